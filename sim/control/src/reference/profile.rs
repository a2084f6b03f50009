//! [`Profile`]: the fastest turn from rest to rest about a fixed axis within limits on rate, acceleration and jerk.
//!
//! Seven segments, as of Biagiotti, Melchiorri, *Trajectory Planning for Automatic Machines and Robots*, 3.4 (double S,
//! no speed at its ends): jerk up, constant acceleration, jerk down, constant rate, and the first three mirrored in time.
//! Segments of length zero are left out where a limit is not reached.

use crate::model::error::{self, ControlError};

/// Limits on a turn; infinite where there is none. One of acceleration and jerk at least is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnLimits {
    /// Largest rate, rad/s.
    pub rate: f64,
    /// Largest acceleration, rad/s².
    pub acceleration: f64,
    /// Largest jerk, rad/s³.
    pub jerk: f64,
}

/// Angle, rate and acceleration at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// Angle from the start, rad.
    pub angle: f64,
    /// Its rate, rad/s.
    pub rate: f64,
    /// Its acceleration, rad/s².
    pub acceleration: f64,
}

/// The turn, from time zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    angle: f64,
    /// Length of each of the four segments with jerk, s.
    jerk_time: f64,
    /// Length of each of the two segments of constant acceleration, s.
    constant_time: f64,
    /// Length of the segment of constant rate, s.
    cruise_time: f64,
    acceleration: f64,
}

impl Profile {
    /// By an angle, rad, that is not negative.
    ///
    /// # Errors
    ///
    /// An angle that is negative or not finite, a limit that is not positive, or both of acceleration and jerk infinite.
    pub fn new(angle: f64, limits: &TurnLimits) -> Result<Self, ControlError> {
        error::not_negative("angle", angle)?;
        let TurnLimits { rate, acceleration, jerk } = *limits;
        error::limit("rate limit", rate)?;
        error::limit("acceleration limit", acceleration)?;
        error::limit("jerk limit", jerk)?;
        if acceleration.is_infinite() {
            error::positive("jerk limit without acceleration limit", jerk)?;
        }
        // Up to the rate limit: with a segment of constant acceleration, or without.
        let with_constant = acceleration.is_finite() && rate * jerk >= acceleration * acceleration;
        let jerk_time = if with_constant { acceleration / jerk } else { libm::sqrt(rate / jerk) };
        let constant_time = if with_constant { rate / acceleration - jerk_time } else { 0.0 };
        let up = 2.0 * jerk_time + constant_time;
        let (jerk_time, constant_time, cruise_time) = if angle >= rate * up {
            (jerk_time, constant_time, angle / rate - up)
        } else if with_constant && angle >= 2.0 * acceleration * jerk_time * jerk_time {
            // angle = a (t_j + t_a) (2 t_j + t_a).
            let root = libm::sqrt(jerk_time * jerk_time + 4.0 * angle / acceleration);
            (jerk_time, (0.5 * (root - 3.0 * jerk_time)).max(0.0), 0.0)
        } else {
            // angle = 2 j t_j³.
            (libm::cbrt(angle / (2.0 * jerk)), 0.0, 0.0)
        };
        let acceleration = if jerk.is_finite() { jerk * jerk_time } else { acceleration };
        Ok(Self { angle, jerk_time, constant_time, cruise_time, acceleration })
    }

    /// Angle of the turn, rad.
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// How long it takes, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        2.0 * self.up() + self.cruise_time
    }

    /// Time until the largest rate, s.
    fn up(&self) -> f64 {
        2.0 * self.jerk_time + self.constant_time
    }

    /// At a time from its start, s: at rest before and after.
    #[must_use]
    pub fn at(&self, time: f64) -> ProfilePoint {
        let duration = self.duration();
        if time <= 0.0 {
            return ProfilePoint { angle: 0.0, rate: 0.0, acceleration: 0.0 };
        }
        if time >= duration {
            return ProfilePoint { angle: self.angle, rate: 0.0, acceleration: 0.0 };
        }
        if time > 0.5 * duration {
            let mirrored = self.first_half(duration - time);
            return ProfilePoint {
                angle: self.angle - mirrored.angle,
                acceleration: -mirrored.acceleration,
                ..mirrored
            };
        }
        self.first_half(time)
    }

    fn first_half(&self, time: f64) -> ProfilePoint {
        let (jerk_time, largest) = (self.jerk_time, self.acceleration);
        let peak = largest * (jerk_time + self.constant_time);
        let up = self.up();
        if time < jerk_time {
            let jerk = largest / jerk_time;
            return ProfilePoint {
                angle: jerk * time * time * time / 6.0,
                rate: jerk * time * time / 2.0,
                acceleration: jerk * time,
            };
        }
        if time < jerk_time + self.constant_time {
            let constant = time - jerk_time;
            return ProfilePoint {
                angle: largest
                    * (jerk_time * jerk_time / 6.0 + (jerk_time + constant) * constant / 2.0),
                rate: largest * (jerk_time / 2.0 + constant),
                acceleration: largest,
            };
        }
        if time < up {
            let (jerk, left) = (largest / jerk_time, up - time);
            return ProfilePoint {
                angle: peak * (up / 2.0 - left) + jerk * left * left * left / 6.0,
                rate: peak - jerk * left * left / 2.0,
                acceleration: jerk * left,
            };
        }
        let angle = 0.5 * self.angle + peak * (time - 0.5 * self.duration());
        ProfilePoint { angle, rate: peak, acceleration: 0.0 }
    }
}
