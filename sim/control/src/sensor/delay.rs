//! [`DelayLine`]: readings that arrive later than they are measured.

use alloc::collections::VecDeque;

use crate::checkpoint::Checkpoint;
use crate::model::error::{self, ControlError};

/// Of the period, by which times that are equal but for rounding may differ.
const ROUNDING: f64 = 1e-9;

/// A line of readings, each of which arrives a fixed time after it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct DelayLine<T> {
    latency: f64,
    tolerance: f64,
    line: VecDeque<(f64, T)>,
    capacity: usize,
}

impl<T> DelayLine<T> {
    /// The longest latency, in periods.
    pub const LONGEST: f64 = 1e4;

    /// Of a latency, s, for readings that are a period apart, s, at least. Room for what is on its way is made here, and
    /// nowhere else.
    ///
    /// # Errors
    ///
    /// A latency that is negative, a period that is not positive, or more than [`Self::LONGEST`] periods of latency.
    pub fn new(latency: f64, period: f64) -> Result<Self, ControlError> {
        error::not_negative("latency", latency)?;
        error::positive("sampling period", period)?;
        let periods = latency / period;
        if periods > Self::LONGEST {
            return Err(ControlError::TooLong { periods, longest: Self::LONGEST });
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative, at most LONGEST"
        )]
        let capacity = libm::ceil(periods) as usize + 2;
        let line = VecDeque::with_capacity(capacity);
        Ok(Self { latency, tolerance: ROUNDING * period, line, capacity })
    }

    /// Takes a reading measured at a time, s, not before that of the last one. Of more than there is room for, the oldest
    /// is lost.
    pub fn put(&mut self, measured: f64, reading: T) {
        if self.line.len() >= self.capacity {
            self.line.pop_front();
        }
        self.line.push_back((measured, reading));
    }

    /// The newest reading that has arrived by a time, s, and when it was measured; none if no other has arrived since the
    /// last that was returned. Older ones are dropped.
    pub fn newest(&mut self, now: f64) -> Option<(f64, T)> {
        let mut found = None;
        while let Some((measured, _)) = self.line.front() {
            if measured + self.latency > now + self.tolerance {
                break;
            }
            found = self.line.pop_front();
        }
        found
    }

    /// Visits the readings on their way, each read into a blank.
    pub fn visit(
        &mut self,
        checkpoint: &mut Checkpoint<'_>,
        blank: impl Fn() -> T,
        mut each: impl FnMut(&mut Checkpoint<'_>, &mut T),
    ) {
        let blank = || (0.0, blank());
        checkpoint.queue(&mut self.line, blank, |checkpoint, (measured, reading)| {
            checkpoint.number(measured);
            each(checkpoint, reading);
        });
    }
}
