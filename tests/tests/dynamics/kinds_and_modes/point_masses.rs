//! The reference: every body is six point masses. Positions are rotation matrices times columns,
//! differentiated by the product rule; no angular momentum, no moving inertia tensor,
//! no recursion and no emitted code is used.
//!
//! A body of mass m whose second moment about its centre, `½ tr(I) 1 - I`, has the eigenpairs
//! `(λ_k, e_k)` moves as three pairs of masses m / 6 at `± sqrt(3 λ_k / m) e_k` do. Everything is
//! expressed in fixed axes that coincide with B's at the instant; positions are from B at the
//! instant.

use std::ops::{Add, Mul};

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Accelerations, Attitude, Devices};

use super::case::{Case, World};
use super::devices::{Chain, Link, Motion};
use super::rigid::{Rigid, turn};

/// Value, rate and acceleration.
pub(crate) type Moving<X> = [X; 3];

/// A frame as it moves; columns of `axes` are its axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) axes: Moving<Matrix3<f64>>,
    pub(crate) origin: Moving<Vector3<f64>>,
}

/// A point mass, fixed in a body's frame.
#[derive(Clone, Copy, Debug)]
struct Point {
    mass: f64,
    position: Vector3<f64>,
}

/// A body with its masses.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Which chain it belongs to; none of the hub.
    pub(crate) chain: Option<usize>,
    pub(crate) frame: Frame,
    /// The axes of the parent body; of the first in a chain, the device's at zero.
    pub(crate) parent: Matrix3<f64>,
    /// The axes in which its wrenches are expressed.
    pub(crate) own: Matrix3<f64>,
    points: Vec<Point>,
}

/// A mass where it is, and how it moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mass {
    pub(crate) mass: f64,
    pub(crate) r: Moving<Vector3<f64>>,
}

/// Rates of the hub, along B axes, and of the joints; or their accelerations.
#[derive(Clone, Debug)]
pub(crate) struct Rates {
    pub(crate) r_b_n_dot: Vector3<f64>,
    pub(crate) omega: Vector3<f64>,
    pub(crate) joints: Vec<f64>,
}

/// Hub and devices in one state.
#[derive(Clone, Debug)]
pub(crate) struct PointMasses {
    hub: Rigid,
    chains: Vec<Chain>,
    /// `[BN]`.
    pub(crate) bn: Matrix3<f64>,
    /// Of B from the inertial origin.
    pub(crate) r_b_n: Vector3<f64>,
    pub(crate) coordinates: Vec<f64>,
    pub(crate) rates: Rates,
}

impl PointMasses {
    pub(crate) fn of<D: Devices<Scalar = f64>>(
        world: &World,
        case: &Case<D>,
        chains: Vec<Chain>,
    ) -> Self {
        let state = &case.state;
        let bn = state.attitude.dcm();
        let (coordinates, joints) = state.devices.states().map(|[q, rate]| (q, rate)).unzip();
        let rates = Rates { r_b_n_dot: bn * state.r_b_n_dot, omega: state.omega, joints };
        let hub = Rigid::of_hub(&world.hub);
        Self { hub, chains, bn, r_b_n: bn * state.r_b_n, coordinates, rates }
    }

    /// The hub, then the child body of each joint in order, with the state's rates.
    pub(crate) fn bodies(&self, accelerations: &Rates) -> Vec<Body> {
        self.moving(&self.rates, accelerations)
    }

    /// The same with unit rate in one direction only, of hub and joints: the velocities are the
    /// derivatives of positions in that direction.
    pub(crate) fn displaced(&self, direction: usize) -> Vec<Body> {
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
    pub(crate) fn directions(&self) -> usize {
        6 + self.coordinates.len()
    }

    /// What spring and friction of each joint exert.
    pub(crate) fn passive(&self) -> Vec<f64> {
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
    pub(crate) fn none(joints: usize) -> Self {
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
    pub(crate) fn of<D: Devices<Scalar = f64>>(found: &Accelerations<D>) -> Self {
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
    pub(crate) fn angular_velocity(&self) -> Vector3<f64> {
        let [axes, rate, _] = &self.axes;
        let tilde = rate * axes.transpose();
        Vector3::new(tilde.m32, tilde.m13, tilde.m21)
    }
}

impl Body {
    /// Its masses.
    pub(crate) fn masses(&self) -> impl Iterator<Item = Mass> + '_ {
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
