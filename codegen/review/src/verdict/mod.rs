//! The three-way verdict on every equation of the paper, (6) to (125): derivation against the
//! hand-checked pages, print against the hand-checked pages, and why they differ where they do.
//!
//! Nothing here is typed in: the differing terms are computed, the notes of the printed pages must
//! add up to them, and mending a cause is done on the printed text and counted.

mod cause;
mod counts;
mod entry;
mod fault;
mod mend;
mod print;
mod sorted;

pub use cause::{Cause, Mended};
pub use counts::Counts;
pub use entry::{Component, Entry, Form, HandChecked, Printed};
pub use fault::{Fault, JudgementError, VerdictError};

use cause::{effects, fitting};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::quantities::quantities;
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::normal::Ring;
use precess_codegen::page::{
    Block, CausePage, Page, PageError, Section, blocks, causes, read_on, sections,
};
use precess_codegen::proof::{Comparison, against_block};
use print::Print;
use sorted::{Judged, Stated, entries, in_order};

/// The page of causes among the printed ones.
pub const CAUSES: &str = "causes.md";

/// Everything that is said of the print.
#[derive(Clone, Debug, Default)]
pub struct Verdicts {
    /// Every number and every asserted equality, in the paper's order.
    pub entries: Vec<Entry>,
    /// The causes, in the order of their page.
    pub causes: Vec<Cause>,
    /// What must hold of notes and mends.
    pub rows: Vec<Comparison>,
}

impl Verdicts {
    /// How many numbered equations each label has, the commonest first.
    #[must_use]
    pub fn tally(&self) -> Vec<(String, usize)> {
        let mut counts: Vec<(String, usize)> = Vec::new();
        for entry in self.entries.iter().filter(|entry| entry.number.is_some()) {
            let label = entry.printed.label();
            match counts.iter_mut().find(|(known, _)| *known == label) {
                Some((_, count)) => *count += 1,
                None => counts.push((label, 1)),
            }
        }
        counts.sort_by(|(a, m), (b, n)| n.cmp(m).then_with(|| a.cmp(b)));
        counts
    }

    /// The cause of a letter.
    #[must_use]
    pub fn cause(&self, letter: char) -> Option<&Cause> {
        self.causes.iter().find(|cause| cause.letter == letter)
    }
}

/// Judges the print by the hand-checked pages.
///
/// # Errors
/// When a page cannot be read, a number lacks its entry, or notes and causes do not fit together.
/// A note that does not add up and a mend that leaves a term are no errors but rows.
pub fn verdicts(pages: &[Page], printed: &[Page]) -> Result<Verdicts, JudgementError> {
    let print = Pages::read(printed)?;
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let (equations, reader) = read_on(&graph, pages)?;
    let derived: Vec<_> = equations.iter().map(|equation| &equation.block).collect();
    let sections = in_order(print.sections, &print.blocks, &derived)?;
    let mends = fitting(&print.blocks, &print.causes)?;

    let (mut ring, list) = (Ring::new(&graph), quantities(&chain));
    let stated = equations.into_iter().map(|equation| {
        let row = against_block(&mut ring, &chain, &list, &equation);
        Stated { block: equation.block, row }
    });
    let stated: Vec<_> = stated.collect();
    let mut against = Print::new(&graph, reader);
    let (mut judged, mut rows) = (Vec::new(), Vec::new());
    for block in &print.blocks {
        let mut terms = Vec::new();
        if !block.is_words() {
            terms = against.difference(block, &block.body)?;
            rows.push(against.against_notes(block)?);
        }
        judged.push(Judged { block, components: entry::by_component(&block.name, terms) });
    }
    let (effects, mended) = effects(&mut against, &mends)?;
    rows.extend(mended);
    let causes = print.causes.iter().map(|cause| Cause::new(cause, &print.blocks, &effects));
    let entries = entries(sections, &judged, &stated)?;
    Ok(Verdicts { entries, causes: causes.collect(), rows })
}

/// What the printed pages hold.
struct Pages {
    sections: Vec<Section>,
    blocks: Vec<Block>,
    causes: Vec<CausePage>,
}

impl Pages {
    fn read(printed: &[Page]) -> Result<Self, PageError> {
        let mut read = Self { sections: Vec::new(), blocks: Vec::new(), causes: Vec::new() };
        for page in printed {
            if page.name == CAUSES {
                read.causes.extend(causes(page)?);
            } else {
                read.sections.extend(sections(page)?);
                read.blocks.extend(blocks(&page.name, &page.text, "printed")?);
            }
        }
        Ok(read)
    }
}
