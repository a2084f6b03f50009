//! [`Extent`]: whether a CSV file that is read has all its samples, by the line with their number
//! ([`csv`](super::csv)).

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read as _, Seek as _, SeekFrom};
use std::path::Path;

use super::csv::{COUNT, NOT_ENDED};

/// The number of samples is within the first lines of a file, bytes.
const HEAD_BYTES: u64 = 1 << 20;

/// The comments at the start of a CSV file, without the ends of lines; the reader is left behind them.
///
/// # Errors
/// Of the operating system.
pub(crate) fn comments(reader: &mut impl BufRead) -> io::Result<Vec<String>> {
    let mut comments = Vec::new();
    while reader.fill_buf()?.first() == Some(&b'#') {
        let mut line = Vec::new();
        reader.read_until(b'\n', &mut line)?;
        comments.push(String::from_utf8_lossy(&line).trim_end().to_owned());
    }
    Ok(comments)
}

/// Rejects a CSV file of samples, read elsewhere, that has other than the number of rows that it states.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn check_rows(path: &Path, rows: usize) -> Result<(), String> {
    let is_file = |file: &File| file.metadata().is_ok_and(|metadata| metadata.is_file());
    let Some(file) = File::open(path).ok().filter(is_file) else { return Ok(()) };
    // A first line of our files is short; others may have no end.
    let mut reader = BufReader::new(file.take(HEAD_BYTES));
    let comments = comments(&mut reader).map_err(|error| error.to_string())?;
    let extent = Extent::of_comments(comments.iter().map(String::as_str));
    let missing = extent.missing(path, u64::try_from(rows).unwrap_or(u64::MAX));
    missing.map_err(|error| error.to_string())?.map_or(Ok(()), Err)
}

/// What a CSV file says of the number of its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// Nothing: it is of an earlier version, or of another program.
    Unstated,
    /// The run that writes it, or wrote it, has not ended.
    NotEnded,
    /// It has so many.
    Samples(u64),
}

impl Extent {
    /// What the comments at the start of a file say.
    pub(crate) fn of_comments<'a>(comments: impl Iterator<Item = &'a str>) -> Self {
        let stated = |line: &'a str| line.strip_prefix(COUNT);
        let Some(text) = comments.into_iter().find_map(stated) else { return Self::Unstated };
        let count = text.split_whitespace().next().and_then(|count| count.parse().ok());
        match count {
            Some(samples) => Self::Samples(samples),
            None if text.starts_with(NOT_ENDED) => Self::NotEnded,
            None => Self::Unstated,
        }
    }

    /// What is wrong with a file of which so many rows were read; none where it has all that it should.
    ///
    /// # Errors
    /// Of the operating system.
    pub(crate) fn missing(self, path: &Path, rows: u64) -> io::Result<Option<String>> {
        let Self::Samples(samples) = self else { return Ok(None) };
        let mut file = File::open(path)?;
        let mut last = [b'\n'];
        if file.seek(SeekFrom::End(0))? > 0 {
            file.seek(SeekFrom::End(-1))?;
            file.read_exact(&mut last)?;
        }
        if rows == samples && last == [b'\n'] {
            return Ok(None);
        }
        let end = if last == [b'\n'] { "" } else { ", the last without the end of its line" };
        Ok(Some(format!(
            "it was cut or changed: {rows} samples are there{end}, and {samples} were written; copy it again, or run the \
             scenario again"
        )))
    }
}
