//! Imbalance in double-double: neither the conversion to the wheel's parameters and back nor a
//! change of units rounds to `f64`.

use precess_dynamics::units::{
    from_deg, from_g_cm, from_g_cm2, from_rpm, to_g_cm, to_g_cm2, to_rpm,
};
use precess_dynamics::{Angle, Imbalance, Scalar};
use precess_tests::double_double::DoubleDouble as Wide;

/// Some ten operations, each right to 1.2e-31 or better, on numbers of size one.
const ROUNDING: f64 = 1e-30;

fn wide(value: f64) -> Wide {
    Wide::from_f64(value)
}

#[track_caller]
fn assert_close(found: Wide, expected: Wide, size: f64) {
    let error = (found - expected).to_f64().abs();
    assert!(error <= ROUNDING * size, "{found:?} is not {expected:?}: {error:e}");
}

#[test]
fn imbalance_comes_back_in_double_double() {
    for phase in [0.0, 0.1, 0.7, 1.5, 2.3, 3.1, -0.4, -1.6, -2.9] {
        let given = Imbalance {
            u_s: from_g_cm(wide(32.0)),
            u_d: from_g_cm2(wide(15.4)),
            // Not a number that f64 has.
            phase: wide(phase) + wide(1e-20),
        };
        let m_w = wide(3.7);
        let wheel = given.in_wheel(m_w).unwrap_or_else(|error| panic!("{error}"));
        let back = wheel.lumped(m_w).unwrap_or_else(|error| panic!("{error}"));
        assert_close(to_g_cm(back.u_s), wide(32.0), 32.0);
        assert_close(to_g_cm2(back.u_d), wide(15.4), 15.4);
        assert_close(back.phase, given.phase, 1.0);
    }
}

#[test]
fn half_a_turn_has_all_digits() {
    let (sine, _) = from_deg(wide(180.0)).sin_cos();
    assert_close(sine, wide(0.0), 1.0);
    assert_close(to_rpm(from_rpm(wide(500.0))), wide(500.0), 500.0);
}
