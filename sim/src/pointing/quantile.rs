//! [`Quantile`]: a quantile of any number of values that are not negative, in bounded memory.
//!
//! Values are counted in buckets of equal leading bits: 1024 in each octave. The result is the upper end of a bucket,
//! so it is at most 0.1 % above the quantile and never below it.

use std::collections::BTreeMap;

use super::PointingError;
use crate::spectra::float;

/// Bits of a double that a bucket leaves out: 52 of the fraction less ten.
const LEFT_OUT: u32 = 42;

/// Counts of values.
#[derive(Clone, Debug, Default)]
pub(crate) struct Quantile {
    buckets: BTreeMap<u64, u64>,
    count: u64,
    most: f64,
    /// Values that are no numbers.
    is_nan: bool,
}

impl Quantile {
    /// One value.
    pub(crate) fn add(&mut self, value: f64) {
        if value.is_nan() {
            self.is_nan = true;
            return;
        }
        self.count += 1;
        self.most = self.most.max(value);
        // Doubles that are not negative have the order of their bits.
        *self.buckets.entry(value.abs().to_bits() >> LEFT_OUT).or_default() += 1;
    }

    /// Least value that at least a share `level` of all values do not exceed; NaN if one of them is; none of none.
    pub(crate) fn at(&self, level: f64) -> Option<f64> {
        if self.is_nan {
            return Some(f64::NAN);
        }
        let rank = rank(usize::try_from(self.count).ok()?, level)?;
        let mut below = 0;
        for (bucket, count) in &self.buckets {
            below += *count;
            if usize::try_from(below).ok()? >= rank {
                let end = f64::from_bits((bucket << LEFT_OUT) | ((1 << LEFT_OUT) - 1));
                return Some(end.min(self.most));
            }
        }
        Some(self.most)
    }
}

/// Which of n values in rising order, from 1, is the quantile of a level: the first that a share `level` of them do not
/// exceed. None of no values.
pub(super) fn rank(count: usize, level: f64) -> Option<usize> {
    if count == 0 {
        return None;
    }
    // 0.9 * 10 is 9: a product that is whole but for rounding is whole.
    let exact = level * float(count);
    let whole = exact.round();
    let up = if (exact - whole).abs() <= 1e-9 * exact { whole } else { exact.ceil() };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 1 and the count"
    )]
    let rank = up.clamp(1.0, float(count)) as usize;
    Some(rank)
}

/// The quantile of a level, exactly.
pub(super) fn quantile(mut values: Vec<f64>, level: f64) -> Result<f64, PointingError> {
    let short = PointingError::Short { samples: values.len(), least: 1 };
    let rank = rank(values.len(), level).ok_or(short.clone())?;
    values.sort_by(f64::total_cmp);
    values.get(rank - 1).copied().ok_or(short)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectra::synthetic::Random;

    #[test]
    fn the_bounded_quantile_is_at_most_a_thousandth_above_the_exact_one() {
        let mut random = Random::new(5);
        let values: Vec<f64> = (0..20_000).map(|_| (3.0 * random.normal()).exp()).collect();
        let mut bounded = Quantile::default();
        for value in &values {
            bounded.add(*value);
        }
        for level in [0.01, 0.5, 0.683, 0.9973, 0.999_99] {
            let exact = quantile(values.clone(), level).expect("values");
            let found = bounded.at(level).expect("values");
            assert!(exact <= found && found <= 1.001 * exact, "{level}: {found} for {exact}");
        }
    }

    #[test]
    fn ranks_are_those_of_the_definition() {
        let ranks = [0.0, 0.05, 0.1, 0.3, 0.9, 0.901, 1.0].map(|level| rank(10, level));
        assert_eq!(ranks, [1, 1, 1, 3, 9, 10, 10].map(Some));
        assert_eq!(rank(0, 0.5), None);
        let mut of_nan = Quantile::default();
        assert_eq!(of_nan.at(0.5), None);
        of_nan.add(f64::NAN);
        assert!(of_nan.at(0.5).is_some_and(f64::is_nan));
    }
}
