//! Both sweeps drawn: error against distance, log-log, one panel each.

use std::error::Error;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use precess_tests::accuracy::AccuracyAtDistance;
use precess_tests::bounds::{ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST};

use crate::Sweeps;
use crate::limit::Limit;

/// The rules that turn the colours on dark screens.
const THEME: &str = include_str!("../theme.css");

const INK: RGBColor = RGBColor(0x1c, 0x1c, 0x1e);
const GRID: RGBColor = RGBColor(0xe3, 0xe3, 0xe6);
const LEVEL: RGBColor = RGBColor(0x8a, 0x8a, 0x8e);
/// Curves in order, as in the figures of the desktop tool: distinct for colour-blind readers too.
const CURVES: [RGBColor; 2] = [RGBColor(0x00, 0x5f, 0xb3), RGBColor(0xd5, 0x5e, 0x00)];
const FONT: &str = "STIX Two Text, Libertinus Serif, Georgia, Times New Roman, serif";

/// Everything is drawn in tenths of a unit, because plotters rounds to whole ones.
const FINE: i32 = 10;
/// plotters writes this share of the size it is passed.
const FONT_SHARE: f64 = 1.24;
const WIDTH: i32 = 780;
const PANEL: i32 = 380;
/// Width of the legend to the right of the axes.
const NAMES: i32 = 240;
/// Distance of two names.
const LINE: i32 = 20;
/// Errors drawn, as powers of ten.
const ERRORS: std::ops::Range<f64> = -16.0..0.0;

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// One sweep and what it is drawn with.
struct Panel<'a> {
    title: &'a str,
    label: &'a str,
    /// Distances drawn, as powers of ten.
    powers: std::ops::Range<f64>,
    curves: Vec<(&'a str, &'a [AccuracyAtDistance])>,
    /// Powers of the distance that an error may grow by.
    laws: Vec<(&'a str, f64)>,
}

/// The drawing as an SVG file.
pub(crate) fn chart(sweeps: &Sweeps) -> Result<String, Box<dyn Error>> {
    let panels = [
        Panel {
            title: "Bare wheels in massless gimbals",
            label: "Distance δ from the singular pose (rad)",
            powers: -8.0..0.0,
            curves: vec![("DGVSCMG", &sweeps.dgvscmg), ("balanced DGVSCMG", &sweeps.balanced)],
            laws: vec![("eps/δ²", -2.0), ("eps/δ", -1.0)],
        },
        Panel {
            title: "Spacecraft stated about a far point B",
            label: "Distance D of the centre of mass from B (m)",
            powers: 0.0..8.0,
            curves: vec![("0 to 8 DGVSCMGs", &sweeps.offset)],
            laws: vec![("eps (D/1 m)²", 2.0)],
        },
    ];
    let (w, h) = (WIDTH * FINE, 2 * PANEL * FINE);
    let mut drawing = String::new();
    {
        let size = (w.unsigned_abs(), h.unsigned_abs());
        let area = SVGBackend::with_string(&mut drawing, size).into_drawing_area();
        for (panel, area) in panels.iter().zip(area.split_evenly((2, 1))) {
            draw(&area, panel)?;
        }
        area.present()?;
    }
    // plotters' own root element says nothing of the units: ours replaces it.
    let body = drawing.split_once('>').map_or("", |(_, rest)| rest);
    Ok(format!(
        "<svg class=\"figure\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{WIDTH}\" \
         height=\"{}\" viewBox=\"0 0 {w} {h}\">\n\
         <title>Relative error of the accelerations against the distance from a singular pose, and \
         against the distance of the centre of mass from B</title>\n\
         <style>\n{THEME}</style>\n\
         <rect x=\"0\" y=\"0\" width=\"{w}\" height=\"{h}\" fill=\"#FFFFFF\"/>{body}",
        2 * PANEL
    ))
}

fn draw(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    panel: &Panel<'_>,
) -> Result<(), Box<dyn Error>> {
    area.draw_text(panel.title, &text(14.0), (84 * FINE, 12 * FINE))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(36 * FINE)
        .margin_left(12 * FINE)
        .margin_right(NAMES * FINE)
        .margin_bottom(8 * FINE)
        .x_label_area_size(44 * FINE)
        .y_label_area_size(72 * FINE)
        .build_cartesian_2d(panel.powers.clone(), ERRORS)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(8))
        .axis_style(INK.stroke_width(8))
        .set_all_tick_mark_size(4 * FINE)
        .x_labels(9)
        .y_labels(9)
        .x_label_formatter(&|power| ten_to(*power))
        .y_label_formatter(&|power| ten_to(*power))
        .label_style(text(12.0))
        .axis_desc_style(text(13.0))
        .x_desc(panel.label)
        .y_desc("Relative error of the accelerations")
        .draw()?;
    let mut names = Names { area, line: 0 };
    for ((name, rows), colour) in panel.curves.iter().zip(CURVES) {
        curve(&mut chart, rows, colour)?;
        names.add(&format!("{name}, worst"), colour, &Mark::Dots)?;
        names.add(&format!("{name}, median"), colour, &Mark::Line)?;
    }
    for (index, (name, power)) in panel.laws.iter().enumerate() {
        let mark = if index == 0 { Mark::Line } else { Mark::Dashes };
        law(&mut chart, &panel.powers, *power, &mark)?;
        names.add(name, LEVEL, &mark)?;
    }
    for (name, bound, mark) in [
        ("bound of the worst", ACCELERATIONS_WORST, Mark::Line),
        ("bound of the median", ACCELERATIONS_MEDIAN, Mark::Dashes),
    ] {
        let bound = libm::log10(bound);
        let ends = [(panel.powers.start, bound), (panel.powers.end, bound)];
        line(&mut chart, ends, INK, &mark)?;
        names.add(&format!("{name}, {}", ten_to(bound)), INK, &mark)?;
    }
    rejected(&mut chart, panel)
}

/// Worst with dots, median without, where there are any.
fn curve(
    chart: &mut Chart<'_, '_>,
    rows: &[AccuracyAtDistance],
    colour: RGBColor,
) -> Result<(), Box<dyn Error>> {
    let solved = || rows.iter().filter(|row| row.solved > 0);
    let worst: Vec<_> = solved().map(|row| at(row, row.worst_block.worst())).collect();
    let median = solved().map(|row| at(row, row.worst_block.median()));
    chart.draw_series(LineSeries::new(median, colour.stroke_width(14)))?;
    chart.draw_series(LineSeries::new(worst.iter().copied(), colour.stroke_width(22)))?;
    let dot = |at: &(f64, f64)| Circle::new(*at, 30, colour.filled());
    chart.draw_series(worst.iter().map(dot))?;
    Ok(())
}

fn at(row: &AccuracyAtDistance, error: f64) -> (f64, f64) {
    (libm::log10(row.distance), libm::log10(error).max(ERRORS.start))
}

/// The line eps times a power of the distance, as far as it lies within the panel.
fn law(
    chart: &mut Chart<'_, '_>,
    powers: &std::ops::Range<f64>,
    power: f64,
    mark: &Mark,
) -> Result<(), Box<dyn Error>> {
    let eps = libm::log10(f64::EPSILON);
    let error = |distance: f64| eps + power * distance;
    let steps =
        (0..=200).map(|step| powers.start + (powers.end - powers.start) * f64::from(step) / 200.0);
    let inside: Vec<_> = steps
        .map(|distance| (distance, error(distance)))
        .filter(|(_, error)| ERRORS.contains(error))
        .collect();
    let ends = inside.first().copied().zip(inside.last().copied());
    let Some((first, last)) = ends else { return Ok(()) };
    line(chart, [first, last], LEVEL, mark)
}

fn line(
    chart: &mut Chart<'_, '_>,
    ends: [(f64, f64); 2],
    colour: RGBColor,
    mark: &Mark,
) -> Result<(), Box<dyn Error>> {
    let style = colour.stroke_width(12);
    if matches!(mark, Mark::Dashes) {
        chart.draw_series(DashedLineSeries::new(ends, 60, 40, style))?;
    } else {
        chart.draw_series([PathElement::new(ends, style)])?;
    }
    Ok(())
}

/// A line where the solver rejects the first spacecraft, with what it says.
fn rejected(chart: &mut Chart<'_, '_>, panel: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let first = panel.curves.first().and_then(|(_, rows)| Limit::of_rows(rows).rejected);
    let Some(first) = first else { return Ok(()) };
    let x = libm::log10(first);
    let ends = [(x, ERRORS.start), (x, ERRORS.end)];
    chart.draw_series(DashedLineSeries::new(ends, 20, 40, INK.stroke_width(10)))?;
    // On the side of the line that has room.
    let left = x > f64::midpoint(panel.powers.start, panel.powers.end);
    let (side, by) = if left { (HPos::Right, -6) } else { (HPos::Left, 6) };
    let (x, y) = chart.backend_coord(&(x, ERRORS.start + 0.7));
    let area = chart.plotting_area().strip_coord_spec();
    let (left, top) = area.get_base_pixel();
    let style = text(12.0).pos(Pos::new(side, VPos::Center));
    area.draw_text("first rejected as singular", &style, (x - left + by * FINE, y - top))?;
    Ok(())
}

/// The sample of a curve in the legend.
enum Mark {
    Dots,
    Line,
    Dashes,
}

/// The legend, from the top.
struct Names<'a, 'b> {
    area: &'a DrawingArea<SVGBackend<'b>, Shift>,
    line: i32,
}

impl Names<'_, '_> {
    fn add(&mut self, name: &str, colour: RGBColor, mark: &Mark) -> Result<(), Box<dyn Error>> {
        let y = (46 + LINE * self.line) * FINE;
        let x = |units: i32| (WIDTH - NAMES + units) * FINE;
        let width = if matches!(mark, Mark::Dots) { 22 } else { 14 };
        let ends: Vec<(i32, i32)> = match mark {
            Mark::Dashes => vec![(12, 17), (21, 26), (30, 34)],
            _ => vec![(12, 34)],
        };
        for (from, to) in ends {
            let style = colour.stroke_width(width);
            self.area.draw(&PathElement::new([(x(from), y), (x(to), y)], style))?;
        }
        if matches!(mark, Mark::Dots) {
            self.area.draw(&Circle::new((x(23), y), 30, colour.filled()))?;
        }
        let style = text(12.0).pos(Pos::new(HPos::Left, VPos::Center));
        self.area.draw_text(name, &style, (x(40), y))?;
        self.line += 1;
        Ok(())
    }
}

fn text(size: f64) -> TextStyle<'static> {
    (FONT, size * f64::from(FINE) * FONT_SHARE).into_font().color(&INK)
}

/// A power of ten, as it is written.
fn ten_to(power: f64) -> String {
    let digits = format!("{:.0}", power.abs());
    let raised = digits.chars().filter_map(|digit| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize - 48));
    let sign = if power <= -0.5 { "⁻" } else { "" };
    format!("10{sign}{}", raised.collect::<String>())
}
