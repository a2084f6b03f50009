//! A force with its moment: across a joint, at a mount, on a body from outside.

use core::ops::Neg;

use nalgebra::Vector3;

use crate::model::kind::JointInfo;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::{
    Columns, Vec3, add, components, cross, dot, finite, rotate, rotate_transposed, sub, vector,
    zeros,
};

/// A force and its moment about a point, expressed in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<T = f64> {
    /// Force, N.
    pub force: Vector3<T>,
    /// Moment about the point that each use names, N m.
    pub moment: Vector3<T>,
}

impl<T: Scalar> Wrench<T> {
    /// Nothing.
    #[must_use]
    pub fn none() -> Self {
        Self { force: vector(zeros()), moment: vector(zeros()) }
    }

    /// A force through a point, `moment = point x force`, both expressed in one frame,
    /// the point from its origin.
    #[must_use]
    pub fn at(point: &Vector3<T>, force: &Vector3<T>) -> Self {
        let moment = cross(components(point), components(force));
        Self { force: *force, moment: vector(moment) }
    }

    /// Only a torque.
    #[must_use]
    pub fn torque(torque: &Vector3<T>) -> Self {
        Self { force: vector(zeros()), moment: *torque }
    }

    /// The same wrench about another point, from which the present one is at `arm`, expressed in
    /// the same axes, m: `moment + arm x force`.
    #[must_use]
    pub fn moved(&self, arm: &Vector3<T>) -> Self {
        self.plus(&Self { force: vector(zeros()), ..Self::at(arm, &self.force) })
    }

    /// The sum of two wrenches about one point, expressed in the same axes.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        self.with(other, add)
    }

    /// The difference of two wrenches about one point, expressed in the same axes.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.with(other, sub)
    }

    fn with(&self, other: &Self, of: fn(Vec3<T>, Vec3<T>) -> Vec3<T>) -> Self {
        Self::of(
            of(components(&self.force), components(&other.force)),
            of(components(&self.moment), components(&other.moment)),
        )
    }

    /// From its components.
    pub(crate) fn of(force: Vec3<T>, moment: Vec3<T>) -> Self {
        Self { force: vector(force), moment: vector(moment) }
    }

    /// Expressed in the axes in which the columns are expressed, from the columns.
    pub(crate) fn turned(&self, axes: &Columns<T>) -> Self {
        let turn = |v: &Vector3<T>| rotate(axes, components(v));
        Self::of(turn(&self.force), turn(&self.moment))
    }

    /// Expressed in the columns.
    pub(crate) fn turned_back(&self, axes: &Columns<T>) -> Self {
        let turn = |v: &Vector3<T>| rotate_transposed(axes, components(v));
        Self::of(turn(&self.force), turn(&self.moment))
    }

    /// The component of a wrench along a joint, about its origin and expressed in its child body:
    /// the moment about its axis, or the force along it.
    pub(crate) fn along(&self, joint: &JointInfo) -> T {
        let [x, y, z] = components(if joint.slides { &self.force } else { &self.moment });
        match joint.axis {
            0 => x,
            1 => y,
            _ => z,
        }
    }

    /// Whether all components are finite.
    pub(crate) fn is_finite(&self) -> bool {
        finite(components(&self.force)) && finite(components(&self.moment))
    }

    /// The power at the velocity of its point and the angular velocity.
    pub(crate) fn power(&self, velocity: Vec3<T>, omega: Vec3<T>) -> T {
        dot(components(&self.force), velocity) + dot(components(&self.moment), omega)
    }
}

impl<T: Scalar> Neg for Wrench<T> {
    type Output = Self;

    /// The reaction.
    fn neg(self) -> Self {
        Self::none().minus(&self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_at_a_point_has_its_moment() {
        let wrench = Wrench::at(&Vector3::new(0.0, 2.0, 0.0), &Vector3::new(0.0, 0.0, 3.0));
        assert_eq!(wrench.moment, Vector3::new(6.0, 0.0, 0.0));
        // About a point 2 m further down the y axis the arm is doubled.
        assert_eq!(wrench.moved(&Vector3::new(0.0, 2.0, 0.0)).moment, Vector3::new(12.0, 0.0, 0.0));
    }

    #[test]
    fn power_is_that_of_force_and_moment() {
        let wrench = Wrench::of([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        assert_eq!(wrench.power([1.0, 0.0, 1.0], [0.0, 1.0, 0.0]), 9.0);
        assert_eq!(wrench.plus(&wrench).minus(&wrench), wrench);
    }
}
