//! Sine and cosine of a double-double angle, absolute error below `1e-31`, small results included.

use precess_dynamics::{Real, Scalar};

use super::{DoubleDouble, two_product};

/// Pi / 2 in three parts, 159 bits: the part left out, times the number of quarter turns, is below
/// `1e-33` for angles up to [`LARGEST_ANGLE`].
const HALF_PI: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Far more turns than any test makes; beyond it the result is NaN instead of a wrong digit.
const LARGEST_ANGLE: f64 = 1e12;

/// Terms of each series: the first one left out is below `(pi/4)^30 / 30! = 3e-36`.
const TERMS: u32 = 14;

/// Sine and cosine of `angle`, radians.
pub(super) fn sin_cos(angle: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    if !angle.is_finite() || angle.high.abs() > LARGEST_ANGLE {
        let nan = DoubleDouble::from_f64(f64::NAN);
        return (nan, nan);
    }
    let quarters = (angle.high / HALF_PI[0]).round();
    let mut rest = angle;
    for part in HALF_PI {
        let (high, low) = two_product(quarters, part);
        rest = rest - DoubleDouble { high, low };
    }
    let (sine, cosine) = (sine_series(rest), cosine_series(rest));
    #[expect(clippy::cast_possible_truncation, reason = "an integer below 1e12")]
    match (quarters as i64).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// `x (1 - x^2/(2 3) (1 - x^2/(4 5) (1 - ...)))`, from the inside out.
fn sine_series(x: DoubleDouble) -> DoubleDouble {
    let one = DoubleDouble::from_f64(1.0);
    let bracket = (1..=TERMS).rev().fold(one, |inner, k| {
        let divisor = f64::from(2 * k * (2 * k + 1));
        one - x * x * DoubleDouble::from_f64(divisor).recip() * inner
    });
    x * bracket
}

/// `1 - x^2/(1 2) (1 - x^2/(3 4) (1 - ...))`, from the inside out.
fn cosine_series(x: DoubleDouble) -> DoubleDouble {
    let one = DoubleDouble::from_f64(1.0);
    (1..=TERMS).rev().fold(one, |inner, k| {
        let divisor = f64::from((2 * k - 1) * 2 * k);
        one - x * x * DoubleDouble::from_f64(divisor).recip() * inner
    })
}
