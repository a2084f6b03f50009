//! Profiles, brakes, locks: what happens at a time happens at that time.

use nalgebra::Vector3;
use precess_dynamics::{About, HubMode};

use super::{DOP853, column, last, recorded, scenario, set_joint, turning_panel, wheel};
use crate::engine::{Advance, Run};
use crate::record::{End, RecordError, RunError};
use crate::scenario::{
    Action, Change, Drive, IntegratorChoice, Interpolation, MotorLimits, Profile, Table,
};

/// Some roundings of a rate of ten.
const ROUNDING: f64 = 1e-13;

const RK4: IntegratorChoice = IntegratorChoice::Rk4 { step: 0.03 };

fn torque(profile: Profile, limit: Option<f64>) -> Drive {
    let limit = limit.map(|torque| MotorLimits { torque: Some(torque), ..MotorLimits::default() });
    Drive::Torque { profile, limit }
}

#[test]
fn a_step_of_torque_begins_when_it_should() {
    // No multiple of any step.
    let at = 0.123_456_789;
    for integrator in [DOP853, RK4] {
        let mut scenario = scenario(&["wheel"], vec![wheel().into()], 1.0);
        scenario.hub_mode = HubMode::Fixed;
        scenario.settings.integrator = integrator;
        scenario.drives = vec![torque(Profile::Step { at, before: 0.0, after: 2.0 }, None)];
        let mut run = Run::new(&scenario).expect("it is accepted");
        let mut times = Vec::new();
        while let Advance::Stepped = run.advance().expect("a step") {
            times.push(run.time());
        }
        assert!(times.contains(&at), "{times:?}");
        let spin = run.state().devices.0[0][0][1];
        assert!((spin - 2.0 / 0.2 * (1.0 - at)).abs() < ROUNDING, "{spin}");
    }
}

#[test]
fn a_table_is_integrated_from_value_to_value_and_clipped_at_the_limit() {
    let times = vec![0.0, 0.1, 0.35, 0.7];
    let held =
        Table { times, values: vec![1.0, -2.0, 3.0, 0.5], interpolation: Interpolation::Hold };
    // 0.1 s of 1 N m, 0.25 s of -2 N m limited to -1.5 N m, 0.35 s of 1.5 N m, 0.3 s of 0.5 N m.
    let impulse = 0.1 - 1.5 * 0.25 + 1.5 * 0.35 + 0.5 * 0.3;
    let linear = Table { interpolation: Interpolation::Linear, ..held.clone() };
    for integrator in [DOP853, RK4] {
        let spin = |table: &Table| {
            let mut scenario = scenario(&["wheel"], vec![wheel().into()], 1.0);
            scenario.hub_mode = HubMode::Fixed;
            scenario.settings.integrator = integrator;
            scenario.drives = vec![torque(Profile::Table(table.clone()), Some(1.5))];
            last(&recorded(&scenario).1, "wheel.spin")
        };
        assert!((spin(&held) - impulse / 0.2).abs() < ROUNDING);
        if integrator == DOP853 {
            // Trapezoids between the knots and the times at which the limit is reached.
            let knots = [
                (0.0, 1.0),
                (0.1 * 2.5 / 3.0, -1.5),
                (0.1 + 0.25 * 0.5 / 5.0, -1.5),
                (0.1 + 0.25 * 3.5 / 5.0, 1.5),
                (0.35 + 0.35 * 1.5 / 2.5, 1.5),
                (0.7, 0.5),
                (1.0, 0.5),
            ];
            let area =
                |pair: &[(f64, f64)]| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1);
            let impulse: f64 = knots.windows(2).map(area).sum();
            assert!((spin(&linear) - impulse / 0.2).abs() < ROUNDING, "{}", spin(&linear));
        }
    }
}

/// 2 sin(2 pi t) N m limited to 1 N m: between its kinks at 1/12 and 5/12 of a period it is constant.
#[test]
fn a_clipped_sine_is_integrated_from_kink_to_kink() {
    let sine = Profile::Sine { mean: 0.0, amplitude: 2.0, frequency: 1.0, phase: 0.0 };
    for integrator in [DOP853, RK4] {
        let mut scenario = scenario(&["wheel"], vec![wheel().into()], 2.5);
        scenario.hub_mode = HubMode::Fixed;
        scenario.settings.integrator = integrator;
        scenario.drives = vec![torque(sine.clone(), Some(1.0))];
        let mut run = Run::new(&scenario).expect("it is accepted");
        let mut times = Vec::new();
        while let Advance::Stepped = run.advance().expect("a step") {
            times.push(run.time());
        }
        for kink in [1.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 25.0, 29.0].map(|k| k / 12.0) {
            assert!(times.iter().any(|time| (time - kink).abs() < 1e-14), "{kink}: {times:?}");
        }
        if integrator == DOP853 {
            // Half a period is left after two whole ones.
            let tau = std::f64::consts::TAU;
            let rise = 2.0 / tau * (1.0 - (tau / 12.0).cos());
            let impulse = 2.0 * rise + 4.0 / 12.0;
            let spin = run.state().devices.0[0][0][1];
            assert!((spin - impulse / 0.2).abs() < ROUNDING, "{:e}", spin - impulse / 0.2);
        }
    }
}

#[test]
fn samples_at_a_jump_show_what_comes_after_it() {
    let mut scenario = scenario(&["wheel"], vec![wheel().into()], 1.0);
    scenario.output.rate = 4.0;
    scenario.drives = vec![torque(Profile::Step { at: 0.5, before: 1.0, after: 2.0 }, Some(1.75))];
    let (_, samples) = recorded(&scenario);
    assert_eq!(column(&samples, "time"), [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert_eq!(column(&samples, "wheel.u_w"), [1.0, 1.0, 1.75, 1.75, 1.75]);
}

#[test]
fn a_brake_keeps_angular_momentum_and_enters_its_loss() {
    let mut scenario = scenario(&["wheel"], vec![wheel().into()], 2.0);
    scenario.initial.omega = Vector3::new(0.0, 0.1, 0.0);
    set_joint(&mut scenario, 0, [0.0, 50.0]);
    scenario.changes = vec![Change { time: 0.7, joint: 0, action: Action::Brake }];
    for integrator in [DOP853, RK4] {
        scenario.settings.integrator = integrator;
        let (outcome, samples) = recorded(&scenario);
        assert_eq!(last(&samples, "wheel.spin"), 0.0);
        // Of 250 J; the rest is motion of the hub. Rotors of 0.2 and 30 kg m², but for what the
        // hub's motion has changed of the spin by then.
        let loss = 0.5 * 50.0 * 50.0 * (0.2 * 30.0 / 30.2);
        assert!((outcome.energy_lost - loss).abs() < 1e-4 * loss, "{}", outcome.energy_lost);
        assert_eq!(last(&samples, "energy_lost"), outcome.energy_lost);
        let drift = outcome.drift;
        let bound = if integrator == DOP853 { 1e-13 } else { 1e-5 };
        for part in [drift.energy, drift.linear, drift.angular] {
            assert!(part.is_some_and(|part| part < bound), "{drift:?}");
        }
        assert_eq!(outcome.events.len(), 1);
        let event = &outcome.events[0];
        assert!(event.time == 0.7 && event.text.starts_with("wheel.theta: braked, "), "{event:?}");
    }
    // The momentum of the samples before and after.
    let run = Run::new(&scenario).expect("it is accepted");
    let about = About::InertialOrigin;
    let spacecraft = scenario.spacecraft().expect("it is accepted");
    let before = spacecraft.momentum(&scenario.initial, about).expect("finite");
    assert!(
        (before.angular
            - run.system.craft.undeformed().momentum(&run.state(), about).expect("finite").angular)
            .norm()
            < 1e-15
    );
}

#[test]
fn a_moving_joint_is_not_locked_without_a_brake() {
    let mut scenario = turning_panel(0.5, 1.0);
    let drive = Drive::Locked;
    scenario.changes = vec![Change { time: 0.25, joint: 0, action: Action::Drive(drive.clone()) }];
    let (outcome, samples) = recorded(&scenario);
    assert_eq!((outcome.end_time, last(&samples, "time"), samples.finished), (0.25, 0.25, true));
    let End::Failed(error) = outcome.end else { panic!("{}", outcome.end) };
    assert_eq!(error.time(), Some(0.25));
    assert_eq!(
        error.to_string(),
        "at t = 0.25 s: panel.phi is to be locked but moves at 0.5 rad/s, not 0; stop it with a \
         brake instead"
    );
    scenario.drives = vec![drive];
    assert!(matches!(Run::new(&scenario), Err(RunError::LockedJointMoves { time: 0.0, .. })));
}

#[test]
fn a_prescribed_acceleration_is_followed_and_its_torque_is_recorded() {
    let mut scenario = scenario(&["wheel"], vec![wheel().into()], 1.0);
    scenario.hub_mode = HubMode::Fixed;
    scenario.drives = vec![Drive::Acceleration(Profile::Constant(3.0))];
    let (outcome, samples) = recorded(&scenario);
    assert!((last(&samples, "wheel.spin") - 3.0).abs() < ROUNDING);
    assert!(column(&samples, "wheel.u_w").iter().all(|torque| (torque - 0.6).abs() < ROUNDING));
    // 0.9 J of the rotor.
    assert!((last(&samples, "work") - 0.9).abs() < ROUNDING, "{}", last(&samples, "work"));
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-13));
    assert_eq!((outcome.drift.linear, outcome.drift.angular), (None, None));
}

#[test]
fn an_unknown_column_is_rejected_with_the_nearest() {
    let mut scenario = turning_panel(0.5, 1.0);
    scenario.output.columns = vec!["panel.phi_dott".to_owned()];
    let rejected = super::run(&scenario, &mut super::Samples::default(), &mut |_| {
        std::ops::ControlFlow::Continue(())
    });
    let Err(RunError::Record(RecordError::UnknownColumn { name, nearest })) = rejected else {
        panic!("accepted")
    };
    assert_eq!((name.as_str(), nearest[0].as_str()), ("panel.phi_dott", "panel.phi_dot"));
}
