//! Motion of each joint's parent body, from the hub outwards, no joint accelerating.
//!
//! Points fixed in a body have the acceleration of its origin, and `[alpha~] + [omega~]^2` times
//! the place from there. The hub's own part is the same for all and is added by the solver with the
//! hub's inertia; here are its rates, expressed in each body's axes.

use super::base_parameters::{Based, origin_words};
use super::first_origin::OriginAxes;
use crate::derivation::chain::{Chain, Coordinate};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, triple};
use crate::graph::Expr;
use crate::space::{BodyFrame, Frame, Vector};

/// Motion of a joint's parent body, expressed in axes in which the joint's axis is a coordinate
/// axis.
#[derive(Clone, Copy)]
pub(super) struct ParentMotion<'g, F> {
    /// Angular velocity.
    pub(super) omega: Vector<'g, F>,
    /// Angular acceleration.
    pub(super) alpha: Vector<'g, F>,
    /// Acceleration of the joint's origin, without the hub's.
    pub(super) origin: Vector<'g, F>,
}

impl<'g, F: Frame> ParentMotion<'g, F> {
    /// The hub, whose own angular acceleration is added by the solver; `origin` is what its rotation
    /// makes of the first joint's origin, or zero where that is added to each row.
    pub(super) fn hub(omega: Vector<'g, F>, origin: Vector<'g, F>) -> Self {
        Self { omega, alpha: Vector::zero(omega.components()[0].graph()), origin }
    }

    /// Entry of `[alpha~] + [omega~]^2`, off the diagonal.
    fn beside(&self, row: usize, column: usize) -> Expr<'g> {
        let (omega, alpha) = (self.omega.components(), self.alpha.components());
        let product = omega[row] * omega[column];
        let other = alpha[3 - row - column];
        // [a~]_xy = -a_z, [a~]_yx = a_z, and so on around.
        if (row + 1) % 3 == column { product - other } else { product + other }
    }

    /// `alpha x r + omega x (omega x r)`.
    pub(super) fn field(&self, r: Vector<'g, F>) -> Vector<'g, F> {
        let r = r.components();
        let square = self.omega.components().map(Expr::squared);
        Vector::new([0, 1, 2].map(|row| {
            let [i, j] = [(row + 1) % 3, (row + 2) % 3];
            let beside = self.beside(row, i) * r[i] + self.beside(row, j) * r[j];
            beside - (square[i] + square[j]) * r[row]
        }))
    }
}

/// Motion of the parent body of each joint but the first, whose parent body is the `hub`, expressed in
/// the first body's axes.
pub(super) fn parent_motions<'g>(
    chain: &Chain<'g>,
    based: &Based<'g>,
    hub: ParentMotion<'g, BodyFrame>,
    script: &mut Script<'g>,
) -> Vec<ParentMotion<'g, BodyFrame>> {
    let mut before = hub;
    let mut list = Vec::new();
    for (k, next) in based.links.iter().enumerate().skip(chain.first_moving() + 1) {
        let (link, data) = (&chain.links[k - 1], &chain.kind.links[k - 1]);
        let [frame, letter] = [data.body.frame, data.body.letters[0]];
        let spin = link.spin();
        let omega = before.omega + spin;
        let heading = Heading::new(format!("ω_{{{letter}/N}}")).equation(data.body.equations.omega);
        script.section("rate", heading.axes("its own axes").unit("rad/s"));
        script.names(pairs(triple(&format!("omega_{frame}_n"), frame), omega.components()));
        let alpha = before.alpha + before.omega.cross(spin);
        let heading = Heading::new("Its derivative, no joint accelerating");
        let heading = heading.cited("as in", data.body.equations.h_dot);
        script.section("turn", heading.axes("the same axes").unit("rad/s²"));
        script.names(pairs(triple(&format!("alpha_{frame}"), frame), alpha.components()));
        // Coriolis: the body slides along one that turns.
        let origin = match link.coordinate {
            Coordinate::Angle(_) => before.origin,
            Coordinate::Length(_) => {
                let turning = before.omega.cross(link.rate * link.axis);
                before.origin + turning + turning
            }
        };
        let own = ParentMotion { omega, alpha, origin };
        let place = next.origin.relabelled_inboard();
        let origin = origin + own.field(place);
        let (outer, body) = (&chain.kind.links[k].body, data.body.title);
        let heading = Heading::new(format!(
            "Acceleration of {}, no joint accelerating, without that of B{}",
            origin_words(chain, k),
            if OriginAxes::choose(chain, based) == OriginAxes::FirstBody {
                ""
            } else {
                " and the hub's part"
            },
        ));
        let axes = format!("the axes of the {body}");
        script.section("path", heading.equation("(D5)").axes(axes).unit("m/s²"));
        script
            .names(pairs(triple(&format!("r_{}_rest", outer.origin), frame), origin.components()));
        let parent = ParentMotion { origin, ..own };
        list.push(parent);
        let turned = |v: Vector<'g, BodyFrame>| v.relabelled_outboard().turned(chain.links[k].turn);
        before = ParentMotion {
            omega: turned(parent.omega),
            alpha: turned(parent.alpha),
            origin: turned(parent.origin),
        };
    }
    list
}
