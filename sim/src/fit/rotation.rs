//! [`Rotation`]: the angle of the wheel over one record, a polynomial of second degree about its middle.
//!
//! ```text
//! theta(t) = angle + speed t + drift t² / 2        t = 0 at the middle of the record
//! ```
//!
//! With an index pulse the polynomial is that of least squares through whole turns at the pulses, and
//! phases count from the index. Without, the angle is zero at the middle and phases have no meaning
//! between records. Speed and drift are corrected by the lines themselves (`orders`), within what the
//! scatter of the pulses, or the stated accuracy of the speed, leaves open.

use std::f64::consts::TAU;

use nalgebra::{Complex, Matrix3, Vector3};

use super::error::FitError;
use super::measurement::Record;
use super::phase::wrapped;

/// Pulses at least, for three coefficients.
const PULSES_MIN: usize = 4;
/// A pulse is this near to a whole turn of the polynomial, turns.
const TURN_MAX: f64 = 0.05;
/// Samples between two exact values of the recurrence, which loses some bits for each.
const EXACT_EVERY: usize = 256;

/// The angle of the wheel over a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// At the middle, rad.
    pub angle: f64,
    /// At the middle, rad/s.
    pub speed: f64,
    /// Rate of change of the speed, rad/s².
    pub drift: f64,
    /// Whether the angle counts from index pulses.
    pub indexed: bool,
    /// Standard deviation of the speed by the scatter of the pulses, rad/s; 0 without.
    pub speed_deviation: f64,
    /// And of the drift, rad/s².
    pub drift_deviation: f64,
}

impl Rotation {
    /// By a speed, rad/s, and its rate of change, rad/s², without an index.
    #[must_use]
    pub const fn stated(speed: f64, drift: f64) -> Self {
        Self {
            angle: 0.0,
            speed,
            drift,
            indexed: false,
            speed_deviation: 0.0,
            drift_deviation: 0.0,
        }
    }

    /// Of a record: through its pulses, or by its speed.
    ///
    /// # Errors
    /// [`FitError::Pulses`] where there are too few, or one is far from a whole turn.
    pub fn from_record(record: &Record) -> Result<Self, FitError> {
        let stated = Self::stated(record.speed, record.drift);
        if record.pulses.is_empty() {
            return Ok(stated);
        }
        let error = |missed: f64| FitError::Pulses {
            record: record.name.clone(),
            found: record.pulses.len(),
            missed,
            bound: TURN_MAX,
        };
        if record.pulses.len() < PULSES_MIN {
            return Err(error(f64::NAN));
        }
        let middle = -time(0, record.length(), record.rate);
        let sense = record.speed.signum();
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        let (mut turns, mut last) = (0.0, None::<f64>);
        let mut points = Vec::with_capacity(record.pulses.len());
        for pulse in &record.pulses {
            if let Some(last) = last {
                turns += ((pulse - last) * record.speed.abs() / TAU).round();
            }
            last = Some(*pulse);
            let t = (pulse - middle) / middle;
            points.push((t, sense * TAU * turns));
            let row = Vector3::new(1.0, t, t * t);
            normal += row * row.transpose();
            right += row * (sense * TAU * turns);
        }
        let inverse = normal.cholesky().ok_or(error(f64::NAN))?.inverse();
        let coefficients = inverse * right;
        let of = |t: f64| coefficients.x + t * (coefficients.y + t * coefficients.z);
        let missed =
            points.iter().map(|(t, angle)| (of(*t) - angle).abs() / TAU).fold(0.0, f64::max);
        let follows = missed <= TURN_MAX;
        if !follows {
            return Err(error(missed));
        }
        let squares: f64 = points.iter().map(|(t, angle)| (of(*t) - angle).powi(2)).sum();
        #[expect(clippy::cast_precision_loss, reason = "at most the samples of a record")]
        let freedom = (points.len() - 3) as f64;
        let spread = (squares / freedom).sqrt();
        Ok(Self {
            // Within half a turn, so that an error of a harmonic number turns no phase.
            angle: wrapped(coefficients.x),
            speed: coefficients.y / middle,
            drift: 2.0 * coefficients.z / (middle * middle),
            indexed: true,
            speed_deviation: spread * inverse[(1, 1)].sqrt() / middle,
            drift_deviation: 2.0 * spread * inverse[(2, 2)].sqrt() / (middle * middle),
        })
    }

    /// The phase `exp(i h theta)` at each sample; `rate` in 1/s.
    #[must_use]
    pub fn phases(&self, order: f64, length: usize, rate: f64) -> Vec<Complex<f64>> {
        phases([order * self.angle, order * self.speed, order * self.drift], length, rate)
    }
}

/// `exp(i (angle + speed t + drift t² / 2))` at each sample about the middle, by a recurrence that is made
/// exact every [`EXACT_EVERY`] samples.
#[must_use]
pub(super) fn phases(
    [angle, speed, drift]: [f64; 3],
    length: usize,
    rate: f64,
) -> Vec<Complex<f64>> {
    let exact = |phase: f64| {
        let (sine, cosine) = precess_dynamics::Angle::sin_cos(phase);
        Complex::new(cosine, sine)
    };
    let step = 1.0 / rate;
    let curve = exact(drift * step * step);
    let mut out = Vec::with_capacity(length);
    for start in (0..length).step_by(EXACT_EVERY) {
        let t = time(start, length, rate);
        let mut value = exact(angle + t * (speed + 0.5 * drift * t));
        let mut turn = exact(step * (speed + drift * (t + 0.5 * step)));
        for _ in start..length.min(start + EXACT_EVERY) {
            out.push(value);
            value *= turn;
            turn *= curve;
        }
    }
    out
}

/// The time of a sample from the middle of its record, s.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "at most SAMPLES_MAX")]
pub(super) fn time(index: usize, length: usize, rate: f64) -> f64 {
    (index as f64 - 0.5 * (length as f64 - 1.0)) / rate
}
