//! Requirements: `[[requirement]]`, on what is recorded and on margins of a loop.

use std::fmt::Write as _;

use super::{Written, quoted};
use crate::pointing::Index;
use crate::scenario::{Scenario, Statistic};

pub(super) fn requirements(out: &mut String, s: &Scenario) -> Written {
    for requirement in &s.requirements {
        writeln!(out, "\n[[requirement]]\nname = {}", quoted(&requirement.name))?;
        writeln!(out, "quantity = {}", quoted(&requirement.quantity))?;
        if let Some((key, n)) = requirement.projection.key() {
            writeln!(out, "{key} = [{:?}, {:?}, {:?}]", n.x, n.y, n.z)?;
        }
        let statistic = match requirement.statistic {
            Statistic::Peak => "\"peak\"".to_owned(),
            Statistic::Rms => "\"rms\"".to_owned(),
            Statistic::BandRms([from, to]) => {
                format!("\"band_rms\"\nband = \"{from:?}, {to:?} Hz\"")
            }
            Statistic::Final => "\"final\"".to_owned(),
            Statistic::Drift => "\"drift\"".to_owned(),
            Statistic::Displacement(time) => format!("\"displacement\"\nexposure = \"{time:?} s\""),
            Statistic::Smear(time) => format!("\"smear\"\nexposure = \"{time:?} s\""),
            Statistic::Jitter(time) => format!("\"jitter\"\nexposure = \"{time:?} s\""),
            Statistic::Index { index, level } => {
                let mut text =
                    format!("{}\nlevel = {level:?}", quoted(&index.name().to_lowercase()));
                if let Some(window) = index.window() {
                    let _ = write!(text, "\nwindow = \"{window:?} s\"");
                }
                if let Index::Pde { stability, .. } = index {
                    let _ = write!(text, "\nstability = \"{stability:?} s\"");
                }
                text
            }
        };
        writeln!(out, "statistic = {statistic}")?;
        let [from, to] = requirement.window;
        writeln!(out, "from = \"{from:?} s\"\nto = \"{to:?} s\"")?;
        writeln!(out, "limit = {}", quoted(&requirement.written))?;
    }
    for of in &s.margin_requirements {
        writeln!(out, "\n[[requirement]]\nname = {}", quoted(&of.name))?;
        writeln!(out, "controller = {}", quoted(&of.controller))?;
        writeln!(out, "margin = {}", quoted(of.margin.word()))?;
        writeln!(out, "least = {}", quoted(&of.written))?;
    }
    Ok(())
}
