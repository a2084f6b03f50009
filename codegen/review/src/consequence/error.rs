//! Why there are no consequences to report.

use std::fmt;

use super::Effect;
use precess_codegen::page::PageError;

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum ConsequenceError {
    /// A page cannot be read.
    Page(PageError),
    /// The hand-checked pages lack an equation of the assembled system, or state it as another kind.
    Missing {
        /// The quantity.
        name: &'static str,
    },
    /// A printed block differs in a quantity that no hand-checked page states.
    Unstated {
        /// The printed page.
        page: String,
        /// Line of the block's fence.
        line: usize,
        /// The quantity.
        name: String,
    },
    /// An equation contains a symbol that has no number in Table 1.
    Symbol {
        /// The symbol.
        name: String,
    },
    /// The right system does not run: there is nothing to compare with.
    Right(Effect),
}

impl From<PageError> for ConsequenceError {
    fn from(error: PageError) -> Self {
        Self::Page(error)
    }
}

impl fmt::Display for ConsequenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Page(error) => error.fmt(f),
            Self::Missing { name } => write!(
                f,
                "the hand-checked pages do not state `{name}`, an equation of the assembled \
                 system; add its block"
            ),
            Self::Unstated { page, line, name } => write!(
                f,
                "{page}:{line}: no hand-checked page states `{name}`; add its block, or mark this \
                 one as a definition"
            ),
            Self::Symbol { name } => write!(
                f,
                "the assembled equations contain `{name}`, which Table 1 does not give; an \
                 equation must be affine in the accelerations and made of parameters and states"
            ),
            Self::Right(effect) => {
                write!(f, "the right system itself: {effect}; mend the hand-checked pages")
            }
        }
    }
}

impl std::error::Error for ConsequenceError {}
