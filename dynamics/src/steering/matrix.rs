//! [`SteeringMatrix`]: the moment about B per command, the drift of what is not commanded, and how near they are to
//! singular.

use nalgebra::Vector3;

use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, add, components, cross, dot, neg, scale, vector, zeros};
use crate::steering::error::SteeringError;
use crate::steering::terms::SteeringTerms;

/// What is commanded of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Steered {
    /// Its rate: a gimbal.
    Rate,
    /// Its acceleration: a wheel.
    Acceleration,
    /// Nothing: for the matrix it keeps its rate, for the servo its mode.
    #[default]
    Nothing,
}

/// The moment about B that the hub exerts on the devices, `Q x + drift` for commands x, expressed in B; the torque on the
/// hub is the opposite.
///
/// Columns and drift are those of the present rates: a rate that is commanded changes them in turn where the momentum
/// depends on products of rates. Left out are what the accelerations of gimbals, of joints that are not commanded, of the
/// hub and of B require: [`SteeringTerms::moment`] has them. Gravity and
/// what else acts on the devices' bodies is in neither.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringMatrix<T, const N: usize> {
    /// Q: moment per command of each joint, zero where nothing is commanded; N m s for a rate, kg m^2 for an acceleration.
    pub columns: [Vector3<T>; N],
    /// What the rates of the other joints and the hub's own require, N m.
    pub drift: Vector3<T>,
}

impl<T: Scalar, const N: usize> SteeringTerms<T, N> {
    /// The steering matrix of the commanded joints. The rates of the others are part of the drift; those of commanded
    /// gimbals are replaced by their commands.
    #[must_use]
    pub fn matrix(&self, steered: &[Steered; N]) -> SteeringMatrix<T, N> {
        let mut columns = [vector(zeros()); N];
        let mut drift = components(&self.gyroscopic);
        let by = self.by_rate.iter().zip(&self.by_acceleration).zip(self.rates);
        for ((to, steered), ((by_rate, by_acceleration), rate)) in
            columns.iter_mut().zip(steered).zip(by)
        {
            match steered {
                Steered::Rate => *to = *by_rate,
                Steered::Acceleration => *to = *by_acceleration,
                Steered::Nothing => {}
            }
            if *steered != Steered::Rate {
                drift = add(drift, scale(rate, components(by_rate)));
            }
        }
        SteeringMatrix { columns, drift: vector(drift) }
    }
}

impl<T: Scalar, const N: usize> SteeringMatrix<T, N> {
    /// `Q x`, N m.
    #[must_use]
    pub fn times(&self, commands: &[T; N]) -> Vector3<T> {
        vector(product(&self.columns, commands))
    }

    /// `-(Q x + drift)`, N m: the torque on the hub for commands, as far as the matrix has it.
    #[must_use]
    pub fn torque(&self, commands: &[T; N]) -> Vector3<T> {
        let moment = add(product(&self.columns, commands), components(&self.drift));
        vector(neg(moment))
    }

    /// `det(Q Q^T) / reference^6`: zero where some direction gets no torque. Over
    /// [`Dual`](crate::Dual) numbers, with gimbal angles as variables, its derivatives are its gradient.
    ///
    /// For gimbals `reference` is the momentum of a wheel, kg m^2/s, not zero: with it this is the measure of Schaub,
    /// Vadali and Junkins (1998) and of Wie (2001).
    #[must_use]
    pub fn measure(&self, reference: T) -> T {
        let per = reference.recip();
        let [x, y, z] =
            gram(&self.columns, &[T::from_f64(1.0); N]).map(|row| scale(per * per, row));
        dot(x, cross(y, z))
    }

    /// The smallest singular value of Q, and the direction, B axes, along which commands give least torque.
    #[must_use]
    pub fn weakest(&self) -> (T, Vector3<T>) {
        let (values, directions) = eigen(gram(&self.columns, &[T::from_f64(1.0); N]));
        let mut least = 0;
        for (k, value) in values.iter().enumerate() {
            if values.get(least).is_some_and(|smallest| value < smallest) {
                least = k;
            }
        }
        let value = values.get(least).copied().unwrap_or(zero()).max(zero()).sqrt();
        (value, vector(directions.get(least).copied().unwrap_or(zeros())))
    }
}

/// `Q x`.
pub(super) fn product<T: Scalar, const N: usize>(q: &[Vector3<T>; N], x: &[T; N]) -> Vec3<T> {
    q.iter().zip(x).fold(zeros(), |sum, (column, x)| add(sum, scale(*x, components(column))))
}

/// `Q W Q^T`, row by row.
pub(super) fn gram<T: Scalar, const N: usize>(
    q: &[Vector3<T>; N],
    weights: &[T; N],
) -> [Vec3<T>; 3] {
    let mut rows = [zeros(); 3];
    for (column, weight) in q.iter().zip(weights) {
        let column = components(column);
        for (row, component) in rows.iter_mut().zip(column) {
            *row = add(*row, scale(*weight * component, column));
        }
    }
    rows
}

/// `S^-1 d` of a symmetric positive definite S, by `L D L^T`.
pub(super) fn solved<T: Scalar>(
    [[a, b, c], [_, d, e], [_, _, f]]: [Vec3<T>; 3],
    [x, y, z]: Vec3<T>,
) -> Result<Vec3<T>, SteeringError<T>> {
    let bound = T::from_f64(64.0) * T::EPSILON * a.max(d).max(f);
    let above = |pivot: T| {
        // Also false of NaN.
        if pivot > bound {
            Ok(pivot.recip())
        } else {
            Err(SteeringError::Singular { pivot, bound })
        }
    };
    let first = above(a)?;
    let (l_21, l_31) = (b * first, c * first);
    let second = above(d - l_21 * b)?;
    let l_32 = (e - l_31 * b) * second;
    let third = above(f - l_31 * c - l_32 * (e - l_31 * b))?;
    let y = y - l_21 * x;
    let z = z - l_31 * x - l_32 * y;
    let z = z * third;
    let y = y * second - l_32 * z;
    Ok([x * first - l_21 * y - l_31 * z, y, z])
}

/// Eigenvalues and eigenvectors of a symmetric matrix, by cyclic rotations of Jacobi: eight sweeps leave nothing beside
/// the diagonal, since each squares what is left.
fn eigen<T: Scalar>(rows: [Vec3<T>; 3]) -> (Vec3<T>, [Vec3<T>; 3]) {
    let one = T::from_f64(1.0);
    let [[mut xx, mut xy, mut xz], [_, mut yy, mut yz], [_, _, mut zz]] = rows;
    let o = zero();
    let mut axes = [[one, o, o], [o, one, o], [o, o, one]];
    for _ in 0..8 {
        let (c, s) = rotation(xx, yy, xy);
        (xx, yy, xy) = diagonal(xx, yy, xy, c, s);
        (xz, yz) = (c * xz - s * yz, s * xz + c * yz);
        turn(&mut axes, 0, 1, c, s);
        let (c, s) = rotation(xx, zz, xz);
        (xx, zz, xz) = diagonal(xx, zz, xz, c, s);
        (xy, yz) = (c * xy - s * yz, s * xy + c * yz);
        turn(&mut axes, 0, 2, c, s);
        let (c, s) = rotation(yy, zz, yz);
        (yy, zz, yz) = diagonal(yy, zz, yz, c, s);
        (xy, xz) = (c * xy - s * xz, s * xy + c * xz);
        turn(&mut axes, 1, 2, c, s);
    }
    ([xx, yy, zz], axes)
}

/// Cosine and sine of the rotation that takes the element between two axes away.
fn rotation<T: Scalar>(p: T, q: T, between: T) -> (T, T) {
    let one = T::from_f64(1.0);
    if between == zero() {
        return (one, zero());
    }
    let half = (q - p) * (between + between).recip();
    let root = (half * half + one).sqrt();
    let tangent = if half < zero() { -(root - half).recip() } else { (root + half).recip() };
    let cosine = (tangent * tangent + one).sqrt().recip();
    (cosine, tangent * cosine)
}

/// The two diagonal elements after the rotation, and what is between them: nothing.
fn diagonal<T: Scalar>(p: T, q: T, between: T, c: T, s: T) -> (T, T, T) {
    let cross = (c * s + c * s) * between;
    (c * c * p - cross + s * s * q, s * s * p + cross + c * c * q, zero())
}

/// Turns two of the axes.
fn turn<T: Scalar>(axes: &mut [Vec3<T>; 3], first: usize, second: usize, c: T, s: T) {
    let [Some(p), Some(q)] = [first, second].map(|k| axes.get(k).copied()) else { return };
    let [new_p, new_q] = [add(scale(c, p), scale(-s, q)), add(scale(s, p), scale(c, q))];
    for (k, new) in [(first, new_p), (second, new_q)] {
        if let Some(axis) = axes.get_mut(k) {
            *axis = new;
        }
    }
}
