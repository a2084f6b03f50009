//! The imbalance of a wheel in two gimbals: free gimbals take its moment, and the hub hardly has it; rates of the gimbals do.

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_toml;
use precess::record::Histories;
use precess::scenario::Scenario;
use precess::telemetry::{TelemetryLayout, TelemetryRows};
use precess::watch::{WatchSettings, WatchedRecord, watch};

/// One gyro whose gimbals are free, with motors and without a servo; readings at 400 Hz.
const GYRO: &str = r#"format = 1
[hub]
mass = "500 kg"
inertia = "200, 210, 190 kg m^2"
[[device]]
name = "cmg"
kind = "dgvscmg"
position = "45, 0, 0 cm"
imbalance = { static = "1 g cm", dynamic = "10 g cm^2", phase = "30 deg" }
outer_gimbal = { mass = "2 kg", inertia = "0.03, 0.03, 0.03 kg m^2" }
inner_gimbal = { mass = "1 kg", inertia = "0.02, 0.02, 0.02 kg m^2" }
wheel = { mass = "6 kg", inertia = "0.4, 0.25, 0.25 kg m^2", rate = "600 rpm" }
[[controller]]
name = "aocs"
rate = "400 Hz"
law = { kind = "eigen_axis", frequency = "0.05 Hz", damping_ratio = 0.8 }
[run]
duration = "12 s"
integrator = "rk4"
step = "2.5 ms"
[output]
rate = "400 Hz"
"#;

/// Columns of a run, the rates of the hub as the gyro's.
fn columns(of: &Scenario) -> Vec<(String, Vec<f64>)> {
    let mut truth = of.clone();
    truth.controllers.clear();
    let mut samples = Histories::default();
    run(&truth, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    let names = samples.header.expect("a header").columns;
    let named = names.into_iter().map(|of| of.name.replace("omega_", "aocs.gyro_"));
    named.zip(samples.columns).collect()
}

fn watched(scenario: &Scenario, columns: Vec<(String, Vec<f64>)>) -> WatchedRecord {
    let layout = TelemetryLayout::of_scenario(scenario, None).expect("a layout");
    let mut rows = TelemetryRows::of_columns("run", columns, &layout).expect("telemetry");
    let settings = WatchSettings { block: 2.0, learn: 6.0, false_alarms: 1.0 };
    watch(scenario, &mut rows, &settings, &mut |_| true).expect("a watch")
}

#[test]
fn the_imbalance_of_a_wheel_in_free_gimbals_is_that_of_the_run() {
    let scenario = from_toml("gyro", GYRO, Path::new("")).expect("accepted").0;
    let record = watched(&scenario, columns(&scenario));
    assert_eq!(record.remarks, &[] as &[String]);
    assert_eq!(record.blocks.len(), 6);
    // Gimbals that nothing holds follow the moment of the dynamic imbalance.
    for (name, expected, most) in
        [("static imbalance of cmg", 1e-5, 1e-5), ("dynamic imbalance of cmg", 1e-6, 1e-4)]
    {
        let place = record.quantities.iter().position(|of| of.name == name).expect("a quantity");
        for block in &record.blocks {
            let [found, variance] = block.values[place].unwrap_or_else(|| panic!("no {name}"));
            println!(
                "{name}: {:.1e} off, deviation {:.1e}",
                found / expected - 1.0,
                variance.sqrt() / expected
            );
            assert!((found / expected - 1.0).abs() < most, "{name}: {found:e}");
        }
    }
}

/// It ends at the block at which `hear` returns false.
#[test]
fn a_watch_is_interrupted_at_the_end_of_a_block() {
    let scenario = from_toml("gyro", GYRO, Path::new("")).expect("accepted").0;
    let layout = TelemetryLayout::of_scenario(&scenario, None).expect("a layout");
    let mut rows =
        TelemetryRows::of_columns("run", columns(&scenario), &layout).expect("telemetry");
    let settings = WatchSettings { block: 2.0, learn: 6.0, false_alarms: 1.0 };
    let mut ends = Vec::new();
    let found = watch(&scenario, &mut rows, &settings, &mut |end| {
        ends.push(end);
        ends.len() < 2
    });
    assert_eq!(found.expect_err("an interrupt").to_string(), "it was interrupted");
    assert_eq!(ends.len(), 2, "{ends:?}");
}
