//! [`QuaternionFeedback`]: feedback of the vector part of the error quaternion and of the rate, with feed-forward.
//!
//! Wie, Weiss, Arapostathis, *Quaternion Feedback Regulator for Spacecraft Eigenaxis Rotations*, J. Guid. Control Dyn. 12(3),
//! 1989:
//!
//! ```text
//! u = -K q - D omega_br + I (omega_rn' - omega_bn x omega_rn) - L + alpha x H      H = I omega_bn + h
//! V = omega_br . K^-1 I omega_br / 2 + 2 (1 - q0)      V' = -omega_br . K^-1 D omega_br
//! ```
//!
//! `V` for `K^-1 I` symmetric and positive definite, as of `K = k I` or a multiple of the identity, and with the whole
//! gyroscopic torque compensated. `q` is the vector part of the quaternion of B relative to R, whose scalar part
//! `q0 = cos(phi / 2)` comes first (there last) and is not negative: of an attitude's two quaternions, which command
//! torques of opposite sign, the one that turns by the shorter way, as `sign(q0) q` does. At exactly half a turn that is the
//! quaternion as computed.

use nalgebra::{Matrix3, Vector3};

use crate::law::gyroscopic::Gyroscopic;
use crate::law::{Law, Sample};
use crate::model::error::{self, ControlError};
use crate::model::motion::Tracking;

/// The law, which keeps nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuaternionFeedback {
    attitude: Matrix3<f64>,
    rate: Matrix3<f64>,
    inertia: Matrix3<f64>,
    gyroscopic: Gyroscopic,
}

impl QuaternionFeedback {
    /// With `K`, N m, and `D`, N m s, and the inertia about the centre of mass that a commanded torque accelerates, expressed
    /// in B, kg m² (as of [`MrpFeedback::new`](crate::MrpFeedback::new)).
    ///
    /// # Errors
    ///
    /// A number that is not finite, or an inertia that is not symmetric and positive semidefinite. Whether the loop is
    /// stable is not examined: that depends on `K^-1 I` and `K^-1 D`.
    pub fn new(
        attitude: Matrix3<f64>,
        rate: Matrix3<f64>,
        inertia: Matrix3<f64>,
        gyroscopic: Gyroscopic,
    ) -> Result<Self, ControlError> {
        for (what, gain) in [("attitude gain", &attitude), ("rate gain", &rate)] {
            for value in gain.iter() {
                error::finite(what, *value)?;
            }
        }
        error::semidefinite("inertia", &inertia)?;
        Ok(Self { attitude, rate, inertia, gyroscopic })
    }

    /// The law that turns about the eigen-axis of the error: `K = k I`, `D = d I`, the whole gyroscopic torque compensated.
    ///
    /// From relative rest the angle of the error obeys `phi'' + d phi' + k sin(phi / 2) = 0` and its axis keeps its
    /// direction. `k` in 1/s², `d` in 1/s: small errors have the frequency `sqrt(k / 2)` and the damping ratio
    /// `d / sqrt(2 k)`.
    ///
    /// # Errors
    ///
    /// A gain that is not positive, or an inertia that is not symmetric and positive definite.
    pub fn eigen_axis(k: f64, d: f64, inertia: Matrix3<f64>) -> Result<Self, ControlError> {
        error::positive("attitude gain", k)?;
        error::positive("rate gain", d)?;
        error::definite("inertia", &inertia)?;
        Self::new(inertia * k, inertia * d, inertia, Gyroscopic::Whole)
    }
}

impl Law for QuaternionFeedback {
    fn torque(&mut self, sample: &Sample) -> Vector3<f64> {
        let error = Tracking::new(&sample.motion, &sample.reference);
        let momentum = self.inertia * error.omega_bn + sample.momentum;
        let part = Vector3::new(error.attitude.q1, error.attitude.q2, error.attitude.q3);
        self.inertia * error.feed_forward()
            + self.gyroscopic.compensation(&error, &Vector3::zeros(), &momentum)
            - self.attitude * part
            - self.rate * error.omega_br
            - sample.external
    }

    fn reset(&mut self) {}
}
