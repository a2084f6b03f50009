//! [`phases`]: the phases of several curves over frequency, each in a panel of its own: more than three in one panel cannot be
//! told apart, since each turns at every resonance.

use std::fmt::Write as _;

use plotters::coord::ranged1d::{BoldPoints, Ranged, ValueFormatter};

use super::figure::{BELOW, FONT, LEFT, RIGHT, TYPE, TYPE_SMALL, WIDTH, escaped, moves, px};
use super::legend::stroke_of;
use super::log_panel::{Kind, Scale};

/// Panels beside one another.
const COLUMNS: usize = 3;
/// Height of a panel, between two of one row, and above one for its name.
const HEIGHT: f64 = 64.0;
const BETWEEN: f64 = 12.0;
const ABOVE: f64 = 18.0;
/// Least distance of two labels of the frequency.
const APART: f64 = 30.0;
/// A label this near to the end of a panel does not go beyond it.
const CORNER: f64 = 10.0;
/// Size of the names.
const NAME: f64 = 11.0;

/// Names and phases, deg, of curves over one range of frequencies.
pub(super) struct Phases<'a> {
    /// Hz, rising, above zero.
    pub(super) frequencies: &'a [f64],
    pub(super) x: Scale,
    pub(super) curves: &'a [(&'a str, Vec<f64>)],
}

/// Height of the panels of so many curves, with their labels.
pub(super) fn height(curves: usize) -> f64 {
    crate::spectra::float(curves.div_ceil(COLUMNS)) * (ABOVE + HEIGHT) + BELOW
}

impl Phases<'_> {
    /// The panels, below an ordinate in tenths of a unit.
    pub(super) fn draw(&self, top: i32) -> String {
        let columns = crate::spectra::float(COLUMNS);
        let width = (WIDTH - LEFT - RIGHT - (columns - 1.0) * BETWEEN) / columns;
        let mut out = format!("<g font-family=\"{FONT}\" fill=\"#1C1C1E\">");
        for (index, (name, values)) in self.curves.iter().enumerate() {
            let (row, column) = (index / COLUMNS, index % COLUMNS);
            let left = LEFT + crate::spectra::float(column) * (width + BETWEEN);
            let above = crate::spectra::float(row) * (ABOVE + HEIGHT) + ABOVE;
            let panel = Place {
                left: px(left),
                right: px(left + width),
                top: top + px(above),
                bottom: top + px(above + HEIGHT),
            };
            let is_last = index + COLUMNS >= self.curves.len();
            self.frame(&mut out, &panel, [column == 0, is_last]);
            let _ = writeln!(
                out,
                "<text x=\"{}\" y=\"{}\" font-size=\"{}\">{}</text>",
                panel.left,
                panel.top - px(4.0),
                px(NAME),
                escaped(name)
            );
            self.curve(&mut out, &panel, (index, name), values);
        }
        let rows = self.curves.len().div_ceil(COLUMNS);
        let bottom = top + px(crate::spectra::float(rows) * (ABOVE + HEIGHT));
        let middle = i32::midpoint(top + px(ABOVE), bottom);
        let size = px(TYPE);
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{middle}\" font-size=\"{size}\" text-anchor=\"middle\" \
             transform=\"rotate(-90, {}, {middle})\">Phase (deg)</text>\
             <text x=\"{}\" y=\"{}\" font-size=\"{size}\" text-anchor=\"middle\">Frequency f (Hz)</text></g>",
            px(14.0),
            px(14.0),
            px(0.5 * (LEFT + WIDTH - RIGHT)),
            bottom + px(BELOW - 8.0),
        );
        out
    }

    /// Grid, frame and labels; those of the phase to the left of the first column, those of the frequency below the last row.
    fn frame(&self, out: &mut String, place: &Place, [of_phase, of_frequency]: [bool; 2]) {
        let Place { left, right, top, bottom } = *place;
        let size = px(0.85 * TYPE_SMALL);
        let mut grid = String::new();
        for phase in [-180.0, -90.0, 0.0, 90.0, 180.0] {
            let y = place.ordinate(phase);
            let _ = write!(grid, "M{left} {y}H{right}");
            if of_phase && [-180.0, 0.0, 180.0].contains(&phase) {
                let text = format!("{phase:.0}").replace('-', "\u{2212}");
                let _ = write!(
                    out,
                    "<text x=\"{}\" y=\"{y}\" dy=\"0.32em\" font-size=\"{size}\" text-anchor=\"end\">{text}</text>",
                    left - px(5.0)
                );
            }
        }
        let mut last = i32::MIN;
        for tick in self.x.key_points(BoldPoints(12)) {
            let x = self.x.map(&tick, (left, right));
            let _ = write!(grid, "M{x} {top}V{bottom}");
            if of_frequency && x >= last.saturating_add(px(APART)) {
                last = x;
                // Labels at the ends of panels beside one another would touch.
                let anchor = match (x - left < px(CORNER), right - x < px(CORNER)) {
                    (true, _) => "start",
                    (_, true) => "end",
                    _ => "middle",
                };
                let _ = write!(
                    out,
                    "<text x=\"{x}\" y=\"{}\" font-size=\"{size}\" text-anchor=\"{anchor}\">{}</text>",
                    bottom + px(13.0),
                    self.x.format_ext(&tick)
                );
            }
        }
        let _ = writeln!(
            out,
            "<path d=\"{grid}\" fill=\"none\" stroke=\"#E3E3E6\" stroke-width=\"8\"/>\
             <path d=\"M{left} {top}H{right}V{bottom}H{left}z\" fill=\"none\" stroke=\"#1C1C1E\" stroke-width=\"8\"/>"
        );
    }

    /// A phase that goes beyond 180 degrees goes on at -180.
    fn curve(&self, out: &mut String, place: &Place, (index, name): (usize, &str), values: &[f64]) {
        let points: Vec<_> = self.frequencies.iter().zip(values).collect();
        let goes_on =
            |a: &(&f64, &f64), b: &(&f64, &f64)| (a.1 - b.1).abs() <= 180.0 && b.1.is_finite();
        for run in points.chunk_by(goes_on).filter(|run| run.iter().all(|(_, v)| v.is_finite())) {
            let placed: Vec<_> = run
                .iter()
                .map(|(frequency, phase)| {
                    [self.x.map(frequency, (place.left, place.right)), place.ordinate(**phase)]
                })
                .collect();
            let _ =
                writeln!(out, "<path d=\"{}\" {}/>", moves(&placed), stroke_of(name, index, 13));
        }
    }
}

/// Where a panel is, tenths of a unit.
struct Place {
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
}

impl Place {
    fn ordinate(&self, phase: f64) -> i32 {
        let axis = Scale { range: -180.0..180.0, kind: Kind::Phase };
        axis.map(&phase, (self.bottom, self.top))
    }
}
