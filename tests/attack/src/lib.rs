//! A randomised campaign against the promises of docs/promises.md, each a property with a name.
//!
//! Cases are drawn and minimised by proptest and printed as a test to paste. `cargo xtask attack`
//! runs the campaign, the suite `sample` a fixed sample of it.
//!
//! A campaign for workstations: nothing of it goes on board.

pub mod bodies;
pub mod call_results;
pub mod campaign;
pub mod case;
pub mod code;
pub mod derivatives;
pub mod draw;
pub mod energy;
pub mod finite;
pub mod limits;
pub mod longest_steps;
pub mod motion;
pub mod number;
pub mod progress;
pub mod properties;
pub mod residual;
pub mod runs;
pub mod same;
pub mod shapes;
pub mod singular;
pub mod sizes;
pub mod typed_errors;
pub mod variants;

pub use case::{Case, List, PreparedCase};

/// What became of a case: whether the property applied to it, or why it does not hold.
pub type Verdict = Result<Checked, String>;

/// Whether a property applied to a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Checked {
    /// It holds.
    Holds,
    /// The case is none that the property speaks of.
    Rejected,
}
