//! A structure with modes: where its numbers are kept, its state, inputs and errors.

pub(crate) mod inputs;
pub(crate) mod modes;
pub(crate) mod modes_error;
pub(crate) mod state;
pub(crate) mod storage;
