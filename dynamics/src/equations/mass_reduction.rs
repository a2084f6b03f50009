//! [`MassReduction`]: shares of damping and stiffness that are subtracted from the mass matrix.
//!
//! ```text
//! (S1)  R = M - x C - y K
//! ```
//!
//! The largest value of `x c + y k` over the kinetic quadratic form m of the same motion is below
//! one exactly where R is positive definite, that is, where every pivot of its elimination is above
//! zero. Damper and spring of a joint are numbers on the diagonal, so the elimination of R is that
//! of the equations of motion with other numbers added to the joints' pivots.

use crate::numbers::real::{Scalar, zero};

/// Shares of damping and stiffness that are subtracted from the mass matrix, (S1).
#[derive(Clone, Copy, Debug)]
pub(crate) struct MassReduction<T> {
    /// `x`, s.
    pub(crate) damping: T,
    /// `y`, s².
    pub(crate) stiffness: T,
}

impl<T: Scalar> MassReduction<T> {
    /// What is subtracted of a joint or mode with this damping and stiffness, kg m² (or kg; of a
    /// mode without unit).
    pub(crate) fn subtracted(&self, damping: T, stiffness: T) -> T {
        // Of a step beyond the root of the largest number a share is infinite.
        let taken = |share: T, number: T| if number == zero() { zero() } else { share * number };
        taken(self.damping, damping) + taken(self.stiffness, stiffness)
    }
}
