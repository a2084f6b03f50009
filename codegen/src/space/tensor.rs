//! Symmetric tensors of second order: inertias and their derivatives.

use std::marker::PhantomData;
use std::ops::{Add, Mul, Sub};

use super::frame::{Axis, BodyFrame, Frame, Hub, ParentFrame, Turn};
use super::vector::Vector;
use crate::graph::{Expr, Graph};

/// A symmetric tensor resolved along the axes of `F`: entries 11, 12, 13, 22, 23, 33.
pub struct Symmetric<'g, F> {
    entries: [Expr<'g>; 6],
    frame: PhantomData<F>,
}

/// Suffixes of the six entries, in the order in which they are stored.
pub const ENTRIES: [&str; 6] = ["11", "12", "13", "22", "23", "33"];
/// Row and column of each stored entry.
const PLACES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
/// Index of each entry in storage.
const INDEX: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

impl<F> Clone for Symmetric<'_, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F> Copy for Symmetric<'_, F> {}

impl<'g, F: Frame> Symmetric<'g, F> {
    /// From the entries 11, 12, 13, 22, 23, 33.
    #[must_use]
    pub fn new(entries: [Expr<'g>; 6]) -> Self {
        Self { entries, frame: PhantomData }
    }

    /// The zero tensor.
    #[must_use]
    pub fn zero(graph: &'g Graph) -> Self {
        Self::new([graph.zero(); 6])
    }

    /// `a 1`.
    #[must_use]
    pub fn isotropic(a: Expr<'g>) -> Self {
        let zero = a.graph().zero();
        Self::new([a, zero, zero, a, zero, a])
    }

    /// With these moments and no products.
    #[must_use]
    pub fn diagonal([xx, yy, zz]: [Expr<'g>; 3]) -> Self {
        let zero = xx.graph().zero();
        Self::new([xx, zero, zero, yy, zero, zz])
    }

    /// The entries 11, 12, 13, 22, 23, 33.
    #[must_use]
    pub fn entries(self) -> [Expr<'g>; 6] {
        self.entries
    }

    /// One entry, rows and columns from zero.
    #[must_use]
    pub fn at(self, row: usize, column: usize) -> Expr<'g> {
        self.entries[INDEX[row][column]]
    }

    /// `(a b^T + b a^T) / 2` doubled: `a b^T + b a^T`.
    #[must_use]
    pub fn outer_pair(a: Vector<'g, F>, b: Vector<'g, F>) -> Self {
        let (a, b) = (a.components(), b.components());
        Self::new(PLACES.map(|(i, j)| a[i] * b[j] + b[i] * a[j]))
    }

    /// `sum t_ij e_i e_j^T`: the tensor whose entries along `axes` these are.
    #[must_use]
    pub fn along<To: Frame>(self, axes: [Vector<'g, To>; 3]) -> Symmetric<'g, To> {
        let graph = self.trace().graph();
        let half = graph.constant(2).recip();
        let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        places.fold(Symmetric::zero(graph), |sum, (i, j)| {
            sum + (half * self.at(i, j)) * Symmetric::outer_pair(axes[i], axes[j])
        })
    }

    /// `a b^T + b a^T` of both pairs.
    #[must_use]
    pub fn pairs([(a, b), (c, d)]: [(Vector<'g, F>, Vector<'g, F>); 2]) -> Self {
        let [a, b, c, d] = [a, b, c, d].map(Vector::components);
        Self::new(PLACES.map(|(i, j)| {
            let half = a[i] * b[j] + c[i] * d[j];
            if i == j { half + half } else { half + (a[j] * b[i] + c[j] * d[i]) }
        }))
    }

    /// `[r~][r~]^T = (r . r) 1 - r r^T`, of the parallel axis theorem.
    #[must_use]
    pub fn tilde_squared(r: Vector<'g, F>) -> Self {
        let [x, y, z] = r.components();
        let (xx, yy, zz) = (x.squared(), y.squared(), z.squared());
        Self::new([yy + zz, -(x * y), -(x * z), xx + zz, -(y * z), xx + yy])
    }

    /// `[a~][b~]^T + [b~][a~]^T = 2 (a . b) 1 - a b^T - b a^T`. Twice `a` is what parameters give,
    /// where it is an arm.
    #[must_use]
    pub fn tilde_pair(a: Vector<'g, F>, b: Vector<'g, F>) -> Self {
        let (a, b) = (a.components(), b.components());
        let twice = [0, 1, 2].map(|i| (a[i] + a[i]) * b[i]);
        Self::new(PLACES.map(|(i, j)| {
            if i == j {
                twice[(i + 1) % 3] + twice[(i + 2) % 3]
            } else {
                -(a[i] * b[j] + a[j] * b[i])
            }
        }))
    }

    /// `self v`.
    #[must_use]
    pub fn times(self, v: Vector<'g, F>) -> Vector<'g, F> {
        let [x, y, z] = v.components();
        Vector::new([0, 1, 2].map(|i| self.at(i, 0) * x + self.at(i, 1) * y + self.at(i, 2) * z))
    }

    /// `tr(I) / 2 1 - I`: the integral of `r r^T dm`, of the inertia about the same point.
    #[must_use]
    pub fn second_moment(self) -> Self {
        let half = self.trace().graph().constant(2).recip();
        Self::isotropic(half * self.trace()) - self
    }

    /// The integral of `r x G r dm` for the second moment `self`: twice the axial vector of `G S`,
    /// to which a multiple of one in either adds nothing.
    #[must_use]
    pub fn couple(self, field: Self) -> Vector<'g, F> {
        let (s, g) = (self, field);
        Vector::new([Axis::X, Axis::Y, Axis::Z].map(|axis| {
            let [i, j, k] = axis.cycle();
            s.at(i, j) * g.at(i, k) - s.at(i, k) * g.at(i, j)
                + (s.at(j, j) - s.at(k, k)) * g.at(j, k)
                + s.at(j, k) * (g.at(k, k) - g.at(j, j))
        }))
    }

    /// The derivative seen from the frame against which `F` turns at `omega`:
    /// `I' = dI/dt + [omega~] I - I [omega~]`.
    #[must_use]
    pub fn prime(self, omega: Vector<'g, F>) -> Self {
        let [a, b, c] = omega.components();
        let [t11, t12, t13, t22, t23, t33] = self.entries;
        let turning = Self::new([
            twice(b * t13 - c * t12),
            b * t23 - c * t22 + c * t11 - a * t13,
            b * t33 - c * t23 + a * t12 - b * t11,
            twice(c * t12 - a * t23),
            c * t13 - a * t33 + a * t22 - b * t12,
            twice(a * t23 - b * t13),
        ]);
        self.component_rates() + turning
    }

    /// `dI/dt` as an observer on `F` sees it: entry by entry.
    #[must_use]
    pub fn component_rates(self) -> Self {
        Self::new(self.entries.map(Expr::time_derivative))
    }

    /// The same tensor along the axes that `turn` leads to. Both moments change by the same, in
    /// opposite senses, and the product of inertia with them, which saves half of the products.
    #[must_use]
    pub fn turned<To: Frame>(self, turn: Turn<'g, F, To>) -> Symmetric<'g, To> {
        if turn.is_none() {
            return Symmetric::new(self.entries);
        }
        let [k, i, j] = turn.axis.cycle();
        let (s, c) = (turn.sin, turn.cos);
        let (ii, ij, jj) = (self.at(i, i), self.at(i, j), self.at(j, j));
        let across = s * (jj - ii) + c * twice(ij);
        let moved = s * across;
        let mut made = self.entries;
        made[INDEX[i][i]] = ii + moved;
        made[INDEX[i][j]] = c * across - ij;
        made[INDEX[j][j]] = jj - moved;
        made[INDEX[k][i]] = c * self.at(k, i) + s * self.at(k, j);
        made[INDEX[k][j]] = c * self.at(k, j) - s * self.at(k, i);
        Symmetric::new(made)
    }

    /// The same with both moments written from the one about `axis`, which is across the turn: the
    /// entry that has it at no turn as `I + s (...)`, the other, which has it after a quarter turn,
    /// as `I + c (...)`. Where that moment is zero, neither is a difference of larger numbers there.
    #[must_use]
    pub fn turned_from<To: Frame>(self, turn: Turn<'g, F, To>, axis: Axis) -> Symmetric<'g, To> {
        let mut made = self.turned(turn);
        let ([k, i, j], [from, ..]) = (turn.axis.cycle(), axis.cycle());
        if turn.is_none() || from == k {
            return made;
        }
        let (s, c) = (turn.sin, turn.cos);
        let (ii, ij, jj) = (self.at(i, i), self.at(i, j), self.at(j, j));
        let across = c * (ii - jj) + s * twice(ij);
        if from == i {
            made.entries[INDEX[j][j]] = ii - c * across;
        } else {
            made.entries[INDEX[i][i]] = jj + c * across;
        }
        made
    }

    /// The same with another entry.
    #[must_use]
    pub fn with(mut self, row: usize, column: usize, entry: Expr<'g>) -> Self {
        self.entries[INDEX[row][column]] = entry;
        self
    }

    /// The sum of the diagonal.
    #[must_use]
    pub fn trace(self) -> Expr<'g> {
        self.entries[0] + self.entries[3] + self.entries[5]
    }
}

impl<'g> Symmetric<'g, ParentFrame> {
    /// Towards the hub: the parent body's frame is the next body's own.
    #[must_use]
    pub fn relabelled_inboard(self) -> Symmetric<'g, BodyFrame> {
        Symmetric::new(self.entries)
    }

    /// The hub is the parent body of the first joint.
    #[must_use]
    pub fn on_hub(self) -> Symmetric<'g, Hub> {
        Symmetric::new(self.entries)
    }
}

fn twice(a: Expr<'_>) -> Expr<'_> {
    a + a
}

impl<F: Frame> Add for Symmetric<'_, F> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(std::array::from_fn(|k| self.entries[k] + other.entries[k]))
    }
}

impl<F: Frame> Sub for Symmetric<'_, F> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(std::array::from_fn(|k| self.entries[k] - other.entries[k]))
    }
}

impl<'g, F: Frame> Mul<Symmetric<'g, F>> for Expr<'g> {
    type Output = Symmetric<'g, F>;
    fn mul(self, t: Symmetric<'g, F>) -> Symmetric<'g, F> {
        Symmetric::new(t.entries.map(|entry| self * entry))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Stage;
    use crate::normal::Ring;

    fn inertia<F: Frame>(g: &Graph) -> Symmetric<'_, F> {
        Symmetric::new(
            ["11", "12", "13", "22", "23", "33"]
                .map(|entry| g.symbol(&format!("i_{entry}"), Stage::Parameter)),
        )
    }

    fn assert_equal<F: Frame>(g: &Graph, a: Symmetric<'_, F>, b: Symmetric<'_, F>) {
        let mut ring = Ring::new(g);
        for entry in (a - b).entries() {
            assert!(ring.normal(entry).unwrap().is_empty());
        }
    }

    #[test]
    fn prime_agrees_with_entries_in_the_fixed_frame() {
        let g = Graph::new();
        let rate = g.symbol("q_dot", Stage::Rate);
        let (sin, cos) = g.angle("q", rate);
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let turn = Turn::<ParentFrame, BodyFrame>::about(axis, sin, cos);
            let i = inertia::<BodyFrame>(&g);
            let moving = i.prime(rate * Vector::unit(&g, axis)).turned(turn.inverse());
            assert_equal(&g, moving, i.turned(turn.inverse()).component_rates());
        }
    }

    #[test]
    fn turning_commutes_with_taking_moments() {
        let g = Graph::new();
        let (sin, cos) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        let v = Vector::<ParentFrame>::new(["x", "y", "z"].map(|a| g.symbol(a, Stage::Parameter)));
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let turn = Turn::<ParentFrame, BodyFrame>::about(axis, sin, cos);
            let i = inertia::<ParentFrame>(&g);
            let (before, after) = (i.times(v).turned(turn), i.turned(turn).times(v.turned(turn)));
            let mut ring = Ring::new(&g);
            for component in (before - after).components() {
                assert!(ring.normal(component).unwrap().is_empty());
            }
        }
    }

    #[test]
    fn written_from_either_moment_it_is_the_same_tensor() {
        let g = Graph::new();
        let (sin, cos) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        for about in [Axis::X, Axis::Y, Axis::Z] {
            let turn = Turn::<ParentFrame, BodyFrame>::about(about, sin, cos);
            for from in [Axis::X, Axis::Y, Axis::Z] {
                let i = inertia::<ParentFrame>(&g);
                assert_equal(&g, i.turned_from(turn, from), i.turned(turn));
            }
        }
    }

    #[test]
    fn without_the_moment_that_it_is_written_from_the_other_has_the_cosine_as_factor() {
        let g = Graph::new();
        let (sin, cos) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        let turn = Turn::<ParentFrame, BodyFrame>::about(Axis::Y, sin, cos);
        let made = inertia::<ParentFrame>(&g).with(0, 0, g.zero()).turned_from(turn, Axis::X);
        assert!(made.at(2, 2).with(&[(symbol(cos), g.zero())]).is_zero());
    }

    fn symbol(e: Expr<'_>) -> crate::graph::SymbolId {
        let crate::graph::Node::Symbol(symbol) = e.node() else { panic!("{e:?} is no symbol") };
        symbol
    }

    #[test]
    fn a_cloud_of_masses_has_the_couple_of_its_points() {
        let g = Graph::new();
        let field = Symmetric::<BodyFrame>::new(
            ENTRIES.map(|entry| g.symbol(&format!("g_{entry}"), Stage::Parameter)),
        );
        let point = |name: &str| {
            Vector::new(["x", "y", "z"].map(|a| g.symbol(&format!("{name}_{a}"), Stage::Parameter)))
        };
        let (a, b) = (point("a"), point("b"));
        let inertia = Symmetric::tilde_squared(a) + Symmetric::tilde_squared(b);
        let points = a.cross(field.times(a)) + b.cross(field.times(b));
        let mut ring = Ring::new(&g);
        for couple in [inertia.second_moment().couple(field), -inertia.couple(field)] {
            for component in (couple - points).components() {
                assert!(ring.normal(component).unwrap().is_empty());
            }
        }
        let moment = inertia.second_moment();
        let half = g.constant(2).recip();
        let outer = |v| half * Symmetric::outer_pair(v, v);
        assert_equal(&g, moment, outer(a) + outer(b));
    }

    /// `G = 3 n n^T - 1` in units of mu / r^3: the torque is 3 n x I n.
    #[test]
    fn the_field_of_a_far_mass_turns_a_body_as_textbooks_say() {
        let g = Graph::new();
        let n = Vector::<BodyFrame>::new(["x", "y", "z"].map(|a| g.symbol(a, Stage::Parameter)));
        let (one, three) = (g.constant(1), g.constant(3));
        let half = g.constant(2).recip();
        let field = (three * half) * Symmetric::outer_pair(n, n) - Symmetric::isotropic(one);
        let i = inertia::<BodyFrame>(&g);
        let mut ring = Ring::new(&g);
        let off = i.second_moment().couple(field) - three * n.cross(i.times(n));
        for component in off.components() {
            assert!(ring.normal(component).unwrap().is_empty());
        }
    }

    #[test]
    fn tilde_pair_of_a_vector_with_itself_is_twice_tilde_squared() {
        let g = Graph::new();
        let v = Vector::<BodyFrame>::new(["x", "y", "z"].map(|a| g.symbol(a, Stage::Parameter)));
        let twice = g.constant(2) * Symmetric::tilde_squared(v);
        assert_equal(&g, Symmetric::tilde_pair(v, v), twice);
    }
}
