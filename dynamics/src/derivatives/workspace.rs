//! [`Workspace`]: what a linearisation writes besides its results, kept so that it is allocated once.

use alloc::vec::Vec;
use core::fmt::{self, Debug, Formatter};

use crate::derivatives::loads::load_columns::LoadsWorkspace;
use crate::derivatives::loads::row_product::RowProduct;
use crate::numbers::real::Scalar;

/// No part of a result: all are equal and look alike, and a copy has none of it yet.
pub(crate) struct Workspace<T> {
    pub(crate) loads: LoadsWorkspace<T>,
    /// The joints that are not locked.
    pub(crate) moving: Vec<usize>,
    pub(crate) product: RowProduct<T>,
}

impl<T: Scalar> Workspace<T> {
    pub(crate) fn new() -> Self {
        let (loads, moving) = (LoadsWorkspace::new(), Vec::new());
        Self { loads, moving, product: RowProduct::new() }
    }
}

impl<T: Scalar> Clone for Workspace<T> {
    fn clone(&self) -> Self {
        Self::new()
    }
}

impl<T> PartialEq for Workspace<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> Debug for Workspace<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("Workspace").finish_non_exhaustive()
    }
}
