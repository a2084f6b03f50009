//! Campaigns: many runs of one scenario with other values of its keys, each reduced to a row of numbers.
//!
//! | file | what |
//! |---|---|
//! | `axis` | [`Axis`]: a key and the values that it takes |
//! | `plan` | [`Plan`]: the samples of a campaign, and the digest that names it |
//! | `reduce` | [`Reducer`]: samples of one run into a row of numbers, in bounded memory |
//! | `journal` | [`Journal`]: a checksummed record of each finished sample, for a campaign that is killed |
//! | `engine` | [`execute`]: the samples that are missing, on any number of threads; [`run_reduced`]: some of them |
//! | `table` | the rows as CSV and NPZ |
//! | `draw` | [`draw`]: seeded samples |
//! | `correlation` | variations that are correlated: a Gaussian copula |
//! | `inference` | [`percentile`], [`probability`], [`spearman`] |
//! | `sensitivity` | derivatives by central differences; a plane through a sample |
//! | `tangent` | exact derivatives: the run over dual numbers |
//! | `keep_out` | intervals of a key in which a requirement is violated |
//!
//! A sample that cannot be run is a row with its error. Rows are in the order of the samples; they do not depend on
//! the number of threads, nor on how often a campaign was ended and continued.

mod axis;
mod correlation;
mod draw;
mod engine;
mod error;
mod inference;
mod journal;
mod keep_out;
mod plan;
mod reduce;
mod sensitivity;
pub mod table;
mod tangent;

pub use axis::{Axis, Spacing};
pub use draw::draw;
#[cfg(feature = "tool")]
pub(crate) use engine::shows_work;
pub use engine::{Execution, Finished, SampleResult, execute, run_reduced, run_reduced_on};
pub use error::CampaignError;
pub use inference::{Estimate, by_chance, percentile, probability, probability_between, spearman};
pub use journal::Journal;
pub use keep_out::keep_out;
pub use plan::{Plan, Sample, digits};
pub use reduce::{Field, LINE_SAMPLES_MAX, Reducer, Selection};
pub use sensitivity::{
    Derivative, central_differences, derivatives, exact_derivatives, regression,
};
pub use tangent::{Tangents, tangents};

/// Samples that a campaign may have.
pub const SAMPLES_MAX: usize = 1_000_000;
/// Numbers that the table of a campaign may have: 400 MB.
pub const NUMBERS_MAX: usize = 50_000_000;
