//! [`Clock`]: times that repeat at an even rate.

use precess_control::Checkpoint;

use crate::engine::integration::dop853::same;

/// Times `offset + k / rate`, k from 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    offset: f64,
    rate: f64,
    /// k of the next one.
    next: u64,
}

impl Clock {
    pub(super) fn new(offset: f64, rate: f64) -> Self {
        Self { offset, rate, next: 0 }
    }

    /// The next time, s.
    pub(super) fn next(&self) -> f64 {
        self.time(self.next)
    }

    /// The last time that was due, s, without rounding of what was due with it.
    pub(super) fn last(&self) -> f64 {
        self.time(self.next.saturating_sub(1))
    }

    fn time(&self, k: u64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
        let count = k as f64;
        self.offset + count / self.rate
    }

    /// Whether the next time is due; then the one after it is the next.
    pub(super) fn due(&mut self, time: f64) -> bool {
        let due = reached(self.next(), time);
        self.next += u64::from(due);
        due
    }

    /// Visits how many times there were.
    pub(super) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.count(&mut self.next);
    }
}

/// Whether a time is reached, to within rounding.
pub(super) fn reached(due: f64, time: f64) -> bool {
    due <= time || same(due, time)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_time_is_due_once_and_does_not_drift() {
        let mut clock = Clock::new(0.25, 10.0);
        assert!(!clock.due(0.2));
        let mut count = 0_u32;
        for k in 0..=10_000 {
            let time = 0.25 + f64::from(k) * 0.1;
            count += u32::from(clock.due(time));
            assert!(!clock.due(time), "{time}");
            assert_eq!(clock.last(), 0.25 + f64::from(k) / 10.0);
        }
        assert_eq!(count, 10_001);
        assert_eq!(clock.next(), 0.25 + 10_001.0 / 10.0);
    }
}
