//! Device kinds as data: a chain of joints and bodies, ordered from the hub to the tip.
//!
//! A kind says what turns about what, where the next origin lies and what its quantities are
//! called; the equations come from the one derivation that walks any such list.

mod dgvscmg;

pub use dgvscmg::DGVSCMG;

use crate::space::Axis;

/// Every kind that is emitted.
pub const KINDS: [&Kind; 1] = [&DGVSCMG];

/// A device: joints and bodies from the hub outwards.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Module and file name.
    pub name: &'static str,
    /// What it is, in words.
    pub title: &'static str,
    /// Source file, as the header of the emitted file cites it.
    pub source: &'static str,
    /// The chain.
    pub links: &'static [Link],
}

/// A joint and the body behind it.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The joint.
    pub joint: Joint,
    /// The body.
    pub body: Body,
    /// This body and all behind it, as the paper calls them: D, V, W.
    pub assembly: &'static str,
}

/// A turning joint.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// Index letter of its quantities: `f_o`, `u_o`.
    pub tag: &'static str,
    /// The axis of the carrying frame about which it turns.
    pub axis: Axis,
    /// The angle.
    pub angle: &'static str,
    /// The angle as the paper writes it.
    pub angle_symbol: &'static str,
    /// Its rate.
    pub rate: &'static str,
    /// Its acceleration: the second-order state.
    pub acceleration: &'static str,
    /// Rate and acceleration as the paper writes them.
    pub symbols: [&'static str; 2],
    /// The motor torque on the body, against the carrier.
    pub torque: &'static str,
    /// Where the joint's origin lies from the carrier's, in carrier axes.
    pub origin: Triple,
}

/// Three components with the vector's symbol.
#[derive(Clone, Copy, Debug)]
pub struct Triple {
    /// As the paper writes it.
    pub symbol: &'static str,
    /// In code.
    pub name: &'static str,
    /// Component names.
    pub names: [&'static str; 3],
}

/// A rigid body.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// What it is, in words.
    pub title: &'static str,
    /// Its frame: axes `gox goy goz`, angular velocity `omega_go_n`.
    pub frame: &'static str,
    /// Its origin, as a point: `r_goc_go`.
    pub origin: &'static str,
    /// The paper's names of its axes.
    pub triad: [&'static str; 3],
    /// Its centre of mass, as a point: `r_goc_b`.
    pub point: &'static str,
    /// Its mass.
    pub mass: &'static str,
    /// Where its centre of mass lies from its origin, in its own axes.
    pub centre: Centre,
    /// Stem of its inertia about its own centre of mass, in its own axes: `i_go_11`.
    pub inertia: &'static str,
    /// The paper's letters for body and point, `Gᵒ` and `Gᵒ_c`.
    pub letters: [&'static str; 2],
    /// Where the paper states its quantities.
    pub equations: Equations,
}

/// The pattern of a centre of mass.
#[derive(Clone, Copy, Debug)]
pub enum Centre {
    /// Anywhere.
    Free(Triple),
    /// On one axis of the body, at this distance.
    On(Axis, &'static str),
}

/// Equation numbers of a body's quantities.
#[derive(Clone, Copy, Debug)]
pub struct Equations {
    /// Angular velocity.
    pub omega: &'static str,
    /// Second derivative of the centre of mass, seen from B.
    pub r_dprime: &'static str,
    /// Derivative of the inertia about the body's own centre of mass.
    pub i_prime: &'static str,
    /// Inertia about B.
    pub i_b: &'static str,
    /// Its derivative.
    pub i_b_prime: &'static str,
    /// Motor torque across the joint that carries the body.
    pub torque: &'static str,
    /// Inertial second derivative of the centre of mass from B.
    pub r_ddot: &'static str,
    /// Angular momentum about B.
    pub h: &'static str,
    /// Its inertial derivative.
    pub h_dot: &'static str,
    /// Mass and first moment of this body and all behind it; for the tip, the body itself.
    pub assembly: &'static str,
    /// Torque on them about the joint's origin.
    pub about_origin: &'static str,
}
