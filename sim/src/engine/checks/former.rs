//! The six variants of Table 1 against the former engine, of one typed set. To be removed with it.

use super::{Kept, kept, scenario};
use crate::plan::{Drive, Profile, Scenario};
use crate::run::{Settings, run};
use crate::scenario::table1::{Variant, variants};

/// Two evaluations in another order of the same sums, at tolerance 1e-13.
const ROUNDING: f64 = 1e-12;

fn of(variant: Variant, duration: f64) -> Scenario {
    let former = variant.scenario();
    let mut scenario = scenario(&["cmg1"], vec![former.devices[0].into()], duration);
    scenario.hub = former.hub;
    scenario.initial.omega = former.state.omega;
    super::set_joint(&mut scenario, 2, [0.0, former.state.devices[0].spin]);
    let motors = variant.drive.motors();
    for (drive, torque) in scenario.drives.iter_mut().zip([motors.u_o, motors.u_i, motors.u_w]) {
        *drive = Drive::Torque { profile: Profile::Constant(torque), limit: None };
    }
    scenario.output.rate = 100.0;
    scenario
}

#[test]
fn trajectories_agree_with_the_former_engine() {
    for variant in variants(None, None) {
        let settings = Settings { duration: 10.0, tolerance: 1e-13, rate: 100.0 };
        let history = run(&variant.scenario(), &settings, &mut |_| {}).expect("Table 1 runs");
        let (outcome, found) = kept(&of(variant, 10.0));
        assert_eq!(history.samples.len() as u64, outcome.samples);
        let column = |name: &str| Kept::column(&found, name);
        let names = ["omega_x", "position_y", "velocity_x", "q1", "cmg1.gamma_i", "cmg1.theta"];
        let columns = names.map(column);
        let mut largest: f64 = 0.0;
        for (i, sample) in history.samples.iter().enumerate() {
            let state = &sample.state;
            let joints = &state.devices[0];
            let expected = [
                state.omega.x,
                state.r_b_n.y,
                state.r_b_n_dot.x,
                state.attitude.q1,
                joints.gamma_i,
                joints.theta,
            ];
            for (found, expected) in columns.iter().zip(expected) {
                largest = largest.max((found[i] - expected).abs() / expected.abs().max(1.0));
            }
        }
        let (former, drift) = (history.ledger.drift(), outcome.drift);
        println!("{}: {largest:.1e}, {former:?}, {drift:?}", variant.name());
        assert!(largest < ROUNDING, "{}: {largest:e}", variant.name());
        assert_eq!(history.steps.accepted as u64, outcome.steps.accepted);
    }
}
