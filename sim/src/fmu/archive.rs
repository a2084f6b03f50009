//! The archive of a unit, and how its sources become a binary of this platform.

use std::io::{self, Cursor, Write as _};

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::FmiVersion;

/// The bytes of a unit from its files, in their order. No time of day: the same files make the same bytes.
///
/// # Errors
///
/// Those of the archive, such as a path that is there twice.
pub fn archive<B: AsRef<[u8]>>(files: &[(String, B)]) -> io::Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(zip::CompressionMethod::Deflated)
        .compression_level(Some(9));
    for (path, bytes) in files {
        archive.start_file(path.as_str(), options)?;
        archive.write_all(bytes.as_ref())?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The folder and the ending of binaries of this platform in a unit of a version; none of a platform for which the standard
/// has no name.
#[must_use]
pub fn platform(version: FmiVersion) -> Option<(&'static str, &'static str)> {
    let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
    match version {
        FmiVersion::Two => match (system, architecture) {
            ("linux", "x86_64") => Some(("linux64", "so")),
            ("macos", _) => Some(("darwin64", "dylib")),
            ("windows", "x86_64") => Some(("win64", "dll")),
            _ => None,
        },
        FmiVersion::Three => match (system, architecture) {
            ("linux", "x86_64") => Some(("x86_64-linux", "so")),
            ("linux", "aarch64") => Some(("aarch64-linux", "so")),
            ("macos", "x86_64") => Some(("x86_64-darwin", "dylib")),
            ("macos", "aarch64") => Some(("aarch64-darwin", "dylib")),
            ("windows", "x86_64") => Some(("x86_64-windows", "dll")),
            _ => None,
        },
    }
}

/// What a C compiler is given to make a binary from the sources, but for these and the result. Only the functions of the
/// standard are visible in it.
#[must_use]
pub fn compiler_arguments() -> &'static [&'static str] {
    &["-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-fvisibility=hidden", "-shared"]
}
