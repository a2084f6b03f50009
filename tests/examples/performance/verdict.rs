//! A goal, what was measured, and whether that can be judged.

use serde::Serialize;

use crate::race::Ratio;

/// Both times of a ratio have a smaller spread than this, or it is not judged.
const SPREAD: f64 = 0.10;
/// Both programs did not run for a smaller part of a turn than this, or it is not judged: on a shared
/// core, long batches lose more than short ones, and a ratio is wrong without a large spread.
pub(crate) const WAITED: f64 = 0.02;

/// One row.
#[derive(Debug, Serialize)]
pub(crate) struct Goal {
    what: String,
    target: String,
    measured: String,
    spread: String,
    verdict: String,
}

/// From which side a goal is reached, and what is written after its number.
#[derive(Clone, Copy)]
pub(crate) enum Bound {
    /// Times faster, at least.
    Times,
    /// A share of one, at least; written in per cent.
    Share,
    /// A ratio, at most.
    AtMost,
}

impl Bound {
    fn written(self, value: f64) -> String {
        match self {
            Self::Times => format!("{value:.2} times"),
            Self::Share => format!("{:.0} %", 100.0 * value),
            Self::AtMost => format!("{value:.2}"),
        }
    }

    /// By which part of the goal it is missed; not above zero where it is met.
    fn missed(self, goal: f64, measured: f64) -> f64 {
        match self {
            Self::Times | Self::Share => 1.0 - measured / goal,
            Self::AtMost => measured / goal - 1.0,
        }
    }
}

impl Goal {
    pub(crate) fn new(what: String, bound: Bound, goal: f64, measured: Option<Ratio>) -> Self {
        let target = match bound {
            Bound::AtMost => format!("at most {}", bound.written(goal)),
            _ => bound.written(goal),
        };
        let Some(Ratio { value, spread, waited }) = measured else {
            let [measured, spread] = ["-", "-"].map(str::to_owned);
            return Self { what, target, measured, spread, verdict: "not measured".to_owned() };
        };
        let missed = bound.missed(goal, value);
        let noisy = spread.is_nan() || spread >= SPREAD;
        let verdict = if waited >= WAITED {
            format!("too noisy to judge: no core for {:.0} % of the time", 100.0 * waited)
        } else if noisy {
            "too noisy to judge".to_owned()
        } else if missed > 0.0 {
            format!("missed by {:.1} %", 100.0 * missed)
        } else {
            "met".to_owned()
        };
        let spread = format!("{:.0} %", 100.0 * spread);
        Self { what, target, measured: bound.written(value), spread, verdict }
    }
}

impl std::fmt::Display for Goal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { what, target, measured, spread, verdict } = self;
        write!(f, "{what:72} goal {target:>13}  measured {measured:>12} ({spread:>5})  {verdict}")
    }
}

#[cfg(test)]
mod tests {
    use super::{Bound, Goal};
    use crate::race::Ratio;

    #[test]
    fn a_ratio_of_a_noisy_time_is_not_judged() {
        let verdict = |bound, goal, value, spread| {
            let ratio = Ratio { value, spread, waited: 0.0 };
            Goal::new(String::new(), bound, goal, Some(ratio)).verdict
        };
        assert_eq!(verdict(Bound::Times, 8.0, 9.0, 0.02), "met");
        assert_eq!(verdict(Bound::Times, 8.0, 6.0, 0.02), "missed by 25.0 %");
        assert_eq!(verdict(Bound::AtMost, 1.15, 1.1, 0.09), "met");
        assert_eq!(verdict(Bound::Share, 0.75, 0.9, 0.1), "too noisy to judge");
        assert_eq!(verdict(Bound::Times, 8.0, 9.0, f64::NAN), "too noisy to judge");
    }

    #[test]
    fn a_ratio_on_a_shared_core_is_not_judged() {
        let ratio = Ratio { value: 40.0, spread: 0.01, waited: 0.48 };
        let goal = Goal::new(String::new(), Bound::Times, 30.0, Some(ratio));
        assert_eq!(goal.verdict, "too noisy to judge: no core for 48 % of the time");
    }
}
