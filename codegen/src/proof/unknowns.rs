//! What the assembled system is solved for, by name, and the blocks between any two of them.
//!
//! Unknowns are the accelerations of B (v1 v2 v3), of the body rate (w1 w2 w3) and of the joints
//! from the hub outwards.

use std::collections::BTreeMap;
use std::ops::Range;

use rustc_hash::FxHashMap;

use crate::derivation::chain::Chain;
use crate::graph::{Expr, Node, SymbolId};
use crate::space::{ENTRIES, Hub, Symmetric, Vector};

/// Suffixes of the hub's unknowns.
pub(super) const HUB: [&str; 6] = ["v1", "v2", "v3", "w1", "w2", "w3"];
/// Suffixes of the components expressed in B.
pub(super) const AXES: [&str; 3] = ["bx", "by", "bz"];

/// Names of what `eliminate` states of the part that moves: first moment, inertia, and force and
/// moment that the joints' rates require.
pub(super) fn moving() -> [Vec<String>; 4] {
    let along = |stem: &str| AXES.map(|axis| format!("{stem}_{axis}")).to_vec();
    let entries = ENTRIES.map(|entry| format!("i_moving_{entry}")).to_vec();
    [along("mr_moving"), entries, along("f_rates"), along("n_rates")]
}

fn vector<'g>(components: &[Expr<'g>]) -> Vector<'g, Hub> {
    Vector::new(std::array::from_fn(|k| components[k]))
}

/// The unknowns by name, hub first, and the blocks of the assembled system between them.
pub(super) struct Unknowns<'g> {
    /// Joint tags.
    pub(super) tags: Vec<&'static str>,
    /// The accelerations.
    pub(super) accelerations: Vec<Expr<'g>>,
    /// The speeds they are the rates of.
    pub(super) speeds: Vec<Expr<'g>>,
    /// Whether each joint has a motor, and thus a row in the elimination.
    driven: Vec<bool>,
    /// Number and motor torque of each joint's equation.
    motors: Vec<[&'static str; 2]>,
    /// Letter of the whole device.
    whole: &'static str,
    pub(super) zero: Expr<'g>,
    mass: Expr<'g>,
}

impl<'g> Unknowns<'g> {
    /// The unknowns of a chain.
    pub(super) fn of_chain(chain: &Chain<'g>) -> Self {
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
            driven: chain.links.iter().map(|link| link.mode.is_some()).collect(),
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

    /// Those that are solved for: all but the joints whose acceleration the kind prescribes.
    pub(super) fn solved(&self) -> Vec<usize> {
        (0..self.len()).filter(|&x| x < HUB.len() || self.driven[x - HUB.len()]).collect()
    }

    /// The acceleration of unknown `x` and what it is while its speed is kept.
    pub(super) fn at_rest(&self, x: usize) -> Option<(SymbolId, Expr<'g>)> {
        match self.accelerations[x].node() {
            Node::Symbol(symbol) => Some((symbol, self.zero)),
            _ => None,
        }
    }

    /// Suffix of unknown `x`: `v1`, `w3`, a joint's tag.
    pub(super) fn suffix(&self, x: usize) -> &'static str {
        if x < HUB.len() { HUB[x] } else { self.tags[x - HUB.len()] }
    }

    /// The blocks that `eliminate` and the hub make together, by the names of the whole: of what
    /// moves and the constant share of the hub, and of what the joints' rates and the hub's own
    /// motion require, `omega x (omega x S)` and `omega x I omega`.
    pub(super) fn with_hub(
        &self,
        chain: &Chain<'g>,
        values: &FxHashMap<String, Expr<'g>>,
        constant_share: &BTreeMap<String, Expr<'g>>,
    ) -> FxHashMap<String, Expr<'g>> {
        let zero = self.zero;
        let named = |name: &String| values.get(name).copied().unwrap_or(zero);
        let taken = |name: &String| constant_share.get(name).copied().unwrap_or(zero);
        let [moment, inertia, force, couple] = moving();
        let sum = |name: &String| {
            named(name) + taken(&format!("constant_{}", name.replace("_moving", "")))
        };
        let moment: Vec<_> = moment.iter().map(sum).collect();
        let inertia: Vec<_> = inertia.iter().map(sum).collect();
        let (s, i) = (vector(&moment), Symmetric::<Hub>::new(std::array::from_fn(|k| inertia[k])));
        let omega = chain.hub.omega;
        let force = vector(&force.iter().map(named).collect::<Vec<_>>());
        let couple = vector(&couple.iter().map(named).collect::<Vec<_>>());
        let rest = [force + omega.cross(omega.cross(s)), couple + omega.cross(i.times(omega))];
        let mut made = values.clone();
        let whole = self.whole;
        let mut put = |stem: &str, v: Vector<'g, Hub>| {
            for (axis, component) in AXES.iter().zip(v.components()) {
                made.insert(format!("{stem}_{axis}"), component);
            }
        };
        put(&format!("mr_{whole}_b"), s);
        put("f_rest", rest[0]);
        put("n_rest", rest[1]);
        for (entry, value) in ENTRIES.iter().zip(i.entries()) {
            made.insert(format!("i_{whole}_b_{entry}"), value);
        }
        made
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

    /// What equation `x` requires with nothing accelerating.
    pub(super) fn rest(&self, x: usize, named: impl Fn(&str) -> Option<Expr<'g>>) -> Expr<'g> {
        self.asked(x, "rest", named)
    }

    /// What the joints' rates require in equation `x` of the hub, and all that one of a joint
    /// requires.
    pub(super) fn of_rates(&self, x: usize, named: impl Fn(&str) -> Option<Expr<'g>>) -> Expr<'g> {
        self.asked(x, "rates", named)
    }

    fn asked(&self, x: usize, what: &str, named: impl Fn(&str) -> Option<Expr<'g>>) -> Expr<'g> {
        let name = match x / 3 {
            0 => format!("f_{what}_{}", AXES[x]),
            1 => format!("n_{what}_{}", AXES[x - 3]),
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
