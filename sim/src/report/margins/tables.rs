//! The tables of a [`MarginsReport`].

use std::f64::consts::TAU;

use precess_control::AtFrequency;

use super::super::blocks::{Block, table};
use super::super::number::{short, with_unit};
use super::super::unit::{SMALL_ANGLE, for_peak};
use super::{MarginsReport, decibels};
use crate::margins::analysis::AXES;
use crate::margins::lines::ClosedLine;
use crate::scenario::LoopMargin;

/// Lines and poles that a table shows.
const ROWS_MAX: usize = 40;

/// A number at a frequency.
fn at(of: Option<AtFrequency>, number: impl Fn(f64) -> String) -> String {
    let text = |of: AtFrequency| format!("{} at {} Hz", number(of.value), short(of.omega / TAU, 4));
    of.map_or_else(|| "any".to_owned(), text)
}

/// In decibels.
fn level(value: f64) -> String {
    format!("{} dB", short(decibels(value), 4))
}

/// A margin in its unit.
pub(crate) fn margin(of: LoopMargin, value: f64) -> String {
    match of {
        LoopMargin::Gain => format!("{} dB", short(value, 4)),
        LoopMargin::Phase => format!("{} deg", short(value.to_degrees(), 4)),
        LoopMargin::Delay => format!("{} ms", short(1e3 * value, 4)),
    }
}

/// An angle with a unit of its size.
fn angle(value: f64) -> String {
    let unit = for_peak(SMALL_ANGLE, value);
    with_unit(value * unit.per_si, 3, unit.name)
}

impl MarginsReport<'_> {
    pub(super) fn margins(&self) -> Block {
        let columns = [
            ("Axis", ""),
            ("State", ""),
            ("Gain up", ""),
            ("Gain down", ""),
            ("Phase", ""),
            ("Largest |S|", ""),
            ("Largest |T|", ""),
        ];
        let states = self.states();
        let axes = self.analysis.axes.iter().flatten().zip(AXES).zip(&states);
        let complementary = self.analysis.complementary.iter().flatten();
        let rows = axes.zip(complementary).map(|(((of, axis), states), t)| {
            let state = states.iter().find(|state| state.is_violated()).or(states.first());
            let word = state.map_or("", |state| state.word());
            let phase = |value: f64| format!("{} deg", short(value.to_degrees(), 4));
            let cells = vec![
                axis.to_owned(),
                word.to_owned(),
                at(of.gain_up, level),
                at(of.gain_down, level),
                at(of.phase, phase),
                at(Some(of.sensitivity), level),
                at(Some(*t), level),
            ];
            (word, cells)
        });
        table("Margins of each axis of B, the others closed", &columns, 2..7, rows)
    }

    pub(super) fn whole(&self) -> Block {
        let mut rows = Vec::new();
        if let Some([s, t]) = self.analysis.peaks {
            rows.push(("", vec!["Largest singular value of S".to_owned(), at(Some(s), level)]));
            rows.push(("", vec!["Largest singular value of T".to_owned(), at(Some(t), level)]));
        }
        let delay = match (self.analysis.stable, self.analysis.delay) {
            (false, _) => "none".to_owned(),
            (true, None) => "more than 32 samples".to_owned(),
            (true, Some(delay)) => format!(
                "{} ms beyond {} ms",
                short(1e3 * delay, 4),
                short(1e3 * self.controller.delay, 4)
            ),
        };
        rows.push(("", vec!["Delay margin".to_owned(), delay]));
        table("The loop as a whole", &[("What", ""), ("Value", "")], 1..2, rows)
    }

    /// The scenario's requirements on the margins.
    pub(super) fn requirement_table(&self) -> Vec<Block> {
        if self.verdicts.is_empty() {
            return Vec::new();
        }
        let rows = self.verdicts.iter().map(|of| {
            let value = |value: f64| margin(of.requirement.margin, value);
            let cells = vec![
                of.requirement.name.clone(),
                of.requirement.margin.word().to_owned(),
                of.found.map_or_else(|| "any".to_owned(), value),
                of.requirement.written.clone(),
                of.state.word().to_owned(),
            ];
            (of.state.word(), cells)
        });
        let columns =
            [("Requirement", ""), ("Margin", ""), ("Found", ""), ("At least", ""), ("State", "")];
        vec![table("Requirements on the margins", &columns, 2..4, rows)]
    }

    pub(super) fn poles(&self) -> Vec<Block> {
        let name = |number: usize| {
            self.analysis.oscillations.get(number).map_or_else(String::new, |of| {
                let name = if of.name.is_empty() { "oscillation" } else { &of.name };
                format!("{name}, {} Hz", short(of.frequency, 5))
            })
        };
        let poles = self.analysis.poles.iter().take(ROWS_MAX).map(|of| {
            let z = format!("{} {} j", short(of.z.re, 5), short(of.z.im, 5));
            let cells = vec![
                short(of.frequency, 5),
                short(of.damping, 4),
                z.replacen(' ', " + ", 1),
                of.oscillation.map_or_else(String::new, name),
            ];
            ("", cells)
        });
        let columns =
            [("Frequency", "Hz"), ("Damping ratio", ""), ("z", ""), ("Of the spacecraft", "")];
        let mut blocks = vec![
            table("Poles of the closed loop", &columns, 0..3, poles),
            Block::Note {
                text: format!(
                    "{} more are at 1: what the loop does not act on, momentum and rates of wheels. Frequencies are those that the samples show.",
                    self.analysis.neutral
                ),
            },
        ];
        if !self.analysis.oscillations.is_empty() {
            let rows = self.analysis.oscillations.iter().take(ROWS_MAX).map(|of| {
                let cells = vec![
                    of.name.clone(),
                    short(of.frequency, 5),
                    short(of.damping, 4),
                    if of.alias < of.frequency * 0.999 {
                        format!("aliased to {}", short(of.alias, 4))
                    } else {
                        short(of.alias, 4)
                    },
                ];
                ("", cells)
            });
            let columns = [
                ("Moves", ""),
                ("Frequency", "Hz"),
                ("Damping ratio", ""),
                ("In the samples", "Hz"),
            ];
            let caption =
                "Oscillations of the spacecraft with motors held: modes, whirls, nutation";
            blocks.push(table(caption, &columns, 1..4, rows));
        }
        blocks
    }

    pub(super) fn line_tables(&self) -> Vec<Block> {
        let mut sorted: Vec<&ClosedLine> = self.lines.iter().collect();
        let size = |of: &ClosedLine| of.attitude_rms().iter().map(|v| v * v).sum::<f64>().sqrt();
        let held = |of: &ClosedLine| of.held_rms().iter().map(|v| v * v).sum::<f64>().sqrt();
        sorted.sort_by(|a, b| size(b).total_cmp(&size(a)));
        if sorted.is_empty() {
            return Vec::new();
        }
        let rows = sorted.iter().take(ROWS_MAX).map(|of| {
            let seen = if of.is_constant() {
                "constant".to_owned()
            } else if of.is_aliased() {
                format!("aliased to {}", short(of.alias, 4))
            } else {
                short(of.alias, 4)
            };
            let at_alias = of.components.get(1).filter(|_| of.is_aliased());
            let at_alias = at_alias.map_or_else(String::new, |component| {
                let sum: f64 = component.attitude.iter().map(nalgebra::Complex::norm_sqr).sum();
                angle((0.5 * sum).sqrt())
            });
            let cells = vec![
                of.rotor.clone(),
                format!("{}, order {}", of.cause, short(of.order, 5)),
                short(of.frequency, 5),
                seen,
                angle(held(of)),
                angle(size(of)),
                at_alias,
            ];
            ("", cells)
        });
        let columns = [
            ("Rotor", ""),
            ("Cause", ""),
            ("Frequency", "Hz"),
            ("In the samples", "Hz"),
            ("RMS rotation, motors held", ""),
            ("RMS rotation, loop closed", ""),
            ("of it at the alias", ""),
        ];
        let caption = "Rotation of the hub by each line, root of the sum of squares of the axes";
        let note = "A line above half the rate of the samples appears to the controller at its alias, and what it commands moves the hub there.";
        vec![table(caption, &columns, 2..7, rows), Block::Note { text: note.to_owned() }]
    }

    pub(super) fn noise_tables(&self) -> Vec<Block> {
        let Some(gains) = self.noise else { return Vec::new() };
        let norm = |row: &[f64; 3]| row.iter().map(|v| v * v).sum::<f64>().sqrt();
        let measured = gains.attitude_rms(&self.measured);
        let rows = AXES.iter().enumerate().map(|(axis, name)| {
            let own = |of: &[[f64; 3]; 3]| of.get(axis).map_or(0.0, norm);
            let cells = vec![
                (*name).to_owned(),
                short(own(&gains.attitude), 4),
                short(own(&gains.rate), 4),
                measured.get(axis).map_or_else(String::new, |rms| angle(*rms)),
            ];
            ("", cells)
        });
        let columns = [
            ("Axis", ""),
            ("By noise of the rotation", ""),
            ("By noise of the rate", "s"),
            ("RMS rotation by this noise", ""),
        ];
        let text = format!(
            "White noise of the readings, independent from sample to sample: RMS rotation of the hub at the samples per standard deviation. Here: {} of the rotation about x, y and z, {} rad/s of the rate.",
            self.measured.attitude_deviations().map(angle).join(", "),
            short(self.measured.rate, 3)
        );
        vec![table("What noise does", &columns, 1..4, rows), Block::Note { text }]
    }
}
