//! [`Gyro`]: three axes with angle random walk, rate random walk and bias, sampled or integrating.
//!
//! Farrenkopf's model (J. Guid. Control 1(4), 1978): `measured = omega + b + n`, `b' = u`, n and u white. Of samples with
//! period T it is, exactly for an integrating gyro (Crassidis, Junkins, *Optimal Estimation of Dynamic Systems*, 4.7):
//!
//! ```text
//! integrating   b_k+1 = b_k + s_u sqrt(T) N_1      measured = mean of omega + (b_k + b_k+1) / 2 + sqrt(s_v² / T + s_u² T / 12) N_2
//! sampled       b_k+1 = b_k + s_u sqrt(T) N_1      measured = omega + b_k + s_v / sqrt(T) N_2
//! ```
//!
//! The angle random walk `s_v`, rad/sqrt(s), is the root of the two-sided density of n; the one-sided one is `2 s_v²`,
//! (rad/s)²/Hz. The rate random walk `s_u`, rad/s^(3/2), has the one-sided density `2 s_u² / (2 pi f)²`.

use nalgebra::Vector3;

use crate::checkpoint::Checkpoint;
use crate::model::error::{self, ControlError};
use crate::sensor::noise::Noise;
use crate::sensor::quantum::Quantum;

/// What a gyro measures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GyroOutput {
    /// The angular velocity at the sample. Whatever is faster than half of the rate is aliased.
    #[default]
    Sampled,
    /// The mean of the angular velocity since the sample before: whatever is faster is aliased, too, but weighted by
    /// `sin(pi f T) / (pi f T)`.
    Integrating,
}

/// Parameters of a gyro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroParameters {
    /// What it measures.
    pub output: GyroOutput,
    /// Time from sample to sample, s.
    pub period: f64,
    /// Angle random walk, rad/sqrt(s): 1 deg/sqrt(h) is `pi / 180 / 60`.
    pub angle_random_walk: f64,
    /// Rate random walk, rad/s^(3/2).
    pub rate_random_walk: f64,
    /// Bias at first, expressed in B, rad/s.
    pub bias: Vector3<f64>,
    /// Step of a reading, zero for none: of a sampled gyro a rate, rad/s, of an integrating one an angle, rad, whose rest
    /// is counted with the next sample.
    pub quantum: f64,
}

/// A gyro with its bias.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyro {
    output: GyroOutput,
    period: f64,
    white: f64,
    walk: f64,
    quantum: Quantum,
    noise: Noise,
    sample: u64,
    bias: Vector3<f64>,
    rest: Vector3<f64>,
}

impl Gyro {
    /// With the numbers of a seed and a sensor's name.
    ///
    /// # Errors
    ///
    /// A parameter that is not in its range.
    pub fn new(parameters: &GyroParameters, seed: u64, sensor: &str) -> Result<Self, ControlError> {
        let GyroParameters { output, period, angle_random_walk, rate_random_walk, bias, quantum } =
            *parameters;
        error::positive("sampling period", period)?;
        error::not_negative("angle random walk", angle_random_walk)?;
        error::not_negative("rate random walk", rate_random_walk)?;
        for value in bias.iter() {
            error::finite("bias", *value)?;
        }
        let mut variance = angle_random_walk * angle_random_walk / period;
        if output == GyroOutput::Integrating {
            variance += rate_random_walk * rate_random_walk * period / 12.0;
        }
        Ok(Self {
            output,
            period,
            white: libm::sqrt(variance),
            walk: rate_random_walk * libm::sqrt(period),
            quantum: Quantum::new(quantum)?,
            noise: Noise::new(seed, sensor),
            sample: 0,
            bias,
            rest: Vector3::zeros(),
        })
    }

    /// The bias at the last sample, expressed in B, rad/s: what an estimator is to find.
    #[must_use]
    pub fn bias(&self) -> Vector3<f64> {
        self.bias
    }

    /// Lets the bias jump, expressed in B, rad/s: a fault, from the next sample on.
    pub fn add_bias(&mut self, jump: &Vector3<f64>) {
        self.bias += jump;
    }

    /// What is read at the next sample, expressed in B, rad/s. `omega` is the angular velocity at the sample or, of an
    /// integrating gyro, its mean since the sample before (the integral of its components over the period).
    pub fn measure(&mut self, omega: &Vector3<f64>) -> Vector3<f64> {
        let [n0, n1, n2, u0, u1, u2, ..] = self.noise.at(self.sample);
        let before = self.bias;
        // The first sample of a sampled gyro has the bias at first.
        if self.output == GyroOutput::Integrating || self.sample > 0 {
            self.bias += Vector3::new(u0, u1, u2) * self.walk;
        }
        self.sample += 1;
        let white = Vector3::new(n0, n1, n2) * self.white;
        match self.output {
            GyroOutput::Sampled => self.quantum.read_each(&(omega + self.bias + white)),
            GyroOutput::Integrating => {
                let mean = omega + (before + self.bias) * 0.5 + white;
                let turned = self.rest + mean * self.period;
                let counted = self.quantum.read_each(&turned);
                self.rest = turned - counted;
                counted / self.period
            }
        }
    }

    /// Visits what it keeps from sample to sample.
    pub fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { sample, bias, rest, .. } = self;
        checkpoint.count(sample);
        checkpoint.numbers(bias.iter_mut().chain(rest.iter_mut()));
    }
}
