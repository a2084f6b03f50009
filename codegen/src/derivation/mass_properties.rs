//! Mass, first moment and inertia of one body or of several, moved from origin to origin.

use super::chain::{Coordinate, Link};
use super::heading::Heading;
use super::script::{Script, pairs, sextuple, triple};
use super::wrench::Wrench;
use crate::graph::{Expr, Graph};
use crate::kinds;
use crate::space::{Carrier, Frame, Own, Symmetric, Vector};

/// Mass, first moment and inertia of a set of bodies, about the current origin.
#[derive(Clone, Copy)]
pub(super) struct MassProperties<'g, F = Own> {
    pub(super) mass: Expr<'g>,
    pub(super) first_moment: Vector<'g, F>,
    pub(super) inertia: Symmetric<'g, F>,
}

impl<'g, F: Frame> MassProperties<'g, F> {
    pub(super) fn zero(graph: &'g Graph) -> Self {
        Self {
            mass: graph.zero(),
            first_moment: Vector::zero(graph),
            inertia: Symmetric::zero(graph),
        }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first_moment: self.first_moment + other.first_moment,
            inertia: self.inertia + other.inertia,
        }
    }

    /// Every number changed alike.
    pub(super) fn map(self, mut f: impl FnMut(Expr<'g>) -> Expr<'g>) -> Self {
        Self {
            mass: f(self.mass),
            first_moment: Vector::new(self.first_moment.components().map(&mut f)),
            inertia: Symmetric::new(self.inertia.entries().map(f)),
        }
    }

    /// What is left without `other`.
    pub(super) fn less(self, other: Self) -> Self {
        Self {
            mass: self.mass - other.mass,
            first_moment: self.first_moment - other.first_moment,
            inertia: self.inertia - other.inertia,
        }
    }

    /// About a point from which the present origin lies at `arm` (parallel axis theorem).
    pub(super) fn shifted(self, arm: Vector<'g, F>) -> Self {
        let inertia = self.inertia
            + Symmetric::tilde_pair(arm, self.first_moment)
            + self.mass * Symmetric::tilde_squared(arm);
        Self { first_moment: self.first_moment + self.mass * arm, inertia, ..self }
    }

    /// What a unit acceleration along or about `axis` requires.
    pub(super) fn moved(self, coordinate: Coordinate<'g>, axis: Vector<'g, F>) -> Wrench<'g, F> {
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
    pub(super) fn of(link: &Link<'g>, data: &kinds::Link, script: &mut Script<'g>) -> Self {
        let (body, origin) = (&data.body, data.body.origin);
        let made = Self {
            mass: link.mass,
            first_moment: link.mass * link.centre,
            inertia: link.inertia + link.mass * Symmetric::tilde_squared(link.centre),
        };
        let heading = Heading::of(format!("The {} about its origin", body.title));
        let heading = heading.cited("inertia as in", body.equations.i_b);
        script.section("own", heading.part("first moment", "kg m").part("inertia", "kg m²"));
        let names = triple(&format!("mr_{}_{origin}", body.point), body.frame);
        script.names(pairs(names, made.first_moment.components()));
        script
            .names(pairs(sextuple(&format!("i_{}_{origin}", body.frame)), made.inertia.entries()));
        made
    }

    /// What a unit acceleration of its joint requires.
    pub(super) fn column(self, link: &Link<'g>) -> Wrench<'g, Own> {
        self.moved(link.coordinate, link.axis)
    }

    /// Expressed in the parent body's axes, about the same origin.
    pub(super) fn turned_back(self, link: &Link<'g>) -> MassProperties<'g, Carrier> {
        let back = link.turn.inverse();
        MassProperties {
            mass: self.mass,
            first_moment: self.first_moment.turned(back),
            inertia: self.inertia.turned(back),
        }
    }

    /// Expressed in the parent body's axes, about its origin.
    pub(super) fn carried(self, link: &Link<'g>) -> Self {
        self.turned_back(link).shifted(link.origin).handed_back()
    }

    /// Names the outboard composite of a joint.
    pub(super) fn name(&self, data: &kinds::Link, script: &mut Script<'g>) {
        let (body, assembly) = (&data.body, data.assembly);
        let (origin, letter) = (body.origin, body.letters[0]);
        let whole = assembly.to_uppercase();
        let heading =
            Heading::of(format!("{whole}, the {} and the bodies outboard of it", body.title));
        let heading = heading.equation(body.equations.assembly).part("mass", "kg").about(letter);
        script.section("lump", heading.part("first moment", "kg m").part("inertia", "kg m²"));
        script.name(format!("m_{assembly}"), self.mass);
        let names = triple(&format!("mr_{assembly}_{origin}"), body.frame);
        script.names(pairs(names, self.first_moment.components()));
        let names = sextuple(&format!("i_{assembly}_{origin}"));
        script.names(pairs(names, self.inertia.entries()));
    }
}

impl<'g> MassProperties<'g, Carrier> {
    /// Towards the hub: the parent body's frame is the next body's own.
    pub(super) fn handed_back(self) -> MassProperties<'g> {
        MassProperties {
            mass: self.mass,
            first_moment: self.first_moment.handed_back(),
            inertia: self.inertia.handed_back(),
        }
    }
}
