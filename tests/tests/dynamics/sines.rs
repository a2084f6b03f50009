//! Sine and cosine of the solver's `f64` against 31 digits, over all angles and at the hardest ones.
//!
//! Run with `--nocapture` to see the figures.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use precess_dynamics::{Angle, Scalar};
use precess_tests::double_double::DoubleDouble;
use precess_tests::random::Random;

/// Angles tried of each sort.
const ANGLES: u32 = 100_000;

/// Where the solver changes to libm's sines, rad.
const LARGEST_ANGLE: f64 = 16_777_216.0;

/// Error in units of the result's last place: half for the last rounding, the rest for the few
/// before it. 1.2e8 angles of the sorts below have shown 0.83; the same of libm's, 0.80.
const LAST_PLACES: f64 = 0.9;

/// Error where one of the two is nearly zero: a last rounding, and the reduction's `2^-114` of an
/// angle that is off a multiple of pi / 2 by `2^-60.5` or more.
const LAST_PLACES_NEAR_ZERO: f64 = 0.55;

/// `value` against `exact`, in units of the last place of the exact value rounded.
fn last_places(value: f64, exact: DoubleDouble) -> f64 {
    let magnitude = exact.high().abs();
    let unit = f64::from_bits(magnitude.to_bits() + 1) - magnitude;
    (DoubleDouble::from_f64(value) - exact).abs().to_f64() / unit
}

/// The errors of both at one angle.
fn errors(angle: f64) -> [f64; 2] {
    let (sine, cosine) = Angle::sin_cos(angle);
    let (exact_sine, exact_cosine) = DoubleDouble::from_f64(angle).sin_cos();
    [last_places(sine, exact_sine), last_places(cosine, exact_cosine)]
}

/// The larger error, over many angles drawn by `draw`, and the angle that shows it.
fn worst(seed: u64, mut draw: impl FnMut(&mut Random) -> f64) -> (f64, f64) {
    let mut random = Random::new(seed);
    let larger = |a: (f64, f64), b: (f64, f64)| if b.0 > a.0 { b } else { a };
    (0..ANGLES)
        .map(|_| draw(&mut random))
        .flat_map(|angle| errors(angle).map(|error| (error, angle)))
        .fold((0.0, f64::NAN), larger)
}

/// A whole number of quarter turns, log-uniform up to what [`LARGEST_ANGLE`] holds.
fn quarters(random: &mut Random) -> f64 {
    random.log_within(1.0, LARGEST_ANGLE / FRAC_PI_2 - 2.0).round()
}

#[test]
fn sines_are_right_to_the_last_place() {
    for (seed, largest) in [(1, FRAC_PI_4), (2, TAU), (3, 1e4), (4, LARGEST_ANGLE)] {
        let (error, angle) = worst(seed, |random| random.within(-largest, largest));
        println!("{error:.4} of the last place up to {largest:e} rad, at {angle:e}");
        assert!(error <= LAST_PLACES, "{error} of the last place at {angle:e}, seed {seed}");
    }
}

/// There the polynomials are longest and the reduced angle goes over to the next quarter.
#[test]
fn sines_are_right_around_odd_eighths_of_a_turn() {
    let (error, angle) =
        worst(5, |random| (quarters(random) + 0.5) * FRAC_PI_2 + random.within(-0.1, 0.1));
    println!("{error:.4} of the last place, at {angle:e}");
    assert!(error <= LAST_PLACES, "{error} of the last place at {angle:e}");
}

#[test]
fn sines_keep_their_digits_next_to_whole_quarter_turns() {
    let (error, angle) = worst(6, |random| {
        let near = (quarters(random) * FRAC_PI_2).to_bits();
        f64::from_bits(near + random.bits() % 9 - 4)
    });
    println!("{error:.4} of the last place, at {angle:e}");
    assert!(error <= LAST_PLACES_NEAR_ZERO, "{error} of the last place at {angle:e}");
}

/// The angles up to [`LARGEST_ANGLE`] that lie nearest to a multiple of pi / 2, from its continued
/// fraction, with the small one of the two in 60-digit arithmetic.
#[test]
fn sines_keep_their_digits_at_the_hardest_angles() {
    let hardest: [(f64, f64); 6] = [
        (45.553_093_477_052, -6.189_806_365_883_577e-19),
        (91.106_186_954_104, -1.237_961_273_176_715_4e-18),
        (14_461_176.670_278_38, -1.698_503_829_898_600_4e-18),
        (1_698_673.284_962_942_4, -5.038_136_613_397_025e-17),
        (321_307.959_442_222_9, -4.429_600_834_596_129e-17),
        (FRAC_PI_2, 6.123_233_995_736_766e-17),
    ];
    for (angle, small) in hardest {
        let (sine, cosine) = Angle::sin_cos(angle);
        let found = if sine.abs() < cosine.abs() { sine } else { cosine };
        assert_eq!(found, small, "{angle}");
        assert!(errors(angle).iter().all(|error| *error <= LAST_PLACES_NEAR_ZERO), "{angle}");
    }
}

/// A signed zero, the smallest number, every power of two, and both sides of the change to libm.
#[test]
fn sine_is_odd_and_cosine_even_to_the_bit() {
    let bits = |angle: f64| {
        let (sine, cosine) = Angle::sin_cos(angle);
        (sine.to_bits(), cosine.to_bits())
    };
    let powers = (-1074..=1023).map(|power| libm::ldexp(1.0, power));
    let mut random = Random::new(7);
    let drawn = (0..ANGLES).map(|_| random.log_within(1e-3, 1e9));
    for angle in [0.0].into_iter().chain(powers).chain(drawn) {
        let ((sine, cosine), (mirrored, same)) = (bits(angle), bits(-angle));
        assert_eq!((mirrored, same), (sine ^ (1 << 63), cosine), "{angle:e}");
    }
    assert_eq!(bits(0.0), (0, 1.0_f64.to_bits()));
}

#[test]
fn angles_beyond_the_largest_have_libms_sines() {
    for angle in [LARGEST_ANGLE.next_up(), 1e9, 1e22, f64::MAX] {
        assert_eq!(Angle::sin_cos(angle), libm::sincos(angle));
    }
    for angle in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let (sine, cosine) = Angle::sin_cos(angle);
        assert!(sine.is_nan() && cosine.is_nan(), "{angle}");
    }
}
