//! [`JointArray`]: one value per joint of a device, in an array that holds those of any kind.

use core::ops::{Deref, DerefMut};

use crate::numbers::each::{Each, JointStates, Value};

/// Largest number of joints of a device of this crate's kinds.
pub const MAX_JOINTS: usize = 7;

/// One value per joint of one device, from the hub to the tip: a list of up to [`MAX_JOINTS`]
/// values, without a heap.
#[derive(Clone, Copy, Debug)]
pub struct JointArray<V> {
    values: [V; MAX_JOINTS],
    count: usize,
}

impl<V: Value> JointArray<V> {
    /// The same value for each of `count` joints.
    pub(crate) fn all(count: usize, value: V) -> Self {
        Self { values: [value; MAX_JOINTS], count }
    }

    /// The values.
    #[must_use]
    pub fn as_slice(&self) -> &[V] {
        self.values.get(..self.count).unwrap_or(&self.values)
    }

    /// The values, mutable.
    pub fn as_mut_slice(&mut self) -> &mut [V] {
        let count = self.count.min(MAX_JOINTS);
        self.values.split_at_mut_checked(count).map_or(&mut [], |(values, _)| values)
    }

    /// Copies values in order; the rest keep theirs.
    pub(crate) fn fill(&mut self, from: impl Iterator<Item = V>) {
        for (to, from) in self.as_mut_slice().iter_mut().zip(from) {
            *to = from;
        }
    }
}

impl<V: Value> Deref for JointArray<V> {
    type Target = [V];

    fn deref(&self) -> &[V] {
        self.as_slice()
    }
}

impl<V: Value> DerefMut for JointArray<V> {
    fn deref_mut(&mut self) -> &mut [V] {
        self.as_mut_slice()
    }
}

impl<V: Value> PartialEq for JointArray<V> {
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl<V: Value> Each<V> for JointArray<V> {
    fn values(&self) -> impl Iterator<Item = V> {
        self.as_slice().iter().copied()
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.as_mut_slice().iter_mut()
    }
}

impl<T: Value> JointStates<T> for JointArray<[T; 2]> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.as_slice().iter().copied()
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.as_mut_slice().iter_mut().map(|[coordinate, rate]| [coordinate, rate])
    }
}

impl<V: Value> IntoIterator for JointArray<V> {
    type Item = V;
    type IntoIter = core::iter::Take<core::array::IntoIter<V, MAX_JOINTS>>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter().take(self.count)
    }
}
