//! [`CurveChart`]: what the script of a page draws in the place of a figure: curves over a speed, a frequency, or another
//! quantity that is not the time.

use super::legend::LIMIT;

/// Curves over one axis.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct CurveChart {
    pub(in crate::report) title: String,
    /// To the right, and upwards.
    pub(in crate::report) axes: [CurveAxis; 2],
    pub(in crate::report) curves: Vec<ChartCurve>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct CurveAxis {
    /// What it shows, without symbol and unit.
    pub(in crate::report) name: String,
    /// May be empty.
    pub(in crate::report) unit: String,
    pub(in crate::report) logarithmic: bool,
    /// What is shown at first; of a horizontal axis without it, all points.
    pub(in crate::report) range: Option<[f64; 2]>,
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct ChartCurve {
    /// In the legend.
    pub(in crate::report) label: String,
    /// With abscissas that do not fall; an ordinate that is not finite interrupts the curve.
    pub(in crate::report) points: Vec<[f64; 2]>,
    /// The ends of the interval at each point; empty without one.
    pub(in crate::report) interval: Vec<[f64; 2]>,
    /// Points that were measured, drawn as crosses; their abscissas do not fall.
    pub(in crate::report) measured: Vec<[f64; 2]>,
    /// Whether it is a limit, or another line to compare with.
    pub(in crate::report) limit: bool,
}

impl CurveAxis {
    /// An axis by its label in a figure: `Frequency f (Hz)`.
    pub(in crate::report) fn labelled(
        label: &str,
        logarithmic: bool,
        range: Option<[f64; 2]>,
    ) -> Self {
        let parts = label.strip_suffix(')').and_then(|label| label.rsplit_once(" ("));
        let (name, unit) = parts.unwrap_or((label, ""));
        // What a user has named, such as `pointing x`, keeps its last letter.
        let name = if name == "Frequency f" { "Frequency" } else { name };
        let unit = if unit == "1" { "" } else { unit };
        Self { name: name.to_owned(), unit: unit.to_owned(), logarithmic, range }
    }
}

impl ChartCurve {
    /// A curve; one named as limits are is a limit.
    pub(in crate::report) fn line(label: &str, points: Vec<[f64; 2]>) -> Self {
        let limit = label == LIMIT;
        Self { label: label.to_owned(), points, interval: Vec::new(), measured: Vec::new(), limit }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_is_split_into_name_and_unit() {
        let of = |label: &str| {
            let CurveAxis { name, unit, .. } = CurveAxis::labelled(label, false, None);
            format!("{name}|{unit}")
        };
        assert_eq!(of("Frequency f (Hz)"), "Frequency|Hz");
        assert_eq!(of("Density ((m/s²)²/Hz)"), "Density|(m/s²)²/Hz");
        assert_eq!(of("Share of samples"), "Share of samples|");
        assert_eq!(of("Value (1)"), "Value|");
        assert_eq!(of("requirement pointing x (arcsec)"), "requirement pointing x|arcsec");
    }
}
