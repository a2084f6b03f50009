//! [`TelemetryLayout`]: which columns of a file are which sensor of a scenario's controller.

use std::fmt;

use precess_dynamics::Steered;

use crate::nearest::nearest;
use crate::scenario::{SampledController, Scenario};

/// A sensor, or the torque of a motor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sensor {
    /// Angular velocity, expressed in B.
    Gyro,
    /// Attitude of B with respect to N.
    StarTracker,
    /// Rate of a joint, by its number.
    Tachometer(usize),
    /// Coordinate of a joint.
    Encoder(usize),
    /// Torque or force of the motor of a joint, held until the next.
    Motor(usize),
}

/// The columns of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorColumns {
    /// Which.
    pub sensor: Sensor,
    /// What messages call it.
    pub name: String,
    /// Names of its columns, in order: one, three or four.
    pub columns: Vec<String>,
    /// SI units that one of its numbers is.
    pub size: f64,
    /// The least time between its readings, s; none where it is unknown.
    pub period: Option<f64>,
    /// Whether two readings of it are never equal, since it has noise and no quantum.
    pub noisy: bool,
    /// The largest magnitude that a component can read, SI; none where it is unknown.
    pub range: Option<f64>,
}

/// Columns of a file of telemetry.
#[derive(Clone, Debug, PartialEq)]
pub struct TelemetryLayout {
    /// The name of the column of the times.
    pub time: String,
    /// Seconds that one of its numbers is.
    pub time_size: f64,
    /// Sensors that the file may have.
    pub sensors: Vec<SensorColumns>,
}

/// Why a scenario does not say what its telemetry has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LayoutError {
    /// It has no controller.
    NoController,
    /// It has several, and none was named.
    Several(Vec<String>),
    /// It has none of this name.
    Unknown {
        /// The name.
        name: String,
        /// Those that are like it.
        nearest: Vec<String>,
    },
}

impl fmt::Display for LayoutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoController => f.write_str(
                "the scenario has no `[[controller]]`, whose `sensors` say what the telemetry is of; add one",
            ),
            Self::Several(names) => write!(
                f,
                "the scenario has several controllers, {}; name the one whose sensors the telemetry is of",
                names.join(", ")
            ),
            Self::Unknown { name, nearest } => {
                write!(f, "the scenario has no controller `{name}`")?;
                if nearest.is_empty() { Ok(()) } else { write!(f, "; there is {}", nearest.join(", ")) }
            }
        }
    }
}

impl std::error::Error for LayoutError {}

impl TelemetryLayout {
    /// That of a scenario: the columns `time`; `NAME.gyro_x` to `_z` of the controller of this name (of the only one);
    /// `NAME.star_tracker_q0` to `q3`; of each joint its rate (`rw.spin`) and motor (`rw.u_w`), and of gimbals the coordinate, as the
    /// columns of a run are named; SI units and radians.
    ///
    /// # Errors
    ///
    /// A scenario without a controller, or with several where none is named.
    pub fn of_scenario(scenario: &Scenario, controller: Option<&str>) -> Result<Self, LayoutError> {
        let controller = controller_of(scenario, controller)?;
        let (name, sensors) = (&controller.name, &controller.sensors);
        let period = controller.rate.recip();
        let gyro_noise =
            |of: &crate::scenario::GyroSettings| of.angle_random_walk > 0.0 && of.quantum == 0.0;
        let mut all = vec![SensorColumns {
            sensor: Sensor::Gyro,
            name: "gyro".to_owned(),
            columns: ["x", "y", "z"].map(|axis| format!("{name}.gyro_{axis}")).to_vec(),
            size: 1.0,
            period: Some(period),
            noisy: sensors.gyro.as_ref().is_some_and(gyro_noise),
            range: None,
        }];
        let star = sensors.star_tracker.as_ref();
        all.push(SensorColumns {
            sensor: Sensor::StarTracker,
            name: "star tracker".to_owned(),
            columns: (0..4).map(|k| format!("{name}.star_tracker_q{k}")).collect(),
            size: 1.0,
            period: Some(star.and_then(|of| of.rate).map_or(period, f64::recip)),
            noisy: star.is_some_and(|of| of.noise.iter().all(|noise| *noise > 0.0)),
            range: None,
        });
        let steered = |joint: usize| {
            let own = controller.joints.iter().find(|of| of.joint == joint);
            own.is_some_and(|of| of.steered == Steered::Rate)
        };
        for (joint, (_, device, info)) in scenario.joints().enumerate() {
            let one = |sensor, what: &str, column: &str| {
                let column = format!("{device}.{column}");
                SensorColumns {
                    sensor,
                    name: format!("{what} {column}"),
                    columns: vec![column],
                    size: 1.0,
                    period: None,
                    noisy: false,
                    range: None,
                }
            };
            all.push(one(Sensor::Tachometer(joint), "tachometer", info.rate));
            if steered(joint) {
                all.push(one(Sensor::Encoder(joint), "encoder", info.coordinate));
            }
            if info.driven {
                all.push(one(Sensor::Motor(joint), "motor", info.motor));
            }
        }
        Ok(Self { time: "time".to_owned(), time_size: 1.0, sensors: all })
    }

    /// The columns of a sensor.
    pub fn sensor_mut(&mut self, sensor: Sensor) -> Option<&mut SensorColumns> {
        self.sensors.iter_mut().find(|of| of.sensor == sensor)
    }
}

/// The controller of a name, or the only one.
pub(crate) fn controller_of<'a>(
    scenario: &'a Scenario,
    name: Option<&str>,
) -> Result<&'a SampledController, LayoutError> {
    let all = &scenario.controllers;
    match (name, all.as_slice()) {
        (None, []) => Err(LayoutError::NoController),
        (None, [one]) => Ok(one),
        (None, _) => Err(LayoutError::Several(all.iter().map(|of| of.name.clone()).collect())),
        (Some(name), _) => all.iter().find(|of| of.name == name).ok_or_else(|| {
            let nearest = nearest(name, all.iter().map(|of| &of.name));
            LayoutError::Unknown { name: name.to_owned(), nearest }
        }),
    }
}
