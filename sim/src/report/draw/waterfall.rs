//! [`Waterfall`]: spectra over speed as SVG: speed to the right, frequency upwards, darker where the density is
//! higher, with the lines of the harmonics and the whirls of the modes.

use std::fmt::Write as _;

use super::axes::{Space, axes, svg_file, title};
use super::figure::{ABOVE, Area, BELOW, PANEL, WIDTH, document, moves, px};
use super::legend::{Entry, stroke};
use super::scale_bar::{SCALE_WIDTH, ScaleBar};
use super::ticks::Axis;
use crate::report::error::DrawError;
use crate::report::number::power_of_ten;

/// Height of the panel by that of a figure of a run.
const HEIGHT: f64 = 1.8;
/// Rows of cells, and levels of grey.
const ROWS: usize = 140;
const LEVELS: usize = 8;
/// Decades of density between the lightest and the darkest level.
const DECADES: f64 = 5.0;

/// Spectra over speed.
#[derive(Clone, Debug)]
pub(crate) struct Waterfall {
    /// What the picture shows, for readers who cannot see it.
    pub(crate) description: String,
    /// The text above it.
    pub(crate) title: String,
    /// Speed, rpm, width of a bin, Hz, and density of each record.
    pub(crate) spectra: Vec<(f64, f64, Vec<f64>)>,
    /// Unit of the densities.
    pub(crate) unit: &'static str,
    /// The highest frequency, Hz.
    pub(crate) highest: f64,
    /// Name and points, rpm and Hz, of each curve.
    pub(crate) curves: Vec<(String, Vec<[f64; 2]>)>,
}

impl Waterfall {
    /// The picture as an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The picture as part of a page that turns its colours.
    pub(crate) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let entries = Entry::curves(self.curves.iter().map(|(name, _)| name.as_str()));
        document(&self.description, style, &entries, [WIDTH, HEIGHT * PANEL], |panel| {
            self.draw(panel)
        })
    }

    /// Greatest density of each row of cells.
    fn rows(&self, bin: f64, spectrum: &[f64]) -> Vec<f64> {
        let mut rows = vec![0.0_f64; ROWS];
        #[expect(clippy::cast_precision_loss, reason = "bins of a record")]
        for (index, value) in spectrum.iter().enumerate().skip(1) {
            let share = (index as f64 * bin / self.highest * ROWS as f64).floor();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "not below 0"
            )]
            if let Some(row) = rows.get_mut(share as usize) {
                *row = row.max(*value);
            }
        }
        rows
    }

    /// The ends of the cells over speed.
    fn edges(&self) -> Vec<f64> {
        let speeds: Vec<f64> = self.spectra.iter().map(|(speed, ..)| *speed).collect();
        let middles = speeds.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let (Some(first), Some(last)) = (speeds.first(), speeds.last()) else { return Vec::new() };
        let half = |pair: Option<&[f64]>| pair.map_or(1.0, |pair| 0.5 * (pair[1] - pair[0]).abs());
        let (low, high) = (half(speeds.windows(2).next()), half(speeds.windows(2).last()));
        std::iter::once(first - low).chain(middles).chain([last + high]).collect()
    }

    fn draw(&self, area: &Area<'_>) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let edges = self.edges();
        let x = match (edges.first(), edges.last()) {
            (Some(from), Some(to)) if from < to => *from..*to,
            _ => 0.0..1.0,
        };
        let y = 0.0..self.highest;
        let labels = ["Speed (rpm)", "Frequency f (Hz)"];
        let (plot, _) = area.split_horizontally(px(WIDTH - SCALE_WIDTH));
        let chart = axes(
            &plot,
            &Space { above: ABOVE, below: BELOW },
            Axis(x.clone()),
            Axis(y.clone()),
            labels,
        )?;
        let rows: Vec<Vec<f64>> =
            self.spectra.iter().map(|(_, bin, values)| self.rows(*bin, values)).collect();
        let most = rows.iter().flatten().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
        let mut cells = vec![String::new(); LEVELS];
        for (row, ends) in rows.iter().zip(edges.windows(2)) {
            for (index, value) in row.iter().enumerate() {
                let below = (most / value).log10() / DECADES;
                if !(0.0..1.0).contains(&below) {
                    continue;
                }
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    clippy::cast_precision_loss,
                    reason = "a share of the levels and rows"
                )]
                let (level, low, high) = (
                    ((1.0 - below) * LEVELS as f64) as usize,
                    index as f64 / ROWS as f64 * self.highest,
                    (index + 1) as f64 / ROWS as f64 * self.highest,
                );
                let (x1, y1) = chart.backend_coord(&(ends[0], high));
                let (x2, y2) = chart.backend_coord(&(ends[1], low));
                if let Some(cell) = cells.get_mut(level.min(LEVELS - 1)) {
                    let _ = write!(cell, "M{x1} {y1}H{x2}V{y2}H{x1}z");
                }
            }
        }
        let mut out = String::new();
        #[expect(clippy::cast_precision_loss, reason = "eight levels")]
        let greys: Vec<String> = (0..LEVELS)
            .map(|level| {
                let opacity = (level + 1) as f64 / LEVELS as f64 * 0.8;
                format!("fill=\"#1C1C1E\" fill-opacity=\"{opacity:.2}\"")
            })
            .collect();
        for (cell, grey) in cells.iter().zip(&greys).filter(|(cell, _)| !cell.is_empty()) {
            let _ = writeln!(out, "<path d=\"{cell}\" {grey} stroke=\"none\"/>");
        }
        if most > 0.0 {
            let framed = |grey: &String| format!("{grey} stroke=\"#1C1C1E\" stroke-width=\"4\"");
            let steps = greys.iter().map(framed).collect();
            let bar = ScaleBar { steps, marks: marks(most), label: self.unit };
            let ((right, top), (_, bottom)) =
                (chart.backend_coord(&(x.end, y.end)), chart.backend_coord(&(x.end, y.start)));
            bar.draw(&mut out, right, [top, bottom]);
        }
        for (index, (_, points)) in self.curves.iter().enumerate() {
            let inside = points.iter().filter(|p| x.contains(&p[0]) && y.contains(&p[1]));
            let placed: Vec<_> = inside
                .map(|p| {
                    let (x, y) = chart.backend_coord(&(p[0], p[1]));
                    [x, y]
                })
                .collect();
            if placed.len() > 1 {
                let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(&placed), stroke(index, 10));
            }
        }
        Ok(out)
    }
}

/// Powers of ten on the scale, and their places.
#[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
fn marks(most: f64) -> Vec<(f64, String)> {
    let top = most.log10();
    let exponents = (top - DECADES).ceil() as i32..=top.floor() as i32;
    exponents.map(|e| (1.0 - (top - f64::from(e)) / DECADES, power_of_ten(e))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_says_what_the_greys_are() {
        let spectra =
            vec![(600.0, 1.0, vec![0.0, 2e-3, 2e-7]), (900.0, 1.0, vec![0.0, 1e-4, 1e-9])];
        let waterfall = Waterfall {
            description: "x".to_owned(),
            title: "y".to_owned(),
            spectra,
            unit: "N²/Hz",
            highest: 3.0,
            curves: Vec::new(),
        };
        let svg = waterfall.file().expect("drawn");
        // Five decades below 2e-3, eight steps.
        for part in ["10⁻³</text>", "10⁻⁷</text>", "N²/Hz</text>"] {
            assert!(svg.contains(part), "{part}: {svg}");
        }
        assert!(!svg.contains("10⁻⁸</text>") && !svg.contains("10⁻²</text>"), "{svg}");
        assert_eq!(svg.matches("stroke-width=\"4\"").count(), LEVELS);
    }
}
