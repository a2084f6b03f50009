//! Numbers as they are read: few digits, a true minus sign, powers of ten as superscripts.

/// A number with so many significant digits: plain where that is short, otherwise times a power of
/// ten.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return if value.is_nan() { "not a number".into() } else { signed(&value.to_string()) };
    }
    // Rounded first: 9.996 to three digits is 10.0.
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..=5).contains(&exponent) {
        let places = i32::try_from(digits).unwrap_or(3) - 1 - exponent;
        return signed(&format!("{value:.*}", usize::try_from(places).unwrap_or(0)));
    }
    format!("{}×{}", signed(mantissa), power_of_ten(exponent))
}

/// The same without zeros at the end of its decimals.
pub(super) fn short(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (number, power) = match text.split_once('×') {
        Some((number, power)) => (number, Some(power)),
        None => (text.as_str(), None),
    };
    let number = if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    };
    match power {
        Some(power) if number == "1" => power.to_owned(),
        Some(power) => format!("{number}×{power}"),
        None => number.to_owned(),
    }
}

/// A number and its unit.
pub(super) fn with_unit(value: f64, digits: usize, unit: &str) -> String {
    let number = significant(value, digits);
    if unit.is_empty() || unit == "1" { number } else { format!("{number} {unit}") }
}

/// A time, s, without its unit.
pub(super) fn time(value: f64) -> String {
    short(value, 6)
}

/// A power of ten: `10⁻¹²`.
pub(super) fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    std::iter::once("10".to_owned()).chain(digits.chars().map(superscript)).collect()
}

/// A message with its powers of ten as superscripts, `2.5e-4` as `2.5×10⁻⁴`; what is between backticks, to be written into a
/// file, stays.
pub(super) fn with_powers(message: &str) -> String {
    let parts = message.split('`').enumerate();
    let parts = parts.map(|(k, part)| if k % 2 == 0 { powers(part) } else { part.to_owned() });
    parts.collect::<Vec<_>>().join("`")
}

/// A text with powers of ten instead of exponents after a digit.
fn powers(text: &str) -> String {
    let mut pieces = text.split('e');
    let mut out = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let digits = piece.strip_prefix('-').unwrap_or(piece);
        let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        let (exponent, rest) = piece.split_at(piece.len() - digits.len() + end);
        match exponent.parse() {
            Ok(exponent) if out.ends_with(|c: char| c.is_ascii_digit()) => {
                out.push('×');
                out.push_str(&power_of_ten(exponent));
                out.push_str(rest);
            }
            _ => {
                out.push('e');
                out.push_str(piece);
            }
        }
    }
    out
}

/// A number with its thousands set apart.
pub(super) fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut out = String::new();
    for (index, digit) in digits.chars().enumerate() {
        let left = digits.len() - index;
        if index > 0 && left.is_multiple_of(3) && digits.len() > 4 {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    out
}

fn signed(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

fn superscript(c: char) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = c.to_digit(10).and_then(|digit| usize::try_from(digit).ok());
    digit.and_then(|digit| DIGITS.get(digit)).map_or_else(|| "⁻".to_owned(), char::to_string)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_in_print() {
        assert_eq!(significant(1.54e-6, 3), "1.54×10⁻⁶");
        assert_eq!(significant(-37.2151, 3), "\u{2212}37.2");
        assert_eq!(significant(9.996, 3), "10.0");
        assert_eq!((significant(0.0, 3), significant(0.54, 3)), ("0".into(), "0.540".into()));
        assert_eq!((short(1e-13, 3), short(0.540, 3)), ("10⁻¹³".into(), "0.54".into()));
        assert_eq!((short(810.0, 6), time(0.1 + 0.2)), ("810".into(), "0.3".into()));
        assert_eq!(significant(1234.5, 3), "1234");
        assert_eq!(
            (count(1234), count(1_234_567)),
            ("1234".into(), "1\u{202f}234\u{202f}567".into())
        );
        assert_eq!(with_unit(2.0, 3, "N m"), "2.00 N m");
        let message =
            "it drifts at 5.59980e-4 rad/s and -1e12 m; write `step = \"1e-5 s\"`, see e-4 the end";
        let shown = "it drifts at 5.59980×10⁻⁴ rad/s and -1×10¹² m; write `step = \"1e-5 s\"`, see e-4 the end";
        assert_eq!(with_powers(message), shown);
    }
}
