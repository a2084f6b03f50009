//! [`rate_curves`]: shares of faults that methods find over their false alarms.

use super::draw::plane::Plane;
use super::error::DrawError;

/// Curves of methods as an SVG file: the decimal logarithm of the false alarms an hour, and the share that is found.
pub(crate) fn rate_curves(methods: Vec<(String, Vec<[f64; 2]>)>) -> Result<String, DrawError> {
    // Without a false alarm there is no logarithm: such a point is where the next one would be.
    let placed = |points: Vec<[f64; 2]>| {
        let rates = points.iter().map(|[rate, _]| *rate).filter(|rate| *rate > 0.0);
        let least = 0.5 * rates.fold(f64::INFINITY, f64::min);
        let least = if least.is_finite() { least } else { 0.01 };
        points.into_iter().map(|[rate, share]| [rate.max(least).log10(), share]).collect()
    };
    Plane {
        description: "Share of faults found within 30 s over false alarms an hour, by method."
            .to_owned(),
        title: "Faults found over false alarms".to_owned(),
        axes: [
            "Decimal logarithm of false alarms an hour".to_owned(),
            "Share found within 30 s".to_owned(),
        ],
        curves: methods.into_iter().map(|(name, points)| (name, placed(points))).collect(),
        lines: Vec::new(),
        dots: Vec::new(),
        marks: Vec::new(),
        large: false,
        logarithmic: false,
        ranges: [None, Some([0.0, 1.0])],
    }
    .file()
}
