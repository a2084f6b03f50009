//! [`keep_out`]: intervals of a key in which a requirement is violated, or of which nothing is known.

use crate::jitter::keep_out as above;

/// Intervals of the values of a key in which a statistic exceeds its limit; ends are where the straight lines between
/// neighbours cross it. A sample without a statistic counts as violated up to its neighbours. Values may be in any order.
#[must_use]
pub fn keep_out(values: &[f64], statistic: &[Option<f64>], limit: f64) -> Vec<[f64; 2]> {
    let mut points: Vec<(f64, Option<f64>)> =
        values.iter().copied().zip(statistic.iter().copied()).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut add = |bands: Vec<[f64; 2]>| {
        for [from, to] in bands {
            match found.last_mut() {
                Some(last) if from <= last[1] => last[1] = to.max(last[1]),
                _ => found.push([from, to]),
            }
        }
    };
    if let [(value, statistic)] = points[..] {
        let violated = statistic.is_none_or(|statistic| statistic > limit);
        return if violated { vec![[value, value]] } else { Vec::new() };
    }
    for pair in points.windows(2) {
        if let [(from, a), (to, b)] = pair {
            match (a, b) {
                (Some(a), Some(b)) => add(above::keep_out(&[*from, *to], &[*a, *b], limit, 0.0)),
                _ => add(vec![[*from, *to]]),
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::keep_out;

    #[test]
    fn a_sample_that_failed_is_kept_out_of_up_to_its_neighbours() {
        let values = [0.0, 1.0, 2.0, 3.0, 4.0];
        let known = [0.0, 2.0, 0.0, 0.0, 0.0].map(Some);
        assert_eq!(keep_out(&values, &known, 1.0), [[0.5, 1.5]]);
        let failed = [Some(0.0), Some(2.0), Some(0.0), None, Some(0.0)];
        assert_eq!(keep_out(&values, &failed, 1.0), [[0.5, 1.5], [2.0, 4.0]]);
        assert_eq!(keep_out(&[1.0, 0.0], &[Some(2.0), Some(0.0)], 1.0), [[0.5, 1.0]]);
        assert_eq!(keep_out(&[1.0], &[None], 1.0), [[1.0, 1.0]]);
    }
}
