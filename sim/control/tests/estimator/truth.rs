//! A hub that turns, its gyro and star tracker, and a filter that reads them.

use nalgebra::{Matrix3, Vector3};
use precess_control::rotation::{from_vector, inverse, product, to_vector};
use precess_control::{
    Covariance, Estimate, Gyro, GyroOutput, GyroParameters, Mekf, MekfParameters, Noise,
    StarTracker,
};
use precess_dynamics::{Attitude as _, Quaternion};

pub(crate) const PERIOD: f64 = 0.1;
const ANGLE_RANDOM_WALK: f64 = 2e-5;
const RATE_RANDOM_WALK: f64 = 3e-6;
/// Standard deviations of the first estimate, rad and rad/s.
const ATTITUDE: f64 = 2e-3;
const BIAS: f64 = 2e-4;

/// A run of one seed.
pub(crate) struct Run {
    attitude: Quaternion,
    gyro: Gyro,
    star: StarTracker,
    pub(crate) filter: Mekf,
    sample: u32,
    /// Measured attitudes that have not arrived.
    on_their_way: Vec<Quaternion>,
    every: u32,
    latency: usize,
}

impl Run {
    /// A star tracker that measures every so many samples of the gyro, and arrives a latency later; the filter takes its
    /// covariance for `believed` times what it is.
    pub(crate) fn new(seed: u64, every: u32, latency: usize, believed: f64) -> Self {
        let mount = from_vector(&Vector3::new(0.5, -0.2, 1.0));
        let star = StarTracker::new(mount, Vector3::new(4e-5, 4e-5, 3e-4), seed, "st").unwrap();
        let [a, b, c, d, e, f, ..] = Noise::new(seed, "first estimate").at(0);
        let attitude = from_vector(&Vector3::new(0.2, -0.7, 1.1));
        // True = estimated turned by the error.
        let error = Vector3::new(a, b, c) * ATTITUDE;
        let initial = Estimate {
            attitude: product(&attitude, &from_vector(&-error)),
            bias: Vector3::zeros(),
            covariance: Covariance::new(ATTITUDE, BIAS),
        };
        let gyro = GyroParameters {
            output: GyroOutput::Integrating,
            period: PERIOD,
            angle_random_walk: ANGLE_RANDOM_WALK,
            rate_random_walk: RATE_RANDOM_WALK,
            bias: Vector3::new(d, e, f) * BIAS,
            quantum: 0.0,
        };
        let parameters = MekfParameters {
            period: PERIOD,
            angle_random_walk: ANGLE_RANDOM_WALK,
            rate_random_walk: RATE_RANDOM_WALK,
            measured: star.covariance() * believed,
            longest_latency: latency,
        };
        Self {
            attitude,
            gyro: Gyro::new(&gyro, seed, "imu").unwrap(),
            star,
            filter: Mekf::new(&parameters, &initial).unwrap(),
            sample: 0,
            on_their_way: Vec::new(),
            every,
            latency,
        }
    }

    /// A sample of the gyro, after a turn at a rate that changes; true where a measured attitude arrived.
    pub(crate) fn step(&mut self) -> bool {
        let t = f64::from(self.sample) * PERIOD;
        let omega = Vector3::new(0.05 * libm::sin(0.9 * t), 0.04, -0.06 * libm::cos(0.5 * t));
        self.attitude = product(&self.attitude, &from_vector(&(omega * PERIOD))).normalised();
        self.sample += 1;
        self.filter.propagate(&self.gyro.measure(&omega));
        if self.sample.is_multiple_of(self.every) {
            self.on_their_way.push(self.star.measure(&self.attitude));
        }
        let arrives = self.sample >= u32::try_from(self.latency).unwrap()
            && (self.sample - u32::try_from(self.latency).unwrap()).is_multiple_of(self.every)
            && !self.on_their_way.is_empty();
        if arrives {
            let measured = self.on_their_way.remove(0);
            self.filter.update(&measured, self.latency).unwrap();
        }
        arrives
    }

    /// Normalised squared error of attitude and bias.
    pub(crate) fn normalised_error(&self) -> f64 {
        let estimate = self.filter.estimate();
        let turn = to_vector(&product(&inverse(&estimate.attitude), &self.attitude));
        let bias = self.gyro.bias() - estimate.bias;
        let covariance = estimate.covariance.matrix();
        // In units of the deviations at first, for the conditioning of the inverse.
        let units = [[ATTITUDE; 3], [BIAS; 3]].concat();
        let scaled = nalgebra::SMatrix::<f64, 6, 6>::from_fn(|i, j| {
            covariance[(i, j)] / units[i] / units[j]
        });
        let error = nalgebra::SVector::<f64, 6>::from_fn(|i, _| {
            if i < 3 { turn[i] / units[i] } else { bias[i - 3] / units[i] }
        });
        error.dot(&(scaled.try_inverse().unwrap() * error))
    }
}

/// A covariance of an attitude, the same about each axis.
pub(crate) fn isotropic(deviation: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(deviation * deviation)
}
