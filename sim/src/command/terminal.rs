//! What a command prints: its answer to standard output by [`print`], notes and errors to standard error by [`note`].
//!
//! Titles, names and keys come from files, and a terminal obeys the control characters in them: they are
//! [escaped](visible).

use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::{self, ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use super::error::CommandError;

/// Whether a note could not be written.
static NOTE_LOST: AtomicBool = AtomicBool::new(false);

/// Prints to standard output. A reader that has gone away, as `head` does, is no error: the command then goes on
/// with the files that it writes.
///
/// # Errors
/// [`CommandError::Output`] where the text cannot be written, as on a full disk.
pub(super) fn print(text: &str) -> Result<(), CommandError> {
    written(&mut io::stdout().lock(), text).map_err(CommandError::Output)
}

/// Prints a line to standard error. Where that is not possible the command goes on, and [ends with an
/// error](notes_are_written).
pub(super) fn note(text: &str) {
    let line = format!("{}\n", text.trim_end_matches('\n'));
    if written(&mut io::stderr().lock(), &line).is_err() {
        NOTE_LOST.store(true, Ordering::Relaxed);
    }
}

/// Whether every note was written.
pub(super) fn notes_are_written() -> bool {
    !NOTE_LOST.load(Ordering::Relaxed)
}

/// Writes a text; a closed pipe takes it, too.
pub(super) fn written(to: &mut dyn Write, text: &str) -> io::Result<()> {
    match to.write_all(visible(text).as_bytes()).and_then(|()| to.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done,
    }
}

/// A text whose control characters are escaped as in JSON and TOML, `\u001b`, but for the ends of lines and tabs; so
/// are the characters that change the direction of what follows.
pub(super) fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_escaped) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for letter in text.replace("\r\n", "\n").chars() {
        if is_escaped(letter) {
            let _ = write!(shown, "\\u{:04x}", u32::from(letter));
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

fn is_escaped(letter: char) -> bool {
    let turns = matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (letter.is_control() && !matches!(letter, '\n' | '\t'))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A writer whose every write has an error of one kind.
    struct Failing(ErrorKind);

    impl Write for Failing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn control_characters_are_escaped_and_lines_stay() {
        assert_eq!(visible("a\tb\r\nc\n"), "a\tb\nc\n");
        assert_eq!(
            visible("\u{1b}]0;x\u{7}\u{9b}2J\u{202e}\r"),
            "\\u001b]0;x\\u0007\\u009b2J\\u202e\\u000d"
        );
        let json = serde_json::to_string("\u{1b}\u{7f}\u{9b}").expect("JSON");
        let read: String = serde_json::from_str(&visible(&json)).expect("JSON");
        assert_eq!(read, "\u{1b}\u{7f}\u{9b}");
    }

    #[test]
    fn a_closed_pipe_is_no_error_and_a_full_disk_is() {
        assert!(written(&mut Failing(ErrorKind::BrokenPipe), "a").is_ok());
        assert!(written(&mut Failing(ErrorKind::StorageFull), "a").is_err());
    }
}
