//! How many equations agree, differ, and are lost: the figures of the errata and of the letter.

use std::collections::BTreeSet;

use serde::Serialize;

use super::{Entry, Printed, Verdicts};
use precess_codegen::page::{Class, Note};

/// Counts of the numbered equations, unless something else is said. Each is in one of `agree`,
/// `definitions`, `differing` and `lost`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// All of them.
    pub numbered: usize,
    /// The first and the last number.
    pub range: [u16; 2],
    /// Equal as printed.
    pub agree: usize,
    /// Definitions: nothing to compare.
    pub definitions: usize,
    /// Different as read.
    pub differing: usize,
    /// Of those, the ones that differ in a way that is, or may be, the paper's,
    pub papers: usize,
    /// and the ones in which a loss of the copy explains everything.
    pub copys: usize,
    /// Equalities without a number, asserted by the text, that differ.
    pub asserted: usize,
    /// Tags of the equations that are lost altogether, and so not counted as different.
    pub lost: Vec<String>,
    /// Tags of the definitions that the paper contradicts, not counted as different.
    pub contradicted: Vec<String>,
    /// Terms and left sides that differ by a slip.
    pub slips: usize,
    /// Tags of the equations with differences that are undecided.
    pub open: Vec<String>,
}

impl Counts {
    /// Counts the entries.
    pub(super) fn of_entries(entries: &[Entry]) -> Self {
        let numbered: Vec<_> = entries.iter().filter(|entry| entry.number.is_some()).collect();
        let count = |holds: fn(&Entry) -> bool| numbered.iter().filter(|e| holds(e)).count();
        let tags = |holds: fn(&Entry) -> bool| {
            numbered.iter().filter(|e| holds(e)).map(|e| e.tag.clone()).collect()
        };
        let agree = count(|e| e.printed == Printed::Agrees);
        let definitions = count(|e| e.printed == Printed::Definition);
        let numbers = || numbered.iter().filter_map(|entry| entry.number);
        Self {
            numbered: numbered.len(),
            range: [numbers().min(), numbers().max()].map(Option::unwrap_or_default),
            agree,
            definitions,
            differing: count(Entry::differs),
            papers: count(Entry::is_papers),
            copys: count(|e| e.differs() && !e.is_papers()),
            asserted: entries.iter().filter(|e| e.number.is_none() && e.differs()).count(),
            lost: tags(Entry::is_lost),
            contradicted: tags(Entry::is_contradicted),
            slips: notes(entries, |note| note.class == Class::Slip),
            open: tags(|e| e.notes().any(|note| note.class == Class::Undecided)),
        }
    }
}

/// Differences that are chosen, each once, although several numbers may share its block.
fn notes(entries: &[Entry], chosen: impl Fn(&Note) -> bool) -> usize {
    let forms = entries.iter().flat_map(|entry| &entry.forms);
    let differences = forms.flat_map(|form| {
        let notes = form
            .block
            .notes
            .iter()
            .filter(|note| (note.changes_value() || note.changes_left_side()) && chosen(note));
        notes.map(|note| (&form.block.page, note.line))
    });
    differences.collect::<BTreeSet<_>>().len()
}

impl Verdicts {
    /// How many equations agree, differ, and are lost.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts::of_entries(&self.entries)
    }

    /// How many differences that are slips have this cause.
    #[must_use]
    pub fn slips_of(&self, letter: char) -> usize {
        notes(&self.entries, |note| note.class == Class::Slip && note.causes.contains(&letter))
    }
}
