//! The unit of an expression, from those of its symbols: what every equation must balance.

use std::fmt;

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Node, NodeId};

/// Powers of kilogram, metre and second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unit {
    /// Power of the kilogram.
    pub kilogram: i32,
    /// Power of the metre.
    pub metre: i32,
    /// Power of the second.
    pub second: i32,
}

impl Unit {
    const fn new(kilogram: i32, metre: i32, second: i32) -> Self {
        Self { kilogram, metre, second }
    }

    fn times(self, other: Self) -> Self {
        Self::new(
            self.kilogram + other.kilogram,
            self.metre + other.metre,
            self.second + other.second,
        )
    }

    fn inverse(self) -> Self {
        Self::new(-self.kilogram, -self.metre, -self.second)
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = NAMED.iter().find(|(unit, _)| unit == self) {
            return f.write_str(name);
        }
        let powers = [("kg", self.kilogram), ("m", self.metre), ("s", self.second)];
        let shown = |sign: i32| {
            let parts = powers.iter().filter(|(_, power)| power * sign > 0);
            let parts = parts.map(|(name, power)| match power.abs() {
                1 => (*name).to_owned(),
                2 => format!("{name}²"),
                3 => format!("{name}³"),
                other => format!("{name}^{other}"),
            });
            parts.collect::<Vec<_>>().join(" ")
        };
        let (above, below) = (shown(1), shown(-1));
        match (above.is_empty(), below.is_empty()) {
            (_, true) => f.write_str(&above),
            (true, false) => write!(f, "1/{below}"),
            (false, false) => write!(f, "{above}/{below}"),
        }
    }
}

/// Units that the field calls by another name.
const NAMED: [(Unit, &str); 5] = [
    (Unit::new(0, 0, 0), "1"),
    (Unit::new(0, 0, -1), "rad/s"),
    (Unit::new(0, 0, -2), "rad/s²"),
    (Unit::new(1, 1, -2), "N"),
    (Unit::new(1, 2, -2), "N m"),
];

/// What balancing comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Balance {
    /// Zero, which has every unit.
    Any,
    /// All terms have this one.
    Is(Unit),
    /// Terms of two units are added.
    Not,
}

impl Balance {
    /// Of a sum of two.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        match (self, other) {
            (Self::Any, other) | (other, Self::Any) => other,
            (Self::Is(a), Self::Is(b)) if a == b => self,
            _ => Self::Not,
        }
    }
}

/// The unit of `e`.
///
/// # Errors
/// The name of a symbol whose unit is not known.
pub fn unit(e: Expr<'_>) -> Result<Balance, String> {
    unit_of(e, &FxHashMap::default())
}

/// The unit of `e`, with those of the symbols that stand for `named` values.
///
/// # Errors
/// The name of a symbol whose unit is not known.
pub(crate) fn unit_of(e: Expr<'_>, named: &FxHashMap<String, Unit>) -> Result<Balance, String> {
    let graph = e.graph();
    let mut known: FxHashMap<NodeId, Balance> = FxHashMap::default();
    for id in graph.reachable([e.id()]) {
        let balance = match graph.node(id) {
            Node::Constant(k) if k == crate::graph::Rational::ZERO => Balance::Any,
            Node::Constant(_) => Balance::Is(Unit::default()),
            Node::Symbol(symbol) => {
                let name = graph.symbol_info(symbol).name;
                let unit = named.get(&name).copied().or_else(|| of_symbol(&name));
                Balance::Is(unit.ok_or(name)?)
            }
            Node::Neg(a) => known[&a],
            Node::Recip(a) => match known[&a] {
                Balance::Is(unit) => Balance::Is(unit.inverse()),
                other => other,
            },
            Node::Sum(a, b) => known[&a].with(known[&b]),
            Node::Product(a, b) => match (known[&a], known[&b]) {
                (Balance::Is(a), Balance::Is(b)) => Balance::Is(a.times(b)),
                (Balance::Not, _) | (_, Balance::Not) => Balance::Not,
                _ => Balance::Any,
            },
        };
        known.insert(id, balance);
    }
    Ok(known[&e.id()])
}

/// The unit of a symbol, by the way it is called.
fn of_symbol(name: &str) -> Option<Unit> {
    let part = |text: &str| name.split('_').any(|part| part == text);
    let time = match (part("ddot"), part("dot")) {
        (true, _) => -2,
        (false, true) => -1,
        _ => 0,
    };
    Some(match name.split('_').next()? {
        "sin" | "cos" | "gamma" | "theta" | "phi" | "tilt" | "mount" | "parent" => {
            Unit::new(0, 0, time)
        }
        "spin" | "omega" => Unit::new(0, 0, -1 + time),
        "m" => Unit::new(1, 0, 0),
        "i" | "j" => Unit::new(1, 2, 0),
        "r" | "l" | "d" | "x" | "y" | "z" => Unit::new(0, 1, time),
        // What drives a slide is a force: that of the slosh mass, those of a bearing.
        "u" if ["u_s", "u_sx", "u_sy", "u_sz"].contains(&name) => Unit::new(1, 1, -2),
        "u" => Unit::new(1, 2, -2),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::chain::Chain;
    use crate::derivation::quantities::quantities;
    use crate::derivation::reference::share;
    use crate::graph::{Graph, Stage};
    use crate::kinds::{DGVSCMG, KINDS, Units};

    #[test]
    fn all_components_of_every_derived_quantity_have_one_unit() {
        let graph = Graph::new();
        let chain = Chain::new(&graph, &DGVSCMG);
        for quantity in quantities(&chain) {
            let units = quantity.value.components().into_iter().map(|c| unit(c).unwrap());
            let all = units.fold(Balance::Any, Balance::with);
            assert_ne!(all, Balance::Not, "{}", quantity.name);
        }
    }

    /// No bias holds a symbol of a drive: its unit comes from masses, lengths and rates only.
    #[test]
    fn the_units_of_a_joint_are_those_of_its_equations() {
        for kind in KINDS {
            let graph = Graph::new();
            let chain = Chain::new(&graph, kind);
            let share = share(&chain);
            for (k, (link, data)) in chain.links.iter().zip(kind.links).enumerate() {
                let units: &Units = data.joint.motion.units();
                let [force, moment] = [share.force[k], share.moment[k]].map(|v| {
                    let stated = v.components().into_iter().filter(|e| !e.is_zero());
                    stated.map(shown).collect::<Vec<_>>()
                });
                let all = |stated: &[String], unit| stated.iter().all(|s| s == unit);
                assert!(all(&force, units.force), "{} {k}: {force:?}", kind.name);
                assert!(all(&moment, units.moment), "{} {k}: {moment:?}", kind.name);
                for (e, stated) in [
                    (link.rate, units.rate),
                    (link.acceleration, units.acceleration),
                    (share.bias_joint[k], units.drive),
                    (share.joint[k][0], units.pivot),
                ] {
                    assert_eq!(shown(e), stated, "{} {k}", kind.name);
                }
            }
        }
    }

    #[test]
    fn what_does_not_balance_is_told_from_what_is_not_known() {
        let g = Graph::new();
        let [m, l, y] = ["m_w", "l_o_x", "what"].map(|name| g.symbol(name, Stage::Parameter));
        assert_eq!(shown(m * l * l), "kg m²");
        assert_eq!(shown(m + g.zero()), "kg");
        assert_eq!(unit(m + l), Ok(Balance::Not));
        assert_eq!(unit(m * (m + l)), Ok(Balance::Not));
        assert_eq!(unit(m + y), Err("what".to_owned()));
    }

    fn shown(e: Expr<'_>) -> String {
        match unit(e) {
            Ok(Balance::Is(unit)) => unit.to_string(),
            other => format!("{other:?}"),
        }
    }
}
