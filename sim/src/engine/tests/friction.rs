//! Friction that sticks, and quadratic drag: times and motions against closed forms, momentum and energy.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{HingedPanel, HubMode, Passive, Vscmg};

use super::{DOP853, column, last, recorded, scenario, set_joint, turning_panel, wheel};
use crate::engine::Run;
use crate::record::{End, Outcome};
use crate::scenario::{
    Action, Change, Drive, DryFriction, IntegratorChoice, JointFriction, MotorLimits, Profile,
    Scenario,
};

const RK4: IntegratorChoice = IntegratorChoice::Rk4 { step: 0.003 };

/// Times of events by closed forms, s.
const TIME: f64 = 1e-9;
/// Some roundings of numbers of order one.
const ROUNDING: f64 = 1e-12;

/// Dry friction of the first joint.
fn dry(static_friction: f64, coulomb: f64, stribeck_rate: f64) -> Vec<JointFriction> {
    let dry = Some(DryFriction { static_friction, coulomb, stribeck_rate });
    vec![JointFriction { joint: 0, dry, drag: 0.0 }]
}

fn torque(profile: Profile) -> Drive {
    Drive::Torque { profile, limit: None }
}

/// The times of events, and what happens.
fn events(outcome: &Outcome) -> Vec<(f64, &str)> {
    let kind = |text: &str| {
        [": sticks", ": slides", ": slides back"].into_iter().find(|word| text.ends_with(word))
    };
    outcome.events.iter().map(|event| (event.time, kind(&event.text).unwrap_or("other"))).collect()
}

fn check_drift(outcome: &Outcome, bound: f64) {
    let drift = &outcome.drift;
    for part in [drift.energy, drift.linear, drift.angular].into_iter().flatten() {
        assert!(part < bound, "{drift:?}");
    }
}

/// A wheel of 0.2 kg m² about the axis x of a hub of 30 kg m², both coaxial: the reduced inertia J = 0.2 30 / 30.2
/// loses its rate by `u_c / J`.
#[test]
fn a_wheel_spins_down_and_sticks_when_the_closed_form_says() {
    let (rate, coulomb) = (7.0, 0.9);
    let reduced = 0.2 * 30.0 / 30.2;
    let stop = rate * reduced / coulomb;
    for integrator in [DOP853, RK4] {
        let mut scenario = scenario(&["wheel"], vec![wheel().into()], 3.0);
        scenario.settings.integrator = integrator;
        set_joint(&mut scenario, 0, [0.0, rate]);
        scenario.friction = dry(1.0, coulomb, 0.0);
        let (outcome, samples) = recorded(&scenario);
        assert!(matches!(outcome.end, End::Finished));
        let [(time, ": sticks")] = events(&outcome)[..] else { panic!("{:?}", outcome.events) };
        assert!((time - stop).abs() < TIME, "{:e}", time - stop);
        let spins = column(&samples, "wheel.spin").into_iter().zip(column(&samples, "time"));
        for (spin, at) in spins {
            let expected = if at < stop { rate - coulomb / reduced * at } else { 0.0 };
            assert!((spin - expected).abs() < ROUNDING * rate, "{at} {spin}");
        }
        assert_eq!(last(&samples, "wheel.spin"), 0.0);
        // The wheel has what is left of its momentum: of the whole spacecraft.
        let omega = 0.2 * rate / 30.2;
        assert!((last(&samples, "omega_x") - omega).abs() < ROUNDING);
        let heat = 0.5 * reduced * rate * rate;
        assert!((last(&samples, "work") + heat).abs() < ROUNDING * heat);
        check_drift(&outcome, 1e-13);
        // Constant while it slides; none is needed to hold it.
        let friction = column(&samples, "wheel.friction_theta");
        assert_eq!((friction[0], column(&samples, "wheel.u_w")[0]), (-coulomb, 0.0));
        assert!(last(&samples, "wheel.friction_theta").abs() < ROUNDING);
    }
}

/// A motor whose torque grows by `ramp` frees the joint at `u_s / ramp`; it then turns against `u_c`, by
/// `ramp (t² - t_0²) / 2 - u_c (t - t_0)` over J.
#[test]
fn a_ramp_of_torque_frees_a_joint_when_static_friction_is_exceeded() {
    // Also where nothing is left of the torque at first, and where the time is a round number.
    let cases = [(1.0, 0.7, 0.61, 0.4), (-1.0, 0.7, 0.61, 0.4), (1.0, 0.5, 0.25, 0.25)];
    for integrator in [DOP853, IntegratorChoice::Rk4 { step: 1e-3 }] {
        for (sign, ramp, fixed, coulomb) in cases {
            let free: f64 = fixed / ramp;
            let mut scenario = turning_panel(0.0, 2.0);
            scenario.settings.integrator = integrator;
            scenario.friction = dry(fixed, coulomb, 0.0);
            let values = [0.0, sign * ramp * 5.0];
            scenario.drives = vec![torque(Profile::Ramp { between: [0.0, 5.0], values })];
            let (outcome, samples) = recorded(&scenario);
            let [(time, ": slides")] = events(&outcome)[..] else { panic!("{:?}", outcome.events) };
            assert!((time - free).abs() < TIME, "{:e}", time - free);
            let end: f64 = 2.0;
            let rate = (0.5 * ramp * (end * end - free * free) - coulomb * (end - free)) / 0.8;
            let found = last(&samples, "panel.phi_dot");
            // RK4 holds the torque during a step of 1 ms.
            let bound = if integrator == DOP853 { 1e-11 } else { 0.5 * ramp * 1e-3 * end / 0.8 };
            assert!((found - sign * rate).abs() < bound, "{found} {rate}");
            let torques = column(&samples, "panel.u_p").into_iter().zip(column(&samples, "time"));
            let friction = column(&samples, "panel.friction_phi");
            for ((motor, at), friction) in torques.zip(friction) {
                let expected = if at < free { -sign * ramp * at } else { -sign * coulomb };
                assert!((friction - expected).abs() < ROUNDING, "{at} {friction} {expected}");
                let held = if integrator == DOP853 { 0.0 } else { 1e-3 * ramp };
                assert!((motor - sign * ramp * at).abs() <= held + ROUNDING, "{at} {motor}");
            }
        }
    }
}

/// With a spring k each half swing takes `pi sqrt(J / k)`, and its amplitude is `2 u_c / k` less than that of the one
/// before; it ends where the spring holds less than `u_s`.
#[test]
fn a_panel_on_a_spring_loses_the_same_of_its_amplitude_in_each_half_swing() {
    let (stiffness, coulomb, fixed, start) = (3.0_f64, 0.2, 0.3, 1.0_f64);
    let half = std::f64::consts::PI * (0.8 / stiffness).sqrt();
    for integrator in [DOP853, RK4] {
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 0.8));
        let passive = Passive::spring(stiffness, 0.0);
        let mut panel = HingedPanel::bare_panel(4.0, inertia);
        panel.passive.panel = passive;
        let mut scenario = scenario(&["panel"], vec![panel.into()], 12.0);
        scenario.hub_mode = HubMode::Fixed;
        scenario.settings.integrator = integrator;
        set_joint(&mut scenario, 0, [start, 0.0]);
        scenario.friction = dry(fixed, coulomb, 0.0);
        let (outcome, samples) = recorded(&scenario);
        // Released at the start; then the turning points and the end.
        let mut expected = vec![(0.0, ": slides")];
        let mut place = start;
        loop {
            place = -place.signum() * (place.abs() - 2.0 * coulomb / stiffness);
            let time = half * f64::from(u32::try_from(expected.len()).expect("few"));
            if stiffness * place.abs() <= fixed {
                expected.push((time, ": sticks"));
                break;
            }
            expected.push((time, ": slides back"));
        }
        assert_eq!(expected.len(), 8, "{expected:?}");
        let found = events(&outcome);
        // RK4 is off by the fourth power of 1.94 rad/s times its step, over 120.
        let bound = if integrator == DOP853 { TIME } else { 1e-8 };
        assert_eq!(found.len(), expected.len(), "{:?}", outcome.events);
        for ((found, what), (time, kind)) in found.iter().zip(&expected) {
            assert!((found - time).abs() < bound && what == kind, "{what} {:e}", found - time);
        }
        assert!((last(&samples, "panel.phi") - place).abs() < 10.0 * bound);
        assert_eq!(last(&samples, "panel.phi_dot"), 0.0);
        // The spring is what friction holds.
        let friction = last(&samples, "panel.friction_phi");
        assert!((friction - stiffness * place).abs() < 10.0 * bound, "{friction}");
        check_drift(&outcome, if integrator == DOP853 { 1e-12 } else { 1e-8 });
    }
}

/// Drag `c_2 |q'| q'` of an inertia J leaves `q' / (1 + c_2 q' t / J)` of the rate q'.
#[test]
fn quadratic_drag_slows_a_joint_by_its_closed_form() {
    let (rate, drag): (f64, f64) = (-3.0, 0.25);
    for integrator in [DOP853, RK4] {
        let mut scenario = turning_panel(rate, 5.0);
        scenario.settings.integrator = integrator;
        scenario.friction = vec![JointFriction { joint: 0, dry: None, drag }];
        let (outcome, samples) = recorded(&scenario);
        let times = column(&samples, "time").into_iter();
        for (time, found) in times.zip(column(&samples, "panel.phi_dot")) {
            let expected = rate / (1.0 + drag * rate.abs() * time / 0.8);
            assert!((found - expected).abs() < 1e-10, "{time} {:e}", found - expected);
        }
        assert!(outcome.events.is_empty());
        let rate = last(&samples, "panel.phi_dot");
        let friction = last(&samples, "panel.friction_phi");
        assert!((friction - drag * rate * rate).abs() < ROUNDING);
        check_drift(&outcome, if integrator == DOP853 { 1e-12 } else { 1e-9 });
    }
}

/// About Stribeck's rate friction falls from `u_s` to `u_c`: `J q'' = u - u_c - (u_s - u_c) exp(-(q'/q_s')²)`. With a motor
/// torque u the time from a rate to another is an integral over the rate.
#[test]
fn sliding_friction_falls_about_the_rate_of_stribeck() {
    let (fixed, coulomb, stribeck, motor) = (0.5, 0.2, 0.3_f64, 0.55);
    let accelerated = |rate: f64| {
        let share = rate / stribeck;
        (motor - coulomb - (fixed - coulomb) * (-share * share).exp()) / 0.8
    };
    for integrator in [DOP853, IntegratorChoice::Rk4 { step: 2e-3 }] {
        let mut scenario = turning_panel(0.0, 4.0);
        scenario.settings.integrator = integrator;
        scenario.friction = dry(fixed, coulomb, stribeck);
        scenario.drives = vec![torque(Profile::Constant(motor))];
        let (outcome, samples) = recorded(&scenario);
        assert_eq!(events(&outcome), [(0.0, ": slides")]);
        // Simpson's rule over 1 / q''.
        let end = last(&samples, "panel.phi_dot");
        let parts = 20_000_u32;
        let width = end / f64::from(parts);
        let sum: f64 = (0..=parts)
            .map(|k| {
                let weight = if k == 0 || k == parts { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
                weight / accelerated(f64::from(k) * width)
            })
            .sum();
        let time = sum * width / 3.0;
        assert!((time - 4.0).abs() < TIME, "{:e}", time - 4.0);
        check_drift(&outcome, 1e-9);
    }
}

/// A torque that swings about zero with less than `u_s` at first: what holds is searched between steps that nothing else
/// bounds.
#[test]
fn a_torque_that_swings_frees_a_joint_at_its_first_excess() {
    let (amplitude, frequency, fixed) = (0.5, 20.0, 0.4999);
    let sine = Profile::Sine { mean: 0.0, amplitude, frequency, phase: 0.0 };
    let free = 1.0 + (fixed / amplitude).asin() / (std::f64::consts::TAU * frequency);
    let during = Profile::During { between: [1.0, 2.0], profile: Box::new(sine) };
    for integrator in [DOP853, RK4] {
        let mut scenario = turning_panel(0.0, 1.2);
        scenario.settings.integrator = integrator;
        scenario.friction = dry(fixed, 0.1, 0.0);
        scenario.drives = vec![torque(during.clone())];
        let (outcome, _) = recorded(&scenario);
        let (time, what) = events(&outcome)[0];
        assert!((time - free).abs() < TIME && what == ": slides", "{time} {free}");
    }
}

/// The gimbal of a CMG on a hub that turns: the gyroscopic torque `h omega_y` is held by friction up to `u_s`, and is the
/// moment that the loads have about the axis of the gimbal.
#[test]
fn friction_holds_a_gimbal_against_its_gyroscopic_torque() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    for (omega, holds) in [(0.01, true), (0.03, false)] {
        let device = Vscmg::bare_wheel(4.0, disc);
        let mut scenario = scenario(&["cmg"], vec![device.into()], 0.5);
        set_joint(&mut scenario, 1, [0.0, 100.0]);
        scenario.initial.omega = Vector3::new(0.0, omega, 0.0);
        scenario.friction = dry(0.4, 0.3, 0.0);
        scenario.output.columns = ["cmg", "cmg.loads"].map(str::to_owned).into();
        let (outcome, samples) = recorded(&scenario);
        let torque = column(&samples, "cmg.friction_gamma")[0];
        let moment = column(&samples, "cmg.gimbal.load_moment_z")[0];
        if holds {
            // h omega of 20 N m s and 0.01 rad/s turns hub and device together: 50 and 0.1 kg m².
            assert!((torque + 0.2 * 50.0 / 50.1).abs() < ROUNDING, "{torque}");
            let friction = column(&samples, "cmg.friction_gamma");
            let moments = column(&samples, "cmg.gimbal.load_moment_z");
            for (friction, moment) in friction.iter().zip(&moments) {
                assert!((friction - moment).abs() < ROUNDING, "{friction} {moment}");
            }
            assert!(column(&samples, "cmg.gamma_dot").iter().all(|rate| *rate == 0.0));
            assert!(column(&samples, "cmg.u_g").iter().all(|torque| *torque == 0.0));
            assert!(outcome.events.is_empty());
        } else {
            assert!((torque + 0.3).abs() < ROUNDING && events(&outcome)[0].1 == ": slides");
            // Without a motor friction is all that there is about the axis.
            assert!((torque - moment).abs() < ROUNDING);
            assert!(column(&samples, "cmg.gamma_dot").iter().any(|rate| *rate > 0.01));
        }
        check_drift(&outcome, 1e-12);
    }
}

/// A brake has an impulse, which dry friction has not: a joint that sticks gives way to that of another, also one whose motor
/// has a largest rate, which is looked at before friction is.
#[test]
fn a_joint_that_sticks_gives_way_to_a_brake() {
    let mut scenario = scenario(&["a", "b"], vec![wheel().into(), wheel().into()], 1.0);
    set_joint(&mut scenario, 1, [0.0, 20.0]);
    scenario.friction = dry(5.0, 4.0, 0.0);
    scenario.changes = vec![Change { time: 0.5, joint: 1, action: Action::Brake }];
    gives_way(&scenario);
    let limits = MotorLimits { torque: Some(1.0), rate: Some(50.0), ..MotorLimits::default() };
    let limited = Drive::Torque { profile: Profile::Constant(0.0), limit: Some(limits) };
    scenario.drives = vec![limited, torque(Profile::Constant(0.0))];
    gives_way(&scenario);
}

fn gives_way(scenario: &Scenario) {
    let (outcome, _) = recorded(scenario);
    let found: Vec<_> = outcome.events.iter().map(|event| event.text.as_str()).collect();
    assert!(
        found[0].starts_with("b.theta: braked, ") && found[1] == "a.theta: slides",
        "{found:?}"
    );
    // 4 N m of friction on what 0.2 kg m² have got of the hub's jump of 0.2 20 / 30.4 rad/s.
    let jump = 0.2 * 20.0 / (30.0 + 0.4) * (30.2 + 0.2) / 30.2;
    assert_eq!(found[2], "a.theta: sticks");
    assert!(outcome.events[2].time - 0.5 < 0.2 * jump / 4.0, "{:?}", outcome.events);
    check_drift(&outcome, 1e-13);
}

#[test]
fn side_by_side_a_run_with_friction_has_the_numbers_that_it_has_by_itself() {
    let with = |rate: f64| -> Scenario {
        let mut scenario = scenario(&["wheel"], vec![wheel().into()], 1.0);
        scenario.settings.integrator = RK4;
        set_joint(&mut scenario, 0, [0.0, rate]);
        scenario.friction = dry(1.0, 0.9, 0.5);
        scenario
    };
    let scenarios = [with(2.0), with(3.0)];
    let alone = scenarios.each_ref().map(|scenario| recorded(scenario).1.rows);
    let mut samples = [crate::record::Samples::default(), crate::record::Samples::default()];
    let runs = scenarios
        .iter()
        .zip(&mut samples)
        .map(|(scenario, samples)| (scenario, samples as &mut dyn crate::record::Recorder));
    let results = crate::engine::run_side_by_side(
        runs.collect(),
        crate::engine::RunQuantities::All,
        &mut || std::ops::ControlFlow::Continue(()),
    );
    assert!(results.iter().all(Result::is_ok));
    for (alone, samples) in alone.iter().zip(&samples) {
        assert_eq!(alone, &samples.rows);
    }
}

#[test]
fn friction_that_is_none_is_rejected_with_its_key() {
    let mut scenario = turning_panel(0.0, 1.0);
    scenario.friction = dry(0.1, 0.2, -1.0);
    let Err(error) = Run::new(&scenario) else { panic!("accepted") };
    let text = error.to_string();
    for part in [
        "device.panel.panel.stribeck_rate: -1 rad/s; it is not negative",
        "device.panel.panel.static_friction: 0.1 N m is below the Coulomb friction of 0.2 N m",
    ] {
        assert!(text.contains(part), "{text}");
    }
}
