//! Accelerations of the described spacecraft by another way than the emitted one: general sums over
//! bodies, all of the spacecraft's equations at once, solved densely.
//!
//! These are the values that the emitted tests compare with. They come from the general kind with
//! every parameter as described, and know neither assumptions nor elimination.

use rustc_hash::FxHashMap;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::reference::share;
use precess_codegen::graph::Graph;
use precess_description::{Description, Device};

use crate::error::BakeError;
use crate::parameters::parameters;
use crate::shape::Shape;

/// A state of the spacecraft with what acts on it, and the accelerations.
pub(crate) struct Case {
    /// ω_{B/N}, rad/s.
    pub(crate) omega: [f64; 3],
    /// On B, N.
    pub(crate) force: [f64; 3],
    /// About B, N m.
    pub(crate) torque_b: [f64; 3],
    /// Shape by shape, device by device.
    pub(crate) devices: Vec<Vec<Vec<JointCase>>>,
    /// `r̈_{B/N}` and ω̇.
    pub(crate) hub: [f64; 6],
}

/// A joint that is not locked.
pub(crate) struct JointCase {
    pub(crate) link: usize,
    pub(crate) coordinate: f64,
    pub(crate) rate: f64,
    /// Whether its torque is given, or its acceleration.
    pub(crate) driven: bool,
    /// What is given.
    pub(crate) given: f64,
    pub(crate) acceleration: f64,
}

/// Numbers in -1..1 from a seed: the states are chosen once and for all.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        // Knuth's constants; the upper bits are good enough for states of a test.
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        2.0 * unit - 1.0
    }
}

/// Three cases: all joints driven, some prescribed, all prescribed.
pub(crate) fn cases(
    description: &Description,
    shapes: &[Shape<'_>],
) -> Result<Vec<Case>, BakeError> {
    (0..3).map(|number| case(description, shapes, number)).collect()
}

fn case(description: &Description, shapes: &[Shape<'_>], number: u64) -> Result<Case, BakeError> {
    let mut draws = Draws(number + 1);
    let [omega, force, torque_b] =
        [0.1, 5.0, 2.0].map(|scale| [(); 3].map(|()| scale * draws.next()));
    let mut devices: Vec<Vec<Vec<JointCase>>> = Vec::new();
    let mut joint = 0;
    for shape in shapes {
        let mut own = Vec::new();
        for _ in &shape.devices {
            let moving = shape.kind.links.iter().enumerate().filter(|(_, link)| !link.is_locked());
            let drawn = moving.map(|(link, data)| {
                joint += 1;
                let tip = link + 1 == shape.kind.links.len();
                let driven = data.is_driven() && (number == 0 || number == 1 && joint % 2 == 0);
                JointCase {
                    link,
                    coordinate: 3.0 * draws.next(),
                    rate: if tip { 600.0 } else { 2.0 } * draws.next(),
                    driven,
                    given: if data.is_driven() { draws.next() } else { 0.0 },
                    acceleration: 0.0,
                }
            });
            own.push(drawn.collect());
        }
        devices.push(own);
    }
    let mut case = Case { omega, force, torque_b, devices, hub: [0.0; 6] };
    solve(description, shapes, &mut case)?;
    Ok(case)
}

/// The whole system: hub first, then the joints whose torque is given.
fn solve(
    description: &Description,
    shapes: &[Shape<'_>],
    case: &mut Case,
) -> Result<(), BakeError> {
    let driven = case.devices.iter().flatten().flatten().filter(|joint| joint.driven).count();
    let size = 6 + driven;
    let (mut mass, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
    let omega = Vector3::from(case.omega);
    let hub = &description.hub;
    let (inertia, c) = (matrix(&hub.inertia), Vector3::from(hub.centre_of_mass));
    let parallel = hub.mass * (c.norm_squared() * Matrix3::identity() - c * c.transpose());
    let inertia = inertia + parallel;
    add_rigid(&mut mass, hub.mass, hub.mass * c, &inertia);
    let turning = omega.cross(&omega.cross(&(hub.mass * c)));
    let gyroscopic = omega.cross(&(inertia * omega));
    right.fixed_rows_mut::<3>(0).copy_from(&(Vector3::from(case.force) - turning));
    right.fixed_rows_mut::<3>(3).copy_from(&(Vector3::from(case.torque_b) - gyroscopic));
    let mut next = 6;
    for (shape, joints) in shapes.iter().zip(&case.devices) {
        for (device, joints) in shape.devices.iter().zip(joints) {
            next = add_device(shape, device, joints, omega, next, &mut mass, &mut right);
        }
    }
    // Scaled to a unit diagonal: kilograms beside kilogram square metres.
    let scale = mass.diagonal().map(|entry| entry.sqrt().recip());
    let scaled = DMatrix::from_diagonal(&scale) * mass * DMatrix::from_diagonal(&scale);
    let found = scaled.lu().solve(&right.component_mul(&scale)).ok_or(BakeError::Singular)?;
    let found = found.component_mul(&scale);
    if !found.iter().all(|x| x.is_finite()) {
        return Err(BakeError::Singular);
    }
    case.hub = std::array::from_fn(|k| found[k]);
    let mut next = 6;
    for joint in case.devices.iter_mut().flatten().flatten() {
        joint.acceleration = joint.given;
        if joint.driven {
            joint.acceleration = found[next];
            next += 1;
        }
    }
    Ok(())
}

fn add_rigid(mass: &mut DMatrix<f64>, m: f64, first_moment: Vector3<f64>, inertia: &Matrix3<f64>) {
    let tilde = first_moment.cross_matrix();
    let mut add = |row: usize, column: usize, block: Matrix3<f64>| {
        let mut view = mass.fixed_view_mut::<3, 3>(row, column);
        view += block;
    };
    add(0, 0, m * Matrix3::identity());
    add(0, 3, -tilde);
    add(3, 0, tilde);
    add(3, 3, *inertia);
}

/// A device along its own axes, turned to B.
fn add_device(
    shape: &Shape<'_>,
    device: &Device,
    joints: &[JointCase],
    omega: Vector3<f64>,
    first: usize,
    mass: &mut DMatrix<f64>,
    right: &mut DVector<f64>,
) -> usize {
    let graph = Graph::new();
    let share = share(&Chain::new(&graph, shape.general));
    let mount = matrix(&device.mount);
    let mut values: FxHashMap<String, f64> = FxHashMap::default();
    for parameter in parameters(shape.general) {
        values.insert(parameter.name.clone(), parameter.place.value(device));
    }
    for (k, link) in shape.general.links.iter().enumerate() {
        let moving = joints.iter().find(|joint| joint.link == k);
        let locked = device.body[k].locked_at.unwrap_or_default();
        let coordinate = moving.map_or(locked, |joint| joint.coordinate);
        let name = link.joint.coordinate;
        values.insert(format!("sin_{name}"), coordinate.sin());
        values.insert(format!("cos_{name}"), coordinate.cos());
        values.insert(name.to_owned(), coordinate);
        values.insert(link.joint.rate.to_owned(), moving.map_or(0.0, |joint| joint.rate));
    }
    let along = mount.transpose() * omega;
    for (axis, value) in ["x", "y", "z"].iter().zip(along.iter()) {
        values.insert(format!("omega_b{axis}"), *value);
    }
    let value = |name: &str| values.get(name).copied().unwrap_or_default();
    let number = |e: precess_codegen::graph::Expr<'_>| e.evaluate(&value);
    let vector = |v: precess_codegen::space::Vector<'_, precess_codegen::space::Hub>| {
        let v: [f64; 3] = v.components().map(number);
        mount * Vector3::from(v)
    };
    let [xx, xy, xz, yy, yz, zz] = share.inertia.entries().map(number);
    let inertia = mount * Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) * mount.transpose();
    add_rigid(mass, number(share.mass), vector(share.first_moment), &inertia);
    subtract(right, 0, vector(share.bias_force));
    subtract(right, 3, vector(share.bias_moment));
    // What a given acceleration requires goes to the right side.
    let columns = joints.iter().scan(first, |next, joint| {
        let own = joint.driven.then_some(*next);
        *next += usize::from(joint.driven);
        Some(own)
    });
    let columns: Vec<_> = columns.collect();
    for (joint, column) in joints.iter().zip(&columns) {
        let (f, n) = (vector(share.force[joint.link]), vector(share.moment[joint.link]));
        if let Some(column) = column {
            for (k, entry) in f.iter().chain(n.iter()).enumerate() {
                mass[(k, *column)] += entry;
                mass[(*column, k)] += entry;
            }
            right[*column] += joint.given - number(share.bias_joint[joint.link]);
        } else {
            subtract(right, 0, f * joint.given);
            subtract(right, 3, n * joint.given);
        }
    }
    for (joint, row) in joints.iter().zip(&columns) {
        let Some(row) = row else { continue };
        for (other, column) in joints.iter().zip(&columns) {
            let (inner, outer) = (joint.link.min(other.link), joint.link.max(other.link));
            let entry = number(share.joint[inner][outer - inner]);
            match column {
                Some(column) => mass[(*row, *column)] += entry,
                None => right[*row] -= entry * other.given,
            }
        }
    }
    first + columns.iter().flatten().count()
}

fn subtract(right: &mut DVector<f64>, row: usize, v: Vector3<f64>) {
    let mut view = right.fixed_rows_mut::<3>(row);
    view -= v;
}

fn matrix(rows: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}
