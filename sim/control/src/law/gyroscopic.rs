//! [`Gyroscopic`]: what a law adds for the gyroscopic torque.

use nalgebra::Vector3;

use crate::model::motion::Tracking;

/// What a law adds for the gyroscopic torque `-omega_bn x H`, H being the angular momentum of spacecraft and devices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gyroscopic {
    /// The whole: `omega_bn x H`. What is left of Euler's equation is linear in `omega_br`.
    #[default]
    Whole,
    /// `(omega_rn - K_I z) x H`: as stable, and without a term quadratic in the rate of B where R rests and `K_I` is zero.
    Reference,
    /// Nothing: `V'` then has a term more, but for a reference at rest and `K_I` zero.
    Nothing,
}

impl Gyroscopic {
    /// The torque, N m; `turned` is `K_I z`, rad/s.
    pub(crate) fn compensation(
        self,
        error: &Tracking,
        turned: &Vector3<f64>,
        momentum: &Vector3<f64>,
    ) -> Vector3<f64> {
        match self {
            Self::Whole => error.omega_bn.cross(momentum),
            Self::Reference => (error.omega_rn - turned).cross(momentum),
            Self::Nothing => Vector3::zeros(),
        }
    }
}
