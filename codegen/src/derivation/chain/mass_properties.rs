//! Mass, first moment and inertia of one body or of several, moved from origin to origin.

use super::wrench::Wrench;
use super::{Coordinate, Link};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, sextuple, triple};
use crate::graph::{Expr, Graph};
use crate::kinds;
use crate::space::{BodyFrame, Frame, ParentFrame, Symmetric, Vector};

/// Mass, first moment and inertia of a set of bodies, about the current origin.
#[derive(Clone, Copy)]
pub(crate) struct MassProperties<'g, F = BodyFrame> {
    pub(crate) mass: Expr<'g>,
    pub(crate) first_moment: Vector<'g, F>,
    pub(crate) inertia: Symmetric<'g, F>,
}

impl<'g, F: Frame> MassProperties<'g, F> {
    pub(crate) fn zero(graph: &'g Graph) -> Self {
        Self {
            mass: graph.zero(),
            first_moment: Vector::zero(graph),
            inertia: Symmetric::zero(graph),
        }
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first_moment: self.first_moment + other.first_moment,
            inertia: self.inertia + other.inertia,
        }
    }

    /// Every number changed alike.
    pub(crate) fn map(self, mut f: impl FnMut(Expr<'g>) -> Expr<'g>) -> Self {
        Self {
            mass: f(self.mass),
            first_moment: Vector::new(self.first_moment.components().map(&mut f)),
            inertia: Symmetric::new(self.inertia.entries().map(f)),
        }
    }

    /// What is left without `other`.
    pub(crate) fn less(self, other: Self) -> Self {
        Self {
            mass: self.mass - other.mass,
            first_moment: self.first_moment - other.first_moment,
            inertia: self.inertia - other.inertia,
        }
    }

    /// About a point from which the present origin lies at `arm` (parallel axis theorem).
    pub(crate) fn shifted(self, arm: Vector<'g, F>) -> Self {
        let inertia = self.inertia
            + Symmetric::tilde_pair(arm, self.first_moment)
            + self.mass * Symmetric::tilde_squared(arm);
        Self { first_moment: self.first_moment + self.mass * arm, inertia, ..self }
    }

    /// What a unit acceleration along or about `axis` requires.
    pub(crate) fn moved(self, coordinate: Coordinate<'g>, axis: Vector<'g, F>) -> Wrench<'g, F> {
        match coordinate {
            Coordinate::Angle(_) => {
                Wrench { force: axis.cross(self.first_moment), moment: self.inertia.times(axis) }
            }
            Coordinate::Length(_) => {
                Wrench { force: self.mass * axis, moment: self.first_moment.cross(axis) }
            }
        }
    }
}

impl<'g> MassProperties<'g> {
    /// One body about its joint's origin: parameters only.
    pub(crate) fn of_body(link: &Link<'g>, data: &kinds::Link, script: &mut Script<'g>) -> Self {
        let (body, origin) = (&data.body, data.body.origin);
        let made = Self {
            mass: link.mass,
            first_moment: link.mass * link.centre,
            inertia: link.inertia + link.mass * Symmetric::tilde_squared(link.centre),
        };
        let heading = Heading::new(format!("The {} about its origin", body.title));
        let heading = heading.cited("inertia as in", body.equations.i_b);
        script.section("own", heading.part("first moment", "kg m").part("inertia", "kg m²"));
        let names = triple(&format!("mr_{}_{origin}", body.point), body.frame);
        script.names(pairs(names, made.first_moment.components()));
        script
            .names(pairs(sextuple(&format!("i_{}_{origin}", body.frame)), made.inertia.entries()));
        made
    }

    /// What a unit acceleration of its joint requires.
    pub(crate) fn column(self, link: &Link<'g>) -> Wrench<'g, BodyFrame> {
        self.moved(link.coordinate, link.axis)
    }

    /// Expressed in the parent body's axes, about the same origin.
    pub(crate) fn in_parent_axes(self, link: &Link<'g>) -> MassProperties<'g, ParentFrame> {
        let back = link.turn.inverse();
        MassProperties {
            mass: self.mass,
            first_moment: self.first_moment.turned(back),
            inertia: self.inertia.turned(back),
        }
    }

    /// Expressed in the parent body's axes, about its origin.
    pub(crate) fn in_parent_frame(self, link: &Link<'g>) -> Self {
        self.in_parent_axes(link).shifted(link.origin).relabelled_inboard()
    }

    /// Names the outboard composite of a joint.
    pub(crate) fn name(&self, data: &kinds::Link, script: &mut Script<'g>) {
        let (body, assembly) = (&data.body, data.assembly);
        let (origin, letter) = (body.origin, body.letters[0]);
        let whole = assembly.to_uppercase();
        let heading =
            Heading::new(format!("{whole}, the {} and the bodies outboard of it", body.title));
        let heading = heading.equation(body.equations.assembly).part("mass", "kg").about(letter);
        script.section("lump", heading.part("first moment", "kg m").part("inertia", "kg m²"));
        script.name(format!("m_{assembly}"), self.mass);
        let names = triple(&format!("mr_{assembly}_{origin}"), body.frame);
        script.names(pairs(names, self.first_moment.components()));
        let names = sextuple(&format!("i_{assembly}_{origin}"));
        script.names(pairs(names, self.inertia.entries()));
    }
}

impl<'g> MassProperties<'g, ParentFrame> {
    /// Towards the hub: the parent body's frame is the next body's own.
    pub(crate) fn relabelled_inboard(self) -> MassProperties<'g> {
        MassProperties {
            mass: self.mass,
            first_moment: self.first_moment.relabelled_inboard(),
            inertia: self.inertia.relabelled_inboard(),
        }
    }
}
