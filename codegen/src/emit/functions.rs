//! What is emitted of a chain: its kernels and `prepare`, after all passes.

use rustc_hash::FxHashMap;

use super::factor::factored;
use super::prepare::{Prepared, prepared};
use crate::derivation::chain::Chain;
use crate::graph::{Graph, Stage};
use crate::kernel::{Kernel, kernels, parameters_of};

/// The functions of a kind.
pub struct Functions<'g> {
    /// What depends on parameters only.
    pub prepared: Prepared<'g>,
    /// All others, in the order of the emitted file.
    pub kernels: Vec<Kernel<'g>>,
}

/// The functions of the chain's kind.
#[must_use]
pub fn functions<'g>(chain: &Chain<'g>) -> Functions<'g> {
    of_kernels(chain, kernels(chain))
}

/// Some of them, and what `prepare` computes for these.
pub(super) fn of_kernels<'g>(chain: &Chain<'g>, mut kernels: Vec<Kernel<'g>>) -> Functions<'g> {
    let (graph, raw) = (chain.graph, parameters_of(chain));
    if chain.passes.factor {
        for kernel in &mut kernels {
            let sections = std::mem::take(&mut kernel.sections);
            kernel.sections = factored(graph, sections, &kernel.output.sources(), kernel.hoisted);
        }
    }
    let mut prepared = prepared(graph, &kernels, &raw);
    if chain.passes.factor {
        let sections = std::mem::take(&mut prepared.sections);
        prepared.sections = factored(graph, sections, &prepared.computed(&raw), false);
    }
    prepared.merge();
    Functions { prepared, kernels }
}

impl<'g> Functions<'g> {
    /// The same with what `prepare` computes put where the others read it: they share its nodes.
    #[must_use]
    pub fn joined(mut self, graph: &'g Graph) -> Self {
        let computed = self.prepared.sections.iter().flat_map(|section| &section.statements);
        let computed: FxHashMap<_, _> = computed.map(|s| (s.name.clone(), s.value)).collect();
        for kernel in &mut self.kernels {
            let sections = kernel.sections.iter_mut();
            for statement in sections.flat_map(|section| &mut section.statements) {
                let own = statement.value.stage() > Stage::Parameter;
                let known = computed.get(&statement.name).filter(|_| !own);
                statement.value = known
                    .copied()
                    .unwrap_or_else(|| self.prepared.read(graph, statement.value, &computed));
            }
        }
        self
    }
}
