//! [`Forces`]: what the suspension of an isolated platform exerts on its joints, as loads and powers take it.

use crate::numbers::real::{Scalar, zero};

/// A number for each joint, in order.
pub(crate) type Six<T> = [T; 6];

/// Forces of a suspension on the joints, and its energy.
#[derive(Clone, Copy, Debug)]
pub struct Forces<T> {
    pub(crate) springs: Six<T>,
    pub(crate) dampers: Six<T>,
    /// V, J.
    pub(crate) potential: T,
}

impl<T: Scalar> Forces<T> {
    pub(crate) fn none() -> Self {
        Self { springs: [zero(); 6], dampers: [zero(); 6], potential: zero() }
    }
}
