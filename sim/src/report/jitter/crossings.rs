//! Crossings of orders and natural frequencies in a [`JitterReport`]: the Campbell diagram and its table.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::super::blocks::{Block, table};
use super::super::draw::plane::Plane;
use super::super::error::DrawError;
use super::super::number::short;
use super::{JitterReport, RPM, rpm};
use crate::jitter::budget::outputs_of;
use crate::jitter::campbell::{Branch, Crossing, Oscillation, Whirl};
use crate::jitter::model::Line;
use crate::scenario::ModalStructure;

/// Branches are drawn up to this many times the highest line of an order, and of the highest branch.
const TOP: f64 = 1.25;
const ABOVE: f64 = 1.06;
/// A crossing has a circle from this share of the largest amplitude on.
const CIRCLE_MIN: f64 = 0.1;
/// Natural frequencies that stay below this share of the lowest order at every speed are not drawn.
const FAR_BELOW: f64 = 0.1;
/// A crossing this near to a worst speed is listed first.
const NEAR_WORST: f64 = 0.02;
/// Crossings that the table lists.
const LISTED_MAX: usize = 200;

impl JitterReport<'_> {
    /// Amplitude of a line of sight by the lines of an order at a speed: a mean over unknown phases.
    fn amplitude(&self, outputs: &[usize], lines: &[Line], order: f64) -> f64 {
        let of_order = lines.iter().filter(|line| {
            self.sweep.contributors.get(line.contributor).is_some_and(|of| of.order == order)
        });
        let values = of_order.flat_map(|line| outputs.iter().filter_map(|of| line.values.get(*of)));
        values.map(Complex::norm_sqr).sum::<f64>().sqrt()
    }

    /// Of each crossing the amplitude of the lines of its order there, by the largest of all orders and speeds; of several
    /// lines of sight the largest share.
    fn shares(&self) -> Vec<f64> {
        let mut shares = vec![0.0_f64; self.crossings.len()];
        let orders = self.orders();
        for sight in 0..self.budget.sights.len() {
            let outputs = outputs_of(sight);
            let each = self
                .sweep
                .lines
                .iter()
                .flat_map(|lines| orders.iter().map(move |order| (lines, *order)));
            let largest = each
                .map(|(lines, order)| self.amplitude(&outputs, lines, order))
                .fold(f64::MIN_POSITIVE, f64::max);
            for (share, of) in shares.iter_mut().zip(self.crossings) {
                let apart = |speed: &f64| (speed - of.speed).abs();
                let speeds = self.sweep.speeds.iter().enumerate();
                let nearest = speeds.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
                let Some(lines) = nearest.and_then(|(at, _)| self.sweep.lines.get(at)) else {
                    continue;
                };
                *share = share.max(self.amplitude(&outputs, lines, of.order) / largest);
            }
        }
        shares
    }

    /// Why no Campbell diagram is drawn: no natural frequency is near an order. None where one is.
    fn far_below(&self) -> Option<String> {
        let lowest = self.orders().first().copied()?;
        let mut highest = 0.0_f64;
        let mut share = 0.0_f64;
        for branch in self.branches {
            for (speed, of) in self.campbell_speeds.iter().zip(&branch.points) {
                let frequency = of.map_or(0.0, |of| of.frequency);
                highest = highest.max(frequency);
                share = share.max(frequency / (lowest * speed));
            }
        }
        if share >= FAR_BELOW {
            return None;
        }
        let none = "No Campbell diagram is drawn, since no order can meet a natural frequency: "
            .to_owned();
        let reason = if highest > 0.0 {
            format!(
                "the highest, {} Hz, is a slow motion of the whole spacecraft and stays below {} % of the lowest order at \
                 every speed.",
                short(highest / TAU, 3),
                short(100.0 * FAR_BELOW, 2)
            )
        } else {
            "hub and devices are rigid, and have none.".to_owned()
        };
        Some(none + &reason)
    }

    /// The Campbell diagram; none where no natural frequency is near an order.
    pub(super) fn campbell_diagram(&self) -> Option<Plane> {
        if self.far_below().is_some() {
            return None;
        }
        let curve = |branch: &Branch| {
            let points = self.campbell_speeds.iter().zip(&branch.points);
            let point = |(speed, of): (&f64, &Option<Oscillation>)| {
                [speed * RPM, of.map_or(f64::NAN, |of| of.frequency / TAU)]
            };
            points.map(point).collect::<Vec<_>>()
        };
        let mut curves: Vec<Vec<[f64; 2]>> = self.branches.iter().map(curve).collect();
        let all = curves.iter().flatten().map(|point| point[1]);
        let highest = all.filter(|value| value.is_finite()).fold(0.0, f64::max);
        // The lowest order is within the picture where all natural frequencies are below it.
        let [lowest, top] = self.ends().map(|order| TOP * order);
        let top = top.min(ABOVE * highest).max(lowest);
        curves.retain(|points| points.iter().any(|point| point[1] <= top));
        let shares = self.shares();
        let mut circled: Vec<(&f64, &Crossing)> = shares.iter().zip(self.crossings).collect();
        circled.retain(|(share, _)| **share >= CIRCLE_MIN);
        circled.sort_by(|a, b| b.0.total_cmp(a.0));
        Some(Plane {
            description:
                "Campbell diagram: natural frequencies in Hz over the speed in rpm, with orders."
                    .to_owned(),
            title: "Natural frequencies over the speed".to_owned(),
            axes: ["Speed (rpm)".to_owned(), "Frequency f (Hz)".to_owned()],
            // Without a legend: a branch has no name of its own.
            curves: curves.into_iter().map(|points| (String::new(), points)).collect(),
            lines: self.order_lines(),
            dots: Vec::new(),
            marks: circled
                .iter()
                .map(|(_, of)| [of.speed * RPM, of.oscillation.frequency / TAU])
                .collect(),
            large: true,
            logarithmic: false,
            ranges: [Some(self.budget.speeds.map(|speed| speed * RPM)), Some([0.0, top])],
        })
    }

    pub(super) fn campbell(&self) -> Result<Vec<Block>, DrawError> {
        if let Some(text) = self.far_below() {
            return Ok(vec![Block::Text { text }]);
        }
        let Some(diagram) = self.campbell_diagram() else { return Ok(Vec::new()) };
        let shares = self.shares();
        let circled = shares.iter().filter(|share| **share >= CIRCLE_MIN).count();
        let circles = format!(
            " Circles: crossings at which the lines of the order have {} % or more of the largest amplitude, {circled} of {}; of \
             circles that would overlap that of the largest lines is drawn. The table lists all crossings.",
            short(100.0 * CIRCLE_MIN, 2),
            shares.len()
        );
        let mut blocks = vec![Block::Figure {
            id: "figure-campbell".to_owned(),
            number: "K".to_owned(),
            caption: format!(
                "Natural frequencies of structure and devices over the speed (curves), with orders (straight lines, labelled).{}",
                if shares.is_empty() { "" } else { &circles }
            ),
            svg: diagram.inline()?,
            charts: Vec::new(),
        }];
        if self.crossings.is_empty() {
            let text = "No order crosses a natural frequency within the speeds.".to_owned();
            blocks.push(Block::Text { text });
            return Ok(blocks);
        }
        // Those of the worst speeds first, then by the amplitude there.
        let worst: Vec<f64> = self
            .assessed
            .iter()
            .filter_map(|of| self.sweep.speeds.get(of.worst).copied())
            .collect();
        let far =
            |of: &Crossing| !worst.iter().any(|speed| (of.speed / speed - 1.0).abs() < NEAR_WORST);
        let mut ranked: Vec<(&f64, &Crossing)> = shares.iter().zip(self.crossings).collect();
        ranked.sort_by(|a, b| far(a.1).cmp(&far(b.1)).then(b.0.total_cmp(a.0)));
        let rows = ranked.into_iter().take(LISTED_MAX).map(|(share, of)| {
            let whirl = match of.whirl {
                Whirl::Forward => "forward whirl",
                Whirl::Backward => "backward whirl",
                Whirl::None => "mode",
            };
            let cells = vec![
                rpm(of.speed),
                short(of.order, 6),
                format!("{} Hz", short(of.oscillation.frequency / TAU, 5)),
                format!("{} %", short(100.0 * of.oscillation.damping, 3)),
                format!("{} %", short(100.0 * share, 3)),
                format!("{whirl}, {}", self.mode_of(of)),
            ];
            ("", cells)
        });
        let columns = [
            ("Speed", ""),
            ("Order", ""),
            ("Frequency", ""),
            ("Damping ratio", ""),
            ("Amplitude by the largest", ""),
            ("Branch", ""),
        ];
        blocks.push(table(
            "Orders that cross natural frequencies, those at the worst speeds first",
            &columns,
            1..5,
            rows,
        ));
        if self.crossings.len() > LISTED_MAX {
            let text =
                format!("{} more crossings are not listed.", self.crossings.len() - LISTED_MAX);
            blocks.push(Block::Note { text });
        }
        Ok(blocks)
    }

    /// The mode of the structure that a branch comes from: in order of frequency where there are as many branches as
    /// modes; otherwise the nearest, which may be another's.
    fn mode_of(&self, of: &Crossing) -> String {
        let modes = self.scenario.structure.as_ref().map_or(&[][..], ModalStructure::massive);
        let mut modes: Vec<_> = modes.iter().map(|mode| mode.frequency).enumerate().collect();
        modes.sort_by(|a, b| a.1.total_cmp(&b.1));
        let at = self.campbell_speeds.iter().position(|speed| *speed >= of.speed).unwrap_or(0);
        let frequency = |branch: &Branch| Some((*branch.points.get(at)?)?.frequency);
        let all: Vec<_> = self.branches.iter().filter_map(frequency).collect();
        let own = self.branches.get(of.branch).and_then(frequency);
        let rank = own.filter(|_| all.len() == modes.len());
        let rank = rank.map(|own| all.iter().filter(|other| **other < own).count());
        let apart = |frequency: f64| (frequency / of.oscillation.frequency - 1.0).abs();
        let nearest = || modes.iter().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
        let (word, found) = match rank {
            Some(rank) => ("of", modes.get(rank)),
            None => ("near", nearest()),
        };
        found.map_or_else(
            || "no mode of the structure".to_owned(),
            |(k, frequency)| {
                format!("{word} mode {} ({} Hz by itself)", k + 1, short(frequency / TAU, 4))
            },
        )
    }
}
