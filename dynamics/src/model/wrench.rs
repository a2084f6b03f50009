//! A force with its moment: across a joint, at a mount, on a body from outside.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use core::ops::Neg;

use nalgebra::Vector3;

use crate::model::kind::JointInfo;
use crate::numbers::real::{Real, Scalar};
use crate::numbers::vec3::{
    Columns, Vec3, components, cross, dot, finite, rotate, rotate_transposed, vector, zeros,
};

/// Wrenches across the joints of a device, and their sum on the hub, about B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carried<W, B> {
    /// About each joint's origin along the axes of its child body.
    pub joints: W,
    /// About B, along the device's axes.
    pub hub: B,
}

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
        self.zip(other, |a, b| a + b)
    }

    /// The difference of two wrenches about one point, expressed in the same axes.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    /// Expressed in the columns.
    pub(crate) fn turned_back(&self, axes: &Columns<T>) -> Self {
        let turn = |v: &Vector3<T>| rotate_transposed(axes, components(v));
        Self::of(turn(&self.force), turn(&self.moment))
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

impl<T: Copy> Wrench<T> {
    /// Two wrenches joined number by number.
    #[inline(always)]
    pub(crate) fn zip<U: Copy, W>(
        &self,
        other: &Wrench<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> Wrench<W> {
        // One by one: an array's own `map` is a call, which lanes must not make.
        let ([a, b, c], [d, e, f]) = (components(&self.force), components(&other.force));
        let force = vector([join(a, d), join(b, e), join(c, f)]);
        let ([a, b, c], [d, e, f]) = (components(&self.moment), components(&other.moment));
        Wrench { force, moment: vector([join(a, d), join(b, e), join(c, f)]) }
    }
}

impl<T: Real> Wrench<T> {
    /// From its components.
    #[inline(always)]
    pub(crate) fn of(force: Vec3<T>, moment: Vec3<T>) -> Self {
        Self { force: vector(force), moment: vector(moment) }
    }

    /// Expressed in the axes in which the columns are expressed, from the columns.
    #[inline(always)]
    pub(crate) fn turned(&self, axes: &Columns<T>) -> Self {
        let (force, moment) = (components(&self.force), components(&self.moment));
        Self::of(rotate(axes, force), rotate(axes, moment))
    }

    /// The component of a wrench along a joint, about its origin and expressed in its child body:
    /// the moment about its axis, or the force along it.
    #[inline(always)]
    pub(crate) fn along(&self, joint: &JointInfo) -> T {
        let [x, y, z] = components(if joint.slides { &self.force } else { &self.moment });
        match joint.axis {
            0 => x,
            1 => y,
            _ => z,
        }
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
