//! Headings, printed blocks and hand-checked blocks, sorted into one entry per number.

use std::collections::BTreeSet;

use super::entry::{Component, Entry, Form, HandChecked, Printed};
use super::fault::{Fault, VerdictError};
use precess_codegen::page::{Block, Class, Note, Number, Section, Subject, numbers};
use precess_codegen::proof::Comparison;

/// The numbers of the paper that state something.
const NUMBERS: std::ops::RangeInclusive<u16> = 6..=125;

/// A hand-checked block and how it was proven.
pub(super) struct Stated {
    pub(super) block: Block,
    pub(super) row: Comparison,
}

/// A printed block and what differs in it.
pub(super) struct Judged<'b> {
    pub(super) block: &'b Block,
    pub(super) components: Vec<Component>,
}

/// The headings in the paper's order: one for every number, each with its printed block and, where
/// that states something, its hand-checked one.
pub(super) fn in_order(
    mut sections: Vec<Section>,
    printed: &[Block],
    derived: &[&Block],
) -> Result<Vec<Section>, VerdictError> {
    sections.sort_by_key(|section| section.number);
    complete(&sections)?;
    let numbered = |block: &Block, number| numbers(&block.tag).contains(&number);
    for section in &sections {
        let here: Vec<_> = printed.iter().filter(|block| numbered(block, section.number)).collect();
        if here.is_empty() {
            return Err(at(section, Fault::NoBlock(section.tag.clone())));
        }
        let is_derived = derived.iter().any(|block| numbered(block, section.number));
        if !is_derived && here.into_iter().any(states) {
            return Err(at(section, Fault::NotDerived(section.tag.clone())));
        }
    }
    let headed = |block: &&Block| sections.iter().any(|section| numbered(block, section.number));
    match printed.iter().find(|block| !headed(block)) {
        Some(block) => Err(VerdictError::on(block, block.line, Fault::NoEntry(block.tag.clone()))),
        None => Ok(sections),
    }
}

/// Whether a printed block states something that can be derived, or did before it was lost.
fn states(block: &Block) -> bool {
    !block.is_words() || block.notes.iter().any(|note| note.class == Class::Unreadable)
}

fn complete(sections: &[Section]) -> Result<(), VerdictError> {
    for pair in sections.windows(2) {
        if pair[0].number == pair[1].number {
            return Err(at(&pair[1], Fault::Twice(pair[1].tag.clone())));
        }
    }
    for number in NUMBERS {
        let wanted = Number { number, numbered: true };
        let next = sections.iter().find(|section| section.number >= wanted);
        if next.is_none_or(|next| next.number != wanted) {
            let (page, line) = next
                .or(sections.last())
                .map_or_else(Default::default, |near| (near.page.clone(), near.line));
            return Err(VerdictError { page, line, fault: Fault::Missing(number) });
        }
    }
    Ok(())
}

fn at(section: &Section, fault: Fault) -> VerdictError {
    VerdictError { page: section.page.clone(), line: section.line, fault }
}

/// One entry per heading.
pub(super) fn entries(
    sections: Vec<Section>,
    judged: &[Judged<'_>],
    stated: &[Stated],
) -> Result<Vec<Entry>, VerdictError> {
    sections.into_iter().map(|section| entry(section, judged, stated)).collect()
}

fn entry(
    section: Section,
    judged: &[Judged<'_>],
    stated: &[Stated],
) -> Result<Entry, VerdictError> {
    let here = judged.iter().filter(|judged| numbers(&judged.block.tag).contains(&section.number));
    let forms: Vec<_> = here.map(|judged| form(&section, judged, stated)).collect();
    let printed = printed(&section, &forms)?;
    Ok(Entry {
        number: section.number.numbered.then_some(section.number.number),
        tag: section.tag,
        title: section.title,
        in_short: section.in_short,
        hand_checked: hand_checked(section.number, stated),
        printed,
        forms,
    })
}

/// The block as far as it is this entry's.
fn form(section: &Section, judged: &Judged<'_>, stated: &[Stated]) -> Form {
    let own = |label: &str| {
        section.entries.is_empty() || section.entries.iter().any(|entry| entry == label)
    };
    let mut block = judged.block.clone();
    block.notes.retain(|note| note.place.as_deref().is_none_or(own));
    let components =
        judged.components.iter().filter(|component| own(&component.label)).cloned().collect();
    let same_name = || stated.iter().map(|s| &s.block).filter(|right| right.name == block.name);
    let same_number = |right: &&Block| numbers(&right.tag).contains(&section.number);
    let plain = |right: &&Block| right.given.is_empty();
    let right = same_name().find(same_number).or_else(|| same_name().find(plain)).cloned();
    Form { block, right, entries: section.entries.clone(), components }
}

fn hand_checked(number: Number, stated: &[Stated]) -> HandChecked {
    let here = stated.iter().filter(|stated| numbers(&stated.block.tag).contains(&number));
    let (mut blocks, mut failed) = (Vec::new(), Vec::new());
    for stated in here {
        blocks.push(stated.block.clone());
        failed.extend(Some(&stated.row).filter(|row| !row.holds()).cloned());
    }
    match (blocks.is_empty(), failed.is_empty()) {
        (true, _) => HandChecked::Definition,
        (false, true) => HandChecked::Proven(blocks),
        (false, false) => HandChecked::Differs(blocks, failed),
    }
}

fn printed(section: &Section, forms: &[Form]) -> Result<Printed, VerdictError> {
    let wrong = |fault: fn(String) -> Fault| Err(at(section, fault(section.tag.clone())));
    let notes = || forms.iter().flat_map(|form| &form.block.notes);
    let components: Vec<_> = forms.iter().flat_map(|form| form.components.clone()).collect();
    let is = |class: Class| move |note: &&Note| note.class == class;
    if forms.iter().all(|form| form.block.is_words()) {
        return match (notes().find(is(Class::Unreadable)), notes().find(is(Class::Definition))) {
            (Some(note), _) => Ok(unreadable(note, components)),
            (None, Some(_)) => Ok(Printed::Definition),
            (None, None) => wrong(Fault::Unclassified),
        };
    }
    for form in forms.iter().filter(|form| !form.components.is_empty()) {
        if let Some(note) = form.block.notes.iter().find(is(Class::Agrees)) {
            let terms = form.components.iter().map(|component| component.terms.len()).sum();
            return Err(VerdictError::on(&form.block, note.line, Fault::SaidToAgree(terms)));
        }
    }
    let differing = differing(forms);
    if differing.iter().any(|note| note.changes_value()) && components.is_empty() {
        return wrong(Fault::NoDifference);
    }
    let classes: BTreeSet<_> = differing.iter().map(|note| note.class).collect();
    let causes: BTreeSet<_> = differing.iter().flat_map(|note| note.causes.clone()).collect();
    match classes.into_iter().collect::<Vec<_>>()[..] {
        [] if notes().any(|note| note.class == Class::Agrees) => Ok(Printed::Agrees),
        [] => wrong(Fault::Unclassified),
        [Class::Unreadable] => Ok(unreadable(differing[0], components)),
        ref classes => Ok(Printed::Differs {
            components,
            classes: classes.to_vec(),
            causes: causes.into_iter().collect(),
        }),
    }
}

/// The notes that make a difference: to a value or a left side, or else, where none says that the
/// equation agrees, by the marks that had to be read.
fn differing(forms: &[Form]) -> Vec<&Note> {
    let notes: Vec<_> = forms.iter().flat_map(|form| &form.block.notes).collect();
    let those = |makes: fn(&Note) -> bool| notes.iter().copied().filter(move |note| makes(note));
    let found: Vec<_> = those(|note| note.changes_value() || note.changes_left_side()).collect();
    if found.is_empty() && those(|note| note.class == Class::Agrees).next().is_none() {
        return those(|note| note.subject == Subject::Reading).collect();
    }
    found
}

fn unreadable(note: &Note, components: Vec<Component>) -> Printed {
    let [best, tried] = [&note.best, &note.tried].map(|text| text.clone().unwrap_or_default());
    Printed::Unreadable { components, best, tried }
}
