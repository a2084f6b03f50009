//! [`program_digests`]: what identifies the program of a controller, for campaigns that go on where they were.

use std::env;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};

/// Bytes that are read at a time.
const BLOCK: usize = 1 << 16;

/// For each word of a command the SHA-256 of the file that it names: the program by its path or that of the environment,
/// arguments from the folder in which it runs; none of a word that names no file.
pub(crate) fn program_digests(command: &[String], folder: &Path) -> Vec<Option<[u8; 32]>> {
    let words = command.iter().enumerate();
    words.map(|(index, word)| digest(&file_of(index == 0, word, folder)?).ok()).collect()
}

/// The file that a word names.
fn file_of(is_program: bool, word: &str, folder: &Path) -> Option<PathBuf> {
    let own = folder.join(word);
    let is_name = Path::new(word).components().count() == 1;
    if !(is_program && is_name) {
        return Some(own).filter(|path| path.is_file());
    }
    let paths = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&paths).map(|path| path.join(word)).find(|path| path.is_file());
    found.or_else(|| Some(own).filter(|path| path.is_file()))
}

fn digest(path: &Path) -> io::Result<[u8; 32]> {
    let mut file = File::open(path)?;
    let mut block = vec![0; BLOCK];
    let mut hash = Sha256::new();
    loop {
        let read = file.read(&mut block)?;
        if read == 0 {
            return Ok(hash.finalize().into());
        }
        hash.update(block.get(..read).unwrap_or_default());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_the_file_that_it_names() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("law.py"), "one").expect("written");
        let command = ["no-such-program-of-precess", "law.py", "--gain", "2"].map(str::to_owned);
        let first = program_digests(&command, folder.path());
        let kinds: Vec<_> = first.iter().map(Option::is_some).collect();
        assert_eq!(kinds, [false, true, false, false]);
        std::fs::write(folder.path().join("law.py"), "two").expect("written");
        assert_ne!(program_digests(&command, folder.path()), first);
    }

    #[cfg(unix)]
    #[test]
    fn a_program_is_looked_for_in_the_path() {
        let command = ["sh".to_owned()];
        assert!(program_digests(&command, Path::new("no such folder"))[0].is_some());
    }
}
