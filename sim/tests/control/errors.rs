//! What is wrong with a controller is said with its place.

use std::path::Path;

use precess::file::from_toml;
use precess::scenario::ControlLaw;

use super::{BUS, controller};

const RUN: &str = "[run]\nduration = \"1 s\"\n";

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let good = format!("{BUS}{}{RUN}", controller("", ""));
    let wheel = "wheel = { mass = \"2 kg\"";
    let panel = "[[device]]\nname = \"panel\"\nkind = \"hinged_panel\"\npanel = { mass = \"1 kg\", inertia = \"1, 1, 1 kg m^2\" }\n";
    let with = |keys: &str| format!("{BUS}{}{RUN}", controller(keys, ""));
    let slew = |angle: &str| {
        let turn = format!(
            "reference = {{ kind = \"slew\", jerk_limit = \"1 deg/s^3\", turn = {{ axis = [0, 0, 1], angle = \"{angle}\" }} }}"
        );
        let keys = controller(&turn, "");
        let keys = keys.split("[controller.reference.attitude]").next().unwrap_or_default();
        format!("{BUS}{keys}{RUN}")
    };
    assert!(from_toml("test.toml", &slew("-180 deg"), Path::new("")).is_ok());
    for (text, message, place) in [
        (good.replace("\"4 Hz\"", "\"0 Hz\""), "0 Hz is not above 0 Hz and at most", "\"0 Hz\""),
        (good.replace("\"4 Hz\"", "\"-4 Hz\""), "-4 Hz is not above 0 Hz", "\"-4 Hz\""),
        (with("delay = \"26 s\""), "26 s is outside 0 s to 25 s, 100 samples", "\"26 s\""),
        (with("offset = \"2 s\""), "2 s is outside the run, 0 s to 1 s", "\"2 s\""),
        (with("devices = [\"rw\"]"), "no device is named `rw`", "[\"rw\"]"),
        (
            with("devices = [\"panel\"]") + panel,
            "`panel` has no gimbal and no wheel with a motor",
            "[\"panel\"]",
        ),
        (
            good.replacen(wheel, "wheel = { torque = \"1 mN m\", mass = \"2 kg\"", 1),
            "`rwx.wheel` has a torque of its own",
            "",
        ),
        (
            good.replacen(wheel, "wheel = { locked = true, mass = \"2 kg\"", 1),
            "`rwx.wheel` is locked",
            "",
        ),
        (good.replace("\"aocs\"", "\"rwx\""), "`rwx` names other columns", "\"rwx\""),
        (good.replace("\"aocs\"", "\"omega\""), "`omega` names other columns", "\"omega\""),
        (good.replace("\"8 N m\"", "\"0 N m\""), "attitude gain is 0", ""),
        (good.replace("\"8 N m\"", "\"8 N\""), "is a force, where a torque is wanted", "\"8 N\""),
        (good.replace("mrp_feedback", "lqr"), "`controller.aocs.law.kind` is \"lqr\"", "\"lqr\""),
        (
            with("allocation = { lambda = 0.1 }"),
            "`lambda` is of a singularity-robust inverse",
            "0.1",
        ),
        (slew("200 deg"), "200 deg is more than 180 deg, and a slew goes", "\"200 deg\""),
        (slew("-270 deg"), "-270 deg is more than 180 deg, and a slew goes", "\"-270 deg\""),
        (with("servo = { rate = \"1 Hz\" }"), "1 Hz is outside 4 Hz", "\"1 Hz\""),
        (
            format!(
                "{BUS}[[at]]\ntime = \"0.5 s\"\njoint = \"rwx.wheel\"\ncontrolled = true\n{RUN}"
            ),
            "no controller commands `rwx.wheel`",
            "",
        ),
    ] {
        is_said(&text, message, place);
    }
}

/// That a text has an error with a message, at a place.
fn is_said(text: &str, message: &str, place: &str) {
    let found = from_toml("test.toml", text, Path::new(""));
    let errors = found.err().unwrap_or_else(|| panic!("{message}: no error\n{text}"));
    let shown = errors.to_string();
    let error = errors.all.iter().find(|error| error.message.contains(message));
    let error = error.unwrap_or_else(|| panic!("{message} in\n{shown}"));
    if !place.is_empty() {
        let span = error.span.clone().unwrap_or_else(|| panic!("{message}: no place\n{shown}"));
        assert_eq!(text.get(span.range), Some(place), "{message}\n{shown}");
    }
}

#[test]
fn what_is_wrong_with_sensors_is_said_with_its_place() {
    let with = |keys: &str| format!("{BUS}{}{RUN}", controller(keys, ""));
    for (text, message, place) in [
        (
            with("sensors = { gyro = { angle_random_walk = \"0.1 deg/sqrt(h)\" } }"),
            "`controller.aocs.sensors.seed` is missing",
            "",
        ),
        (
            with("sensors = { gyro = { angle_random_walk = \"0.1 deg/h\" } }"),
            "is no angle over the root of a time",
            "\"0.1 deg/h\"",
        ),
        (
            with("sensors = { gyro = { angle_random_walk = \"0.1 m/sqrt(h)\" } }"),
            "is no angle over the root of a time",
            "\"0.1 m/sqrt(h)\"",
        ),
        (
            with("sensors = { gyro = { quantum = \"-1 deg/s\" } }"),
            "quantum is -0.017453292519943295; it must be finite and not negative",
            "",
        ),
        (with("sensors = { gyro = { node = \"tip\" } }"), "there is no structure", "\"tip\""),
        (
            with("sensors = { star_tracker = { rate = \"5 Hz\" } }"),
            "5 Hz is not above 0 Hz and at most 4 Hz",
            "\"5 Hz\"",
        ),
        (
            with("sensors = { star_tracker = { latency = \"26 s\" } }"),
            "26 s is outside 0 s to 25 s, 100 samples",
            "\"26 s\"",
        ),
        (
            with("filter = [{ kind = \"low_pass\", frequency = \"2 Hz\" }]"),
            "is not below half of the sampling rate",
            "",
        ),
        (
            with(
                "sensors.seed = 1\nestimator = { attitude_deviation = \"1 deg\", bias_deviation = \"1 deg/h\" }",
            ),
            "it estimates from a gyro and a star tracker",
            "",
        ),
        (with("dumping = { gain = \"0 1/s\" }"), "gain of momentum dumping is 0", ""),
    ] {
        is_said(&text, message, place);
    }
}

/// A file has gains of axes of B only, so a scenario has no others: written and read back they would be lost.
#[test]
fn gains_beside_the_diagonal_are_rejected() {
    let mut scenario = super::read(&format!("{BUS}{}{RUN}", controller("", "")));
    assert!(scenario.check().is_empty());
    let ControlLaw::MrpFeedback { gains, .. } = &mut scenario.controllers[0].law else {
        panic!("another law")
    };
    gains.rate[(0, 1)] = 0.5;
    let errors = scenario.check();
    let shown: Vec<_> = errors.iter().map(ToString::to_string).collect();
    assert_eq!(shown.len(), 1, "{shown:?}");
    assert!(shown[0].contains("law.rate_gain") && shown[0].contains("0.5"), "{shown:?}");
}
