//! Numbers of a spacecraft from seeded telemetry of another one: the truth within intervals, what the data do not tell and which
//! manoeuvre would, bad data.

mod agreement;
mod bus_truth;
mod designed;
mod recovered;
mod richer;
mod untold;

use std::fs;

use precess::identify::{Identified, IdentifyError, Unknowns, identify};
use precess::scenario::Scenario;
use precess::telemetry::{Telemetry, TelemetryError, TelemetryLayout};

/// Telemetry of a text.
fn telemetry(scenario: &Scenario, text: &str) -> Result<Telemetry, TelemetryError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("telemetry.csv");
    fs::write(&path, text).expect("a file");
    let layout = TelemetryLayout::of_scenario(scenario, None).expect("a layout");
    Telemetry::read(&path, &layout)
}

fn identified(
    scenario: &Scenario,
    text: &str,
    unknowns: &Unknowns,
) -> Result<Identified, IdentifyError> {
    let telemetry = telemetry(scenario, text).expect("telemetry");
    identify(scenario, &telemetry, unknowns, &mut |_| true)
}
