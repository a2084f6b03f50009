//! The tables that `jitter` writes, CSV.

use std::fmt::Write as _;

use super::JitterResults;
use crate::jitter::budget::Budget;
use crate::jitter::keep_out::{KEEP_OUT_COLUMNS, union};
use crate::jitter::sweep::Sweep;
use crate::names::column_heads;

/// A row for each speed and tone: amplitude and phase of each output.
pub(super) fn lines_csv(sweep: &Sweep) -> String {
    let mut text = String::from("speed_rad_per_s,rotor,cause,order,frequency_hz");
    for name in column_heads(&sweep.outputs) {
        let _ = write!(text, ",{name}_re,{name}_im");
    }
    text.push('\n');
    let mut digits = zmij::Buffer::new();
    for (speed, lines) in sweep.speeds.iter().zip(&sweep.lines) {
        for line in lines {
            let Some(of) = sweep.contributors.get(line.contributor) else { continue };
            text.push_str(digits.format(*speed));
            let _ = write!(text, ",{},{}", of.rotor, of.cause.replace(',', " "));
            for value in [of.order, line.frequency / std::f64::consts::TAU] {
                text.push(',');
                text.push_str(digits.format(value));
            }
            for part in line.values.iter().flat_map(|value| [value.re, value.im]) {
                text.push(',');
                text.push_str(digits.format(part));
            }
            text.push('\n');
        }
    }
    text
}

/// A row for each band of speeds in which a requirement is violated, all requirements together: what
/// `allocation.keep_out` of a controller reads.
pub(super) fn keep_out_csv(found: &JitterResults) -> String {
    let [lower, upper] = KEEP_OUT_COLUMNS;
    let mut text = format!("{lower},{upper}\n");
    let mut digits = zmij::Buffer::new();
    for [from, to] in union(found.assessed.iter().flat_map(|of| of.keep_out.iter().copied())) {
        text.push_str(digits.format(from));
        text.push(',');
        text.push_str(digits.format(to));
        text.push('\n');
    }
    text
}

/// A row for each speed: the metric of each requirement, SI.
pub(super) fn requirements_csv(found: &JitterResults) -> String {
    let mut text = String::from("speed_rad_per_s");
    for name in column_heads(found.assessed.iter().map(|of| &of.limit.name)) {
        let _ = write!(text, ",{name}");
    }
    text.push('\n');
    let mut digits = zmij::Buffer::new();
    for (index, speed) in found.sweep.speeds.iter().enumerate() {
        text.push_str(digits.format(*speed));
        for of in &found.assessed {
            text.push(',');
            text.push_str(digits.format(of.values.get(index).copied().unwrap_or(f64::NAN)));
        }
        text.push('\n');
    }
    text
}

/// A row for each requirement and assumption about phases, with each rotor at its own speed: state, metric and limit, SI; no
/// number of what is not evaluated.
pub(super) fn own_speeds_csv(budget: &Budget, found: &JitterResults) -> String {
    let mut text = String::from("requirement,phases,state,value,limit\n");
    let mut digits = zmij::Buffer::new();
    let names = column_heads(budget.limits.iter().map(|(_, limit)| &limit.name));
    for (name, of) in names.iter().zip(found.own()) {
        for (phases, margin) in &of.by_phases {
            let state = of.state(margin);
            let _ = write!(text, "{name},{},{},", phases.word(), state.word());
            if state.reason().is_none() {
                text.push_str(digits.format(margin.value));
            }
            text.push(',');
            text.push_str(digits.format(margin.limit));
            text.push('\n');
        }
    }
    text
}
