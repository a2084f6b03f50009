//! Parameters of the rigid hub. Those of the devices are with their kinds, under
//! [`generated`](crate::generated).
//!
//! Numbers in SI units. [`Spacecraft::new`](crate::Spacecraft::new) checks it and turns it into
//! constants once; parameters never change during a run.

use nalgebra::{Matrix3, Vector3};

/// The rigid hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hub<T = f64> {
    /// `m_B`, mass without the devices, kg; above zero.
    pub m_b: T,
    /// `r_{Bc/B}`, centre of mass from the reference point B, B axes, m.
    ///
    /// Choose B near it. The equations are about B, and digits are lost with the square of the
    /// distance over the radius of gyration: an error of 1e-11 is exceeded from 200 such radii on:
    /// from 4 m for a hub of some centimetres, from 200 m for one of some metres.
    pub r_bc_b: Vector3<T>,
    /// `[I_{hub,Bc}]`, inertia about the hub's centre of mass, B axes, kg m^2.
    pub i_b_bc: Matrix3<T>,
}

impl<T: Copy> Hub<T> {
    /// The hub with each of its numbers converted.
    #[must_use]
    pub fn map<U: nalgebra::Scalar>(&self, number: impl Fn(T) -> U + Copy) -> Hub<U>
    where
        T: nalgebra::Scalar,
    {
        Hub {
            m_b: number(self.m_b),
            r_bc_b: self.r_bc_b.map(number),
            i_b_bc: self.i_b_bc.map(number),
        }
    }
}
