//! [`Response`]: magnitude and phase over frequency as SVG: logarithmic axes for frequency and magnitude, the
//! phase below; of more than three curves each has a panel for its phase.

use nalgebra::Complex;

use super::axes::{svg_file, title};
use super::figure::{ABOVE, BELOW, PANEL, WIDTH, document, px};
use super::legend::Entry;
use super::log_panel::{Kind, Panel, Scale, decades};
use super::phases::{self, Phases};
use crate::report::error::DrawError;

/// Phases in one panel, at most; more have a panel each.
const TOGETHER_MAX: usize = 3;
/// Label of the horizontal axis.
const FREQUENCY: &str = "Frequency f (Hz)";
/// Height of the panel of the phase.
const PHASE: f64 = 150.0;
/// Above the panel of the phase.
const ABOVE_PHASE: f64 = 8.0;
/// Decades below the largest magnitude that are shown.
const DECADES_MAX: f64 = 9.0;

/// Complex curves over frequency.
#[derive(Clone, Debug)]
pub(crate) struct Response {
    /// What the picture shows, for readers who cannot see it.
    pub(crate) description: String,
    /// The text above it.
    pub(crate) title: String,
    /// What the magnitude is, with its unit.
    pub(crate) axis: String,
    /// Frequencies, Hz, rising, above zero.
    pub(crate) frequencies: Vec<f64>,
    /// Name of each curve, `_` before a subscript, and its values.
    pub(crate) curves: Vec<(String, Vec<Complex<f64>>)>,
}

impl Response {
    /// The picture as an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| {
            let names = || self.curves.iter().map(|(name, _)| name.as_str());
            // Adding zero makes the phase of a negative number with -0 as imaginary part 180.
            let phase = |v: &Complex<f64>| (v.im + 0.0).atan2(v.re).to_degrees();
            let phases = self.curves.iter().map(|(_, values)| values.iter().map(phase).collect());
            let phases: Vec<(&str, Vec<f64>)> = names().zip(phases).collect();
            let apart = self.curves.len() > TOGETHER_MAX;
            let below = if apart { phases::height(self.curves.len()) } else { PHASE };
            let of_magnitude = if apart { PANEL + BELOW } else { PANEL };
            let entries = Entry::curves(names());
            let size = [WIDTH, of_magnitude + below];
            document(&self.description, style, &entries, size, |panel| {
                let (above, below) = panel.split_vertically(px(of_magnitude));
                title(&above, &self.title)?;
                let x_label = if apart { FREQUENCY } else { "" };
                let above = self.magnitudes(x_label).draw(&above, self.sizes())?;
                let below = if apart {
                    let x = self.magnitudes(x_label).x_axis();
                    let all = Phases { frequencies: &self.frequencies, x, curves: &phases };
                    all.draw(below.get_base_pixel().1)
                } else {
                    let panel = Panel {
                        above: ABOVE_PHASE,
                        frequencies: &self.frequencies,
                        y: Scale { range: -180.0..180.0, kind: Kind::Phase },
                        x_label: FREQUENCY,
                        y_label: "Phase (deg)",
                    };
                    panel.draw(&below, phases.into_iter())?
                };
                Ok(above + &below)
            })
        })
    }

    fn magnitudes<'a>(&'a self, x_label: &'a str) -> Panel<'a> {
        let sizes = self.curves.iter().flat_map(|(_, values)| values).map(|v| v.norm());
        Panel {
            above: ABOVE,
            frequencies: &self.frequencies,
            y: decades(sizes, DECADES_MAX),
            x_label,
            y_label: &self.axis,
        }
    }

    /// Name and magnitudes of each curve.
    fn sizes(&self) -> impl Iterator<Item = (&str, Vec<f64>)> {
        let curves = self.curves.iter();
        curves.map(|(name, values)| (name.as_str(), values.iter().map(|v| v.norm()).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_through_zero_and_an_empty_one_are_drawn() {
        let zero = Complex::new(0.0, 0.0);
        for (frequencies, values) in [(vec![1.0, 2.0], vec![zero, zero]), (vec![], vec![])] {
            let response = Response {
                description: String::new(),
                title: "a".into(),
                axis: "b".into(),
                frequencies,
                curves: vec![("c".into(), values)],
            };
            assert!(response.file().expect("it is drawn").contains("</svg>"));
        }
    }

    #[test]
    fn nine_phases_are_in_nine_panels() {
        let curve = |k: u32| {
            let at = |f: f64| Complex::from_polar(1.0, -f64::from(k) * f);
            (format!("x/{k}"), [0.1, 0.2, 0.4].map(at).to_vec())
        };
        let of = |count: u32| {
            let response = Response {
                description: String::new(),
                title: "a".into(),
                axis: "b".into(),
                frequencies: vec![0.1, 0.2, 0.4],
                curves: (1..=count).map(curve).collect(),
            };
            response.file().expect("it is drawn")
        };
        // A name in the legend and above its panel, or in the legend alone.
        assert_eq!(of(9).matches(">x/4</text>").count(), 2);
        assert_eq!(of(3).matches(">x/3</text>").count(), 1);
        assert_eq!(of(9).matches(">Phase (deg)</text>").count(), 1);
        assert!(of(9).matches(">\u{2212}180</text>").count() == 3);
    }
}
