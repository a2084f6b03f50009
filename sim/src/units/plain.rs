//! [`Plain`]: a number as a message shows it.

use std::fmt;

/// Numbers between these are written without an exponent.
const PLAIN: [f64; 2] = [1e-4, 1e9];

/// A number in the fewest digits that read back the same; a very large or small one with an exponent, and not in three
/// hundred digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plain(pub(crate) f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        let [least, most] = PLAIN;
        if value == 0.0 || !value.is_finite() || (least..most).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Plain;

    #[test]
    fn a_number_is_short_at_any_size() {
        let shown =
            [0.0, 0.1, -320.0, 3.2e8, 1e300, -2.5e-7, f64::INFINITY].map(|v| Plain(v).to_string());
        assert_eq!(shown, ["0", "0.1", "-320", "320000000", "1e300", "-2.5e-7", "inf"]);
    }
}
