//! [`law_feedback`]: a law for small errors about a reference at rest.
//!
//! With the rotation theta of B relative to the reference, rad, and `z_k` the integral with the present sample:
//!
//! ```text
//! MRP feedback      u = -K theta / 4 - P (omega + K_I z) + h x K_I z [reference] - h x omega [whole]
//!                   z_k = sum T K theta / 4 + I omega
//! quaternion        u = -K theta / 2 - D omega - h x omega [whole]
//! rate damping      u = -D omega
//! ```
//!
//! `h` is the momentum of the devices relative to the hub. Those in brackets are of the gyroscopic compensation.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_control::{Feedback, Gyroscopic};

use super::MarginsError;
use crate::scenario::{ControlLaw, SampledController, Scenario};

/// From attitude and angular velocity, six numbers, to the torque on the spacecraft.
///
/// # Errors
/// [`MarginsError::Program`].
pub fn law_feedback(
    scenario: &Scenario,
    of: &SampledController,
    momentum: &Vector3<f64>,
) -> Result<Feedback, MarginsError> {
    let own =
        |inertia: &Option<Matrix3<f64>>| inertia.unwrap_or_else(|| scenario.inertia_at_start());
    let h = momentum.cross_matrix();
    let whole = |gyroscopic: Gyroscopic| match gyroscopic {
        Gyroscopic::Whole => h,
        Gyroscopic::Reference | Gyroscopic::Nothing => Matrix3::zeros(),
    };
    Ok(match &of.law {
        ControlLaw::MrpFeedback { gains, inertia, gyroscopic } => {
            let attitude = Matrix3::from_diagonal_element(gains.attitude / 4.0);
            let turned = match gyroscopic {
                Gyroscopic::Reference => h * gains.integral,
                Gyroscopic::Whole | Gyroscopic::Nothing => Matrix3::zeros(),
            };
            let by_z = turned - gains.rate * gains.integral;
            let by_rate = by_z * own(inertia) - gains.rate - whole(*gyroscopic);
            let step = attitude / of.rate;
            if gains.integral == Matrix3::zeros() {
                return Ok(gain(-attitude, by_rate));
            }
            let Feedback { d, .. } = gain(by_z * step - attitude, by_rate);
            let mut b = DMatrix::zeros(3, 6);
            b.view_mut((0, 0), (3, 3)).copy_from(&step);
            let mut c = DMatrix::zeros(3, 3);
            c.copy_from(&by_z);
            Feedback { a: DMatrix::identity(3, 3), b, c, d }
        }
        ControlLaw::QuaternionFeedback { attitude, rate, gyroscopic, .. } => {
            gain(attitude * -0.5, -rate - whole(*gyroscopic))
        }
        ControlLaw::EigenAxis { frequency, damping_ratio, inertia } => {
            let omega = std::f64::consts::TAU * frequency;
            let inertia = own(inertia);
            gain(inertia * -(omega * omega), inertia * -(2.0 * damping_ratio * omega) - h)
        }
        ControlLaw::RateDamping { rate } => gain(Matrix3::zeros(), -rate),
        ControlLaw::Program { .. } => return Err(MarginsError::Program { name: of.name.clone() }),
    })
}

fn gain(attitude: Matrix3<f64>, rate: Matrix3<f64>) -> Feedback {
    let mut d = DMatrix::zeros(3, 6);
    d.view_mut((0, 0), (3, 3)).copy_from(&attitude);
    d.view_mut((0, 3), (3, 3)).copy_from(&rate);
    Feedback::gain(d)
}
