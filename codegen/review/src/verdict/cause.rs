//! The causes that differences share: what mending each of them mends, by computation.

use super::entry::by_component;
use super::fault::{Fault, VerdictError};
use super::mend::mended;
use super::print::Print;
use precess_codegen::page::{Block, CausePage, Class, Mend, PageError, numbers};
use precess_codegen::proof::Comparison;

/// A cause that differences share.
#[derive(Clone, Debug)]
pub struct Cause {
    /// Its letter.
    pub letter: char,
    /// What it is.
    pub title: String,
    /// What it does to the print, in one line of Markdown.
    pub in_short: String,
    /// The paragraphs of its page, without the mends.
    pub prose: Vec<String>,
    /// What each mend does, in the page's order.
    pub mended: Vec<Mended>,
    /// Tags of the blocks with a note that names it, in the paper's order.
    pub entries: Vec<String>,
    /// Line of the heading.
    pub line: usize,
}

/// What one mend does to one printed block.
#[derive(Clone, Debug)]
pub struct Mended {
    /// Tag of the printed block.
    pub tag: String,
    /// Its name.
    pub name: String,
    /// Terms of printed less right: as printed,
    pub before: usize,
    /// with this mend only,
    pub alone: usize,
    /// with this one and all before it on the page,
    pub so_far: usize,
    /// with all.
    pub all: usize,
    /// Line of the mend.
    pub line: usize,
}

impl Cause {
    /// With the effects of its mends.
    pub(super) fn new(cause: &CausePage, blocks: &[Block], effects: &[Mended]) -> Self {
        let effect = |mend: &Mend| effects.iter().find(|effect| effect.line == mend.line).cloned();
        Self {
            letter: cause.letter,
            title: cause.title.clone(),
            in_short: cause.in_short.clone(),
            prose: cause.prose.clone(),
            mended: cause.mends.iter().filter_map(effect).collect(),
            entries: naming(blocks, cause.letter),
            line: cause.line,
        }
    }
}

/// A printed block and its mends.
pub(super) struct Mends<'p> {
    block: &'p Block,
    steps: Vec<Step<'p>>,
}

/// The text of a block with one mend only, and with all up to it.
struct Step<'p> {
    mend: &'p Mend,
    alone: String,
    so_far: String,
}

/// The mends of every printed block that has some, put into its text.
///
/// # Errors
/// When notes, causes and mends do not fit together: every term has its cause, every cause its
/// notes, each pair of cause and block a mend, and every mend its piece of text.
pub(super) fn fitting<'p>(
    blocks: &'p [Block],
    causes: &'p [CausePage],
) -> Result<Vec<Mends<'p>>, VerdictError> {
    notes_have_causes(blocks, causes)?;
    causes_have_notes(blocks, causes)?;
    let mut made = Vec::new();
    for block in blocks {
        let mut steps: Vec<Step<'_>> = Vec::new();
        for cause in causes {
            for mend in cause.mends.iter().filter(|mend| is_of(mend, block)) {
                let place =
                    |fault| VerdictError { page: cause.page.clone(), line: mend.line, fault };
                let before = steps.last().map_or(&block.body, |step| &step.so_far);
                let so_far = mended(before, &mend.changes).map_err(place)?;
                let alone = mended(&block.body, &mend.changes).map_err(place)?;
                steps.push(Step { mend, alone, so_far });
            }
        }
        if !steps.is_empty() {
            made.push(Mends { block, steps });
        }
    }
    Ok(made)
}

/// What each mend mends, and one row for each block: all its mends together leave what is torn and
/// nothing else.
pub(super) fn effects(
    print: &mut Print<'_>,
    mends: &[Mends<'_>],
) -> Result<(Vec<Mended>, Vec<Comparison>), PageError> {
    let (mut effects, mut rows) = (Vec::new(), Vec::new());
    for Mends { block, steps } in mends {
        let Some(last) = steps.last() else { continue };
        let before = differing(print, block, &block.body)?;
        let all = differing(print, block, &last.so_far)?;
        for Step { mend, alone, so_far } in steps {
            effects.push(Mended {
                tag: mend.tag.clone(),
                name: mend.name.clone(),
                before,
                alone: differing(print, block, alone)?,
                so_far: differing(print, block, so_far)?,
                all,
                line: mend.line,
            });
        }
        rows.push(print.against_torn(block, &last.so_far)?);
    }
    Ok((effects, rows))
}

/// How many terms printed and right differ in, a mirror image not counted.
fn differing(print: &mut Print<'_>, block: &Block, body: &str) -> Result<usize, PageError> {
    let components = by_component(&block.name, print.difference(block, body)?);
    Ok(components.iter().map(|component| component.terms.len()).sum())
}

/// Tags of the blocks with a note that names a cause.
fn naming(blocks: &[Block], letter: char) -> Vec<String> {
    let named = blocks.iter().filter(|block| names(block, letter));
    let mut tags: Vec<_> = named.map(|block| block.tag.clone()).collect();
    tags.sort_by_key(|tag| numbers(tag));
    tags.dedup();
    tags
}

fn names(block: &Block, letter: char) -> bool {
    block.notes.iter().any(|note| note.causes.contains(&letter))
}

fn is_of(mend: &Mend, block: &Block) -> bool {
    mend.tag == block.tag && mend.name == block.name
}

fn notes_have_causes(blocks: &[Block], causes: &[CausePage]) -> Result<(), VerdictError> {
    for block in blocks {
        for note in &block.notes {
            let fault = |fault| Err(VerdictError::on(block, note.line, fault));
            let term = note.changes_value() && note.class != Class::Unreadable;
            if term && note.causes.is_empty() {
                return fault(Fault::NoCause);
            }
            for letter in &note.causes {
                let Some(cause) = causes.iter().find(|cause| cause.letter == *letter) else {
                    return fault(Fault::UnknownCause(*letter));
                };
                if term && !cause.mends.iter().any(|mend| is_of(mend, block)) {
                    return fault(Fault::NoMend(*letter));
                }
            }
        }
    }
    Ok(())
}

fn causes_have_notes(blocks: &[Block], causes: &[CausePage]) -> Result<(), VerdictError> {
    for cause in causes {
        let fault = |line, fault| Err(VerdictError { page: cause.page.clone(), line, fault });
        if naming(blocks, cause.letter).is_empty() {
            return fault(cause.line, Fault::UnusedCause(cause.letter));
        }
        for mend in &cause.mends {
            let name = format!("{} {}", mend.tag, mend.name);
            let Some(block) = blocks.iter().find(|block| is_of(mend, block)) else {
                return fault(mend.line, Fault::NoTarget(name));
            };
            if !names(block, cause.letter) {
                return fault(mend.line, Fault::NoNote(cause.letter, name));
            }
        }
    }
    Ok(())
}
