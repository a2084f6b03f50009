//! [`Bode`]: magnitudes in decibels over a logarithmic frequency, and below them phases, as SVG.

use nalgebra::Complex;

use super::axes::{svg_file, title};
use super::curves::{ChartCurve, CurveAxis, CurveChart};
use super::figure::{ABOVE, PANEL, WIDTH, document, px};
use super::legend::Entry;
use super::log_panel::{Kind, Panel, Scale, decibels};
use crate::report::error::DrawError;

/// Label of the horizontal axis.
const FREQUENCY: &str = "Frequency f (Hz)";
/// Height of the panel of the phase, and above it.
const PHASE: [f64; 2] = [150.0, 8.0];
/// Decibels below the largest magnitude that are shown.
const DECIBELS_MAX: f64 = 120.0;

/// Complex curves over frequency.
#[derive(Clone, Debug)]
pub(in crate::report) struct Bode {
    /// What the picture shows, for readers who cannot see it.
    pub(in crate::report) description: String,
    /// The text above it.
    pub(in crate::report) title: String,
    /// Frequencies, Hz, rising, above zero.
    pub(in crate::report) frequencies: Vec<f64>,
    /// Name of each curve, `_` before a subscript, and its values.
    pub(in crate::report) curves: Vec<(String, Vec<Complex<f64>>)>,
    /// Whether there is a panel of the phases.
    pub(in crate::report) has_phases: bool,
}

/// A magnitude in decibels.
pub(in crate::report) fn level(value: f64) -> f64 {
    20.0 * value.log10()
}

impl Bode {
    /// The picture as an SVG file of its own.
    pub(in crate::report) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The picture as part of a page that turns its colours.
    pub(in crate::report) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn levels(&self) -> Vec<(&str, Vec<f64>)> {
        let of = |values: &Vec<Complex<f64>>| values.iter().map(|v| level(v.norm())).collect();
        self.curves.iter().map(|(name, values)| (name.as_str(), of(values))).collect()
    }

    fn phases(&self) -> Vec<(&str, Vec<f64>)> {
        // Adding zero makes the phase of a negative number with -0 as imaginary part 180.
        let phase = |v: &Complex<f64>| (v.im + 0.0).atan2(v.re).to_degrees();
        let of = |values: &Vec<Complex<f64>>| values.iter().map(phase).collect();
        self.curves.iter().map(|(name, values)| (name.as_str(), of(values))).collect()
    }

    fn scale(&self) -> Scale {
        let levels = self.levels();
        decibels(levels.iter().flat_map(|(_, levels)| levels).copied(), DECIBELS_MAX)
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let entries = Entry::curves(self.curves.iter().map(|(name, _)| name.as_str()));
        let below = if self.has_phases { PHASE[0] } else { 0.0 };
        document(&self.description, style, &entries, [WIDTH, PANEL + below], |panel| {
            let magnitudes = Panel {
                above: ABOVE,
                frequencies: &self.frequencies,
                y: self.scale(),
                x_label: if self.has_phases { "" } else { FREQUENCY },
                y_label: "Magnitude (dB)",
            };
            if !self.has_phases {
                title(panel, &self.title)?;
                return magnitudes.draw(panel, self.levels().into_iter());
            }
            let (above, below) = panel.split_vertically(px(PANEL));
            title(&above, &self.title)?;
            let above = magnitudes.draw(&above, self.levels().into_iter())?;
            let phases = Panel {
                above: PHASE[1],
                frequencies: &self.frequencies,
                y: Scale { range: -180.0..180.0, kind: Kind::Phase },
                x_label: FREQUENCY,
                y_label: "Phase (deg)",
            };
            Ok(above + &phases.draw(&below, self.phases().into_iter())?)
        })
    }

    /// The same for the script of a page.
    pub(in crate::report) fn charts(&self) -> Vec<CurveChart> {
        let chart = |label: &str, curves: Vec<(&str, Vec<f64>)>, range: [f64; 2]| {
            let points = |values: Vec<f64>| {
                let all = self.frequencies.iter().zip(values).map(|(f, value)| [*f, value]);
                all.collect::<Vec<_>>()
            };
            CurveChart {
                title: self.title.clone(),
                axes: [
                    CurveAxis::labelled(FREQUENCY, true, None),
                    CurveAxis::labelled(label, false, Some(range)),
                ],
                curves: curves
                    .into_iter()
                    .map(|(name, values)| ChartCurve::line(name, points(values)))
                    .collect(),
            }
        };
        let range = self.scale().range;
        let mut charts = vec![chart("Magnitude (dB)", self.levels(), [range.start, range.end])];
        if self.has_phases {
            charts.push(chart("Phase (deg)", broken(self.phases()), [-180.0, 180.0]));
        }
        charts
    }
}

/// Phases that are interrupted where they go on at the other end of their range.
fn broken(mut curves: Vec<(&str, Vec<f64>)>) -> Vec<(&str, Vec<f64>)> {
    for (_, values) in &mut curves {
        let jumps: Vec<usize> = values
            .windows(2)
            .enumerate()
            .filter(|(_, pair)| matches!(pair, [a, b] if (a - b).abs() > 180.0))
            .map(|(at, _)| at + 1)
            .collect();
        for at in jumps {
            if let Some(value) = values.get_mut(at) {
                *value = f64::NAN;
            }
        }
    }
    curves
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnitude_and_phase_are_drawn_and_an_empty_figure_too() {
        let values = [0.1, 1.0, 10.0].map(|f| Complex::new(0.0, -1.0 / f)).to_vec();
        for (frequencies, values) in [(vec![0.1, 1.0, 10.0], values), (vec![], vec![])] {
            let bode = Bode {
                description: String::new(),
                title: "a".into(),
                frequencies,
                curves: vec![("L_x".into(), values)],
                has_phases: true,
            };
            let file = bode.file().expect("it is drawn");
            assert!(file.contains("</svg>") && file.contains("Phase (deg)"));
            assert_eq!(bode.charts().len(), 2);
        }
    }

    #[test]
    fn ticks_are_whole_steps_of_twenty() {
        use plotters::coord::ranged1d::{BoldPoints, Ranged as _};
        let scale = decibels([-37.0, 12.0].into_iter(), 120.0);
        assert_eq!(scale.key_points(BoldPoints(9)), [-40.0, -20.0, 0.0, 20.0]);
    }
}
