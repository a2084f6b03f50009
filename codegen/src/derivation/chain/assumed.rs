//! What is known beforehand of the parameters of one device: which are zero, which are equal, and
//! how the mount is made of turns.
//!
//! A chain with assumptions has no symbol for what is zero, and one symbol for what is equal, so
//! the derivation has nothing of it to carry. A mount of at most two turns is a product of sines and
//! cosines, whose columns are orthonormal by the rule `sin^2 = 1 - cos^2`.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Expr, Graph, Stage};
use crate::space::{Axis, BodyFrame, Hub, ParentFrame, Turn, Vector};

/// What is assumed of a device's parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Assumed {
    /// Names of the parameters that are zero.
    pub zero: BTreeSet<String>,
    /// Name of a parameter, and of the one that it equals.
    pub equal: BTreeMap<String, String>,
    /// The mount.
    pub mount: Mount,
}

/// What is assumed of a mount.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mount {
    /// Any rotation: nine parameters.
    #[default]
    Any,
    /// `P R Q`: axes exchanged, turned, exchanged.
    Turned {
        /// P.
        outer: Exchange,
        /// R: the unit matrix, `Rz(a)`, or `Rz(a) Ry(b)`.
        turns: Turns,
        /// Q.
        inner: Exchange,
    },
}

/// How many turns about coordinate axes a mount is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Turns {
    /// None.
    None,
    /// `Rz(a)`.
    One,
    /// `Rz(a) Ry(b)`.
    Two,
}

/// A rotation by whole quarter turns: for each column, the row of its entry that is not zero, and
/// whether that is minus one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Exchange([(usize, bool); 3]);

impl Exchange {
    /// The unit matrix.
    pub const NONE: Self = Self([(0, false), (1, false), (2, false)]);

    /// All 24 of them.
    #[must_use]
    pub fn every() -> Vec<Self> {
        const ROWS: [[usize; 3]; 6] =
            [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        let mut list = Vec::new();
        for (order, rows) in ROWS.into_iter().enumerate() {
            for signs in 0..8_u32 {
                let negative = |column: usize| signs >> column & 1 == 1;
                // A rotation, not a reflection: the product of order and signs is one.
                if (order < 3) == (signs.count_ones() % 2 == 0) {
                    list.push(Self([0, 1, 2].map(|column| (rows[column], negative(column)))));
                }
            }
        }
        list
    }

    /// The entry in `row` and `column`: -1, 0 or 1.
    #[must_use]
    pub fn entry(self, row: usize, column: usize) -> i8 {
        let (at, negative) = self.0[column];
        match (at == row, negative) {
            (false, _) => 0,
            (true, false) => 1,
            (true, true) => -1,
        }
    }
}

impl Turns {
    /// The names of the angles.
    #[must_use]
    pub fn angles(self) -> &'static [&'static str] {
        match self {
            Self::None => &[],
            Self::One => &["mount_a"],
            Self::Two => &["mount_a", "mount_b"],
        }
    }
}

impl Assumed {
    /// The parameter `name`: zero, or the symbol of the one that it equals.
    pub(super) fn parameter<'g>(&self, graph: &'g Graph, name: &str) -> Expr<'g> {
        if self.zero.contains(name) {
            return graph.zero();
        }
        let name = self.equal.get(name).map_or(name, String::as_str);
        graph.symbol(name, Stage::Parameter)
    }

    /// The device's axes expressed in B.
    pub(super) fn mount<'g>(&self, graph: &'g Graph) -> [Vector<'g, Hub>; 3] {
        match self.mount {
            Mount::Any => [0, 1, 2].map(|column| {
                let entry = |row| graph.symbol(&mount_entry(row, column), Stage::Parameter);
                Vector::new([0, 1, 2].map(entry))
            }),
            Mount::Turned { outer, turns, inner } => {
                let turned = turned(graph, turns);
                [0, 1, 2].map(|column| outer.times(inner.column(turned, column)))
            }
        }
    }
}

impl Exchange {
    /// Column of `R Q`, of the columns of R.
    fn column<'g>(self, of: [Vector<'g, Hub>; 3], column: usize) -> Vector<'g, Hub> {
        let (at, negative) = self.0[column];
        if negative { -of[at] } else { of[at] }
    }

    /// `P v`.
    fn times<'g>(self, v: Vector<'g, Hub>) -> Vector<'g, Hub> {
        let v = v.components();
        let zero = v[0].graph().zero();
        let mut made = [zero; 3];
        for (column, (row, negative)) in self.0.into_iter().enumerate() {
            made[row] = if negative { -v[column] } else { v[column] };
        }
        Vector::new(made)
    }
}

/// The columns of R.
fn turned<'g>(graph: &'g Graph, turns: Turns) -> [Vector<'g, Hub>; 3] {
    let back = |v: Vector<'g, BodyFrame>, axis: Axis, name: &str| {
        let (sin, cos) = graph.constant_angle(name);
        v.turned(Turn::<ParentFrame, BodyFrame>::about(axis, sin, cos).inverse())
            .relabelled_inboard()
    };
    [Axis::X, Axis::Y, Axis::Z].map(|axis| {
        let v = Vector::<BodyFrame>::unit(graph, axis);
        let v = if turns == Turns::Two { back(v, Axis::Y, "mount_b") } else { v };
        let v = if turns == Turns::None { v } else { back(v, Axis::Z, "mount_a") };
        Vector::new(v.components())
    })
}

/// The name of an entry of `mount`, counted from zero.
#[must_use]
pub fn mount_entry(row: usize, column: usize) -> String {
    format!("mount_{}{}", row + 1, column + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_24_rotations_by_quarter_turns() {
        let every = Exchange::every();
        assert_eq!(every.iter().collect::<BTreeSet<_>>().len(), 24);
        for exchange in every {
            let m = [0, 1, 2].map(|row| [0, 1, 2].map(|c| i32::from(exchange.entry(row, c))));
            let minor = |a: usize, b: usize| m[1][a] * m[2][b] - m[1][b] * m[2][a];
            assert_eq!(m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1), 1);
        }
    }
}
