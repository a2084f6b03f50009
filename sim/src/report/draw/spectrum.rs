//! [`SpectrumFigure`]: power spectral densities over frequency as SVG, on logarithmic axes, and below them the RMS of
//! all lower frequencies.
//!
//! A picture has fewer points than a spectrum has bins: neighbours at nearly one ratio are one point, the greatest of
//! them, so no line is lost.

use super::axes::{svg_file, title};
use super::figure::{ABOVE, PANEL, WIDTH, document, px};
use super::log_panel::{Panel, decades};
use crate::report::error::DrawError;

/// Height of the panel of the RMS.
const RMS: f64 = 190.0;
/// Above the panel of the RMS.
const ABOVE_RMS: f64 = 8.0;
/// Decades below the largest density that are shown, and below the largest RMS.
const DECADES_MAX: [f64; 2] = [12.0, 6.0];
/// Points of a curve, at most.
const POINTS_MAX: f64 = 600.0;

/// Densities with one unit.
#[derive(Clone, Debug)]
pub(crate) struct SpectrumFigure {
    /// What the picture shows, for readers who cannot see it.
    pub(crate) description: String,
    /// The text above it.
    pub(crate) title: String,
    /// The unit of the signals; empty of a pure number.
    pub(crate) unit: String,
    /// Frequencies, Hz, rising; those that are not above zero are not drawn.
    pub(crate) frequencies: Vec<f64>,
    /// Name of each curve, `_` before a subscript, its density and the RMS of all lower frequencies.
    pub(crate) curves: Vec<SpectrumCurve>,
}

/// The densities of one signal.
#[derive(Clone, Debug)]
pub(crate) struct SpectrumCurve {
    pub(crate) name: String,
    pub(crate) density: Vec<f64>,
    pub(crate) rms: Vec<f64>,
}

impl SpectrumFigure {
    /// The picture as an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The picture as part of a page that turns its colours.
    pub(crate) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let names: Vec<_> = self.curves.iter().map(|curve| curve.name.as_str()).collect();
        let points = self.points();
        let at = |values: &[f64]| greatest(&points, values);
        let frequencies = points.iter().filter_map(|point| self.frequencies.get(point.start));
        let frequencies: Vec<f64> = frequencies.copied().collect();
        let densities: Vec<_> = self.curves.iter().map(|curve| at(&curve.density)).collect();
        let sums: Vec<_> = self.curves.iter().map(|curve| at(&curve.rms)).collect();
        let [of_density, of_rms] = DECADES_MAX;
        let [density_label, rms_label] = match self.unit.as_str() {
            "" => ["Density (1/Hz)".to_owned(), "Cumulative RMS".to_owned()],
            unit => {
                let square = if unit.contains([' ', '/']) {
                    format!("({unit})²")
                } else {
                    format!("{unit}²")
                };
                [format!("Density ({square}/Hz)"), format!("Cumulative RMS ({unit})")]
            }
        };
        document(&self.description, style, &names, [WIDTH, PANEL + RMS], |panel| {
            let (above, below) = panel.split_vertically(px(PANEL));
            title(&above, &self.title)?;
            let density = Panel {
                above: ABOVE,
                frequencies: &frequencies,
                y: decades(densities.iter().flatten().copied(), of_density),
                x_label: "",
                y_label: &density_label,
            };
            let rms = Panel {
                above: ABOVE_RMS,
                frequencies: &frequencies,
                y: decades(sums.iter().flatten().copied(), of_rms),
                x_label: "Frequency f (Hz)",
                y_label: &rms_label,
            };
            let above = density.draw(&above, densities.iter().map(|c| c.iter().copied()))?;
            Ok(above + &rms.draw(&below, sums.iter().map(|c| c.iter().copied()))?)
        })
    }

    /// The bins of each point of the picture.
    fn points(&self) -> Vec<std::ops::Range<usize>> {
        let positive = self.frequencies.iter().position(|frequency| *frequency > 0.0);
        let Some((first, from, to)) = positive.and_then(|first| {
            Some((first, self.frequencies.get(first)?, self.frequencies.last()?))
        }) else {
            return Vec::new();
        };
        let ratio = (to / from).powf(1.0 / POINTS_MAX);
        let mut points = Vec::new();
        let mut start = first;
        let mut end = from * ratio;
        for (bin, frequency) in self.frequencies.iter().enumerate().skip(first + 1) {
            if *frequency >= end {
                points.push(start..bin);
                (start, end) = (bin, frequency * ratio);
            }
        }
        points.push(start..self.frequencies.len());
        points
    }
}

/// The greatest value of the bins of each point.
fn greatest(points: &[std::ops::Range<usize>], values: &[f64]) -> Vec<f64> {
    let of = |point: &std::ops::Range<usize>| {
        let values = values.get(point.clone()).unwrap_or_default();
        values.iter().copied().fold(f64::NAN, f64::max)
    };
    points.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(count: u32, density: impl Fn(u32) -> f64) -> SpectrumFigure {
        let values: Vec<f64> = (0..count).map(density).collect();
        SpectrumFigure {
            description: String::new(),
            title: "a".into(),
            unit: "rad/s".into(),
            frequencies: (0..count).map(|k| 0.1 * f64::from(k)).collect(),
            curves: vec![SpectrumCurve { name: "x".into(), rms: values.clone(), density: values }],
        }
    }

    #[test]
    fn a_line_among_a_hundred_thousand_bins_is_drawn() {
        let found = figure(100_000, |k| if k == 77_777 { 5.0 } else { 1e-6 });
        let points = found.points();
        assert!(points.len() <= 601, "{}", points.len());
        let drawn = greatest(&points, &found.curves[0].density);
        assert_eq!(drawn.iter().filter(|value| **value == 5.0).count(), 1);
        assert!(found.file().expect("it is drawn").len() < 40_000);
    }

    #[test]
    fn empty_spectra_and_zeros_are_drawn() {
        for count in [0, 1, 2, 5] {
            let file = figure(count, |_| 0.0).file().expect("it is drawn");
            assert!(file.contains("</svg>") && !file.contains("NaN"), "{count}");
        }
    }
}
