//! Files that are opened to be read, remembered while a command is executed: none of its outputs replaces one of them.
//!
//! Everything in this crate that reads a file of a user opens it by [`open`].

use std::cell::RefCell;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

thread_local! {
    /// The files that this thread has opened; none where nobody asks.
    static OPENED: RefCell<Option<Vec<PathBuf>>> = const { RefCell::new(None) };
}

/// Opens a file to read it.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    let file = File::open(path)?;
    OPENED.with_borrow_mut(|opened| {
        if let Some(opened) = opened
            && !opened.iter().any(|known| known == path)
        {
            opened.push(path.to_owned());
        }
    });
    Ok(file)
}

/// Remembers what this thread opens from now on.
#[cfg(feature = "tool")]
pub(crate) fn remember() {
    OPENED.set(Some(Vec::new()));
}

/// What this thread has opened since then, each once.
#[cfg(feature = "tool")]
pub(crate) fn opened() -> Vec<PathBuf> {
    OPENED.with_borrow(|opened| opened.clone().unwrap_or_default())
}
