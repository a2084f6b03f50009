//! The equations of motion from the kinetic energy, by differences in double-double.
//!
//! `T = ½ V . M(x) V` in the velocities `V = (v, omega, x')` with coordinates `x = (eta, q)`: v is
//! the velocity of B and omega the angular velocity, both expressed in B. T does not depend on
//! place and attitude, so Hamel's equations are
//!
//! ```text
//! (M V)'_v + omega x p = F           (M V)'_omega + omega x h + v x p = L
//! (M V)'_x - ½ V . (dM/dx) V = Q
//! ```
//!
//! Nothing is taken from the solver: places and rotations of all bodies are composed from the
//! parameters, their Jacobians are differences of fourth order, and so are the derivatives of M.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Angle, ContainedBody, Devices, Gravity, Real, Scalar};
use precess_tests::double_double::DoubleDouble as DD;
use precess_tests::newton_euler::vector::{Tensor, Vector, cross, dot, tilde};

use crate::craft::{Case, Chain};

/// Steps of the differences: of places, and of the mass matrix. Their truncation is of the fourth
/// power, 1e-24 and 1e-18; rounding, 1e-31, over the step stays far below.
const STEPS: [f64; 2] = [1e-6, 3e-5];

type Matrix = Vec<Vec<DD>>;

pub(crate) fn dd(value: f64) -> DD {
    DD::from_f64(value)
}

pub(crate) fn vector(v: &Vector3<f64>) -> Vector<DD> {
    Vector([v.x, v.y, v.z].map(dd))
}

pub(crate) fn tensor(m: &Matrix3<f64>) -> Tensor<DD> {
    Tensor::from(&m.map(dd))
}

/// Place of a body's centre of mass and its axes, expressed in B.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) at: Vector<DD>,
    pub(crate) axes: Tensor<DD>,
    /// The origin of the body's joint; without one, the place itself.
    pub(crate) origin: Vector<DD>,
}

/// What has mass, or a wrench in own axes.
pub(crate) struct Body {
    pub(crate) mass: DD,
    pub(crate) inertia: Tensor<DD>,
    wrench: Option<(Vector<DD>, Vector<DD>)>,
}

/// Accelerations of the reference, and the terms for a backward error.
pub(crate) struct Reference {
    /// `a_B` and omega', expressed in B, eta'', q''.
    pub(crate) accelerations: Vec<f64>,
    pub(crate) mass: Matrix,
    force: Vec<DD>,
    /// What the rows of the velocity of B have besides the acceleration of B: `omega x v`.
    convective: Vector<DD>,
}

impl Reference {
    /// Residual of accelerations in units of `|M| |a| + |h|`, row by row; the largest.
    pub(crate) fn backward_error(&self, found: &[f64]) -> f64 {
        let mut unknowns: Vec<DD> = found.iter().copied().map(dd).collect();
        for (unknown, part) in unknowns.iter_mut().zip(self.convective.0) {
            *unknown = *unknown - part;
        }
        let row = |(row, force): (&Vec<DD>, &DD)| {
            let terms = row.iter().zip(&unknowns).map(|(m, a)| *m * *a);
            let (mut sum, mut size) = (-*force, force.abs());
            for term in terms {
                sum = sum + term;
                size = size + term.abs();
            }
            (sum.abs() * size.recip()).to_f64()
        };
        self.mass.iter().zip(&self.force).map(row).fold(0.0, f64::max)
    }
}

/// Poses of all bodies for coordinates `x`: those of the devices, those contained, the mounts.
pub(crate) fn poses<D: Devices<Scalar = f64>>(case: &Case<D>, x: &[DD]) -> Vec<Pose> {
    let (eta, mut q) = x.split_at(case.modes.frequencies.len());
    let mounts: Vec<_> = case
        .modes
        .mounts
        .iter()
        .map(|mount| {
            let combined = |shapes: &[Vector3<f64>]| {
                shapes.iter().zip(eta).fold(Vector::zero(), |sum, (s, e)| sum + vector(s) * *e)
            };
            let r_0 = vector(&mount.point.position);
            let shift = combined(&mount.point.translation);
            (r_0, r_0 + shift, exponential(combined(&mount.point.rotation)))
        })
        .collect();
    let on_mount = |k: usize, at: Vector<DD>, axes: Tensor<DD>, origin: Vector<DD>| {
        let (r_0, r, turn) = mounts[k];
        let [at, origin] = [at, origin].map(|place| r + turn * (place - r_0));
        Pose { at, axes: turn * axes, origin }
    };
    let mut poses = Vec::new();
    for Chain { axes, mount, links } in &case.chains {
        let (mut axes, mut origin) = (tensor(axes), Vector::zero());
        for (index, link) in links.iter().enumerate() {
            let offset = Vector(link.origin.map(dd));
            // The first origin is expressed in B, those after it in the parent's axes.
            origin = origin + if index == 0 { offset } else { axes * offset };
            let (coordinate, rest) = q.split_first().expect("a coordinate");
            q = rest;
            let axis = Vector::unit(link.info.axis);
            if link.info.slides {
                origin = origin + axes * axis * *coordinate;
            } else {
                axes = axes * exponential(axis * *coordinate);
            }
            let centre = origin + axes * Vector(link.centre.map(dd));
            poses.push(on_mount(*mount, centre, axes, origin));
        }
    }
    for (k, mount) in case.modes.mounts.iter().enumerate() {
        let at = |place| on_mount(k, place, Tensor::identity(), place);
        let body = |body: &ContainedBody| at(vector(&body.centre));
        poses.extend(mount.contained.as_ref().map(body));
        poses.push(at(mounts[k].0));
    }
    poses
}

/// What the poses are of.
pub(crate) fn bodies<D: Devices<Scalar = f64>>(case: &Case<D>) -> Vec<Body> {
    let mut bodies = Vec::new();
    for link in case.chains.iter().flat_map(|chain| &chain.links) {
        let (mass, inertia) = (dd(link.mass), tensor(&link.inertia));
        bodies.push(Body { mass, inertia, wrench: None });
    }
    for (mount, wrench) in case.modes.mounts.iter().zip(&case.inputs.modal.mounts) {
        if let Some(body) = &mount.contained {
            let (mass, inertia) = (-dd(body.mass), tensor(&body.inertia) * dd(-1.0));
            bodies.push(Body { mass, inertia, wrench: None });
        }
        let wrench = Some((vector(&wrench.force), vector(&wrench.moment)));
        bodies.push(Body { mass: dd(0.0), inertia: tensor(&Matrix3::zeros()), wrench });
    }
    bodies
}

/// `exp(tilde(t))`, by Rodrigues.
pub(crate) fn exponential(t: Vector<DD>) -> Tensor<DD> {
    let angle = t.norm();
    if angle.to_f64() == 0.0 {
        return Tensor::identity();
    }
    let (sin, cos) = angle.sin_cos();
    let n = tilde(t * angle.recip());
    Tensor::identity() + n * sin + n * n * (dd(1.0) - cos)
}

/// The difference of fourth order from values at -2, -1, 1, 2 steps.
pub(crate) fn difference<V>(
    step: f64,
    at: impl Fn(DD) -> V,
    scale: impl Fn(&V, &V, DD, &V, &V) -> V,
) -> V {
    let h = dd(step);
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(dd(k) * h));
    scale(&a, &b, (dd(12.0) * h).recip(), &c, &d)
}

pub(crate) fn shifted(x: &[DD], index: usize, by: DD) -> Vec<DD> {
    let mut x = x.to_vec();
    x[index] = x[index] + by;
    x
}

/// Linear and angular Jacobian of each body by columns: `v, omega, x'`.
fn jacobians<D: Devices<Scalar = f64>>(
    case: &Case<D>,
    x: &[DD],
) -> Vec<(Pose, Vec<[Vector<DD>; 2]>)> {
    let now = poses(case, x);
    let slope = |a: DD, b: DD, h: DD, c: DD, d: DD| (a - d + (c - b) * dd(8.0)) * h;
    let columns: Vec<Vec<Pose>> = (0..x.len())
        .map(|index| {
            difference(
                STEPS[0],
                |by| poses(case, &shifted(x, index, by)),
                |a, b, h, c, d| {
                    let four = a.iter().zip(b).zip(c).zip(d);
                    four.map(|(((a, b), c), d)| Pose {
                        origin: Vector::zero(),
                        at: Vector(core::array::from_fn(|i| {
                            slope(a.at.0[i], b.at.0[i], h, c.at.0[i], d.at.0[i])
                        })),
                        axes: Tensor(core::array::from_fn(|i| {
                            core::array::from_fn(|j| {
                                slope(
                                    a.axes.0[i][j],
                                    b.axes.0[i][j],
                                    h,
                                    c.axes.0[i][j],
                                    d.axes.0[i][j],
                                )
                            })
                        })),
                    })
                    .collect()
                },
            )
        })
        .collect();
    now.into_iter()
        .enumerate()
        .map(|(body, pose)| {
            let unit = Vector::<DD>::unit;
            let mut jacobian: Vec<_> = (0..3).map(|i| [unit(i), Vector::zero()]).collect();
            jacobian.extend((0..3).map(|i| [cross(unit(i), pose.at), unit(i)]));
            for column in &columns {
                // R' Rᵀ is the matrix of the angular velocity.
                let spin = (column[body].axes * pose.axes.transpose()).0;
                let omega = Vector([
                    (spin[2][1] - spin[1][2]) * dd(0.5),
                    (spin[0][2] - spin[2][0]) * dd(0.5),
                    (spin[1][0] - spin[0][1]) * dd(0.5),
                ]);
                jacobian.push([column[body].at, omega]);
            }
            (pose, jacobian)
        })
        .collect()
}

/// The mass matrix: bodies, and the truncated kinetic energy of the structure.
fn mass_matrix<D: Devices<Scalar = f64>>(case: &Case<D>, x: &[DD]) -> Matrix {
    let size = 6 + x.len();
    let mut mass = vec![vec![dd(0.0); size]; size];
    for (body, (pose, jacobian)) in bodies(case).iter().zip(jacobians(case, x)) {
        let inertia = body.inertia.resolved_from(pose.axes);
        for (row, [v, w]) in mass.iter_mut().zip(&jacobian) {
            let (p, h) = (*v * body.mass, inertia * *w);
            for (entry, [v, w]) in row.iter_mut().zip(&jacobian) {
                *entry = *entry + dot(p, *v) + dot(h, *w);
            }
        }
    }
    // T = ½ m v.v + v.(omega x s) + v.P eta' + ½ omega.I omega + omega.H eta' + ½ eta'.modal.eta'
    let (m, c) = (dd(case.hub.m_b), vector(&case.hub.r_bc_b));
    let linear = case.modes.linear.iter().zip(x);
    let s = linear.fold(c * m, |sum, (p, eta)| sum + vector(p) * *eta);
    let about_b = Tensor::identity() * dot(c, c) - Tensor([0, 1, 2].map(|i| (c * c.0[i]).0));
    let inertia = tensor(&case.hub.i_b_bc) + about_b * m;
    let coupling = tilde(s);
    for i in 0..3 {
        mass[i][i] = mass[i][i] + m;
        for j in 0..3 {
            mass[i][3 + j] = mass[i][3 + j] - coupling.0[i][j];
            mass[3 + j][i] = mass[3 + j][i] - coupling.0[i][j];
            mass[3 + i][3 + j] = mass[3 + i][3 + j] + inertia.0[i][j];
        }
        for (k, (p, h)) in case.modes.linear.iter().zip(&case.modes.angular).enumerate() {
            for (row, value) in [(i, p[i]), (3 + i, h[i])] {
                mass[row][6 + k] = mass[row][6 + k] + dd(value);
                mass[6 + k][row] = mass[6 + k][row] + dd(value);
            }
        }
    }
    for (k, row) in mass.iter_mut().enumerate().skip(6).take(case.craft.massive()) {
        row[k] = row[k] + dd(1.0);
    }
    mass
}

/// Accelerations of a case.
pub(crate) fn reference<D: Devices<Scalar = f64>>(case: &Case<D>) -> Reference {
    let rigid = &case.state;
    let joints: Vec<_> = rigid.devices.states().collect();
    let x: Vec<DD> =
        case.state.modal.eta.iter().copied().chain(joints.iter().map(|q| q[0])).map(dd).collect();
    let rates = case.state.modal.eta_dot.iter().copied().chain(joints.iter().map(|q| q[1]));
    let omega = vector(&rigid.omega);
    // Quaternions of the suites have length one to rounding; so has the solver's matrix.
    let v = Tensor::from(&precess_dynamics::Attitude::dcm(&rigid.attitude).map(dd))
        * vector(&rigid.r_b_n_dot);
    let velocities: Vec<DD> = v.0.into_iter().chain(omega.0).chain(rates.clone().map(dd)).collect();

    let mass = mass_matrix(case, &x);
    let slopes: Vec<Matrix> = (0..x.len())
        .map(|index| {
            difference(
                STEPS[1],
                |by| mass_matrix(case, &shifted(&x, index, by)),
                |a, b, h, c, d| {
                    let entry = |i: usize, j: usize| {
                        (a[i][j] - d[i][j] + (c[i][j] - b[i][j]) * dd(8.0)) * h
                    };
                    (0..a.len()).map(|i| (0..a.len()).map(|j| entry(i, j)).collect()).collect()
                },
            )
        })
        .collect();
    let times = |m: &Matrix, v: &[DD]| -> Vec<DD> {
        m.iter().map(|row| row.iter().zip(v).fold(dd(0.0), |s, (a, b)| s + *a * *b)).collect()
    };
    let mut force = vec![dd(0.0); velocities.len()];
    for (index, (slope, rate)) in slopes.iter().zip(rates.map(dd)).enumerate() {
        let of_slope = times(slope, &velocities);
        let energy = of_slope.iter().zip(&velocities).fold(dd(0.0), |s, (a, b)| s + *a * *b);
        force[6 + index] = force[6 + index] + energy * dd(0.5);
        for (to, term) in force.iter_mut().zip(of_slope) {
            *to = *to - term * rate;
        }
    }
    let momentum = times(&mass, &velocities);
    let p = Vector([momentum[0], momentum[1], momentum[2]]);
    let h = Vector([momentum[3], momentum[4], momentum[5]]);
    let linear = vector(&case.inputs.force) - cross(omega, p);
    let angular = vector(&case.inputs.torque_b) - cross(omega, h) - cross(v, p);
    let generalised = generalised_forces(case);
    let mut generalised: Vec<DD> = generalised.into_iter().map(dd).collect();
    let mut field = [Vector::zero(); 2];
    if let Gravity::Central { mu } = case.inputs.gravity {
        let found = crate::field::forces(case, dd(mu), &x);
        field = [found.force, found.torque];
        for (sum, force) in generalised.iter_mut().zip(found.generalised) {
            *sum = *sum + force;
        }
    }
    let (linear, angular) = (linear + field[0], angular + field[1]);
    let given = linear.0.into_iter().chain(angular.0).chain(generalised);
    for (to, term) in force.iter_mut().zip(given) {
        *to = *to + term;
    }
    for (body, (pose, jacobian)) in bodies(case).iter().zip(jacobians(case, &x)) {
        let Some((f, m)) = body.wrench else { continue };
        for (to, [v, w]) in force.iter_mut().zip(&jacobian) {
            *to = *to + dot(pose.axes * f, *v) + dot(pose.axes * m, *w);
        }
    }
    let mut solution = solve(mass.clone(), force.clone());
    // The derivative of v's components, and the inertial acceleration of B.
    let convective = cross(omega, v);
    for (to, term) in solution.iter_mut().zip(convective.0) {
        *to = *to + term;
    }
    let accelerations = solution.into_iter().map(Scalar::to_f64).collect();
    Reference { accelerations, mass, force, convective }
}

/// Modal forces; motors, springs and dampers of the joints. In `f64`: as exact as they enter.
fn generalised_forces<D: Devices<Scalar = f64>>(case: &Case<D>) -> Vec<f64> {
    let modes = &case.modes;
    let mut forces: Vec<f64> = (0..modes.frequencies.len())
        .map(|k| {
            let (w, zeta) = (dd(modes.frequencies[k]), dd(modes.damping[k]));
            let (eta, rate) = (dd(case.state.modal.eta[k]), dd(case.state.modal.eta_dot[k]));
            (dd(case.inputs.modal.forces[k]) - w * w * eta - dd(2.0) * zeta * w * rate).to_f64()
        })
        .collect();
    let joints = case.state.devices.states().zip(case.inputs.motors.values());
    // As `craft::device` gives every joint: 3 N m/rad about 0.1 rad, 0.2 N m s/rad.
    forces.extend(joints.map(|([q, rate], motor)| motor - 3.0 * (q - 0.1) - 0.2 * rate));
    forces
}

/// Elimination with the largest pivot of each column.
fn solve(mut a: Matrix, mut b: Vec<DD>) -> Vec<DD> {
    let size = b.len();
    for column in 0..size {
        let largest = (column..size)
            .max_by(|i, j| a[*i][column].abs().to_f64().total_cmp(&a[*j][column].abs().to_f64()));
        let largest = largest.expect("a row");
        a.swap(column, largest);
        b.swap(column, largest);
        for row in column + 1..size {
            let factor = a[row][column] / a[column][column];
            let pivot_row = a[column].clone();
            for (entry, above) in a[row].iter_mut().zip(pivot_row).skip(column) {
                *entry = *entry - factor * above;
            }
            b[row] = b[row] - factor * b[column];
        }
    }
    for row in (0..size).rev() {
        let known = (row + 1..size).fold(b[row], |sum, k| sum - a[row][k] * b[k]);
        b[row] = known / a[row][row];
    }
    b
}
