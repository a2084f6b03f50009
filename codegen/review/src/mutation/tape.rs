//! An emitted function as a flat list of operations, evaluated in floating point with at most one
//! of them changed.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::listing::Listing;
use super::site::{Change, Location, partner, symbol};
use nalgebra::{Matrix3, Vector3};
use precess_codegen::graph::{Expr, Graph, Node, NodeId, SymbolId, float};
use precess_codegen::space::ENTRIES;

/// One operation; operands are slots of earlier ones.
#[derive(Clone, Copy, Debug)]
enum Step {
    Constant(f64),
    Input(SymbolId),
    Copy(usize),
    Sum(usize, usize),
    Difference(usize, usize),
    Product(usize, usize),
    Neg(usize),
    Recip(usize),
}

/// The operations of one function.
pub(super) struct Tape {
    steps: Vec<Step>,
    slots: FxHashMap<NodeId, usize>,
    returned: BTreeMap<String, usize>,
}

/// A number for every symbol; what was not given is not a number.
#[derive(Clone)]
pub(super) struct Values(Vec<f64>);

/// What a function returned.
pub(super) struct Returned<'a> {
    slots: Vec<f64>,
    names: &'a BTreeMap<String, usize>,
}

/// The one step that is other than it should be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Changed {
    slot: usize,
    step: Step,
}

impl Tape {
    /// The operations of a listed function.
    pub(super) fn new(graph: &Graph, listing: &Listing<'_>) -> Self {
        let mut made =
            Self { steps: Vec::new(), slots: FxHashMap::default(), returned: BTreeMap::new() };
        let mut named = FxHashMap::default();
        for line in &listing.lines {
            for id in &line.nodes {
                made.place(graph, *id);
            }
            if let Some(slot) = made.slots.get(&line.value.id()).copied() {
                named.insert(line.name.as_str(), slot);
                if let Some(symbol) = line.cut {
                    made.slots.insert(symbol.id(), slot);
                }
            }
        }
        for (field, source) in &listing.fields {
            if let Some(slot) = named.get(source.as_str()) {
                // A slot of its own, so that what is returned can be changed by itself.
                made.steps.push(Step::Copy(*slot));
                made.returned.insert(field.clone(), made.steps.len() - 1);
            }
        }
        made
    }

    fn place(&mut self, graph: &Graph, id: NodeId) {
        if self.slots.contains_key(&id) {
            return;
        }
        let other = partner(graph, graph.expr(id));
        if let Some((other, input)) = other.and_then(|other| Some((other, symbol(other)?))) {
            self.push(other, Step::Input(input));
        }
        let at = |id: &NodeId| self.slots[id];
        let step = match graph.node(id) {
            Node::Constant(k) => Step::Constant(float(k)),
            Node::Symbol(symbol) => Step::Input(symbol),
            Node::Sum(a, b) => Step::Sum(at(&a), at(&b)),
            Node::Product(a, b) => Step::Product(at(&a), at(&b)),
            Node::Neg(a) => Step::Neg(at(&a)),
            Node::Recip(a) => Step::Recip(at(&a)),
        };
        self.push(graph.expr(id), step);
    }

    fn push(&mut self, node: Expr<'_>, step: Step) {
        self.slots.entry(node.id()).or_insert_with(|| {
            self.steps.push(step);
            self.steps.len() - 1
        });
    }

    /// The change of this function that a mutant requires; none where it does not compute the node.
    pub(super) fn changed(
        &self,
        graph: &Graph,
        place: &Location,
        change: Change,
    ) -> Option<Changed> {
        let swapped = |id: NodeId| Some(self.slots[&partner(graph, graph.expr(id))?.id()]);
        match place {
            Location::Returned(field, id) => {
                let slot = *self.returned.get(field)?;
                Some(Changed { slot, step: Step::Copy(swapped(*id)?) })
            }
            Location::Operand { node, second } => {
                let slot = *self.slots.get(node)?;
                let operands: Vec<_> = graph.node(*node).operands().collect();
                let chosen = operands[usize::from(*second)];
                let step = match (change, self.steps[slot]) {
                    (Change::Drop, Step::Sum(a, b)) => Step::Copy(if *second { a } else { b }),
                    (Change::Flip, Step::Sum(a, b)) if *second => Step::Difference(a, b),
                    (Change::Flip, Step::Sum(a, b)) => Step::Difference(b, a),
                    (Change::Swap, step) => step.with(*second, swapped(chosen)?),
                    _ => return None,
                };
                Some(Changed { slot, step })
            }
        }
    }

    /// What the function returns for these inputs.
    pub(super) fn evaluate(&self, values: &Values, changed: Option<Changed>) -> Returned<'_> {
        let mut slots = Vec::with_capacity(self.steps.len());
        let (before, from) = self.steps.split_at(changed.map_or(0, |changed| changed.slot));
        let after = from.iter().skip(usize::from(changed.is_some()));
        let changed = changed.iter().map(|changed| &changed.step);
        for step in before.iter().chain(changed).chain(after) {
            slots.push(step.value(values, &slots));
        }
        Returned { slots, names: &self.returned }
    }
}

impl Step {
    fn value(self, values: &Values, slots: &[f64]) -> f64 {
        match self {
            Self::Constant(k) => k,
            Self::Input(symbol) => values.0[symbol.index()],
            Self::Copy(a) => slots[a],
            Self::Sum(a, b) => slots[a] + slots[b],
            Self::Difference(a, b) => slots[a] - slots[b],
            Self::Product(a, b) => slots[a] * slots[b],
            Self::Neg(a) => -slots[a],
            Self::Recip(a) => 1.0 / slots[a],
        }
    }

    /// The same operation with one operand replaced.
    fn with(self, second: bool, slot: usize) -> Self {
        let pair = |a: usize, b: usize| if second { (a, slot) } else { (slot, b) };
        match self {
            Self::Sum(a, b) => {
                let (a, b) = pair(a, b);
                Self::Sum(a, b)
            }
            Self::Product(a, b) => {
                let (a, b) = pair(a, b);
                Self::Product(a, b)
            }
            Self::Neg(_) => Self::Neg(slot),
            Self::Recip(_) => Self::Recip(slot),
            other => other,
        }
    }
}

impl Values {
    /// Room for every symbol of a graph, and nothing given yet.
    pub(super) fn covering(graph: &Graph) -> Self {
        Self(vec![f64::NAN; graph.symbols()])
    }

    /// Gives a symbol its value; what is no symbol takes none.
    pub(super) fn set(&mut self, of: Expr<'_>, value: f64) {
        let place = symbol(of).and_then(|id| self.0.get_mut(id.index()));
        if let Some(place) = place {
            *place = value;
        }
    }

    /// Gives three symbols the components of a vector.
    pub(super) fn set_vector(&mut self, of: [Expr<'_>; 3], value: Vector3<f64>) {
        for (symbol, component) in of.into_iter().zip(value.iter()) {
            self.set(symbol, *component);
        }
    }
}

impl Returned<'_> {
    /// The number returned under a name; a name that is not returned is not a number.
    pub(super) fn scalar(&self, field: &str) -> f64 {
        self.names.get(field).map_or(f64::NAN, |slot| self.slots[*slot])
    }

    /// Whether a number is returned under a name.
    pub(super) fn returns(&self, field: &str) -> bool {
        self.names.contains_key(field)
    }

    /// Three components: `r_wc_b` along `gi`. A vector that is zero in every state of the kind is
    /// not returned.
    pub(super) fn vector(&self, stem: &str, frame: &str) -> Vector3<f64> {
        let names = ["x", "y", "z"].map(|axis| format!("{stem}_{frame}{axis}"));
        Vector3::from(self.all_or_zero(&names))
    }

    /// Six entries of a symmetric tensor; as for a vector.
    pub(super) fn tensor(&self, stem: &str) -> Matrix3<f64> {
        let names = ENTRIES.map(|entry| format!("{stem}_{entry}"));
        let [xx, xy, xz, yy, yz, zz] = self.all_or_zero(&names);
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    /// The numbers under these names; zeros where none is returned. That it is really zero shows in
    /// the laws, which the unchanged functions must obey.
    fn all_or_zero<const K: usize>(&self, names: &[String; K]) -> [f64; K] {
        let none = names.iter().all(|name| !self.names.contains_key(name));
        if none { [0.0; K] } else { names.each_ref().map(|name| self.scalar(name)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mutation::site::sites;
    use precess_codegen::derivation::heading::Heading;
    use precess_codegen::derivation::script::Script;
    use precess_codegen::graph::Stage;
    use precess_codegen::kernel::{Field, Record, Source};
    use rustc_hash::FxHashSet;

    #[test]
    fn each_change_gives_the_value_it_names() {
        let g = Graph::new();
        let rate = g.symbol("rate", Stage::Rate);
        let (s, c) = g.angle("q", rate);
        let mut script = Script::new(&g);
        script.section("a", Heading::new("A cut and what is made of it"));
        let cut = script.cut("cut", s * rate);
        script.name("z", cut - c);
        script.name("w", c);
        let field =
            |name: &str| Field { name: name.into(), doc: String::new(), source: Source::Own };
        let fields = vec![field("z"), field("w")];
        let output = Record { name: String::new(), doc: String::new(), fields, shared: false };
        let listing = Listing::new(&g, "f", &script.sections, &output, &[], &FxHashSet::default());
        let tape = Tape::new(&g, &listing);
        let mut values = Values::covering(&g);
        for (symbol, value) in [(rate, 3.0), (s, 0.6), (c, 0.8)] {
            values.set(symbol, value);
        }
        let right = tape.evaluate(&values, None);
        assert_eq!((right.scalar("z"), right.scalar("w")), (0.6 * 3.0 - 0.8, 0.8));
        let found = sites(&g, &listing).into_iter().map(|site| {
            let changed = tape.changed(&g, &site.place, site.mutant.change);
            let wrong = tape.evaluate(&values, changed);
            (site.mutant.to_string(), wrong.scalar("z"), wrong.scalar("w"))
        });
        let cut = 0.6 * 3.0;
        let expected = [
            ("f: cut: swap `sin_q` of `rate * sin_q`", 0.8 * 3.0 - 0.8, 0.8),
            ("f: z: swap `cos_q` of `-cos_q`", cut - 0.6, 0.8),
            ("f: z: drop `-cos_q` of `cut - cos_q`", cut, 0.8),
            ("f: z: flip `-cos_q` of `cut - cos_q`", cut + 0.8, 0.8),
            ("f: z: drop `cut` of `cut - cos_q`", -0.8, 0.8),
            ("f: z: flip `cut` of `cut - cos_q`", -cut - 0.8, 0.8),
            ("f: w: swap `cos_q` of `cos_q`", cut - 0.8, 0.6),
        ];
        let mut found: Vec<_> = found.collect();
        found.sort_by(|a, b| a.0.cmp(&b.0));
        let mut expected = expected.map(|(text, z, w)| (text.to_owned(), z, w)).to_vec();
        expected.sort_by(|a, b| a.0.cmp(&b.0));
        assert_eq!(found, expected);
    }
}
