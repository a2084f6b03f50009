//! What is distributed, and archives: a gzipped tar with sorted names, one time, no owner; and back again.

use std::io::Read as _;
use std::path::{Component, Path};

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use tar::{Archive, Builder, EntryType, Header};

/// A file that is distributed.
pub(super) struct Package {
    pub(super) name: String,
    pub(super) bytes: Vec<u8>,
}

/// A file of an archive, or a symbolic link.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    /// Its path, with `/` between folders.
    pub(super) path: String,
    pub(super) content: Content,
}

/// What an entry is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Content {
    File {
        bytes: Vec<u8>,
        executable: bool,
    },
    /// To a path that starts at the folder of the link.
    Link(String),
}

impl Entry {
    /// A file that is not executable.
    pub(super) fn file(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        let content = Content::File { bytes: bytes.into(), executable: false };
        Self { path: path.into(), content }
    }

    /// A symbolic link.
    pub(super) fn link(path: impl Into<String>, to: impl Into<String>) -> Self {
        Self { path: path.into(), content: Content::Link(to.into()) }
    }
}

/// The time of every entry, seconds since 1970: `SOURCE_DATE_EPOCH`, or the first that a zip can state.
pub(super) fn time() -> u64 {
    const FIRST_OF_ZIP: u64 = 315_532_800;
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.parse().ok());
    given.unwrap_or(FIRST_OF_ZIP)
}

/// An archive of the entries in a folder `root`, sorted by path.
pub(super) fn pack(root: &str, entries: &[Entry]) -> Result<Vec<u8>, String> {
    let mut sorted: Vec<_> = entries.iter().collect();
    sorted.sort_by(|a, b| a.path.cmp(&b.path));
    // The header of gzip has neither time nor name.
    let mut builder = Builder::new(GzEncoder::new(Vec::new(), Compression::best()));
    for entry in sorted {
        let path = format!("{root}/{}", entry.path);
        let mut header = Header::new_gnu();
        header.set_mtime(time());
        let appended = match &entry.content {
            Content::File { bytes, executable } => {
                header.set_size(bytes.len() as u64);
                header.set_mode(if *executable { 0o755 } else { 0o644 });
                builder.append_data(&mut header, &path, bytes.as_slice())
            }
            Content::Link(to) => {
                header.set_size(0);
                header.set_mode(0o777);
                header.set_entry_type(EntryType::Symlink);
                builder.append_link(&mut header, &path, to)
            }
        };
        appended.map_err(|error| format!("cannot pack {path}: {error}"))?;
    }
    let packed = builder.into_inner().and_then(GzEncoder::finish);
    packed.map_err(|error| format!("cannot pack {root}: {error}"))
}

/// The entries of an archive, without the folder that they are in.
pub(super) fn unpack(packed: &[u8]) -> Result<Vec<Entry>, String> {
    let wrong = |error: std::io::Error| format!("cannot unpack: {error}");
    let mut entries = Vec::new();
    for entry in Archive::new(GzDecoder::new(packed)).entries().map_err(wrong)? {
        let mut entry = entry.map_err(wrong)?;
        let path = inside(&entry.path().map_err(wrong)?)?;
        let content = if let Some(to) = entry.link_name().map_err(wrong)? {
            Content::Link(to.to_string_lossy().into_owned())
        } else {
            let mode = entry.header().mode().map_err(wrong)?;
            let mut bytes = Vec::new();
            entry.read_to_end(&mut bytes).map_err(wrong)?;
            Content::File { bytes, executable: mode & 0o100 != 0 }
        };
        entries.push(Entry { path, content });
    }
    Ok(entries)
}

/// A path without its first folder; an error where it leads out of that.
fn inside(path: &Path) -> Result<String, String> {
    let mut parts = path.components();
    let plain = |part: Component| match part {
        Component::Normal(name) => name.to_str().map(str::to_owned),
        _ => None,
    };
    let wrong = || format!("{} leads out of its archive, or is no text", path.display());
    parts.next().and_then(plain).ok_or_else(wrong)?;
    let names: Option<Vec<_>> = parts.map(plain).collect();
    Ok(names.ok_or_else(wrong)?.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_archive_does_not_depend_on_the_order_of_its_entries() -> Result<(), String> {
        let entries = [Entry::file("b/c.txt", "text"), Entry::link("a", "b/c.txt")];
        let packed = pack("root", &entries)?;
        let turned: Vec<_> = entries.iter().rev().cloned().collect();
        assert_eq!(packed, pack("root", &turned)?);
        assert_eq!(unpack(&packed)?, turned);
        Ok(())
    }

    #[test]
    fn the_header_of_gzip_has_neither_time_nor_system() -> Result<(), String> {
        let packed = pack("root", &[])?;
        assert_eq!(packed.get(..10), Some(&[0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 2, 255][..]));
        Ok(())
    }

    #[test]
    fn a_path_that_leads_out_of_the_archive_is_rejected() {
        assert_eq!(inside(Path::new("root/a/b")), Ok("a/b".to_owned()));
        assert!(inside(Path::new("root/../b")).is_err());
        assert!(inside(Path::new("/b")).is_err());
    }
}
