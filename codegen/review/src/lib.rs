//! What judges the paper and our own text: regeneration with all proofs, verdicts on each equation as
//! printed, consequences of its slips, mutants of what is emitted, and the documents about all of it.
//!
//! - [`regen`]: hand-checked pages in, proofs and files out;
//! - [`verdict`]: derivation, hand-checked page and print of every equation of the paper;
//! - [`consequence`]: what each slip does to a simulated spacecraft;
//! - [`mutation`]: each operand of the emitted functions made wrong, against conservation laws,
//!   differences and other engines;
//! - [`notation`]: names, equations and units as LaTeX;
//! - [`report`]: the documents, as Markdown.

pub mod consequence;
pub mod mutation;
pub mod notation;
pub mod regen;
pub mod report;
pub mod verdict;
