//! The scalar against digits computed elsewhere (60-digit arithmetic) and against exact identities.

use precess_dynamics::{Angle, Real, Scalar};

use precess_tests::random::Random;

use super::DoubleDouble;

/// Arithmetic loses at most 10 u^2 = 1.3e-31 an operation; the tests chain up to six.
const ARITHMETIC: f64 = 1e-30;

/// Two series of fifteen terms with a division each, on an argument below pi / 4.
const SINE: f64 = 1e-31;

/// The decimal digits as a double-double: 31 digits are exact, each further one is worth `1e-31`.
fn digits(text: &str) -> DoubleDouble {
    let ten = DoubleDouble::from_f64(10.0);
    let (mut value, mut scale) = (DoubleDouble::from_f64(0.0), DoubleDouble::from_f64(1.0));
    let mut after_point = false;
    for character in text.trim_start_matches('-').chars().take(34) {
        let Some(digit) = character.to_digit(10) else {
            after_point = true;
            continue;
        };
        value = value * ten + DoubleDouble::from_f64(f64::from(digit));
        if after_point {
            scale = scale * ten;
        }
    }
    let magnitude = value / scale;
    if text.starts_with('-') { -magnitude } else { magnitude }
}

fn number(value: f64) -> DoubleDouble {
    DoubleDouble::from_f64(value)
}

#[track_caller]
fn assert_close(value: DoubleDouble, expected: DoubleDouble, tolerance: f64) {
    let error = (value - expected).abs().to_f64();
    let bound = tolerance * expected.abs().to_f64().max(1.0);
    assert!(error <= bound, "{value:?} is {error:e} away from {expected:?}, allowed {bound:e}");
}

#[test]
fn quotients_have_the_known_digits() {
    assert_close(
        number(1.0) / number(3.0),
        digits("0.333333333333333333333333333333333333"),
        1e-31,
    );
    assert_close(
        number(1.0) / number(7.0),
        digits("0.142857142857142857142857142857142857"),
        1e-31,
    );
    assert_close(
        number(22.0) / number(7.0),
        digits("3.14285714285714285714285714285714285"),
        1e-30,
    );
}

#[test]
fn roots_have_the_known_digits() {
    assert_close(
        number(2.0).sqrt(),
        digits("1.41421356237309504880168872420969807856967188"),
        1e-31,
    );
    assert_close(
        number(0.5).sqrt(),
        digits("0.707106781186547524400844362104849039284835938"),
        1e-31,
    );
    let large = number(1e10) + number(1.0);
    assert_close(large.sqrt(), digits("100000.000004999999999875000000006249999999609"), 1e-31);
    assert_eq!(number(0.0).sqrt(), number(0.0));
}

#[test]
fn sines_and_cosines_have_the_known_digits() {
    let known = [
        (
            1.0,
            "0.841470984807896506652502321630298999622563061",
            "0.540302305868139717400936607442976603732310421",
        ),
        (
            0.1,
            "0.0998334166468281578301968678586166677359655721",
            "0.995004165278025765541375198862345256348080084",
        ),
        (
            -2.5,
            "-0.598472144103956494051854702186162271703597172",
            "-0.801143615546933714833502790467351664428567849",
        ),
        (
            22.0,
            "-0.00885130929040387592169025681577233246328920395",
            "-0.999960826394637126454174739212693774135988467",
        ),
        (
            12_345.678,
            "-0.704081313753381585414566490626715364171410044",
            "0.710119358716062773648715997163551540029889221",
        ),
        (
            1e6,
            "-0.349993502171292952117652486780771469061406605",
            "0.936752127533144786938532535074918775708097804",
        ),
    ];
    for (angle, sine, cosine) in known {
        let (s, c) = number(angle).sin_cos();
        assert_close(s, digits(sine), SINE);
        assert_close(c, digits(cosine), SINE);
    }
}

/// Near a multiple of pi / 2 the small one of the two keeps its digits: it is what the angle lacks.
#[test]
fn small_sines_and_cosines_keep_their_digits() {
    let (sine, _) = number(core::f64::consts::PI).sin_cos();
    let scaled = sine * number(1e16);
    assert_close(scaled, digits("1.2246467991473531772260659322749979970830539"), ARITHMETIC);
    let (_, cosine) = number(core::f64::consts::FRAC_PI_2).sin_cos();
    let scaled = cosine * number(1e17);
    assert_close(scaled, digits("6.1232339957367658861303296613750014646403778"), ARITHMETIC);
}

#[test]
fn squares_of_sine_and_cosine_sum_to_one() {
    let mut random = Random::new(11);
    for _ in 0..1000 {
        let angle = DoubleDouble::sum(random.within(-1000.0, 1000.0), random.within(-1e-14, 1e-14));
        let (s, c) = angle.sin_cos();
        assert_close(s * s + c * c, number(1.0), ARITHMETIC);
    }
}

#[test]
fn products_and_quotients_undo_each_other() {
    let mut random = Random::new(12);
    for _ in 0..10_000 {
        let mut draw = || DoubleDouble::sum(random.within(1.0, 2.0), random.within(-1e-16, 1e-16));
        let (a, b) = (draw(), draw());
        assert_close(a / b * b, a, ARITHMETIC);
        assert_close(b.recip() * b, number(1.0), ARITHMETIC);
        assert_close((a + b) * (a - b), a * a - b * b, ARITHMETIC);
        assert_close(a.sqrt() * a.sqrt(), a, ARITHMETIC);
    }
}

/// A product of two 53-bit integers has at most 106 bits: the pair holds it without error.
#[test]
fn products_of_integers_are_exact() {
    let mut random = Random::new(13);
    for _ in 0..1000 {
        let (a, b) = (random.bits() >> 11, random.bits() >> 11);
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let product = number(a as f64) * number(b as f64);
        #[expect(clippy::cast_possible_truncation, reason = "both parts are integers")]
        let exact = product.high() as i128 + product.low() as i128;
        assert_eq!(exact, i128::from(a) * i128::from(b));
    }
}

#[test]
fn cancellation_leaves_the_small_part() {
    let a = DoubleDouble::sum(1.0, 1e-25);
    assert_eq!((a - number(1.0)).to_f64(), 1e-25);
}
