//! Parsing of units: products of powers of symbols, into their size in SI and their dimension.

use super::error::{UnitError, UnitErrorKind};
use super::expression::{number_end, skip};
use super::measure::{Dimension, Measure};
use super::symbols::{self, Spelling, Symbol};

/// A unit: `10^ten * factor` of SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) ten: i32,
    pub(super) factor: f64,
    pub(super) dimension: Dimension,
    /// The power of hertz in it.
    hertz: i8,
}

/// The number one.
pub(super) const ONE: Scale =
    Scale { ten: 0, factor: 1.0, dimension: Measure::NUMBER.dimension, hertz: 0 };

impl Scale {
    /// Whether hertz in it are cycles: of a frequency, or one over hertz of a spectral density, which is otherwise a
    /// square.
    fn counts_cycles(&self) -> bool {
        let Dimension { length, mass, time, angle } = self.dimension;
        match self.hertz {
            0 => true,
            1 => self.dimension == Measure::FREQUENCY.dimension,
            -1 => [length, mass, time - 1, angle].iter().all(|power| power % 2 == 0),
            _ => false,
        }
    }
}

impl From<Symbol> for Scale {
    fn from(of: Symbol) -> Self {
        Self { ten: of.ten, factor: of.factor, dimension: of.dimension, hertz: of.hertz }
    }
}

/// The unit from a place of a text to its end.
pub(super) fn scale_of(text: &str, at: usize) -> Result<Scale, UnitError> {
    let mut parser = Parser { text, at };
    let scale = parser.product()?;
    parser.end()?;
    if scale.counts_cycles() {
        return Ok(scale);
    }
    let unit = text.get(at..).unwrap_or_default().trim();
    // One with a prefix, such as kHz, is not replaced: neither of them takes one.
    let prefixed = unit
        .match_indices("Hz")
        .any(|(at, _)| unit.get(..at).is_some_and(|before| before.ends_with(char::is_alphabetic)));
    let by = |rate: &str| if prefixed { rate.to_owned() } else { unit.replace("Hz", rate) };
    let kind = UnitErrorKind::Hertz([by("(rev/s)"), by("(rad/s)")]);
    Err(UnitError { at: at..text.len(), kind })
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
        let first = self.at;
        let mut product = self.power(false)?;
        let mut divided = false;
        loop {
            self.at = skip(self.text, self.at);
            let start = self.at;
            let inverse = self.take("/");
            if !inverse && self.rest().starts_with("**") {
                return Err(UnitError { at: start..start + 2, kind: UnitErrorKind::Expected });
            }
            let sheet = !inverse && (self.take_before_letter("-") || self.take_before_letter("."));
            if sheet && divided {
                return Err(self.divided_product(first, start));
            }
            if !inverse && self.at == start {
                let _ = ["*", "·", "⋅", "×"].into_iter().any(|sign| self.take(sign));
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
            let factor = self.power(inverse)?;
            product = self.times(start, product, factor, if inverse { -1 } else { 1 })?;
            divided |= inverse;
        }
    }

    /// The error of `N/rad-s`, whose sign at `sign` may multiply the unit or what it is divided by.
    fn divided_product(&self, first: usize, sign: usize) -> UnitError {
        let text = |from: usize, to: usize| self.text.get(from..to).unwrap_or_default();
        let (head, tail) = (text(first, sign).trim(), text(sign + 1, self.text.len()).trim());
        let (over, under) = head.rsplit_once('/').unwrap_or((head, ""));
        let readings = vec![format!("{over}/({under} {tail})"), format!("{over} {tail}/{under}")];
        UnitError { at: first..self.text.len(), kind: UnitErrorKind::Ambiguous(readings) }
    }

    /// A sign before a letter; of `s-2` it belongs to the exponent.
    fn take_before_letter(&mut self, sign: &str) -> bool {
        let rest = self.rest().strip_prefix(sign);
        let found =
            rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_alphabetic() || c == '('));
        found && self.take(sign)
    }

    /// A symbol or a unit in parentheses, to a power; `inverse` where it is divided by.
    fn power(&mut self, inverse: bool) -> Result<Scale, UnitError> {
        self.at = skip(self.text, self.at);
        let start = self.at;
        let (first, base) = if self.take("(") {
            let inner = self.product()?;
            self.at = skip(self.text, self.at);
            if !self.take(")") {
                return Err(self.error(start, UnitErrorKind::Expected));
            }
            (None, inner)
        } else {
            self.symbol(inverse)?
        };
        let is_one = self.text.get(start..self.at) == Some("1");
        let power = self.exponent(!is_one)?;
        let last = self.times(start, ONE, base, power)?;
        first.map_or(Ok(last), |first| self.times(start, first, last, 1))
    }

    /// A symbol; of a product that is written without a space the first, and the second.
    fn symbol(&mut self, inverse: bool) -> Result<(Option<Scale>, Scale), UnitError> {
        let start = self.at;
        let letter = |c: char| c.is_alphabetic() || c == '°';
        let letters = |text: &str| text.find(|c| !letter(c)).unwrap_or(text.len());
        let rest = self.rest();
        let end = letters(rest);
        // The number one, as in 1/s.
        let mut end = if end == 0 && rest.starts_with('1') { 1 } else { end };
        let mut name = rest.get(..end).unwrap_or_default().to_owned();
        // `milli-arcsec` is one word.
        let after = rest.get(end..).and_then(|rest| rest.strip_prefix('-')).unwrap_or_default();
        if letters(after) > 0 && symbols::is_prefix_word(&name) {
            name.push_str(after.get(..letters(after)).unwrap_or_default());
            end += 1 + letters(after);
        }
        self.at += end;
        if name.is_empty() {
            self.at = self.text.len();
            return Err(self.error(start, UnitErrorKind::Expected));
        }
        match symbols::spelling(&name) {
            Spelling::One(found) => Ok((None, found.into())),
            Spelling::Product(_) if inverse => {
                let help = UnitErrorKind::Ambiguous(vec![format!("({name})")]);
                Err(self.error(start, help))
            }
            Spelling::Product([first, second]) => Ok((Some(first.into()), second.into())),
            Spelling::Several(readings) => {
                Err(self.error(start, UnitErrorKind::Ambiguous(readings)))
            }
            Spelling::Unknown(near) => Err(self.error(start, UnitErrorKind::Symbol(near))),
        }
    }

    /// An exponent; `bare` where a digit right after the symbol is one: `m2`, `s-2`.
    fn exponent(&mut self, bare: bool) -> Result<i8, UnitError> {
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
        if bare && let Some(power) = self.bare_exponent() {
            return Ok(power);
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

    /// One digit right after a symbol, or a minus and one digit.
    fn bare_exponent(&mut self) -> Option<i8> {
        let rest = self.rest();
        let digits = rest.strip_prefix('-').unwrap_or(rest);
        let digit =
            digits.chars().next().and_then(|c| c.to_digit(10)).filter(|digit| *digit > 0)?;
        if digits.get(1..).is_some_and(|after| after.starts_with(|c: char| c.is_ascii_digit())) {
            return None;
        }
        let power = i8::try_from(digit).ok()?;
        let negative = digits.len() < rest.len();
        self.at += rest.len() - digits.len() + 1;
        Some(if negative { -power } else { power })
    }

    fn times(&self, start: usize, a: Scale, b: Scale, power: i8) -> Result<Scale, UnitError> {
        let error = || self.error(start, UnitErrorKind::Exponent);
        let dimension = a.dimension.times(b.dimension, power).ok_or_else(error)?;
        let ten = b.ten.checked_mul(i32::from(power)).and_then(|ten| a.ten.checked_add(ten));
        let factor = a.factor * b.factor.powi(i32::from(power));
        let hertz = b.hertz.checked_mul(power).and_then(|b| a.hertz.checked_add(b));
        let (ten, hertz) = (ten.ok_or_else(error)?, hertz.ok_or_else(error)?);
        Ok(Scale { ten, factor, dimension, hertz })
    }
}
