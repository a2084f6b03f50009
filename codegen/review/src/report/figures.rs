//! What the slips of an equation, and the differences of a cause, do to Table 1.

use std::collections::BTreeMap;
use std::thread::scope;

use crate::consequence::{
    Consequence, ConsequenceError, Drift, Effect, Slip, consequences, effects, floor,
};
use crate::verdict::{Entry, Form, Verdicts};
use precess_codegen::page::{Class, Note, Page};
use precess_codegen::threads::joined;

/// Every figure of the errata.
pub(super) struct Figures {
    /// The drift of the right system.
    pub(super) floor: Drift,
    /// Of each printed block as it is read.
    pub(super) forms: Vec<Consequence>,
    entries: BTreeMap<String, Effect>,
    causes: BTreeMap<char, Effect>,
}

impl Figures {
    /// Runs every form, every equation's slips and every cause.
    pub(super) fn of_pages(
        pages: &[Page],
        printed: &[Page],
        verdicts: &Verdicts,
    ) -> Result<Self, ConsequenceError> {
        let slips = |note: &Note| matches!(note.class, Class::Slip | Class::Undecided);
        let by_entry = verdicts.entries.iter().map(|entry| {
            let forms = entry.forms.iter();
            (entry.tag.clone(), forms.filter_map(|form| slip(form, slips)).collect::<Vec<_>>())
        });
        let (tags, by_entry) = runs(by_entry);
        let by_cause = verdicts.causes.iter().map(|cause| {
            let of_cause = |note: &Note| {
                note.class != Class::Unreadable && note.causes.contains(&cause.letter)
            };
            let forms = once(&verdicts.entries);
            (cause.letter, forms.filter_map(|form| slip(form, of_cause)).collect::<Vec<_>>())
        });
        let (letters, by_cause) = runs(by_cause);

        let (entries, causes, forms, floor) = scope(|threads| {
            let of_entries = threads.spawn(|| effects(pages, &by_entry));
            let of_causes = threads.spawn(|| effects(pages, &by_cause));
            let of_forms = threads.spawn(|| consequences(pages, printed));
            let floor = floor(pages);
            (joined(of_entries), joined(of_causes), joined(of_forms), floor)
        });
        let entries = tags.into_iter().zip(entries?).collect();
        let causes = letters.into_iter().zip(causes?).collect();
        Ok(Self { floor: floor?, forms: forms?, entries, causes })
    }

    /// What the slips of an entry do; nothing where it has none of value, or holds in a special
    /// case.
    pub(super) fn of_entry(&self, tag: &str) -> Option<Effect> {
        self.entries.get(tag).copied()
    }

    /// What all differences of a cause do together; nothing where none has a value.
    pub(super) fn of_cause(&self, letter: char) -> Option<Effect> {
        self.causes.get(&letter).copied()
    }
}

/// What is to be run, beside what it is run for.
fn runs<'a, K>(sets: impl Iterator<Item = (K, Vec<Slip<'a>>)>) -> (Vec<K>, Vec<Vec<Slip<'a>>>) {
    sets.filter(|(_, set)| !set.is_empty()).unzip()
}

/// The notes of a form that are chosen and change a value.
fn slip(form: &Form, chosen: impl Fn(&Note) -> bool) -> Option<Slip<'_>> {
    let own = |note: &&Note| {
        let place = note.place.as_ref();
        form.entries.is_empty() || place.is_none_or(|place| form.entries.contains(place))
    };
    let notes = form.block.notes.iter().filter(own);
    let notes: Vec<_> = notes.filter(|note| note.changes_value() && chosen(note)).collect();
    (!notes.is_empty() && form.block.given.is_empty()).then_some(Slip { block: &form.block, notes })
}

/// Every form once, although several numbers may share a block.
fn once(entries: &[Entry]) -> impl Iterator<Item = &Form> {
    let mut seen: Vec<(String, Vec<String>)> = Vec::new();
    entries.iter().flat_map(|entry| &entry.forms).filter(move |form| {
        let place = (form.block.place(), form.entries.clone());
        let new = !seen.contains(&place);
        seen.push(place);
        new
    })
}
