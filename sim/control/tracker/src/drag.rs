//! [`DragTracker`]: the drag torque of a rotor by its expected one, from tachometer and motor torque.

use crate::error::{self, TrackerError};
use crate::recursion::{Estimated, Recursion};

/// Follows the coefficient c of `J s' = u - c d` by recursive least squares with exponential forgetting.
///
/// s is the rotor's rate about its spin axis relative to inertial space (the tachometer's reading and the body rate's component
/// along the axis), J its moment of inertia about that axis, u the motor's torque and d the drag that is expected at the
/// present speed, positive where it brakes a positive rate: with a bearing as it should be, c is 1. With d = 1 c is the drag
/// torque itself, N m. What is fitted is the momentum `J s`, so that white noise of the tachometer is white noise of the fit;
/// differences of readings are not taken. What turns the rotor otherwise, across its spin axis, is not in the balance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct DragTracker {
    inertia: f64,
    recursion: Recursion<2>,
}

/// A sample of a rotor, and what has acted since the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DragSample {
    /// Time since the sample before, s; of the first one it does not count.
    pub elapsed: f64,
    /// Mean torque of the motor since then, N m.
    pub torque: f64,
    /// Mean drag that is expected since then, N m: with the sign of the rate.
    pub drag: f64,
    /// Rate of the rotor about its spin axis relative to inertial space, rad/s.
    pub rate: f64,
}

/// What the last samples say of a drag torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DragEstimate {
    /// c: the drag by the expected one.
    pub coefficient: f64,
    /// Its variance; of white noise.
    pub variance: f64,
    /// Rate of the rotor, filtered, rad/s.
    pub rate: f64,
    /// Standard deviation of the noise of the rate, rad/s.
    pub noise: f64,
}

impl DragTracker {
    /// Of a rotor's moment of inertia about its spin axis, kg m², with a memory of so many samples: weights fall by a factor of
    /// e in that time. With `w = 1 - 1 / memory` the variance of c is `2 (1 - w)^3 / (1 + w)^3` of that of the noise by the
    /// square of `d T / J`, T the sampling period.
    ///
    /// # Errors
    ///
    /// An inertia that is not positive, a memory that is not from 8 to 1e9.
    pub fn new(inertia: f64, memory: f64) -> Result<Self, TrackerError> {
        error::within("inertia of the rotor", inertia, (f64::MIN_POSITIVE, f64::MAX))?;
        Ok(Self { inertia, recursion: Recursion::new(memory)? })
    }

    /// Takes a sample.
    ///
    /// # Errors
    ///
    /// A number that is not finite, a negative time; the tracker stays as it was.
    pub fn update(&mut self, sample: &DragSample) -> Result<(), TrackerError> {
        let DragSample { elapsed, torque, drag, rate } = *sample;
        error::within("time since the sample before", elapsed, (0.0, f64::MAX))?;
        error::finite("torque of the motor", torque)?;
        error::finite("expected drag", drag)?;
        error::finite("rate of the rotor", rate)?;
        let by = elapsed / self.inertia;
        self.recursion.advance(torque * by, drag * by);
        self.recursion.update(&[1.0, 0.0], rate);
        Ok(())
    }

    /// The drag; none while the samples do not determine it: there are fewer than three, or none is expected.
    #[must_use]
    pub fn estimate(&self) -> Option<DragEstimate> {
        let Estimated { parameters, covariance, noise } = self.recursion.estimate()?;
        let [rate, coefficient] = parameters;
        let [_, [_, variance]] = covariance;
        Some(DragEstimate { coefficient, variance, rate, noise: libm::sqrt(noise) })
    }
}
