//! Devices of a layout, one by one.

use std::fs;
use std::path::Path;

use precess::file::{Override, from_file, from_toml};
use precess::scenario::Scenario;
use precess_dynamics::JointStates as _;

use super::folder;

const PYRAMID: &str = r#"format = 1
[hub]
mass = "350 kg"
inertia = "80, 70, 60 kg m^2"
[[device]]
name = "cmg"
kind = "vscmg"
layout.pyramid = { count = 4, half_angle = "54.74 deg", radius = "30 cm" }
imbalance = { static = "1 g cm", phase = "10 deg" }
gimbal = { mass = "2 kg", inertia = "0.03, 0.025, 0.025 kg m^2", angle = "5 deg" }
wheel = { mass = "4 kg", inertia = "0.0288, 0.015, 0.015 kg m^2", rate = "3000 rpm" }
MEMBERS
[run]
duration = "1 s"
"#;

/// Angle and rate of the gimbals, then rates of the wheels, rounded to a thousandth.
fn joints(scenario: &Scenario) -> Vec<[f64; 3]> {
    let states: Vec<[f64; 2]> = scenario.initial.devices.states().collect();
    let pair = |pair: &[[f64; 2]]| {
        [pair[0][0].to_degrees(), pair[0][1].to_degrees(), pair[1][1] * 30.0 / std::f64::consts::PI]
            .map(|value| (1e3 * value).round() / 1e3)
    };
    states.chunks(2).map(pair).collect()
}

fn read(members: &str) -> Result<Scenario, String> {
    let text = PYRAMID.replace("MEMBERS", members);
    let read = from_toml("pyramid", &text, Path::new(""));
    read.map(|(scenario, _)| scenario).map_err(|errors| errors.to_string())
}

#[test]
fn one_device_of_a_layout_has_keys_of_its_own() {
    let own = "[[device.member]]\nname = \"cmg3\"\ngimbal.rate = \"2 deg/s\"\nwheel.rate = \"-100 rpm\"\n\
               imbalance.static = \"0 g cm\"\n";
    let scenario = read(own).expect("a scenario");
    let all = [5.0, 0.0, 3000.0];
    assert_eq!(joints(&scenario), [all, all, [5.0, 2.0, -100.0], all]);
    let imbalance = |name: &str| {
        let bodies = scenario.members().find(|(own, _)| *own == name).expect("a device").1.bodies();
        bodies.last().expect("a wheel").centre[1]
    };
    assert_eq!(imbalance("cmg3"), 0.0);
    assert!((imbalance("cmg1") - 1e-5 / 4.0).abs() < 1e-18);
    // What is written out is each device by itself.
    let (again, _) =
        from_toml("again", &scenario.source.filled, Path::new("")).expect("it is read");
    assert_eq!(joints(&again), joints(&scenario));
}

#[test]
fn an_override_names_one_device_of_a_layout() {
    let folder = folder("layouts");
    let path = folder.join("pyramid.toml");
    let own = "[[device.member]]\nname = \"cmg2\"\ngimbal.rate = \"1 deg/s\"\n";
    let all = [5.0, 0.0, 3000.0];
    for (members, key, expected) in [
        ("", "device.cmg4.gimbal.rate=\"7 deg/s\"", [all, all, all, [5.0, 7.0, 3000.0]]),
        (
            own,
            "device.cmg4.gimbal.rate=\"7 deg/s\"",
            [all, [5.0, 1.0, 3000.0], all, [5.0, 7.0, 3000.0]],
        ),
        (own, "device.cmg2.wheel.rate=\"50 rpm\"", [all, [5.0, 1.0, 50.0], all, all]),
        ("", "device.cmg.gimbal.rate=\"3 deg/s\"", [[5.0, 3.0, 3000.0]; 4]),
    ] {
        fs::write(&path, PYRAMID.replace("MEMBERS", members)).expect("it is written");
        let read = from_file(&path, &[Override::from(key)]);
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{key}: {errors}"));
        assert_eq!(joints(&scenario), expected, "{members}{key}");
    }
    for (key, part) in [
        ("device.cmg9.gimbal.rate=\"7 deg/s\"", "no device of the layout is named `cmg9`"),
        ("device.cmg0.gimbal.rate=\"7 deg/s\"", "nothing is named `cmg0`"),
        ("device.cmgx.gimbal.rate=\"7 deg/s\"", "nothing is named `cmgx`"),
        ("device.cmg1.gimbel.rate=\"7 deg/s\"", "unknown key"),
    ] {
        let shown = from_file(&path, &[Override::from(key)]).expect_err("an error").to_string();
        assert!(shown.contains(part), "{key}: {part} in\n{shown}");
    }
}

#[test]
fn a_member_that_is_none_is_refused_with_its_place() {
    let member = |keys: &str| format!("[[device.member]]\n{keys}\n");
    for (members, parts) in [
        (member("name = \"cmg5\""), ["no device of the layout is named `cmg5`", "^^^"]),
        (member("gimbal.rate = \"1 deg/s\""), ["name` is missing", "cmg1"]),
        (member("name = \"cmg1\"\nposition = \"1, 2, 3 cm\""), ["unknown key", "position"]),
        (member("name = \"cmg1\"\nwheel.rate = \"1 kg\""), ["an angular rate is wanted", "^^^"]),
        (
            format!("{}{}", member("name = \"cmg1\""), member("name = \"cmg1\"")),
            ["are named `cmg1`", "^^^"],
        ),
    ] {
        let shown = read(&members).expect_err("an error");
        for part in parts {
            assert!(shown.contains(part), "{members}: {part} in\n{shown}");
        }
    }
    let single = PYRAMID
        .replace(
            "layout.pyramid = { count = 4, half_angle = \"54.74 deg\", radius = \"30 cm\" }\n",
            "",
        )
        .replace("MEMBERS", "[[device.member]]\nname = \"cmg1\"");
    let shown = from_toml("one", &single, Path::new("")).expect_err("an error").to_string();
    assert!(shown.contains("only a layout has members"), "{shown}");
}

/// A quantity over a profile would leave the joint free where its motion was prescribed.
#[test]
fn an_override_does_not_take_a_motion_away() {
    let folder = folder("motion-away");
    let path = folder.join("pyramid.toml");
    let member = "[[device.member]]\nname = \"cmg2\"\n\
                  gimbal.rate = { ramp = \"0, 1 rad/s\", from = \"0 s\", to = \"1 s\" }\n";
    fs::write(&path, PYRAMID.replace("MEMBERS", member)).expect("it is written");
    let refused = from_file(&path, &[Override::from("device.cmg2.gimbal.rate=\"5 deg/s\"")]);
    let shown = refused.expect_err("an error").to_string();
    for part in ["`rate` is a profile, which prescribes the motion", "{ constant = .. }"] {
        assert!(shown.contains(part), "{part} in\n{shown}");
    }
    // One number of its list.
    let number = "device.cmg2.gimbal.rate.ramp[2]=\"0.5 rad/s\"";
    let (scenario, _) = from_file(&path, &[Override::from(number)]).expect("a scenario");
    assert!(scenario.source.filled.contains("0.5 rad/s^2"), "{}", scenario.source.filled);
    // A profile of another kind replaces it.
    let constant = "device.cmg2.gimbal.rate={ constant = \"5 deg/s\" }";
    let (scenario, _) = from_file(&path, &[Override::from(constant)]).expect("a scenario");
    assert_eq!(joints(&scenario)[1], [5.0, 5.0, 3000.0]);
    // Another initial rate of a device without one stands.
    assert!(from_file(&path, &[Override::from("device.cmg1.gimbal.rate=\"5 deg/s\"")]).is_ok());
}
