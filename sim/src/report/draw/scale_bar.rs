//! [`ScaleBar`]: what the colours or greys of a picture mean, right of its axes: steps, numbers, and a label above.

use std::fmt::Write as _;

use super::figure::{FONT, TYPE_SMALL, WIDTH, escaped, px};

/// Width of the bar with its numbers, and of the bar itself.
pub(in crate::report) const SCALE_WIDTH: f64 = 74.0;
const BAR_WIDTH: f64 = 14.0;

/// A scale.
pub(in crate::report) struct ScaleBar<'a> {
    /// Attributes of the steps, from the bottom.
    pub(in crate::report) steps: Vec<String>,
    /// Place of each number, zero at the bottom and one at the top, and the number.
    pub(in crate::report) marks: Vec<(f64, String)>,
    /// What it shows, with its unit.
    pub(in crate::report) label: &'a str,
}

impl ScaleBar<'_> {
    /// Draws it right of axes, from the top to the bottom of them.
    pub(in crate::report) fn draw(&self, out: &mut String, right: i32, [top, bottom]: [i32; 2]) {
        let left = right + px(12.0);
        let end = left + px(BAR_WIDTH);
        let height = f64::from(bottom - top);
        let y = |share: f64| f64::from(bottom) - share * height;
        let count = crate::spectra::float(self.steps.len());
        for (index, attributes) in self.steps.iter().enumerate() {
            let [from, to] = [index, index + 1].map(|step| crate::spectra::float(step) / count);
            let _ = writeln!(
                out,
                "<path d=\"M{left} {:.0}H{end}V{:.0}H{left}z\" {attributes}/>",
                y(to),
                y(from)
            );
        }
        let size = px(TYPE_SMALL);
        for (share, number) in &self.marks {
            let at = y(*share);
            let _ = writeln!(
                out,
                "<path d=\"M{end} {at:.0}h30\" fill=\"none\" stroke=\"#1C1C1E\" stroke-width=\"8\"/>\
                 <text x=\"{}\" y=\"{at:.0}\" dy=\"0.32em\" font-family=\"{FONT}\" font-size=\"{size}\" \
                 fill=\"#1C1C1E\">{number}</text>",
                end + 45,
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\" font-family=\"{FONT}\" font-size=\"{size}\" \
             fill=\"#1C1C1E\">{}</text>",
            px(WIDTH),
            top - px(7.0),
            escaped(self.label)
        );
    }
}
