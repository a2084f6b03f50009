//! Functional mock-up units: descriptions, refusals, and the C, which has the bits of a run.
//!
//! Of both versions of FMI the C is compiled by each compiler at hand with its warnings as errors, and once with sanitisers;
//! `driver_fmi2.c` and `driver_fmi3*.c` are importers. Validation by others, and Model Exchange, are in
//! `tests/engines/units.py`.

mod compiled;
mod derivatives;
mod described;
mod engine;
mod engine_state;
mod refused;

use std::path::Path;

use precess::file::from_toml;
use precess::fmu::{FmiVersion, Fmu};
use precess::scenario::Scenario;

/// A wheel and, second, a panel with end stops; wrenches on hub and wheel, a torque beyond its limit.
const UNIT: &str = r#"format = 1
title = "Bus & <panel>"
description = "One line\nand another: \"quoted\", \u001b[2J."
[hub]
mass = "90 kg"
centre_of_mass = "1, -2, 3 cm"
inertia = "20, 21, 22 kg m^2"
[initial]
angular_velocity = "1, -2, 3 deg/s"
[[device]]
name = "rw"
kind = "reaction_wheel"
position = "20, 10, 0 cm"
mount = { spin_axis = [0.6, 0, 0.8] }
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
torque = "0.3 N m"
torque_limit = "0.2 N m"
[[device]]
name = "panel"
kind = "hinged_panel"
position = "45, 0, 0 cm"
mount = { hinge_axis = [0, 0, 1] }
[device.panel]
mass = "8 kg"
centre_of_mass = "60, 0, 0 cm"
inertia = "0.5, 0.96, 0.96 kg m^2"
stiffness = "3 N m/rad"
damping = "0.1 N m s/rad"
lower_stop = "-20 deg"
upper_stop = "20 deg"
at_stop = "end"
[[wrench]]
on = "hub"
axes = "inertial"
force = "1, 2, -3 N"
point = "5, 0, 1 cm"
[[wrench]]
on = "rw.wheel"
force = "0, 0, 0.1 N"
moment = "1e-3, 0, 0 N m"
[run]
duration = "0.1 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1 kHz"
"#;

/// A scenario of a text.
fn scenario(text: &str) -> Scenario {
    from_toml("bus-1", text, Path::new("")).expect("a scenario").0
}

/// The unit of a scenario and its files of a version.
fn files(version: FmiVersion, scenario: &Scenario) -> (Fmu, Vec<(String, String)>) {
    let unit = Fmu::new(scenario).expect("a unit");
    let solver = precess_bake::solver(unit.spacecraft()).expect("a solver");
    let solver: Vec<_> = solver.into_iter().map(|file| (file.path, file.text)).collect();
    let files = unit.files(version, &solver);
    (unit, files)
}
