//! Speeds to keep out of: where a quantity is above its limit.

/// Columns of a table of bands: lower and upper end of each, rad/s.
pub const KEEP_OUT_COLUMNS: [&str; 2] = ["lower_rad_per_s", "upper_rad_per_s"];

/// Intervals of speed in which values exceed a limit; ends are where the straight lines between neighbouring values
/// cross it. Intervals nearer than `gap` are one.
#[must_use]
pub fn keep_out(speeds: &[f64], values: &[f64], limit: f64, gap: f64) -> Vec<[f64; 2]> {
    let points: Vec<[f64; 2]> =
        speeds.iter().zip(values).map(|(speed, value)| [*speed, *value]).collect();
    let mut bands: Vec<[f64; 2]> = Vec::new();
    let mut add = |from: f64, to: f64| match bands.last_mut() {
        Some(last) if from - last[1] <= gap => last[1] = to,
        _ => bands.push([from, to]),
    };
    for pair in points.windows(2) {
        let [[s0, v0], [s1, v1]] = [pair[0], pair[1]];
        let crossing = || s0 + (s1 - s0) * (limit - v0) / (v1 - v0);
        match (v0 > limit, v1 > limit) {
            (true, true) => add(s0, s1),
            (true, false) => add(s0, crossing()),
            (false, true) => add(crossing(), s1),
            (false, false) => {}
        }
    }
    if let ([only], true) = (points.as_slice(), values.first().is_some_and(|v| *v > limit)) {
        add(only[0], only[0]);
    }
    bands
}

/// The union of bands, rising: those that meet are one. A band without a width is left out.
#[must_use]
pub fn union(bands: impl IntoIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = bands.into_iter().filter(|[from, to]| to > from).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut union: Vec<[f64; 2]> = Vec::with_capacity(all.len());
    for [from, to] in all {
        match union.last_mut() {
            Some(last) if from <= last[1] => last[1] = to.max(last[1]),
            _ => union.push([from, to]),
        }
    }
    union
}

#[cfg(test)]
mod tests {
    use super::{keep_out, union};

    #[test]
    fn bands_that_meet_are_one() {
        let bands = [[7.0, 9.0], [1.0, 3.0], [8.0, 8.5], [3.0, 4.0], [6.0, 6.0]];
        assert_eq!(union(bands), [[1.0, 4.0], [7.0, 9.0]]);
        assert_eq!(union([]), Vec::<[f64; 2]>::new());
    }

    #[test]
    fn ends_are_where_the_line_crosses_the_limit() {
        let speeds = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let values = [0.0, 2.0, 2.0, 0.0, 0.0, 4.0];
        assert_eq!(keep_out(&speeds, &values, 1.0, 0.0), [[0.5, 2.5], [4.25, 5.0]]);
        assert_eq!(keep_out(&speeds, &values, 1.0, 2.0), [[0.5, 5.0]]);
        assert_eq!(keep_out(&speeds, &values, 9.0, 0.0), Vec::<[f64; 2]>::new());
        assert_eq!(keep_out(&[2.0], &[3.0], 1.0, 0.0), [[2.0, 2.0]]);
    }
}
