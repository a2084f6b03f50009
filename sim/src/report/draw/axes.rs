//! What every figure with axes has: title, mesh, labels and frame; and the SVG file around a drawing.

use std::borrow::Cow;

use plotters::coord::ranged1d::{BoldPoints, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::figure::{
    ABOVE, Area, GRID, INK, LEFT, RIGHT, THEME, TYPE, TYPE_SMALL, px, text, whole,
};
use crate::report::error::DrawError;

/// Most ticks that are asked for; ours are fewer.
const TICKS: usize = 12;
/// Width of a digit in units of the size of its type.
const DIGIT: f64 = 0.6;
/// Width of a letter in units of the size of its type.
const LETTER: f64 = 0.52;
/// The smallest type of a title.
const TITLE_MIN: f64 = 10.0;
/// Of the title of a vertical axis, and between it, the labels and the ticks.
const BESIDE: f64 = 26.0;

/// Axes to draw in.
pub(in crate::report) type Chart<'a, 's, X, Y> =
    ChartContext<'a, SVGBackend<'s>, Cartesian2d<X, Y>>;

/// Space above the axes, and below them for labels.
pub(in crate::report) struct Space {
    pub(in crate::report) above: f64,
    pub(in crate::report) below: f64,
}

/// The title of a drawing, above its first panel: in smaller type where it is long, and cut at a word where it is still
/// wider than the drawing, whose description has all of it.
pub(in crate::report) fn title(area: &Area<'_>, words: &str) -> Result<(), DrawError> {
    let (wide, _) = area.dim_in_pixel();
    let room = f64::from(wide) / f64::from(px(1.0)) - LEFT;
    let letters = crate::spectra::float(words.chars().count());
    let size = (room / (LETTER * letters)).clamp(TITLE_MIN, TYPE);
    let style = text(size, INK).pos(Pos::new(HPos::Left, VPos::Center));
    let shown = shortened(words, room / (LETTER * size));
    area.draw_text(&shown, &style, (px(LEFT), px(0.62 * ABOVE)))?;
    Ok(())
}

/// The first words, of at most so many letters; with an ellipsis where some are left out.
fn shortened(words: &str, letters: f64) -> Cow<'_, str> {
    let fits = |text: &str| crate::spectra::float(text.chars().count()) <= letters;
    if fits(words) {
        return words.into();
    }
    let ends = words.char_indices().filter(|(_, letter)| *letter == ' ').map(|(at, _)| at);
    let cut = ends.map(|at| format!("{}…", &words[..at])).take_while(|text| fits(text)).last();
    // A word of its own that is too long.
    let some =
        (1..).zip(words.chars()).take_while(|(count, _)| crate::spectra::float(*count) < letters);
    cut.unwrap_or_else(|| some.map(|(_, letter)| letter).chain(['…']).collect()).into()
}

/// Draws axes with a mesh, their labels and a frame.
pub(in crate::report) fn axes<'a, 's, X, Y>(
    area: &'a Area<'s>,
    space: &Space,
    x: X,
    y: Y,
    labels: [&str; 2],
) -> Result<Chart<'a, 's, X, Y>, DrawError>
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let (of_x, of_y) = (x.range(), y.range());
    // The longest label of the vertical axis stays beside its title.
    let ticks = y.key_points(BoldPoints(TICKS)).into_iter();
    let longest = ticks.map(|tick| y.format_ext(&tick).chars().count()).max().unwrap_or(0);
    let labels_wide = DIGIT * TYPE_SMALL * crate::spectra::float(longest) + BESIDE;
    let mut chart = ChartBuilder::on(area)
        .margin_top(px(space.above))
        .margin_right(px(RIGHT))
        .x_label_area_size(px(space.below))
        .y_label_area_size(px(LEFT.max(labels_wide)))
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(whole(0.8)))
        .axis_style(INK.stroke_width(whole(0.8)))
        .set_all_tick_mark_size(px(4.0))
        .label_style(text(TYPE_SMALL, INK))
        .axis_desc_style(text(TYPE, INK))
        .x_desc(labels[0])
        .y_desc(labels[1])
        .draw()?;
    let corners = [(of_x.start, of_y.start), (of_x.end, of_y.end)];
    chart.draw_series([Rectangle::new(corners, INK.stroke_width(8))])?;
    Ok(chart)
}

/// An SVG file of its own, of a drawing that is passed the rules that turn its colours on dark screens.
pub(in crate::report) fn svg_file(
    document: impl FnOnce(&str) -> Result<String, DrawError>,
) -> Result<String, DrawError> {
    let drawn = document(&format!("<style>\n{THEME}</style>\n"))?;
    Ok(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{drawn}"))
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn a_title_is_cut_at_a_word() {
        assert_eq!(shortened("a limit at 3000 rpm", 19.0), "a limit at 3000 rpm");
        assert_eq!(shortened("a limit at 3000 rpm", 18.0), "a limit at 3000…");
        assert_eq!(shortened("mikrovibration", 9.0), "mikrovib…");
    }
}
