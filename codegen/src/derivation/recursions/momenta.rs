//! [`Momenta`]: twice the momentum of a composite about a joint's origin, and twice its moment.
//!
//! With r from the origin and v the velocity relative to it, seen from N, the momentum is `p = sum m v`, and the moment
//! that an angular velocity e adds by Coriolis' term is `sum m r x (2 e x v) = Y e`, with
//! `Y = 2 sum m ((r . v) 1 - v r^T)`.

use crate::derivation::chain::Link;
use crate::derivation::chain::mass_properties::MassProperties;
use crate::graph::{Expr, Graph};
use crate::space::{BodyFrame, Frame, Symmetric, Turn, Vector};

/// Of the bodies outboard of a joint, about its origin.
#[derive(Clone, Copy)]
pub(super) struct Momenta<'g> {
    /// `2 p`.
    pub(super) momentum: Vector<'g, BodyFrame>,
    /// `Y`, by rows.
    pub(super) moment: [Vector<'g, BodyFrame>; 3],
}

impl<'g> Momenta<'g> {
    pub(super) fn zero(graph: &'g Graph) -> Self {
        Self { momentum: Vector::zero(graph), moment: [Vector::zero(graph); 3] }
    }

    /// Of a rigid body whose angular velocity is `omega`: `Y = -tilde(omega) (tr(I) 1 - 2 I)`.
    pub(super) fn of_body(body: &MassProperties<'g>, omega: Vector<'g, BodyFrame>) -> Self {
        let MassProperties { first_moment, inertia, .. } = *body;
        let [_, xy, xz, _, yz, _] = inertia.entries().map(|entry| -(entry + entry));
        let [a, b, c] = [0, 1, 2].map(|i| {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            inertia.at(j, j) + inertia.at(k, k) - inertia.at(i, i)
        });
        let second = Symmetric::<BodyFrame>::new([a, xy, xz, b, yz, c]);
        let rows = [0, 1, 2].map(|i| Vector::new([0, 1, 2].map(|j| second.at(i, j))));
        let [x, y, z] = omega.components();
        let twice_omega = omega + omega;
        Self {
            momentum: twice_omega.cross(first_moment),
            moment: [
                z * rows[1] - y * rows[2],
                x * rows[2] - z * rows[0],
                y * rows[0] - x * rows[1],
            ],
        }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        let [a, b, c] = self.moment;
        let [x, y, z] = other.moment;
        Self { momentum: self.momentum + other.momentum, moment: [a + x, b + y, c + z] }
    }

    /// `Y e`.
    pub(super) fn times(&self, e: Vector<'g, BodyFrame>) -> Vector<'g, BodyFrame> {
        Vector::new(self.moment.map(|row| row.dot(e)))
    }

    /// `Y^T e`.
    pub(super) fn transposed_times(&self, e: Vector<'g, BodyFrame>) -> Vector<'g, BodyFrame> {
        let ([a, b, c], [x, y, z]) = (self.moment, e.components());
        x * a + y * b + z * c
    }

    /// Expressed in the parent body's axes, about its origin, from which the present one lies at `arm` and moves at
    /// half of `twice_u`; `composite` is expressed in the parent body's axes, about the present origin.
    pub(super) fn in_parent_frame(
        self,
        link: &Link<'g>,
        composite: &MassProperties<'g>,
        twice_u: Vector<'g, BodyFrame>,
    ) -> Self {
        let (arm, s) = (link.origin.relabelled_inboard(), composite.first_moment);
        let back = link.turn.inverse();
        let turned = self.momentum.turned(back).relabelled_inboard();
        let momentum = turned + composite.mass * twice_u;
        let diagonal = s.dot(twice_u) + arm.dot(momentum);
        let rows = turned_rows(self.moment, back).map(Vector::relabelled_inboard);
        let (u, p) = (twice_u.components(), momentum.components());
        let moment = [0, 1, 2].map(|i| {
            let mut row = (rows[i] - u[i] * s - p[i] * arm).components();
            row[i] = row[i] + diagonal;
            Vector::new(row)
        });
        Self { momentum, moment }
    }
}

/// The rows of a square matrix along the axes that `turn` leads to. In the plane of the turn its symmetric part turns as
/// that of a symmetric tensor, and its antisymmetric part stays.
fn turned_rows<'g, From: Frame, To: Frame>(
    rows: [Vector<'g, From>; 3],
    turn: Turn<'g, From, To>,
) -> [Vector<'g, To>; 3] {
    let m = rows.map(Vector::components);
    if turn.is_none() {
        return m.map(Vector::new);
    }
    let ([k, i, j], [sin, cos]) = turn.plane();
    let mut made = m;
    let across = sin * (m[j][j] - m[i][i]) + cos * (m[i][j] + m[j][i]);
    let moved = sin * across;
    let off: Expr<'g> = cos * across;
    made[i][i] = m[i][i] + moved;
    made[j][j] = m[j][j] - moved;
    made[i][j] = off - m[j][i];
    made[j][i] = off - m[i][j];
    made[k][i] = cos * m[k][i] + sin * m[k][j];
    made[k][j] = cos * m[k][j] - sin * m[k][i];
    made[i][k] = cos * m[i][k] + sin * m[j][k];
    made[j][k] = cos * m[j][k] - sin * m[i][k];
    made.map(Vector::new)
}
