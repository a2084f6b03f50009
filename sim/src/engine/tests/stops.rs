//! End stops, crossings, cancellation and failure: where a run ends, and its samples.

use std::ops::ControlFlow;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Dgvscmg, HubMode, SolveError};

use super::{DOP853, Samples, last, recorded, scenario, set_joint, turning_panel, wheel};
use crate::engine::{Run, run};
use crate::record::{End, RunError};
use crate::scenario::{
    Action, Change, Crossing, Drive, EndStop, IntegratorChoice, Profile, StopAction,
};

const RK4: IntegratorChoice = IntegratorChoice::Rk4 { step: 0.01 };

/// The bracket of a passage, s, and a rounding of the coordinate.
const TIME: f64 = 2e-12;

fn stop(upper: f64, action: StopAction) -> EndStop {
    EndStop { joint: 0, lower: -1.0, upper, action }
}

#[test]
fn an_end_stop_is_met_when_the_closed_form_says() {
    for (integrator, rate, bound) in
        [(DOP853, 0.3, 0.4), (RK4, 0.3, 0.4), (DOP853, -2.0, -1.0), (RK4, -2.0, -1.0)]
    {
        let mut scenario = turning_panel(rate, 5.0);
        scenario.settings.integrator = integrator;
        scenario.stops = vec![stop(0.4, StopAction::End)];
        let (outcome, samples) = recorded(&scenario);
        assert!((outcome.end_time - bound / rate).abs() < TIME, "{}", outcome.end_time);
        assert!(matches!(&outcome.end, End::EndStop { joint, .. } if joint == "panel.phi"));
        assert_eq!(last(&samples, "time"), outcome.end_time);
        let coordinate = last(&samples, "panel.phi");
        assert!((coordinate - bound).abs() < TIME && (-1.0..=0.4).contains(&coordinate));
    }
}

#[test]
fn a_stop_that_locks_takes_the_energy_of_the_joint() {
    for integrator in [DOP853, RK4] {
        let mut scenario = turning_panel(0.5, 4.0);
        scenario.settings.integrator = integrator;
        scenario.stops = vec![stop(1.0, StopAction::Lock)];
        let (outcome, samples) = recorded(&scenario);
        assert!(matches!(outcome.end, End::Finished) && outcome.end_time == 4.0);
        assert!((outcome.energy_lost - 0.5 * 0.8 * 0.25).abs() < 1e-15);
        assert!(
            (last(&samples, "panel.phi") - 1.0).abs() < TIME
                && last(&samples, "panel.phi_dot") == 0.0
        );
        assert_eq!(outcome.events.len(), 1);
        assert!((outcome.events[0].time - 2.0).abs() < TIME, "{:?}", outcome.events);
        assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-13));
    }
}

#[test]
fn a_stop_touched_between_the_ends_of_a_step_is_found() {
    // Rises to 0.8 / 1.6 = 0.5 rad at 1 s and returns: a parabola, of which one step suffices.
    let mut scenario = turning_panel(1.0, 2.0);
    scenario.drives = vec![Drive::Torque { profile: Profile::Constant(-0.8), limit: None }];
    scenario.stops = vec![stop(0.499_999, StopAction::End)];
    for integrator in [DOP853, IntegratorChoice::Rk4 { step: 2.0 }] {
        scenario.settings.integrator = integrator;
        let (outcome, _) = recorded(&scenario);
        let expected = 1.0 - (2.0_f64 * 1e-6).sqrt();
        // The passage is nearly tangential: a rounding of the coordinate over the rate there.
        assert!((outcome.end_time - expected).abs() < 1e-11, "{}", outcome.end_time);
    }
}

#[test]
fn a_joint_that_starts_beyond_its_stops_is_rejected() {
    let mut scenario = turning_panel(0.5, 1.0);
    set_joint(&mut scenario, 0, [1.5, 0.0]);
    scenario.stops = vec![stop(1.0, StopAction::End)];
    let Err(error) = Run::new(&scenario) else { panic!("accepted") };
    assert_eq!(
        error.to_string(),
        "panel.phi starts at 1.5 rad, beyond its end stops -1 rad and 1 rad; start it in between"
    );
}

#[test]
fn crossings_are_noted_each_time_and_the_earliest_that_ends_the_run_ends_it() {
    let crossing = |name: &str, column: &str, value, ends| Crossing {
        name: name.to_owned(),
        column: column.to_owned(),
        value,
        unit: String::new(),
        ends,
    };
    let mut scenario = scenario(&["wheel"], vec![wheel().into()], 10.0);
    scenario.hub_mode = HubMode::Fixed;
    set_joint(&mut scenario, 0, [0.0, 4.0]);
    scenario.crossings = vec![
        crossing("late", "wheel.theta", 39.0, true),
        // After three turns: the angle is counted on.
        crossing("third turn", "wheel.theta", 20.0, false),
        crossing("early", "wheel.theta", 30.0, true),
    ];
    for integrator in [DOP853, RK4] {
        scenario.settings.integrator = integrator;
        let (outcome, _) = recorded(&scenario);
        assert!(matches!(&outcome.end, End::Crossing { name } if name == "early"));
        assert!((outcome.end_time - 7.5).abs() < TIME, "{}", outcome.end_time);
        let times: Vec<f64> = outcome.events.iter().map(|event| event.time).collect();
        assert!(times.len() == 2 && (times[0] - 5.0).abs() < TIME, "{:?}", outcome.events);
    }
    scenario.crossings[0].column = "wheel.thetta".to_owned();
    let Err(RunError::Crossing { nearest, .. }) = Run::new(&scenario) else { panic!("accepted") };
    assert_eq!(nearest[0], "wheel.theta");
}

#[test]
fn a_cancelled_run_is_a_shorter_one_that_says_so() {
    let mut scenario = turning_panel(0.5, 100.0);
    scenario.settings.integrator = RK4;
    scenario.output.rate = 10.0;
    let mut found = Samples::default();
    let outcome = run(&scenario, &mut found, &mut |time| {
        if time >= 1.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let outcome = outcome.expect("a result");
    assert!(matches!(outcome.end, End::Cancelled) && !outcome.end.is_complete());
    assert_eq!((outcome.end_time, last(&found, "time"), found.finished), (1.0, 1.0, true));
    assert_eq!((found.rows.len() as u64, outcome.samples), (11, 11));
}

#[test]
fn a_massless_gimbal_at_its_lock_is_an_error_with_its_time() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let mut scenario = scenario(&["cmg1"], vec![Dgvscmg::bare_wheel(4.0, disc).into()], 5.0);
    // The inner gimbal turns at a radian per second; a step ends where it is locked, at 90 degrees,
    // in which the outer one would turn about the spin axis.
    scenario.drives[1] = Drive::Acceleration(Profile::ZERO);
    set_joint(&mut scenario, 1, [0.0, 1.0]);
    let lock = std::f64::consts::FRAC_PI_2;
    let action = Action::Drive(scenario.drives[2].clone());
    scenario.changes = vec![Change { time: lock, joint: 2, action }];
    for integrator in [DOP853, IntegratorChoice::Rk4 { step: 0.01 }] {
        scenario.settings.integrator = integrator;
        let (outcome, samples) = recorded(&scenario);
        let End::Failed(error) = &outcome.end else { panic!("{}", outcome.end) };
        // Near the lock the pivot is rounding already; rk4 names the start of its step.
        let time = error.time().unwrap_or_default();
        assert!((lock - 0.01..=lock).contains(&time), "{error}");
        let RunError::Solve { device: Some(device), source, .. } = error else { panic!("{error}") };
        assert_eq!(device, "cmg1");
        assert!(matches!(source, SolveError::Singular { .. }), "{error}");
        assert!(outcome.end_time <= lock && samples.finished);
        // A state that has no accelerations is not recorded.
        assert!((1.5..=lock).contains(&last(&samples, "time")));
        assert!(samples.rows.iter().flatten().all(|number| number.is_finite()));
    }
}
