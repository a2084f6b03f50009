//! Parsing of quantities: numbers, then a unit.
//!
//! ```text
//! quantity  = number ("," number)* unit          -0.02, 0.01, 10 cm
//! unit      = power (("*" | "·" | "/" | " ") power)*      a "/" divides by the next power only
//! power     = (symbol | "(" unit ")") (("^" | "**") integer | superscript digits)?
//! ```

use crate::nearest::nearest;

use super::error::{UnitError, UnitErrorKind};
use super::measure::{Dimension, Measure, measure_of};
use super::symbols;

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

/// A unit: `10^ten * factor` of SI.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    ten: i32,
    factor: f64,
    dimension: Dimension,
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
            return Err(UnitError { at: at..text.len().max(at), kind: UnitErrorKind::Number });
        }
        numbers.push(at..end);
        at = skip(text, end);
        match text.get(at..).and_then(|rest| rest.strip_prefix(',')) {
            Some(_) => at += 1,
            None => break,
        }
    }
    let rest = text.get(at..).unwrap_or_default();
    let scale = if rest.trim().is_empty() {
        Scale { ten: 0, factor: 1.0, dimension: Dimension::default() }
    } else {
        let mut parser = Parser { text, at };
        let scale = parser.product()?;
        parser.end()?;
        scale
    };
    let values = numbers.into_iter().map(|at| value(text, at, scale)).collect::<Result<_, _>>()?;
    Ok(Quantity { values, dimension: scale.dimension, unit: rest.trim().to_owned() })
}

/// The size of a unit in SI, and its dimension.
///
/// # Errors
/// The first place at which the text is no unit.
pub fn parse_unit(text: &str) -> Result<(f64, Dimension), UnitError> {
    let mut parser = Parser { text, at: 0 };
    let scale = parser.product()?;
    parser.end()?;
    let size = format!("1e{}", scale.ten).parse::<f64>().unwrap_or(f64::NAN) * scale.factor;
    Ok((size, scale.dimension))
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

fn skip(text: &str, at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + (rest.len() - rest.trim_start().len())
}

/// Where a decimal number that starts at `at` ends; `at` if there is none.
fn number_end(text: &str, at: usize) -> usize {
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

struct Parser<'a> {
    text: &'a str,
    at: usize,
}

impl Parser<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn error(&self, start: usize, kind: UnitErrorKind) -> UnitError {
        UnitError { at: start..self.at.max(start), kind }
    }

    fn take(&mut self, token: &str) -> bool {
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    fn end(&mut self) -> Result<(), UnitError> {
        self.at = skip(self.text, self.at);
        if self.at == self.text.len() {
            return Ok(());
        }
        Err(UnitError { at: self.at..self.text.len(), kind: UnitErrorKind::Expected })
    }

    fn product(&mut self) -> Result<Scale, UnitError> {
        let mut product = self.power()?;
        loop {
            self.at = skip(self.text, self.at);
            let start = self.at;
            let inverse = self.take("/");
            if !inverse && !self.take("·") && self.rest().starts_with("**") {
                return Err(UnitError { at: start..start + 2, kind: UnitErrorKind::Expected });
            }
            if !inverse && self.at == start {
                self.take("*");
            }
            self.at = skip(self.text, self.at);
            if self.rest().is_empty() || self.rest().starts_with(')') {
                if self.at == start
                    || self.text.get(start..self.at).unwrap_or_default().trim().is_empty()
                {
                    return Ok(product);
                }
                return Err(UnitError { at: start..self.at, kind: UnitErrorKind::Expected });
            }
            let factor = self.power()?;
            product = self.times(start, product, factor, if inverse { -1 } else { 1 })?;
        }
    }

    fn power(&mut self) -> Result<Scale, UnitError> {
        self.at = skip(self.text, self.at);
        let start = self.at;
        let base = if self.take("(") {
            let inner = self.product()?;
            self.at = skip(self.text, self.at);
            if !self.take(")") {
                return Err(self.error(start, UnitErrorKind::Expected));
            }
            inner
        } else {
            self.symbol()?
        };
        let power = self.exponent()?;
        let one = Scale { ten: 0, factor: 1.0, dimension: Dimension::default() };
        self.times(start, one, base, power)
    }

    fn symbol(&mut self) -> Result<Scale, UnitError> {
        let start = self.at;
        let letter = |c: char| c.is_alphabetic() || c == '°';
        let rest = self.rest();
        let end = rest.find(|c| !letter(c)).unwrap_or(rest.len());
        // The number one, as in 1/s.
        let end = if end == 0 && rest.starts_with('1') { 1 } else { end };
        let name = rest.get(..end).unwrap_or_default().to_owned();
        self.at += end;
        if name.is_empty() {
            self.at = self.text.len();
            return Err(self.error(start, UnitErrorKind::Expected));
        }
        let Some(found) = symbols::find(&name) else {
            let near = symbols::parted(&name)
                .or_else(|| nearest(&name, symbols::all()).into_iter().next());
            return Err(self.error(start, UnitErrorKind::Symbol(near)));
        };
        Ok(Scale { ten: found.ten, factor: found.factor, dimension: found.dimension })
    }

    fn exponent(&mut self) -> Result<i8, UnitError> {
        const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
        let start = self.at;
        if self.take("^") || self.take("**") {
            let digits = self.at;
            self.take("-");
            let end = number_end(self.text, self.at);
            self.at = end;
            let power = self.text.get(digits..end).and_then(|text| text.parse::<i8>().ok());
            return match power {
                Some(power) if power.abs() <= 9 => Ok(power),
                _ => Err(self.error(start, UnitErrorKind::Exponent)),
            };
        }
        let negative = self.take("⁻");
        let digit = self.rest().chars().next();
        let place = digit.and_then(|c| SUPERSCRIPTS.chars().position(|s| s == c));
        match (place.and_then(|place| i8::try_from(place).ok()), digit) {
            (Some(power), Some(digit)) => {
                self.at += digit.len_utf8();
                Ok(if negative { -power } else { power })
            }
            _ if negative => Err(self.error(start, UnitErrorKind::Exponent)),
            _ => Ok(1),
        }
    }

    fn times(&self, start: usize, a: Scale, b: Scale, power: i8) -> Result<Scale, UnitError> {
        let error = || self.error(start, UnitErrorKind::Exponent);
        let dimension = a.dimension.times(b.dimension, power).ok_or_else(error)?;
        let ten = b.ten.checked_mul(i32::from(power)).and_then(|ten| a.ten.checked_add(ten));
        let factor = a.factor * b.factor.powi(i32::from(power));
        Ok(Scale { ten: ten.ok_or_else(error)?, factor, dimension })
    }
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
        assert_eq!(joined("60 mNm"), UnitErrorKind::Symbol(Some("mN m".to_owned())));
        assert_eq!(joined("4 kgs"), UnitErrorKind::Symbol(Some("kg".to_owned())));
        assert_eq!(joined("3000 RPM"), UnitErrorKind::Symbol(Some("rpm".to_owned())));
        for (written, symbol) in [
            ("microrad", "urad"),
            ("microradians", "urad"),
            ("µradians", "µrad"),
            ("milliNewton", "mN"),
            ("degrees", "deg"),
            ("arcseconds", "arcsec"),
        ] {
            assert_eq!(
                joined(&format!("5 {written}")),
                UnitErrorKind::Symbol(Some(symbol.to_owned()))
            );
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
    fn a_rate_in_hertz_is_no_angular_rate() {
        assert!(!parse_quantity("100 Hz").expect("a frequency").is(Measure::ANGULAR_RATE));
    }
}
