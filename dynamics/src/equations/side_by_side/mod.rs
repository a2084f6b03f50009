//! Devices of one kind side by side in lanes: constants, elimination, loads. The same kernels and the same
//! operations in the same order as one after another, with the same bits.

pub(crate) mod back_substitution;
pub(crate) mod blocks;
pub(crate) mod checks;
pub(crate) mod elimination;
pub(crate) mod fallbacks;
pub(crate) mod gains;
pub(crate) mod gather;
pub(crate) mod group;
mod group_loads;
pub(crate) mod loads;
pub(crate) mod passive;
pub(crate) mod put;
pub(crate) mod registers;
mod thresholds;
