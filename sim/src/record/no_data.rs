//! [`no_data`]: why a requirement cannot be evaluated by a whole run, known before the run.

use super::welch::{SHORTEST, expected_empty_band};
use crate::pointing::{EXPOSURE_SAMPLES_MIN, Index, NoData, samples_of};
use crate::scenario::{Requirement, Statistic};
use crate::spectra::float;

/// A sample this near to an end of a window, in samples, is within it: times of samples are rounded.
const ROUNDING: f64 = 1e-6;

/// Why a requirement has no data in a whole run of a duration, s, recorded at a rate, 1/s; none where it has.
#[must_use]
pub fn no_data(requirement: &Requirement, rate: f64, duration: f64) -> Option<NoData> {
    let window @ [from, to] = requirement.window;
    let samples = samples_within(window, rate);
    // The end of the run has a sample that need not be evenly spaced.
    if samples == 0 && to < duration {
        return Some(NoData::NoSample { window });
    }
    let length = to - from;
    let needs = |window: f64, least: usize| samples_of(window, rate, least).ok();
    let short = |needed: f64, count: Option<usize>| {
        count.is_some_and(|count| count > samples).then_some(NoData::Short { needed, length })
    };
    match requirement.statistic {
        Statistic::Peak | Statistic::Rms | Statistic::Final | Statistic::Drift => None,
        Statistic::BandRms(_) if samples < SHORTEST => {
            Some(NoData::FewSamples { least: SHORTEST, length })
        }
        Statistic::BandRms(band) => expected_empty_band(band, rate, length * rate, samples)
            .map(|resolution| NoData::NoBin { band, resolution }),
        Statistic::Displacement(time) | Statistic::Smear(time) | Statistic::Jitter(time) => {
            short(time, needs(time, EXPOSURE_SAMPLES_MIN))
        }
        Statistic::Index { index, .. } => {
            let window = index.window()?;
            let lag =
                if let Index::Pde { stability, .. } = index { stability / window } else { 0.0 };
            let of_window = needs(window, 1)?;
            let count = float(of_window) * (1.0 + lag.round());
            (count > float(samples))
                .then_some(NoData::Short { needed: window * (1.0 + lag), length })
        }
    }
}

/// Evenly spaced samples within a window, s, at a rate, 1/s.
fn samples_within([from, to]: [f64; 2], rate: f64) -> usize {
    let first = (from * rate - ROUNDING).ceil();
    let last = (to * rate + ROUNDING).floor();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a cast saturates; a run has a bounded number of samples"
    )]
    let count = (last - first + 1.0).max(0.0) as usize;
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Projection;

    fn reason(statistic: Statistic, window: [f64; 2]) -> Option<NoData> {
        let requirement = Requirement {
            name: "a".to_owned(),
            quantity: "omega".to_owned(),
            projection: Projection::None,
            statistic,
            window,
            limit: 1.0,
            written: "1 rad/s".to_owned(),
            unit: ("rad/s".to_owned(), 1.0),
        };
        no_data(&requirement, 100.0, 10.0)
    }

    #[test]
    fn each_statistic_without_data_has_its_reason() {
        let whole = [0.0, 10.0];
        let index = |index| Statistic::Index { index, level: 0.99 };
        let short = |needed| Some(NoData::Short { needed, length: 10.0 });
        for (statistic, window, expected) in [
            (Statistic::Peak, whole, None),
            (Statistic::Rms, [1.001, 1.009], Some(NoData::NoSample { window: [1.001, 1.009] })),
            (Statistic::Final, [9.995, 10.0], None),
            (Statistic::BandRms([2.0, 4.0]), whole, None),
            (
                Statistic::BandRms([2.0, 4.0]),
                [1.0, 1.1],
                Some(NoData::FewSamples { least: 16, length: 1.1 - 1.0 }),
            ),
            (
                Statistic::BandRms([2.31, 2.32]),
                [0.0, 1.0],
                Some(NoData::NoBin { band: [2.31, 2.32], resolution: 1.0 }),
            ),
            (Statistic::Smear(10.0), whole, None),
            (Statistic::Smear(10.2), whole, short(10.2)),
            (index(Index::Ape), whole, None),
            (index(Index::Mpe { window: 10.5 }), whole, short(10.5)),
            (index(Index::Pde { window: 5.0, stability: 5.0 }), whole, None),
            (index(Index::Pde { window: 5.0, stability: 10.0 }), whole, short(15.0)),
        ] {
            assert_eq!(reason(statistic, window), expected, "{statistic:?}");
        }
    }
}
