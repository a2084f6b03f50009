//! Which manoeuvre tells what a record does not.

use std::path::Path;

use precess::file::from_toml;
use precess::file::identification_example as example;
use precess::identify::{Design, IdentifyError, Manoeuvre, Unknown, design};
use precess::scenario::Scenario;

use super::identified;
use super::recovered::unknowns;
use super::untold::{found, frictionless, known, record};

const NAMES: [&str; 2] = ["rest", "slew"];

/// The scenario of the example without friction, that holds its attitude or turns by ten degrees, for 8 s.
fn manoeuvres() -> [Scenario; 2] {
    let text = example::SCENARIO.replace("damping = \"1e-5 N m s/rad\"\n", "");
    let text = text.replace("duration = \"20 s\"", "duration = \"8 s\"");
    let slew = "[controller.reference]\nkind = \"slew\"\nturn = { axis = [1, 2, 3], angle = \"10 deg\" }\n\
                acceleration_limit = \"0.3 deg/s^2\"\n\n[controller.sensors]";
    let slew = text.replace("[controller.sensors]", slew);
    let read = |text: &str| from_toml("bus", text, Path::new("")).expect("a scenario").0;
    [read(&text), read(&slew)]
}

fn designed(of: &[Unknown], flown: &[Scenario; 2]) -> Result<Design, IdentifyError> {
    let scenario = frictionless();
    let text = record(&scenario, 0.0);
    let unknowns = known(of, &unknowns(&scenario));
    let found = identified(&scenario, &text, &unknowns).expect("estimates");
    let [rest, slew] = [0, 1].map(|k| Manoeuvre { name: NAMES[k], scenario: &flown[k] });
    design(&scenario, &unknowns, &found, &[rest, slew])
}

/// A record without torques does not tell the moments of the hub. Rest does not either; a slew does.
#[test]
fn the_manoeuvre_that_tells_the_moments_of_the_hub_is_named() {
    let wheels = [0, 1, 2, 3].map(Unknown::Imbalance);
    let all: Vec<_> = wheels.into_iter().chain([Unknown::HubMoments]).collect();
    let quiet = found(&frictionless(), 0.0, &all);
    let of = designed(&all, &manoeuvres()).expect("a design");
    assert_eq!(of.manoeuvres, NAMES);
    assert!(of.durations.iter().all(|length| (length - 8.0).abs() < 0.1), "{:?}", of.durations);
    let moments = |name: &String| name.starts_with("hub.i_b_bc_");
    let untold: Vec<_> = of
        .directions
        .iter()
        .filter(|of| of.direction.changes.first().is_some_and(|(name, ..)| moments(name)))
        .collect();
    assert!(!untold.is_empty() && quiet.untold.len() >= untold.len(), "{:?}", of.directions);
    for direction in untold {
        assert!(!direction.is_told_by(0) && direction.is_told_by(1), "{direction:?}");
    }
    for number in &of.numbers {
        // More readings tell more.
        assert!(number.with.iter().all(|with| *with <= 1.001 * number.alone), "{number:?}");
        if moments(&number.name) {
            assert!(number.with[1] < 0.1 * number.with[0], "{number:?}");
        }
    }
}

#[test]
fn a_manoeuvre_of_another_spacecraft_is_an_error() {
    let error = designed(&[Unknown::GyroBias], &manoeuvres()).expect_err("nothing of it");
    assert_eq!(error, IdentifyError::NothingOfSpacecraft);
    let mut flown = manoeuvres();
    flown[0].names[0] = "other".to_owned();
    let error = designed(&[Unknown::HubMoments], &flown).expect_err("another spacecraft");
    let text = error.to_string();
    assert!(text.contains("`rest`") && text.contains("devices"), "{text}");
}
