//! Scenarios with a flexible structure: against closed forms, against the library called
//! directly, and errors of every key.

mod direct;
mod errors;
mod known;
mod platform;
mod residual;
mod satellite;
#[path = "../../examples/satellite_modes.rs"]
mod satellite_modes;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use precess::engine::run;
use precess::file::{from_file, from_toml};
use precess::record::{End, Outcome, Samples};
use precess::scenario::Scenario;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

/// A file of `scenarios`.
fn file(name: &str) -> Scenario {
    from_file(&folder().join(name), &[]).unwrap_or_else(|errors| panic!("{errors}")).0
}

/// A text, with files beside those of `scenarios`.
fn text(text: &str) -> Scenario {
    from_toml("test.toml", text, &folder()).unwrap_or_else(|errors| panic!("{errors}")).0
}

/// A run to its end.
fn ran(scenario: &Scenario) -> (Samples, Outcome) {
    let mut samples = Samples::default();
    let outcome = run(scenario, &mut samples, &mut |_| ControlFlow::Continue(()));
    let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(matches!(outcome.end, End::Finished), "{}", outcome.end);
    (samples, outcome)
}

/// Columns by name, sample by sample.
fn columns<const N: usize>(samples: &Samples, names: [&str; N]) -> Vec<[f64; N]> {
    let header = samples.header.as_ref().expect("the run has begun");
    let indices = names.map(|name| header.index(name).unwrap_or_else(|| panic!("no {name}")));
    samples.rows.iter().map(|row| indices.map(|index| row[index])).collect()
}

/// A beam that is clamped at B and flexible in z, with one mode and a wheel at its tip.
const BEAM: &str = r#"
format = 1
[hub]
mass = "40 kg"
centre_of_mass = "5, 0, 1 cm"
inertia = "3, 8, 7 kg m^2"
[structure]
contains_devices = false
[[structure.point]]
name = "tip"
[[structure.node]]
name = "tip"
position = "1.2, 0, 0 m"
[[structure.node]]
name = "root"
position = "0, 0, 0 m"
[[structure.mode]]
frequency = "9 Hz"
damping = 0.01
linear_momentum = [0, 0, 1.2]
angular_momentum = [0, -1.1, 0]
[[structure.mode.shape]]
node = "tip"
translation = [0, 0, 1.1]
rotation = [0, -1.3, 0]
[[structure.mode]]
frequency = "25 Hz"
damping = 0.02
linear_momentum = [0, 0.7, 0]
angular_momentum = [0.1, 0, 0.2]
[[structure.mode.shape]]
node = "tip"
translation = [0, 0.9, 0]
rotation = [0.2, 0, 2.0]
[[device]]
name = "rw"
kind = "reaction_wheel"
node = "tip"
mount = { spin_axis = [1, 1, 0] }
imbalance = { static = "20 g cm", dynamic = "30 g cm^2" }
[device.wheel]
mass = "2 kg"
inertia = "40, 25, 25 kg cm^2"
rate = "900 rpm"
torque = { sine = "5 mN m", frequency = "3 Hz" }
damping = "1 mN m s/rad"
[run]
duration = "0.4 s"
[output]
rate = "500 Hz"
"#;
