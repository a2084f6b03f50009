//! Parsing of quantities: numbers, then a unit.
//!
//! ```text
//! quantity  = number ("," number)* unit          -0.02, 0.01, 10 cm
//! unit      = power (("*" | "·" | "/" | "-" | "." | " ") power)*      a "/" divides by the next power only
//! power     = (symbol | "(" unit ")") (("^" | "**") integer | superscript digits | digit | "-" digit)?
//! ```
//!
//! Spellings of data sheets are read where they have one reading (`N-m`, `g.cm`, `gcm`, `m/s2`, `RPM`); of others the
//! error names the readings. Hertz are a unit of a frequency and of a spectral density only: of a rate they would
//! leave a factor of 2 pi open.

use super::error::{UnitError, UnitErrorKind};
use super::measure::{Dimension, Measure, measure_of};
use super::unit::{ONE, Scale, scale_of};

/// Numbers of one unit, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The numbers, SI.
    pub values: Vec<f64>,
    /// Their dimension.
    pub dimension: Dimension,
    /// The unit as written; empty of a pure number.
    pub unit: String,
}

impl Quantity {
    /// What it is, in words: `a length`.
    #[must_use]
    pub fn name(&self) -> String {
        let named = measure_of(self.dimension).map(|measure| measure.name.to_owned());
        named.unwrap_or_else(|| format!("in {}", self.dimension))
    }

    /// Whether a measure has its dimension.
    #[must_use]
    pub fn is(&self, measure: Measure) -> bool {
        self.dimension == measure.dimension || Some(self.dimension) == measure.also
    }
}

/// Numbers and their unit.
///
/// # Errors
/// The first place at which the text is no quantity.
pub fn parse_quantity(text: &str) -> Result<Quantity, UnitError> {
    let mut numbers = Vec::new();
    let mut at = 0;
    loop {
        at = skip(text, at);
        let end = number_end(text, at);
        if end == at {
            return Err(no_number(text, at));
        }
        numbers.push(at..end);
        at = skip(text, end);
        match text.get(at..).and_then(|rest| rest.strip_prefix(',')) {
            Some(_) => at += 1,
            None => break,
        }
    }
    let rest = text.get(at..).unwrap_or_default();
    let scale = if rest.trim().is_empty() { ONE } else { scale_of(text, at)? };
    let values = numbers.into_iter().map(|at| value(text, at, scale)).collect::<Result<_, _>>()?;
    Ok(Quantity { values, dimension: scale.dimension, unit: rest.trim().to_owned() })
}

/// The size of a unit in SI, and its dimension.
///
/// # Errors
/// The first place at which the text is no unit.
pub fn parse_unit(text: &str) -> Result<(f64, Dimension), UnitError> {
    let scale = scale_of(text, 0)?;
    let size = format!("1e{}", scale.ten).parse::<f64>().unwrap_or(f64::NAN) * scale.factor;
    Ok((size, scale.dimension))
}

/// Why there is no number at a place.
fn no_number(text: &str, at: usize) -> UnitError {
    let rest = text.get(at..).unwrap_or_default();
    let signed = rest.strip_prefix(['+', '-']).unwrap_or(rest);
    let letters = signed.find(|c: char| !c.is_alphabetic()).unwrap_or(signed.len());
    let word = signed.get(..letters).unwrap_or_default();
    let is_word = ["inf", "infinity", "nan"].contains(&word.to_lowercase().as_str());
    if is_word {
        let end = at + rest.len() - signed.len() + letters;
        return UnitError { at: at..end, kind: UnitErrorKind::NotFinite(word.to_owned()) };
    }
    UnitError { at: at..text.len().max(at), kind: UnitErrorKind::Number }
}

/// The number in SI. Its decimal exponent and that of the unit are added before it is rounded.
fn value(text: &str, at: std::ops::Range<usize>, scale: Scale) -> Result<f64, UnitError> {
    let digits = text.get(at.clone()).unwrap_or_default().replace('_', "");
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((&digits, "0"));
    let shifted = exponent.parse::<i32>().ok().and_then(|e| e.checked_add(scale.ten));
    let number = shifted.and_then(|e| format!("{mantissa}e{e}").parse::<f64>().ok());
    match number.map(|number| number * scale.factor) {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(UnitError { at, kind: UnitErrorKind::Large }),
        None => Err(UnitError { at, kind: UnitErrorKind::Number }),
    }
}

pub(super) fn skip(text: &str, at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + (rest.len() - rest.trim_start().len())
}

/// Where a decimal number that starts at `at` ends; `at` if there is none.
pub(super) fn number_end(text: &str, at: usize) -> usize {
    let bytes = text.as_bytes();
    let byte = |i: usize| bytes.get(i).copied().unwrap_or(0);
    let mut i = at;
    if matches!(byte(i), b'+' | b'-') {
        i += 1;
    }
    let start = i;
    let mut digits = 0;
    let mut point = false;
    loop {
        match byte(i) {
            b'0'..=b'9' => digits += 1,
            b'_' if i > start && byte(i - 1).is_ascii_digit() => {}
            b'.' if !point => point = true,
            _ => break,
        }
        i += 1;
    }
    if digits == 0 {
        return at;
    }
    if matches!(byte(i), b'e' | b'E') {
        let mut e = i + 1;
        if matches!(byte(e), b'+' | b'-') {
            e += 1;
        }
        if byte(e).is_ascii_digit() {
            while byte(e).is_ascii_digit() {
                e += 1;
            }
            i = e;
        }
    }
    i
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn one(text: &str, measure: Measure) -> f64 {
        let quantity = parse_quantity(text).unwrap_or_else(|error| panic!("{text}: {error:?}"));
        assert!(quantity.is(measure), "{text} is {}", quantity.name());
        quantity.values[0]
    }

    #[test]
    fn powers_of_ten_cost_no_rounding() {
        assert_eq!(one("0.08 mm", Measure::LENGTH), 0.08e-3);
        assert_eq!(one("32 g cm", Measure::STATIC_IMBALANCE), 32e-5);
        assert_eq!(one("15.4 g cm^2", Measure::DYNAMIC_IMBALANCE), 15.4e-7);
        assert_eq!(one("15.4 g·cm²", Measure::DYNAMIC_IMBALANCE), 15.4e-7);
        assert_eq!(one("-100 mN m", Measure::TORQUE), -0.1);
        assert_eq!(
            one("3.986004418e14 m^3/s^2", Measure::GRAVITATIONAL_PARAMETER),
            3.986_004_418e14
        );
        assert_eq!(one("398600.4418 km³/s²", Measure::GRAVITATIONAL_PARAMETER), 3.986_004_418e14);
    }

    #[test]
    fn usual_units_are_what_their_definitions_say() {
        assert_eq!(one("6000 rpm", Measure::ANGULAR_RATE), 6000.0 * (PI / 30.0));
        assert_eq!(one("180 deg", Measure::ANGLE), PI);
        assert_eq!(one("1 rev/s", Measure::ANGULAR_RATE), 2.0 * PI);
        assert!((one("3600 arcsec", Measure::ANGLE) - PI / 180.0).abs() < 1e-17);
        assert!((one("1 oz in^2", Measure::INERTIA) - 1.828_997_833_932_5e-5).abs() < 1e-18);
        assert!((one("1 lbf ft", Measure::TORQUE) - 1.355_817_948_331_400_4).abs() < 1e-15);
        assert_eq!(one("90 min", Measure::TIME), 5400.0);
        assert_eq!(one("2 N m s/rad", Measure::ANGULAR_DAMPING), 2.0);
        assert_eq!(one("2 N m/(rad/s)", Measure::ANGULAR_DAMPING), 2.0);
        assert_eq!(one("5 1/s", Measure::FREQUENCY), 5.0);
    }

    #[test]
    fn several_numbers_share_a_unit() {
        let quantity = parse_quantity("-0.02, 0.01,10 cm").expect("three lengths");
        assert_eq!(quantity.values, [-0.02e-2, 0.01e-2, 0.1]);
    }

    #[test]
    fn an_error_points_at_what_is_wrong() {
        let error = |text: &str| parse_quantity(text).expect_err(text);
        let unknown = error("4 kgg");
        assert_eq!(unknown.at, 2..5);
        assert!(matches!(unknown.kind, UnitErrorKind::Symbol(Some(_))), "{unknown:?}");
        let joined = |text: &str| error(text).kind;
        assert_eq!(joined("4 kgs"), UnitErrorKind::Symbol(Some("kg".to_owned())));
        assert_eq!(joined("4 KG"), UnitErrorKind::Symbol(Some("kg".to_owned())));
        // Of one letter nothing is left that is meant.
        assert_eq!(joined("4 stone"), UnitErrorKind::Symbol(None));
        for word in ["inf", "NaN", "-Infinity"] {
            let word_alone = word.trim_start_matches('-').to_owned();
            assert_eq!(joined(&format!("{word} kg")), UnitErrorKind::NotFinite(word_alone));
        }
        // In lower case it is longer.
        assert!(matches!(joined("5 \u{130}\u{130}\u{130}s"), UnitErrorKind::Symbol(_)));
        assert_eq!(error("kg").kind, UnitErrorKind::Number);
        assert_eq!(error("").kind, UnitErrorKind::Number);
        assert_eq!(error("4, kg").at, 3..5);
        assert_eq!(error("4 kg/").kind, UnitErrorKind::Expected);
        assert_eq!(error("4 kg^99").kind, UnitErrorKind::Exponent);
        assert_eq!(error("1e400 kg").kind, UnitErrorKind::Large);
        assert_eq!(
            error("1 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9")
                .kind,
            UnitErrorKind::Exponent
        );
        assert_eq!(error("4 kg )").kind, UnitErrorKind::Expected);
    }

    #[test]
    fn spellings_of_data_sheets_with_one_reading_are_read() {
        for (written, symbols) in [
            ("g-cm", "g cm"),
            ("g.cm", "g cm"),
            ("gcm", "g cm"),
            ("gcm²", "g cm^2"),
            ("g cm2", "g cm^2"),
            ("kg-m^2", "kg m^2"),
            ("kgm^2", "kg m^2"),
            ("N-m", "N m"),
            ("Nm", "N m"),
            ("mNm", "mN m"),
            ("N-m-s", "N m s"),
            ("Nm s/rad", "N m s/rad"),
            ("ozf-in", "ozf in"),
            ("kg m s-2", "kg m/s^2"),
            ("m/s2", "m/s^2"),
            ("Kg", "kg"),
            ("lbm", "lb"),
            ("RPM", "rpm"),
            ("r/min", "rpm"),
            ("rad/sec", "rad/s"),
            ("degrees/s", "deg/s"),
            ("milliarcsec", "marcsec"),
            ("milli-arcsec", "marcsec"),
            ("mas", "marcsec"),
            ("microrad", "urad"),
            ("microradians", "urad"),
            ("µradians", "µrad"),
            ("Mradian", "Mrad"),
            ("milliNewton", "mN"),
            ("arcseconds", "arcsec"),
        ] {
            let parsed = |unit: &str| parse_unit(unit).unwrap_or_else(|e| panic!("{unit}: {e:?}"));
            let ((size, dimension), (right, wanted)) = (parsed(written), parsed(symbols));
            assert_eq!(dimension, wanted, "{written}");
            assert!((size - right).abs() < 1e-15 * right, "{written}: {size} and {right}");
        }
        assert!((one("1 slug", Measure::MASS) - 14.593_902_937_206_36).abs() < 1e-14);
        assert_eq!(parse_quantity("5 12/s").map(|found| found.values).ok(), None);
    }

    #[test]
    fn spellings_with_several_readings_name_them() {
        let readings = |text: &str| match parse_quantity(text).expect_err(text).kind {
            UnitErrorKind::Ambiguous(readings) => readings.join(", "),
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(readings("3 Nms"), "N m s, N ms");
        assert_eq!(readings("0.48 gm cm"), "g, g m");
        assert_eq!(readings("50 rps"), "rev/s, rad/s");
        assert_eq!(readings("1 N/rad-s"), "N/(rad s), N s/rad");
        assert_eq!(readings("1 rad/Nm"), "(Nm)");
    }

    #[test]
    fn hertz_are_of_frequencies_and_densities_only() {
        assert!(!parse_quantity("100 Hz").expect("a frequency").is(Measure::ANGULAR_RATE));
        for density in ["mN^2/Hz", "N^2 m^2/Hz", "N²/kHz", "kHz", "rad^2/Hz"] {
            assert!(parse_unit(density).is_ok(), "{density}");
        }
        for rate in ["N/Hz^2", "N m/Hz^2", "N/Hz", "N m/Hz/rad", "kg m^2 Hz", "kg m Hz^2", "m Hz"] {
            let kind = parse_unit(rate).expect_err(rate).kind;
            assert!(matches!(kind, UnitErrorKind::Hertz(_)), "{rate}: {kind:?}");
        }
        let shown = parse_unit("N/kHz^2").expect_err("hertz").kind.to_string();
        assert!(shown.contains("`(rev/s)` for turns, `(rad/s)` for radians"), "{shown}");
        let shown = parse_unit("N/Hz^2").expect_err("hertz").kind.to_string();
        assert!(shown.contains("`N/(rev/s)^2` for turns, `N/(rad/s)^2` for radians"), "{shown}");
    }
}
