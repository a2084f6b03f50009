//! [`Partial`]: a file that is written as it comes, under the name `NAME.partial`, and gets its
//! name once it is complete and on the disk.
//!
//! A program that is killed leaves the partial file with everything up to the last flush: at most a
//! second, or 64 kB, before. A file of the wanted name is replaced only by the rename, whole; a
//! partial file that an earlier run left is overwritten. Whether a present result may be replaced is
//! for the caller to decide, before the run.

use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What is kept in memory at most.
const BUFFER: usize = 64 * 1024;
/// For how long it is kept at most.
const FLUSH: Duration = Duration::from_secs(1);

/// A file in progress.
pub struct Partial {
    file: BufWriter<File>,
    /// The name with `.partial`.
    beside: PathBuf,
    path: PathBuf,
    flushed: Instant,
}

/// The name under which a file is written.
#[must_use]
pub fn partial_name(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    PathBuf::from(name)
}

impl Partial {
    /// Makes the partial file of a path, in a folder that exists.
    ///
    /// # Errors
    ///
    /// Of the operating system.
    pub fn create(path: &Path) -> io::Result<Self> {
        let beside = partial_name(path);
        let options = &mut File::options();
        let file = options.read(true).write(true).create(true).truncate(true).open(&beside)?;
        let file = BufWriter::with_capacity(BUFFER, file);
        Ok(Self { file, beside, path: path.to_owned(), flushed: Instant::now() })
    }

    /// The name that the file gets.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Hands what is buffered to the operating system, if it has been kept for a second.
    ///
    /// # Errors
    ///
    /// Of the operating system.
    pub fn flush_at_times(&mut self) -> io::Result<()> {
        if self.flushed.elapsed() < FLUSH {
            return Ok(());
        }
        self.flushed = Instant::now();
        self.file.flush()
    }

    /// Writes everything to the disk and gives the file its name.
    ///
    /// # Errors
    ///
    /// Of the operating system; the partial file then stays.
    pub fn finish(mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_all()?;
        fs::rename(&self.beside, &self.path)?;
        sync_folder(&self.path);
        Ok(())
    }

    /// Removes the partial file: of a spool whose content is in another file.
    ///
    /// # Errors
    ///
    /// Of the operating system.
    pub fn discard(self) -> io::Result<()> {
        let Self { file, beside, .. } = self;
        drop(file);
        fs::remove_file(beside)
    }

    /// The file from its start, to be read, once everything is written.
    ///
    /// # Errors
    ///
    /// Of the operating system.
    pub fn rewind(&mut self) -> io::Result<&mut File> {
        self.file.flush()?;
        let file = self.file.get_mut();
        file.seek(SeekFrom::Start(0))?;
        Ok(file)
    }
}

impl Write for Partial {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Partial {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// Makes a rename durable where folders can be opened; elsewhere the file system does so.
fn sync_folder(path: &Path) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Ok(folder) = File::open(folder.unwrap_or(Path::new("."))) {
        let _ = folder.sync_all();
    }
}
