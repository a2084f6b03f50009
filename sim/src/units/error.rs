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
    /// The word for what is no finite number: `inf`, `nan`.
    NotFinite(String),
    /// No such symbol; the one that may be meant, where there is one.
    Symbol(Option<String>),
    /// Letters with more than one reading, and these.
    Ambiguous(Vec<String>),
    /// Hertz within a unit of a rate; the unit by turns per second, and by radians per second.
    Hertz([String; 2]),
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
            Self::NotFinite(word) => write!(f, "`{word}` is no number; a quantity is finite"),
            Self::Symbol(None) => f.write_str("no such unit"),
            Self::Symbol(Some(nearest)) => write!(f, "no such unit; did you mean `{nearest}`?"),
            Self::Ambiguous(readings) => {
                write!(f, "it has more than one reading; write `{}`", readings.join("` or `"))
            }
            Self::Hertz([turns, radians]) => write!(
                f,
                "hertz do not say whether turns or radians per second are meant; write `{turns}` for \
                 turns, `{radians}` for radians"
            ),
            Self::Expected => f.write_str("a unit is missing here"),
            Self::Exponent => f.write_str("an exponent is an integer from -9 to 9"),
        }
    }
}
