//! [`ControllerSensors`], [`FilterSettings`], [`EstimatorSettings`], [`DumpingSettings`]: what a controller reads of the
//! truth, how it filters that, and the external torque that it commands; in numbers of a scenario, from which
//! [`precess_control`] makes them.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use precess_control::{
    Accelerometer, AccelerometerParameters, AnalogSection, ControlError, Covariance, DelayLine,
    Discretisation, Estimate, Filter, Gyro, GyroOutput, GyroParameters, Mekf, MekfParameters,
    MomentumDumping, Quantum, Section, StarTracker,
};
use precess_dynamics::{Attitude as _, Quaternion};

use super::SampledController;
use super::controller::DELAY_MAX;
use crate::units::Plain;

/// Sensors of a controller. What has no sensor is read as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControllerSensors {
    /// Of the noise of all of them.
    pub seed: u32,
    /// Of the angular velocity.
    pub gyro: Option<GyroSettings>,
    /// Of the attitude.
    pub star_tracker: Option<StarTrackerSettings>,
    /// Of the specific force; for controllers of one's own.
    pub accelerometer: Option<AccelerometerSettings>,
    /// Step of the coordinates of the commanded joints, rad; zero for none.
    pub encoder_quantum: f64,
    /// Step of their rates, rad/s; zero for none.
    pub tachometer_quantum: f64,
}

/// A gyro with three axes, read at each sample of its controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroSettings {
    /// The node of the structure on which it stands; none for the hub.
    pub node: Option<usize>,
    /// What it measures.
    pub output: GyroOutput,
    /// Angle random walk, rad/sqrt(s).
    pub angle_random_walk: f64,
    /// Rate random walk, rad/s^(3/2).
    pub rate_random_walk: f64,
    /// Bias at first, rad/s.
    pub bias: Vector3<f64>,
    /// Step of a reading: rad/s, of an integrating gyro rad; zero for none.
    pub quantum: f64,
}

/// A star tracker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarTrackerSettings {
    /// The node of the structure on which it stands; none for the hub.
    pub node: Option<usize>,
    /// Its axes, columns expressed in B.
    pub mount: Matrix3<f64>,
    /// Standard deviation of the noise about each of them, rad.
    pub noise: Vector3<f64>,
    /// Measurements per second, Hz; none for one at each sample of the controller.
    pub rate: Option<f64>,
    /// From a measurement to its arrival, s.
    pub latency: f64,
}

/// An accelerometer with three axes, read at each sample of its controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccelerometerSettings {
    /// The node of the structure on which it stands; none for the hub.
    pub node: Option<usize>,
    /// From B, m, of one on the hub.
    pub position: Vector3<f64>,
    /// Root of the one-sided density of its noise, m/s²/sqrt(Hz).
    pub noise_density: f64,
    /// Bias, m/s².
    pub bias: Vector3<f64>,
    /// Step of a reading, m/s²; zero for none.
    pub quantum: f64,
}

/// Which signal a filter is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FilteredSignal {
    /// The angular velocity that the law reads.
    #[default]
    Rate,
    /// The torque that it commands.
    Torque,
}

/// A filter of three axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterSettings {
    /// Of which signal.
    pub signal: FilteredSignal,
    /// Its transfer function.
    pub kind: FilterKind,
}

/// The transfer function of a filter; frequencies in Hz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilterKind {
    /// Of first order, at its cutoff.
    FirstOrderLowPass {
        /// The cutoff.
        frequency: f64,
    },
    /// Of second order.
    LowPass {
        /// The cutoff.
        frequency: f64,
        /// Damping ratio of the poles.
        damping_ratio: f64,
    },
    /// Notch.
    Notch {
        /// Of zeros and poles.
        frequency: f64,
        /// Damping ratio of the zeros.
        zero_damping: f64,
        /// Damping ratio of the poles.
        pole_damping: f64,
    },
    /// Lead or lag.
    LeadLag {
        /// Of the zero.
        zero: f64,
        /// Of the pole.
        pole: f64,
    },
}

/// The multiplicative extended Kalman filter of a controller: [`Mekf`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimatorSettings {
    /// Standard deviation of the attitude at first about each axis, rad.
    pub attitude_deviation: f64,
    /// Standard deviation of the bias at first about each axis, rad/s.
    pub bias_deviation: f64,
}

/// An external torque that takes momentum from the devices: [`MomentumDumping`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DumpingSettings {
    /// Torque per momentum, 1/s.
    pub gain: f64,
    /// The momentum of the devices that is wanted, B, N m s.
    pub momentum: Vector3<f64>,
    /// Largest magnitude of each component of the torque, N m; infinite where there is none.
    pub torque_limit: Vector3<f64>,
}

/// Sensors, filters and the parameters of an estimator that a run keeps.
#[derive(Clone, Debug)]
pub(crate) struct BuiltSensors {
    pub(crate) gyro: Option<Gyro>,
    pub(crate) star_tracker: Option<StarTracker>,
    pub(crate) accelerometer: Option<Accelerometer>,
    /// Measured attitudes on their way, each with the number of the sample at which it was measured.
    pub(crate) arriving: Option<DelayLine<(usize, Quaternion)>>,
    pub(crate) encoder: Quantum,
    pub(crate) tachometer: Quantum,
    /// Of each axis: of the rate, and of the torque.
    pub(crate) filters: [[Filter; 3]; 2],
    pub(crate) estimator: Option<MekfParameters>,
    pub(crate) dumping: Option<MomentumDumping>,
}

/// What is wrong with the numbers of a key.
type Fault = (&'static str, ControlError);

impl FilterKind {
    /// At a sampling period, s: filters keep their own frequency (prewarped), a lead or lag is bilinear as it is.
    fn section(&self, period: f64) -> Result<Section, ControlError> {
        let (analog, by) = match *self {
            Self::FirstOrderLowPass { frequency } => {
                let w = TAU * frequency;
                (AnalogSection::low_pass_of_first_order(w)?, Discretisation::Prewarped(w))
            }
            Self::LowPass { frequency, damping_ratio } => {
                let w = TAU * frequency;
                (AnalogSection::low_pass(w, damping_ratio)?, Discretisation::Prewarped(w))
            }
            Self::Notch { frequency, zero_damping, pole_damping } => {
                let w = TAU * frequency;
                let notch = AnalogSection::notch(w, zero_damping, pole_damping)?;
                (notch, Discretisation::Prewarped(w))
            }
            Self::LeadLag { zero, pole } => {
                (AnalogSection::lead_lag(TAU * zero, TAU * pole)?, Discretisation::Bilinear)
            }
        };
        analog.discrete(period, by)
    }
}

impl ControllerSensors {
    /// Whether nothing is measured: everything is read as it is.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self { seed: self.seed, ..Self::default() }
    }
}

impl StarTrackerSettings {
    /// Attitude of its axes relative to B.
    fn attitude(&self) -> Quaternion {
        let turn =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(self.mount));
        Quaternion { q0: turn.w, q1: turn.i, q2: turn.j, q3: turn.k }.normalised()
    }
}

impl SampledController {
    /// Sensors, filters, estimator and dumping, as a run keeps them.
    ///
    /// # Errors
    ///
    /// The key of what is wrong, and why.
    pub(crate) fn built_sensors(&self) -> Result<BuiltSensors, Fault> {
        let period = 1.0 / self.rate;
        let seed = u64::from(self.sensors.seed);
        let at = |key| move |error: ControlError| (key, error);
        let of = &self.sensors;
        let gyro = of.gyro.map(|of| {
            let parameters = GyroParameters {
                output: of.output,
                period,
                angle_random_walk: of.angle_random_walk,
                rate_random_walk: of.rate_random_walk,
                bias: of.bias,
                quantum: of.quantum,
            };
            Gyro::new(&parameters, seed, &format!("{}.gyro", self.name))
        });
        let star_tracker = of.star_tracker.map(|of| {
            StarTracker::new(of.attitude(), of.noise, seed, &format!("{}.star_tracker", self.name))
        });
        let star_tracker = star_tracker.transpose().map_err(at("sensors.star_tracker"))?;
        let arriving = of.star_tracker.map(|of| DelayLine::new(of.latency, period));
        let accelerometer = of.accelerometer.map(|of| {
            let AccelerometerSettings { noise_density, bias, quantum, .. } = of;
            let parameters = AccelerometerParameters { period, noise_density, bias, quantum };
            Accelerometer::new(&parameters, seed, &format!("{}.accelerometer", self.name))
        });
        let mut filters = [Vec::new(), Vec::new()];
        for filter in &self.filters {
            let section = filter.kind.section(period).map_err(at("filter"))?;
            let [rate, torque] = &mut filters;
            if filter.signal == FilteredSignal::Rate { rate } else { torque }.push(section);
        }
        let estimator = match (&self.estimator, &of.gyro, &of.star_tracker, &star_tracker) {
            (Some(settings), Some(gyro), Some(star), Some(built)) => {
                Some(self.mekf(settings, gyro, (star, built))?)
            }
            _ => None,
        };
        let dumping =
            self.dumping.map(|of| MomentumDumping::new(of.gain, of.momentum, of.torque_limit));
        Ok(BuiltSensors {
            gyro: gyro.transpose().map_err(at("sensors.gyro"))?,
            star_tracker,
            accelerometer: accelerometer.transpose().map_err(at("sensors.accelerometer"))?,
            arriving: arriving.transpose().map_err(at("sensors.star_tracker"))?,
            encoder: Quantum::new(of.encoder_quantum).map_err(at("sensors.encoder_quantum"))?,
            tachometer: Quantum::new(of.tachometer_quantum)
                .map_err(at("sensors.tachometer_quantum"))?,
            filters: filters.map(|sections| [0, 1, 2].map(|_| Filter::new(sections.clone()))),
            estimator,
            dumping: dumping.transpose().map_err(at("dumping"))?,
        })
    }

    /// Parameters of the estimator, which has been found to accept them.
    fn mekf(
        &self,
        settings: &EstimatorSettings,
        gyro: &GyroSettings,
        (star, built): (&StarTrackerSettings, &StarTracker),
    ) -> Result<MekfParameters, Fault> {
        for (what, value) in [
            ("deviation of the attitude", settings.attitude_deviation),
            ("deviation of the bias", settings.bias_deviation),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(("estimator", ControlError::Negative { what, value }));
            }
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative, at most DELAY_MAX"
        )]
        let latency = (star.latency * self.rate).ceil().clamp(0.0, DELAY_MAX) as usize;
        let parameters = MekfParameters {
            period: 1.0 / self.rate,
            angle_random_walk: gyro.angle_random_walk,
            rate_random_walk: gyro.rate_random_walk,
            measured: built.covariance(),
            longest_latency: latency + 1,
        };
        let start = settings.at(Quaternion::identity());
        Mekf::new(&parameters, &start).map_err(|error| ("estimator", error))?;
        Ok(parameters)
    }

    /// Keys of sensors with what is wrong with their values.
    pub(super) fn sensor_faults(&self) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        if let Some(star) = &self.sensors.star_tracker {
            if let Some(rate) = star.rate
                && !(rate > 0.0 && rate <= self.rate)
            {
                let [rate, own] = [rate, self.rate].map(Plain);
                let message = format!(
                    "{rate} Hz is not above 0 Hz and at most {own} Hz, the rate of samples"
                );
                faults.push(("sensors.star_tracker.rate", message));
            }
            let longest = DELAY_MAX / self.rate;
            if !(0.0..=longest).contains(&star.latency) {
                let [latency, longest] = [star.latency, longest].map(Plain);
                let message =
                    format!("{latency} s is outside 0 s to {longest} s, {DELAY_MAX} samples");
                // What is built of it would say the same.
                faults.push(("sensors.star_tracker.latency", message));
                return faults;
            }
        }
        let measured = self.sensors.gyro.is_some() && self.sensors.star_tracker.is_some();
        if self.estimator.is_some() && !measured {
            let message = "it estimates from a gyro and a star tracker; add both to `sensors`";
            faults.push(("estimator", message.to_owned()));
        }
        faults.extend(self.built_sensors().err().map(|(key, error)| (key, error.to_string())));
        faults
    }
}

impl EstimatorSettings {
    /// The estimate at first.
    pub(crate) fn at(&self, attitude: Quaternion) -> Estimate {
        let covariance = Covariance::new(self.attitude_deviation, self.bias_deviation);
        Estimate { attitude, bias: Vector3::zeros(), covariance }
    }
}
