//! Joints whose rate or angle is a profile.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::Path;

use precess::engine;
use precess::file::from_toml;
use precess::record::{End, Histories};

const GYRO: &str = r#"format = 1
[hub]
mass = "40 kg"
inertia = "3, 4, 5 kg m^2"
[[device]]
name = "cmg"
kind = "vscmg"
[device.gimbal]
mass = "0.8 kg"
inertia = "2e-3, 2e-3, 1.5e-3 kg m^2"
MOTION
[device.wheel]
mass = "1.2 kg"
inertia = "1.8e-3, 1e-3, 1e-3 kg m^2"
rate = "6000 rpm"
[run]
duration = "2 s"
[output]
rate = "200 Hz"
columns = ["cmg"]
"#;

/// Time, angle and rate of the gimbal over the run.
fn gimbal(motion: &str) -> [Vec<f64>; 3] {
    let text = GYRO.replace("MOTION", motion);
    let read = from_toml("gyro", &text, Path::new(""));
    let (scenario, warnings) = read.unwrap_or_else(|errors| panic!("{motion}: {errors}"));
    assert!(warnings.all.is_empty(), "{motion}: {warnings}");
    // It comes back from its record.
    let again = from_toml("again", &scenario.source.filled, Path::new(""));
    let (again, _) = again.unwrap_or_else(|errors| panic!("{motion}: {errors}"));
    assert_eq!(again.drives, scenario.drives, "{motion}");
    let mut found = Histories::default();
    let outcome = engine::run(&scenario, &mut found, &mut |_| ControlFlow::Continue(()));
    assert!(matches!(outcome.expect("it runs").end, End::Finished), "{motion}");
    let header = found.header.as_ref().expect("a run");
    let column = |name: &str| {
        let index = header.columns.iter().position(|column| column.name == name);
        found.columns[index.expect("a column")].clone()
    };
    ["time", "cmg.gamma", "cmg.gamma_dot"].map(column)
}

#[test]
fn a_joint_follows_the_profile_of_its_rate_or_angle() {
    type Motion = fn(f64) -> f64;
    let triangle: Motion = |t| {
        let knots = [[0.0, 0.0], [0.5, 0.5], [1.5, -0.5], [2.0, 0.0]];
        let pair = knots.windows(2).find(|pair| t <= pair[1][0]).unwrap_or(&knots[2..]);
        pair[0][1] + (t - pair[0][0]) / (pair[1][0] - pair[0][0]) * (pair[1][1] - pair[0][1])
    };
    let rates: [(&str, Motion); 4] = [
        (
            "rate = { times = \"0, 0.5, 1.5, 2 s\", values = \"0, 0.5, -0.5, 0 rad/s\", interpolation = \"linear\" }",
            triangle,
        ),
        ("rate = { ramp = \"0.1, 0.4 rad/s\", from = \"0.5 s\", to = \"1 s\" }", |t| {
            0.1 + 0.3 * ((t - 0.5) / 0.5).clamp(0.0, 1.0)
        }),
        ("rate = { constant = \"0.2 rad/s\" }", |_| 0.2),
        ("rate = { sine = \"0.3 rad/s\", frequency = \"2 Hz\", phase = \"90 deg\" }", |t| {
            0.3 * (2.0 * TAU * t).cos()
        }),
    ];
    for (keys, wanted) in rates {
        let [time, _, rate] = gimbal(keys);
        for (t, found) in time.iter().zip(&rate) {
            assert!((found - wanted(*t)).abs() < 1e-10, "{keys}: {found} at {t}");
        }
    }
    // The angle with its slope, which is the rate from the start on.
    let [time, angle, rate] = gimbal(
        "angle = { sine = \"20 deg\", frequency = \"0.5 Hz\", mean = \"10 deg\" }\nrate = \"1.0966227112321508 rad/s\"",
    );
    for ((t, angle), rate) in time.iter().zip(&angle).zip(&rate) {
        let (sine, cosine) = (0.5 * TAU * t).sin_cos();
        let wanted =
            [(10.0 + 20.0 * sine).to_radians(), 20.0_f64.to_radians() * 0.5 * TAU * cosine];
        assert!((angle - wanted[0]).abs() < 1e-9, "{angle} at {t}");
        assert!((rate - wanted[1]).abs() < 1e-9, "{rate} at {t}");
    }
}

#[test]
fn a_motion_that_takes_an_infinite_torque_or_is_said_twice_is_refused() {
    let table = "times = \"0, 1 s\", values = \"0, 1";
    for (keys, parts) in [
        (
            format!("rate = {{ {table} rad/s\", interpolation = \"hold\" }}"),
            ["the `rate` jumps at 1 s, from 0 to 1 rad/s", "use a ramp"],
        ),
        (
            "rate = { step = \"1 rad/s\", at = \"0.3 s\" }".to_owned(),
            ["jumps at 0.3 s, from 0 to 1 rad/s", "^^^"],
        ),
        (
            "rate = { constant = \"1 rad/s\", from = \"0 s\", to = \"1 s\" }".to_owned(),
            ["jumps at 1 s, from 1 to 0 rad/s", "^^^"],
        ),
        (
            format!("angle = {{ {table} rad\", interpolation = \"linear\" }}"),
            ["the slope of `angle` jumps at 1 s, from 1 to 0 rad/s", "prescribe the rate"],
        ),
        (
            "rate = { chirp = \"1 rad/s\", frequency = \"1, 5 Hz\", from = \"0 s\", to = \"1 s\" }"
                .to_owned(),
            ["the derivative of `rate`, a chirp", "prescribe the `acceleration`"],
        ),
        (
            "angle = { sine = \"1 rad\", frequency = \"1 Hz\" }\nrate = \"1 rad/s\"".to_owned(),
            ["`rate` is 1 rad/s, the profile begins with 6.28", "remove it"],
        ),
        (
            "angle = { constant = \"1 rad\" }\nrate = { constant = \"0 rad/s\" }".to_owned(),
            ["`angle` and `rate` are both profiles", "keep one of them"],
        ),
        (
            "rate = { constant = \"1 rad/s\" }\ntorque = \"1 N m\"".to_owned(),
            ["a joint whose `rate` is a profile has no `torque`", "remove it"],
        ),
        ("rate = { constant = \"1 rad/s\" }\nlocked = true".to_owned(), ["has no `locked`", "^^^"]),
        ("rate = { constant = \"1 N\" }".to_owned(), ["an angular rate is wanted", "^^^"]),
    ] {
        let text = GYRO.replace("MOTION", &keys);
        let shown = from_toml("gyro", &text, Path::new("")).expect_err("an error").to_string();
        for part in parts {
            assert!(shown.contains(part), "{keys}: {part} in\n{shown}");
        }
    }
}
