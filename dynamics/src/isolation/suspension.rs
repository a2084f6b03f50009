//! [`Suspension`]: springs and dampers between a platform and its base that couple its joints, as
//! matrices and as struts.
//!
//! With q the six coordinates of the platform, rest `q_0`, and l the length of a strut:
//!
//! ```text
//! (I8)  V = ½ (q - q_0)ᵀ K (q - q_0) + sum of ½ k (l - l_0)²
//! (I9)  u = -∂V/∂q - C q' - sum of c l' ∂l/∂q
//! ```
//!
//! V is a function of the coordinates, so the springs conserve energy in turns of any size; K is its
//! second derivative in them. `∂l/∂q` is the direction of the strut for the slides, and its moment
//! about P along the turn axes for the turns.

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::equations::suspension_forces::{Forces, Six};
use crate::isolation::motion::Pose;
use crate::isolation::records::Joints;
use crate::numbers::real::{Scalar, half, one, two, zero};
use crate::numbers::vec3::{
    Vec3, add, components, cross, dot, rotate, rotate_transposed, scale, sub,
};

/// Springs and dampers that couple the joints of a platform; those of single joints are its
/// [`passive`](crate::Platform::passive). All are added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suspension<T = f64> {
    /// Matrices of stiffness and damping.
    pub coupled: Option<Coupled<T>>,
    /// Struts, as those of a hexapod.
    pub struts: [Option<Strut<T>>; 6],
}

/// Stiffness and damping in the coordinates `(x, y, z, alpha, beta, gamma)` of a platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupled<T = f64> {
    /// K, second derivative of the potential in the coordinates: N/m, N/rad, N m/rad. Symmetric,
    /// positive semidefinite.
    pub stiffness: Matrix6<T>,
    /// `q_0`, the coordinates at which the springs are at rest, m and rad.
    pub rest: Vector6<T>,
    /// C, of the rates of the coordinates: N s/m, N s/rad, N m s/rad. Symmetric, positive
    /// semidefinite.
    pub damping: Matrix6<T>,
}

/// A strut between base and platform, with joints at both ends that turn freely: spring and damper
/// along the line between them. It has no mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strut<T = f64> {
    /// Its end on the platform from P, platform axes, m.
    pub position: Vector3<T>,
    /// Unit vector from its end on the base to that on the platform with every coordinate zero,
    /// mount axes.
    pub direction: Vector3<T>,
    /// `l_0`, its length with every coordinate zero, at which it exerts no force, m. Above zero.
    pub length: T,
    /// k, N/m. Not negative.
    pub stiffness: T,
    /// c, N s/m. Not negative.
    pub damping: T,
}

impl<T: Scalar> Suspension<T> {
    /// Neither matrices nor struts.
    #[must_use]
    pub const fn none() -> Self {
        Self { coupled: None, struts: [None; 6] }
    }

    /// Six struts.
    #[must_use]
    pub const fn hexapod([a, b, c, d, e, f]: [Strut<T>; 6]) -> Self {
        Self { coupled: None, struts: [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] }
    }
}

/// A strut as it is with the platform in some pose.
struct StrutStretch<T> {
    /// `∂l/∂q`.
    slope: Six<T>,
    /// `l - l_0`.
    stretch: T,
}

/// `a . b`, in order.
fn sum<T: Scalar>(a: &Six<T>, b: &Six<T>) -> T {
    a.iter().zip(b).fold(zero(), |sum, (a, b)| sum + *a * *b)
}

/// Adds `s b` to a.
fn add_scaled<T: Scalar>(a: &mut Six<T>, s: T, b: &Six<T>) {
    for (a, b) in a.iter_mut().zip(b) {
        *a = *a + s * *b;
    }
}

impl<T: Scalar> Suspension<T> {
    /// (I8) and (I9).
    pub(crate) fn forces(&self, pose: &Pose<T>, joints: &Joints<T>) -> Forces<T> {
        let mut forces = Forces::none();
        let rates = joints.rates();
        if let Some(coupled) = &self.coupled {
            let [rest] = coupled.rest.data.0;
            let mut stretch = joints.coordinates();
            add_scaled(&mut stretch, -one::<T>(), &rest);
            let columns = coupled.stiffness.data.0.iter().zip(&coupled.damping.data.0);
            for ((k, c), (stretch, rate)) in columns.zip(stretch.iter().zip(rates)) {
                add_scaled(&mut forces.springs, -*stretch, k);
                add_scaled(&mut forces.dampers, -rate, c);
            }
            forces.potential = -(half::<T>() * sum(&forces.springs, &stretch));
        }
        for strut in self.struts.iter().flatten() {
            let StrutStretch { slope, stretch } = strut.stretched(pose);
            let (spring, damper) = (strut.stiffness * stretch, strut.damping * sum(&slope, &rates));
            add_scaled(&mut forces.springs, -spring, &slope);
            add_scaled(&mut forces.dampers, -damper, &slope);
            forces.potential = forces.potential + half::<T>() * spring * stretch;
        }
        forces
    }

    /// Diagonals, damping and stiffness, that bound the matrices in a pose, or with every coordinate
    /// zero: less the matrix they are positive semidefinite. What a step has to resolve is bounded
    /// by them. Without the share of the struts' forces, which turn with them.
    pub(crate) fn diagonals(&self, pose: Option<&Pose<T>>) -> [Six<T>; 2] {
        let mut damping = self.coupled.map_or([[zero(); 6]; 6], |coupled| coupled.damping.data.0);
        let mut stiffness =
            self.coupled.map_or([[zero(); 6]; 6], |coupled| coupled.stiffness.data.0);
        for strut in self.struts.iter().flatten() {
            let slope = pose.map_or_else(|| strut.slope(), |pose| strut.stretched(pose).slope);
            for ((c, k), along) in damping.iter_mut().zip(&mut stiffness).zip(slope) {
                add_scaled(c, strut.damping * along, &slope);
                add_scaled(k, strut.stiffness * along, &slope);
            }
        }
        [dominant(&damping), dominant(&stiffness)]
    }
}

/// The diagonal `d_j = sum over i of |k_ij| sqrt(k_jj / k_ii)`: of a positive semidefinite k the
/// difference from it, scaled to unit diagonal, is diagonally dominant.
fn dominant<T: Scalar>(k: &[Six<T>; 6]) -> Six<T> {
    let mut roots = [zero::<T>(); 6];
    for (index, (root, column)) in roots.iter_mut().zip(k).enumerate() {
        *root = column.get(index).map_or_else(zero, |own| own.max(zero()).sqrt());
    }
    let mut diagonal = [zero(); 6];
    for ((entry, own), column) in diagonal.iter_mut().zip(roots).zip(k) {
        for (element, other) in column.iter().zip(roots) {
            if other > zero() {
                *entry = *entry + element.abs() * own * other.recip();
            }
        }
    }
    diagonal
}

impl<T: Scalar> Strut<T> {
    /// `∂l/∂q` with every coordinate zero.
    fn slope(&self) -> Six<T> {
        let along = components(&self.direction);
        let [x, y, z] = along;
        let [alpha, beta, gamma] = cross(components(&self.position), along);
        [x, y, z, alpha, beta, gamma]
    }

    /// Length and its slope in a pose.
    fn stretched(&self, pose: &Pose<T>) -> StrutStretch<T> {
        let (position, direction) = (components(&self.position), components(&self.direction));
        let turned = pose.turned();
        // How far the end on the platform has moved, mount axes.
        let moved = add(pose.slid, sub(rotate(&turned, position), position));
        let ends = add(scale(self.length, direction), moved);
        let length = dot(ends, ends).sqrt();
        let along = scale(length.recip(), ends);
        // (l² - l_0²) / (l + l_0): zero where nothing has moved.
        let twice = add(scale(two::<T>() * self.length, direction), moved);
        let stretch = dot(moved, twice) * (length + self.length).recip();
        let moment = cross(position, rotate_transposed(&turned, along));
        let [alpha, beta, gamma] = pose.turn_axes().map(|axis: Vec3<T>| dot(axis, moment));
        let [x, y, z] = along;
        StrutStretch { slope: [x, y, z, alpha, beta, gamma], stretch }
    }
}
