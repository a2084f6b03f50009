//! What the reduction's proof says of pi / 2 in parts, and the core at numbers of any sign.
//!
//! The suite `sines` measures the accuracy, against a wider number.

use crate::numbers::sincos::{HALF_PI, LARGEST_ANGLE, QuarterTurns, sin_cos};

/// Pi / 2 in units of `2^-124`, cut there; the next 16 binary digits are [`NEXT`].
const DIGITS: u128 = 0x1921_fb54_442d_1846_9898_cc51_701b_839a;

const NEXT: u64 = 0x2520;

/// Angles a hundredth apart around zero, others over the whole range, zeros and the smallest
/// number.
fn angles() -> impl Iterator<Item = f64> {
    let near = (-2000..=2000).map(|step| f64::from(step) / 100.0);
    let far = (-2000..=2000).map(|step| f64::from(step) / 2000.0 * LARGEST_ANGLE);
    near.chain(far).chain([-0.0, 5e-324, -5e-324, 45.553_093_477_052, 14_461_176.670_278_38])
}

#[test]
fn parts_of_half_pi_are_its_digits_in_turn() {
    // In units of 2^-82, of which every one of the first three is a whole number.
    let unit = f64::EPSILON * 2.0_f64.powi(-30);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, positive")]
    let whole = |part: f64| (part / unit) as u128;
    let [first, second, third, fourth] = HALF_PI;
    assert_eq!(whole(first) + whole(second) + whole(third), DIGITS >> 42);
    assert_eq!(whole(first) % (1 << 54), 0, "a multiple of 2^-28");
    assert_eq!(whole(second) % (1 << 29), 0, "a multiple of 2^-53");
    assert!(
        second < 2.0_f64.powi(-29) && third < 2.0_f64.powf(-53.8) && fourth < 2.0_f64.powi(-85)
    );

    // The 58 digits from 2^-83 to 2^-140; the rounding keeps those down to 2^-138.
    let left = ((DIGITS % (1 << 42)) as u64) << 16 | NEXT;
    #[expect(clippy::cast_precision_loss, reason = "rounding is intended")]
    let rounded = left as f64;
    assert_eq!(fourth, rounded * 2.0_f64.powi(-140));
}

#[test]
fn products_of_the_first_three_parts_with_whole_quarter_turns_are_exact() {
    let most = (LARGEST_ANGLE * core::f64::consts::FRAC_2_PI).round();
    for part in &HALF_PI[..3] {
        for k in [1.0, 3.0, 4_194_303.0, 8_388_607.0, most - 1.0, most] {
            assert_eq!(libm::fma(k, *part, -(k * part)), 0.0, "{k} {part:e}");
        }
    }
}

#[test]
fn quarter_turns_are_counted_modulo_four_either_way() {
    let (s, c) = (0.25, -0.5);
    for (k, turned) in [(0, (s, c)), (1, (c, -s)), (2, (-s, -c)), (3, (-c, s))] {
        for turns in [-4_000_000, -1, 0, 1, 4_000_000] {
            let count = 1.5 * 2.0_f64.powi(52) + f64::from(4 * turns + k);
            assert_eq!(f64::turned(count, s, c), turned);
        }
    }
}

#[test]
fn sine_is_odd_and_cosine_even_to_the_bit() {
    for angle in angles() {
        let (there, back) = (sin_cos(angle), sin_cos(-angle));
        assert_eq!((-back.0).to_bits(), there.0.to_bits(), "{angle}");
        assert_eq!(back.1.to_bits(), there.1.to_bits(), "{angle}");
    }
}

#[test]
fn no_number_has_no_sine() {
    for angle in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let (sine, cosine) = sin_cos(angle);
        assert!(sine.is_nan() && cosine.is_nan(), "{angle}");
    }
}
