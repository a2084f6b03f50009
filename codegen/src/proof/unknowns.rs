//! What the assembled system is solved for, by name, and the blocks between any two of them.
//!
//! Unknowns are the accelerations of B (v1 v2 v3), of the body rate (w1 w2 w3) and of the joints from
//! the hub outwards.

use std::ops::Range;

use crate::derivation::chain::Chain;
use crate::graph::{Expr, Node, SymbolId};
use crate::space::Vector;

/// Suffixes of the hub's unknowns.
pub(super) const HUB: [&str; 6] = ["v1", "v2", "v3", "w1", "w2", "w3"];
const AXES: [&str; 3] = ["bx", "by", "bz"];

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
