//! A kind of another crate: emitted for it, and proven, as the kinds of this one are.

use crate::derivation::chain::Chain;
use crate::emit::{EmitError, EmittedFile, TargetCrate, of_kind};
use crate::graph::Graph;
use crate::kinds::Kind;
use crate::proof::{self, Comparison, EmittedError};

/// The emitted files of a kind, for a crate that calls the dynamics crate by the name `dynamics`.
/// Their paths are plain names: where they are put is the caller's choice.
///
/// # Errors
/// When a name of the kind is too long for a line of the emitted text, or `dynamics` is no path.
pub fn emit_kind(kind: &'static Kind, dynamics: &str) -> Result<Vec<EmittedFile>, EmitError> {
    let graph = Graph::new();
    Ok(of_kind(&Chain::new(&graph, kind), TargetCrate::External(dynamics))?.files)
}

/// One row for each claim about the emitted files of a kind: a row that does not hold names the
/// terms that differ.
///
/// # Errors
/// When the kind's file is not among them, or cannot be read.
pub fn prove_kind(
    kind: &'static Kind,
    files: &[EmittedFile],
) -> Result<Vec<Comparison>, EmittedError> {
    let graph = Graph::new();
    proof::prove_kind(&Chain::new(&graph, kind), files)
}
