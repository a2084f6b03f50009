//! [`GroupGains`]: what back substitution needs of the groups of an evaluation, in lanes.
//!
//! Numbers of each device by itself would have to be taken out of the lanes: of four DGVSCMGs that took
//! as long as to eliminate one.

use std::cell::Cell;
use std::vec::Vec;

use crate::numbers::laned::WIDEST;

/// Numbers of half of the widest lanes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Half(pub(crate) [f64; WIDEST / 2]);

impl Half {
    pub(crate) const ZERO: Self = Self([0.0; WIDEST / 2]);
}

std::thread_local! {
    /// The memory of the last evaluation on this thread: allocating takes time.
    static KEPT: Cell<Vec<Half>> = const { Cell::new(Vec::new()) };
}

/// The gains of groups, one after another, in the order in which the devices are visited.
#[derive(Debug)]
pub(crate) struct GroupGains {
    numbers: Vec<Half>,
    /// How many numbers were written, and how many were read.
    written: usize,
    read: usize,
}

impl GroupGains {
    /// None yet.
    pub(crate) const fn none() -> Self {
        Self { numbers: Vec::new(), written: 0, read: 0 }
    }

    /// Places for so many numbers of the next group.
    #[inline]
    pub(crate) fn next_mut(&mut self, count: usize) -> &mut [Half] {
        let start = self.written;
        self.written = start.saturating_add(count);
        if self.numbers.len() < self.written {
            self.grow();
        }
        self.numbers.get_mut(start..self.written).unwrap_or_default()
    }

    #[cold]
    fn grow(&mut self) {
        if self.numbers.is_empty() {
            self.numbers = KEPT.try_with(Cell::take).unwrap_or_default();
        }
        if self.numbers.len() < self.written {
            self.numbers.resize(self.written, Half::ZERO);
        }
    }

    /// So many numbers of the next group.
    #[inline]
    pub(crate) fn next(&mut self, count: usize) -> &[Half] {
        let start = self.read;
        self.read = start.saturating_add(count);
        self.numbers.get(start..self.read).unwrap_or_default()
    }
}

impl Drop for GroupGains {
    #[inline]
    fn drop(&mut self) {
        if !self.numbers.is_empty() {
            let numbers = core::mem::take(&mut self.numbers);
            // A thread that ends keeps none.
            let _ = KEPT.try_with(|kept| kept.set(numbers));
        }
    }
}
