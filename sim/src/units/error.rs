//! [`UnitError`]: where and why a text is no quantity.

/// Where and why a text is no quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitError {
    /// The part of the text that is wrong, bytes from its start.
    pub at: std::ops::Range<usize>,
    /// What is wrong.
    pub kind: UnitErrorKind,
}

/// Why a text is no quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum UnitErrorKind {
    /// A number was expected.
    Number,
    /// A number is beyond the largest.
    Large,
    /// No such symbol; the nearest one, where one is near.
    Symbol(Option<String>),
    /// A symbol or a parenthesis was expected.
    Expected,
    /// An exponent that is no small integer.
    Exponent,
}

impl std::fmt::Display for UnitErrorKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number => f.write_str("a number is missing here"),
            Self::Large => f.write_str("this number is not finite in SI units"),
            Self::Symbol(None) => f.write_str("no such unit"),
            Self::Symbol(Some(nearest)) => write!(f, "no such unit; did you mean `{nearest}`?"),
            Self::Expected => f.write_str("a unit is missing here"),
            Self::Exponent => f.write_str("an exponent is an integer from -9 to 9"),
        }
    }
}
