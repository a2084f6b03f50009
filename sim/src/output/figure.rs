//! One figure: panels of curves over time, drawn as SVG by plotters.
//!
//! Everything is drawn in tenths of a unit, because plotters rounds to whole ones. Colours are
//! those of the light theme, so a viewer that knows no CSS shows a right picture; `theme.css`
//! turns them for dark screens by selecting on the attribute, which is why each colour below has
//! one meaning.

use std::fmt;
use std::io;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::ticks::{Axis, Scale, decimated};

/// The rules that turn the colours on dark screens, for an SVG file or the page around it.
pub const THEME: &str = include_str!("theme.css");

/// Ink of text, frame and axes.
const INK: RGBColor = RGBColor(0x1c, 0x1c, 0x1e);
/// Grid lines.
const GRID: RGBColor = RGBColor(0xe3, 0xe3, 0xe6);
/// Level lines, such as a bound.
const LEVEL: RGBColor = RGBColor(0x8a, 0x8a, 0x8e);
/// Curves in order: blue, orange, green, distinct for colour-blind readers too.
const CURVES: [RGBColor; 3] =
    [RGBColor(0x00, 0x5f, 0xb3), RGBColor(0xd5, 0x5e, 0x00), RGBColor(0x00, 0x8a, 0x64)];

const FONT: &str = "STIX Two Text, Libertinus Serif, Georgia, Times New Roman, serif";
/// Tenths of a unit, see above.
const FINE: f64 = 10.0;
/// plotters writes this share of the size it is passed.
const FONT_SHARE: f64 = 1.24;
const WIDTH: f64 = 450.0;
const PANEL: f64 = 224.0;
const LEGEND: f64 = 20.0;
/// Around a figure: names and titles in a reader's wider font.
const MARGIN: f64 = 12.0;
/// Type sizes: labels and legend, ticks.
const TYPE: f64 = 13.0;
const TYPE_SMALL: f64 = 12.0;

/// A curve.
pub struct Curve {
    /// Its name in the legend.
    pub name: &'static str,
    /// Points, in the order of time.
    pub points: Vec<(f64, f64)>,
}

/// One set of axes.
pub struct Panel {
    /// The text above it, after its letter.
    pub title: String,
    /// Label of the vertical axis, with its unit.
    pub label: &'static str,
    /// Vertical scale.
    pub scale: Scale,
    /// Curves, at most three.
    pub curves: Vec<Curve>,
    /// A horizontal line and its name.
    pub level: Option<(f64, &'static str)>,
}

/// Panels one above the other, all over time.
pub struct Figure {
    /// What the picture shows, for readers who cannot see it.
    pub description: String,
    /// The panels; the first one's curves name the legend.
    pub panels: Vec<Panel>,
}

/// plotters could not draw.
#[derive(Debug)]
pub struct DrawError {
    /// What it reports.
    pub source: DrawingAreaErrorKind<io::Error>,
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot draw the figure: {}; this is a fault of the program", self.source)
    }
}

impl std::error::Error for DrawError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

impl From<DrawingAreaErrorKind<io::Error>> for DrawError {
    fn from(source: DrawingAreaErrorKind<io::Error>) -> Self {
        Self { source }
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

impl Figure {
    /// The figure as an SVG file of its own.
    ///
    /// # Errors
    /// If plotters cannot draw.
    pub fn file(&self) -> Result<String, DrawError> {
        let style = format!("<style>\n{THEME}</style>\n");
        let document = self.document(&style)?;
        Ok(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}"))
    }

    /// The figure as part of a page that holds [`THEME`].
    ///
    /// # Errors
    /// If plotters cannot draw.
    pub fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    #[expect(clippy::cast_precision_loss, reason = "a figure has few panels")]
    fn height(&self) -> f64 {
        LEGEND + PANEL * self.panels.len() as f64
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let mut drawing = String::new();
        {
            let area = SVGBackend::with_string(&mut drawing, (whole(WIDTH), whole(self.height())))
                .into_drawing_area();
            self.draw(&area)?;
            area.present()?;
        }
        // plotters' own root element says nothing of the units: ours replaces it.
        let body = drawing.split_once('>').map_or("", |(_, rest)| rest);
        let body = body.rsplit_once("</svg>").map_or(body, |(body, _)| body);
        let (width, height) = (WIDTH + 2.0 * MARGIN, self.height() + 2.0 * MARGIN);
        let (x, w, h) = (-px(MARGIN), px(width), px(height));
        let description = escaped(&self.description);
        Ok(format!(
            "<svg class=\"figure\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" \
             width=\"{width}\" height=\"{height}\" viewBox=\"{x} {x} {w} {h}\">\n\
             <title>{description}</title>\n{style}\
             <rect x=\"{x}\" y=\"{x}\" width=\"{w}\" height=\"{h}\" fill=\"#FFFFFF\"/>\n\
             <g stroke-linejoin=\"round\">{body}</g>\n</svg>\n"
        ))
    }

    fn draw(&self, area: &Area) -> Result<(), DrawError> {
        let (legend, rest) = area.split_vertically(px(LEGEND));
        let panels = rest.split_evenly((self.panels.len(), 1));
        if let Some(first) = self.panels.first() {
            draw_legend(&legend, &first.curves)?;
        }
        for ((panel, area), letter) in self.panels.iter().zip(&panels).zip('a'..) {
            let title = match self.panels.len() {
                1 => panel.title.clone(),
                _ => format!("({letter}) {}", panel.title),
            };
            panel.draw(area, &title)?;
        }
        Ok(())
    }
}

fn draw_legend(area: &Area, curves: &[Curve]) -> Result<(), DrawError> {
    /// Width that a letter of a name takes, on average, and that of a line sample with its gaps.
    const LETTER: f64 = 0.52 * TYPE;
    const SAMPLE: f64 = 22.0;
    const GAP: f64 = 6.0;
    const BETWEEN: f64 = 20.0;
    #[expect(clippy::cast_precision_loss, reason = "names are short")]
    let width = |c: &Curve| SAMPLE + GAP + LETTER * c.name.chars().count() as f64;
    let total = curves.iter().map(|c| width(c) + BETWEEN).sum::<f64>() - BETWEEN;
    let mut x = 0.5 * (WIDTH - total);
    let y = 0.5 * LEGEND;
    for (curve, colour) in curves.iter().zip(CURVES) {
        let sample = vec![(px(x), px(y)), (px(x + SAMPLE), px(y))];
        area.draw(&PathElement::new(sample, colour.stroke_width(whole(2.0))))?;
        let style = text(TYPE, INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(curve.name, &style, (px(x + SAMPLE + GAP), px(y)))?;
        x += width(curve) + BETWEEN;
    }
    Ok(())
}

impl Panel {
    fn draw(&self, area: &Area, title: &str) -> Result<(), DrawError> {
        const LEFT: f64 = 60.0;
        const BELOW: f64 = 42.0;
        const ABOVE: f64 = 34.0;
        const RIGHT: f64 = 12.0;
        let style = text(TYPE, INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(title, &style, (px(LEFT), px(0.62 * ABOVE)))?;
        let (x, y) = (self.time(), self.scale.range(self.values()));
        let mut chart = ChartBuilder::on(area)
            .margin_top(px(ABOVE))
            .margin_right(px(RIGHT))
            .x_label_area_size(px(BELOW))
            .y_label_area_size(px(LEFT))
            .build_cartesian_2d(
                Axis::new(Scale::Linear, x.clone()),
                Axis::new(self.scale, y.clone()),
            )?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(whole(0.8)))
            .axis_style(INK.stroke_width(whole(0.8)))
            .set_all_tick_mark_size(px(4.0))
            .label_style(text(TYPE_SMALL, INK))
            .axis_desc_style(text(TYPE, INK))
            .x_desc("Time t (s)")
            .y_desc(self.label)
            .draw()?;
        if let Some((level, name)) = self.level {
            let level = self.scale.apply(level);
            let line = [(x.start, level), (x.end, level)];
            chart.draw_series(LineSeries::new(line, LEVEL.stroke_width(whole(1.2))))?;
            let style = text(TYPE_SMALL, INK).pos(Pos::new(HPos::Right, VPos::Bottom));
            let at = (x.end - 0.015 * (x.end - x.start), level + 0.015 * (y.end - y.start));
            chart.draw_series([Text::new(name, at, style)])?;
        }
        for (curve, colour) in self.curves.iter().zip(CURVES) {
            let points = curve.points.iter().map(|&(t, v)| (t, self.scale.apply(v)));
            let points = points.filter(|(_, v)| v.is_finite()).collect::<Vec<_>>();
            let style = colour.stroke_width(whole(1.3));
            chart.draw_series(LineSeries::new(decimated(&points), style))?;
        }
        let frame = Rectangle::new([(x.start, y.start), (x.end, y.end)], INK.stroke_width(8));
        chart.draw_series([frame])?;
        Ok(())
    }

    fn time(&self) -> Range<f64> {
        let times = || self.curves.iter().flat_map(|c| &c.points).map(|p| p.0);
        let (from, to) = (times().fold(f64::MAX, f64::min), times().fold(f64::MIN, f64::max));
        if from < to { from..to } else { 0.0..1.0 }
    }

    fn values(&self) -> impl Iterator<Item = f64> + '_ {
        let level = self.level.map(|(value, _)| value);
        self.curves.iter().flat_map(|c| &c.points).map(|p| p.1).chain(level)
    }
}

fn text(size: f64, colour: RGBColor) -> TextStyle<'static> {
    (FONT, size * FINE * FONT_SHARE).into_font().color(&colour)
}

#[expect(clippy::cast_possible_truncation, reason = "sizes of a picture")]
fn px(value: f64) -> i32 {
    (value * FINE).round() as i32
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "positive sizes of a picture"
)]
fn whole(value: f64) -> u32 {
    (value * FINE).round() as u32
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
