//! A structure from a file of any format that is known.

use std::io::Read as _;
use std::path::Path;

use super::{Fault, Structure, StructureError, flex42, npz, op4};
use crate::file::{Diagnostics, structure_from_toml};
use crate::opened::open;

/// Longer files are not read, bytes.
pub const MOST_BYTES: usize = 1 << 30;

/// The bytes of a file, and no more than [`MOST_BYTES`].
///
/// # Errors
/// [`Fault::Io`], [`Fault::Large`].
pub fn bytes_of(path: &Path) -> Result<Vec<u8>, StructureError> {
    let mut bytes = Vec::new();
    let read = open(path)
        .and_then(|file| file.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes))
        .map_err(|source| StructureError::from(Fault::Io(source)).in_file(path))?;
    if read > MOST_BYTES {
        return Err(StructureError::from(Fault::Large { bound: MOST_BYTES }).in_file(path));
    }
    Ok(bytes)
}

/// Why a structure was not read.
#[derive(Debug)]
pub enum ReadError {
    /// One error in a file of modes.
    File(StructureError),
    /// Every error of a table.
    Table(Diagnostics),
}

impl std::fmt::Display for ReadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(error) => write!(f, "error: {error}"),
            Self::Table(errors) => errors.fmt(f),
        }
    }
}

impl std::error::Error for ReadError {}

/// Reads a structure: NPZ, Flex text of 42, or a table in TOML that says what op4 or Flex files are.
///
/// # Errors
/// Where, what, the bound and the remedy.
pub fn from_file(path: &Path) -> Result<Structure, ReadError> {
    if path.extension().is_some_and(|extension| extension == "toml") {
        return structure_from_toml(path).map_err(ReadError::Table);
    }
    let bytes = bytes_of(path).map_err(ReadError::File)?;
    let read = if bytes.starts_with(b"PK") {
        npz::read(&bytes)
    } else if flex42::is_flex(&bytes) {
        flex42::read(&bytes).and_then(flex42::Flex::structure)
    } else if op4::is_op4(&bytes) {
        Err(Fault::Bare.into())
    } else {
        Err(Fault::Format.into())
    };
    read.map_err(|error| ReadError::File(error.in_file(path)))
}
