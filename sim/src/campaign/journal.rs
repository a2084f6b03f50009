//! [`Journal`]: finished samples on the disk, one checksummed record each, appended as they come.
//!
//! ```text
//! header    "precess-journal-1\n", SHA-256 of the plan (32 bytes), numbers of a row (u32)
//! record    length of the content (u32), its CRC-32 (u32), content
//! content   number of the sample (u32), 0 and the row (f64 each), or 1 and the error in UTF-8
//! ```
//!
//! Numbers are little-endian. A program that is killed leaves at most one record that is cut off, at the end; it is
//! dropped, with all after a record whose checksum is wrong, and these samples are run again. The header is complete: it
//! is written under another name and renamed. A lock keeps a second program out.

use std::fs::{self, File, TryLockError};
use std::io::{BufReader, ErrorKind, Read, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::{CampaignError, SampleResult};
use crate::record::partial::{Reservation, in_use};

const MAGIC: &[u8] = b"precess-journal-1\n";
/// Bytes of an error's text that are kept.
const TEXT_MAX: usize = 2000;
/// Records are forced to the disk this often.
const SYNC: Duration = Duration::from_secs(1);

/// Finished samples on the disk.
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
    synced: Instant,
}

impl Journal {
    /// Opens the journal of a plan, or makes it, and returns the rows that it has, in the order in which they were
    /// finished. `force` discards one of another plan.
    ///
    /// # Errors
    /// A journal of another plan, one that another program writes to, or the operating system's reason.
    pub fn open(
        path: &Path,
        digest: &[u8; 32],
        fields: usize,
        force: bool,
    ) -> Result<(Self, Vec<SampleResult>), CampaignError> {
        let io = |source| CampaignError::Io { path: path.to_owned(), source };
        let mut header = MAGIC.to_vec();
        header.extend_from_slice(digest);
        header.extend(u32::try_from(fields).unwrap_or(u32::MAX).to_le_bytes());
        let mut file = match File::options().read(true).write(true).open(path) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::NotFound => made(path, &header)?,
            Err(error) => return Err(io(error)),
        };
        lock(&file, path)?;
        let mut found = vec![0; header.len()];
        let is_ours = file.read_exact(&mut found).is_ok() && found == header;
        if !is_ours && !force {
            return Err(CampaignError::OtherPlan(path.to_owned()));
        }
        if !is_ours {
            fs::remove_file(path).map_err(io)?;
            file = made(path, &header)?;
            lock(&file, path)?;
            file.seek(SeekFrom::End(0)).map_err(io)?;
        }
        let (rows, length) = records(&file, fields);
        let end = length.saturating_add(u64::try_from(header.len()).unwrap_or(u64::MAX));
        file.set_len(end).map_err(io)?;
        file.seek(SeekFrom::Start(end)).map_err(io)?;
        Ok((Self { file, path: path.to_owned(), synced: Instant::now() }, rows))
    }

    /// Appends a row.
    ///
    /// # Errors
    /// The operating system's reason.
    pub fn append(&mut self, row: &SampleResult) -> Result<(), CampaignError> {
        let content = content(row);
        let mut record = u32::try_from(content.len()).unwrap_or(u32::MAX).to_le_bytes().to_vec();
        record.extend(crc32fast::hash(&content).to_le_bytes());
        record.extend(content);
        let written = self.file.write_all(&record).and_then(|()| {
            if self.synced.elapsed() < SYNC {
                return Ok(());
            }
            self.synced = Instant::now();
            self.file.sync_data()
        });
        written.map_err(|source| CampaignError::Io { path: self.path.clone(), source })
    }

    /// Forces everything to the disk.
    ///
    /// # Errors
    /// The operating system's reason.
    pub fn sync(&self) -> Result<(), CampaignError> {
        let synced = self.file.sync_all();
        synced.map_err(|source| CampaignError::Io { path: self.path.clone(), source })
    }
}

/// A file with a header, whole from the start; that of another program, if it made one in the meantime.
fn made(path: &Path, header: &[u8]) -> Result<File, CampaignError> {
    let failed = |source: std::io::Error| match source.kind() {
        ErrorKind::ResourceBusy => CampaignError::Locked { path: path.to_owned(), source },
        _ => CampaignError::Io { path: path.to_owned(), source },
    };
    let reservation = Reservation::new(path).map_err(failed)?;
    if !path.exists() {
        let mut partial = reservation.begin().map_err(failed)?;
        partial.write_all(header).and_then(|()| partial.finish()).map_err(failed)?;
    }
    File::options().read(true).write(true).open(path).map_err(failed)
}

fn lock(file: &File, path: &Path) -> Result<(), CampaignError> {
    let path = || path.to_owned();
    match file.try_lock() {
        // File systems without locks: two programs are then for the user to avoid.
        Ok(()) => Ok(()),
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(()),
        Err(TryLockError::WouldBlock) => {
            Err(CampaignError::Locked { path: path(), source: in_use(file) })
        }
        Err(TryLockError::Error(source)) => Err(CampaignError::Io { path: path(), source }),
    }
}

fn content(row: &SampleResult) -> Vec<u8> {
    let mut content = u32::try_from(row.sample).unwrap_or(u32::MAX).to_le_bytes().to_vec();
    match &row.result {
        Ok(numbers) => {
            content.push(0);
            content.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        }
        Err(text) => {
            content.push(1);
            content.extend(kept(text).as_bytes());
        }
    }
    content
}

/// As much of an error's text as the journal keeps.
pub(super) fn kept(text: &str) -> &str {
    text.get(..text.floor_char_boundary_of(TEXT_MAX)).unwrap_or_default()
}

trait Boundary {
    /// The last boundary of a letter that is not beyond an index.
    fn floor_char_boundary_of(&self, index: usize) -> usize;
}

impl Boundary for str {
    fn floor_char_boundary_of(&self, index: usize) -> usize {
        (0..=index.min(self.len())).rev().find(|at| self.is_char_boundary(*at)).unwrap_or(0)
    }
}

/// Whole records from the present place on, and their length in bytes.
fn records(file: &File, fields: usize) -> (Vec<SampleResult>, u64) {
    let mut reader = BufReader::new(file);
    let (mut rows, mut length) = (Vec::new(), 0);
    while let Some((row, bytes)) = record(&mut reader, fields) {
        rows.push(row);
        length += bytes;
    }
    (rows, length)
}

fn record(reader: &mut impl Read, fields: usize) -> Option<(SampleResult, u64)> {
    let (mut size, mut sum) = ([0; 4], [0; 4]);
    reader.read_exact(&mut size).ok()?;
    reader.read_exact(&mut sum).ok()?;
    let size = usize::try_from(u32::from_le_bytes(size)).ok()?;
    if size > 5 + TEXT_MAX.max(fields.saturating_mul(8)) {
        return None;
    }
    let mut content = vec![0; size];
    reader.read_exact(&mut content).ok()?;
    if crc32fast::hash(&content) != u32::from_le_bytes(sum) {
        return None;
    }
    let (sample, rest) = content.split_first_chunk::<4>()?;
    let sample = usize::try_from(u32::from_le_bytes(*sample)).ok()?;
    let result = match rest.split_first()? {
        (0, bytes) if bytes.len() == fields * 8 => {
            let (numbers, _) = bytes.as_chunks::<8>();
            Ok(numbers.iter().map(|number| f64::from_le_bytes(*number)).collect())
        }
        (1, text) => Err(String::from_utf8(text.to_vec()).ok()?),
        _ => return None,
    };
    Some((SampleResult { sample, result }, u64::try_from(size + 8).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: [u8; 32] = [7; 32];

    fn rows() -> Vec<SampleResult> {
        let failed = SampleResult { sample: 1, result: Err("solver: \u{b5}".to_owned()) };
        let row = |sample, numbers: &[f64]| SampleResult { sample, result: Ok(numbers.to_vec()) };
        vec![row(2, &[1.0, -0.0]), failed, row(0, &[f64::MAX, 5e-324])]
    }

    fn written(folder: &Path) -> (PathBuf, Vec<u8>) {
        let path = folder.join("a.journal");
        let (mut journal, found) = Journal::open(&path, &PLAN, 2, false).expect("made");
        assert!(found.is_empty());
        for row in rows() {
            journal.append(&row).expect("written");
        }
        let bytes = fs::read(&path).expect("a file");
        (path, bytes)
    }

    #[test]
    fn a_journal_cut_anywhere_has_its_whole_records_and_takes_more() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, bytes) = written(folder.path());
        let header = MAGIC.len() + 36;
        let mut most = 0;
        for length in header..=bytes.len() {
            fs::write(&path, &bytes[..length]).expect("cut");
            let (mut journal, found) = Journal::open(&path, &PLAN, 2, false).expect("opened");
            assert_eq!(found, rows()[..found.len()], "{length}");
            assert!(found.len() >= most);
            most = found.len();
            journal.append(&rows()[2]).expect("written");
            drop(journal);
            let (_, again) = Journal::open(&path, &PLAN, 2, false).expect("opened");
            assert_eq!(again.len(), found.len() + 1);
            assert_eq!(again.last(), rows().last());
        }
        assert_eq!(most, 3);
    }

    #[test]
    fn no_changed_byte_of_a_record_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, bytes) = written(folder.path());
        for at in MAGIC.len() + 36..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            fs::write(&path, &changed).expect("a file");
            let (_, found) = Journal::open(&path, &PLAN, 2, false).expect("opened");
            assert!(found.len() < 3);
            assert_eq!(found, rows()[..found.len()], "{at}");
        }
    }

    /// As campaigns do that are started at the same instant: one has the journal, the others get an error that says so.
    #[test]
    fn of_several_that_make_a_journal_one_has_it() {
        for _ in 0..50 {
            let folder = tempfile::tempdir().expect("a folder");
            let path = folder.path().join("a.journal");
            let opened: Vec<_> = std::thread::scope(|scope| {
                let open = || Journal::open(&path, &PLAN, 2, false);
                let threads: Vec<_> = (0..4).map(|_| scope.spawn(open)).collect();
                threads.into_iter().map(|thread| thread.join().expect("it ends")).collect()
            });
            assert_eq!(opened.iter().filter(|opened| opened.is_ok()).count(), 1, "{opened:?}");
            for error in opened.iter().filter_map(|opened| opened.as_ref().err()) {
                assert!(matches!(error, CampaignError::Locked { .. }), "{error}");
            }
        }
    }

    #[test]
    fn a_journal_of_another_plan_or_in_use_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, _) = written(folder.path());
        let error = Journal::open(&path, &[8; 32], 2, false).expect_err("another plan");
        assert!(error.to_string().contains("discard it with --force"), "{error}");
        assert!(Journal::open(&path, &PLAN, 3, false).is_err());
        let (held, found) = Journal::open(&path, &PLAN, 2, false).expect("opened");
        assert_eq!(found.len(), 3);
        let error = Journal::open(&path, &PLAN, 2, true).expect_err("in use");
        assert!(matches!(error, CampaignError::Locked { .. }), "{error}");
        drop(held);
        let (_, found) = Journal::open(&path, &[8; 32], 2, true).expect("discarded");
        assert!(found.is_empty());
    }
}
