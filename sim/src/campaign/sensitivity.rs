//! Derivatives of the numbers of a row by keys, by central differences about the middle of each distribution; ranked by their size
//! over one standard deviation, which is the contribution of a key to the deviation of a linear number.

use nalgebra::{DMatrix, DVector};

use super::axis::set;
use super::{Plan, Sample};
use crate::spectra::float;
use crate::variation::Variation;

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
    /// Whether it is exact; of a central difference otherwise.
    pub exact: bool,
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
            slope.is_finite().then_some(Derivative { label, slope, deviation, exact: false })
        })
        .collect();
    ranked(&mut found);
    found
}

/// Exact derivatives of a number by the keys that have one, ranked.
#[must_use]
pub fn exact_derivatives(variations: &[Variation], slopes: &[f64]) -> Vec<Derivative> {
    let scaled = variations.iter().filter_map(|of| Some((of.label(), of.distribution.scale()?)));
    let mut found: Vec<Derivative> = scaled
        .zip(slopes)
        .map(|((label, [_, deviation]), slope)| Derivative {
            label,
            slope: *slope,
            deviation,
            exact: true,
        })
        .collect();
    ranked(&mut found);
    found
}

/// The largest over a standard deviation first.
fn ranked(all: &mut [Derivative]) {
    all.sort_by(|a, b| b.size().total_cmp(&a.size()));
}

/// Slopes of a plane through a sample by least squares, with their standard errors: of the numbers by each key; none where there
/// are too few samples, or keys that go together. Where a number is linear in the keys these are its derivatives.
#[must_use]
pub fn regression(keys: &[Vec<f64>], numbers: &[f64]) -> Option<Vec<[f64; 2]>> {
    let (rows, count) = (numbers.len(), keys.len());
    if rows < count + 3 || keys.iter().any(|key| key.len() != rows) {
        return None;
    }
    let mean = |of: &[f64]| of.iter().sum::<f64>() / float(rows);
    // Each by its own deviation: keys have units of their own.
    let centred = |of: &[f64]| {
        let middle = mean(of);
        of.iter().map(|value| value - middle).collect::<Vec<f64>>()
    };
    let columns: Vec<Vec<f64>> = keys.iter().map(|key| centred(key)).collect();
    let size = |of: &[f64]| of.iter().map(|value| value * value).sum::<f64>().sqrt();
    let sizes: Vec<f64> = columns.iter().map(|column| size(column)).collect();
    let of = centred(numbers);
    let design = DMatrix::from_fn(rows, count, |row, key| columns[key][row] / sizes[key]);
    let right = DVector::from_vec(of);
    let normal = design.tr_mul(&design);
    let inverse = normal.cholesky()?.inverse();
    let slopes = &inverse * design.tr_mul(&right);
    let rest = (&right - design * &slopes).norm_squared() / float(rows - count - 1);
    let found = (0..count)
        .map(|key| [slopes[key] / sizes[key], (rest * inverse[(key, key)]).sqrt() / sizes[key]]);
    let found: Vec<[f64; 2]> = found.collect();
    found.iter().flatten().all(|value| value.is_finite()).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_found_again_and_noise_widens_the_errors() {
        let x: Vec<f64> = (0..40).map(|k| f64::from(k * 7 % 13)).collect();
        let y: Vec<f64> = (0..40).map(|k| 1e3 * f64::from(k * 5 % 11)).collect();
        let plane = |noise: f64| -> Vec<f64> {
            let wave = |k: usize| noise * (12.9898 * float(k)).sin();
            (0..40).map(|k| 4.0 + 2.0 * x[k] - 3e-3 * y[k] + wave(k)).collect()
        };
        let keys = [x.clone(), y.clone()];
        let exact = regression(&keys, &plane(0.0)).expect("enough samples");
        assert!((exact[0][0] - 2.0).abs() < 1e-12 && (exact[1][0] + 3e-3).abs() < 1e-15);
        let noisy = regression(&keys, &plane(0.5)).expect("enough samples");
        for ([slope, error], expected) in noisy.iter().zip([2.0, -3e-3]) {
            assert!((slope - expected).abs() < 4.0 * error && *error > 0.0, "{slope} {error}");
        }
        assert_eq!(regression(&[x.clone(), x.clone()], &plane(0.0)), None);
    }
}
