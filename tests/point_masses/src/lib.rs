//! A reference for devices of every kind: every body is six point masses. Positions are rotation matrices times columns,
//! differentiated by the product rule; no angular momentum, no moving inertia tensor,
//! no recursion and no emitted code is used.
//!
//! A body of mass m whose second moment about its centre, `½ tr(I) 1 - I`, has the eigenpairs
//! `(λ_k, e_k)` moves as three pairs of masses m / 6 at `± sqrt(3 λ_k / m) e_k` do. Everything is
//! expressed in fixed axes that coincide with B's at the instant; positions are from B at the
//! instant.

mod chain;
mod equations;
mod rigid;

use std::ops::{Add, Mul};

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Accelerations, Attitude, Devices, Hub, State};

pub use chain::{Chain, Link, Motion};
pub use equations::DirectionEquation;
pub use rigid::{Rigid, posed, turn};

/// Value, rate and acceleration.
pub type Moving<X> = [X; 3];

/// A frame as it moves; columns of `axes` are its axes.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Of the frame, as columns.
    pub axes: Moving<Matrix3<f64>>,
    /// From B at the instant, m.
    pub origin: Moving<Vector3<f64>>,
}

/// A point mass, fixed in a body's frame.
#[derive(Clone, Copy, Debug)]
struct Point {
    mass: f64,
    position: Vector3<f64>,
}

/// A body with its masses.
#[derive(Clone, Debug)]
pub struct Body {
    /// Which chain it belongs to; none of the hub.
    pub chain: Option<usize>,
    /// Its frame.
    pub frame: Frame,
    /// The axes of the parent body; of the first in a chain, the device's at zero.
    pub parent: Matrix3<f64>,
    /// The axes in which its wrenches are expressed.
    pub own: Matrix3<f64>,
    points: Vec<Point>,
}

/// A mass where it is, and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    /// kg.
    pub mass: f64,
    /// From B at the instant, m.
    pub r: Moving<Vector3<f64>>,
}

/// Rates of the hub, along B axes, and of the joints; or their accelerations.
#[derive(Clone, Debug)]
pub struct Rates {
    /// Of B, m/s.
    pub r_b_n_dot: Vector3<f64>,
    /// Of the hub, rad/s.
    pub omega: Vector3<f64>,
    /// Of the joints, rad/s or m/s.
    pub joints: Vec<f64>,
}

/// Hub and devices in one state.
#[derive(Clone, Debug)]
pub struct PointMasses {
    hub: Rigid,
    chains: Vec<Chain>,
    /// `[BN]`.
    pub bn: Matrix3<f64>,
    /// Of B from the inertial origin.
    pub r_b_n: Vector3<f64>,
    /// Of the joints, rad or m.
    pub coordinates: Vec<f64>,
    /// Of hub and joints.
    pub rates: Rates,
}

impl PointMasses {
    /// Of a spacecraft in a state.
    #[must_use]
    pub fn of_spacecraft<D: Devices<Scalar = f64>>(
        hub: &Hub,
        state: &State<D>,
        chains: Vec<Chain>,
    ) -> Self {
        let bn = state.attitude.dcm();
        let (coordinates, joints) = state.devices.states().map(|[q, rate]| (q, rate)).unzip();
        let rates = Rates { r_b_n_dot: bn * state.r_b_n_dot, omega: state.omega, joints };
        let hub = Rigid::of_hub(hub);
        Self { hub, chains, bn, r_b_n: bn * state.r_b_n, coordinates, rates }
    }

    /// The hub, then the child body of each joint in order, with the state's rates.
    #[must_use]
    pub fn bodies(&self, accelerations: &Rates) -> Vec<Body> {
        self.moving(&self.rates, accelerations)
    }

    /// The same with unit rate in one direction only, of hub and joints: the velocities are the
    /// derivatives of positions in that direction.
    #[must_use]
    pub fn displaced(&self, direction: usize) -> Vec<Body> {
        let unit = Rates::unit(direction, self.coordinates.len());
        self.moving(&unit, &Rates::none(self.coordinates.len()))
    }

    fn moving(&self, rates: &Rates, accelerations: &Rates) -> Vec<Body> {
        let turning = rates.omega.cross_matrix();
        let axes =
            [Matrix3::identity(), turning, turning * turning + accelerations.omega.cross_matrix()];
        let origin = [Vector3::zeros(), rates.r_b_n_dot, accelerations.r_b_n_dot];
        let hub = Frame { axes, origin };
        let (parent, own) = (Matrix3::identity(), Matrix3::identity());
        let mut bodies =
            vec![Body { chain: None, frame: hub, parent, own, points: points(&self.hub) }];
        let mut joints = self.coordinates.iter().zip(&rates.joints).zip(&accelerations.joints);
        for (number, chain) in self.chains.iter().enumerate() {
            let mut frame = hub.carried(&chain.position).turned_by(&chain.mount);
            for (link, ((q, rate), acceleration)) in chain.links.iter().zip(&mut joints) {
                let parent = frame.axes[0];
                frame = frame.carried(&link.origin).moved(link.motion, [*q, *rate, *acceleration]);
                let Link { mass, centre, inertia, .. } = *link;
                let own = if link.round { parent } else { frame.axes[0] };
                let points = points(&Rigid { mass, centre, inertia });
                bodies.push(Body { chain: Some(number), frame, parent, own, points });
            }
        }
        bodies
    }

    /// How many directions there are.
    #[must_use]
    pub fn directions(&self) -> usize {
        6 + self.coordinates.len()
    }

    /// What spring and friction of each joint exert.
    #[must_use]
    pub fn passive(&self) -> Vec<f64> {
        let all = self.chains.iter().flat_map(|chain| &chain.passive);
        let states = self.coordinates.iter().zip(&self.rates.joints);
        let of = all.zip(states).map(|(p, (q, rate))| {
            let dry = if p.coulomb == 0.0 {
                0.0
            } else {
                p.coulomb * rate / libm::hypot(*rate, p.coulomb_rate)
            };
            -p.stiffness * (q - p.rest) - p.viscous * rate - dry
        });
        of.collect()
    }
}

impl Rates {
    /// All zero.
    #[must_use]
    pub fn none(joints: usize) -> Self {
        let still = Vector3::zeros();
        Self { r_b_n_dot: still, omega: still, joints: vec![0.0; joints] }
    }

    fn unit(direction: usize, joints: usize) -> Self {
        let mut rates = Self::none(joints);
        let Self { r_b_n_dot, omega, joints } = &mut rates;
        let mut all = r_b_n_dot.iter_mut().chain(omega.iter_mut()).chain(joints);
        *all.nth(direction).expect("a direction") = 1.0;
        rates
    }

    /// Accelerations of any set.
    #[must_use]
    pub fn of_accelerations<D: Devices<Scalar = f64>>(found: &Accelerations<D>) -> Self {
        let (r_b_n_dot, omega) = (found.r_b_n_ddot, found.omega_dot);
        Self { r_b_n_dot, omega, joints: found.devices.values().collect() }
    }
}

impl Frame {
    /// The frame with its origin at a point fixed in it.
    fn carried(&self, r: &Vector3<f64>) -> Self {
        Self { origin: self.at(r), ..*self }
    }

    /// A point that is fixed in it.
    fn at(&self, r: &Vector3<f64>) -> Moving<Vector3<f64>> {
        std::array::from_fn(|k| self.origin[k] + self.axes[k] * r)
    }

    fn turned_by(&self, turn: &Matrix3<f64>) -> Self {
        Self { axes: self.axes.map(|axes| axes * turn), ..*self }
    }

    /// The frame of the child body of a joint.
    fn moved(&self, motion: Motion, [q, rate, acceleration]: Moving<f64>) -> Self {
        match motion {
            Motion::Turns(axis) => {
                // The derivative of a rotation by its angle is the rotation times this.
                let by = axis.cross_matrix();
                let turned = turn(&axis, q);
                let (first, second) = (turned * by, turned * by * by);
                let ddot = first * acceleration + second * (rate * rate);
                Self { axes: product(&self.axes, &[turned, first * rate, ddot]), ..*self }
            }
            Motion::Slides(axis) => {
                let slid = product(&self.axes, &[axis * q, axis * rate, axis * acceleration]);
                Self { origin: std::array::from_fn(|k| self.origin[k] + slid[k]), ..*self }
            }
        }
    }

    /// `A' A^T` is the tilde of it.
    #[must_use]
    pub fn angular_velocity(&self) -> Vector3<f64> {
        let [axes, rate, _] = &self.axes;
        let tilde = rate * axes.transpose();
        Vector3::new(tilde.m32, tilde.m13, tilde.m21)
    }
}

impl Body {
    /// Its masses.
    pub fn masses(&self) -> impl Iterator<Item = Mass> + '_ {
        self.points.iter().map(|point| Mass { mass: point.mass, r: self.frame.at(&point.position) })
    }
}

/// The product rule, twice.
fn product<X>(a: &Moving<Matrix3<f64>>, b: &Moving<X>) -> Moving<X>
where
    X: Copy + Add<Output = X> + Mul<f64, Output = X>,
    Matrix3<f64>: Mul<X, Output = X>,
{
    let [a, a_dot, a_ddot] = *a;
    let [b, b_dot, b_ddot] = *b;
    [a * b, a_dot * b + a * b_dot, a_ddot * b + a_dot * b_dot * 2.0 + a * b_ddot]
}

/// The six masses of a body; none of a body without mass.
fn points(body: &Rigid) -> Vec<Point> {
    if body.mass == 0.0 {
        return Vec::new();
    }
    let half_trace = Matrix3::from_diagonal_element(body.inertia.trace() / 2.0);
    let SymmetricEigen { eigenvectors, eigenvalues } =
        (half_trace - body.inertia).symmetric_eigen();
    let pairs = eigenvectors.column_iter().zip(&eigenvalues).flat_map(|(axis, moment)| {
        // A thin body's may be below zero by rounding.
        let arm = axis * (3.0 * moment.max(0.0) / body.mass).sqrt();
        [body.centre + arm, body.centre - arm]
    });
    pairs.map(|position| Point { mass: body.mass / 6.0, position }).collect()
}
