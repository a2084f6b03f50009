//! [`LoadGroup`]: loads of a device by some variables, side by side.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::model::joint_array::MAX_JOINTS;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::Columns;

/// How many variables or joints are computed side by side.
pub(crate) const TOGETHER: usize = 4;

/// Numbers of the hub: along the axes of B of the translation, then of the rotation.
pub(crate) type Six<T> = [T; 6];

/// The same by some variables.
pub(crate) type HubGroup<T> = [[T; TOGETHER]; 6];

/// By one variable: force and moment about B that the hub exerts on a device, B axes, and what each of its motors exerts
/// less spring and friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load<T> {
    pub(crate) hub: Six<T>,
    pub(crate) joints: [T; MAX_JOINTS],
}

/// The same by some variables: of each number of a [`Load`] one by each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadGroup<T> {
    pub(crate) hub: HubGroup<T>,
    pub(crate) joints: [[T; TOGETHER]; MAX_JOINTS],
}

impl<T: Scalar> Load<T> {
    pub(crate) fn none() -> Self {
        Self { hub: [zero(); 6], joints: [zero(); MAX_JOINTS] }
    }
}

impl<T: Scalar> LoadGroup<T> {
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self { hub: [[zero(); TOGETHER]; 6], joints: [[zero(); TOGETHER]; MAX_JOINTS] }
    }
}

/// Loads of the hub expressed in B, of those in the axes of a device of this mount.
#[inline(always)]
pub(crate) fn turned<T: Scalar>(of: &HubGroup<T>, mount: &Columns<T>) -> HubGroup<T> {
    let [x, y, z] = mount;
    let mut found = [[zero(); TOGETHER]; 6];
    let vectors = found.as_chunks_mut::<3>().0.iter_mut().zip(of.as_chunks::<3>().0);
    for (to, [a, b, c]) in vectors {
        for (axis, to) in to.iter_mut().enumerate() {
            for (k, to) in to.iter_mut().enumerate() {
                *to = x[axis] * a[k] + y[axis] * b[k] + z[axis] * c[k];
            }
        }
    }
    found
}

/// Numbers by components along B, of those by components along the axes of a device of this mount.
#[inline(always)]
pub(crate) fn by_b<T: Scalar, const N: usize>(
    of: &[[T; TOGETHER]; N],
    mount: &Columns<T>,
) -> [[T; TOGETHER]; N] {
    let [[a, b, c], [d, e, f], [g, h, i]] = *mount;
    let (p, q, r) = ([a, b, c, zero()], [d, e, f, zero()], [g, h, i, zero()]);
    let mut found = *of;
    for line in &mut found {
        let [x, y, z, _] = *line;
        for (k, to) in line.iter_mut().enumerate() {
            *to = p[k] * x + q[k] * y + r[k] * z;
        }
    }
    found
}

/// Whether all numbers seen are finite: zero times each, summed side by side, is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Finiteness<T> {
    sums: [T; TOGETHER],
}

impl<T: Scalar> Finiteness<T> {
    #[inline(always)]
    pub(crate) fn of_none() -> Self {
        Self { sums: [zero(); TOGETHER] }
    }

    #[inline(always)]
    pub(crate) fn see(&mut self, numbers: &[T; TOGETHER]) {
        add_product(&mut self.sums, zero(), numbers);
    }

    /// Fewer numbers.
    #[inline(always)]
    pub(crate) fn see_each(&mut self, numbers: &[T]) {
        for (sum, number) in self.sums.iter_mut().zip(numbers) {
            *sum = *sum + *number * zero();
        }
    }

    /// And what another has seen.
    #[inline(always)]
    pub(crate) fn merge(&mut self, other: &Self) {
        add_product(&mut self.sums, one(), &other.sums);
    }

    #[inline(always)]
    pub(crate) fn holds(&self) -> bool {
        self.sums.iter().all(|sum| sum.is_finite())
    }
}

/// Adds a multiple of numbers, side by side.
#[inline(always)]
pub(crate) fn add_product<T: Scalar>(to: &mut [T; TOGETHER], by: T, of: &[T; TOGETHER]) {
    for (to, from) in to.iter_mut().zip(of) {
        *to = *to + by * *from;
    }
}
