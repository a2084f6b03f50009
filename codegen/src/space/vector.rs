//! Three components along the axes of a frame, and the transport theorem.

use std::marker::PhantomData;
use std::ops::{Add, Mul, Neg, Sub};

use super::frame::{Axis, BodyFrame, Frame, Hub, ParentFrame, Turn};
use crate::graph::{Expr, Graph, Stage};

/// Suffixes of three components.
pub const XYZ: [&str; 3] = ["x", "y", "z"];

/// A vector resolved along the axes of `F`. Vectors of two frames do not mix.
pub struct Vector<'g, F> {
    components: [Expr<'g>; 3],
    frame: PhantomData<F>,
}

impl<F> Clone for Vector<'_, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F> Copy for Vector<'_, F> {}

impl<'g, F: Frame> Vector<'g, F> {
    /// From components along x, y, z.
    #[must_use]
    pub fn new(components: [Expr<'g>; 3]) -> Self {
        Self { components, frame: PhantomData }
    }

    /// The zero vector.
    #[must_use]
    pub fn zero(graph: &'g Graph) -> Self {
        Self::new([graph.zero(); 3])
    }

    /// The unit vector along `axis`.
    #[must_use]
    pub fn unit(graph: &'g Graph, axis: Axis) -> Self {
        let mut components = [graph.zero(); 3];
        components[axis.cycle()[0]] = graph.constant(1);
        Self::new(components)
    }

    /// The components along x, y, z.
    #[must_use]
    pub fn components(self) -> [Expr<'g>; 3] {
        self.components
    }

    /// `self . other`.
    #[must_use]
    pub fn dot(self, other: Self) -> Expr<'g> {
        let ([a, b, c], [x, y, z]) = (self.components, other.components);
        a * x + b * y + c * z
    }

    /// `self x other`.
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.components, other.components);
        Self::new([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// The time derivative seen from the frame against which `F` turns at `omega`:
    /// the transport theorem, `u' = du/dt + omega x u`.
    #[must_use]
    pub fn prime(self, omega: Self) -> Self {
        self.component_rates() + omega.cross(self)
    }

    /// `du/dt` as an observer on `F` sees it: component by component.
    #[must_use]
    pub fn component_rates(self) -> Self {
        self.map(Expr::time_derivative)
    }

    /// `d self / d x`, component by component.
    #[must_use]
    pub fn partial(self, x: Expr<'g>) -> Self {
        self.map(|e| e.partial(x))
    }

    /// The part without symbols of `stage`.
    #[must_use]
    pub fn without(self, stage: Stage) -> Self {
        self.map(|e| e.without(stage))
    }

    /// The same vector along the axes that `turn` leads to.
    #[must_use]
    pub fn turned<To: Frame>(self, turn: Turn<'g, F, To>) -> Vector<'g, To> {
        let [k, i, j] = turn.axis.cycle();
        let (v, s, c) = (self.components, turn.sin, turn.cos);
        let mut made = v;
        made[k] = v[k];
        made[i] = c * v[i] + s * v[j];
        made[j] = c * v[j] - s * v[i];
        Vector::new(made)
    }

    /// The vector whose components along `axes` these are.
    #[must_use]
    pub fn along<To: Frame>(self, axes: [Vector<'g, To>; 3]) -> Vector<'g, To> {
        let [x, y, z] = self.components();
        x * axes[0] + y * axes[1] + z * axes[2]
    }

    fn map(self, f: impl FnMut(Expr<'g>) -> Expr<'g>) -> Self {
        Self::new(self.components.map(f))
    }
}

impl<'g> Vector<'g, BodyFrame> {
    /// Away from the hub: this body's frame is the parent frame of the next joint.
    #[must_use]
    pub fn relabelled_outboard(self) -> Vector<'g, ParentFrame> {
        Vector::new(self.components)
    }
}

impl<'g> Vector<'g, ParentFrame> {
    /// Towards the hub: the parent body's frame is the next body's own.
    #[must_use]
    pub fn relabelled_inboard(self) -> Vector<'g, BodyFrame> {
        Vector::new(self.components)
    }

    /// The hub is the parent body of the first joint.
    #[must_use]
    pub fn on_hub(self) -> Vector<'g, Hub> {
        Vector::new(self.components)
    }
}

impl<'g> Vector<'g, Hub> {
    /// The hub is the parent body of the first joint.
    #[must_use]
    pub fn as_parent_frame(self) -> Vector<'g, ParentFrame> {
        Vector::new(self.components)
    }
}

impl<F: Frame> Add for Vector<'_, F> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.components, other.components);
        Self::new([a + x, b + y, c + z])
    }
}

impl<F: Frame> Sub for Vector<'_, F> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<F: Frame> Neg for Vector<'_, F> {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|e| -e)
    }
}

impl<'g, F: Frame> Mul<Vector<'g, F>> for Expr<'g> {
    type Output = Vector<'g, F>;
    fn mul(self, v: Vector<'g, F>) -> Vector<'g, F> {
        v.map(|e| self * e)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal::Ring;

    fn symbols<'g, F: Frame>(g: &'g Graph, name: &str) -> Vector<'g, F> {
        Vector::new(
            ["x", "y", "z"].map(|axis| g.symbol(&format!("{name}_{axis}"), Stage::Parameter)),
        )
    }

    fn assert_equal<F: Frame>(g: &Graph, a: Vector<'_, F>, b: Vector<'_, F>) {
        let mut ring = Ring::new(g);
        for component in (a - b).components() {
            assert!(ring.normal(component).unwrap().is_empty());
        }
    }

    #[test]
    fn prime_of_body_fixed_vector_is_omega_cross_it() {
        let g = Graph::new();
        let (u, omega) = (symbols::<BodyFrame>(&g, "u"), symbols(&g, "w"));
        assert_equal(&g, u.prime(omega), omega.cross(u));
    }

    #[test]
    fn turning_there_and_back_changes_nothing() {
        let g = Graph::new();
        let (sin, cos) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let turn = Turn::<ParentFrame, BodyFrame>::about(axis, sin, cos);
            let u = symbols::<ParentFrame>(&g, "u");
            assert_equal(&g, u.turned(turn).turned(turn.inverse()), u);
        }
    }

    #[test]
    fn a_quarter_turn_about_z_takes_new_x_to_old_y() {
        let g = Graph::new();
        let turn = Turn::<ParentFrame, BodyFrame>::about(Axis::Z, g.constant(1), g.constant(0));
        let new_x = Vector::<BodyFrame>::unit(&g, Axis::X).turned(turn.inverse());
        assert_equal(&g, new_x, Vector::unit(&g, Axis::Y));
    }

    #[test]
    fn transport_theorem_agrees_with_components_in_the_fixed_frame() {
        let g = Graph::new();
        let rate = g.symbol("q_dot", Stage::Rate);
        let (sin, cos) = g.angle("q", rate);
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let turn = Turn::<ParentFrame, BodyFrame>::about(axis, sin, cos);
            let u = symbols::<BodyFrame>(&g, "u");
            let moving = u.prime(rate * Vector::unit(&g, axis)).turned(turn.inverse());
            assert_equal(&g, moving, u.turned(turn.inverse()).component_rates());
        }
    }
}
