//! [`LoadGroup`]: loads of a device by some variables, side by side.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::model::joint_array::MAX_JOINTS;
use crate::numbers::real::{Real, Scalar, zero};
use crate::numbers::vec3::Columns;

/// How many variables or joints are computed side by side.
pub(crate) const TOGETHER: usize = 4;

/// Numbers of the hub: along the axes of B of the translation, then of the rotation.
pub(crate) type Six<T> = [T; 6];

/// The same by some variables.
pub(crate) type HubGroup<T, const P: usize = TOGETHER> = [[T; P]; 6];

/// By one variable: force and moment about B that the hub exerts on a device, B axes, and what each of its motors exerts
/// less spring and friction.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load<T> {
    pub(crate) hub: Six<T>,
    pub(crate) joints: [T; MAX_JOINTS],
}

/// The same by some variables, of so many joints: of each number of a [`Load`] one by each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadGroup<T, const JOINTS: usize = MAX_JOINTS, const P: usize = TOGETHER> {
    pub(crate) hub: HubGroup<T, P>,
    pub(crate) joints: [[T; P]; JOINTS],
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Load<T> {
    pub(crate) fn none() -> Self {
        Self { hub: [zero(); 6], joints: [zero(); MAX_JOINTS] }
    }
}

impl<T: Copy, const JOINTS: usize, const P: usize> LoadGroup<T, JOINTS, P> {
    #[inline(always)]
    pub(crate) const fn none(zero: T) -> Self {
        Self { hub: [[zero; P]; 6], joints: [[zero; P]; JOINTS] }
    }

    /// Sets a number: of the hub's load, then of the joints'.
    #[inline(always)]
    pub(crate) fn put(&mut self, row: usize, place: usize, number: T) {
        let Self { hub, joints } = self;
        let row = if row < 6 { hub.get_mut(row) } else { joints.get_mut(row.wrapping_sub(6)) };
        if let Some(to) = row.and_then(|row| row.get_mut(place)) {
            *to = number;
        }
    }
}

/// Loads of the hub expressed in B, of those in the axes of a device of this mount.
#[inline(always)]
pub(crate) fn turned<T: Real, const P: usize>(
    zero: T,
    of: &HubGroup<T, P>,
    mount: &Columns<T>,
) -> HubGroup<T, P> {
    let [x, y, z] = mount;
    let mut found = [[zero; P]; 6];
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

/// Numbers by components along B, of those by components along the axes of a device of this mount; beyond three they are
/// zero.
#[inline(always)]
pub(crate) fn by_b<T: Real, const N: usize, const P: usize>(
    zero: T,
    of: &[[T; P]; N],
    mount: &Columns<T>,
) -> [[T; P]; N] {
    let mut axes = [[zero; P]; 3];
    for (to, axis) in axes.iter_mut().zip(mount) {
        for (to, component) in to.iter_mut().zip(axis) {
            *to = *component;
        }
    }
    let [p, q, r] = axes;
    let mut found = *of;
    for line in &mut found {
        let [x, y, z, ..] = line.as_slice() else { continue };
        let (x, y, z) = (*x, *y, *z);
        for (k, to) in line.iter_mut().enumerate() {
            *to = p[k] * x + q[k] * y + r[k] * z;
        }
    }
    found
}

/// Whether all numbers seen are finite: their sums, side by side, are. Sums of the largest numbers are not, though all
/// may be: then [`are_finite`] knows.
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
    pub(crate) fn see<const P: usize>(&mut self, numbers: &[T; P]) {
        for (sum, number) in self.sums.iter_mut().zip(numbers) {
            *sum = *sum + *number;
        }
    }

    /// What another has seen.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn see_all(&mut self, Self { sums }: &Self) {
        self.see(sums);
    }

    /// Fewer numbers.
    #[inline(always)]
    pub(crate) fn see_each(&mut self, numbers: &[T]) {
        for (sum, number) in self.sums.iter_mut().zip(numbers) {
            *sum = *sum + *number;
        }
    }

    /// Whether they are; may be false where they are.
    #[inline(always)]
    pub(crate) fn holds(&self) -> bool {
        self.sums.iter().all(|sum| sum.is_finite())
    }
}

/// Whether all numbers are finite: zero times each, summed side by side, is.
#[inline(always)]
pub(crate) fn are_finite<T: Scalar>(numbers: &[T]) -> bool {
    let mut sums = [zero::<T>(); TOGETHER];
    let (fours, rest) = numbers.as_chunks::<TOGETHER>();
    for four in fours {
        add_product(&mut sums, zero(), four);
    }
    for (sum, number) in sums.iter_mut().zip(rest) {
        *sum = *sum + *number * zero();
    }
    sums.iter().all(|sum| sum.is_finite())
}

/// Adds a multiple of numbers, side by side.
#[inline(always)]
pub(crate) fn add_product<T: Real, const P: usize>(to: &mut [T; P], by: T, of: &[T; P]) {
    for (to, from) in to.iter_mut().zip(of) {
        *to = *to + by * *from;
    }
}
