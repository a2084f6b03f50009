//! The bytes of a file of a structure.

use std::io::Read as _;
use std::path::Path;

use super::{Fault, StructureError};
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
