//! Advice about a requirement on a band whose window is too short for the band's lowest frequency.

use super::Advice;
use crate::scenario::{Requirement, Scenario, Statistic};

/// Fewer periods of a band's lowest frequency in a window, and the main lobe of Hann's window, two resolutions to
/// each side, reaches from there to zero.
pub(super) const PERIODS_MIN: f64 = 2.0;

/// The requirement on a band whose window has the fewest periods of its lowest frequency, where these are too few.
pub(super) fn too_short(scenario: &Scenario) -> Option<Advice> {
    let short = |of: &Requirement| {
        let Statistic::BandRms([lowest, _]) = of.statistic else { return None };
        let [from, to] = of.window;
        let window = to.min(scenario.settings.duration) - from;
        let too_short = lowest > 0.0 && window > 0.0 && window * lowest < PERIODS_MIN;
        too_short.then(|| Advice::ShortWindow { requirement: of.name.clone(), lowest, window })
    };
    let least = |of: &Advice| match of {
        Advice::ShortWindow { lowest, window, .. } => lowest * window,
        _ => f64::INFINITY,
    };
    scenario.requirements.iter().filter_map(short).min_by(|a, b| least(a).total_cmp(&least(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::tests::{scenario, wheel};
    use crate::file::Diagnostic;
    use crate::scenario::Projection;

    /// 1.5 periods of 1 Hz in 1.5 s, three in the whole run.
    #[test]
    fn a_window_too_short_for_its_band_is_named() {
        let mut still = scenario(&["wheel"], vec![wheel().into()], 3.0);
        let requirement = |from: f64| Requirement {
            name: "pointing".to_owned(),
            quantity: "omega".to_owned(),
            projection: Projection::None,
            statistic: Statistic::BandRms([1.0, 20.0]),
            window: [from, f64::INFINITY],
            limit: 1.0,
            written: "1 rad/s".to_owned(),
            unit: ("rad/s".to_owned(), 1.0),
        };
        still.requirements = vec![requirement(0.0)];
        assert_eq!(too_short(&still), None);
        still.requirements.push(requirement(1.5));
        let found = too_short(&still).expect("advice");
        let shown = Diagnostic::from(&found);
        assert!(shown.message.contains("its window of 1.5 s has 1.5 periods"), "{}", shown.message);
        assert_eq!(shown.help, "let the window be 2 s or more");
    }
}
