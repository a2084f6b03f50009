//! The emitted elimination multiplied out again: `S + L D L^T = M`, and the right sides with it.
//!
//! Stated here from the names of the outputs alone, without the code that eliminates. Unknowns are
//! the accelerations of B (v1 v2 v3), of the body rate (w1 w2 w3) and of the joints from the hub
//! outwards; S is what is left on the hub, L the gains, D the pivots.

use std::collections::BTreeMap;
use std::ops::Range;

use super::Row;
use super::read_back::Reading;
use crate::derivation::chain::Chain;
use crate::graph::Expr;
use crate::normal::Ring;
use crate::space::Vector;

/// Suffixes of the hub's unknowns.
const HUB: [&str; 6] = ["v1", "v2", "v3", "w1", "w2", "w3"];
const AXES: [&str; 3] = ["bx", "by", "bz"];

/// The unknowns by name, hub first, and the blocks of the assembled system between them.
pub(super) struct Unknowns<'g> {
    /// Joint tags.
    pub(super) tags: Vec<&'static str>,
    /// The accelerations.
    pub(super) accelerations: Vec<Expr<'g>>,
    /// The speeds they are the rates of.
    pub(super) speeds: Vec<Expr<'g>>,
    /// Number and motor torque of each joint's equation.
    motors: Vec<[&'static str; 2]>,
    /// Letter of the whole device.
    whole: &'static str,
    zero: Expr<'g>,
    mass: Expr<'g>,
}

impl<'g> Unknowns<'g> {
    /// The unknowns of a chain.
    pub(super) fn of(chain: &Chain<'g>) -> Self {
        let hub = &chain.hub;
        let joint = |of: fn(&crate::derivation::chain::Link<'g>) -> Expr<'g>| {
            chain.links.iter().map(of).collect::<Vec<_>>()
        };
        let accelerations = [hub.r_b_n_ddot, hub.omega_dot].map(Vector::components).concat();
        let speeds = [hub.r_b_n_dot, hub.omega].map(Vector::components).concat();
        let zero = chain.graph.zero();
        Self {
            tags: chain.kind.links.iter().map(|link| link.joint.tag).collect(),
            accelerations: [accelerations, joint(|link| link.acceleration)].concat(),
            speeds: [speeds, joint(|link| link.rate)].concat(),
            motors: chain
                .kind
                .links
                .iter()
                .map(|link| [link.body.equations.torque, link.joint.torque])
                .collect(),
            whole: chain.kind.links[0].assembly,
            zero,
            mass: chain.links.iter().fold(zero, |sum, link| sum + link.mass),
        }
    }

    /// Suffix of unknown `x`: `v1`, `w3`, a joint's tag.
    fn suffix(&self, x: usize) -> &'static str {
        if x < HUB.len() { HUB[x] } else { self.tags[x - HUB.len()] }
    }

    /// The entry of the assembled mass matrix between unknowns `x <= y`, by its blocks' names.
    pub(super) fn assembled(
        &self,
        x: usize,
        y: usize,
        named: impl Fn(&str) -> Option<Expr<'g>>,
    ) -> Expr<'g> {
        let or_zero = |name: String| named(&name).unwrap_or(self.zero);
        match (x / 3, y / 3) {
            (0, 0) if x == y => self.mass,
            (0, 0) => self.zero,
            // -[S~]: force along x per angular acceleration about y is S x e_y reversed.
            (0, 1) => {
                let (row, column) = (x, y - 3);
                let other = 3 - row - column.min(3 - row);
                match (column + 3 - row) % 3 {
                    0 => self.zero,
                    1 => or_zero(format!("mr_{}_b_{}", self.whole, AXES[other])),
                    _ => -or_zero(format!("mr_{}_b_{}", self.whole, AXES[other])),
                }
            }
            (1, 1) => or_zero(format!("i_{}_b_{}{}", self.whole, x - 2, y - 2)),
            (0, _) => or_zero(format!("f_{}_{}", self.suffix(y), AXES[x])),
            (1, _) => or_zero(format!("n_{}_{}", self.suffix(y), AXES[x - 3])),
            _ => or_zero(format!("mass_{}{}", self.suffix(x), self.suffix(y))),
        }
    }

    /// What equation `x` asks for with nothing accelerating.
    pub(super) fn rest(&self, x: usize, named: impl Fn(&str) -> Option<Expr<'g>>) -> Expr<'g> {
        let name = match x / 3 {
            0 => format!("f_rest_{}", AXES[x]),
            1 => format!("n_rest_{}", AXES[x - 3]),
            _ => format!("u_rest_{}", self.suffix(x)),
        };
        named(&name).unwrap_or(self.zero)
    }

    /// Number, left side and unknowns of each equation.
    pub(super) fn equations(&self) -> Vec<(&'static str, &'static str, Range<usize>)> {
        let motors =
            (HUB.len()..).zip(&self.motors).map(|(x, [tag, name])| (*tag, *name, x..x + 1));
        [("(16)", "F", 0..3), ("(75)", "L_B", 3..6)].into_iter().chain(motors).collect()
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.accelerations.len()
    }
}

/// `S + L D L^T = M`, `h + L D free = u - rest`, and the diagonals for the pivot test.
pub(super) fn of_elimination<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    unknowns: &Unknowns<'g>,
    back: &Reading<'g>,
) -> Vec<Row> {
    let graph = chain.graph;
    let named = |name: &str| graph.find(name).or_else(|| back.values.get(name).copied());
    let output = |name: String| back.returned.get(&name).copied();
    let joints: Vec<usize> = (HUB.len()..unknowns.len()).collect();
    // L_xj: one on the diagonal, a gain nearer the hub, nothing further out.
    let gain = |x: usize, j: usize| match x.cmp(&j) {
        std::cmp::Ordering::Equal => Some(graph.constant(1)),
        std::cmp::Ordering::Less => {
            // A gain that is zero in every state of the kind is not returned.
            let gain = output(format!("gain_{}_{}", unknowns.suffix(j), unknowns.suffix(x)));
            Some(gain.unwrap_or(unknowns.zero))
        }
        std::cmp::Ordering::Greater => Some(unknowns.zero),
    };
    let pivot = |j: usize| output(format!("pivot_{}", unknowns.suffix(j)));

    let mut product = Vec::new();
    let mut matrix = Vec::new();
    for x in 0..unknowns.len() {
        for y in x..unknowns.len() {
            let label = format!("{}{}", unknowns.suffix(x), unknowns.suffix(y));
            let left_over =
                if y < HUB.len() { output(share_name(x, y)) } else { Some(unknowns.zero) };
            let mut sum = left_over;
            for &j in &joints {
                // The pivot's own row shows what the pivot is; elsewhere it is a symbol.
                let d = if x == j && y == j { written_pivot(back, unknowns, j) } else { pivot(j) };
                sum = add(sum, gain(x, j), d, gain(y, j));
            }
            product.extend(sum.map(|sum| (label.clone(), sum)));
            matrix.push((label, unknowns.assembled(x, y, named)));
        }
    }
    let mut rows = vec![Row::compare(
        ring,
        ["(L D Lᵀ)", "S + L D Lᵀ = M", "fn eliminate = identity"],
        &product,
        &matrix,
    )];

    let mut product = Vec::new();
    let mut right = Vec::new();
    for x in 0..unknowns.len() {
        let label = unknowns.suffix(x).to_owned();
        let hub_name = || format!("h_{}_{}", ["v", "w"][x / 3], x % 3 + 1);
        let mut sum = if x < HUB.len() { output(hub_name()) } else { Some(unknowns.zero) };
        for &j in &joints {
            let free = output(format!("free_{}", unknowns.suffix(j)));
            sum = add(sum, gain(x, j), pivot(j), free);
        }
        product.extend(sum.map(|sum| (label.clone(), sum)));
        let driven = if x < HUB.len() { unknowns.zero } else { chain.links[x - HUB.len()].torque };
        right.push((label, driven - unknowns.rest(x, named)));
    }
    let heading = ["(L D Lᵀ)", "h + L D free = u", "fn eliminate = identity"];
    rows.push(Row::compare(ring, heading, &product, &right));

    let mut diagonals = Vec::new();
    let mut expected = Vec::new();
    for &j in &joints {
        let label = format!("diagonal_{}", unknowns.suffix(j));
        diagonals.extend(output(label.clone()).map(|value| (label.clone(), value)));
        expected.push((label, unknowns.assembled(j, j, named)));
    }
    let heading = ["(L D Lᵀ)", "diagonals", "fn eliminate = identity"];
    rows.push(Row::compare(ring, heading, &diagonals, &expected));
    rows
}

/// `q_j'' + sum of gains times what they multiply = free_j`, every name spelled out.
pub(super) fn of_back_substitution<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    unknowns: &Unknowns<'g>,
    back: &Reading<'g>,
) -> Row {
    let named = |name: String| chain.graph.find(&name);
    let accelerations: BTreeMap<usize, &str> =
        (HUB.len()..).zip(chain.kind.links.iter().map(|link| link.joint.acceleration)).collect();
    let mut checked = Vec::new();
    let mut reference = Vec::new();
    for (&j, name) in &accelerations {
        let tag = unknowns.suffix(j);
        let mut sum = back.returned.get(*name).copied();
        for x in 0..j {
            let value = match accelerations.get(&x) {
                Some(inner) => back.returned.get(*inner).copied(),
                None => Some(unknowns.accelerations[x]),
            };
            let gain = named(format!("gain_{tag}_{}", unknowns.suffix(x)));
            let gain = Some(gain.unwrap_or(unknowns.zero));
            sum = add(sum, gain, value, Some(chain.graph.constant(1)));
        }
        checked.extend(sum.map(|sum| ((*name).to_owned(), sum)));
        reference.extend(named(format!("free_{tag}")).map(|free| ((*name).to_owned(), free)));
    }
    let heading = ["(L D Lᵀ)", "Lᵀ q″ = free", "fn back_substitute = identity"];
    Row::compare(ring, heading, &checked, &reference)
}

/// The pivot as it is computed, before it becomes a symbol.
fn written_pivot<'g>(back: &Reading<'g>, unknowns: &Unknowns<'g>, j: usize) -> Option<Expr<'g>> {
    let symbol = back.returned.get(&format!("pivot_{}", unknowns.suffix(j)))?;
    let crate::graph::Node::Symbol(id) = symbol.node() else { return Some(*symbol) };
    let name = symbol.graph().symbol_info(id).name;
    // A block of the system that nothing is taken out of is its own pivot.
    let first = name == format!("mass_{0}{0}", unknowns.suffix(j));
    // A parameter, too, is what it is: no statement computes it.
    if first { Some(*symbol) } else { Some(back.values.get(&name).copied().unwrap_or(*symbol)) }
}

/// Field of the hub's share between hub unknowns `x <= y`.
fn share_name(x: usize, y: usize) -> String {
    let block = [["vv", "vw"], ["", "ww"]][x / 3][y / 3];
    format!("m_{block}_{}{}", x % 3 + 1, y % 3 + 1)
}

/// `sum + a b c`, missing where anything is.
fn add<'g>(
    sum: Option<Expr<'g>>,
    a: Option<Expr<'g>>,
    b: Option<Expr<'g>>,
    c: Option<Expr<'g>>,
) -> Option<Expr<'g>> {
    Some(sum? + a? * b? * c?)
}
