//! [`Segments`]: the times at which a step must end, and the changes due there.
//!
//! They are the breaks of all profiles, the times at which a ramp or a table reaches the torque
//! limit, the changes, and the end of the run. A profile that is a sine or a chirp reaches its
//! limit at a kink that no step ends on; DOP853 shortens its steps there, RK4 does not.

use crate::scenario::{Action, Change, Drive, Interpolation, Profile, Scenario};

/// The ends of segments in the order of time.
#[derive(Clone, Debug)]
pub(crate) struct Segments<'a> {
    /// Each above the one before; the last one is the end of the run.
    ends: Vec<f64>,
    next: usize,
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
            Action::Brake => None,
        });
        for drive in scenario.drives.iter().chain(changed) {
            ends.extend(drive.profile().map(Profile::breaks).unwrap_or_default());
            if let Drive::Torque { profile, limit: Some(limit) } = drive {
                clips(profile, limit.abs(), &mut ends);
            }
        }
        for wrench in &scenario.wrenches {
            ends.extend(wrench.force.iter().chain(&wrench.moment).flat_map(Profile::breaks));
        }
        ends.retain(|end| 0.0 < *end && *end < duration);
        ends.push(duration);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        Self { ends, next: 0, changes, due: 0 }
    }

    /// The end of the segment that starts at a time; times only grow from call to call.
    pub(crate) fn end_after(&mut self, time: f64) -> f64 {
        while self.next + 1 < self.ends.len() && self.ends[self.next] <= time {
            self.next += 1;
        }
        self.ends[self.next]
    }

    /// The changes up to a time that have not been returned yet.
    pub(crate) fn due(&mut self, time: f64) -> &[&'a Change] {
        let from = self.due;
        self.due += self.changes[from..].iter().take_while(|change| change.time <= time).count();
        &self.changes[from..self.due]
    }
}

/// Adds the times at which a piecewise linear profile passes the limit.
fn clips(profile: &Profile, limit: f64, ends: &mut Vec<f64>) {
    let mut piece = |[from, to]: [f64; 2], [first, last]: [f64; 2]| {
        for bound in [-limit, limit] {
            if (first - bound) * (last - bound) < 0.0 {
                ends.push(from + (to - from) * ((bound - first) / (last - first)));
            }
        }
    };
    match profile {
        Profile::Ramp { between, values } => piece(*between, *values),
        Profile::Table(table) if table.interpolation == Interpolation::Linear => {
            for (times, values) in table.times.windows(2).zip(table.values.windows(2)) {
                piece([times[0], times[1]], [values[0], values[1]]);
            }
        }
        Profile::During { profile, .. } => clips(profile, limit, ends),
        _ => {}
    }
}
