//! The figures of a [`JitterReport`]: a metric over speed and cumulative over frequency, waterfall, Campbell diagram.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::super::draw::plane::Plane;
use super::super::draw::spectrum::{SpectrumCurve, SpectrumFigure};
use super::super::number::{short, with_unit};
use super::super::sweep::scaled;
use super::super::unit::{SMALL_ANGLE, for_peak};
use super::{JitterReport, RPM, metric, rpm, worst_speed};
use crate::jitter::budget::{Assessed, outputs_of};
use crate::jitter::model::Line;
use crate::jitter::weight::Weight;
use crate::spectra::float;

/// A line is drawn in a waterfall from this square root of its share of the largest on.
const DOT_MIN: f64 = 1e-2;
/// Parts of the range of speeds, at most, of which a waterfall shows the largest lines.
const WATERFALL_PARTS: usize = 240;
/// Metrics of a page are drawn over logarithmic axes where the largest value of one of them is this many times its least.
const DECADES: f64 = 30.0;
/// A limit is drawn up to this many times the RMS.
const LIMIT_SHOWN: f64 = 3.0;

/// The share of a mean square in the metric of a requirement. A budget has no index.
fn weight(of: &Assessed) -> Weight {
    Weight::of_metric(&of.limit.metric).unwrap_or_else(|_| Weight::one())
}

/// The unit of a limit for some values and the limit, SI, times a power of ten where that makes numbers short; its size in SI.
fn unit_of(of: &Assessed, values: impl Iterator<Item = f64>) -> (String, f64) {
    let (unit, size) = &of.limit.unit;
    scaled((unit, *size), values.chain([of.limit.limit]))
}

/// The least and the largest of a metric over the speed and its limit, SI, of those above zero.
fn shown(of: &Assessed) -> [f64; 2] {
    let all = || of.values.iter().copied().chain([of.limit.limit]).filter(|value| *value > 0.0);
    [all().fold(f64::MAX, f64::min), all().fold(0.0, f64::max)]
}

/// Whether a metric over the speed wants a logarithmic axis.
fn is_over_decades(of: &Assessed) -> bool {
    let [least, most] = shown(of);
    most > DECADES * least
}

impl JitterReport<'_> {
    /// A metric over the speed, in the unit of its limit.
    pub(super) fn over_speed(&self, of: &Assessed) -> Plane {
        let (unit, size) = unit_of(of, of.values.iter().copied());
        let points = self.sweep.speeds.iter().zip(&of.values);
        let points = points.map(|(speed, value)| [speed * RPM, value / size]).collect();
        let ends = [self.budget.speeds[0], self.budget.speeds[1]];
        let limit = ends.map(|speed| [speed * RPM, of.limit.limit / size]).to_vec();
        let [_, most] = shown(of);
        Plane {
            description: format!("{} over the speed in rpm, in {unit}.", of.limit.name),
            title: format!("{}: {}", of.limit.name, metric(&of.limit.metric)),
            axes: ["Speed (rpm)".to_owned(), format!("Line of sight ({unit})")],
            curves: vec![("found".to_owned(), points), ("limit".to_owned(), limit)],
            lines: Vec::new(),
            dots: Vec::new(),
            marks: Vec::new(),
            large: true,
            logarithmic: self.assessed.iter().any(is_over_decades),
            ranges: [Some(ends.map(|speed| speed * RPM)), Some([0.0, 1.06 * most / size])],
        }
    }

    /// A metric of all lines up to a frequency, and from it, at the worst speed: lines of one frequency are added as the
    /// budget's phases say, so the end is the metric. The noise is that of the nearest speed at which its density is known, times
    /// what makes its mean square that of the worst speed.
    pub(super) fn cumulative(&self, of: &Assessed) -> Plane {
        let outputs = outputs_of(of.sight);
        let weight = weight(of);
        let speed = self.sweep.speeds.get(of.worst).copied().unwrap_or(0.0);
        let lines = self.sweep.squares(of.worst, &outputs, self.budget.phases, &weight);
        let mut sorted: Vec<_> =
            lines.into_iter().map(|(frequency, square)| (frequency / TAU, square)).collect();
        if let Some(densities) = self.sweep.noise.nearest(speed) {
            let noise = densities.squares(&outputs, &weight);
            let there: f64 = noise.iter().map(|(_, square)| square).sum();
            let here = self.sweep.noise_square(of.worst, &outputs, &weight);
            let factor = if there > 0.0 { here / there } else { 0.0 };
            sorted.extend(noise.into_iter().map(|(at, square)| (at, factor * square)));
        }
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let whole: f64 = sorted.iter().map(|(_, square)| square).sum();
        let (unit, size) = unit_of(of, std::iter::once(whole.sqrt()));
        let top = sorted.last().map_or(1.0, |(frequency, _)| 1.1 * frequency);
        let (mut forward, mut backward) = (vec![[0.0, 0.0]], vec![[0.0, whole.sqrt() / size]]);
        let mut sum = 0.0;
        for (frequency, square) in sorted {
            for (points, value) in [(&mut forward, sum), (&mut backward, whole - sum)] {
                points.push([frequency, value.max(0.0).sqrt() / size]);
            }
            sum += square;
            for (points, value) in [(&mut forward, sum), (&mut backward, whole - sum)] {
                points.push([frequency, value.max(0.0).sqrt() / size]);
            }
        }
        forward.push([top, whole.sqrt() / size]);
        backward.push([top, 0.0]);
        let speed = worst_speed(&self.sweep.speeds, of.worst, of.is_flat());
        let limit = of.limit.limit / size;
        let found = whole.sqrt() / size;
        let highest = if limit < LIMIT_SHOWN * found { limit.max(found) } else { found };
        let mut curves =
            vec![("from below".to_owned(), forward), ("from above".to_owned(), backward)];
        if limit <= highest {
            curves.push(("limit".to_owned(), vec![[0.0, limit], [top, limit]]));
        }
        Plane {
            description: format!(
                "{}: cumulative {} over frequency in Hz at {speed}, in {}.",
                of.limit.name,
                metric(&of.limit.metric),
                unit,
            ),
            title: format!("{}: {} at {speed}", of.limit.name, metric(&of.limit.metric)),
            axes: ["Frequency f (Hz)".to_owned(), format!("Cumulative ({unit})")],
            curves,
            lines: Vec::new(),
            dots: Vec::new(),
            marks: Vec::new(),
            large: false,
            logarithmic: false,
            ranges: [Some([0.0, top]), Some([0.0, 1.06 * highest])],
        }
    }

    /// Density of a line of sight by broadband noise at the worst speed of a requirement, both axes together, and what of it
    /// counts in the metric, of all lower frequencies; none without noise.
    pub(super) fn density(&self, of: &Assessed) -> Option<SpectrumFigure> {
        let speed = self.sweep.speeds.get(of.worst).copied()?;
        let densities = self.sweep.noise.nearest(speed)?;
        let outputs = outputs_of(of.sight);
        let (unit, size) = unit_of(of, std::iter::once(of.limit.limit));
        let sum = |values: &Vec<f64>| -> f64 {
            outputs.iter().filter_map(|output| values.get(*output)).sum()
        };
        let square = size * size;
        let density: Vec<f64> =
            densities.values.iter().map(|values| sum(values) / square).collect();
        let cumulative = densities.cumulative(&outputs, &weight(of));
        let rms: Vec<f64> = cumulative.iter().map(|sum| sum.sqrt() / size).collect();
        let limit = vec![of.limit.limit / size; rms.len()];
        let curve = |name: &str, density: Vec<f64>, rms: Vec<f64>| SpectrumCurve {
            name: name.to_owned(),
            density,
            rms,
        };
        let title = format!("{}: broadband noise at {}", of.limit.name, rpm(densities.speed));
        Some(SpectrumFigure {
            description: format!("{title}, density and cumulative RMS over frequency, in {unit}."),
            title,
            unit: unit.clone(),
            frequencies: densities.frequencies.clone(),
            curves: vec![
                curve("noise", density.clone(), rms),
                curve("limit", vec![f64::NAN; density.len()], limit),
            ],
        })
    }

    /// Orders that tones have, each once, rising.
    pub(super) fn orders(&self) -> Vec<f64> {
        let mut orders: Vec<f64> = self.sweep.contributors.iter().map(|of| of.order).collect();
        orders.sort_by(f64::total_cmp);
        orders.dedup();
        orders
    }

    /// Straight lines of the orders.
    pub(super) fn order_lines(&self) -> Vec<(String, [[f64; 2]; 2])> {
        let [from, to] = self.budget.speeds;
        let line = |order: &f64| {
            let at = |speed: f64| [speed * RPM, order * speed / TAU];
            (format!("{}×", short(*order, 4)), [at(from), at(to)])
        };
        self.orders().iter().map(line).collect()
    }

    /// Frequencies of the lowest and the highest order at the highest speed, Hz.
    pub(super) fn ends(&self) -> [f64; 2] {
        let orders = self.orders();
        let of = |order: Option<&f64>| order.map_or(1.0, |order| *order);
        [orders.first(), orders.last()].map(|order| of(order) * self.budget.speeds[1] / TAU)
    }

    /// How many speeds of the budget, next to one another, are one part of a waterfall.
    fn speeds_per_part(&self) -> usize {
        self.budget.count.div_ceil(WATERFALL_PARTS).max(1)
    }

    /// What a waterfall shows, for its caption.
    pub(super) fn drawn_lines(&self) -> String {
        let of_part = match self.speeds_per_part() {
            1 => String::new(),
            several => {
                format!(", of each tone the largest of {several} speeds next to one another")
            }
        };
        format!(
            "lines over the speed{of_part}, without those below {} of the largest of all; the area of a dot is \
             proportional to the square root of its amplitude. Straight lines are orders.",
            short(DOT_MIN * DOT_MIN, 1)
        )
    }

    /// The larger lines of a line of sight over the speed.
    pub(super) fn waterfall(&self, sight: usize) -> Plane {
        let outputs = outputs_of(sight);
        let mut dots = Vec::new();
        let [from, to] = self.budget.speeds;
        // Whole numbers of speeds are a part, each speed in the middle of its share: parts of another length would hold now one
        // speed and now two, and leave regular gaps in a straight line.
        let per_part = float(self.speeds_per_part());
        let steps = float(self.budget.count.saturating_sub(1));
        let part = |speed: f64| ((steps * (speed - from) / (to - from) + 0.5) / per_part).floor();
        let all: Vec<_> = self.sweep.speeds.iter().zip(&self.sweep.lines).collect();
        for near in all.chunk_by(|a, b| part(*a.0) == part(*b.0)) {
            for contributor in 0..self.sweep.contributors.len() {
                let dot = |(speed, lines): &(&f64, &Vec<Line>)| {
                    let line = lines.get(contributor)?;
                    let values = outputs.iter().filter_map(|output| line.values.get(*output));
                    let size = values.map(Complex::norm_sqr).sum::<f64>().sqrt();
                    Some([*speed * RPM, line.frequency / TAU, size])
                };
                let found = near.iter().filter_map(dot);
                dots.extend(found.max_by(|a, b| a[2].total_cmp(&b[2])));
            }
        }
        let largest = dots.iter().map(|dot| dot[2]).fold(f64::MIN_POSITIVE, f64::max);
        for dot in &mut dots {
            dot[2] = (dot[2] / largest).sqrt();
        }
        dots.retain(|dot| dot[2] > DOT_MIN);
        // That of the limits, if there are any.
        let limited = self.assessed.iter().find(|of| of.sight == sight);
        let (unit, size) = limited.map_or_else(
            || {
                let unit = for_peak(SMALL_ANGLE, largest);
                (unit.name.to_owned(), unit.per_si.recip())
            },
            |of| scaled((&of.limit.unit.0, of.limit.unit.1), std::iter::once(largest)),
        );
        let name = self.budget.sights.get(sight).map_or("", |sight| sight.name.as_str());
        let amplitude = with_unit(largest / size, 3, &unit);
        Plane {
            description: format!(
                "Waterfall of {name}: lines over speed in rpm and frequency in Hz; the largest amplitude is {amplitude}."
            ),
            title: format!("{name}: lines, largest {amplitude}"),
            axes: ["Speed (rpm)".to_owned(), "Frequency f (Hz)".to_owned()],
            curves: Vec::new(),
            lines: self.order_lines(),
            dots,
            marks: Vec::new(),
            large: true,
            logarithmic: false,
            ranges: [
                Some(self.budget.speeds.map(|speed| speed * RPM)),
                Some([0.0, 1.06 * self.ends()[1]]),
            ],
        }
    }
}
