//! [`Section`]: a discrete filter of second order with its state.

use crate::checkpoint::Checkpoint;
use crate::model::error::{self, ControlError};

/// `(b0 + b1 / z + b2 / z²) / (1 + a1 / z + a2 / z²)` in the transposed direct form II.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    b: [f64; 3],
    a: [f64; 2],
    state: [f64; 2],
}

impl Section {
    /// Of coefficients `[b0, b1, b2]` and `[a1, a2]`, at rest.
    ///
    /// # Errors
    ///
    /// A coefficient that is not finite, or a pole that is not inside the unit circle.
    pub fn new(b: [f64; 3], a: [f64; 2]) -> Result<Self, ControlError> {
        for value in b.into_iter().chain(a) {
            error::finite("coefficient", value)?;
        }
        let [a1, a2] = a;
        let stable = a2.abs() < 1.0 && a1.abs() < 1.0 + a2;
        if !stable {
            return Err(ControlError::Unstable { first: a1, second: a2 });
        }
        Ok(Self { b, a, state: [0.0; 2] })
    }

    /// `[b0, b1, b2]`.
    #[must_use]
    pub fn numerator(&self) -> [f64; 3] {
        self.b
    }

    /// `[a1, a2]`.
    #[must_use]
    pub fn denominator(&self) -> [f64; 2] {
        self.a
    }

    /// What a constant input becomes at last, over the input.
    #[must_use]
    pub fn gain(&self) -> f64 {
        let ([b0, b1, b2], [a1, a2]) = (self.b, self.a);
        (b0 + b1 + b2) / (1.0 + a1 + a2)
    }

    /// The output of the next sample.
    pub fn filter(&mut self, input: f64) -> f64 {
        let ([b0, b1, b2], [a1, a2], [first, second]) = (self.b, self.a, self.state);
        let output = b0 * input + first;
        self.state = [b1 * input - a1 * output + second, b2 * input - a2 * output];
        output
    }

    /// The state that a constant input leads to, so that a first sample like it causes no transient; the output then.
    pub fn settle(&mut self, input: f64) -> f64 {
        let output = self.gain() * input;
        let ([_, b1, b2], [a1, a2]) = (self.b, self.a);
        let second = b2 * input - a2 * output;
        self.state = [b1 * input - a1 * output + second, second];
        output
    }

    /// At rest.
    pub fn reset(&mut self) {
        self.state = [0.0; 2];
    }

    /// Visits its state.
    pub fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.numbers(&mut self.state);
    }
}
