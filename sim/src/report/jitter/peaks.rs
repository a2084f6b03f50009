//! What bounds the peak beside the RMS in a [`JitterReport`]: the sum of the amplitudes of all tones.

use super::super::blocks::{Block, table};
use super::super::number::with_unit;
use super::{JitterReport, worst_speed};
use crate::jitter::budget::{Assessed, is_flat, outputs_of, worst_of};
use crate::jitter::model::Line;
use crate::jitter::weight::Weight;
use crate::pointing::Metric;

impl JitterReport<'_> {
    /// The bound at a speed: both axes of a tone go through `sqrt(|x|^2 + |y|^2)` at most.
    fn peak(of: &Assessed, weight: &Weight, lines: &[Line]) -> f64 {
        let outputs = outputs_of(of.sight);
        let amplitude = |line: &Line| {
            let values = outputs.iter().filter_map(|output| line.values.get(*output));
            (values.map(nalgebra::Complex::norm_sqr).sum::<f64>() * weight.at(line.frequency))
                .sqrt()
        };
        lines.iter().map(amplitude).sum()
    }

    /// A row for each limit on an RMS, of all tones or of those in a band; nothing without one.
    pub(super) fn peaks(&self) -> Vec<Block> {
        let of_rms = self.assessed.iter().filter(|of| {
            matches!(of.limit.metric, Metric::Rms | Metric::BandRms(_)) && of.no_data.is_none()
        });
        let rows: Vec<_> = of_rms
            .filter_map(|of| {
                let weight = Weight::of_metric(&of.limit.metric).ok()?;
                let (unit, size) = &of.limit.unit;
                let peaks = self.sweep.lines.iter().map(|lines| Self::peak(of, &weight, lines));
                let all: Vec<f64> = peaks.collect();
                let at = worst_of(&all);
                let largest = all.get(at).copied()?;
                let there = all.get(of.worst).copied()?;
                let speed = |index, is_flat| worst_speed(&self.sweep.speeds, index, is_flat);
                let cells = vec![
                    of.limit.name.clone(),
                    with_unit(of.margin.value / size, 4, unit),
                    with_unit(there / size, 4, unit),
                    speed(of.worst, of.is_flat()),
                    with_unit(largest / size, 4, unit),
                    speed(at, is_flat(&all)),
                ];
                Some(("", cells))
            })
            .collect();
        if rows.is_empty() {
            return Vec::new();
        }
        let columns = [
            ("Requirement", ""),
            ("RMS", ""),
            ("Peak, at most", ""),
            ("At", ""),
            ("Largest bound of all speeds", ""),
            ("At", ""),
        ];
        let text = "The peak of both axes together is at most the sum of the amplitudes of the tones, which is reached where \
                    all are in phase. Broadband noise has no largest value and is not in it. A run has the peak itself.";
        vec![
            table("Bound of the peak beside the RMS", &columns, 1..6, rows),
            Block::Note { text: text.to_owned() },
        ]
    }
}
