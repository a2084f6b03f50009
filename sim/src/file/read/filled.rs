//! [`from_filled`]: the text of a scenario that is complete, as a scenario is written.
//!
//! A program that reads no other has no analysis of vibration in it, by which the state of a settled start is found.

use std::path::Path;

use super::devices::initial::whole;
use super::{Read, with_completion};
use crate::file::diagnostic::{Diagnostics, Numbers};
use crate::file::document::Node;
use crate::file::keys::{Keys, Reports};
use crate::file::load::load_text;
use crate::scenario::Scenario;

/// Reads the text of [`to_toml`](crate::file::to_toml), in which every default is written out and the initial state is complete.
///
/// # Errors
/// As [`from_toml`](crate::file::from_toml); where the initial state is to be completed.
pub fn from_filled(name: &str, text: &str) -> Read {
    let folder = Path::new("");
    let mut reports = Diagnostics::default();
    let node = load_text(name, (text, Numbers::WithUnits), folder, &mut reports);
    with_completion(node, (name, name, folder), (&[], Numbers::Si), reports, refuse)
}

/// Reports an initial state that is to be completed.
fn refuse(node: &Node, _: &mut Scenario, reports: &Reports) {
    let Some(keys) = Keys::new(node, "", reports) else { return };
    let whole = whole(&keys);
    let Some(initial) = keys.table("initial") else { return };
    for (key, is_written) in [("state_of", whole.of_centre), ("settled", whole.settled)] {
        if is_written {
            initial.error(key, "the initial state is not complete", "give the state of B at 0 s");
        }
    }
}
