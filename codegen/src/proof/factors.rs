//! The emitted elimination multiplied out again: `S + L D L^T = M`, and the right sides with it.
//!
//! Stated here from the names of the outputs only, without the code that eliminates. M is what the
//! joints bring, the hub's own block left out; -S is what they take out of that, L the gains, D the
//! pivots. All of it holds whichever joints have their torque given and whichever their acceleration:
//! see [`super::modes`]. In the identity of one entry the elimination of all others is left as symbols:
//! see [`super::stages`].

use std::collections::BTreeMap;

use super::Comparison;
use super::modes::{Settled, divisor, every};
use super::read_back::Reading;
use super::stages;
use super::unknowns::{HUB, Unknowns};
use crate::derivation::chain::Chain;
use crate::derivation::chain::parallel_axes::ParallelAxes;
use crate::graph::{Expr, Node};
use crate::normal::Ring;

/// The two sides of an identity, by labelled components; what was emitted may lack some.
#[derive(Default)]
struct Sides<'g> {
    emitted: Vec<(String, Expr<'g>)>,
    expected: Vec<(String, Expr<'g>)>,
}

impl<'g> Sides<'g> {
    fn push(&mut self, label: String, emitted: Option<Expr<'g>>, expected: Expr<'g>) {
        self.emitted.extend(emitted.map(|value| (label.clone(), value)));
        self.expected.push((label, expected));
    }

    /// Writes the entries of a joint whose axis can be parallel to the tip's by what they are across
    /// that and along it, which is claimed of these by themselves.
    fn write_across(&mut self, chain: &Chain<'g>, named: impl Fn(&str) -> Option<Expr<'g>>) {
        let Some(joints) = ParallelAxes::of_chain(chain) else { return };
        let tag = |k: usize| chain.kind.links[k].joint.tag;
        let (inner, tip) = (tag(joints.inner), tag(joints.tip));
        let zero = joints.cosine.graph().zero();
        let value = |name: String| named(&name).unwrap_or(zero);
        let own = joints.cosine * value(format!("mass_{tip}{tip}"));
        let across = joints.names(chain.kind.links).map(value);
        let entries = [(inner, joints.cosine * own), (tip, own)].into_iter().zip(across);
        let entries = entries.filter_map(|((other, along), across)| {
            match value(format!("mass_{inner}{other}")).node() {
                Node::Symbol(symbol) => Some((symbol, across + along)),
                _ => None,
            }
        });
        let entries: Vec<_> = entries.collect();
        for (_, value) in self.emitted.iter_mut().chain(&mut self.expected) {
            *value = value.with(&entries);
        }
    }

    fn row(&self, ring: &mut Ring<'g>, name: &str) -> Comparison {
        let heading = ["(L D Lᵀ)", name, "fn eliminate = identity"];
        Comparison::new(ring, heading, &self.emitted, &self.expected)
    }
}

/// `S + L D L^T = M`, `h + L D free = u - rest`, what a joint whose acceleration is given has for its
/// gains, and the diagonals and divisors.
pub(super) fn of_elimination<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    unknowns: &Unknowns<'g>,
    back: &Reading<'g>,
) -> Vec<Comparison> {
    let named = |name: &str| {
        let name = back.shared.get(name).map_or(name, String::as_str);
        chain.graph.find(name).or_else(|| back.values.get(name).copied())
    };
    let [mut matrix, mut right, mut given] = [(); 3].map(|()| Sides::default());
    for settled in every(unknowns, back) {
        of_matrix(&settled, unknowns, named, &mut matrix);
        of_right_side(&settled, chain, unknowns, named, &mut right);
        of_given(&settled, unknowns, named, &mut given);
    }
    for sides in [&mut matrix, &mut right] {
        sides.write_across(chain, named);
    }
    let [mut diagonals, mut divisors] = [(); 2].map(|()| Sides::default());
    let output = |name: &str| back.returned.get(name).copied();
    for tag in unknowns.solved().into_iter().skip(HUB.len()).map(|j| unknowns.suffix(j)) {
        let name = format!("diagonal_{tag}");
        let entry = named(&format!("mass_{tag}{tag}")).unwrap_or(unknowns.zero);
        let pivot = output(&format!("pivot_{tag}"));
        // The pivot from which nothing is subtracted is the diagonal: it is returned once.
        diagonals.push(name.clone(), output(&name).or(pivot), entry);
        let tip =
            ParallelAxes::of_chain(chain).map(|joints| chain.kind.links[joints.tip].joint.tag);
        let weight = named(&format!("driven_{tag}")).filter(|_| tip == Some(tag));
        let own = pivot.map(|pivot| weight.map_or(pivot, |driven| driven * pivot));
        let sum = own.zip(named(&format!("held_{tag}")));
        let expected = sum.map_or(unknowns.zero, |(own, held)| own + held);
        let name = divisor(tag);
        divisors.push(name.clone(), back.values.get(&name).copied(), expected);
    }
    let sides = [
        (matrix, "S + L D Lᵀ = M"),
        (right, "h + L D free = u"),
        (given, "L = 0, free = given"),
        (diagonals, "diagonals"),
        (divisors, "D + held"),
    ];
    sides.iter().map(|(sides, name)| sides.row(ring, name)).collect()
}

/// Every entry between hub and joints whose outer joint is driven: the row or column of a joint
/// nearer the hub whose acceleration is given is among them.
fn of_matrix<'g>(
    settled: &Settled<'_, 'g>,
    unknowns: &Unknowns<'g>,
    named: impl Fn(&str) -> Option<Expr<'g>>,
    sides: &mut Sides<'g>,
) {
    let solved = unknowns.solved();
    let negated = |name: &str| settled.output(name).map(|taken| -taken);
    for (place, &y) in solved.iter().enumerate().filter(|(_, y)| settled.is_equation(**y)) {
        for &x in &solved[..=place] {
            let hub = y < HUB.len();
            let left_over = if hub { negated(&share_name(x, y)) } else { Some(unknowns.zero) };
            // The pivot's own row shows what the pivot is; elsewhere it is a symbol.
            let own = |j: usize| x == j && y == j;
            let d = |j| if own(j) { settled.written_pivot(j) } else { settled.pivot(j) };
            let product = settled.sum(x, |j| Some(d(j)? * settled.gain(y, j)));
            let sum = left_over.zip(product).map(|(left_over, product)| left_over + product);
            let own = if hub { Vec::new() } else { stages::of_entry(unknowns, x, y) };
            let sum = sum.map(|sum| settled.written(sum, own));
            let expected = if hub { unknowns.zero } else { unknowns.assembled(x, y, &named) };
            sides.push(settled.label(&[x, y]), sum, expected);
        }
    }
}

/// The right side of each equation. What a given acceleration requires goes to that side: of the
/// equations nearer the hub, all that the driven joints further out have not taken already.
fn of_right_side<'g>(
    settled: &Settled<'_, 'g>,
    chain: &Chain<'g>,
    unknowns: &Unknowns<'g>,
    named: impl Fn(&str) -> Option<Expr<'g>>,
    sides: &mut Sides<'g>,
) {
    for x in unknowns.solved().into_iter().filter(|&x| settled.is_equation(x)) {
        let hub_name = || format!("h_{}_{}", ["v", "w"][x / 3], x % 3 + 1);
        let taken = || settled.output(&hub_name()).map(|taken| -taken);
        let left_over = if x < HUB.len() { taken() } else { Some(unknowns.zero) };
        let product = settled.sum(x, |j| Some(settled.pivot(j)? * settled.free(j)?));
        let torque = if x < HUB.len() { unknowns.zero } else { chain.links[x - HUB.len()].torque };
        let further_out = settled.given.iter().filter(|&&p| p > x);
        let asked = further_out.clone().copied().try_fold(unknowns.zero, |sum, p| {
            let taken = settled.sum(x, |j| Some(settled.pivot(j)? * settled.gain(p, j)))?;
            let told = named(&format!("given_{}", unknowns.suffix(p)))?;
            Some(sum + (unknowns.assembled(x, p, &named) - taken) * told)
        });
        let sum =
            left_over.zip(product).zip(asked).map(|((h, product), asked)| h + product + asked);
        // What a given acceleration requires has been subtracted from the entry beside it.
        let beside = further_out.flat_map(|&p| stages::of_entry(unknowns, x, p));
        let own = (x >= HUB.len()).then(|| stages::of_right_side(unknowns, x));
        let names = beside.chain(own.into_iter().flatten());
        let sum = sum.map(|sum| settled.written(sum, names));
        sides.push(settled.label(&[x]), sum, torque - unknowns.of_rates(x, &named));
    }
}

/// A joint whose acceleration is given has zero gains, and moves as prescribed.
fn of_given<'g>(
    settled: &Settled<'_, 'g>,
    unknowns: &Unknowns<'g>,
    named: impl Fn(&str) -> Option<Expr<'g>>,
    sides: &mut Sides<'g>,
) {
    for &p in &settled.given {
        for x in unknowns.solved().into_iter().filter(|&x| x < p) {
            sides.push(settled.label(&[x, p]), Some(settled.gain(x, p)), unknowns.zero);
        }
        let told = named(&format!("given_{}", unknowns.suffix(p)));
        sides.push(settled.label(&[p]), settled.free(p), told.unwrap_or(unknowns.zero));
    }
}

/// `q_j'' + sum of gains times what they multiply = free_j`, every name spelled out. A joint whose
/// acceleration the kind prescribes has neither: it is zero.
pub(super) fn of_back_substitution<'g>(
    ring: &mut Ring<'g>,
    chain: &Chain<'g>,
    unknowns: &Unknowns<'g>,
    back: &Reading<'g>,
) -> Comparison {
    let named = |name: String| chain.graph.find(&name);
    let (solved, zero) = (unknowns.solved(), Some(unknowns.zero));
    let accelerations: BTreeMap<usize, &str> =
        (HUB.len()..).zip(chain.kind.links.iter().map(|link| link.joint.acceleration)).collect();
    let mut checked = Vec::new();
    let mut reference = Vec::new();
    let locked = |j: usize| chain.kind.links[j - HUB.len()].is_locked();
    for (&j, name) in accelerations.iter().filter(|(j, _)| !locked(**j)) {
        let tag = unknowns.suffix(j);
        let mut sum = back.returned.get(*name).copied();
        for x in 0..j {
            let value = match accelerations.get(&x) {
                Some(_) if locked(x) => zero,
                Some(inner) => back.returned.get(*inner).copied(),
                None => Some(unknowns.accelerations[x]),
            };
            let gain = named(format!("gain_{tag}_{}", unknowns.suffix(x)));
            sum = add(sum, gain.or(zero), value, Some(chain.graph.constant(1)));
        }
        checked.extend(sum.map(|sum| ((*name).to_owned(), sum)));
        let free = if solved.contains(&j) { named(format!("free_{tag}")) } else { zero };
        reference.extend(free.map(|free| ((*name).to_owned(), free)));
    }
    let heading = ["(L D Lᵀ)", "Lᵀ q″ = free", "fn back_substitute = identity"];
    Comparison::new(ring, heading, &checked, &reference)
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
