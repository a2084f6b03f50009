//! [`MarginVerdict`]: what became of a requirement on a margin.

use super::analysis::LoopAnalysis;
use crate::pointing::RequirementState;
use crate::scenario::{LoopMargin, MarginRequirement, Scenario};

/// A requirement on a margin, and what was found.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginVerdict<'a> {
    /// The requirement.
    pub requirement: &'a MarginRequirement,
    /// The margin, dB, rad or s; none where it has no bound.
    pub found: Option<f64>,
    /// Met or violated.
    pub state: RequirementState,
}

impl LoopAnalysis {
    /// The smallest gain margin, dB, upwards or downwards, or phase margin, rad, of all axes; the delay margin, s. Zero of a loop that is not stable;
    /// none where no gain, no turn, or no delay of up to 32 periods makes it unstable.
    #[must_use]
    pub fn least(&self, margin: LoopMargin) -> Option<f64> {
        let Some(axes) = &self.axes else { return Some(0.0) };
        let gain = |value: f64| (20.0 * value.log10()).abs();
        let all: Vec<f64> = match margin {
            LoopMargin::Delay => return self.delay,
            LoopMargin::Phase => {
                axes.iter().filter_map(|axis| axis.phase).map(|of| of.value).collect()
            }
            LoopMargin::Gain => axes
                .iter()
                .flat_map(|axis| [axis.gain_up, axis.gain_down])
                .flatten()
                .map(|of| gain(of.value))
                .collect(),
        };
        all.into_iter().reduce(f64::min)
    }

    /// The requirements of a scenario on the margins of a controller, by its name.
    #[must_use]
    pub fn verdicts<'a>(&self, scenario: &'a Scenario, controller: &str) -> Vec<MarginVerdict<'a>> {
        let own = scenario.margin_requirements.iter().filter(|of| of.controller == controller);
        let verdict = |requirement: &'a MarginRequirement| {
            let found = self.least(requirement.margin);
            let met = found.is_none_or(|found| found >= requirement.least) && self.stable;
            let state = if met { RequirementState::Met } else { RequirementState::Violated };
            MarginVerdict { requirement, found, state }
        };
        own.map(verdict).collect()
    }
}
