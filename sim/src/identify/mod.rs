//! From telemetry to the numbers of a spacecraft: imbalance of its wheels, friction, mounts, inertia and the bias of its gyro, by
//! maximum likelihood, each with its 95 % interval.
//!
//! ```text
//! scenario, unknowns with priors                                        component
//! telemetry -> readings and motors' torques in order                    timeline, noise
//!   -> axes and units agree with the model                              agreement
//!   -> motion with exact derivatives, normal equations                  model, pass
//!   -> Gauss and Newton's steps over longer and longer parts            solve
//!   -> what the data do not tell                                        directions
//!   -> estimates, correlations, what each sensor leaves                 estimates, amplitude
//!   -> parts of a scenario                                              device
//!   -> what a manoeuvre would add                                       design
//! ```
//!
//! The motion is that of the scenario's spacecraft under the measured torques of its motors, which are held from reading to reading.
//! Initial state and gyro bias are estimated with the rest. No process noise acts but the walk of the gyro's bias: a torque that
//! the scenario does not have is seen in the residuals, and not estimated.

mod agreement;
mod amplitude;
mod component;
mod design;
pub mod device;
mod directions;
mod error;
mod estimates;
mod model;
mod noise;
mod pass;
pub mod recording;
mod solve;
mod timeline;

pub use component::{Component, Unknown, UnknownPrior};
pub use design::{Design, DirectionDesign, Manoeuvre, NumberDesign, design};
pub use directions::Direction;
pub use error::IdentifyError;
pub use estimates::{
    Correlation, Identified, NamedEstimate, SQUARES_MAX, SensorResidual, WheelEstimate,
};
pub use noise::JointNoise;
pub use solve::Progress;

use nalgebra::Vector3;
use precess_dynamics::JointStates as _;

use component::{Start, components};
use noise::SensorNoise;
use solve::Estimation;
use timeline::Timeline;

use crate::scenario::Scenario;
use crate::telemetry::{Sensor, Series, Telemetry, controller_of};

/// What is to be found in telemetry, and what is known of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unknowns {
    /// The controller whose sensors the telemetry is of; none for the only one.
    pub controller: Option<String>,
    /// What is unknown.
    pub unknowns: Vec<UnknownPrior>,
    /// Noise of tachometers and encoders.
    pub noise: JointNoise,
    /// Whether the first values are near the truth: the whole record is taken at once.
    pub is_near: bool,
}

/// Finds the unknowns of a scenario in telemetry. `progress` returns whether to go on.
///
/// # Errors
///
/// [`IdentifyError`]: what the estimation does not have, what is missing, axes or units that are not the model's, no
/// convergence.
pub fn identify(
    scenario: &Scenario,
    telemetry: &Telemetry,
    of: &Unknowns,
    progress: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Identified, IdentifyError> {
    model::check(scenario)?;
    if of.unknowns.is_empty() {
        return Err(IdentifyError::Nothing);
    }
    let controller = controller_of(scenario, of.controller.as_deref())?;
    let Some(gyro) = telemetry.of(Sensor::Gyro) else {
        return Err(IdentifyError::NoReadings { sensor: "gyro".to_owned() });
    };
    let noise = SensorNoise::new(controller, &of.noise, telemetry)?;
    let few = |found| IdentifyError::Few { found, needed: of.unknowns.len() };
    let timeline = Timeline::new(scenario, telemetry, &noise).ok_or_else(|| few(0))?;
    let stated = scenario;
    let scenario = &at_start(stated, telemetry, timeline.start);
    agreement::check(stated, scenario, telemetry, &timeline)?;
    let components =
        components(scenario, &of.unknowns, &start(scenario, telemetry, gyro, &timeline))?;
    let numbers = timeline.numbers(timeline.end);
    if numbers <= components.len() {
        return Err(IdentifyError::Few { found: numbers, needed: components.len() });
    }
    let estimation =
        Estimation { scenario, components: &components, timeline: &timeline, noise: &noise };
    let solution = estimation.solve(of.is_near, progress)?;
    Ok(Identified::new(scenario, &estimation, solution, telemetry))
}

/// The scenario with the state at the start of a record as far as sensors have it: attitude, angular velocity, joints.
fn at_start(scenario: &Scenario, telemetry: &Telemetry, start: f64) -> Scenario {
    let mut own = scenario.clone();
    if let Some(value) = telemetry.of(Sensor::StarTracker).and_then(|of| first(of, start)) {
        let [q0, q1, q2, q3] = value;
        own.initial.attitude = precess_dynamics::Quaternion { q0, q1, q2, q3 };
    }
    if let Some(value) = telemetry.of(Sensor::Gyro).and_then(|of| first(of, start)) {
        own.initial.omega = Vector3::new(value[0], value[1], value[2]);
    }
    for (joint, [coordinate, rate]) in own.initial.devices.states_mut().enumerate() {
        let of = |sensor| telemetry.of(sensor).and_then(|of| first(of, start));
        if let Some(value) = of(Sensor::Encoder(joint)) {
            *coordinate = value[0];
        }
        if let Some(value) = of(Sensor::Tachometer(joint)) {
            *rate = value[0];
        }
    }
    own
}

/// The first reading from a time on.
fn first(of: &Series, start: f64) -> Option<[f64; 4]> {
    let place = of.times.iter().position(|time| *time >= start - 1e-9)?;
    of.values.get(place).copied()
}

fn start(scenario: &Scenario, telemetry: &Telemetry, gyro: &Series, timeline: &Timeline) -> Start {
    let value = first(gyro, timeline.start).unwrap_or_default();
    let joints =
        scenario.initial.devices.states().enumerate().map(|(joint, [coordinate, rate])| {
            let has = |sensor| telemetry.of(sensor).is_some();
            (
                has(Sensor::Encoder(joint)).then_some(coordinate),
                has(Sensor::Tachometer(joint)).then_some(rate),
            )
        });
    Start {
        omega: Vector3::new(value[0], value[1], value[2]),
        attitude: telemetry.of(Sensor::StarTracker).is_some(),
        joints: joints.collect(),
    }
}
