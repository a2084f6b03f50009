//! A structure from a file of any format that is known.

use std::path::Path;

use super::structure_from_toml;
use crate::file::diagnostic::Diagnostics;
use crate::structure::{Fault, Structure, StructureError, bytes_of, flex42, npz, op4};

/// Why a structure was not read.
#[derive(Debug)]
pub enum StructureReadError {
    /// One error in a file of modes.
    File(StructureError),
    /// Every error of a table.
    Table(Diagnostics),
}

impl std::fmt::Display for StructureReadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(error) => write!(f, "error: {error}"),
            Self::Table(errors) => errors.fmt(f),
        }
    }
}

impl std::error::Error for StructureReadError {}

/// Reads a structure: NPZ, Flex text of 42, or a table in TOML that says what op4 or Flex files are.
///
/// # Errors
/// Where, what, the bound and the remedy.
pub fn structure_from_file(path: &Path) -> Result<Structure, StructureReadError> {
    if path.extension().is_some_and(|extension| extension == "toml") {
        return structure_from_toml(path).map_err(StructureReadError::Table);
    }
    let bytes = bytes_of(path).map_err(StructureReadError::File)?;
    let read = if bytes.starts_with(b"PK") {
        npz::read(&bytes)
    } else if flex42::is_flex(&bytes) {
        flex42::read(&bytes).and_then(flex42::Flex::structure)
    } else if op4::is_op4(&bytes) {
        Err(Fault::Bare.into())
    } else {
        Err(Fault::Format.into())
    };
    read.map_err(|error| StructureReadError::File(error.in_file(path)))
}
