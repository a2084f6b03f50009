//! Which program has a lock on a file, and whether a file still has its name.

use std::fs::File;
use std::path::Path;

/// The program that has a lock on a file, as `process 1234 (precess)`; none where the system does not say.
#[cfg(target_os = "linux")]
pub(super) fn lock_holder(file: &File) -> Option<String> {
    use std::os::unix::fs::MetadataExt as _;
    let inode = file.metadata().ok()?.ino().to_string();
    let locks = std::fs::read_to_string("/proc/locks").ok()?;
    // `1: FLOCK  ADVISORY  WRITE 1234 08:01:131 0 EOF`: the process, then device and inode.
    let process = locks.lines().find_map(|line| {
        let mut fields = line.split_whitespace().skip_while(|field| *field != "FLOCK").skip(3);
        let (process, place) = (fields.next()?, fields.next()?);
        let is_it = place.rsplit(':').next() == Some(inode.as_str());
        is_it.then(|| process.parse::<u32>().ok()).flatten()
    })?;
    let name = std::fs::read_to_string(format!("/proc/{process}/comm")).unwrap_or_default();
    let name = name.trim();
    Some(if name.is_empty() {
        format!("process {process}")
    } else {
        format!("process {process} ({name})")
    })
}

/// The program that has a lock on a file: this system does not say.
#[cfg(not(target_os = "linux"))]
pub(super) fn lock_holder(_: &File) -> Option<String> {
    None
}

/// Whether an open file is the one that has a name.
#[cfg(unix)]
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let place = |of: &std::fs::Metadata| (of.dev(), of.ino());
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(open), Ok(named)) => place(&open) == place(&named),
        _ => false,
    }
}

/// Whether there is a file of a name: who renames it has the lock, and then there is none.
#[cfg(not(unix))]
pub(super) fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}
