//! What the emitted elimination returns with every joint's mode settled: its torque is given, or its
//! acceleration.
//!
//! A mode is three numbers of which two say only which it is: one and zero, or zero and one. With
//! those put in, one text is as many eliminations as there are combinations.

use std::cmp::Ordering;

use rustc_hash::FxHashMap;

use super::read_back::Reading;
use super::stages;
use super::unknowns::{HUB, Unknowns};
use crate::graph::{Expr, Node, NodeId, SymbolId};

/// The name of what a joint divides by.
pub(super) fn divisor(tag: &str) -> String {
    format!("divisor_{tag}")
}

/// One combination of modes and the outputs for it.
pub(super) struct Settled<'a, 'g> {
    unknowns: &'a Unknowns<'g>,
    back: &'a Reading<'g>,
    /// Joints whose torque is given.
    pub(super) driven: Vec<usize>,
    /// Joints whose acceleration is given.
    pub(super) given: Vec<usize>,
    /// What every node is with the modes put in.
    made: FxHashMap<NodeId, Expr<'g>>,
}

/// Every combination of modes, all joints driven first.
pub(super) fn every<'a, 'g>(
    unknowns: &'a Unknowns<'g>,
    back: &'a Reading<'g>,
) -> impl Iterator<Item = Settled<'a, 'g>> {
    let joints: Vec<_> = unknowns.solved().into_iter().skip(HUB.len()).collect();
    (0..1_usize << joints.len()).map(move |combination| {
        let is_given = |place: usize| combination >> place & 1 == 1;
        let (given, driven): (Vec<_>, Vec<_>) =
            joints.iter().enumerate().partition(|(place, _)| is_given(*place));
        let [driven, given] =
            [driven, given].map(|list| list.into_iter().map(|(_, joint)| *joint).collect());
        Settled::new(unknowns, back, driven, given)
    })
}

impl<'a, 'g> Settled<'a, 'g> {
    fn new(
        unknowns: &'a Unknowns<'g>,
        back: &'a Reading<'g>,
        driven: Vec<usize>,
        given: Vec<usize>,
    ) -> Self {
        let graph = unknowns.zero.graph();
        let (zero, one) = (unknowns.zero, graph.constant(1));
        let mut values = FxHashMap::default();
        let mut put = |name: String, value: Expr<'g>| {
            if let Some(Node::Symbol(symbol)) = graph.find(&name).map(Expr::node) {
                values.insert(symbol, value);
            }
        };
        for &j in &driven {
            let tag = unknowns.suffix(j);
            put(format!("driven_{tag}"), one);
            put(format!("held_{tag}"), zero);
            put(format!("given_{tag}"), zero);
            // Nothing is held: what is divided by is the pivot.
            if let Some(pivot) = back.returned.get(&format!("pivot_{tag}")) {
                put(divisor(tag), *pivot);
            }
        }
        for &p in &given {
            let tag = unknowns.suffix(p);
            put(format!("driven_{tag}"), zero);
            put(format!("held_{tag}"), one);
            // Where the divisor is a number then, it is that.
            let modes = [("driven", zero), ("held", one)]
                .map(|(stem, value)| Some((symbol(graph.find(&format!("{stem}_{tag}"))?)?, value)));
            let modes: Vec<_> = modes.into_iter().flatten().collect();
            let written = back.values.get(&divisor(tag)).map(|value| value.with(&modes));
            if let Some(number) = written.filter(|e| matches!(e.node(), Node::Constant(_))) {
                put(divisor(tag), number);
            }
        }
        let returned = back.returned.values().copied();
        let pivots = driven.iter().filter_map(|&j| written_pivot(back, unknowns.suffix(j)));
        let stages = stages::all(unknowns);
        let stages = stages.iter().filter_map(|name| back.values.get(name).copied());
        let roots = returned.chain(pivots).chain(stages).map(Expr::id);
        let made = graph.rebuilt(roots, |symbol| values.get(&symbol).copied());
        Self { unknowns, back, driven, given, made }
    }

    /// Whether there is an equation of unknown `x`: of the hub, or of a driven joint.
    pub(super) fn is_equation(&self, x: usize) -> bool {
        x < HUB.len() || self.driven.contains(&x)
    }

    /// An output by its name.
    pub(super) fn output(&self, name: &str) -> Option<Expr<'g>> {
        self.back.returned.get(name).map(|value| self.made[&value.id()])
    }

    /// `L_xj`: one on the diagonal, a gain nearer the hub, nothing further out.
    pub(super) fn gain(&self, x: usize, j: usize) -> Expr<'g> {
        let zero = self.unknowns.zero;
        match x.cmp(&j) {
            Ordering::Equal => zero.graph().constant(1),
            Ordering::Less => {
                // A gain that is zero in every state of the kind is not returned.
                let (of, on) = (self.unknowns.suffix(j), self.unknowns.suffix(x));
                self.output(&format!("gain_{of}_{on}")).unwrap_or(zero)
            }
            Ordering::Greater => zero,
        }
    }

    /// The sum of `L_xj times(j)` over the driven joints; none where a part is missing.
    pub(super) fn sum(
        &self,
        x: usize,
        times: impl Fn(usize) -> Option<Expr<'g>>,
    ) -> Option<Expr<'g>> {
        let mut joints = self.driven.iter();
        joints.try_fold(self.unknowns.zero, |sum, &j| Some(sum + self.gain(x, j) * times(j)?))
    }

    /// `d_j`, by its name only.
    pub(super) fn pivot(&self, j: usize) -> Option<Expr<'g>> {
        self.output(&format!("pivot_{}", self.unknowns.suffix(j)))
    }

    /// `free_j`.
    pub(super) fn free(&self, j: usize) -> Option<Expr<'g>> {
        self.output(&format!("free_{}", self.unknowns.suffix(j)))
    }

    /// The pivot as it is computed, before it becomes a symbol.
    pub(super) fn written_pivot(&self, j: usize) -> Option<Expr<'g>> {
        written_pivot(self.back, self.unknowns.suffix(j)).map(|value| self.made[&value.id()])
    }

    /// A stage of the elimination by its symbol, with its value in terms of the stage before; none
    /// where nothing is subtracted, so that the stage before has the name.
    pub(super) fn stage(&self, name: &str) -> Option<(SymbolId, Expr<'g>)> {
        let name = self.back.shared.get(name).map_or(name, String::as_str);
        let written = self.made[&self.back.values.get(name)?.id()];
        Some((symbol(self.unknowns.zero.graph().find(name)?)?, written))
    }

    /// `e` with these stages written out, and the pivots where an entry can have a
    /// pivot's name: two names of one expression are one.
    pub(super) fn written(&self, e: Expr<'g>, names: impl IntoIterator<Item = String>) -> Expr<'g> {
        let mut values = stages::written(self, names);
        if !self.back.shared.is_empty() {
            let pivots = self.driven.iter();
            let pivots =
                pivots.filter_map(|&j| Some((symbol(self.pivot(j)?)?, self.written_pivot(j)?)));
            let pivots: Vec<_> =
                pivots.map(|(pivot, value)| (pivot, value.with(&values))).collect();
            values.extend(pivots);
        }
        stages::write_out(e, &values)
    }

    /// The unknowns of a component, and whose accelerations are given.
    pub(super) fn label(&self, of: &[usize]) -> String {
        let tags =
            |list: &[usize]| -> String { list.iter().map(|&x| self.unknowns.suffix(x)).collect() };
        if self.given.is_empty() {
            return tags(of);
        }
        format!("{} with {} given", tags(of), tags(&self.given))
    }
}

fn symbol(e: Expr<'_>) -> Option<SymbolId> {
    if let Node::Symbol(symbol) = e.node() { Some(symbol) } else { None }
}

fn written_pivot<'g>(back: &Reading<'g>, tag: &str) -> Option<Expr<'g>> {
    let symbol = back.returned.get(&format!("pivot_{tag}"))?;
    let Node::Symbol(id) = symbol.node() else { return Some(*symbol) };
    let name = symbol.graph().symbol_info(id).name;
    // A block of the system that nothing is taken out of is its own pivot.
    let first = name == format!("mass_{tag}{tag}");
    // A parameter, too, is what it is: no statement computes it.
    if first { Some(*symbol) } else { Some(back.values.get(&name).copied().unwrap_or(*symbol)) }
}
