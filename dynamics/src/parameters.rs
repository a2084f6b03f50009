//! What a spacecraft is made of: the rigid hub and its devices, as a user states them.
//!
//! Plain data in SI units. [`Spacecraft::new`](crate::Spacecraft::new) checks it and turns it into
//! constants once; parameters never change during a run. The frames: `Go = mount Rz(gamma_o)`,
//! `Gi = Go Ry(gamma_i)`, `W = Gi Rx(theta)`, columns being the new axes in the old frame.

use nalgebra::{Matrix3, Vector3};

use crate::real::{Scalar, zero};
use crate::vec3::{vector, zeros};

/// The rigid hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hub<T = f64> {
    /// `m_B`, mass without the devices, kg; above zero.
    pub m_b: T,
    /// `r_{Bc/B}`, centre of mass from the reference point B, B axes, m.
    pub r_bc_b: Vector3<T>,
    /// `[I_{hub,Bc}]`, inertia about the hub's centre of mass, B axes, kg m^2.
    pub i_b_bc: Matrix3<T>,
}

/// An imbalanced double-gimbal variable-speed control moment gyro.
///
/// Products of inertia stand in the tensors with the sign they have there (`J_13` is the element).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dgvscmg<T = f64> {
    /// Columns: the outer gimbal's axes at zero angle, along B axes. The outer gimbal turns about
    /// the third, the inner one about the second at zero angle, the wheel about the first.
    pub mount: Matrix3<T>,
    /// `r_{Go/B}`, origin of the outer gimbal from B, *B axes*, m.
    pub r_go_b: Vector3<T>,
    /// `m_{Go}`, mass of the outer gimbal, kg; zero is legal.
    pub m_go: T,
    /// `r_{Goc/Go}`, centre of mass of the outer gimbal from its origin, Go axes, m.
    pub r_goc_go: Vector3<T>,
    /// `[I_{Go,Goc}]`, inertia of the outer gimbal about its centre of mass, Go axes, kg m^2.
    pub i_go_goc: Matrix3<T>,
    /// `L^o`, origin of the inner gimbal from the origin of the outer one, Go axes, m.
    pub l_o: Vector3<T>,
    /// `m_{Gi}`, mass of the inner gimbal, kg; zero is legal.
    pub m_gi: T,
    /// `r_{Gic/Gi}`, centre of mass of the inner gimbal from its origin, Gi axes, m.
    pub r_gic_gi: Vector3<T>,
    /// `[I_{Gi,Gic}]`, inertia of the inner gimbal about its centre of mass, Gi axes, kg m^2.
    pub i_gi_gic: Matrix3<T>,
    /// `L^i`, the wheel's origin W from the origin of the inner gimbal, Gi axes, m.
    pub l_i: Vector3<T>,
    /// `m_W`, mass of the wheel, kg; above zero.
    pub m_w: T,
    /// `d`, static imbalance: the wheel's centre of mass is at `d w_y` from W, m. From a data
    /// sheet: [`Self::with_imbalance`].
    pub d: T,
    /// `[I_{W,Wc}]`, inertia of the wheel about its centre of mass, W axes, kg m^2. The dynamic
    /// imbalance is `J_13` (and `J_12`).
    pub i_w_wc: Matrix3<T>,
}

impl<T: Scalar> Dgvscmg<T> {
    /// A bare balanced wheel at the hub's point B: massless gimbals, nothing offset, mount along B.
    ///
    /// Meant as a start for struct update syntax. Massless gimbals are legal, with one singular
    /// pose: `gamma_i` at 90 deg, where the outer gimbal would turn about the spin axis.
    #[must_use]
    pub fn bare_wheel(m_w: T, i_w_wc: Matrix3<T>) -> Self {
        let none =
            Matrix3::new(zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero());
        let one = T::from_f64(1.0);
        Self {
            mount: Matrix3::new(one, zero(), zero(), zero(), one, zero(), zero(), zero(), one),
            r_go_b: vector(zeros()),
            m_go: zero(),
            r_goc_go: vector(zeros()),
            i_go_goc: none,
            l_o: vector(zeros()),
            m_gi: zero(),
            r_gic_gi: vector(zeros()),
            i_gi_gic: none,
            l_i: vector(zeros()),
            m_w,
            d: zero(),
            i_w_wc,
        }
    }
}
