//! [`SensorNoise`]: the standard deviations of readings, from what the sensors of a controller state.
//!
//! ```text
//! gyro, sampled        s_v² / T + q² / 12                          white
//! gyro, integrating    s_v² / T + s_u² T / 12 + q² / (6 T²)        q an angle: what is left is counted with the next sample
//! bias                 s_u² dt                                     a random walk between readings
//! quanta               q² / 12
//! ```

use nalgebra::Matrix3;
use precess_control::GyroOutput;

use super::error::IdentifyError;
use crate::scenario::SampledController;
use crate::telemetry::{Sensor, Telemetry};

/// Standard deviations from which a residual counts by its size.
const HUBER: f64 = 3.0;

/// What the file of unknowns states of the noise of joints, beside the quanta of the scenario.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointNoise {
    /// Standard deviation of a tachometer's reading, rad/s; zero for none.
    pub tachometer: f64,
    /// Of an encoder's, rad.
    pub encoder: f64,
}

/// Standard deviations of readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SensorNoise {
    /// Of a component of the gyro's reading, rad/s.
    pub(super) gyro: f64,
    /// Of the walk of its bias, rad/s^(3/2).
    pub(super) walk: f64,
    /// Over which the gyro's reading is the mean, s; none of a sampled one.
    pub(super) mean_over: Option<f64>,
    /// About the axes of the star tracker, rad.
    pub(super) star: [f64; 3],
    /// Those axes, columns expressed in B.
    pub(super) star_mount: Matrix3<f64>,
    pub(super) tachometer: f64,
    pub(super) encoder: f64,
    /// Standard deviations from which a residual counts by its size.
    pub(super) bound: f64,
}

impl SensorNoise {
    /// Of a controller and the sensors that the telemetry has.
    pub(super) fn new(
        controller: &SampledController,
        stated: &JointNoise,
        telemetry: &Telemetry,
    ) -> Result<Self, IdentifyError> {
        let sensors = &controller.sensors;
        let period = controller.rate.recip();
        let unknown = |sensor: &str, key| IdentifyError::NoNoise { sensor: sensor.to_owned(), key };
        let mut noise = Self {
            gyro: 0.0,
            walk: 0.0,
            mean_over: None,
            star: [0.0; 3],
            star_mount: Matrix3::identity(),
            tachometer: stated.tachometer.hypot(sensors.tachometer_quantum / 12_f64.sqrt()),
            encoder: stated.encoder.hypot(sensors.encoder_quantum / 12_f64.sqrt()),
            bound: HUBER,
        };
        if telemetry.of(Sensor::Gyro).is_some() {
            let gyro = sensors.gyro.ok_or_else(|| unknown("gyro", "controller.sensors.gyro"))?;
            let mut variance = gyro.angle_random_walk * gyro.angle_random_walk / period;
            if gyro.output == GyroOutput::Integrating {
                noise.mean_over = Some(period);
                variance += gyro.rate_random_walk * gyro.rate_random_walk * period / 12.0;
                variance += gyro.quantum * gyro.quantum / (6.0 * period * period);
            } else {
                variance += gyro.quantum * gyro.quantum / 12.0;
            }
            noise.gyro = variance.sqrt();
            noise.walk = gyro.rate_random_walk;
            if noise.gyro <= 0.0 {
                return Err(unknown("gyro", "controller.sensors.gyro.angle_random_walk"));
            }
        }
        if telemetry.of(Sensor::StarTracker).is_some() {
            let star = sensors.star_tracker;
            let star =
                star.ok_or_else(|| unknown("star tracker", "controller.sensors.star_tracker"))?;
            noise.star = star.noise.into();
            noise.star_mount = star.mount;
            if noise.star.iter().any(|of| *of <= 0.0) {
                return Err(unknown("star tracker", "controller.sensors.star_tracker.noise"));
            }
        }
        let has = |of: fn(&Sensor) -> bool| telemetry.series.iter().any(|s| of(&s.sensor));
        if has(|of| matches!(of, Sensor::Tachometer(_))) && noise.tachometer <= 0.0 {
            return Err(unknown("tachometers", "noise.tachometer"));
        }
        if has(|of| matches!(of, Sensor::Encoder(_))) && noise.encoder <= 0.0 {
            return Err(unknown("encoders", "noise.encoder"));
        }
        Ok(noise)
    }
}
