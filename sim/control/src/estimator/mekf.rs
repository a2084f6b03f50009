//! [`Mekf`]: the multiplicative extended Kalman filter for attitude and gyro bias.
//!
//! Markley, *Attitude Error Representations for Kalman Filtering*, J. Guid. Control Dyn. 26(2), 2003; Crassidis, Markley,
//! Cheng, *Survey of Nonlinear Attitude Estimation Methods*, J. Guid. Control Dyn. 30(1), 2007. The attitude is a quaternion
//! of unit length, its error a rotation vector about B axes: `true = estimated * exp(error)`. At a sample of the gyro the
//! filter turns by what it reads less the bias; at one of a star tracker the innovation is the rotation vector from the
//! estimated attitude to the measured one.
//!
//! After an update the covariance is not turned by the correction, as in these sources: to first order it need not be.
//!
//! A measured attitude may arrive some samples of the gyro later: the filter keeps these samples, updates at the time of the
//! measurement and turns by them anew. That is what it would have estimated, to the bit, had the measurement been there at once.

use alloc::collections::VecDeque;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::checkpoint::Checkpoint;
use crate::estimator::covariance::{Covariance, ProcessNoise};
use crate::model::error::{self, ControlError};
use crate::model::motion::Motion;
use crate::model::rotation::{from_vector, inverse, product, to_vector};

/// What the filter knows of its sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MekfParameters {
    /// Time from sample to sample of the gyro, s.
    pub period: f64,
    /// Angle random walk of the gyro, rad/sqrt(s).
    pub angle_random_walk: f64,
    /// Rate random walk of the gyro, rad/s^(3/2).
    pub rate_random_walk: f64,
    /// Covariance of the star tracker's noise, expressed in B, rad²: positive definite.
    pub measured: Matrix3<f64>,
    /// The latest that a measured attitude may arrive, in samples of the gyro.
    pub longest_latency: usize,
}

/// Attitude, bias and the covariance of their errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Attitude of B relative to N.
    pub attitude: Quaternion,
    /// Bias of the gyro, expressed in B, rad/s.
    pub bias: Vector3<f64>,
    /// Of the errors.
    pub covariance: Covariance,
}

/// The filter.
#[derive(Clone, Debug, PartialEq)]
pub struct Mekf {
    period: f64,
    noise: ProcessNoise,
    measured: Matrix3<f64>,
    longest: usize,
    /// Readings of the gyro since `past`, the oldest first.
    readings: VecDeque<Vector3<f64>>,
    past: Estimate,
    now: Estimate,
    /// The last reading of the gyro.
    reading: Option<Vector3<f64>>,
}

impl Mekf {
    /// The longest latency, in samples of the gyro.
    pub const LONGEST: usize = 100_000;

    /// From an estimate. Room for the gyro's samples is made here, and nowhere else.
    ///
    /// # Errors
    ///
    /// A parameter that is not in its range, a quaternion that is not an attitude, a covariance that is not symmetric and
    /// positive semidefinite in its diagonal blocks, or a latency above [`Self::LONGEST`].
    pub fn new(parameters: &MekfParameters, initial: &Estimate) -> Result<Self, ControlError> {
        let MekfParameters {
            period,
            angle_random_walk,
            rate_random_walk,
            measured,
            longest_latency,
        } = *parameters;
        error::positive("sampling period", period)?;
        error::not_negative("angle random walk", angle_random_walk)?;
        error::not_negative("rate random walk", rate_random_walk)?;
        error::definite("covariance of the measured attitude", &measured)?;
        error::semidefinite("covariance of the attitude", &initial.covariance.attitude)?;
        error::semidefinite("covariance of the bias", &initial.covariance.bias)?;
        for value in initial.bias.iter().chain(initial.covariance.cross.iter()) {
            error::finite("estimate at first", *value)?;
        }
        if longest_latency > Self::LONGEST {
            return Err(ControlError::TooOld { age: longest_latency, kept: Self::LONGEST });
        }
        let attitude = error::attitude("attitude at first", &initial.attitude)?;
        let initial = Estimate { attitude, ..*initial };
        Ok(Self {
            period,
            noise: ProcessNoise::new(period, angle_random_walk, rate_random_walk),
            measured,
            longest: longest_latency,
            readings: VecDeque::with_capacity(longest_latency + 1),
            past: initial,
            now: initial,
            reading: None,
        })
    }

    /// The estimate at the last sample of the gyro.
    #[must_use]
    pub fn estimate(&self) -> &Estimate {
        &self.now
    }

    /// Estimated attitude, and the last reading of the gyro less the bias; a rate of zero before the first reading.
    #[must_use]
    pub fn motion(&self) -> Motion {
        let omega = self.reading.map_or_else(Vector3::zeros, |reading| reading - self.now.bias);
        Motion { attitude: self.now.attitude, omega }
    }

    /// Takes a sample of the gyro, expressed in B, rad/s: the filter is then at its time.
    ///
    /// Of an integrating gyro it is the mean rate since the sample before, as the equations have it; a sampled gyro's reading
    /// is taken for that.
    pub fn propagate(&mut self, reading: &Vector3<f64>) {
        self.reading = Some(*reading);
        self.now = self.propagated(&self.now, reading);
        self.readings.push_back(*reading);
        if self.readings.len() > self.longest {
            self.forward();
        }
    }

    /// Takes an attitude of B relative to N that was measured some samples of the gyro ago; none, at the last one. Returns
    /// the square of the innovation in units of its covariance: of a filter in accord with its sensors chi-square with three
    /// degrees of freedom.
    ///
    /// # Errors
    ///
    /// An age above the longest latency, or before another measurement that was taken already, or the filter's start; a
    /// quaternion that is not an attitude. The filter then stays as it is.
    pub fn update(&mut self, measured: &Quaternion, age: usize) -> Result<f64, ControlError> {
        let kept = self.readings.len();
        let measured = error::attitude("measured attitude", measured)?;
        let Some(before) = kept.checked_sub(age) else {
            return Err(ControlError::TooOld { age, kept });
        };
        for _ in 0..before {
            self.forward();
        }
        let estimate = &mut self.past;
        let innovation = to_vector(&product(&inverse(&estimate.attitude), &measured));
        let Some(gains) = estimate.covariance.gains(&self.measured) else {
            return Err(ControlError::NotDefinite {
                what: "covariance of the innovation",
                minor: (estimate.covariance.attitude + self.measured).determinant(),
            });
        };
        let turn = gains.attitude * innovation;
        estimate.attitude = product(&estimate.attitude, &from_vector(&turn)).normalised();
        estimate.bias += gains.bias * innovation;
        estimate.covariance = estimate.covariance.updated(&gains, &self.measured);
        self.now =
            self.readings.iter().fold(self.past, |at, reading| self.propagated(&at, reading));
        Ok(innovation.dot(&(gains.information * innovation)))
    }

    /// Visits what it keeps from sample to sample.
    pub fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { readings, past, now, reading, .. } = self;
        checkpoint.queue(readings, Vector3::zeros, |checkpoint, of| checkpoint.numbers(of));
        for Estimate { attitude, bias, covariance } in [past, now] {
            checkpoint.attitude(attitude);
            checkpoint.numbers(bias);
            covariance.visit(checkpoint);
        }
        checkpoint.optional_vector(reading);
    }

    /// Moves the past on by a sample.
    fn forward(&mut self) {
        if let Some(reading) = self.readings.pop_front() {
            self.past = self.propagated(&self.past, &reading);
        }
    }

    fn propagated(&self, at: &Estimate, reading: &Vector3<f64>) -> Estimate {
        let turn = (reading - at.bias) * self.period;
        Estimate {
            attitude: product(&at.attitude, &from_vector(&turn)).normalised(),
            bias: at.bias,
            covariance: at.covariance.propagated(&turn, self.period, &self.noise),
        }
    }
}
