//! [`Outputs`]: the files that a command writes. They are reserved for it, are not there or may be replaced, and none is
//! one that it reads.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, BufRead as _, ErrorKind, IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};

use super::error::CommandError;
use super::progress::interruptible;
use super::terminal::written;
use crate::opened::opened;
use crate::record::partial::{Partial, Reservation, partial_name};

/// The files that a command writes into a folder.
#[derive(Debug)]
pub(super) struct Outputs {
    folder: PathBuf,
    /// Whether files that are there are replaced.
    force: bool,
    /// Of names that are not yet written.
    reserved: BTreeMap<String, Reservation>,
    /// Folders that were made, the outermost first.
    made: Vec<PathBuf>,
}

impl Outputs {
    /// Reserves names in a folder, which is made if it is missing. Asks on a terminal whether files that are there may be
    /// replaced, and refuses elsewhere.
    ///
    /// # Errors
    /// [`CommandError::Exists`], [`CommandError::Input`], a name that another program writes, or the operating system's
    /// reason. Nothing is then changed.
    pub(super) fn reserve(
        folder: &Path,
        names: &[String],
        force: bool,
    ) -> Result<Self, CommandError> {
        let (folder, reserved) = (folder.to_owned(), BTreeMap::new());
        let mut outputs = Self { folder, force, reserved, made: Vec::new() };
        outputs.add(names)?;
        Ok(outputs)
    }

    /// Reserves a file, or several in its folder.
    ///
    /// # Errors
    /// Those of [`reserve`](Self::reserve).
    pub(super) fn of_files(paths: &[&Path], force: bool) -> Result<Self, CommandError> {
        let folder = paths.first().and_then(|path| path.parent()).unwrap_or(Path::new(""));
        let names: Vec<_> = paths.iter().map(|path| name_of(path)).collect();
        Self::reserve(folder, &names, force)
    }

    /// Reserves a folder that another program writes, and replaces where it is allowed to.
    ///
    /// # Errors
    /// Those of [`reserve`](Self::reserve); [`CommandError::Input`] of a file in the folder.
    pub(super) fn of_folder(folder: &Path) -> Result<Self, CommandError> {
        let real = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let is_within =
            |path: &PathBuf| path.canonicalize().is_ok_and(|path| path.starts_with(&real));
        if let Some(input) = opened().into_iter().find(is_within) {
            return Err(CommandError::Input(input));
        }
        // Without a stroke at its end.
        let folder: PathBuf = folder.components().collect();
        let mut outputs = Self::reserve(folder.parent().unwrap_or(Path::new("")), &[], true)?;
        let reservation = Reservation::new(&folder).map_err(failure(&folder))?;
        outputs.reserved.insert(name_of(&folder), reservation);
        Ok(outputs)
    }

    /// Reserves more names.
    ///
    /// # Errors
    /// Those of [`reserve`](Self::reserve).
    pub(super) fn add(&mut self, names: &[String]) -> Result<(), CommandError> {
        if self.folder.is_file() {
            let message = format!("{} is a file; name a folder", self.folder.display());
            return Err(CommandError::Other(message));
        }
        let names: Vec<_> =
            names.iter().filter(|name| !self.reserved.contains_key(*name)).collect();
        // In one order in every program: of two that want some of the same names one has them all.
        let mut paths: Vec<_> = names.iter().map(|name| self.folder.join(name)).collect();
        paths.sort();
        let pairs = paths.iter().zip(paths.iter().skip(1));
        if let Some((path, _)) = pairs.into_iter().find(|(path, next)| path == next) {
            let path = path.display();
            let message =
                format!("{path} would be written twice: two names give one file; rename one");
            return Err(CommandError::Other(message));
        }
        check_inputs(&paths)?;
        self.may_replace(&paths)?;
        self.make_folder()?;
        for path in &paths {
            let reservation = Reservation::new(path).map_err(failure(path))?;
            self.reserved.insert(name_of(path), reservation);
        }
        // Another program may have written them until they were reserved.
        match paths.into_iter().find(|path| path.exists() && !self.force) {
            Some(path) => Err(CommandError::Exists(path)),
            None => Ok(()),
        }
    }

    /// Files that are there are replaced from now on.
    pub(super) fn replace(&mut self) {
        self.force = true;
    }

    /// The reservation of a name, for a recorder that writes it.
    pub(super) fn take(&mut self, name: &str) -> Option<Reservation> {
        self.reserved.remove(name)
    }

    /// Writes files, all or none: each under another name, and all get theirs once they are on the disk. Returns their
    /// paths.
    ///
    /// # Errors
    /// Those of [`reserve`](Self::reserve) for names that are not reserved yet, and a file that cannot be written.
    pub(super) fn write<B: AsRef<[u8]>>(
        &mut self,
        files: &[(String, B)],
    ) -> Result<Vec<PathBuf>, CommandError> {
        let names: Vec<_> = files.iter().map(|(name, _)| name.clone()).collect();
        self.add(&names)?;
        let mut partials = Vec::new();
        for (name, bytes) in files {
            let Some(reservation) = self.take(name) else { continue };
            let path = reservation.path().to_owned();
            let done = reservation.begin().and_then(|mut partial| {
                let done = partial.write_all(bytes.as_ref()).and_then(|()| partial.sync());
                partials.push(partial);
                done
            });
            if let Err(source) = done {
                discard(partials);
                return Err(CommandError::Io { path, source });
            }
        }
        let mut paths = Vec::new();
        let mut partials = partials.into_iter();
        while let Some(partial) = partials.next() {
            let path = partial.path().to_owned();
            if let Err(source) = partial.finish() {
                let _ = fs::remove_file(partial_name(&path));
                discard(partials.collect());
                return Err(CommandError::Io { path, source }.leaving(paths));
            }
            paths.push(path);
        }
        Ok(paths)
    }

    /// The partial files that a run left which ended with an error; empty ones are removed.
    pub(super) fn left(&self, names: &[String]) -> Vec<PathBuf> {
        let of_name = |name: &String| {
            let path = self.folder.join(name);
            let spool = self.folder.join(format!("{name}.samples"));
            [partial_name(&path), partial_name(&spool)]
        };
        let has_samples = |path: &PathBuf| match fs::symlink_metadata(path) {
            Ok(metadata) if metadata.is_file() && metadata.len() == 0 => {
                let _ = fs::remove_file(path);
                false
            }
            found => found.is_ok(),
        };
        let names = names.iter().filter(|name| !self.reserved.contains_key(*name));
        names.flat_map(of_name).filter(has_samples).collect()
    }

    /// Rejects a path that is there and may not be replaced.
    fn may_replace(&mut self, paths: &[PathBuf]) -> Result<(), CommandError> {
        let Some(path) = paths.iter().find(|path| path.exists()) else { return Ok(()) };
        if let Some(folder) = paths.iter().find(|path| path.is_dir()) {
            return Err(CommandError::Exists(folder.clone()));
        }
        if self.force {
            return Ok(());
        }
        let stdin = io::stdin();
        if !stdin.is_terminal() || !io::stderr().is_terminal() {
            return Err(CommandError::Exists(path.clone()));
        }
        let question =
            format!("{} exists. Replace it and the results beside it? [y/N] ", path.display());
        let mut answer = String::new();
        let asked = written(&mut io::stderr(), &question);
        let read = interruptible(|| asked.and_then(|()| stdin.lock().read_line(&mut answer)));
        if read.is_ok() && matches!(answer.trim(), "y" | "Y" | "yes") {
            self.force = true;
            return Ok(());
        }
        Err(CommandError::Exists(path.clone()))
    }

    fn make_folder(&mut self) -> Result<(), CommandError> {
        let is_missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
        let mut missing: Vec<_> =
            self.folder.ancestors().take_while(is_missing).map(Path::to_owned).collect();
        missing.reverse();
        for folder in missing {
            match fs::create_dir(&folder) {
                Ok(()) => self.made.push(folder),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(source) => return Err(failure(&folder)(source)),
            }
        }
        Ok(())
    }
}

impl Drop for Outputs {
    /// Gives the names free, and removes folders that were made for nothing.
    fn drop(&mut self) {
        self.reserved.clear();
        for folder in self.made.iter().rev() {
            // Not one in which there is something.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Rejects a path that is that of a file which the command reads, or whose partial file is.
fn check_inputs(paths: &[PathBuf]) -> Result<(), CommandError> {
    let inputs = opened();
    for path in paths {
        for written in [path.clone(), partial_name(path)] {
            if inputs.iter().any(|input| is_same(input, &written)) {
                return Err(CommandError::Input(written));
            }
        }
    }
    Ok(())
}

fn failure(path: &Path) -> impl FnOnce(io::Error) -> CommandError + use<> {
    let path = path.to_owned();
    |source| CommandError::Io { path, source }
}

/// The name of a file in its folder.
pub(super) fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

fn discard(partials: Vec<Partial>) {
    for partial in partials {
        let _ = partial.discard();
    }
}

/// Whether two paths are of one file, also by links and other spellings.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    let [Ok(real_a), Ok(real_b)] = [a, b].map(Path::canonicalize) else { return false };
    real_a == real_b || is_linked(&real_a, &real_b)
}

/// Whether two names are hard links to one file.
#[cfg(unix)]
fn is_linked(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let place = |path: &Path| fs::metadata(path).ok().map(|of| (of.dev(), of.ino()));
    place(a).is_some_and(|place_a| place(b) == Some(place_a))
}

/// Whether two names are hard links to one file: not known here.
#[cfg(not(unix))]
fn is_linked(_: &Path, _: &Path) -> bool {
    false
}

/// The names of the files in a folder that have an extension.
pub(super) fn files(folder: &Path, extension: &str) -> Result<BTreeSet<String>, CommandError> {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder).map_err(failure(folder))? {
        let name = entry.map_err(failure(folder))?.file_name();
        if Path::new(&name).extension().is_some_and(|found| found == extension) {
            names.insert(name.to_string_lossy().into_owned());
        }
    }
    Ok(names)
}
