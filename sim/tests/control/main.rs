//! Controllers in scenarios: a loop with delay against its exact solution, the order at one time, sensors and estimator, limits of motors, what replaces a controller, controllers of one's own, written scenarios, errors with their places.

mod accelerometer;
mod campaigns;
mod errors;
mod files;
mod limits;
mod own;
mod sampling;
mod sensors;
mod steered;

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_toml;
use precess::record::{Outcome, Samples};
use precess::scenario::Scenario;

/// Three balanced wheels at B, along the axes of a hub whose centre of mass is there.
const BUS: &str = r#"format = 1
[hub]
mass = "100 kg"
inertia = "12, 11, 10 kg m^2"
[[device]]
name = "rwx"
kind = "balanced_reaction_wheel"
mount = { spin_axis = [1, 0, 0] }
wheel = { mass = "2 kg", inertia = "0.02, 0.01, 0.01 kg m^2" }
[[device]]
name = "rwy"
kind = "balanced_reaction_wheel"
mount = { spin_axis = [0, 1, 0] }
wheel = { mass = "2 kg", inertia = "0.02, 0.01, 0.01 kg m^2" }
[[device]]
name = "rwz"
kind = "balanced_reaction_wheel"
mount = { spin_axis = [0, 0, 1] }
wheel = { mass = "2 kg", inertia = "0.02, 0.01, 0.01 kg m^2" }
"#;

/// Wheel and hub together about z, kg m².
const I_Z: f64 = 10.0 + 0.02 + 0.01 + 0.01;
/// K, N m.
const K: f64 = 8.0;
/// P, N m s.
const P: f64 = 6.0;

/// A controller at 4 Hz with the gains above; more keys of its table, and of its law.
fn controller(keys: &str, law: &str) -> String {
    format!(
        "[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\n{keys}\n[controller.law]\nkind = \"mrp_feedback\"\n\
         attitude_gain = \"{K} N m\"\nrate_gain = \"{P} N m s\"\n{law}\n\
         [controller.reference.attitude]\nquaternion = [1, 0, 0, 0]\nscalar = \"first\"\n"
    )
}

fn read(text: &str) -> Scenario {
    let read = from_toml("test.toml", text, Path::new(""));
    read.unwrap_or_else(|errors| panic!("{errors}\n{text}")).0
}

fn ran(scenario: &Scenario) -> (Outcome, Samples) {
    let mut samples = Samples::default();
    let outcome = run(scenario, &mut samples, &mut |_| ControlFlow::Continue(()));
    (outcome.unwrap_or_else(|error| panic!("{error}")), samples)
}

fn column(samples: &Samples, name: &str) -> Vec<f64> {
    samples.column(name).unwrap_or_else(|| panic!("no column {name}"))
}
