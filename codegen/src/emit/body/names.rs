//! Which statements of a function are needed, what their nodes are called, and how often each node
//! is an operand.

use std::collections::hash_map::Entry;

use rustc_hash::FxHashSet;

use super::Writer;
use crate::derivation::script::{Section, Statement};
use crate::graph::{Expr, Node, NodeId};

impl<'g> Writer<'_, 'g> {
    /// Names of the statements that outputs need; names and use counts of their nodes.
    pub(super) fn live(
        &mut self,
        sections: &[Section<'g>],
        outputs: &[String],
    ) -> FxHashSet<String> {
        let all: Vec<&Statement<'g>> = sections.iter().flat_map(|s| &s.statements).collect();
        let mut live: FxHashSet<String> = outputs.iter().cloned().collect();
        let mut nodes = FxHashSet::default();
        // Backwards: a statement comes before whatever uses the symbol it was cut at.
        for statement in all.iter().rev() {
            let symbol = statement.cut.map(Expr::id);
            let needed = live.contains(&statement.name)
                || symbol.is_some_and(|symbol| nodes.contains(&symbol));
            if needed {
                live.insert(statement.name.clone());
                self.collect(statement.value.id(), &mut nodes);
            }
        }
        let cut = all.iter().filter(|statement| statement.cut.is_some());
        let cut: FxHashSet<&String> = cut.map(|statement| &statement.name).collect();
        // A name without a user of its own still names a node that is computed.
        for statement in &all {
            let (id, name) = (statement.value.id(), &statement.name);
            if nodes.contains(&id) && !live.contains(name) && statement.cut.is_none() {
                live.insert(name.clone());
            }
            if live.contains(name) && self.compound(id) {
                // Of several names the first; but the proof knows the name of a cut.
                match self.names.entry(id) {
                    Entry::Vacant(entry) => _ = entry.insert(name.clone()),
                    Entry::Occupied(mut entry) => {
                        let plain = !outputs.contains(entry.get()) && !cut.contains(entry.get());
                        if plain && statement.cut.is_some() {
                            entry.insert(name.clone());
                        }
                    }
                }
            }
            // Signs move outwards, so what is used may be the opposite of what has the name.
            let opposite = match self.graph.node(id) {
                Node::Neg(inner) if !live.contains(name) => Some(inner),
                _ => None,
            };
            if let Some(inner) = opposite.filter(|inner| nodes.contains(inner)) {
                let new = self.compound(inner) && !self.names.contains_key(&inner);
                if new && self.names.insert(inner, format!("neg_{name}")).is_none() {
                    live.insert(name.clone());
                }
            }
        }
        self.count_uses(&nodes);
        live
    }

    pub(super) fn collect(&self, root: NodeId, nodes: &mut FxHashSet<NodeId>) {
        let mut pending = vec![root];
        while let Some(id) = pending.pop() {
            if nodes.insert(id) && (self.given)(id).is_none() {
                pending.extend(self.graph.node(id).operands());
            }
        }
    }

    /// A sign is no value of its own: the users of `-a` are users of `a`.
    fn count_uses(&mut self, nodes: &FxHashSet<NodeId>) {
        let mut descending: Vec<_> = nodes.iter().copied().collect();
        descending.sort_unstable_by(|a, b| b.cmp(a));
        for id in descending.into_iter().filter(|id| (self.given)(*id).is_none()) {
            let weight = match self.graph.node(id) {
                Node::Neg(_) if !self.names.contains_key(&id) => {
                    self.uses.get(&id).copied().unwrap_or(1)
                }
                _ => 1,
            };
            for operand in self.graph.node(id).operands() {
                *self.uses.entry(operand).or_default() += weight;
            }
        }
    }
}
