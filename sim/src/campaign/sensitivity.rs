//! Derivatives of the numbers of a row by keys, by central differences about the middle of each distribution; ranked by their size
//! over one standard deviation, which is the contribution of a key to the deviation of a linear number.

use super::axis::set;
use super::{Plan, Sample, Variation};

/// Steps to either side, of a standard deviation: small against it, and large against what a run's tolerance leaves.
const STEP: f64 = 0.05;

/// The derivative of a number by a key.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivative {
    /// The key with its unit.
    pub label: String,
    /// The number's SI unit by the key's unit.
    pub slope: f64,
    /// Standard deviation of the key, in its unit.
    pub deviation: f64,
}

impl Derivative {
    /// Its magnitude over one standard deviation, in the number's SI unit.
    #[must_use]
    pub fn size(&self) -> f64 {
        (self.slope * self.deviation).abs()
    }
}

/// Two samples for each key that has a derivative: below and above its middle, all others at theirs. Keys that have none (lists,
/// phases) are left as the scenario has them, and have no label.
#[must_use]
pub fn central_differences(variations: &[Variation]) -> Plan {
    let scaled: Vec<(&Variation, [f64; 2])> =
        variations.iter().filter_map(|of| Some((of, of.distribution.scale()?))).collect();
    let mut samples = Vec::new();
    for at in 0..scaled.len() {
        for side in [-STEP, STEP] {
            let value = |(index, (_, [middle, deviation])): (usize, &(&Variation, [f64; 2]))| {
                if index == at { middle + side * deviation } else { *middle }
            };
            let values: Vec<f64> = scaled.iter().enumerate().map(value).collect();
            let pairs = scaled.iter().zip(&values);
            let overrides = pairs.map(|((of, _), value)| set(&of.key, *value, &of.unit)).collect();
            samples.push(Sample { values, overrides });
        }
    }
    Plan {
        labels: scaled.iter().map(|(of, _)| of.label()).collect(),
        samples,
        identity: format!("central differences {STEP} {variations:?}"),
    }
}

/// Derivatives of a number, the largest over a standard deviation first; none by a key of which a sample failed.
#[must_use]
pub fn derivatives(
    variations: &[Variation],
    plan: &Plan,
    values: &[Option<f64>],
) -> Vec<Derivative> {
    let scaled = variations.iter().filter_map(|of| Some((of.label(), of.distribution.scale()?)));
    let pairs = plan.samples.chunks_exact(2).zip(values.chunks_exact(2));
    let mut found: Vec<Derivative> = scaled
        .zip(pairs)
        .enumerate()
        .filter_map(|(key, ((label, [_, deviation]), (samples, values)))| {
            let [below, above] = samples else { return None };
            let [Some(low), Some(high)] = values else { return None };
            let step = above.values.get(key)? - below.values.get(key)?;
            let slope = (high - low) / step;
            slope.is_finite().then_some(Derivative { label, slope, deviation })
        })
        .collect();
    found.sort_by(|a, b| b.size().total_cmp(&a.size()));
    found
}
