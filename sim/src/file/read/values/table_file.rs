//! Columns of numbers in a file beside a scenario ([`crate::tables`]), with the bounds of scenarios.

use std::path::Path;

use crate::tables::{Limits, columns as of_table};

/// Most rows of a table, and most bytes of its file: a device has no end.
const LIMITS: Limits = Limits { rows: 1_000_000, bytes: 100_000_000 };

/// The columns of some names, in their order: of an archive where the file's name ends in `.npz`.
///
/// A name may be missing in the file where `needed` says no: its column is empty.
pub(in crate::file::read) fn columns(
    path: &Path,
    names: &[(&str, bool)],
) -> Result<Vec<Vec<f64>>, String> {
    of_table(path, names, LIMITS).map_err(|fault| fault.to_string())
}
