//! Cost against the number of devices, log-log: services in colour, peers as grey lines.

use std::error::Error;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::axis::Axis;
use crate::contender::Contender;
use crate::race::{Time, Times};
use crate::subject::Subject;

/// The rules that turn the colours on dark screens.
const THEME: &str = include_str!("../theme.css");

const INK: RGBColor = RGBColor(0x1c, 0x1c, 0x1e);
const GRID: RGBColor = RGBColor(0xe3, 0xe3, 0xe6);
const PEER: RGBColor = RGBColor(0x8a, 0x8a, 0x8e);
/// Services in order, after Okabe and Ito: distinct for colour-blind readers too, on white and on
/// black.
const SERVICES: [RGBColor; 6] = [
    RGBColor(0x00, 0x5f, 0xb3),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x8a, 0x64),
    RGBColor(0xe6, 0x9f, 0x00),
];
/// The services that are drawn: more could not be distinguished.
const DRAWN: [&str; 5] = ["portable", "dispatched", "abreast", "batch", "parameters"];
const FONT: &str = "STIX Two Text, Libertinus Serif, Georgia, Times New Roman, serif";

/// Everything is drawn in tenths of a unit, because plotters rounds to whole ones.
const FINE: i32 = 10;
/// plotters writes this share of the size it is passed.
const FONT_SHARE: f64 = 1.24;
const WIDTH: i32 = 760;
const HEIGHT: i32 = 460;
/// Around the drawing, left, above, right, below: names and titles in a reader's wider font.
const MARGINS: [i32; 4] = [12, 0, 60, 8];
/// Width of the names to the right of the curves.
const NAMES: i32 = 310;
/// Least distance of two names.
const LINE: i32 = 17;

/// A curve: its name, its colour, and its points in the order of N.
struct Curve<'a> {
    name: &'a str,
    colour: RGBColor,
    width: u32,
    points: Vec<(f64, f64)>,
}

/// The drawing as an SVG file.
pub(crate) fn chart(contenders: &[Contender], times: &Times) -> Result<String, Box<dyn Error>> {
    let curves = curves(contenders, times);
    let mut drawing = String::new();
    {
        let size = (unsigned(WIDTH * FINE), unsigned(HEIGHT * FINE));
        let area = SVGBackend::with_string(&mut drawing, size).into_drawing_area();
        draw(&area, &curves)?;
        area.present()?;
    }
    // plotters' own root element says nothing of the units: ours replaces it.
    let body = drawing.split_once('>').map_or("", |(_, rest)| rest);
    let [left, above, right, below] = MARGINS;
    let (width, height) = (left + WIDTH + right, above + HEIGHT + below);
    let [x, y, w, h] = [-left, -above, width, height].map(|units| units * FINE);
    Ok(format!(
        "<svg class=\"figure\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" \
         height=\"{height}\" viewBox=\"{x} {y} {w} {h}\">\n\
         <title>Nanoseconds per evaluation against the number of devices</title>\n\
         <style>\n{THEME}</style>\n\
         <rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"#FFFFFF\"/>{body}"
    ))
}

fn curves<'a>(contenders: &'a [Contender], times: &Times) -> Vec<Curve<'a>> {
    let mut colours = SERVICES.into_iter().cycle();
    let curve = |contender: &'a Contender| {
        let point = |time: &Time| {
            let count: u32 = time.case.parse().ok()?;
            Some((f64::from(count).log2(), time.ns().log10()))
        };
        let mut points: Vec<_> = times.all_of(contender).filter_map(point).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|a, b| a.0 == b.0);
        let (colour, width) = match contender.service {
            Some(_) => (colours.next().unwrap_or(INK), 22),
            None => (PEER, 13),
        };
        Curve { name: &contender.name, colour, width, points }
    };
    let drawn = contenders.iter().filter(|who| is_drawn(who));
    drawn.map(curve).filter(|curve| !curve.points.is_empty()).collect()
}

/// Peers of evaluations, and the services of [`DRAWN`].
fn is_drawn(contender: &Contender) -> bool {
    match &contender.service {
        Some(service) => DRAWN.contains(&service.name.as_str()),
        None => contender.subject == Subject::Evaluation && !contender.is_ours(),
    }
}

fn draw<DB: DrawingBackend>(
    area: &DrawingArea<DB, plotters::coord::Shift>,
    curves: &[Curve<'_>],
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let all = || curves.iter().flat_map(|curve| &curve.points).copied();
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN, f64::max);
    let counts = 1.0..most(&mut all().map(|(n, _)| n.exp2())).max(2.0);
    let slowest = most(&mut all().map(|(_, ns)| ns));
    let fastest = -most(&mut all().map(|(_, ns)| -ns));
    let times = 10_f64.powf(fastest.floor())..10_f64.powf(slowest.ceil());
    let powers = (0..=16).map(|power| f64::from(power).exp2());
    let parts = (0..=12).flat_map(|decade| [1.0, 2.0, 5.0].map(|part| part * 10_f64.powi(decade)));
    let mut chart = ChartBuilder::on(area)
        .margin_top(14 * FINE)
        .margin_right(NAMES * FINE)
        .x_label_area_size(44 * FINE)
        .y_label_area_size(72 * FINE)
        .build_cartesian_2d(Axis::new(2.0, &counts, powers), Axis::new(10.0, &times, parts))?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(8))
        .axis_style(INK.stroke_width(8))
        .set_all_tick_mark_size(4 * FINE)
        .label_style(text(12.0))
        .axis_desc_style(text(13.0))
        .x_desc("Devices N")
        .y_desc("Time of an evaluation (ns)")
        .draw()?;
    let mut names = Vec::new();
    for curve in curves {
        let style = curve.colour.stroke_width(curve.width);
        chart.draw_series(LineSeries::new(curve.points.iter().copied(), style))?;
        chart.draw_series(curve.points.iter().map(|at| Circle::new(*at, 22, style)))?;
        if let Some(last) = curve.points.last() {
            names.push((chart.backend_coord(last), curve));
        }
    }
    names.sort_by_key(|((_, y), _)| *y);
    let mut free = 0;
    for (end, curve) in names {
        let y = end.1.max(free);
        free = y + LINE * FINE;
        let x = |units: i32| (WIDTH - NAMES + units) * FINE;
        // From where the curve ends to its name.
        area.draw(&PathElement::new([end, (x(28), y)], curve.colour.stroke_width(5)))?;
        let style = text(13.0).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(curve.name, &style, (x(34), y))?;
    }
    Ok(())
}

fn text(size: f64) -> TextStyle<'static> {
    (FONT, size * f64::from(FINE) * FONT_SHARE).into_font().color(&INK)
}

fn unsigned(value: i32) -> u32 {
    value.unsigned_abs()
}
