//! [`LineTracker`]: the once-per-revolution line of a rotor in a measured signal, against the rotor's angle.

use precess_dynamics::Angle;

use crate::error::{self, TrackerError};
use crate::recursion::{Estimated, Recursion};

/// Follows mean, amplitude and phase of `y = mean + gain C cos(theta + phase)` by recursive least squares with exponential
/// forgetting.
///
/// theta is the angle of the rotor, rad; y any signal: a component of the body rate, an acceleration, a force. `gain` is what
/// the line would be by itself at C = 1, at the rotor's present rate: with Omega² for a force or an acceleration, or Omega for
/// a body rate, C does not change with the speed and is proportional to the imbalance. Lines that the sampling folds are
/// followed as others are, since the angle itself is what counts; not those at multiples of half the sampling rate, where the
/// mean or one phase takes their place. Another rotor's line counts as noise unless it is nearer in frequency than `1 / (memory
/// T)`, T the sampling period.
///
/// ```
/// use precess_tracker::LineTracker;
///
/// let mut tracker = LineTracker::new(200.0)?;
/// for k in 0..1000 {
///     let angle = 2.1 * f64::from(k);
///     tracker.update(angle, 1.0, 0.3 + 2e-3 * (angle + 0.7).cos())?;
/// }
/// let line = tracker.estimate();
/// assert!(line.is_some_and(|line| (line.amplitude - 2e-3).abs() < 1e-12));
/// assert!(line.is_some_and(|line| (line.phase - 0.7).abs() < 1e-9));
/// # Ok::<(), precess_tracker::TrackerError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct LineTracker {
    recursion: Recursion<3>,
}

/// What the last samples say of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineEstimate {
    /// Mean of the signal, in its unit.
    pub mean: f64,
    /// C: amplitude of the line by the gain; not negative.
    pub amplitude: f64,
    /// Phase, rad, from -pi to pi.
    pub phase: f64,
    /// `C cos(phase)` and `-C sin(phase)`: the parts in cos(theta) and sin(theta), normally distributed about the truth.
    pub parts: [f64; 2],
    /// Variances of the two parts and, last, their covariance; of white noise.
    pub covariance: [f64; 3],
    /// Standard deviation of the noise, in the unit of the signal.
    pub noise: f64,
}

impl LineTracker {
    /// With a memory of so many samples: weights fall by a factor of e in that time. The variance of a part is
    /// `2 / (2 memory - 1)` of the noise's, at a gain of one. Changes of the line are followed as slowly as that.
    ///
    /// # Errors
    ///
    /// A memory that is not from 8 to 1e9.
    pub fn new(memory: f64) -> Result<Self, TrackerError> {
        Ok(Self { recursion: Recursion::new(memory)? })
    }

    /// Takes a sample: angle of the rotor, rad, gain and signal.
    ///
    /// # Errors
    ///
    /// A number that is not finite; the tracker stays as it was.
    pub fn update(&mut self, angle: f64, gain: f64, signal: f64) -> Result<(), TrackerError> {
        error::finite("angle of the rotor", angle)?;
        error::finite("gain of the line", gain)?;
        error::finite("signal", signal)?;
        let (sine, cosine) = Angle::sin_cos(angle);
        self.recursion.update(&[1.0, gain * cosine, gain * sine], signal);
        Ok(())
    }

    /// The line; none while the samples do not determine it: there are fewer than four, or the rotor stands.
    #[must_use]
    pub fn estimate(&self) -> Option<LineEstimate> {
        let Estimated { parameters, covariance, noise } = self.recursion.estimate()?;
        let [mean, cosine, sine] = parameters;
        let [_, [_, of_cosine, _], [_, both, of_sine]] = covariance;
        Some(LineEstimate {
            mean,
            amplitude: libm::hypot(cosine, sine),
            phase: libm::atan2(-sine, cosine),
            parts: [cosine, sine],
            covariance: [of_cosine, of_sine, both],
            noise: libm::sqrt(noise),
        })
    }
}
