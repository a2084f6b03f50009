//! The functions beside the equations of motion: `axes`, `loads`, `external`, `gravity`.

use std::rc::Rc;

use nalgebra::{Matrix3, Vector3};

use super::kinematics::unit;
use super::{Device, Fault};
use crate::mutation::state::{Accelerations, Case, Motion, Wrench};
use crate::mutation::tape::Returned;
use precess_codegen::derivation::recursions::external::acting;
use precess_codegen::derivation::recursions::gravity::gradient;
use precess_codegen::kinds;

/// Origin and axes of a body, expressed in B.
pub(in crate::mutation) struct BodyPose {
    /// Its axes, as columns.
    pub(in crate::mutation) axes: Matrix3<f64>,
    /// Origin of its joint.
    pub(in crate::mutation) origin: Vector3<f64>,
}

/// Wrenches at the joints, along B, each about its joint's origin; and about B.
pub(in crate::mutation) struct JointWrenches {
    pub(in crate::mutation) joints: Vec<Wrench>,
    pub(in crate::mutation) whole: Wrench,
    /// Along each joint.
    pub(in crate::mutation) drives: Vec<f64>,
}

/// What a field does.
pub(in crate::mutation) struct FieldLoads {
    /// On each body, along B, about its joint's origin.
    pub(in crate::mutation) bodies: Vec<Wrench>,
    pub(in crate::mutation) second_moment: Matrix3<f64>,
}

impl Device<'_, '_> {
    /// `axes`.
    pub(in crate::mutation) fn poses(
        &self,
        case: &Case,
        motion: &Motion,
        fault: &Fault,
    ) -> Rc<[BodyPose]> {
        let function = self.functions.axes;
        fault.result(
            |known| &known.poses,
            &[function],
            case,
            motion,
            || {
                let returned = self.call(function, &self.arguments(case, motion), fault);
                let stand = |link: &kinds::Link| {
                    let frame = link.body.frame;
                    let column = |axis: &str| returned.vector(&format!("{frame}_{axis}"), "b");
                    BodyPose {
                        axes: Matrix3::from_columns(&["x", "y", "z"].map(column)),
                        origin: returned.vector(&format!("origin_{frame}"), "b"),
                    }
                };
                self.chain.kind.links.iter().map(stand).collect()
            },
        )
    }

    /// Axes and origins: the geometry itself, which no fault changes.
    pub(in crate::mutation) fn geometry(
        &self,
        case: &Case,
        motion: &Motion,
        fault: &Fault,
    ) -> Rc<[BodyPose]> {
        fault.result(|known| &known.geometry, &[], case, motion, || self.stood(case, motion))
    }

    fn stood(&self, case: &Case, motion: &Motion) -> Rc<[BodyPose]> {
        let mut origin = Vector3::zeros();
        let stand = |(k, link): (usize, &kinds::Link)| {
            let place = link.joint.place();
            let rest = place.map_or_else(Vector3::zeros, |place| {
                Vector3::from(place.names.map(|name| self.parameter(case, name)))
            });
            let slide = match link.joint.motion {
                kinds::Motion::Turn(_) => Vector3::zeros(),
                kinds::Motion::Slide(axis) => motion.coordinates[k] * unit(axis),
            };
            origin += self.axes(k, motion) * (rest + slide);
            BodyPose { axes: self.axes(k + 1, motion), origin }
        };
        self.chain.kind.links.iter().enumerate().map(stand).collect()
    }

    /// Centre of mass of body `k` from its joint's origin, along own axes: given.
    pub(in crate::mutation) fn centre(&self, k: usize, case: &Case) -> Vector3<f64> {
        match self.chain.kind.links[k].body.centre {
            kinds::Centre::Free(triple) => {
                Vector3::from(triple.names.map(|name| self.parameter(case, name)))
            }
            kinds::Centre::On(axis, name) => self.parameter(case, name) * unit(axis),
            kinds::Centre::At => Vector3::zeros(),
        }
    }

    /// `loads`.
    pub(in crate::mutation) fn loads(
        &self,
        case: &Case,
        any: &Accelerations,
        fault: &Fault,
    ) -> Rc<JointWrenches> {
        let find = || Rc::new(self.loaded(case, any, fault));
        fault.result(|known| &known.loads, &[self.functions.loads], case, &case.motion, find)
    }

    fn loaded(&self, case: &Case, any: &Accelerations, fault: &Fault) -> JointWrenches {
        let returned = self.moving(self.functions.loads, case, &case.motion, any, fault);
        self.carried(&returned, "load", &case.motion)
    }

    /// `external`.
    pub(in crate::mutation) fn external(
        &self,
        case: &Case,
        on_bodies: &[Wrench],
        fault: &Fault,
    ) -> Rc<JointWrenches> {
        let find = || Rc::new(self.received(case, on_bodies, fault));
        fault.result(|known| &known.external, &[self.functions.external], case, &case.motion, find)
    }

    fn received(&self, case: &Case, on_bodies: &[Wrench], fault: &Fault) -> JointWrenches {
        let mut values = self.arguments(case, &case.motion);
        for (symbols, own) in acting(self.chain).iter().zip(on_bodies) {
            values.set_vector(symbols.force.components(), own.force);
            values.set_vector(symbols.moment.components(), own.moment);
        }
        let returned = self.call(self.functions.external, &values, fault);
        self.carried(&returned, "sum", &case.motion)
    }

    /// `gravity`.
    pub(in crate::mutation) fn gravity(
        &self,
        case: &Case,
        motion: &Motion,
        field: &Matrix3<f64>,
        fault: &Fault,
    ) -> Rc<FieldLoads> {
        let find = || Rc::new(self.pulled(case, motion, field, fault));
        fault.result(|known| &known.field_loads, &[self.functions.gravity], case, motion, find)
    }

    fn pulled(
        &self,
        case: &Case,
        motion: &Motion,
        field: &Matrix3<f64>,
        fault: &Fault,
    ) -> FieldLoads {
        let mut values = self.arguments(case, motion);
        let g = gradient(self.chain.graph);
        for row in 0..3 {
            for column in 0..3 {
                values.set(g.at(row, column), field[(row, column)]);
            }
        }
        let returned = self.call(self.functions.gravity, &values, fault);
        let links = self.chain.kind.links.iter().enumerate();
        let on = |(k, link): (usize, &kinds::Link)| {
            wrench(&returned, "on", link.body.frame).turned(&self.axes(k + 1, motion))
        };
        FieldLoads {
            bodies: links.map(on).collect(),
            second_moment: returned.tensor("second_moment"),
        }
    }

    /// The wrenches of a returned record, along B.
    pub(super) fn carried(
        &self,
        returned: &Returned<'_>,
        what: &str,
        motion: &Motion,
    ) -> JointWrenches {
        let links = self.chain.kind.links;
        let own = |link: &kinds::Link| wrench(returned, what, link.body.frame);
        let at = |(k, link)| own(link).turned(&self.axes(k + 1, motion));
        let along = |link: &kinds::Link| {
            let axis: Vector3<f64> = unit(link.joint.motion.axis());
            match link.joint.motion {
                kinds::Motion::Turn(_) => axis.dot(&own(link).moment),
                kinds::Motion::Slide(_) => axis.dot(&own(link).force),
            }
        };
        JointWrenches {
            joints: links.iter().enumerate().map(at).collect(),
            whole: wrench(returned, what, "b"),
            drives: links.iter().map(along).collect(),
        }
    }
}

fn wrench(returned: &Returned<'_>, what: &str, frame: &str) -> Wrench {
    let vector = |letter: char| returned.vector(&format!("{letter}_{what}"), frame);
    Wrench { force: vector('f'), moment: vector('n') }
}
