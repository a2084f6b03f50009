//! [`Partial`]: a file that is written as it comes, under the name `NAME.partial`, and gets its
//! name once it is complete and on the disk.
//!
//! A program that is killed leaves the partial file with everything up to the last flush: at most a
//! second, or 64 kB, before. A file of the wanted name is replaced only by the rename, whole; a
//! partial file that an earlier run left is overwritten. Whether a present result may be replaced is
//! for the caller to decide, once it has the [`Reservation`] of its name.
//!
//! A [`Reservation`] is a lock on the partial file, by which one program writes a name at a time. The operating system
//! drops the lock of a program that is killed. File systems without locks have none: two programs that write one name
//! are then for the user to avoid.

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::file_lock;

/// What is kept in memory at most.
const BUFFER: usize = 64 * 1024;
/// For how long it is kept at most.
const FLUSH: Duration = Duration::from_secs(1);

/// A name that only one program writes, from before the file is begun until it is dropped.
#[derive(Debug)]
pub struct Reservation {
    /// Locked; none once it is begun.
    file: Option<File>,
    /// The name with `.partial`.
    beside: PathBuf,
    path: PathBuf,
}

/// A file in progress.
#[derive(Debug)]
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

impl Reservation {
    /// Reserves a path, in a folder that exists. Nothing that is there is changed.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::ResourceBusy`] with the program that has it, or the operating system's reason.
    pub fn new(path: &Path) -> io::Result<Self> {
        let beside = partial_name(path);
        let options = &mut File::options();
        options.read(true).write(true).create(true);
        loop {
            let file = options.open(&beside)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
                Err(TryLockError::WouldBlock) => return Err(in_use(&file)),
                Err(TryLockError::Error(error)) => return Err(error),
            }
            // The program that had the lock may have renamed the file in the meantime.
            if file_lock::is_at(&file, &beside) {
                return Ok(Self { file: Some(file), beside, path: path.to_owned() });
            }
        }
    }

    /// The name that is reserved.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Begins the file, empty.
    ///
    /// # Errors
    ///
    /// Of the operating system.
    pub fn begin(mut self) -> io::Result<Partial> {
        let Some(file) = self.file.take() else { return Err(ErrorKind::NotFound.into()) };
        // A device has no length.
        if file.metadata()?.is_file() {
            file.set_len(0)?;
        }
        let file = BufWriter::with_capacity(BUFFER, file);
        let [beside, path] = [&self.beside, &self.path].map(Clone::clone);
        Ok(Partial { file, beside, path, flushed: Instant::now() })
    }
}

impl Drop for Reservation {
    /// Removes a partial file that has nothing, while it is locked: it was made for the lock.
    fn drop(&mut self) {
        let Some(file) = &self.file else { return };
        if file.metadata().is_ok_and(|found| found.is_file() && found.len() == 0) {
            let _ = fs::remove_file(&self.beside);
        }
    }
}

/// Begins the file of a path, by its reservation where there is one.
pub(crate) fn begin(reserved: Option<Reservation>, path: &Path) -> io::Result<Partial> {
    reserved.map_or_else(|| Partial::create(path), Reservation::begin)
}

/// The error of a file that another program has locked.
pub(crate) fn in_use(file: &File) -> io::Error {
    let who = file_lock::lock_holder(file).unwrap_or_else(|| "another program".to_owned());
    let text = format!("in use by {who}; wait for its end, or choose another folder");
    io::Error::new(ErrorKind::ResourceBusy, text)
}

impl Partial {
    /// Reserves a path and begins the file, in a folder that exists.
    ///
    /// # Errors
    ///
    /// Those of [`Reservation::new`].
    pub fn create(path: &Path) -> io::Result<Self> {
        Reservation::new(path)?.begin()
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

    /// Writes everything to the disk.
    ///
    /// # Errors
    ///
    /// Of the operating system.
    pub fn sync(&mut self) -> io::Result<()> {
        self.file.flush()?;
        let file = self.file.get_ref();
        // A device has nothing to write.
        if file.metadata()?.is_file() { file.sync_all() } else { Ok(()) }
    }

    /// Writes everything to the disk and gives the file its name.
    ///
    /// # Errors
    ///
    /// Of the operating system; the partial file then stays.
    pub fn finish(mut self) -> io::Result<()> {
        self.sync()?;
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
        // While it is locked: afterwards it may be another program's.
        let removed = fs::remove_file(&self.beside);
        // What is buffered is not wanted, nor is an error about it.
        let _ = self.file.into_parts();
        removed
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
