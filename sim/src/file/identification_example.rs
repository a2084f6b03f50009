//! An example: a bus with four wheels, its unknowns, and a record of another bus, the truth, of the same seed each time.

use std::path::Path;

use super::{Diagnostics, Numbers, Tables, from_program, from_toml};
use crate::identify::IdentifyError;
use crate::identify::recording::Recording;
use crate::scenario::Scenario;

/// Names of its files.
pub const SCENARIO_FILE: &str = "bus.toml";
/// Names of its files.
pub const UNKNOWN_FILE: &str = "bus-unknown.toml";
/// Names of its files.
pub const TELEMETRY_FILE: &str = "bus-telemetry.csv";

/// The record of the example: 20 s.
pub const RECORDING: Recording =
    Recording { seed: 1, duration: 20.0, torque: 0.05, tachometer: 0.05 };

/// The scenario, as drawings and data sheets have the bus.
pub const SCENARIO: &str = r#"# A bus with a pyramid of four wheels, as data sheets have it (precess identify --example).
format = 1
title = "Bus with four wheels"

[hub]
mass = "180 kg"
centre_of_mass = "0, 0, 5 cm"
inertia = "40, 35, 30 kg m^2"
size = "0.9, 0.8, 1.0 m"

[[device]]
name = "rw"
kind = "reaction_wheel"
layout.pyramid = { count = 4, half_angle = "54.74 deg", radius = "25 cm" }
imbalance = { static = "0.15 g cm", dynamic = "2.2 g cm^2" }

[device.wheel]
mass = "6.0 kg"
inertia = "0.0191, 0.0114, 0.0114 kg m^2"
damping = "1e-5 N m s/rad"
torque_limit = "200 mN m"

# Each at its own speed, so that their lines are apart.
[[device.member]]
name = "rw1"
wheel.rate = "1080 rpm"
[[device.member]]
name = "rw2"
wheel.rate = "1170 rpm"
[[device.member]]
name = "rw3"
wheel.rate = "-1260 rpm"
[[device.member]]
name = "rw4"
wheel.rate = "1350 rpm"

# Whose sensors the telemetry is of: a fibre-optic gyro at 100 Hz.
[[controller]]
name = "aocs"
rate = "100 Hz"

[controller.law]
kind = "eigen_axis"
frequency = "0.03 Hz"
damping_ratio = 0.8

[controller.sensors]
seed = 1
gyro = { output = "integrating", angle_random_walk = "0.001 deg/sqrt(h)", rate_random_walk = "0.01 deg/h/sqrt(h)", bias = "0.5, -0.3, 0.4 deg/h" }

[run]
duration = "20 s"

[output]
rate = "100 Hz"
"#;

/// What is to be found.
pub const UNKNOWN: &str = r#"# What is unknown of the bus. true: nothing is known before; a quantity: a standard deviation.
format = 1
name = "bus"

[unknown]
hub_moments = true
gyro_bias = "2 deg/h"

[[unknown.device]]
name = "rw"                        # the four of this layout
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
viscous = true

[noise]
tachometer = "0.05 rad/s"
"#;

/// Keys by which the truth differs from the scenario.
pub const TRUTH: &[&str] = &[
    "hub.inertia = \"41.3, 34.2, 30.6 kg m^2\"",
    "device.rw1.imbalance = { static = \"0.21 g cm\", dynamic = \"2.9 g cm^2\", phase = \"40 deg\" }",
    "device.rw2.imbalance = { static = \"0.17 g cm\", dynamic = \"1.8 g cm^2\", phase = \"-70 deg\" }",
    "device.rw3.imbalance = { static = \"0.12 g cm\", dynamic = \"2.4 g cm^2\", phase = \"120 deg\" }",
    "device.rw4.imbalance = { static = \"0.28 g cm\", dynamic = \"3.3 g cm^2\", phase = \"10 deg\" }",
    "device.rw1.wheel.angle = \"25 deg\"",
    "device.rw2.wheel.angle = \"-110 deg\"",
    "device.rw3.wheel.angle = \"160 deg\"",
    "device.rw4.wheel.angle = \"75 deg\"",
    "device.rw1.wheel.damping = \"1.4e-5 N m s/rad\"",
    "device.rw2.wheel.damping = \"1.1e-5 N m s/rad\"",
    "device.rw3.wheel.damping = \"2.3e-5 N m s/rad\"",
    "device.rw4.wheel.damping = \"0.8e-5 N m s/rad\"",
];

/// The scenario of the example.
///
/// # Errors
/// None of this text; as any scenario's.
pub fn scenario() -> Result<Scenario, Diagnostics> {
    from_toml("bus", SCENARIO, Path::new("")).map(|(scenario, _)| scenario)
}

/// The truth: the scenario with other numbers.
///
/// # Errors
/// None of this text; as any scenario's.
pub fn truth() -> Result<Scenario, Diagnostics> {
    let tables = Tables::Text {
        name: "bus",
        text: SCENARIO,
        numbers: Numbers::WithUnits,
        folder: Path::new(""),
    };
    let overrides: Vec<String> = TRUTH.iter().map(|&key| key.to_owned()).collect();
    from_program(tables, &overrides).map(|(scenario, _)| scenario)
}

/// The telemetry of the truth, CSV: the same bytes each time.
///
/// # Errors
/// None of this scenario; as of a recording.
pub fn telemetry(truth: &Scenario) -> Result<String, IdentifyError> {
    RECORDING.csv(truth)
}
