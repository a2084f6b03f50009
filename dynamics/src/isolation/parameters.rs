//! [`Platform`]: the rigid body of an isolator, on three slides and three turns.

use nalgebra::{Matrix3, Vector3};

use crate::isolation::records::PerJoint;
use crate::model::passive::Passive;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::vector;

/// A rigid platform with six freedoms relative to its base, which is the hub or another platform.
///
/// Its joints from the base outwards: slides along the mount's x, y and z axes, then turns about
/// x, about the turned y, about the platform's z. Springs and dampers of single joints are in
/// `passive`; those that couple joints, and struts, are the
/// [`Suspension`](crate::Suspension) of an [`Isolated`](crate::Isolated) set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Platform<T = f64> {
    /// Columns: the axes of the mount, those of the platform at zero, expressed in *B* (of a
    /// platform on a platform: in the axes of the one that carries it).
    pub mount: Matrix3<T>,
    /// `r_{P/B}`, origin P of the platform with every coordinate zero from B, expressed in *B*, m.
    pub r_p_b: Vector3<T>,
    /// `m_P`, mass of the platform without what it carries, kg. Above zero.
    pub m_p: T,
    /// `r_{Pc/P}`, centre of mass from P, expressed in the platform's axes, m.
    pub r_pc_p: Vector3<T>,
    /// `[I_{P,Pc}]`, inertia about its centre of mass, platform axes, kg m².
    pub i_p_pc: Matrix3<T>,
    /// Spring, damper and friction of each joint; `PerJoint::all(Passive::none())` for none.
    pub passive: PerJoint<Passive<T>>,
}

impl<T: Scalar> Platform<T> {
    /// A bare platform at point B of the base: nothing offset, the mount's axes those of B, no
    /// springs.
    ///
    /// Meant as a start for struct update syntax.
    #[must_use]
    pub fn bare(m_p: T, i_p_pc: Matrix3<T>) -> Self {
        Self {
            mount: crate::model::kind::unit(),
            r_p_b: vector([zero(); 3]),
            m_p,
            r_pc_p: vector([zero(); 3]),
            i_p_pc,
            passive: PerJoint::all(Passive::none()),
        }
    }
}
