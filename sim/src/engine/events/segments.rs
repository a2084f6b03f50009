//! [`Segments`]: the times at which a step must end, and the changes due there.
//!
//! They are the breaks of all profiles and measured records, the times at which a source begins and ends, the times at which a profile reaches the limit of its motor
//! ([`clipping`](super::clipping)), the changes, and the end of the run.

use precess_control::Checkpoint;

use super::clipping;
use crate::disturbance::Model;
use crate::scenario::{Action, Change, Profile, Scenario};

/// The ends of segments in the order of time.
#[derive(Clone, Debug)]
pub(crate) struct Segments<'a> {
    /// Each above the one before; the last one is the end of the run.
    ends: Vec<f64>,
    next: usize,
    /// Profiles with a limit, which may pass it between two of these.
    limited: Vec<(&'a Profile, f64)>,
    /// The end of the present segment.
    end: f64,
    /// In the order of time.
    changes: Vec<&'a Change>,
    due: usize,
}

impl<'a> Segments<'a> {
    pub(crate) fn new(scenario: &'a Scenario) -> Self {
        let duration = scenario.settings.duration;
        let mut changes: Vec<_> = scenario.changes.iter().collect();
        changes.sort_by(|a, b| a.time.total_cmp(&b.time));
        let mut ends: Vec<f64> = changes.iter().map(|change| change.time).collect();
        let changed = changes.iter().filter_map(|change| match &change.action {
            Action::Drive(drive) => Some(drive),
            Action::Brake | Action::Release => None,
        });
        let mut limited = Vec::new();
        for drive in scenario.drives.iter().chain(changed) {
            ends.extend(drive.profile().map(Profile::breaks).unwrap_or_default());
            if let (Some(profile), Some(limit)) = (drive.profile(), drive.limits().torque) {
                clipping::straight(profile, limit.abs(), &mut ends);
                limited.push((profile, limit.abs()));
            }
        }
        for wrench in &scenario.wrenches {
            ends.extend(wrench.force.iter().chain(&wrench.moment).flat_map(Profile::breaks));
        }
        for of in &scenario.disturbances {
            ends.extend(of.window);
            if let Model::Measured(record) = &of.model {
                ends.extend(record.breaks(duration));
            }
        }
        ends.retain(|end| 0.0 < *end && *end < duration);
        ends.push(duration);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        Self { ends, next: 0, limited, end: 0.0, changes, due: 0 }
    }

    /// The end of the segment that starts at a time; times only grow from call to call.
    pub(crate) fn end_after(&mut self, time: f64) -> f64 {
        if self.end > time {
            return self.end;
        }
        while self.next + 1 < self.ends.len() && self.ends[self.next] <= time {
            self.next += 1;
        }
        let listed = self.ends[self.next];
        let passes = self.limited.iter().filter_map(|(of, limit)| clipping::next(of, *limit, time));
        self.end = passes.filter(|pass| *pass > time).fold(listed, f64::min);
        self.end
    }

    /// Visits where it is.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.index(&mut self.next, self.ends.len());
        checkpoint.number(&mut self.end);
        checkpoint.index(&mut self.due, self.changes.len() + 1);
    }

    /// The changes up to a time that have not been returned yet.
    pub(crate) fn due(&mut self, time: f64) -> &[&'a Change] {
        let from = self.due;
        self.due += self.changes[from..].iter().take_while(|change| change.time <= time).count();
        &self.changes[from..self.due]
    }
}
