//! What is written by hand of the emitted crate and computes its constants: here it computes those
//! that `--constants` folds, so that the bits are the same. The other files of this folder are only
//! emitted.

pub(crate) mod body;
#[allow(dead_code, reason = "what is only checked was checked when the description was read")]
pub(crate) mod check;
pub(crate) mod mount;
pub(crate) mod rigid;
pub(crate) mod sin_cos;
