//! Units of data sheets, converted where they enter and leave: everything else is SI and radians.
//!
//! `from_x` takes a number in the unit x and gives it in SI, `to_x` the reverse. Each is right to
//! two or three roundings of its type, and passes on what is not finite.

use crate::numbers::real::Scalar;

/// Angular velocity, rad/s, from revolutions per minute.
#[must_use]
pub fn from_rpm<T: Scalar>(value: T) -> T {
    value * pi() * T::from_f64(30.0).recip()
}

/// Revolutions per minute from an angular velocity, rad/s.
#[must_use]
pub fn to_rpm<T: Scalar>(spin: T) -> T {
    spin * T::from_f64(30.0) * pi::<T>().recip()
}

/// Angle, rad, from degrees.
#[must_use]
pub fn from_deg<T: Scalar>(value: T) -> T {
    value * (pi::<T>() * T::from_f64(180.0).recip())
}

/// Degrees from an angle, rad.
#[must_use]
pub fn to_deg<T: Scalar>(angle: T) -> T {
    angle * (T::from_f64(180.0) * pi::<T>().recip())
}

/// Static imbalance, kg m, from g cm.
#[must_use]
pub fn from_g_cm<T: Scalar>(value: T) -> T {
    value * T::from_f64(1e5).recip()
}

/// g cm from a static imbalance, kg m.
#[must_use]
pub fn to_g_cm<T: Scalar>(u_s: T) -> T {
    u_s * T::from_f64(1e5)
}

/// Dynamic imbalance, kg m², from g cm².
#[must_use]
pub fn from_g_cm2<T: Scalar>(value: T) -> T {
    value * T::from_f64(1e7).recip()
}

/// g cm² from a dynamic imbalance, kg m².
#[must_use]
pub fn to_g_cm2<T: Scalar>(u_d: T) -> T {
    u_d * T::from_f64(1e7)
}

/// Length, m, from cm.
#[must_use]
pub fn from_cm<T: Scalar>(value: T) -> T {
    value * T::from_f64(1e2).recip()
}

/// Length, m, from mm.
#[must_use]
pub fn from_mm<T: Scalar>(value: T) -> T {
    value * T::from_f64(1e3).recip()
}

/// Torque, N m, from mN m.
#[must_use]
pub fn from_mn_m<T: Scalar>(value: T) -> T {
    value * T::from_f64(1e3).recip()
}

/// Half a turn, to twice the digits of `f64`: the nearest `f64`, and what that leaves out.
fn pi<T: Scalar>() -> T {
    T::from_f64(core::f64::consts::PI) + T::from_f64(1.224_646_799_147_353_2e-16)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A conversion rounds its factor and its product, sometimes pi too, by half an epsilon each.
    const ONE_WAY: f64 = 1.5 * f64::EPSILON;

    fn assert_close(found: f64, expected: f64, roundings: f64) {
        assert!((found - expected).abs() <= roundings * expected.abs(), "{found}, not {expected}");
    }

    #[test]
    fn units_have_their_size() {
        for (found, expected) in [
            (from_rpm(60.0), 2.0 * core::f64::consts::PI),
            (from_deg(180.0), core::f64::consts::PI),
            (from_g_cm(32.0), 32e-3 * 1e-2),
            (from_g_cm2(15.4), 15.4e-3 * 1e-4),
            (from_cm(30.0), 0.3),
            (from_mm(8.0), 0.008),
            (from_mn_m(250.0), 0.25),
        ] {
            assert_close(found, expected, ONE_WAY);
        }
    }

    #[test]
    fn half_a_turn_is_that_of_either_precision() {
        assert_eq!(pi::<f64>(), core::f64::consts::PI);
        assert_eq!(pi::<f32>(), core::f32::consts::PI);
    }

    #[test]
    fn every_unit_leads_back() {
        for value in [-6000.0, 0.0, 15.4, 32.0, 40.0, 500.0] {
            for back in [
                to_rpm(from_rpm(value)),
                to_deg(from_deg(value)),
                to_g_cm(from_g_cm(value)),
                to_g_cm2(from_g_cm2(value)),
            ] {
                assert_close(back, value, 2.0 * ONE_WAY);
            }
        }
    }
}
