//! Largest power and rate of a motor: closed forms of a wheel about the axis of a hub.

use precess_dynamics::HubMode;

use super::{DOP853, Samples, column, last, recorded, scenario, set_joint, wheel};
use crate::engine::Run;
use crate::record::{Outcome, RunError};
use crate::scenario::{
    Action, AppliedWrench, Change, Drive, DryFriction, IntegratorChoice, Interpolation,
    JointFriction, MotorLimits, Profile, Scenario, Table, Target, WrenchAxes,
};

/// Moments of inertia of wheel and hub about the axis of the wheel, and that of the rate between them, kg m².
const J: f64 = 0.2;
const HUB: f64 = 30.0;
const REDUCED: f64 = J * HUB / (J + HUB);

/// Of a rate of tens of rad/s, and of times of tens of seconds.
const CLOSE: f64 = 1e-9;

const RK4: IntegratorChoice = IntegratorChoice::Rk4 { step: 0.01 };

fn limits(torque: Option<f64>, power: Option<f64>, rate: Option<f64>) -> MotorLimits {
    MotorLimits { torque, power, rate }
}

fn spin_up(profile: Profile, limits: MotorLimits, duration: f64) -> Scenario {
    let mut scenario = scenario(&["wheel"], vec![wheel().into()], duration);
    scenario.drives = vec![Drive::Torque { profile, limit: Some(limits) }];
    scenario.output.rate = 10.0;
    scenario
}

/// Times and words of what happened.
fn events(outcome: &Outcome) -> Vec<(f64, &str)> {
    outcome.events.iter().map(|event| (event.time, event.text.as_str())).collect()
}

fn each(samples: &Samples, expected: impl Fn(f64) -> f64) {
    for (time, spin) in column(samples, "time").into_iter().zip(column(samples, "wheel.spin")) {
        let expected = expected(time);
        assert!((spin - expected).abs() < CLOSE, "{spin}, not {expected}, at {time} s");
    }
}

#[test]
fn beyond_the_corner_rate_a_wheel_gains_energy_at_the_largest_power() {
    // 0.1 N m up to 50 rad/s, then 5 W; a profile above the largest torque, and one below it.
    for (profile, torque) in [(0.4, Some(0.1)), (0.1, None)] {
        let (power, corner) = (5.0, 50.0);
        let of = limits(torque, Some(power), None);
        let (outcome, samples) = recorded(&spin_up(Profile::Constant(profile), of, 200.0));
        let from = corner * REDUCED / 0.1;
        each(&samples, |time| {
            let since = (time - from).max(0.0);
            let up_to = 0.1 / REDUCED * time.min(from);
            (up_to * up_to + 2.0 * power * since / REDUCED).sqrt()
        });
        let events = events(&outcome);
        assert!(events.len() == 1 && (events[0].0 - from).abs() < CLOSE, "{events:?}");
        assert_eq!(events[0].1, "wheel.theta: the motor delivers its largest power, 5 W");
        // The work is that of the torque as it is limited.
        let work = 0.1 * 0.5 * corner * from + power * (200.0 - from);
        assert!((last(&samples, "work") - work).abs() < 1e-9 * work, "{}", last(&samples, "work"));
        assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
        assert!(outcome.drift.angular.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
    }
}

#[test]
fn braking_has_no_largest_power() {
    let of = limits(None, Some(5.0), None);
    let mut scenario = spin_up(Profile::Constant(-0.1), of, 20.0);
    set_joint(&mut scenario, 0, [0.0, 100.0]);
    let (outcome, samples) = recorded(&scenario);
    each(&samples, |time| 100.0 - 0.1 / REDUCED * time);
    assert!(outcome.events.is_empty(), "{:?}", outcome.events);
}

#[test]
fn a_sine_comes_to_the_largest_power_and_leaves_it_each_time() {
    // A clamped hub: J rate' = u, J rate^2 / 2 grows by no more than 2 W.
    let sine = Profile::Sine { mean: 0.0, amplitude: 1.0, frequency: 0.5, phase: 0.0 };
    let mut scenario = spin_up(sine, limits(None, Some(2.0), None), 4.0);
    scenario.hub_mode = HubMode::Fixed;
    scenario.output.rate = 500.0;
    let (outcome, samples) = recorded(&scenario);
    let powers = column(&samples, "wheel.spin").into_iter().zip(column(&samples, "wheel.u_w"));
    let highest = powers.map(|(rate, torque)| rate * torque).fold(0.0, f64::max);
    assert!((highest - 2.0).abs() < 1e-12, "{highest}");
    let states: Vec<bool> =
        outcome.events.iter().map(|event| event.text.contains("delivers")).collect();
    assert_eq!(states, [true, false, true, false], "{:?}", outcome.events);
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
}

#[test]
fn a_wheel_comes_to_its_largest_rate_and_stays_there() {
    for (integrator, sign) in [(DOP853, 1.0), (RK4, 1.0), (DOP853, -1.0)] {
        let of = limits(Some(0.1), None, Some(40.0));
        let mut scenario = spin_up(Profile::Constant(sign * 0.3), of, 120.0);
        scenario.settings.integrator = integrator;
        let (outcome, samples) = recorded(&scenario);
        let arrival = 40.0 * REDUCED / 0.1;
        each(&samples, |time| sign * (0.1 / REDUCED * time).min(40.0));
        let events = events(&outcome);
        assert!(events.len() == 1 && (events[0].0 - arrival).abs() < CLOSE, "{events:?}");
        let text = "wheel.theta is at its largest rate, 40 rad/s; the motor holds it";
        assert_eq!(events[0].1, text);
        assert!(last(&samples, "wheel.u_w").abs() < 1e-12);
        assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
        assert!(outcome.drift.angular.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
    }
}

#[test]
fn power_then_rate_are_met_in_their_order() {
    let of = limits(Some(0.1), Some(5.0), Some(70.0));
    let (outcome, samples) = recorded(&spin_up(Profile::Constant(0.1), of, 300.0));
    let corner = 50.0 * REDUCED / 0.1;
    let arrival = corner + 0.5 * REDUCED * (70.0 * 70.0 - 50.0 * 50.0) / 5.0;
    let times: Vec<f64> = outcome.events.iter().map(|event| event.time).collect();
    assert!(times.len() == 2, "{:?}", outcome.events);
    assert!((times[0] - corner).abs() < CLOSE && (times[1] - arrival).abs() < CLOSE, "{times:?}");
    assert!((last(&samples, "wheel.spin") - 70.0).abs() < CLOSE);
}

#[test]
fn a_wheel_leaves_its_largest_rate_where_friction_takes_more_than_the_profile() {
    // Friction of 2 mN m s/rad takes 80 mN m at 40 rad/s; the profile falls below that at 60 s.
    let mut of: precess_dynamics::BalancedReactionWheel = wheel();
    of.passive.wheel.viscous = 2e-3;
    let ramp = Profile::Ramp { between: [0.0, 120.0], values: [0.16, 0.0] };
    let mut scenario = spin_up(ramp, limits(None, None, Some(40.0)), 120.0);
    scenario.devices.0 = vec![of.into()];
    set_joint(&mut scenario, 0, [0.0, 40.0]);
    for integrator in [DOP853, RK4] {
        scenario.settings.integrator = integrator;
        let (outcome, samples) = recorded(&scenario);
        let events = events(&outcome);
        assert!(events.len() == 2 && events[0].0 == 0.0, "{events:?}");
        // By a part of 1e-9 of the largest torque later, at 1.3 mN m/s.
        assert!((events[1].0 - 60.0).abs() < 2e-7, "{events:?}");
        assert_eq!(events[1].1, "wheel.theta leaves its largest rate, 40 rad/s");
        // rate' = (u - c rate) / J with u = c 40 - s t from there: a lag of J / c.
        let (slope, lag) = (0.16 / 120.0 / 2e-3, REDUCED / 2e-3);
        // RK4 holds the torque over each step: half a step later.
        let tolerance = if integrator == DOP853 { CLOSE } else { 0.5 * 0.01 * slope };
        let rates = column(&samples, "time").into_iter().zip(column(&samples, "wheel.spin"));
        for (time, spin) in rates {
            let since = (time - 60.0).max(0.0);
            let expected = 40.0 - slope * (since - lag * (1.0 - (-since / lag).exp()));
            assert!((spin - expected).abs() < tolerance, "{spin}, not {expected}, at {time} s");
        }
        assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
    }
}

#[test]
fn a_jump_of_the_profile_leaves_the_largest_rate_at_once() {
    let of = limits(None, None, Some(40.0));
    let step = Profile::Step { at: 10.0, before: 0.1, after: -0.1 };
    let mut scenario = spin_up(step, of, 20.0);
    set_joint(&mut scenario, 0, [0.0, 40.0]);
    let (outcome, samples) = recorded(&scenario);
    each(&samples, |time| 40.0 - 0.1 / REDUCED * (time - 10.0).max(0.0));
    let times: Vec<f64> = outcome.events.iter().map(|event| event.time).collect();
    assert_eq!(times, [0.0, 10.0], "{:?}", outcome.events);
}

#[test]
fn a_joint_is_driven_beyond_its_largest_rate_and_braked_by_the_largest_torque() {
    // On a clamped hub 0.3 N m from outside, 0.1 N m of the motor against it, for 10 s; then those against the rate.
    let of = limits(Some(0.1), None, Some(40.0));
    let mut scenario = spin_up(Profile::ZERO, of, 50.0);
    scenario.hub_mode = HubMode::Fixed;
    set_joint(&mut scenario, 0, [0.0, 25.0]);
    let pulse = Profile::During { between: [0.0, 20.0], profile: Box::new(Profile::Constant(0.3)) };
    scenario.wrenches = vec![AppliedWrench {
        body: Target::Joint(0),
        force: [Profile::ZERO, Profile::ZERO, Profile::ZERO],
        moment: [pulse, Profile::ZERO, Profile::ZERO],
        point: nalgebra::Vector3::zeros(),
        axes: WrenchAxes::Body,
    }];
    let (outcome, samples) = recorded(&scenario);
    each(&samples, |time| {
        let up = 25.0 + 0.3 / J * time.min(10.0) + 0.2 / J * (time.min(20.0) - 10.0).max(0.0);
        (up - 0.1 / J * (time - 20.0).max(0.0)).max(if time > 20.0 { 40.0 } else { 0.0 })
    });
    let events = events(&outcome);
    assert_eq!(events.len(), 3, "{events:?}");
    for ((time, _), expected) in events.iter().zip([10.0, 10.0, 40.0]) {
        assert!((time - expected).abs() < CLOSE, "{events:?}");
    }
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
}

#[test]
fn two_wheels_at_their_largest_rates_hold_each_by_itself() {
    let of = |rate| Some(limits(None, None, Some(rate)));
    let mut scenario = scenario(&["a", "b"], vec![wheel().into(), wheel().into()], 200.0);
    let drive =
        |torque, rate| Drive::Torque { profile: Profile::Constant(torque), limit: of(rate) };
    scenario.drives = vec![drive(0.1, 40.0), drive(-0.1, 30.0)];
    let (outcome, samples) = recorded(&scenario);
    assert_eq!(outcome.events.len(), 2, "{:?}", outcome.events);
    assert!((last(&samples, "a.spin") - 40.0).abs() < CLOSE);
    assert!((last(&samples, "b.spin") + 30.0).abs() < CLOSE);
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
}

#[test]
fn a_rate_beyond_the_largest_one_is_rejected_or_braked() {
    let mut scenario = spin_up(Profile::ZERO, limits(None, None, Some(40.0)), 10.0);
    set_joint(&mut scenario, 0, [0.0, -41.0]);
    let Err(error) = Run::new(&scenario) else { panic!("accepted") };
    let text = "at t = 0 s: wheel.theta has the rate -41 rad/s, beyond the largest one of its motor, 40 rad/s; \
                raise that, start slower, or during a run give the motor a largest torque, with which it brakes";
    assert_eq!(error.to_string(), text);
    // By a change during the run it is braked by the largest torque, if there is one.
    let changed = |torque| Drive::Torque {
        profile: Profile::ZERO,
        limit: Some(limits(torque, None, Some(40.0))),
    };
    scenario.drives = vec![Drive::Torque { profile: Profile::ZERO, limit: None }];
    let change = |torque| Change { time: 2.0, joint: 0, action: Action::Drive(changed(torque)) };
    scenario.changes = vec![change(Some(0.1))];
    let (_, samples) = recorded(&scenario);
    each(&samples, |time| (-41.0 + 0.1 / REDUCED * (time - 2.0).max(0.0)).min(-40.0));
    scenario.changes = vec![change(None)];
    let (outcome, _) = recorded(&scenario);
    let crate::record::End::Failed(error) = outcome.end else { panic!("{}", outcome.end) };
    assert!(matches!(error, RunError::BeyondLargestRate { time: 2.0, .. }), "{error}");
}

#[test]
fn a_wheel_whose_friction_sticks_breaks_away_is_held_at_its_largest_rate_and_leaves_it() {
    // Static friction of 50 mN m, sliding friction of 30; a profile that rises by 1 mN m/s to 60, and falls again.
    let table = Profile::Table(Table {
        times: vec![0.0, 60.0, 120.0],
        values: vec![0.0, 0.06, 0.0],
        interpolation: Interpolation::Linear,
    });
    let mut scenario = spin_up(table, limits(None, None, Some(1.0)), 115.0);
    let dry = DryFriction { static_friction: 0.05, coulomb: 0.03, stribeck_rate: 0.0 };
    scenario.friction = vec![JointFriction { joint: 0, dry: Some(dry), drag: 0.0 }];
    let (outcome, samples) = recorded(&scenario);
    let events = events(&outcome);
    let words: Vec<_> = events.iter().map(|(_, text)| *text).collect();
    let held = "wheel.theta is at its largest rate, 1 rad/s; the motor holds it";
    let left = "wheel.theta leaves its largest rate, 1 rad/s";
    assert_eq!(words, ["wheel.theta: slides", held, left, "wheel.theta: sticks"]);
    // rate = (20 mN m t + t^2 / 2 mN m/s) / J from 50 s.
    let arrival = 50.0 - 20.0 + (400.0 + 2.0 * REDUCED * 1e3_f64).sqrt();
    assert!((events[0].0 - 50.0).abs() < CLOSE, "{events:?}");
    assert!((events[1].0 - arrival).abs() < CLOSE, "{events:?}, not {arrival}");
    // The profile is at the sliding friction; 1e-9 of the largest torque later.
    assert!((events[2].0 - 90.0).abs() < 2e-7, "{events:?}");
    let at = column(&samples, "time").iter().position(|time| *time == 80.0).expect("a sample");
    assert!(
        (column(&samples, "wheel.u_w")[at] - 0.03).abs() < 1e-12,
        "the motor holds against friction"
    );
    assert!((column(&samples, "wheel.friction_theta")[at] + 0.03).abs() < 1e-15);
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-9), "{:?}", outcome.drift);
}
