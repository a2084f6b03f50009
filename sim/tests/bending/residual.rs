//! Residual flexibility: modes that are left out, by their static response.

use super::{columns, folder, ran, text};
use precess::file::from_toml;
use precess::jitter::device::Steady;
use precess::jitter::model::{Model, Output};
use precess::structure::dynamic_mass::Motor;

/// Angular frequency, rad/s, and shape at the tip, kg^-1/2, of each mode.
const MODES: [[f64; 2]; 3] = [[20.0, 0.9], [130.0, -0.8], [400.0, 0.7]];
/// The force on the tip, N.
const FORCE: f64 = 0.5;

/// A panel with its modes along z, a wheel at its tip.
fn panel(keys: &str, rate: f64) -> String {
    use std::fmt::Write as _;
    let mut text = format!(
        r#"
format = 1
[hub]
mass = "1e9 kg"
inertia = "1e9, 1e9, 1e9 kg m^2"
{}
[structure]
contains_devices = false
{keys}
[[structure.point]]
name = "tip"
[[structure.node]]
name = "tip"
position = "1.2, 0, 0 m"
"#,
        if rate == 0.0 { "mode = \"fixed\"" } else { "" }
    );
    for [frequency, shape] in MODES {
        let _ = writeln!(
            text,
            "[[structure.mode]]\nfrequency = \"{frequency} rad/s\"\ndamping = 0.3\n\
             [[structure.mode.shape]]\nnode = \"tip\"\ntranslation = [0, 0, {shape}]"
        );
    }
    let _ = writeln!(
        text,
        r#"
[[device]]
name = "rw"
kind = "reaction_wheel"
node = "tip"
mount = {{ spin_axis = [1, 0, 0] }}
imbalance = {{ static = "{} g cm" }}
[device.wheel]
mass = "0.2 kg"
inertia = "4, 2.5, 2.5 kg cm^2"
rate = "{rate} rad/s"
[[wrench]]
on = "tip"
force = "0, 0, {FORCE} N"
[run]
duration = "4 s"
[output]
rate = "2 Hz"
"#,
        if rate == 0.0 { 0.0 } else { 2.0 }
    );
    text
}

const ONE_MODE: &str = "modes = 1\nresidual_flexibility = true";

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_constant_force_bends_one_mode_with_the_rest_as_it_bends_all() {
    let compliance: f64 = MODES.iter().map(|[w, phi]| (phi / w).powi(2)).sum();
    let first = (MODES[0][1] / MODES[0][0]).powi(2);
    for (keys, expected) in [("", compliance), (ONE_MODE, compliance), ("modes = 1", first)] {
        let (samples, _) = ran(&text(&panel(keys, 0.0)));
        let [tip] = *columns(&samples, ["tip.displacement_z"]).last().expect("a sample");
        let miss = (tip / (FORCE * expected) - 1.0).abs();
        println!("{keys:?}: {tip:e} m, {miss:.1e}");
        // exp(-0.3 w t), and the integrator's tolerance.
        assert!(miss < 1e-8, "{keys:?}: {miss:e}");
    }
    assert!(first / compliance < 0.99, "the modes left out matter");
}

/// Far below the modes left out, what they miss falls with the square of the frequency.
#[test]
fn lines_below_the_modes_left_out_are_those_of_all_modes() {
    let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: Some(&[]) };
    let along_z = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let line = |keys: &str, speed: f64| {
        let outputs =
            [Output { name: "tip z".to_owned(), terms: vec![("tip".to_owned(), along_z)] }];
        let scenario = text(&panel(keys, 100.0));
        let model = Model::new(&scenario, &outputs, &steady).expect("valid");
        model.lines(speed).expect("bounded")[0].values[0]
    };
    // Between the mode that is kept and those left out, where the static part of both counts.
    let errors = [26.0, 13.0].map(|speed| {
        let [all, with, without] = ["", ONE_MODE, "modes = 1"].map(|keys| line(keys, speed));
        [(with - all).norm() / all.norm(), (without - all).norm() / all.norm()]
    });
    println!("{errors:?}");
    let [[at, without], [at_half, _]] = errors;
    assert!(at < 0.2 * without, "{errors:?}");
    assert!((2.5..8.0).contains(&(at / at_half)), "{errors:?}");
}

#[test]
fn residual_coordinates_are_written_out_and_counted() {
    let scenario = text(&panel(ONE_MODE, 0.0));
    let structure = scenario.structure.as_ref().expect("a structure");
    // Both modes left out move the tip along z: one direction.
    assert_eq!((structure.modes.len(), structure.residual), (2, 1));
    assert_eq!(structure.massive().len(), 1);
    let filled = scenario.source.filled.clone();
    let again = from_toml("test.toml", &filled, &folder());
    let (again, _) = again.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(again.source.filled, filled);
    assert_eq!(again.structure, scenario.structure);
}

#[test]
fn errors_name_the_key() {
    let said = |text: &str| {
        let read = from_toml("test.toml", text, &folder());
        read.map_or_else(|errors| errors.to_string(), |_| String::new())
    };
    let whole = panel(ONE_MODE, 0.0);
    let last = "frequency = \"400 rad/s\"\n";
    for (text, part) in [
        (panel("residual_flexibility = true", 0.0), "no mode is left out"),
        (panel("residual_damping = 0.1", 0.0), "there are no residual coordinates"),
        (panel(&format!("{ONE_MODE}\nresidual_damping = 1"), 0.0), "a damping ratio of 1"),
        (whole.replace("contains_devices = false", "contains_devices = true"), "residual"),
        (
            panel("", 0.0).replacen("damping = 0.3", "damping = 0.3\nresidual = true", 1),
            "a residual coordinate is before a mode",
        ),
        (
            panel("", 0.0)
                .replace(last, &format!("{last}residual = true\nlinear_momentum = [0, 0, 1]\n")),
            "momentum",
        ),
    ] {
        let shown = said(&text);
        assert!(shown.contains(part), "{part} in\n{shown}\nof\n{text}");
    }
}
