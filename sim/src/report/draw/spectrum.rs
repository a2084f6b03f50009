//! [`SpectrumFigure`]: power spectral densities over frequency as SVG, on logarithmic axes, and below them the RMS of
//! all lower frequencies.
//!
//! A picture has fewer points than a spectrum has bins: neighbours at nearly one ratio are one point. Of noise it is their mean,
//! which is its density; where one of them stands out it is that, so no line is lost.

use std::f64::consts::LN_2;

use super::axes::{svg_file, title};
use super::curves::{ChartCurve, CurveAxis, CurveChart};
use super::figure::{ABOVE, PANEL, WIDTH, document, px};
use super::legend::Entry;
use super::log_panel::{Panel, Scale, decades};
use crate::report::error::DrawError;

/// Label of the horizontal axis.
const FREQUENCY: &str = "Frequency f (Hz)";
/// Height of the panel of the RMS.
const RMS: f64 = 190.0;
/// Above the panel of the RMS.
const ABOVE_RMS: f64 = 8.0;
/// Decades below the largest density that are shown, and below the largest RMS.
const DECADES_MAX: [f64; 2] = [12.0, 6.0];
/// Bins of noise that is not averaged are distributed exponentially: the greatest of n is above `ln n + 7` means once in a
/// thousand points, and the mean is the median by `ln 2`.
const BEYOND_NOISE: f64 = 7.0;
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

    /// The same for the script of a page: densities, and RMS.
    pub(in crate::report) fn charts(&self) -> Vec<CurveChart> {
        let Thinned { frequencies, densities, sums } = self.thinned();
        let scales = scales(&densities, &sums);
        let ends = frequencies.first().zip(frequencies.last()).map(|(from, to)| [*from, *to]);
        let all = [(densities, "density"), (sums, "cumulative RMS")];
        let charts = all.into_iter().zip(scales).zip(self.labels()).map(
            |(((values, what), scale), label)| CurveChart {
                title: format!("{}: {what}", self.title),
                axes: [
                    CurveAxis::labelled(FREQUENCY, true, ends),
                    CurveAxis::labelled(&label, true, Some([scale.range.start, scale.range.end])),
                ],
                curves: self
                    .curves
                    .iter()
                    .zip(values)
                    .map(|(curve, values)| {
                        let points = frequencies.iter().zip(values).map(|(f, value)| [*f, value]);
                        ChartCurve::line(&curve.name, points.collect())
                    })
                    .filter(|curve| curve.points.iter().any(|point| point[1] > 0.0))
                    .collect(),
            },
        );
        charts.collect()
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let names: Vec<_> = self.curves.iter().map(|curve| curve.name.as_str()).collect();
        let Thinned { frequencies, densities, sums } = self.thinned();
        let [density_label, rms_label] = self.labels();
        let [of_density, of_rms] = scales(&densities, &sums);
        document(
            &self.description,
            style,
            &Entry::curves(names.iter().copied()),
            [WIDTH, PANEL + RMS],
            |panel| {
                let (above, below) = panel.split_vertically(px(PANEL));
                title(&above, &self.title)?;
                let density = Panel {
                    above: ABOVE,
                    frequencies: &frequencies,
                    y: of_density,
                    x_label: "",
                    y_label: &density_label,
                };
                let rms = Panel {
                    above: ABOVE_RMS,
                    frequencies: &frequencies,
                    y: of_rms,
                    x_label: FREQUENCY,
                    y_label: &rms_label,
                };
                let named = |values: &[Vec<f64>]| {
                    let each = names.iter().copied().zip(values.to_vec());
                    each.collect::<Vec<_>>().into_iter()
                };
                let above = density.draw(&above, named(&densities))?;
                Ok(above + &rms.draw(&below, named(&sums))?)
            },
        )
    }

    /// Labels of the vertical axes: of densities, and of the RMS.
    fn labels(&self) -> [String; 2] {
        match self.unit.as_str() {
            "" => ["Density (1/Hz)".to_owned(), "Cumulative RMS".to_owned()],
            unit => {
                let square = if unit.contains([' ', '/']) {
                    format!("({unit})²")
                } else {
                    format!("{unit}²")
                };
                [format!("Density ({square}/Hz)"), format!("Cumulative RMS ({unit})")]
            }
        }
    }

    /// The points that are drawn.
    fn thinned(&self) -> Thinned {
        let points = self.points();
        let frequencies = points.iter().filter_map(|point| self.frequencies.get(point.start));
        Thinned {
            frequencies: frequencies.copied().collect(),
            densities: self.curves.iter().map(|curve| levels(&points, &curve.density)).collect(),
            sums: self.curves.iter().map(|curve| greatest(&points, &curve.rms)).collect(),
        }
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

/// The points of a picture: of each curve a density and an RMS at each frequency.
struct Thinned {
    frequencies: Vec<f64>,
    densities: Vec<Vec<f64>>,
    sums: Vec<Vec<f64>>,
}

/// The vertical axes: of densities, and of the RMS.
fn scales(densities: &[Vec<f64>], sums: &[Vec<f64>]) -> [Scale; 2] {
    let [of_density, of_rms] = DECADES_MAX;
    [
        decades(densities.iter().flatten().copied(), of_density),
        decades(sums.iter().flatten().copied(), of_rms),
    ]
}

/// The density of each point: the greatest bin where it is a line, else the mean.
fn levels(points: &[std::ops::Range<usize>], values: &[f64]) -> Vec<f64> {
    let of = |point: &std::ops::Range<usize>| {
        let bins = values.get(point.clone()).unwrap_or_default();
        let mut finite: Vec<f64> = bins.iter().copied().filter(|bin| bin.is_finite()).collect();
        finite.sort_by(f64::total_cmp);
        let greatest = finite.last().copied().unwrap_or(f64::NAN);
        let median = finite.get(finite.len() / 2).copied().unwrap_or(f64::NAN);
        let count = crate::spectra::float(finite.len());
        if greatest > (count.ln() + BEYOND_NOISE) / LN_2 * median {
            return greatest;
        }
        finite.iter().sum::<f64>() / count
    };
    points.iter().map(of).collect()
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
        let drawn = levels(&points, &found.curves[0].density);
        assert_eq!(drawn.iter().filter(|value| **value == 5.0).count(), 1);
        assert!(found.file().expect("it is drawn").len() < 40_000);
    }

    /// A periodogram of white noise of density one: bins are distributed exponentially.
    #[test]
    fn noise_is_drawn_at_its_density() {
        let mut state = 1_u64;
        let mut bin = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let share = f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2_f64.powi(32);
            -(1.0 - share).ln()
        };
        let values: Vec<f64> = (0..100_000).map(|_| bin()).collect();
        let points = figure(100_000, |_| 1.0).points();
        let last = points.len() - 100..points.len() - 1;
        let drawn = levels(&points, &values);
        let mean = drawn[last.clone()].iter().sum::<f64>() / 99.0;
        assert!((mean - 1.0).abs() < 0.02, "{mean}");
        // The greatest bins are some ten times the density.
        let held = greatest(&points, &values);
        assert!(held[last].iter().sum::<f64>() / 99.0 > 6.0);
    }

    #[test]
    fn empty_spectra_and_zeros_are_drawn() {
        for count in [0, 1, 2, 5] {
            let file = figure(count, |_| 0.0).file().expect("it is drawn");
            assert!(file.contains("</svg>") && !file.contains("NaN"), "{count}");
        }
    }
}
