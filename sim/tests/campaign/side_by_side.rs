//! Runs side by side: each has the row that it has by itself, to the bit, whatever is beside it. With the
//! feature `lanes` those of RK4 share lanes.

use std::fs;
use std::ops::ControlFlow;

use precess::campaign::{Reducer, Selection, run_reduced};
use precess::file::Template;
use precess::scenario::Scenario;

use super::shared::folder;

/// Two imbalanced double-gimbal gyros, RK4 at 1 ms.
pub(super) const GYROS: &str = r#"format = 1
[hub]
mass = "96 kg"
inertia = "20, 21, 22 kg m^2"
[initial]
angular_velocity = "0.01, -0.02, 0.03 rad/s"
[[device]]
name = "a"
kind = "dgvscmg"
mount = { gimbal_axis = [0, 0, 1], spin_axis = [1, 0, 0] }
position = "0.3, 0.1, 0 m"
imbalance = { static = "10 g cm", dynamic = "20 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
torque = "0.02 N m"
[device.outer_gimbal]
mass = "1 kg"
inertia = "60, 50, 40 kg cm^2"
rate = "0.1 rad/s"
[device.inner_gimbal]
mass = "1 kg"
inertia = "30, 40, 50 kg cm^2"
angle = "0.3 rad"
[[device]]
name = "b"
kind = "dgvscmg"
mount = { gimbal_axis = [0, 1, 0], spin_axis = [0, 0, 1] }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "1000 rpm"
[device.outer_gimbal]
mass = "1 kg"
inertia = "60, 50, 40 kg cm^2"
[device.inner_gimbal]
mass = "1 kg"
inertia = "30, 40, 50 kg cm^2"
[run]
duration = "0.1 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "250 Hz"
[[requirement]]
name = "slow"
quantity = "omega"
statistic = "peak"
limit = "0.04 rad/s"
"#;

/// What each run differs in.
pub(super) const CASES: [&[&str]; 13] = [
    &[],
    &["hub.mass = \"90 kg\""],
    &["hub.mass = \"101 kg\"", "device.a.imbalance.static = \"30 g cm\""],
    &["device.b.wheel.rate = \"2000 rpm\""],
    // Samples between steps, and at no two steps at the same place.
    &["output.rate = \"333 Hz\""],
    &["device.a.wheel.torque = { ramp = \"0, 0.1 N m\", from = \"20 ms\", to = \"50 ms\" }"],
    &["device.a.wheel.torque = { step = \"0.1 N m\", at = \"33.3 ms\" }"],
    &["at = [{ time = \"40.5 ms\", joint = \"a.outer_gimbal\", brake = true }]"],
    &[
        "device.b.inner_gimbal.upper_stop = \"1 mrad\"",
        "device.b.inner_gimbal.rate = \"0.02 rad/s\"",
        "device.b.inner_gimbal.at_stop = \"lock\"",
    ],
    &["wrench = [{ on = \"hub\", force.x = \"1 N\", axes = \"inertial\" }]"],
    &["gravity.uniform = \"0, 0, 9.8 m/s^2\""],
    &["run.step = \"0.7 ms\""],
    &["run.duration = \"0.05 s\""],
];

pub(super) fn scenario(template: &Template, case: &[&str]) -> Scenario {
    let overrides: Vec<String> = case.iter().map(|text| (*text).to_owned()).collect();
    let read = template.scenario(&overrides);
    read.unwrap_or_else(|errors| panic!("{case:?}: {errors}")).0
}

pub(super) fn selection() -> Selection {
    let columns = ["omega", "acceleration", "a.theta", "energy"].map(str::to_owned);
    Selection { columns: columns.into(), lines: 0, from: 0.0 }
}

/// The row by a run that keeps everything.
fn alone(mut scenario: Scenario, selection: &Selection) -> Vec<u64> {
    scenario.output.columns.clone_from(&selection.columns);
    let mut reducer = Reducer::new(&scenario, selection);
    let progress = &mut |_| ControlFlow::Continue(());
    let outcome = precess::engine::run(&scenario, &mut reducer, progress).expect("a run");
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    bits(&reducer.row().expect("numbers"))
}

pub(super) fn bits(row: &[f64]) -> Vec<u64> {
    row.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn each_run_has_the_row_that_it_has_by_itself() {
    let (folder, _) = folder("side-by-side");
    let file = folder.join("gyros.toml");
    fs::write(&file, GYROS).expect("a file");
    let template = Template::from_file(&file).unwrap_or_else(|errors| panic!("{errors}"));
    let selection = selection();
    let scenarios: Vec<Scenario> = CASES.iter().map(|case| scenario(&template, case)).collect();
    let together = run_reduced(scenarios.clone(), &selection, &|| false);
    let mut rows = Vec::new();
    for ((case, scenario), found) in CASES.iter().zip(scenarios).zip(together) {
        let found = found.expect("not cancelled").expect("a row");
        assert!(found.iter().all(|number| number.is_finite()), "{case:?}: {found:?}");
        assert_eq!(bits(&found), alone(scenario, &selection), "{case:?}");
        rows.push(bits(&found));
    }
    // Each differs from the first: what is varied acts.
    let same = rows.iter().skip(1).filter(|row| **row == rows[0]).count();
    assert_eq!(same, 0, "of {} cases", CASES.len());
}
