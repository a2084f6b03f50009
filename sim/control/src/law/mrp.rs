//! [`MrpFeedback`]: feedback of modified Rodrigues parameters, their integral, and the rate, with feed-forward.
//!
//! Schaub, Junkins, *Analytical Mechanics of Space Systems*, chapter 8, as Basilisk documents its module `mrpFeedback`:
//!
//! ```text
//! u = -K sigma - P omega_br - P K_I z + I (omega_rn' - omega_bn x omega_rn) - L + alpha x H
//! z = K int sigma dt + I omega_br      H = I omega_bn + h
//! V = omega_br . I omega_br / 2 + 2 K ln(1 + sigma . sigma) + z . K_I z / 2
//! V' = -(omega_br + K_I z) . P (omega_br + K_I z)
//! ```
//!
//! `alpha` is `omega_bn`, or `omega_rn - K_I z` ([`Gyroscopic::Reference`]). Basilisk prints and computes
//! `omega_rn + K_I z`; its proof has the minus, and with the plus `V'` has the term `2 omega_br . (K_I z x H)` more. Without
//! integral term both are the same.

use nalgebra::{Matrix3, Vector3};

use crate::law::gyroscopic::Gyroscopic;
use crate::law::{Law, Sample};
use crate::model::error::{self, ControlError};
use crate::model::motion::Tracking;

/// Gains of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MrpGains {
    /// `K`, N m.
    pub attitude: f64,
    /// `P`, N m s: positive definite.
    pub rate: Matrix3<f64>,
    /// `K_I`, 1/(kg m²): symmetric and not negative; zero for none.
    pub integral: Matrix3<f64>,
    /// The largest magnitude of each component of `K int sigma dt`, N m s.
    pub integral_limit: f64,
}

impl MrpGains {
    /// `K` in N m and `P` in N m s, the same about each axis, without integral.
    #[must_use]
    pub fn new(attitude: f64, rate: f64) -> Self {
        Self {
            attitude,
            rate: Matrix3::from_diagonal_element(rate),
            integral: Matrix3::zeros(),
            integral_limit: 0.0,
        }
    }
}

/// The law with its integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MrpFeedback {
    gains: MrpGains,
    inertia: Matrix3<f64>,
    gyroscopic: Gyroscopic,
    integral: Vector3<f64>,
}

impl MrpFeedback {
    /// With gains, and the inertia about the centre of mass that a commanded torque accelerates, expressed in B, kg m²:
    /// `I`. Of wheels, whose motors exert that torque, it is that of the spacecraft with locked wheels less the wheels' own
    /// about their axes, and [`Sample::momentum`] is then `h = sum J (spin + omega . s) s`.
    ///
    /// An inertia of zero leaves out all that is computed with it.
    ///
    /// # Errors
    ///
    /// A gain or an inertia that is not in its range.
    pub fn new(
        gains: MrpGains,
        inertia: Matrix3<f64>,
        gyroscopic: Gyroscopic,
    ) -> Result<Self, ControlError> {
        error::positive("attitude gain", gains.attitude)?;
        error::not_negative("limit of the integral", gains.integral_limit)?;
        error::definite("rate gain", &(gains.rate + gains.rate.transpose()))?;
        error::semidefinite("integral gain", &gains.integral)?;
        error::semidefinite("inertia", &inertia)?;
        Ok(Self { gains, inertia, gyroscopic, integral: Vector3::zeros() })
    }

    /// `K int sigma dt`, N m s.
    #[must_use]
    pub fn integral(&self) -> Vector3<f64> {
        self.integral
    }

    /// `z`, N m s: zero without integral gain.
    fn z(&self, error: &Tracking) -> Vector3<f64> {
        if self.gains.integral == Matrix3::zeros() {
            return Vector3::zeros();
        }
        self.integral + self.inertia * error.omega_br
    }

    /// The torque at the integral as it is, N m; nothing advances.
    #[must_use]
    pub fn torque_now(&self, sample: &Sample) -> Vector3<f64> {
        let error = Tracking::new(&sample.motion, &sample.reference);
        let turned = self.gains.integral * self.z(&error);
        let momentum = self.inertia * error.omega_bn + sample.momentum;
        self.inertia * error.feed_forward()
            + self.gyroscopic.compensation(&error, &turned, &momentum)
            - error.sigma() * self.gains.attitude
            - self.gains.rate * (error.omega_br + turned)
            - sample.external
    }
}

impl Law for MrpFeedback {
    /// The integral is the sum of `K sigma` at this sample and all before, each times the time since the one before it, as
    /// in Basilisk.
    fn torque(&mut self, sample: &Sample) -> Vector3<f64> {
        if !sample.limited {
            let limit = self.gains.integral_limit;
            let sigma = Tracking::new(&sample.motion, &sample.reference).sigma();
            let sum = self.integral + sigma * (self.gains.attitude * sample.elapsed);
            self.integral = sum.map(|part| part.clamp(-limit, limit));
        }
        self.torque_now(sample)
    }

    fn reset(&mut self) {
        self.integral = Vector3::zeros();
    }

    fn kept(&mut self) -> &mut [f64] {
        self.integral.as_mut_slice()
    }
}
