//! [`Flexible`]: a structure with modes, by its [`ModalStorage`]: where numbers per mode and per mount
//! are kept, in arrays or on the heap.

use core::fmt::Debug;
use core::marker::PhantomData;

/// A structure with modes, and devices on its mounts; `M` is where modal numbers are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flexible<M>(PhantomData<M>);

/// Storage of what there is one of per mode or per mount.
pub trait ModalStorage: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// One value per mode.
    type Modes<V: Clone + Debug>: AsRef<[V]> + AsMut<[V]> + Clone + Debug;
    /// One value per mount.
    type Mounts<V: Clone + Debug>: AsRef<[V]> + AsMut<[V]> + Clone + Debug;

    /// A square of values, a row for each mode.
    type Square<V: Clone + Debug>: Clone + Debug;

    /// One value at `count` modes; storage of fixed size has its own number of them.
    fn modes<V: Clone + Debug>(count: usize, value: &V) -> Self::Modes<V>;
    /// One value at `count` mounts; storage of fixed size has its own number of them.
    fn mounts<V: Clone + Debug>(count: usize, value: &V) -> Self::Mounts<V>;
    /// One value in every place of `count` rows; storage of fixed size has its own number of them.
    fn square<V: Clone + Debug>(count: usize, value: &V) -> Self::Square<V>;
    /// The values of a square of `count` rows, row by row, and how many there are in a row.
    fn flat<V: Clone + Debug>(square: &mut Self::Square<V>, count: usize) -> (&mut [V], usize);
    /// The rows of a square of `count` rows.
    fn rows<'a, V: Clone + Debug + 'a>(
        square: &'a mut Self::Square<V>,
        count: usize,
    ) -> impl Iterator<Item = &'a mut [V]> {
        let (flat, length) = Self::flat(square, count);
        flat.chunks_exact_mut(length.max(1))
    }
    /// What a function makes of the value of each mount.
    fn per_mount<V: Clone + Debug, W: Clone + Debug>(
        of: &Self::Mounts<V>,
        make: impl FnMut(&V) -> W,
    ) -> Self::Mounts<W>;
    /// What a function makes of the value of each mode.
    fn per_mode<V: Clone + Debug, W: Clone + Debug>(
        of: &Self::Modes<V>,
        make: impl FnMut(&V) -> W,
    ) -> Self::Modes<W>;
}

/// `MODES` modes and `MOUNTS` mounts in arrays, without a heap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedModes<const MODES: usize, const MOUNTS: usize>;

impl<const MODES: usize, const MOUNTS: usize> ModalStorage for FixedModes<MODES, MOUNTS> {
    type Modes<V: Clone + Debug> = [V; MODES];
    type Mounts<V: Clone + Debug> = [V; MOUNTS];
    type Square<V: Clone + Debug> = [[V; MODES]; MODES];

    fn modes<V: Clone + Debug>(_: usize, value: &V) -> [V; MODES] {
        core::array::from_fn(|_| value.clone())
    }

    fn mounts<V: Clone + Debug>(_: usize, value: &V) -> [V; MOUNTS] {
        core::array::from_fn(|_| value.clone())
    }

    fn square<V: Clone + Debug>(_: usize, value: &V) -> [[V; MODES]; MODES] {
        core::array::from_fn(|_| core::array::from_fn(|_| value.clone()))
    }

    fn flat<V: Clone + Debug>(square: &mut [[V; MODES]; MODES], _: usize) -> (&mut [V], usize) {
        (square.as_flattened_mut(), MODES)
    }

    fn per_mount<V: Clone + Debug, W: Clone + Debug>(
        of: &[V; MOUNTS],
        make: impl FnMut(&V) -> W,
    ) -> [W; MOUNTS] {
        of.each_ref().map(make)
    }

    fn per_mode<V: Clone + Debug, W: Clone + Debug>(
        of: &[V; MODES],
        make: impl FnMut(&V) -> W,
    ) -> [W; MODES] {
        of.each_ref().map(make)
    }
}

/// Any number of modes and mounts, in vectors.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListedModes;

#[cfg(feature = "alloc")]
impl ModalStorage for ListedModes {
    type Modes<V: Clone + Debug> = alloc::vec::Vec<V>;
    type Mounts<V: Clone + Debug> = alloc::vec::Vec<V>;
    type Square<V: Clone + Debug> = alloc::vec::Vec<V>;

    fn modes<V: Clone + Debug>(count: usize, value: &V) -> alloc::vec::Vec<V> {
        alloc::vec![value.clone(); count]
    }

    fn mounts<V: Clone + Debug>(count: usize, value: &V) -> alloc::vec::Vec<V> {
        alloc::vec![value.clone(); count]
    }

    fn square<V: Clone + Debug>(count: usize, value: &V) -> alloc::vec::Vec<V> {
        alloc::vec![value.clone(); count.saturating_mul(count)]
    }

    fn flat<V: Clone + Debug>(square: &mut alloc::vec::Vec<V>, count: usize) -> (&mut [V], usize) {
        (square, count)
    }

    fn per_mount<V: Clone + Debug, W: Clone + Debug>(
        of: &alloc::vec::Vec<V>,
        make: impl FnMut(&V) -> W,
    ) -> alloc::vec::Vec<W> {
        of.iter().map(make).collect()
    }

    fn per_mode<V: Clone + Debug, W: Clone + Debug>(
        of: &alloc::vec::Vec<V>,
        make: impl FnMut(&V) -> W,
    ) -> alloc::vec::Vec<W> {
        of.iter().map(make).collect()
    }
}
