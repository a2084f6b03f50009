//! [`Response`]: magnitude and phase over frequency as SVG: logarithmic axes for frequency and magnitude, the
//! phase below.

use nalgebra::Complex;

use super::axes::{svg_file, title};
use super::figure::{ABOVE, PANEL, WIDTH, document, px};
use super::log_panel::{Kind, Panel, Scale, decades};
use crate::report::error::DrawError;

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
        let names: Vec<_> = self.curves.iter().map(|(name, _)| name.as_str()).collect();
        svg_file(|style| {
            document(&self.description, style, &names, [WIDTH, PANEL + PHASE], |panel| {
                let (above, below) = panel.split_vertically(px(PANEL));
                title(&above, &self.title)?;
                let sizes = self.curves.iter().flat_map(|(_, values)| values).map(|v| v.norm());
                let magnitudes = Panel {
                    above: ABOVE,
                    frequencies: &self.frequencies,
                    y: decades(sizes, DECADES_MAX),
                    x_label: "",
                    y_label: &self.axis,
                };
                let phases = Panel {
                    above: ABOVE_PHASE,
                    frequencies: &self.frequencies,
                    y: Scale { range: -180.0..180.0, kind: Kind::Phase },
                    x_label: "Frequency f (Hz)",
                    y_label: "Phase (deg)",
                };
                // Adding zero makes the phase of a negative number with -0 as imaginary part 180.
                let phase = |v: &Complex<f64>| (v.im + 0.0).atan2(v.re).to_degrees();
                let curves = || self.curves.iter().map(|(_, values)| values);
                let above =
                    magnitudes.draw(&above, curves().map(|c| c.iter().map(|v| v.norm())))?;
                Ok(above + &phases.draw(&below, curves().map(|c| c.iter().map(phase)))?)
            })
        })
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
}
