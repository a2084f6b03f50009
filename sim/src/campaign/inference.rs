//! What a sample says about its distribution: percentiles with distribution-free intervals, probabilities with the interval of
//! Clopper and Pearson, rank correlation by Spearman and how probable it is by chance.

use statrs::distribution::{Beta, ContinuousCDF as _, StudentsT};

use crate::spectra::float;

/// A value and the interval that contains the true one with at least a stated probability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Lower and upper end; infinite where the sample is too small for one.
    pub interval: [f64; 2],
}

/// The percentile of a probability by the order statistics of a sorted sample, with an interval that holds for any continuous
/// distribution: order statistics l < u with `P(X_(l) <= q < X_(u)) >= level`, by binomial tails of `(1 - level) / 2` each
/// (David and Nagaraja, Order Statistics, 3rd edition, 7.1). None of an empty sample, and of a probability or level that is
/// not between zero and one.
#[must_use]
pub fn percentile(sorted: &[f64], probability: f64, level: f64) -> Option<Estimate> {
    if !(is_share(probability) && is_share(level)) {
        return None;
    }
    let count = sorted.len();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of the count"
    )]
    let place = (probability * float(count)).ceil().max(1.0) as usize;
    let value = *sorted.get(place.min(count).checked_sub(1)?)?;
    let tail = 0.5 * (1.0 - level);
    // P(X_(k) <= q) = P(Bin(n, p) >= k) = I_p(k, n - k + 1), which falls as k grows.
    let below = |k: usize| at_least(count, k, probability);
    let (mut lowest, mut most) = (0, count + 1);
    while most - lowest > 1 {
        let middle = lowest.midpoint(most);
        if below(middle) >= 1.0 - tail { lowest = middle } else { most = middle }
    }
    let lower = lowest.checked_sub(1).and_then(|k| sorted.get(k)).copied();
    let (mut least, mut highest) = (0, count + 1);
    while highest - least > 1 {
        let middle = least.midpoint(highest);
        if below(middle) <= tail { highest = middle } else { least = middle }
    }
    let upper = sorted.get(highest - 1).copied();
    let ends = [lower.unwrap_or(f64::NEG_INFINITY), upper.unwrap_or(f64::INFINITY)];
    Some(Estimate { value, interval: ends })
}

/// Whether a number is between zero and one, both included.
fn is_share(number: f64) -> bool {
    (0.0..=1.0).contains(&number)
}

/// The probability that at least k of n independent trials succeed, each with a probability between zero and one.
fn at_least(n: usize, k: usize, probability: f64) -> f64 {
    if k == 0 {
        return 1.0;
    }
    if k > n {
        return 0.0;
    }
    Beta::new(float(k), float(n - k + 1)).map_or(f64::NAN, |beta| beta.cdf(probability))
}

/// A probability by n trials of which the success of some is unknown, with the least and the most successes that there may be:
/// the interval is from the lower end with none of the unknown ones to the upper end with all of them, and the value is NaN where
/// there are some. None without trials.
#[must_use]
pub fn probability_between([least, most]: [usize; 2], n: usize, level: f64) -> Option<Estimate> {
    let (low, high) = (probability(least, n, level)?, probability(most, n, level)?);
    let value = if least == most { low.value } else { f64::NAN };
    Some(Estimate { value, interval: [low.interval[0], high.interval[1]] })
}

/// A probability by `k` successes of `n` trials, with the interval of Clopper and Pearson (Biometrika 26, 1934): ends at which
/// one tail of the binomial distribution is `(1 - level) / 2`. None without trials, and of a level that is not between zero and one.
#[must_use]
pub fn probability(k: usize, n: usize, level: f64) -> Option<Estimate> {
    if n == 0 || k > n || !is_share(level) {
        return None;
    }
    let tail = 0.5 * (1.0 - level);
    // Bisection over the binomial tails: the probability is within [0, 1], and 60 halvings are below rounding.
    let solve = |k: usize, wanted: f64| {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if at_least(n, k, middle) < wanted { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    let lower = if k == 0 { 0.0 } else { solve(k, tail) };
    let upper = if k == n { 1.0 } else { solve(k + 1, 1.0 - tail) };
    Some(Estimate { value: float(k) / float(n), interval: [lower, upper] })
}

/// Ranks, equal values with the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    let value = |index: usize| values.get(index).copied().unwrap_or(f64::NAN);
    order.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
    let mut ranks = vec![0.0; values.len()];
    let mut start = 0;
    for group in order.chunk_by(|a, b| value(*a) == value(*b)) {
        let rank = float(start) + 0.5 * float(group.len() - 1);
        for index in group {
            if let Some(place) = ranks.get_mut(*index) {
                *place = rank;
            }
        }
        start += group.len();
    }
    ranks
}

/// Rank correlation by Spearman: the correlation of ranks, -1 to 1. None of fewer than three pairs, or where one of the two
/// does not vary.
#[must_use]
pub fn spearman(x: &[f64], y: &[f64]) -> Option<f64> {
    if x.len() != y.len() || x.len() < 3 {
        return None;
    }
    let (x, y) = (ranks(x), ranks(y));
    let middle = 0.5 * float(x.len() - 1);
    let product = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum::<f64>()
    };
    let size = (product(&x, &x) * product(&y, &y)).sqrt();
    (size > 0.0).then(|| product(&x, &y) / size)
}

/// Pairs from which on the distribution by which [`by_chance`] judges is close to that of all permutations.
const PAIRS_MIN: usize = 10;

/// The probability that a rank correlation of n pairs is at least as far from zero by chance, where one does not depend on the
/// other: `r sqrt((n - 2) / (1 - r^2))` is nearly of Student's distribution with n - 2 degrees of freedom (Kendall and Gibbons,
/// Rank Correlation Methods, 5th edition, 4.4). None of fewer than ten pairs.
#[must_use]
pub fn by_chance(correlation: f64, pairs: usize) -> Option<f64> {
    if pairs < PAIRS_MIN || correlation.is_nan() {
        return None;
    }
    let freedom = float(pairs - 2);
    let left = 1.0 - correlation * correlation;
    if left <= 0.0 {
        return Some(0.0);
    }
    let of = StudentsT::new(0.0, 1.0, freedom).ok()?;
    Some(2.0 * of.cdf(-correlation.abs() * (freedom / left).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the incomplete beta function.
    const BETA: f64 = 1e-9;

    #[test]
    fn what_is_no_probability_has_no_estimate() {
        for wrong in [f64::NAN, -0.1, 1.1, f64::INFINITY] {
            assert_eq!(percentile(&[1.0, 2.0], wrong, 0.95), None);
            assert_eq!(percentile(&[1.0, 2.0], 0.5, wrong), None);
            assert_eq!(probability(1, 2, wrong), None);
        }
        assert!(percentile(&[1.0, 2.0], 1.0, 0.95).is_some());
    }

    #[test]
    fn intervals_of_probabilities_are_closed_forms_at_the_ends() {
        // 0 of n: the upper end is 1 - tail^(1/n). Clopper and Pearson.
        for n in [1_u32, 10, 300] {
            let found = probability(0, n as usize, 0.95).expect("trials");
            let upper = 1.0 - 0.025_f64.powf(1.0 / f64::from(n));
            assert!(found.interval[0] == 0.0 && (found.interval[1] - upper).abs() < BETA);
            let found = probability(n as usize, n as usize, 0.95).expect("trials");
            assert!((found.interval[0] - (1.0 - upper)).abs() < BETA && found.interval[1] == 1.0);
        }
        // At the ends the tails, written out as sums, are a fortieth each.
        let (n, k) = (20_i32, 3_i32);
        let found = probability(3, 20, 0.95).expect("trials");
        let choose = |j: i32| (0..j).fold(1.0, |c, i| c * f64::from(n - i) / f64::from(i + 1));
        let tail = |p: f64, of: std::ops::RangeInclusive<i32>| {
            of.map(|j| choose(j) * p.powi(j) * (1.0 - p).powi(n - j)).sum::<f64>()
        };
        assert!((tail(found.interval[0], k..=n) - 0.025).abs() < BETA);
        assert!((tail(found.interval[1], 0..=k) - 0.025).abs() < BETA);
        assert_eq!(probability(0, 0, 0.95), None);
    }

    #[test]
    fn what_is_unknown_widens_the_interval_of_a_probability() {
        let known = |k| probability(k, 50, 0.95).expect("trials");
        let same = probability_between([7, 7], 50, 0.95).expect("trials");
        assert_eq!(same, known(7));
        let found = probability_between([7, 12], 50, 0.95).expect("trials");
        assert_eq!(found.interval, [known(7).interval[0], known(12).interval[1]]);
        assert!(found.value.is_nan());
    }

    #[test]
    fn percentiles_have_the_order_statistics_of_tables() {
        // Median of ten: second and ninth, 0.9785 (David and Nagaraja, 7.1).
        let ten: Vec<f64> = (1..=10).map(f64::from).collect();
        let found = percentile(&ten, 0.5, 0.95).expect("a sample");
        assert_eq!((found.value, found.interval), (5.0, [2.0, 9.0]));
        // The largest of n is above the 95th percentile but with a probability of 0.95^n, below 0.025 from 72 on.
        let sample = |n: u32| (1..=n).map(f64::from).collect::<Vec<_>>();
        let upper = |n| percentile(&sample(n), 0.95, 0.95).expect("a sample").interval[1];
        assert!(upper(71) == f64::INFINITY && upper(72) == 72.0);
        assert_eq!(percentile(&[], 0.5, 0.95), None);
    }

    #[test]
    fn rank_correlation_is_that_of_any_rising_function() {
        let x: Vec<f64> = (0..50).map(|i| f64::from(i * 7 % 50)).collect();
        let up: Vec<f64> = x.iter().map(|x| (0.2 * x).exp()).collect();
        let down: Vec<f64> = x.iter().map(|x| -x.powi(3)).collect();
        assert!((spearman(&x, &up).expect("varies") - 1.0).abs() < 1e-14);
        assert!((spearman(&x, &down).expect("varies") + 1.0).abs() < 1e-14);
        assert_eq!(spearman(&x, &vec![1.0; 50]), None);
        // 1 - 6 sum d^2 / (n (n^2 - 1)) without ties: d = 1, -1, 0, 0.
        let found = spearman(&[1.0, 2.0, 3.0, 4.0], &[2.0, 1.0, 3.0, 4.0]).expect("varies");
        assert!((found - 0.8).abs() < 1e-14);
    }

    #[test]
    fn a_rank_correlation_by_chance_is_that_of_tables_and_of_permutations() {
        // The critical values of Student's t at 0.05, two-sided: 2.306 with 8, 1.984 with 98 degrees of freedom.
        for (pairs, t) in [(10, 2.306_004_135), (100, 1.984_467_454)] {
            let freedom = float(pairs - 2);
            let r = t / (freedom + t * t).sqrt();
            for r in [r, -r] {
                let found = by_chance(r, pairs).expect("enough pairs");
                assert!((found - 0.05).abs() < 1e-8, "{found}");
            }
        }
        assert_eq!((by_chance(0.0, 50), by_chance(1.0, 50)), (Some(1.0), Some(0.0)));
        assert_eq!((by_chance(0.9, 9), by_chance(f64::NAN, 50)), (None, None));
        // Of random permutations of twelve, the share that is as far from zero.
        let still: Vec<f64> = (0..12).map(f64::from).collect();
        let mut seed = 1_u64;
        let mut drawn = || {
            let mut moved = still.clone();
            for last in (1..12_usize).rev() {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                let other = (seed >> 33) as usize % (last + 1);
                moved.swap(last, other);
            }
            spearman(&still, &moved).expect("varies").abs()
        };
        let (count, at) = (20_000, 0.5);
        let beyond = (0..count).filter(|_| drawn() >= at).count();
        let (share, known) = (float(beyond) / float(count), by_chance(at, 12).expect("enough"));
        // Four deviations of the share, and what the approximation leaves at twelve pairs.
        assert!(
            (share - known).abs() < 4.0 * (known / float(count)).sqrt() + 4e-3,
            "{share} {known}"
        );
    }
}
