//! [`TreeSystem`]: the mass matrix of a tree of joints, factorised, `M = Lᵀ D L`.
//!
//! Each row has elements only in the columns of its ancestors: the joints inboard of it, and the hub. Eliminated from the
//! tips inwards it stays so, at any depth of carriers.

#![expect(clippy::inline_always, reason = "part of a loop over rows")]

use alloc::vec::Vec;

use crate::derivatives::loads::side_by_side::{TOGETHER, add_product};
use crate::numbers::real::{Scalar, one, zero};

/// The rows from the hub's on, each after its ancestors.
#[derive(Debug)]
pub(crate) struct TreeSystem<T> {
    rows: Vec<Row<T>>,
}

/// A row of the matrix, then of L.
#[derive(Clone, Debug)]
pub(crate) struct Row<T> {
    /// The rows of its ancestors, from the first on.
    path: Vec<usize>,
    /// How many of these are the first rows of all, one after another.
    first: usize,
    /// Its elements in their columns.
    entries: Vec<T>,
    /// Its diagonal, then the reciprocal of its pivot.
    diagonal: T,
    free: bool,
}

impl<T: Scalar> TreeSystem<T> {
    pub(crate) fn new() -> Self {
        Self { rows: Vec::new() }
    }

    /// Adds a row whose nearest ancestor is `parent`; one that is not free has an acceleration that is given.
    pub(crate) fn push(&mut self, parent: Option<usize>, free: bool) {
        let mut path = Vec::new();
        if let Some((parent, row)) = parent.and_then(|k| Some((k, self.rows.get(k)?))) {
            path.extend(row.path.iter().copied().chain([parent]));
        }
        let entries = alloc::vec![zero(); path.len()];
        let first = path.iter().enumerate().take_while(|(place, row)| place == *row).count();
        self.rows.push(Row { path, first, entries, diagonal: zero(), free });
    }

    /// The number of rows.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Adds to the element of a row in the column of itself or of an ancestor; elsewhere nothing.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: T) {
        let is_free = |of: usize| self.rows.get(of).is_some_and(|of| of.free);
        if !(is_free(row) && is_free(column)) {
            return;
        }
        let Some(Row { path, entries, diagonal, .. }) = self.rows.get_mut(row) else { return };
        if row == column {
            *diagonal = *diagonal + value;
            return;
        }
        let place = path.binary_search(&column).ok();
        if let Some(entry) = place.and_then(|place| entries.get_mut(place)) {
            *entry = *entry + value;
        }
    }

    /// Factorises.
    pub(crate) fn factorise(&mut self) {
        for k in (0..self.rows.len()).rev() {
            let (ancestors, rest) = self.rows.split_at_mut(k);
            let Some(Row { path, entries, diagonal, free, .. }) = rest.first_mut() else { return };
            if !*free {
                *diagonal = one();
                continue;
            }
            *diagonal = diagonal.recip();
            for (ancestor, entry) in path.iter().zip(&*entries) {
                let Some(row) = ancestors.get_mut(*ancestor) else { continue };
                let factor = *entry * *diagonal;
                for (to, other) in row.entries.iter_mut().zip(&*entries) {
                    *to = *to - factor * *other;
                }
                row.diagonal = row.diagonal - factor * *entry;
            }
            for entry in entries {
                *entry = *entry * *diagonal;
            }
        }
    }

    /// `M⁻¹` times numbers, in their place, some columns side by side; zero in rows that are not free.
    pub(crate) fn solve(&self, numbers: &mut [[T; TOGETHER]]) {
        for (k, row) in self.rows.iter().enumerate().rev() {
            let (ancestors, rest) = numbers.split_at_mut(k.min(numbers.len()));
            let Some(own) = rest.first_mut() else { continue };
            if !row.free {
                *own = [zero(); TOGETHER];
            }
            if own.iter().all(|number| number.vanishes()) {
                continue;
            }
            let (first, last, entries) = row.split(ancestors.len());
            let ((of_first, of_last), own) = (entries, *own);
            for (to, entry) in ancestors.iter_mut().zip(of_first).take(first) {
                add_product(to, -*entry, &own);
            }
            for (ancestor, entry) in last.iter().zip(of_last) {
                if let Some(to) = ancestors.get_mut(*ancestor) {
                    add_product(to, -*entry, &own);
                }
            }
        }
        for (k, row) in self.rows.iter().enumerate() {
            let (ancestors, rest) = numbers.split_at_mut(k.min(numbers.len()));
            let Some(own) = rest.first_mut() else { continue };
            let mut sum = *own;
            for number in &mut sum {
                *number = *number * row.diagonal;
            }
            let (first, last, (of_first, of_last)) = row.split(ancestors.len());
            for (of, entry) in ancestors.iter().zip(of_first).take(first) {
                add_product(&mut sum, -*entry, of);
            }
            for (ancestor, entry) in last.iter().zip(of_last) {
                if let Some(of) = ancestors.get(*ancestor) {
                    add_product(&mut sum, -*entry, of);
                }
            }
            *own = sum;
        }
    }
}

impl<T> Row<T> {
    /// How many ancestors are the first rows of all, the others, and the elements of both.
    #[inline(always)]
    fn split(&self, rows: usize) -> (usize, &[usize], (&[T], &[T])) {
        let first = self.first.min(rows);
        let (_, last) = self.path.split_at_checked(first).unwrap_or_default();
        (first, last, self.entries.split_at_checked(first).unwrap_or_default())
    }
}
