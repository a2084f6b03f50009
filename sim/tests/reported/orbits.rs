//! Attitudes from the orbital frame.

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine;
use precess::file::from_toml;
use precess::record::Histories;

/// A sphere in a circular orbit of a radius of 7000 km, tilted against the axes of N: no torque of gravity acts.
const SPHERE: &str = r#"format = 1
[hub]
mass = "500 kg"
inertia = "100, 100, 100 kg m^2"
[gravity]
central = "4e14 m^3/s^2"
[initial]
position = "4.2, 5.6, 0 Mm"
velocity = "0, 0, 7559.289460184545 m/s"
relative_to = "orbit"
attitude = { euler = "20, -10, 5 deg", sequence = "ZYX", direction = "N to B" }
OMEGA
[run]
duration = "900 s"
[output]
columns = ["orbit", "omega"]
"#;

fn run(omega: &str) -> impl Fn(&str) -> Vec<f64> + use<> {
    let text = SPHERE.replace("OMEGA", omega);
    let (scenario, _) = from_toml("sphere", &text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    let mut found = Histories::default();
    engine::run(&scenario, &mut found, &mut |_| ControlFlow::Continue(())).expect("it runs");
    move |name: &str| {
        let header = found.header.as_ref().expect("a run");
        let index = header.columns.iter().position(|column| column.name == name);
        found.columns[index.unwrap_or_else(|| panic!("no {name}"))].clone()
    }
}

#[test]
fn a_sphere_at_rest_in_the_orbital_frame_stays_so() {
    let columns = run("");
    for (name, wanted) in [("orbit.yaw", 20.0), ("orbit.pitch", -10.0), ("orbit.roll", 5.0)] {
        let values = columns(name);
        assert!((values[0].to_degrees() - wanted).abs() < 1e-9, "{name}: {}", values[0]);
        // At rest in the frame at first, and no torque: its inertial rate stays that of the frame.
        for value in &values {
            assert!((value.to_degrees() - wanted).abs() < 1e-5, "{name}: {}", value.to_degrees());
        }
    }
    for axis in ["x", "y", "z"] {
        let most =
            columns(&format!("orbit.omega_{axis}")).iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        assert!(most < 1e-9, "{axis}: {most:e}");
    }
    // The orbital rate, v / r.
    let rate = 7_559.289_460_184_545 / 7e6;
    let omega = ["x", "y", "z"].map(|axis| columns(&format!("omega_{axis}"))[0]);
    let size = omega.iter().map(|w| w * w).sum::<f64>().sqrt();
    assert!((size / rate - 1.0).abs() < 1e-12, "{size:e} {rate:e}");
}

#[test]
fn a_rate_with_respect_to_the_frame_is_added_to_its_own() {
    let columns = run("angular_velocity = \"1, 2, -3 mrad/s\"");
    for (axis, wanted) in [("x", 1e-3), ("y", 2e-3), ("z", -3e-3)] {
        let first = columns(&format!("orbit.omega_{axis}"))[0];
        assert!((first - wanted).abs() < 1e-15, "{axis}: {first:e}");
    }
}

#[test]
fn without_an_orbit_there_is_no_frame() {
    let text =
        SPHERE.replace("velocity = \"0, 0, 7559.289460184545 m/s\"\n", "").replace("OMEGA", "");
    let shown = from_toml("none", &text, Path::new("")).expect_err("an error").to_string();
    for part in ["there is no orbital frame", "give the `position` and `velocity`", "^^^"] {
        assert!(shown.contains(part), "{part} in\n{shown}");
    }
    let without =
        SPHERE.replace("[gravity]\ncentral = \"4e14 m^3/s^2\"\n", "").replace("OMEGA", "");
    let shown = from_toml("none", &without, Path::new("")).expect_err("an error").to_string();
    assert!(shown.contains("`orbit` is no column and no group of columns"), "{shown}");
}

/// Position and velocity of the centre of mass, of a hub that turns about another point.
#[test]
fn the_state_of_the_centre_of_mass_gives_that_of_b() {
    let text = |key: &str| {
        format!(
            "format = 1\n[hub]\nmass = \"10 kg\"\ncentre_of_mass = \"10, 0, 0 cm\"\ninertia = \"1, 1, 1 kg m^2\"\n\
             [initial]\nposition = \"1, 2, 3 m\"\nvelocity = \"4, 5, 6 m/s\"\nangular_velocity = \"0, 0, 2 rad/s\"\n\
             attitude = {{ axis = [0, 0, 1], angle = \"90 deg\" }}\n{key}[run]\nduration = \"1 s\"\n\
             [[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\nposition = \"0, 50, 0 cm\"\n\
             wheel = {{ mass = \"10 kg\", inertia = \"2, 1, 1 g m^2\" }}\n"
        )
    };
    let state = |key: &str| {
        let read = from_toml("cm", &text(key), Path::new(""));
        read.unwrap_or_else(|errors| panic!("{errors}")).0.initial
    };
    assert_eq!(state("state_of = \"B\"\n"), state(""));
    let found = state("state_of = \"centre_of_mass\"\n");
    // c = (5, 25) cm in B, turned by 90 degrees: (-25, 5) cm in N; omega x c = (-10, -50) cm/s.
    let wanted = [1.25, 1.95, 3.0, 4.1, 5.5, 6.0];
    let numbers = found.r_b_n.iter().chain(found.r_b_n_dot.iter());
    for (found, wanted) in numbers.zip(wanted) {
        assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
    }
}

/// Roll, pitch and yaw from N.
#[test]
fn euler_angles_are_columns() {
    let text = SPHERE
        .replace("relative_to = \"orbit\"\n", "")
        .replace("\"orbit\", ", "\"euler\", ")
        .replace("900 s", "1 s")
        .replace("OMEGA", "");
    let (scenario, _) = from_toml("euler", &text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    let mut found = Histories::default();
    engine::run(&scenario, &mut found, &mut |_| ControlFlow::Continue(())).expect("it runs");
    let header = found.header.expect("a run");
    for (name, wanted) in [("yaw", 20.0), ("pitch", -10.0), ("roll", 5.0)] {
        let index = header.columns.iter().position(|column| column.name == name).expect("a column");
        assert!((found.columns[index][0].to_degrees() - wanted).abs() < 1e-12, "{name}");
    }
}

/// Hub and wheel of equal moments in sum, so that no torque of gravity acts: the motor leaves the momentum about the centre.
#[test]
fn the_momentum_about_the_centre_of_mass_stays_while_a_wheel_is_driven() {
    let text = SPHERE
        .replace("[hub]", "title = \"wheel\"\n[hub]")
        .replace("100, 100, 100", "99.8, 99.9, 99.9")
        .replace(
            "[gravity]",
            "[[device]]\nname = \"rw\"\nkind = \"balanced_reaction_wheel\"\n[device.wheel]\nmass = \"4 kg\"\n\
             inertia = \"0.2, 0.1, 0.1 kg m^2\"\nrate = \"50 rad/s\"\ntorque = \"10 mN m\"\n[gravity]",
        )
        .replace("relative_to = \"orbit\"\nattitude = { euler = \"20, -10, 5 deg\", sequence = \"ZYX\", direction = \"N to B\" }\n", "")
        .replace("OMEGA", "angular_velocity = \"1, 2, -3 mrad/s\"");
    let (scenario, _) = from_toml("wheel", &text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    let mut found = Histories::default();
    engine::run(&scenario, &mut found, &mut |_| ControlFlow::Continue(())).expect("it runs");
    let column = |name: &str| {
        let header = found.header.as_ref().expect("a run");
        let index = header.columns.iter().position(|column| column.name == name);
        &found.columns[index.unwrap_or_else(|| panic!("no {name}"))]
    };
    // N and B have the same axes at first: I omega and the wheel's 0.2 kg m^2 x 50 rad/s.
    for (axis, first) in [("x", 0.1 + 10.0), ("y", 0.2), ("z", -0.3)] {
        let momentum = column(&format!("orbit.momentum_about_centre_{axis}"));
        assert!((momentum[0] - first).abs() < 1e-14, "{axis}: {}", momentum[0]);
        let drift = momentum.iter().fold(0.0_f64, |most, value| most.max((value - first).abs()));
        assert!(drift < DRIFT, "{axis}: {drift:e}");
    }
}

/// Of a momentum of 10 N m s by the tolerance of the run, over 900 s.
const DRIFT: f64 = 1e-7;
