//! Progress of a campaign: the next chunk of each seed and property, in a small text file.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Chunks of one seed and property.
#[derive(Clone, Debug, Default)]
struct Chunks {
    /// The first one that is not finished.
    next: u64,
    /// The first one that is not begun.
    begun: u64,
    /// Finished ones after an unfinished one.
    finished: BTreeSet<u64>,
}

/// The file, and what it says.
#[derive(Clone, Debug)]
pub struct Progress {
    path: PathBuf,
    chunks: BTreeMap<(u64, String), Chunks>,
}

impl Progress {
    /// Reads the file; one that is not there says nothing. A line is `seed property next-chunk`.
    ///
    /// # Errors
    /// When it cannot be read, or has another line.
    pub fn read(path: &Path) -> io::Result<Self> {
        let text = match fs::read_to_string(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            other => other?,
        };
        let mut chunks = BTreeMap::new();
        for line in text.lines() {
            let known = || {
                let mut words = line.split(' ');
                let seed = words.next()?.parse().ok()?;
                let (name, next) = (words.next()?.to_owned(), words.next()?.parse().ok()?);
                Some(((seed, name), Chunks { next, begun: next, finished: BTreeSet::new() }))
            };
            let (key, value) = known().ok_or_else(|| {
                let what = format!("{}: `{line}` is no line of it; delete it", path.display());
                io::Error::new(io::ErrorKind::InvalidData, what)
            })?;
            chunks.insert(key, value);
        }
        Ok(Self { path: path.to_owned(), chunks })
    }

    /// The first seed that was never used, from 1.
    #[must_use]
    pub fn unused(&self) -> u64 {
        self.chunks.keys().map(|(seed, _)| seed + 1).max().unwrap_or(1)
    }

    /// The next chunk to be tried, which counts as begun.
    pub fn begin(&mut self, seed: u64, property: &str) -> u64 {
        let chunks = self.chunks.entry((seed, property.to_owned())).or_default();
        let next = chunks.begun;
        chunks.begun += 1;
        next
    }

    /// Notes that a chunk is finished; the file says so at once.
    pub fn finish(&mut self, seed: u64, property: &str, chunk: u64) {
        let chunks = self.chunks.entry((seed, property.to_owned())).or_default();
        chunks.finished.insert(chunk);
        while chunks.finished.remove(&chunks.next) {
            chunks.next += 1;
        }
        // What cannot be written is tried again after the next chunk.
        let _ = self.write();
    }

    /// Writes the file under another name first, so that it is never half there.
    fn write(&self) -> io::Result<()> {
        let mut text = String::new();
        for ((seed, name), chunks) in &self.chunks {
            let _ = writeln!(text, "{seed} {name} {}", chunks.next);
        }
        if let Some(folder) = self.path.parent() {
            fs::create_dir_all(folder)?;
        }
        let written = self.path.with_extension("new");
        fs::write(&written, text)?;
        fs::rename(&written, &self.path)
    }
}
