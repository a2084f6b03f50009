//! Random structures with physical modes, and devices of several kinds on their mounts.
//!
//! A structure is a set of point masses on springs that nobody needs to know: any directions of
//! their displacements that are orthonormal in the mass are mass-normalised shapes, and the
//! momentum integrals are sums. So no mode carries more than the structure has.

use nalgebra::{DVector, Matrix3, Quaternion as Hamilton, UnitQuaternion, Vector3};
use precess_dynamics::kind::{Each, JointInfo, JointStates, Kind};
use precess_dynamics::set::OnMount;
use precess_dynamics::{
    ContainedBody, DeviceSet, Devices, Dgvscmg, Flexible, HingedPanel, Hub, ImbalanceModel, Inputs,
    ListedModes, ModalMount, ModalPoint, Modes, Passive, Quaternion, ReactionWheel, SloshMass,
    Spacecraft, State, Wrench,
};
use precess_tests::random::Random;

/// Cases of a suite are drawn from `SEED + n`.
pub(crate) const SEED: u64 = 0x0F1E_71B1;

/// The devices of most cases: all mechanisms (gimbals, an imbalanced rotor, a hinge, slides).
pub(crate) type Mixed = (Dgvscmg, ReactionWheel, HingedPanel, SloshMass);

/// The mounts that the devices of [`Mixed`] stand on: two share one.
pub(crate) const ON_MOUNT: <Mixed as DeviceSet>::Per<OnMount> = (0, 1, 2, 1);

/// Joint and body of a chain, numbers as drawn.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) info: &'static JointInfo,
    pub(crate) origin: [f64; 3],
    pub(crate) mass: f64,
    pub(crate) centre: [f64; 3],
    pub(crate) inertia: Matrix3<f64>,
}

/// A device and its mount.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    pub(crate) axes: Matrix3<f64>,
    pub(crate) mount: usize,
    pub(crate) links: Vec<Link>,
}

/// A spacecraft in a state.
pub(crate) struct Case<D: Devices<Scalar = f64> = Mixed> {
    pub(crate) seed: u64,
    pub(crate) hub: Hub,
    pub(crate) modes: Modes<ListedModes>,
    pub(crate) devices: D,
    pub(crate) craft: Spacecraft<D, Flexible<ListedModes>>,
    pub(crate) chains: Vec<Chain>,
    pub(crate) state: State<D, Quaternion, Flexible<ListedModes>>,
    pub(crate) inputs: Inputs<D, Flexible<ListedModes>>,
}

impl Clone for Case {
    fn clone(&self) -> Self {
        Self {
            seed: self.seed,
            hub: self.hub,
            modes: self.modes.clone(),
            devices: self.devices,
            craft: self.craft.clone(),
            chains: self.chains.clone(),
            state: self.state.clone(),
            inputs: self.inputs.clone(),
        }
    }
}

/// What a case is drawn with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    pub(crate) modes: usize,
    /// Whether the model contains rigid bodies in place of the devices.
    pub(crate) contained: bool,
    /// Rotation of the mounts, rad: about 0.01 for a real structure.
    pub(crate) rotation: f64,
    /// Whether the modes are those of a free structure, orthogonal to its rigid motions.
    pub(crate) free: bool,
}

impl Case {
    pub(crate) fn new(seed: u64, size: Size) -> Self {
        let random = &mut Random::new(seed);
        let devices: Mixed =
            (device(random, 6.0), device(random, 4.0), device(random, 20.0), device(random, 10.0));
        let (hub, modes) = structure(random, size, &[6.0, 14.0, 20.0]);
        let craft = Spacecraft::flexible(&hub, &modes, &devices, &ON_MOUNT).expect("valid");
        let chains = vec![
            chain(&devices.0, ON_MOUNT.0),
            chain(&devices.1, ON_MOUNT.1),
            chain(&devices.2, ON_MOUNT.2),
            chain(&devices.3, ON_MOUNT.3),
        ];
        let mut state = State::at_rest_for(&craft);
        let mut inputs = Inputs::none_for(&craft);
        draw_motion(random, size, &mut state);
        draw_inputs(random, &mut inputs);
        Self { seed, hub, modes, devices, craft, chains, state, inputs }
    }
}

/// Any motion: the frame, the joints, the modes.
pub(crate) fn draw_motion<D: Devices<Scalar = f64>>(
    random: &mut Random,
    size: Size,
    state: &mut State<D, Quaternion, Flexible<ListedModes>>,
) {
    state.r_b_n = random.vector(10.0);
    state.r_b_n_dot = random.vector(3.0);
    state.omega = random.vector(0.8);
    let q = rotation(random).into_inner();
    state.attitude = Quaternion { q0: q.w, q1: q.i, q2: q.j, q3: q.k };
    for [coordinate, rate] in state.devices.states_mut() {
        (*coordinate, *rate) = (random.within(-2.0, 2.0), random.within(-4.0, 4.0));
    }
    // Shapes of about 0.1/sqrt(kg) and 0.1 rad/(m sqrt(kg)): so many times the rotation.
    let eta = 10.0 * size.rotation;
    for (eta_, rate) in state.modal.eta.iter_mut().zip(&mut state.modal.eta_dot) {
        (*eta_, *rate) = (random.within(-eta, eta), random.within(-20.0 * eta, 20.0 * eta));
    }
}

/// Any forces.
pub(crate) fn draw_inputs<D: Devices<Scalar = f64>>(
    random: &mut Random,
    inputs: &mut Inputs<D, Flexible<ListedModes>>,
) {
    inputs.force = random.vector(20.0);
    inputs.torque_b = random.vector(5.0);
    inputs.motors.values_mut().for_each(|motor| *motor = random.within(-1.0, 1.0));
    inputs.modal.forces.iter_mut().for_each(|force| *force = random.within(-1.0, 1.0));
    for wrench in &mut inputs.modal.mounts {
        *wrench = Wrench { force: random.vector(2.0), moment: random.vector(1.0) };
    }
}

/// A rotation in any direction.
fn rotation(random: &mut Random) -> UnitQuaternion<f64> {
    let (axis, angle) = (random.vector(1.0), random.within(-3.0, 3.0));
    let (sin, cos) = libm::sincos(0.5 * angle);
    UnitQuaternion::new_normalize(Hamilton::from_parts(cos, axis * sin))
}

/// The inertia of a block with edges of some decimetres, turned anyhow.
fn inertia(random: &mut Random, mass: f64) -> Matrix3<f64> {
    let edges = Vector3::from_fn(|_, _| random.within(0.1, 0.6));
    let squares = edges.component_mul(&edges);
    let moments = (Vector3::from_element(squares.sum()) - squares) * (mass / 12.0);
    let axes = rotation(random).to_rotation_matrix().into_inner();
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (inertia + inertia.transpose()) * 0.5
}

/// A device of a kind, its first body within 1.5 m of B.
pub(crate) fn device<K: Kind<Scalar = f64>>(random: &mut Random, mass: f64) -> K {
    let mount = rotation(random).to_rotation_matrix().into_inner();
    mounted(random, mass, &mount)
}

/// A device of a kind with this mount.
pub(crate) fn mounted<K: Kind<Scalar = f64>>(
    random: &mut Random,
    mass: f64,
    mount: &Matrix3<f64>,
) -> K {
    let body = precess_dynamics::kind::BodyParameters {
        origin: [0.0; 3],
        mass,
        centre: [0.0; 3],
        inertia: Matrix3::identity(),
    };
    let mut bodies = K::all(body);
    let mut reach = 1.5;
    for body in bodies.values_mut() {
        let own = mass * random.within(0.3, 1.0);
        *body = precess_dynamics::kind::BodyParameters {
            origin: random.vector(reach).into(),
            mass: own,
            centre: random.vector(0.05).into(),
            inertia: inertia(random, own),
        };
        reach = 0.2;
    }
    let passive = K::all(Passive { stiffness: 3.0, viscous: 0.2, rest: 0.1, ..Passive::none() });
    K::of_bodies(mount, &bodies, &passive, ImbalanceModel::Coupled)
}

pub(crate) fn chain<K: Kind<Scalar = f64>>(device: &K, mount: usize) -> Chain {
    let bodies = device.bodies();
    let links = bodies.values().zip(K::JOINTS).map(|(body, info)| Link {
        info,
        origin: body.origin,
        mass: body.mass,
        centre: body.centre,
        inertia: body.inertia,
    });
    Chain { axes: *device.mount(), mount, links: links.collect() }
}

/// What is summed over the masses: of the place and the displacement of each.
type Integrand = fn(&Vector3<f64>, Vector3<f64>) -> Vector3<f64>;

/// Eighty point masses, some modes, and mounts at the first points.
pub(crate) fn structure(
    random: &mut Random,
    size: Size,
    contained: &[f64],
) -> (Hub, Modes<ListedModes>) {
    const POINTS: usize = 80;
    let points: Vec<(f64, Vector3<f64>)> = (0..POINTS)
        .map(|_| (random.within(1.0, 8.0), Vector3::from_fn(|_, _| random.within(-1.5, 1.5))))
        .collect();
    let mass: f64 = points.iter().map(|(m, _)| m).sum();
    let centre = points.iter().fold(Vector3::zeros(), |sum, (m, r)| sum + r * *m) / mass;
    let inertia = points.iter().fold(Matrix3::zeros(), |sum, (m, r)| {
        let d = r - centre;
        sum + (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * *m
    });
    let hub = Hub { m_b: mass, r_bc_b: centre, i_b_bc: (inertia + inertia.transpose()) * 0.5 };

    // Columns orthonormal in sqrt(m) times displacement.
    let mut shapes: Vec<DVector<f64>> = Vec::new();
    let rigid = if size.free { 6 } else { 0 };
    while shapes.len() < rigid + size.modes {
        let mut v = DVector::from_fn(3 * POINTS, |_, _| random.within(-1.0, 1.0));
        if shapes.len() < rigid {
            // Translation along an axis, then rotation about it.
            let axis = Vector3::ith(shapes.len() % 3, 1.0);
            for (k, (m, r)) in points.iter().enumerate() {
                let moved = if shapes.len() < 3 { axis } else { axis.cross(r) };
                v.fixed_rows_mut::<3>(3 * k).copy_from(&(moved * m.sqrt()));
            }
        }
        for _ in 0..2 {
            for known in &shapes {
                v -= known * known.dot(&v);
            }
        }
        shapes.push(v.normalize());
    }
    shapes.drain(..rigid);
    let at = |shape: &DVector<f64>, k: usize| {
        shape.fixed_rows::<3>(3 * k).into_owned() / points[k].0.sqrt()
    };
    let sum = |of: Integrand| -> Vec<Vector3<f64>> {
        let integral = |shape: &DVector<f64>| {
            points
                .iter()
                .enumerate()
                .fold(Vector3::zeros(), |sum, (k, (m, r))| sum + of(r, at(shape, k)) * *m)
        };
        shapes.iter().map(integral).collect()
    };
    let (linear, angular) = (sum(|_, phi| phi), sum(|r, phi| r.cross(&phi)));
    let mounts = contained.iter().enumerate().map(|(k, mass)| {
        let position = points[k].1;
        let point = ModalPoint {
            position,
            translation: shapes.iter().map(|shape| at(shape, k)).collect(),
            rotation: (0..size.modes).map(|_| random.vector(0.1)).collect(),
        };
        // A twentieth of the devices, far less than what the modes move.
        let body = ContainedBody {
            mass: 0.05 * mass,
            centre: position + random.vector(0.1),
            inertia: Matrix3::from_diagonal_element(0.002 * mass),
        };
        ModalMount { point, contained: size.contained.then_some(body) }
    });
    let mounts = mounts.collect();
    let frequencies = (0..size.modes).map(|_| random.log_within(2.0, 60.0)).collect();
    let damping = (0..size.modes).map(|_| random.within(0.0, 0.02)).collect();
    (hub, Modes { frequencies, damping, linear, angular, mounts })
}
