//! Filters: a transfer function of second order, made discrete, and sections one after another.

pub(crate) mod analog;
pub(crate) mod cascade;
pub(crate) mod section;
