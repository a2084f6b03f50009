//! [`PerpendicularComposite`]: the composite without inertia about the tip's axis, of
//! [two axes that can be parallel](crate::derivation::chain::parallel_axes).

use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::wrench::Wrench;
use crate::graph::Expr;
use crate::space::{Axis, BodyFrame, ParentFrame, Symmetric, Turn, Vector};

/// The composite without inertia about the tip's axis, and what the tip's joint requires of it, on
/// their way to the inboard joint.
#[derive(Clone, Copy)]
pub(super) struct PerpendicularComposite<'g> {
    axis: Axis,
    inertia: Symmetric<'g, BodyFrame>,
    column: Wrench<'g, BodyFrame>,
}

impl<'g> PerpendicularComposite<'g> {
    /// Of the tip's composite and column.
    pub(super) fn of_tip(
        axis: Axis,
        composite: &MassProperties<'g>,
        column: Wrench<'g, BodyFrame>,
    ) -> Self {
        let [k, ..] = axis.cycle();
        let zero = composite.mass.graph().zero();
        let mut moment = column.moment.components();
        moment[k] = zero;
        Self {
            axis,
            inertia: composite.inertia.with(k, k, zero),
            column: Wrench { moment: Vector::new(moment), ..column },
        }
    }

    /// With the next body inboard, expressed in the axes that `back` leads to.
    pub(super) fn with_body(
        self,
        body: &MassProperties<'g>,
        back: Turn<'g, BodyFrame, ParentFrame>,
    ) -> Self {
        let turned = |v: Vector<'g, BodyFrame>| v.turned(back).relabelled_inboard();
        Self {
            inertia: (body.inertia + self.inertia)
                .turned_from(back, self.axis)
                .relabelled_inboard(),
            column: Wrench { force: turned(self.column.force), moment: turned(self.column.moment) },
            ..self
        }
    }

    /// About a point from which the present origin lies at `arm`; the composite has this first moment.
    pub(super) fn shifted(
        self,
        arm: Vector<'g, BodyFrame>,
        composite: &MassProperties<'g>,
    ) -> Self {
        let Wrench { force, moment } = self.column;
        Self {
            inertia: MassProperties { inertia: self.inertia, ..*composite }.shifted(arm).inertia,
            column: Wrench { force, moment: moment + arm.cross(force) },
            ..self
        }
    }

    /// `A_kk` and `A_kj` along the axis of the inboard joint.
    pub(super) fn along(&self, axis: Axis) -> [Expr<'g>; 2] {
        let [k, ..] = axis.cycle();
        [self.inertia.at(k, k), self.column.moment.components()[k]]
    }
}
