//! [`Recording`]: telemetry of a scenario under torques of its wheels' motors, with the noise of its sensors, from a seed: for examples
//! and tests. The motion is by steps of a tenth of what the estimation takes.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use nalgebra::Vector3;
use precess_control::{GyroOutput, Noise, rotation};
use precess_dynamics::{Each as _, JointStates as _};

use super::component::wheel_joint;
use super::error::IdentifyError;
use super::model::Model;
use crate::scenario::Scenario;
use crate::telemetry::{Sensor, TelemetryLayout, controller_of};

/// The longest step, of the turn of the fastest wheel, rad.
const TURN: f64 = 0.05;
/// Frequencies of the torques of the wheels, Hz: no two beat within half a minute.
const FREQUENCIES: [f64; 6] = [0.11, 0.17, 0.23, 0.31, 0.37, 0.43];

/// A record that is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recording {
    /// Of the noise of all sensors.
    pub seed: u32,
    /// s.
    pub duration: f64,
    /// Amplitude of the sinusoidal torque of each wheel's motor, N m; wheel k at its own frequency.
    pub torque: f64,
    /// Standard deviation of the tachometers, rad/s, beside the quantum.
    pub tachometer: f64,
}

impl Recording {
    /// The readings as CSV, with the columns of [`TelemetryLayout::of_scenario`].
    ///
    /// # Errors
    ///
    /// A scenario without controller and gyro, or whose motion cannot be computed.
    pub fn csv(&self, scenario: &Scenario) -> Result<String, IdentifyError> {
        let controller = controller_of(scenario, None)?;
        let built = controller.built_sensors();
        let unknown = || IdentifyError::NoReadings { sensor: "gyro".to_owned() };
        let mut built = built.map_err(|_| unknown())?;
        let mut gyro = built.gyro.take().ok_or_else(unknown)?;
        let output = controller.sensors.gyro.map(|of| of.output).unwrap_or_default();
        let layout = TelemetryLayout::of_scenario(scenario, None)?;
        let model = Model::new(scenario, &[], &[])?;
        let (mut state, mut inputs) = (model.state.clone(), model.inputs.clone());
        let wheels: Vec<usize> =
            (0..scenario.names.len()).filter_map(|device| wheel_joint(scenario, device)).collect();
        let noise = Noise::new(u64::from(self.seed), "tachometers");
        let fastest = state.devices.states().map(|[_, rate]| rate.abs()).fold(1.0, f64::max);
        let period = controller.rate.recip();
        let parts = (period * fastest / TURN).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
        let samples = (self.duration * controller.rate).round() as u32;
        let has_star = built.star_tracker.is_some();
        let shown = |of: &Sensor| match of {
            Sensor::StarTracker => has_star,
            Sensor::Encoder(_) => false,
            _ => true,
        };
        let sensors = || layout.sensors.iter().filter(|of| shown(&of.sensor));
        let mut text = layout.time.clone();
        sensors().flat_map(|of| &of.columns).for_each(|name| text.extend([",", name.as_str()]));
        text.push('\n');
        let mut before = state.attitude;
        for sample in 0..=samples {
            let time = f64::from(sample) / controller.rate;
            let turn = rotation::product(&rotation::inverse(&before), &state.attitude);
            let mean = match output {
                GyroOutput::Integrating if sample > 0 => rotation::to_vector(&turn) / period,
                _ => state.omega,
            };
            before = state.attitude;
            let reading: Vector3<f64> = gyro.measure(&mean);
            for (wheel, joint) in wheels.iter().enumerate() {
                let frequency = FREQUENCIES[wheel % FREQUENCIES.len()];
                if let Some(motor) = inputs.motors.values_mut().nth(*joint) {
                    *motor = self.torque * (TAU * frequency * time).sin();
                }
            }
            let motors: Vec<f64> = inputs.motors.values().collect();
            let rates: Vec<f64> = state.devices.states().map(|[_, rate]| rate).collect();
            let star = built.star_tracker.as_mut().map(|of| of.measure(&state.attitude));
            let _ = write!(text, "{time}");
            for of in sensors() {
                match of.sensor {
                    Sensor::Gyro => {
                        reading.iter().for_each(|rate| {
                            let _ = write!(text, ",{rate}");
                        });
                    }
                    Sensor::StarTracker => {
                        if let Some(q) = star {
                            let _ = write!(text, ",{},{},{},{}", q.q0, q.q1, q.q2, q.q3);
                        }
                    }
                    Sensor::Tachometer(joint) => {
                        // Eight numbers a sample; of more joints those of later blocks.
                        let block = u64::from(sample) + ((joint as u64 / 8) << 32);
                        let drawn = noise.at(block)[joint % 8];
                        let rate = rates.get(joint).copied().unwrap_or_default();
                        let rate = built.tachometer.read(rate + self.tachometer * drawn);
                        let _ = write!(text, ",{rate}");
                    }
                    Sensor::Motor(joint) => {
                        let torque = motors.get(joint).copied().unwrap_or_default();
                        let _ = write!(text, ",{torque}");
                    }
                    Sensor::Encoder(_) => {}
                }
            }
            text.push('\n');
            let mut part = 0.0;
            while part < parts {
                state = model.craft.step(&state, &inputs, period / parts)?;
                part += 1.0;
            }
        }
        Ok(text)
    }
}
