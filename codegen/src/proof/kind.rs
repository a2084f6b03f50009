//! All proofs of one kind: of its derivation, and of its emitted file.

use super::{Comparison, EmittedError, Prover, zero_traces};
use crate::derivation::chain::Chain;
use crate::emit::EmittedFile;
use crate::kinds::Kind;
use crate::normal::Ring;

/// Compares the emitted file of one kind with its derivation, and that with the laws.
///
/// # Errors
/// When there is no such file, or it cannot be read.
pub fn prove_kind(
    chain: &Chain<'_>,
    files: &[EmittedFile],
) -> Result<Vec<Comparison>, EmittedError> {
    let file = own_file(chain.kind, files)?;
    let mut rows = zero_traces(&mut Ring::new(chain.graph), chain);
    let mut prover = Prover::new(chain);
    rows.extend(prover.derivation());
    rows.extend(prover.rows(&file.text)?);
    Ok(rows.into_iter().map(|row| row.about(chain.kind)).collect())
}

/// The file of a kind's kernels.
pub(super) fn own_file<'a>(
    kind: &Kind,
    files: &'a [EmittedFile],
) -> Result<&'a EmittedFile, EmittedError> {
    let name = format!("{}.rs", kind.name);
    let own = |file: &&EmittedFile| file.path.rsplit('/').next() == Some(name.as_str());
    files.iter().find(own).ok_or_else(|| EmittedError::NoFile(kind.name.to_owned()))
}
