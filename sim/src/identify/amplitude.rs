//! Length and angle of two numbers with normal errors, the components of an imbalance, with intervals that also hold where noise
//! hides the length.
//!
//! In units of its standard deviation a length `A` is found as `R` with Rice's distribution
//!
//! ```text
//! F(r; A) = P(R < r) = sum over k of P(N = k) P(M > k)      N, M Poisson's, of mean A²/2 and r²/2
//! ```
//!
//! and the interval is Neyman's: all lengths of which `R` is between the quantiles `t` and `t + 0.95`, where `t` is zero up to [`FREE`],
//! and rises to 0.025 at twice that. It covers in 95 % at any length where the errors of the two are alike, as those of a
//! wheel that turns are, never reaches below zero, and is `R ± 1.96` far from it. Where zero belongs to it, noise
//! hides the length, and its upper end is a bound. The error across is normal, so the sine of the angle's is `1.96 / R` at most.

use std::f64::consts::PI;

use crate::fit::Estimate;

/// The quantile 0.975 of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;
/// Within the interval.
const LEVEL: f64 = 0.95;
/// Below the interval, of lengths far from zero.
const TAIL: f64 = 0.025;
/// Lengths up to this are within any interval that reaches to zero.
const FREE: f64 = 1.5;
/// From this on the distribution is normal about `A + 1 / 2A`, with the variance `1 - 1 / 2A²`: to 1e-3 of a standard deviation.
const NORMAL_FROM: f64 = 12.0;
/// Halvings of a bracket of at most twenty: to 1e-12.
const HALVINGS: usize = 44;
/// Terms of the sum: of means up to 170 the rest is below 1e-20.
const TERMS: u32 = 400;
/// A term below this, beyond the largest, is the last.
const SMALL: f64 = 1e-18;

/// An estimate with a normal error.
pub(super) fn normal(value: f64, deviation: f64) -> Estimate {
    let half = NORMAL * deviation;
    Estimate { value, deviation, interval: [value - half, value + half] }
}

/// A length and an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polar {
    pub(super) length: Estimate,
    pub(super) angle: Estimate,
    /// Whether noise hides the length, and the angle with it.
    pub(super) hidden: bool,
}

/// Of a length and an angle, rad, with their standard deviations to first order.
pub(super) fn polar([length, angle]: [f64; 2], [deviation, across]: [f64; 2]) -> Polar {
    let ratio = length / deviation;
    let [low, high] = if deviation <= 0.0 {
        [length; 2]
    } else if ratio.is_nan() || deviation.is_infinite() {
        [0.0, f64::INFINITY]
    } else {
        of_ratio(ratio).map(|end| end * deviation)
    };
    let length = Estimate { value: length, deviation, interval: [low, high] };
    let hidden = low <= 0.0 && high > 0.0;
    Polar { length, angle: about(angle, across, hidden), hidden }
}

/// An angle with a standard deviation, rad, to first order; of what is hidden anything within half a turn.
pub(super) fn about(angle: f64, across: f64, hidden: bool) -> Estimate {
    let sine = NORMAL * across;
    if hidden || sine.is_nan() || sine >= 1.0 {
        // That of what is anything within half a turn.
        let deviation = PI / 3_f64.sqrt();
        return Estimate { value: angle, deviation, interval: [angle - PI, angle + PI] };
    }
    let half = sine.asin();
    Estimate { interval: [angle - half, angle + half], ..normal(angle, across) }
}

/// The interval of a length that is found as this, both in standard deviations.
fn of_ratio(found: f64) -> [f64; 2] {
    if found >= NORMAL_FROM {
        return [-NORMAL, NORMAL].map(|away| {
            let middle = found + away;
            let length = 0.5 * (middle + (middle * middle - 2.0).sqrt());
            length - away / (4.0 * length * length)
        });
    }
    // Both fall with the length.
    let above = |length: f64| below(found, length) - tail(length) - LEVEL;
    let under = |length: f64| below(found, length) - tail(length);
    [root(above, found + 4.0), root(under, found + 6.0).max(FREE)]
}

/// The share below the interval.
fn tail(length: f64) -> f64 {
    TAIL * ((length - FREE) / FREE).clamp(0.0, 1.0)
}

/// `F(r; A)`.
fn below(found: f64, length: f64) -> f64 {
    let [mean, of_found] = [0.5 * length * length, 0.5 * found * found];
    let (mut weight, mut term) = ((-mean).exp(), (-of_found).exp());
    // Of M above k: without those up to k.
    let mut more = 1.0 - term;
    let mut sum = weight * more;
    for k in 1..TERMS {
        let k = f64::from(k);
        (weight, term) = (weight * mean / k, term * of_found / k);
        more = (more - term).max(0.0);
        sum += weight * more;
        if k > mean && weight < SMALL {
            break;
        }
    }
    sum
}

/// Where what falls is zero, from zero to an end; zero where it is nowhere positive.
fn root(of: impl Fn(f64) -> f64, end: f64) -> f64 {
    let [mut low, mut high] = [0.0, end];
    if of(low) <= 0.0 {
        return 0.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if of(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of a normal error, each of the same probability.
    fn errors() -> Vec<f64> {
        let count = 200;
        let share = |k: i32| (f64::from(k) + 0.5) / f64::from(count);
        // By halving of the normal distribution, whose density is summed.
        let cumulative = |x: f64| {
            let steps = 400;
            let step = x / f64::from(steps);
            let density = |at: f64| (-0.5 * at * at).exp() / (2.0 * PI).sqrt();
            0.5 + (0..steps).map(|k| step * density((f64::from(k) + 0.5) * step)).sum::<f64>()
        };
        let quantile = |share: f64| {
            let [mut low, mut high] = [-6.0, 6.0];
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if cumulative(middle) < share { low = middle } else { high = middle }
            }
            low
        };
        (0..count).map(|k| quantile(share(k))).collect()
    }

    /// Of any length, those that noise hides among them, in 95 % within what a grid of 40,000 errors counts, a percent.
    #[test]
    fn an_amplitude_is_within_its_interval_in_95_percent_at_any_size() {
        // Intervals of lengths that are found, every 0.01.
        let table: Vec<[f64; 2]> = (0..2_000).map(|k| of_ratio(0.01 * f64::from(k))).collect();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 2,000")]
        let interval = |found: f64| table[(100.0 * found).round() as usize];
        let errors = errors();
        let all: f64 = errors.iter().map(|_| 1.0).sum::<f64>().powi(2);
        for length in [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 9.0, 11.9, 14.0] {
            let (mut inside, mut angles) = (0.0, 0.0);
            for along in &errors {
                for across in &errors {
                    let [x, y] = [length + along, *across];
                    let found: f64 = x.hypot(y);
                    let [low, high] = interval(found);
                    inside += f64::from(u8::from(low <= length && length <= high));
                    let [low, high] = about(y.atan2(x), found.recip(), low <= 0.0).interval;
                    angles += f64::from(u8::from(low <= 0.0 && 0.0 <= high));
                }
            }
            assert!((inside / all - 0.95).abs() < 0.01, "length {length}: {}", inside / all);
            // Of hidden ones any angle, so more than 95 %.
            assert!(angles / all > 0.94, "length {length}: angles {}", angles / all);
            assert!(
                length < 6.0 || angles / all < 0.96,
                "length {length}: angles {}",
                angles / all
            );
        }
    }

    #[test]
    fn the_interval_of_an_amplitude_is_that_of_rice_below_and_the_normal_one_above() {
        // F(r; 0) = 1 - exp(-r²/2).
        assert!((below(2.0, 0.0) - (1.0 - (-2.0_f64).exp())).abs() < 1e-14);
        let [low, high] = of_ratio(NORMAL_FROM - 1e-9);
        let [low_normal, high_normal] = of_ratio(NORMAL_FROM);
        assert!((low - low_normal).abs() < 1e-3 && (high - high_normal).abs() < 1e-3);
        // Hidden up to the quantile 0.95 of noise alone.
        let most = (-2.0 * 0.05_f64.ln()).sqrt();
        assert!(of_ratio(most - 1e-6)[0] == 0.0 && of_ratio(most + 1e-6)[0] > 0.0);
        assert!(of_ratio(0.0)[1] >= FREE - 1e-9);
    }

    #[test]
    fn what_nothing_tells_has_no_bound_and_no_angle() {
        let of = polar([0.0, 0.0], [f64::INFINITY, f64::NAN]);
        assert!(of.hidden && of.length.interval == [0.0, f64::INFINITY]);
        assert!((of.angle.interval[1] - of.angle.interval[0] - 2.0 * PI).abs() < 1e-12);
    }
}
