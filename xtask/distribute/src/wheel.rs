//! Wheels as small as their format allows: deflated by Zopfli, a twentieth smaller than by level 9, and read by every
//! `pip`. Names, order, times, permissions and contents of the members stay, and with them the checksums in `RECORD`.

use std::fs;
use std::io::{Cursor, Read as _, Write as _};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// Options of maturin: it packs, the members are compressed here.
pub(crate) const STORED: [&str; 2] = ["--compression-method", "stored"];
/// Nine more than iterations: more than three gain a thousandth.
const LEVEL: i64 = 12;
/// What is split into at most fifteen parts, each with codes of its own, bytes.
const BLOCK: usize = 200_000;

/// The one wheel of a folder.
pub(crate) fn of_folder(folder: &Path) -> Result<PathBuf, String> {
    let wrong = |error| format!("cannot read {}: {error}", folder.display());
    let found = fs::read_dir(folder).map_err(wrong)?.flatten().map(|entry| entry.path());
    let mut wheels = found.filter(|path| path.extension().is_some_and(|ending| ending == "whl"));
    wheels.next().ok_or_else(|| format!("{} has no wheel", folder.display()))
}

/// Compresses the members of a wheel, which maturin has stored.
pub(crate) fn compress(wheel: &Path) -> Result<(), String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", wheel.display());
    let stored = fs::read(wheel).map_err(|error| wrong(&error))?;
    let compressed = compressed(&stored).map_err(|error| wrong(&error))?;
    // Beside it first: a write that fails leaves the wheel as it was.
    let beside = wheel.with_extension("whl.part");
    fs::write(&beside, compressed).map_err(|error| wrong(&error))?;
    fs::rename(&beside, wheel).map_err(|error| wrong(&error))
}

fn compressed(stored: &[u8]) -> zip::result::ZipResult<Vec<u8>> {
    let mut from = ZipArchive::new(Cursor::new(stored))?;
    let mut to = ZipWriter::new(Cursor::new(Vec::new()));
    for index in 0..from.len() {
        let mut member = from.by_index(index)?;
        let mut options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(LEVEL))
            // Each block is written at once.
            .with_zopfli_buffer(None);
        if let Some(time) = member.last_modified() {
            options = options.last_modified_time(time);
        }
        if let Some(mode) = member.unix_mode() {
            options = options.unix_permissions(mode);
        }
        let mut bytes = Vec::new();
        member.read_to_end(&mut bytes)?;
        to.start_file(member.name()?, options)?;
        for block in bytes.chunks(BLOCK) {
            to.write_all(block)?;
        }
    }
    Ok(to.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use zip::DateTime;

    #[test]
    fn members_stay_as_they_are() {
        let members = [("a/RECORD", 0o644, "a,b,c\n".repeat(1000)), ("b.so", 0o755, String::new())];
        let mut stored = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, mode, text) in &members {
            let options = SimpleFileOptions::default()
                .compression_method(CompressionMethod::Stored)
                .last_modified_time(DateTime::from_date_and_time(2024, 2, 3, 4, 5, 6).unwrap())
                .unix_permissions(*mode);
            stored.start_file(*name, options).unwrap();
            stored.write_all(text.as_bytes()).unwrap();
        }
        let stored = stored.finish().unwrap().into_inner();
        let small = compressed(&stored).unwrap();
        assert!(small.len() < stored.len() / 2, "{} of {} bytes", small.len(), stored.len());
        assert_eq!(small, compressed(&stored).unwrap(), "the same bytes each time");
        let [mut before, mut after] =
            [stored, small].map(|bytes| ZipArchive::new(Cursor::new(bytes)).unwrap());
        assert_eq!(after.len(), members.len());
        for (index, (name, mode, text)) in members.iter().enumerate() {
            let time = before.by_index(index).unwrap().last_modified();
            let mut member = after.by_index(index).unwrap();
            assert_eq!((member.name().unwrap().as_ref(), member.last_modified()), (*name, time));
            assert_eq!(time.unwrap().year(), 2024);
            assert_eq!(member.unix_mode().map(|mode| mode & 0o777), Some(*mode));
            let mut found = String::new();
            member.read_to_string(&mut found).unwrap();
            assert_eq!(found, *text);
        }
    }
}
