//! One joint: Coriolis and centrifugal wrench of its rate (D8), and its own equation (D9).

use super::parent_motion::ParentMotion;
use crate::derivation::chain::Coordinate;
use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::wrench::Wrench;
use crate::graph::Expr;
use crate::space::{Axis, Frame, Vector};

/// A joint and the bodies outboard of it, expressed in axes in which its own is a coordinate axis.
#[derive(Clone, Copy)]
pub(super) struct AtJoint<'g, F> {
    pub(super) axis: Axis,
    pub(super) coordinate: Coordinate<'g>,
    pub(super) rate: Expr<'g>,
    /// Outboard composite, about the joint's origin.
    pub(super) composite: MassProperties<'g, F>,
    /// Motion of the parent body.
    pub(super) parent: ParentMotion<'g, F>,
}

impl<'g, F: Frame> AtJoint<'g, F> {
    /// (D8): what the joint's rate adds to force and moment of the outboard composite, about the
    /// joint's origin. With `a` the axis of a turning joint, `2 q' [omega~][a~] + q'^2 [a~]^2` is
    /// added to the parent's field of acceleration; with that of a sliding one, `2 q' omega x a`.
    /// Neither has a part in the joint's own equation.
    pub(super) fn of_rate(&self) -> Wrench<'g, F> {
        let [k, i, j] = self.axis.cycle();
        let omega = self.parent.omega.components();
        let moment = self.composite.first_moment.components();
        let placed = |along, first, second| {
            let mut components = [along; 3];
            (components[i], components[j]) = (first, second);
            Vector::new(components)
        };
        let zero = self.rate.graph().zero();
        match self.coordinate {
            Coordinate::Angle(_) => {
                let inertia = self.composite.inertia;
                let (u, v) = (self.rate * omega[i], self.rate * omega[j]);
                // q' (2 omega_k + q'), by the angular velocity of what is turned.
                let e = self.rate * (omega[k] + (self.rate + omega[k]));
                let along = u * moment[i] + v * moment[j];
                let force = placed(along + along, -(e * moment[i]), -(e * moment[j]));
                let product = inertia.at(i, j) + inertia.at(i, j);
                let (ki, kj, kk) = (inertia.at(k, i), inertia.at(k, j), inertia.at(k, k));
                let difference = inertia.at(i, i) - inertia.at(j, j);
                let first = v * (kk + difference) - u * product - e * kj;
                let second = e * ki + v * product - u * (kk - difference);
                Wrench { force, moment: placed(zero, first, second) }
            }
            Coordinate::Length(_) => {
                let (u, v) = (self.rate * omega[i], self.rate * omega[j]);
                let twice = placed(zero, v + v, -(u + u));
                Wrench {
                    force: self.composite.mass * twice,
                    moment: self.composite.first_moment.cross(twice),
                }
            }
        }
    }

    /// (D9): the joint row of what the parent body's field of acceleration requires.
    pub(super) fn of_field(&self) -> Expr<'g> {
        let [k, i, j] = self.axis.cycle();
        let ParentMotion { omega, alpha, origin } = self.parent;
        let (moment, p) = (self.composite.first_moment.components(), origin.components());
        match self.coordinate {
            Coordinate::Angle(_) => {
                let inertia = self.composite.inertia;
                let (omega, alpha) = (omega.components(), alpha.components());
                let lever = moment[i] * p[j] - moment[j] * p[i];
                let (ki, kj, kk) = (inertia.at(k, i), inertia.at(k, j), inertia.at(k, k));
                let difference = inertia.at(i, i) - inertia.at(j, j);
                let squares = omega[i].squared() - omega[j].squared();
                let beside = ki * (alpha[i] - omega[j] * omega[k])
                    + kj * (alpha[j] + omega[i] * omega[k])
                    + kk * alpha[k];
                let across = squares * inertia.at(i, j) - difference * (omega[i] * omega[j]);
                lever + (beside + across)
            }
            Coordinate::Length(_) => {
                self.composite.mass * p[k]
                    + self.parent.field(self.composite.first_moment).components()[k]
            }
        }
    }
}
