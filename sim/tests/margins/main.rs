//! Margins of a scenario's loop: a rigid spacecraft against closed forms, poles and margins against python-control, lines of rotors and their aliases against runs, noise against a run of the recursion, what has no margins; sensors, filters and estimators in the loop.

mod closed_form;
mod judged;
mod lines;
mod measured;
mod moving;
mod noise;
mod rejected;
mod requirements;

use std::path::Path;

use precess::file::from_toml;
use precess::margins::analysis::{ControlLoop, chosen};
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
/// K, N m.
const K: f64 = 8.0;
/// P, N m s.
const P: f64 = 6.0;

/// A controller at 4 Hz with the gains above; more keys of its table.
fn controller(keys: &str) -> String {
    format!(
        "[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\n{keys}\n[controller.law]\nkind = \"mrp_feedback\"\n\
         attitude_gain = \"{K} N m\"\nrate_gain = \"{P} N m s\"\n\
         [controller.reference.attitude]\nquaternion = [1, 0, 0, 0]\nscalar = \"first\"\n\
         [run]\nduration = \"1 s\"\n[output]\nrate = \"4 Hz\"\n"
    )
}

fn read(text: &str) -> Scenario {
    let read = from_toml("test.toml", text, Path::new(""));
    read.unwrap_or_else(|errors| panic!("{errors}\n{text}")).0
}

fn loop_of(scenario: &Scenario) -> ControlLoop {
    let of = chosen(scenario, None).expect("a controller");
    ControlLoop::new(scenario, of, &[]).expect("a loop")
}
