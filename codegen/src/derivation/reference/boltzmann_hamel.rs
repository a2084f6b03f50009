//! The equations of motion from the kinetic energy only: Boltzmann and Hamel's.
//!
//! With v the inertial velocity of point B and omega the body rate, both expressed in B and neither
//! the rate of a coordinate, and T(v, omega, q'; q):
//!
//! ```text
//! F   = d(T_v)/dt + omega x T_v
//! L_B = d(T_omega)/dt + omega x T_omega + v x T_v
//! u_i = d(T_qi')/dt - T_qi
//! ```
//!
//! Of the transport-theorem derivation only the places of the bodies enter: T is built from
//! the velocities of the centres of mass and of the body's axes, so that no angular velocity of a
//! body, no parallel axes and no force is ever stated.

use super::{BodyInHub, bodies};
use crate::derivation::chain::Chain;
use crate::graph::Expr;
use crate::space::{Hub, Vector};

/// T with its slopes, and the equations that follow from it.
pub struct BoltzmannHamel<'g> {
    /// T, the kinetic energy.
    pub energy: Expr<'g>,
    /// `T_v`: linear momentum.
    pub linear: Vector<'g, Hub>,
    /// `T_omega`: angular momentum about B.
    pub angular: Vector<'g, Hub>,
    /// `d^2 T / dx dy`, upper triangle by rows, for the speeds x of v, omega, joints.
    pub mass: Vec<Vec<Expr<'g>>>,
    /// The left sides of F, `L_B` and every u, accelerations included.
    pub equations: Vec<Expr<'g>>,
}

/// Derives the equations of a device on a hub without mass.
#[must_use]
pub fn boltzmann_hamel<'g>(chain: &Chain<'g>) -> BoltzmannHamel<'g> {
    let (v, omega) = (chain.hub.r_b_n_dot, chain.hub.omega);
    let energy = energy(chain);
    let slope =
        |speeds: Vector<'g, Hub>| Vector::new(speeds.components().map(|x| energy.partial(x)));
    let (linear, angular) = (slope(v), slope(omega));

    // Expressed in B: `prime` with omega is the inertial derivative.
    let force = linear.prime(omega);
    let torque_b = angular.prime(omega) + v.cross(linear);
    let joints = chain
        .links
        .iter()
        .map(|link| energy.partial(link.rate).time_derivative() - link.coordinate.partial(energy));
    let hub = [force, torque_b].map(Vector::components).concat();
    let equations = hub.into_iter().chain(joints).collect();

    let rates = chain.links.iter().map(|link| link.rate);
    let speeds: Vec<_> = [v, omega].into_iter().flat_map(Vector::components).chain(rates).collect();
    let row = |(x, speed): (usize, &Expr<'g>)| {
        let slope = energy.partial(*speed);
        speeds[x..].iter().map(|other| slope.partial(*other)).collect()
    };
    let mass = speeds.iter().enumerate().map(row).collect();
    BoltzmannHamel { energy, linear, angular, mass, equations }
}

/// `T = 1/2 sum (m r_dot . r_dot + sum_ab S_ab e_a_dot . e_b_dot)` over the bodies with axes `e_a`,
/// where `S = tr(I)/2 1 - I` is the second moment of mass about the centre of mass.
fn energy<'g>(chain: &Chain<'g>) -> Expr<'g> {
    let half = chain.graph.constant(2).recip();
    let (v, omega) = (chain.hub.r_b_n_dot, chain.hub.omega);
    let of_body = |(body, link): (BodyInHub<'g>, &crate::derivation::chain::Link<'g>)| {
        let r_dot = v + body.r.prime(omega);
        let axes_dot = body.axes.map(|axis| axis.prime(omega));
        let half_trace = half * link.inertia.trace();
        let mut sum = link.mass * r_dot.dot(r_dot);
        for (a, e_a_dot) in axes_dot.into_iter().enumerate() {
            for (b, e_b_dot) in axes_dot.into_iter().enumerate() {
                let trace = if a == b { half_trace } else { chain.graph.zero() };
                sum = sum + (trace - link.inertia.at(a, b)) * e_a_dot.dot(e_b_dot);
            }
        }
        half * sum
    };
    let parts = bodies(chain).into_iter().zip(&chain.links).map(of_body);
    parts.fold(chain.graph.zero(), |sum, part| sum + part)
}
