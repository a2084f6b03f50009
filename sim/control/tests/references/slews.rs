//! Turns from rest to rest: ends, limits, the segments that each case has, and the least time.

use precess_control::{ControlError, Profile, TurnLimits};

const NONE: f64 = f64::INFINITY;

/// Roundings of a sum of a few terms, relative.
const ROUNDING: f64 = 1e-14;

struct Case {
    angle: f64,
    limits: [f64; 3],
    duration: f64,
    peak_rate: f64,
    peak_acceleration: f64,
}

/// Durations by hand.
fn cases() -> Vec<Case> {
    let case = |angle, limits, duration, peak_rate, peak_acceleration| Case {
        angle,
        limits,
        duration,
        peak_rate,
        peak_acceleration,
    };
    vec![
        // Seven segments: jerk 0.5 s, constant 1.5 s, and 2 rad at 1 rad/s less 2.5 s at half of it at each end.
        case(4.0, [1.0, 0.5, 1.0], 6.5, 1.0, 0.5),
        // The rate limit is just reached.
        case(2.5, [1.0, 0.5, 1.0], 5.0, 1.0, 0.5),
        // No constant rate: 0.5 (0.5 + 1) (1 + 1) = 1.5, 2 s up.
        case(1.5, [1.0, 0.5, 1.0], 4.0, 0.75, 0.5),
        // The acceleration limit is just reached: 2 j t³ with t = 0.5.
        case(0.25, [1.0, 0.5, 1.0], 2.0, 0.25, 0.5),
        // Jerk only: 2 j t³ with t = 0.1.
        case(0.002, [1.0, 0.5, 1.0], 0.4, 0.01, 0.1),
        // The rate limit before the acceleration limit: up by two segments of 0.2 s.
        case(1.0, [0.04, 0.5, 1.0], 25.4, 0.04, 0.2),
        // And an angle for which it is not reached.
        case(0.002, [0.04, 0.5, 1.0], 0.4, 0.01, 0.1),
        // Both limits, the acceleration's just before the rate's: 0.5 s, 0.1 s and 0.5 s up.
        case(0.9, [0.3, 0.5, 1.0], 4.1, 0.3, 0.5),
        // Without limit on jerk: trapezoid, triangle.
        case(4.0, [1.0, 0.5, NONE], 6.0, 1.0, 0.5),
        case(0.5, [1.0, 0.5, NONE], 2.0, 0.5, 0.5),
        // Without limit on rate.
        case(1.5, [NONE, 0.5, 1.0], 4.0, 0.75, 0.5),
        case(0.5, [NONE, 0.5, NONE], 2.0, 0.5, 0.5),
        // Without limit on acceleration, and on jerk only.
        case(1.0, [0.04, NONE, 1.0], 25.4, 0.04, 0.2),
        case(0.002, [NONE, NONE, 1.0], 0.4, 0.01, 0.1),
        // Nothing to turn.
        case(0.0, [1.0, 0.5, 1.0], 0.0, 0.0, 0.0),
        case(0.0, [1.0, 0.5, NONE], 0.0, 0.0, 0.0),
    ]
}

fn limits([rate, acceleration, jerk]: [f64; 3]) -> TurnLimits {
    TurnLimits { rate, acceleration, jerk }
}

#[test]
fn every_case_has_the_duration_and_the_peaks_by_hand() {
    const STEPS: u32 = 20_000;
    for case in cases() {
        let profile = Profile::new(case.angle, &limits(case.limits)).unwrap();
        let duration = profile.duration();
        assert!((duration - case.duration).abs() <= ROUNDING * 10.0, "{duration}");
        let (mut rate, mut acceleration) = (0.0_f64, 0.0_f64);
        let mut before = profile.at(0.0);
        assert_eq!((before.angle, before.rate), (0.0, 0.0));
        let step = duration / f64::from(STEPS);
        for k in 0..=STEPS {
            let now = profile.at(step * f64::from(k));
            rate = rate.max(now.rate);
            acceleration = acceleration.max(now.acceleration.abs());
            assert!(now.angle >= before.angle && now.angle <= case.angle * (1.0 + ROUNDING));
            // The mean value theorem, at segments' ends, too; no jump of what a limit keeps from jumping.
            let [rate_limit, acceleration_limit, jerk_limit] = case.limits;
            let within =
                |change: f64, limit: f64| change.abs() <= limit * step * (1.0 + 1e-6) + 1e-15;
            assert!(within(now.angle - before.angle, rate_limit), "{k}");
            assert!(within(now.rate - before.rate, acceleration_limit), "{k}");
            assert!(
                step == 0.0 || within(now.acceleration - before.acceleration, jerk_limit),
                "{k}"
            );
            before = now;
        }
        let end = profile.at(duration);
        assert_eq!((end.angle, end.rate), (case.angle, 0.0));
        assert!((rate - case.peak_rate).abs() < 1e-7, "{rate}");
        assert!(acceleration <= case.peak_acceleration * (1.0 + ROUNDING));
        // Where the acceleration peaks between two of the times, by what jerk makes of a step.
        let jerk = if case.limits[2].is_finite() { case.limits[2] } else { 0.0 };
        assert!(acceleration >= case.peak_acceleration * (1.0 - ROUNDING) - jerk * step);
    }
}

/// Angle and rate at the middle are those of either half, and a turn back in time is the turn.
#[test]
fn a_turn_is_its_own_mirror() {
    for case in cases().iter().filter(|case| case.angle > 0.0) {
        let profile = Profile::new(case.angle, &limits(case.limits)).unwrap();
        let duration = profile.duration();
        for share in [0.01, 0.2, 0.37, 0.499, 0.5] {
            let (early, late) =
                (profile.at(share * duration), profile.at((1.0 - share) * duration));
            assert!((early.angle + late.angle - case.angle).abs() < ROUNDING * case.angle * 10.0);
            assert!((early.rate - late.rate).abs() < 1e-13);
            assert!(share == 0.5 || (early.acceleration + late.acceleration).abs() < 1e-12);
        }
    }
}

#[test]
fn limits_that_are_none_are_rejected() {
    let rejected = |angle, of| Profile::new(angle, &limits(of)).unwrap_err();
    assert_eq!(
        rejected(1.0, [0.0, 1.0, 1.0]),
        ControlError::NotPositive { what: "rate limit", value: 0.0 }
    );
    assert_eq!(
        rejected(-1.0, [1.0, 1.0, 1.0]),
        ControlError::Negative { what: "angle", value: -1.0 }
    );
    let both = rejected(1.0, [1.0, NONE, NONE]);
    assert_eq!(
        both.to_string(),
        "jerk limit without acceleration limit is inf; it must be finite and positive"
    );
}
