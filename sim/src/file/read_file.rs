//! [`read_file`]: a TOML file of its own, such as a budget or a plan, by a function that takes its keys.

use std::cell::RefCell;
use std::path::Path;

use super::diagnostic::{Diagnostics, Numbers};
use super::keys::Keys;
use super::load::{Override, load_file};
use super::overrides::apply_with_prefix;

/// Reads a TOML file whose keys `read` takes, after overrides; they were written with a prefix, which was taken off.
///
/// # Errors
/// Everything that is wrong, with its places; `what` the file is not, where nothing else is.
pub(super) fn read_file<T>(
    path: &Path,
    what: &str,
    (prefix, overrides): (&str, &[Override]),
    read: impl FnOnce(&Keys<'_>) -> Option<T>,
) -> Result<T, Diagnostics> {
    let mut reports = Diagnostics::default();
    let mut node = load_file(path, &mut reports);
    apply_with_prefix(&mut node, (overrides, Numbers::WithUnits), prefix, &mut reports);
    if reports.has_errors() {
        return Err(reports);
    }
    let cell = RefCell::new(reports);
    let found = Keys::new(&node, "", &cell).and_then(|keys| read(&keys));
    let mut reports = cell.into_inner();
    match found {
        Some(found) if !reports.has_errors() => Ok(found),
        _ => {
            if !reports.has_errors() {
                reports.error_anywhere(format!("{} is no {what}", path.display()), "");
            }
            Err(reports)
        }
    }
}

/// The folder of a file, from which the files that it names are sought.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or_else(|| Path::new(""))
}
