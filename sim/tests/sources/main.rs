//! Sources of disturbance: what they do to a spacecraft against closed forms, what is refused, and how they
//! are written.

mod correlated;
mod errors;
mod listed;
mod motion;
mod places;
mod records;
mod sheet;

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::{from_toml, to_toml};
use precess::record::{End, Outcome, Samples};
use precess::scenario::Scenario;

/// A hub of 96 kg and a wheel of 4 kg at its centre of mass, spin axis `b_x`, at 50 rad/s.
const WHEEL: &str = "format = 1\n[hub]\nmass = \"96 kg\"\ninertia = \"30, 40, 50 kg m^2\"\n\
    [[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
    [device.wheel]\nmass = \"4 kg\"\ninertia = \"0.2, 0.1, 0.1 kg m^2\"\nrate = \"50 rad/s\"\n\
    angle = \"0.7 rad\"\n[run]\nduration = \"10 s\"\ntolerance = 1e-13\n[output]\nrate = \"50 Hz\"\n";

/// The scenario of a text.
fn read(text: &str) -> Scenario {
    let read = from_toml("sources.toml", text, Path::new(env!("CARGO_TARGET_TMPDIR")));
    read.unwrap_or_else(|errors| panic!("{errors}\n{text}")).0
}

/// The errors of a text.
fn errors(text: &str) -> String {
    let read = from_toml("sources.toml", text, Path::new(env!("CARGO_TARGET_TMPDIR")));
    read.map_or_else(|errors| errors.to_string(), |_| panic!("no error:\n{text}"))
}

/// A run to its end.
fn ran(scenario: &Scenario) -> (Outcome, Samples) {
    let mut samples = Samples::default();
    let outcome = run(scenario, &mut samples, &mut |_| ControlFlow::Continue(()));
    let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(matches!(outcome.end, End::Finished), "{}", outcome.end);
    (outcome, samples)
}

fn column(samples: &Samples, name: &str) -> Vec<f64> {
    samples.column(name).unwrap_or_else(|| panic!("no column {name}"))
}

fn last(samples: &Samples, name: &str) -> f64 {
    *column(samples, name).last().expect("a sample")
}

/// The largest magnitude; NaN where there is one.
fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if b.is_nan() || b.abs() > a { b.abs() } else { a };
    numbers.into_iter().fold(0.0, larger)
}

/// That a scenario is read back as it is written.
fn read_back(text: &str) {
    let first = read(text);
    let written = to_toml(&first);
    let second = read(&written);
    assert_eq!(second.disturbances, first.disturbances, "{written}");
    assert_eq!(to_toml(&second), written);
}
