//! What a printed slip does to Table 1: drift of energy and momenta over one second when the
//! printed form is in the assembled system.
//!
//! - [`table1`]: the scenario as data;
//! - `assembled`: the paper's nine equations from the hand-checked pages, with the slip in them;
//! - `system`, `tape`, `elimination`: their accelerations in numbers;
//! - `state`, `run`, `ledger`: the run, and what it should conserve.
//!
//! The right system drifts too, by rounding and by the integrator's error: [`floor`] says how far.

mod assembled;
mod effect;
mod elimination;
mod error;
mod ledger;
mod run;
mod state;
mod system;
pub mod table1;
mod tape;
#[cfg(test)]
mod tests;

pub use effect::{Drift, Effect, RESOLUTION, Slip};
pub use error::ConsequenceError;
pub use run::{DURATION, STEP};

use assembled::{Equations, Pages, equal};
use ledger::Accountant;
use run::{STEPS, run};
use system::at_table_1;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::normal::Ring;
use precess_codegen::page::{Block, Note, Page, Value, blocks};

/// What one printed block does.
#[derive(Clone, Debug, PartialEq)]
pub struct Consequence {
    /// The printed block's tag: `(14)`, `(53 first line)`.
    pub tag: String,
    /// The quantity in code.
    pub name: String,
    /// The printed page.
    pub page: String,
    /// Line of the block's fence, from one.
    pub line: usize,
    /// What it does.
    pub effect: Effect,
}

/// The consequence of every printed block that differs in value, in the order of the pages. Words,
/// definitions and what holds in a special case have none.
///
/// # Errors
/// When a page cannot be read, or the assembled system is not on the pages.
pub fn consequences(
    pages: &[Page],
    printed: &[Page],
) -> Result<Vec<Consequence>, ConsequenceError> {
    let graph = Graph::new();
    let mut bench = Bench::new(&graph, pages)?;
    let mut found = Vec::new();
    for block in differing(printed)? {
        let slipped = bench.pages.printed(&block)?;
        let effect = bench.effect(&[(block.name.as_str(), slipped)])?;
        let Block { tag, name, page, line, .. } = block;
        found.push(Consequence { tag, name, page, line, effect });
    }
    Ok(found)
}

/// What each set of slips does, made together in a system that is right otherwise.
///
/// # Errors
/// When a page or a note cannot be read, or the assembled system is not on the pages.
pub fn effects(pages: &[Page], sets: &[Vec<Slip<'_>>]) -> Result<Vec<Effect>, ConsequenceError> {
    let graph = Graph::new();
    let mut bench = Bench::new(&graph, pages)?;
    let mut found = Vec::new();
    for set in sets {
        let mut values = Vec::new();
        for slip in set {
            values.push((slip.block.name.as_str(), bench.pages.with_notes(slip)?));
        }
        found.push(bench.effect(&values)?);
    }
    Ok(found)
}

/// The drift of the right system over the same run: what the figures are compared with.
///
/// # Errors
/// When a page cannot be read, or the assembled system is not on the pages or does not run.
pub fn floor(pages: &[Page]) -> Result<Drift, ConsequenceError> {
    let graph = Graph::new();
    let mut bench = Bench::new(&graph, pages)?;
    match run(&graph, &mut bench.accountant, &bench.right, STEPS)? {
        Effect::Drift(drift) => Ok(drift),
        effect => Err(ConsequenceError::Right(effect)),
    }
}

/// The right system, and what others are held against it with.
struct Bench<'g> {
    graph: &'g Graph,
    accountant: Accountant,
    pages: Pages<'g>,
    right: Equations<'g>,
    right_at_table_1: Equations<'g>,
    ring: Ring<'g>,
}

impl<'g> Bench<'g> {
    fn new(graph: &'g Graph, pages: &[Page]) -> Result<Self, ConsequenceError> {
        let accountant = Accountant::new(&Chain::new(graph, &DGVSCMG))?;
        let pages = Pages::read(graph, pages)?;
        let right = pages.assembled(&[])?;
        let right_at_table_1 = at_table_1(&right);
        Ok(Self { graph, accountant, pages, right, right_at_table_1, ring: Ring::new(graph) })
    }

    /// What the system does in which names have these values.
    fn effect(&mut self, values: &[(&str, Value<'g>)]) -> Result<Effect, ConsequenceError> {
        // What agrees is no slip, in whatever words.
        let (pages, ring) = (&self.pages, &mut self.ring);
        let mut slips = values.to_vec();
        slips.retain(|(name, value)| !pages.agrees(ring, name, *value));
        let equations = self.pages.assembled(&slips)?;
        if equations == self.right {
            return Ok(Effect::Unchanged);
        }
        if equal(&mut self.ring, &at_table_1(&equations), &self.right_at_table_1) {
            return Ok(Effect::Vanishes);
        }
        run(self.graph, &mut self.accountant, &equations, STEPS)
    }
}

/// The printed blocks of which a note names a term; a special case is not part of the system.
fn differing(printed: &[Page]) -> Result<Vec<Block>, ConsequenceError> {
    let mut found = Vec::new();
    for page in printed {
        found.extend(blocks(&page.name, &page.text, "printed")?);
    }
    found.retain(|block| {
        let differs = block.notes.iter().any(Note::changes_value);
        differs && !block.is_words() && block.given.is_empty()
    });
    Ok(found)
}
