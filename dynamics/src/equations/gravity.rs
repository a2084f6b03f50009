//! [`Gravity`]: a uniform field, or that of a central body with its gradient.
//!
//! A uniform field is a change of frame: in the frame that falls with it there is none, so it is
//! exact for every body and in no kernel. The gradient of a central field is a linear field about
//! B, with a force and a torque on each body.
//!
//! ```text
//! field       a(r) = g + G r,   G = mu / R³ (3 n nᵀ - 1),   r from B, n from the centre to B
//! potential   V = -m mu / R - g . m c - ½ G : S,             S = integral of r rᵀ dm
//! ```
//!
//! V is what the ledger counts, so the force on the whole is its gradient to the last term, that of
//! G with the position of B included: `½ ∂(G : S)/∂R = mu / R⁴ (3 S n - 15/2 (n . S n) n + 3/2 tr S
//! n)`.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::Vector3;

use crate::model::kernels::Kernels;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Real, Scalar, half, reciprocal_in_two};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, components, dot, largest, map, rotate, scale, zeros,
};

/// The gravity that acts on hub and devices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gravity<T = f64> {
    /// None.
    None,
    /// The same acceleration everywhere, N axes, m/s².
    Uniform(Vector3<T>),
    /// A central body at the inertial origin.
    Central {
        /// `mu`, its gravitational parameter, m³/s².
        mu: T,
    },
}

/// Gravity about B, expressed in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field<T> {
    /// At B, m/s².
    pub(crate) at_b: Vec3<T>,
    /// Of a central body; none where the field is uniform.
    pub(crate) central: Option<Central<T>>,
}

/// What a central body adds to the field at B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Central<T> {
    /// G, 1/s².
    pub(crate) gradient: Symmetric<T>,
    /// n, from the centre to B.
    n: Vec3<T>,
    /// `mu / R`, m²/s².
    potential: T,
    /// `mu / R⁴`, 1/(m s²).
    slope: T,
}

impl<T: Scalar> Gravity<T> {
    /// The field about B for `[BN]` and the position of B, N axes; no field is none.
    pub(crate) fn field(&self, bn: &Columns<T>, r_b_n: &Vector3<T>) -> Option<Field<T>> {
        match self {
            Self::None => None,
            Self::Uniform(g) => Some(Field { at_b: rotate(bn, components(g)), central: None }),
            Self::Central { mu } => {
                let r = rotate(bn, components(r_b_n));
                let (n, powers) = central(*mu, r);
                let (at_b, central) = Central::of(n, powers);
                Some(Field { at_b, central: Some(central) })
            }
        }
    }
}

/// The direction `r / R`, and `mu / R` to `mu / R⁴`.
fn central<T: Scalar>(mu: T, r: Vec3<T>) -> (Vec3<T>, [T; 4]) {
    let (size, near) = (largest(r), T::EPSILON * T::EPSILON);
    if near < size && size < near.recip() {
        let per_r = dot(r, r).sqrt().recip();
        return (scale(per_r, r), powers(mu, per_r));
    }
    // Beyond, R² or 1/R² may be no number although the field is one.
    let (first, second) = reciprocal_in_two(size);
    let r = map(r, |component| component * first * second);
    let per_r = dot(r, r).sqrt().recip();
    let over_r = |x: T| x * per_r * first * second;
    let (potential, at_b) = (over_r(mu), over_r(over_r(mu)));
    (scale(per_r, r), [potential, at_b, over_r(at_b), over_r(over_r(at_b))])
}

/// `mu / R` to `mu / R⁴` from `1 / R`.
#[inline(always)]
pub(crate) fn powers<T: Real>(mu: T, per_r: T) -> [T; 4] {
    let (potential, per_square) = (mu * per_r, per_r * per_r);
    [potential, potential * per_r, potential * per_square, potential * per_r * per_square]
}

impl<T: Scalar> Field<T> {
    /// Potential energy of a spacecraft, J: its mass, its first moment about B, expressed in B; and
    /// for a central field its second moment, else of the position of B, N axes.
    pub(crate) fn potential(
        &self,
        mass: T,
        first_moment: Vec3<T>,
        second_moment: &Symmetric<T>,
        r_b: Vec3<T>,
    ) -> T {
        match &self.central {
            None => -(dot(self.at_b, add(scale(mass, r_b), first_moment))),
            Some(central) => {
                let linear = mass * central.potential + dot(self.at_b, first_moment);
                -(linear + half::<T>() * central.gradient.double_dot(second_moment))
            }
        }
    }
}

#[cfg(any(feature = "alloc", feature = "lanes"))]
impl<T: Copy> Central<T> {
    /// Each number changed.
    #[inline(always)]
    pub(crate) fn map<U>(&self, mut change: impl FnMut(T) -> U) -> Central<U> {
        Central {
            gradient: self.gradient.zip(self.gradient, |number, _| change(number)),
            n: map(self.n, &mut change),
            potential: change(self.potential),
            slope: change(self.slope),
        }
    }
}

impl<T: Real> Central<T> {
    /// The field at B, and what is added to it, from n and `mu / R` to `mu / R⁴`.
    #[inline(always)]
    pub(crate) fn of(n: Vec3<T>, [potential, at_b, square, slope]: [T; 4]) -> (Vec3<T>, Self) {
        let gradient =
            Symmetric::dyad(n).scaled(square.like(3.0) * square).plus(Symmetric::scalar(-square));
        (scale(-at_b, n), Self { gradient, n, potential, slope })
    }

    /// The same with its change for the gradient, where the position from the centre changes by `e`:
    /// `3 mu / R⁴ (e nᵀ + n eᵀ + (n . e) (1 - 5 n nᵀ))`.
    #[cfg(feature = "alloc")]
    pub(crate) fn changed(&self, e: Vec3<T>) -> Self {
        let (n, three) = (self.n, self.slope.like(3.0) * self.slope);
        let along = three * dot(n, e);
        let mixed = |i: usize, k: usize| three * (e[i] * n[k] + n[i] * e[k]);
        let of_both = Symmetric {
            xx: mixed(0, 0),
            xy: mixed(0, 1),
            xz: mixed(0, 2),
            yy: mixed(1, 1),
            yz: mixed(1, 2),
            zz: mixed(2, 2),
        };
        let of_n = Symmetric::dyad(n).scaled(along * n[0].like(-5.0));
        Self { gradient: of_both.plus(of_n).plus(Symmetric::scalar(along)), ..*self }
    }

    /// Expressed in the columns.
    #[inline(always)]
    pub(crate) fn turned(&self, axes: &Columns<T>) -> Self {
        let [x, y, z] = *axes;
        let transposed = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
        let n = rotate(&transposed, self.n);
        Self { gradient: self.gradient.rotated(&transposed), n, ..*self }
    }

    /// Third-order force on the spacecraft, in addition to field and gradient, N.
    #[inline(always)]
    pub(crate) fn third_order(&self, second_moment: &Symmetric<T>) -> Vec3<T> {
        let along = second_moment.times(self.n);
        let [half, two_and_half, three] = map([0.5, 2.5, 3.0], |number| self.slope.like(number));
        let spread = half * second_moment.trace() - two_and_half * dot(self.n, along);
        scale(three * self.slope, add(along, scale(spread, self.n)))
    }

    /// Force and moment about B that the gradient exerts on a rigid body, by its first and second
    /// moment about B: `G s` and `integral of r x G r dm`.
    #[inline(always)]
    pub(crate) fn wrench(
        &self,
        first_moment: Vec3<T>,
        second_moment: &Symmetric<T>,
    ) -> (Vec3<T>, Vec3<T>) {
        let moment = gradient_moment(&self.gradient, second_moment);
        (self.gradient.times(first_moment), moment)
    }
}

/// Moment about a point that the field `G r` from it exerts on a mass distribution, by its second
/// moment about the point.
#[inline(always)]
pub(crate) fn gradient_moment<T: Real>(
    gradient: &Symmetric<T>,
    second_moment: &Symmetric<T>,
) -> Vec3<T> {
    let [x, y, z] = second_moment.columns();
    let [x, y, z] = [gradient.times(x), gradient.times(y), gradient.times(z)];
    // Component i: epsilon_ijk (S G)_jk.
    [y[2] - z[1], z[0] - x[2], x[1] - y[0]]
}

/// Wrenches of the gradient of gravity on the bodies of a device, and its second moment about B,
/// expressed in its own axes.
#[inline(always)]
pub(crate) fn gradient<K: Kernels, T: Real>(
    constants: &K::Constants<T>,
    mount: &Columns<T>,
    pose: &K::Pose<T>,
    central: &Central<T>,
) -> (K::PerJoint<Wrench<T>>, Symmetric<T>) {
    let [x, y, z] = *mount;
    let transposed = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
    let g = central.gradient.rotated(&transposed);
    let entries = [g.xx, g.xy, g.xz, g.yy, g.yz, g.zz];
    let (wrenches, [xx, xy, xz, yy, yz, zz]) = K::gravity(constants, pose, entries);
    (wrenches, Symmetric { xx, xy, xz, yy, yz, zz })
}

/// `½ tr(I) 1 - I`: the second moment of a mass distribution from its inertia about the same point.
#[inline(always)]
pub(crate) fn second_moment<T: Real>(inertia: &Symmetric<T>) -> Symmetric<T> {
    let (half, minus_one) = (inertia.xx.like(0.5), inertia.xx.like(-1.0));
    Symmetric::scalar(half * inertia.trace()).plus(inertia.scaled(minus_one))
}

/// Nothing moves it: no field.
pub(crate) fn at_b<T: Scalar>(field: Option<&Field<T>>) -> Vec3<T> {
    field.map_or_else(zeros, |field| field.at_b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::vec3::{neg, sub};

    /// Differences over a step of 1e-4 of fields of size one: rounding 1e-12, curvature 1e-8.
    const DIFFERENCE: f64 = 1e-7;

    const IDENTITY: Columns<f64> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    fn field(r: Vec3<f64>) -> Field<f64> {
        let central = Gravity::Central { mu: 2.0 };
        central.field(&IDENTITY, &Vector3::from(r)).expect("a field")
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_field() {
        let (r, step) = ([0.8, -0.5, 0.9], 1e-4);
        let gradient = field(r).central.expect("central").gradient.columns();
        for k in 0..3 {
            let mut arm = [0.0; 3];
            arm[k] = step;
            let change = sub(field(add(r, arm)).at_b, field(sub(r, arm)).at_b);
            for (found, expected) in scale(0.5 / step, change).iter().zip(&gradient[k]) {
                assert!((found - expected).abs() < DIFFERENCE);
            }
        }
    }

    #[test]
    fn field_at_extreme_radius_is_the_quotient_where_it_is_a_number() {
        for (mu, radius, expected) in [
            (1e300, 1e160, 1e-20),
            (1e-300, 1e-160, 1e20),
            (1e300, 1e20, 1e260),
            (1.0, 1e-150, 1e300),
        ] {
            let central = Gravity::Central { mu };
            let r = Vector3::new(0.0, -0.6 * radius, 0.8 * radius);
            let [_, y, z] = central.field(&IDENTITY, &r).expect("a field").at_b;
            assert!((y / expected - 0.6).abs() < 1e-15 && (z / expected + 0.8).abs() < 1e-15);
        }
        // The same on both sides of the threshold between the two formulas.
        for radius in [4e-32, 6e-32, 1.9e31, 2.2e31] {
            let (n, [potential, at_b, square, slope]) = central(2.0, [radius, 0.0, 0.0]);
            assert_eq!(n, [1.0, 0.0, 0.0]);
            let powers = [potential * radius, at_b * radius / potential, square * radius / at_b];
            let ratios = [powers[0] / 2.0, powers[1], powers[2], slope * radius / square];
            assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-15), "{ratios:?}");
        }
    }

    #[test]
    fn force_on_the_whole_is_the_gradient_of_the_potential() {
        let (r, step) = ([0.8, -0.5, 0.9], 1e-4);
        let (mass, s) = (1.3, [0.3, 0.2, -0.4]);
        let second = Symmetric { xx: 0.5, xy: 0.1, xz: -0.2, yy: 0.7, yz: 0.05, zz: 0.4 };
        let here = field(r);
        let central = here.central.expect("central");
        let force = add(
            add(scale(mass, here.at_b), central.wrench(s, &second).0),
            central.third_order(&second),
        );
        let potential = |r| field(r).potential(mass, s, &second, r);
        for k in 0..3 {
            let mut arm = [0.0; 3];
            arm[k] = step;
            let found = (potential(sub(r, arm)) - potential(add(r, arm))) * 0.5 / step;
            assert!((found - force[k]).abs() < DIFFERENCE, "{k}: {found} and {}", force[k]);
        }
    }

    #[test]
    fn moment_of_the_gradient_is_that_of_its_masses() {
        let central = field([0.8, -0.5, 0.9]).central.expect("central");
        let masses = [(0.7, [0.3, -0.1, 0.2]), (1.1, [-0.2, 0.5, 0.4])];
        let mut second = Symmetric::scalar(0.0);
        let (mut first, mut moment) = ([0.0; 3], [0.0; 3]);
        for (mass, r) in masses {
            let force = scale(mass, central.gradient.times(r));
            first = add(first, scale(mass, r));
            second = second.plus(Symmetric::dyad(r).scaled(mass));
            moment = add(moment, crate::numbers::vec3::cross(r, force));
        }
        let (force, found) = central.wrench(first, &second);
        let off = add(sub(moment, found), neg([0.0; 3]));
        assert!(dot(off, off).sqrt() < 1e-15 && force.iter().all(|f| f.is_finite()));
    }
}
