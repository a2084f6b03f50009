//! `[[source]]` as text: every phase and value, in SI units; a long record by the name of its file.

use std::fmt::Write as _;

use super::{Written, joint_name, mount, quoted, structure, vector};
use crate::disturbance::{
    Broadband, COMPONENTS, Disturbance, Harmonic, JointAxes, Measured, MeasuredInterpolation,
    Model, Six, SourceTarget,
};
use crate::scenario::Scenario;

/// The table of a source.
pub(super) fn write(out: &mut String, s: &Scenario, of: &Disturbance) -> Written {
    let on = match of.on {
        SourceTarget::Mount(member) => s.names.get(member).cloned().unwrap_or_default(),
        SourceTarget::Hub { .. } => "hub".to_owned(),
        SourceTarget::Node { node, .. } => structure::node_name(s, node).to_owned(),
        SourceTarget::Joint { joint, .. } => joint_name(s, joint),
    };
    writeln!(out, "\n[[source]]\nname = {}\non = {}", quoted(&of.name), quoted(&on))?;
    writeln!(out, "point = {}", vector(&of.point, "m"))?;
    match &of.on {
        SourceTarget::Hub { axes } | SourceTarget::Node { axes, .. } => mount(out, axes)?,
        SourceTarget::Joint { axes, .. } => {
            let word = if *axes == JointAxes::Body { "body" } else { "parent" };
            writeln!(out, "axes = \"{word}\"")?;
        }
        SourceTarget::Mount(_) => {}
    }
    let axis = ["x", "y", "z"].get(of.spin_axis).copied().unwrap_or("x");
    writeln!(out, "spin_axis = \"{axis}\"")?;
    if let Some(wheel) = of.wheel {
        writeln!(out, "wheel = {}", quoted(&joint_name(s, wheel)))?;
    }
    writeln!(out, "fundamental_removed = {}", of.fundamental_removed)?;
    writeln!(out, "modes_removed = {}", of.modes_removed)?;
    if let Some(seed) = of.seed {
        writeln!(out, "seed = {seed}")?;
    }
    for (key, end) in ["from", "to"].into_iter().zip(of.window) {
        if end.is_finite() {
            writeln!(out, "{key} = \"{end:?} s\"")?;
        }
    }
    match &of.model {
        Model::Harmonic(harmonics) => harmonics.iter().try_for_each(|of| harmonic(out, of)),
        Model::Broadband(of) => broadband(out, of),
        Model::Measured(of) => record(out, of),
    }
}

fn harmonic(out: &mut String, of: &Harmonic) -> Written {
    writeln!(out, "\n[[source.harmonic]]\nnumber = {:?}", of.number)?;
    let each = COMPONENTS.iter().zip(of.amplitudes.iter().zip(&of.phases)).zip(0..);
    // One is written in any case: a harmonic has an amplitude.
    let acts = |amplitude: f64, phase: f64| amplitude != 0.0 || phase != 0.0;
    let none = of.amplitudes.iter().zip(&of.phases).all(|(a, p)| !acts(*a, *p));
    for ((component, (amplitude, phase)), index) in each {
        if acts(*amplitude, *phase) || (none && index == 0) {
            let unit = if index < 3 { "kg m" } else { "kg m^2" };
            writeln!(out, "{component} = \"{amplitude:?} {unit}\"")?;
            writeln!(out, "phase.{component} = \"{phase:?} rad\"")?;
        }
    }
    Ok(())
}

fn broadband(out: &mut String, of: &Broadband) -> Written {
    let [from, to] = of.band;
    writeln!(out, "\n[source.broadband]\nband = \"{from:?}, {to:?} Hz\"")?;
    writeln!(out, "period = \"{:?} s\"", of.period)?;
    if !of.frequencies.is_empty() {
        writeln!(out, "frequencies = {}", list(&of.frequencies, "Hz"))?;
    }
    components(out, &of.densities, ["N^2/Hz", "N^2 m^2/Hz"])?;
    if let Some(rate) = of.reference_rate {
        writeln!(out, "reference_rate = \"{rate:?} rad/s\"")?;
    }
    of.pairs.iter().try_for_each(|pair| {
        let [a, b] = pair.components.map(|of| COMPONENTS.get(of).copied().unwrap_or_default());
        writeln!(out, "\n[[source.broadband.coherent]]\nbetween = [\"{a}\", \"{b}\"]")?;
        writeln!(out, "coherence = {}", list(&pair.coherence, ""))?;
        writeln!(out, "phase = {}", list(&pair.phase, "rad"))
    })
}

fn record(out: &mut String, of: &Measured) -> Written {
    writeln!(out, "\n[source.record]")?;
    if let Some(file) = &of.file {
        writeln!(out, "file = {}\ntime = {}", quoted(&file.name), quoted(&file.time))?;
        let [force, moment] = file.units.each_ref().map(|unit| quoted(unit));
        writeln!(out, "force_unit = {force}\nmoment_unit = {moment}")?;
        for (component, column) in COMPONENTS.iter().zip(&file.columns) {
            if let Some(column) = column {
                writeln!(out, "columns.{component} = {}", quoted(column))?;
            }
        }
    } else {
        writeln!(out, "times = {}", list(&of.times, "s"))?;
        components(out, &of.values, ["N", "N m"])?;
    }
    let word = match of.interpolation {
        MeasuredInterpolation::Linear => "linear",
        MeasuredInterpolation::Cubic => "cubic",
    };
    writeln!(out, "interpolation = \"{word}\"\nrepeats = {}", of.repeats)
}

fn components(out: &mut String, of: &Six<Vec<f64>>, units: [&str; 2]) -> Written {
    let mut each = COMPONENTS.iter().zip(of).zip(0..).filter(|((_, values), _)| !values.is_empty());
    each.try_for_each(|((component, values), index)| {
        let unit = if index < 3 { units[0] } else { units[1] };
        writeln!(out, "{component} = {}", list(values, unit))
    })
}

fn list(numbers: &[f64], unit: &str) -> String {
    let numbers: Vec<_> = numbers.iter().map(|number| format!("{number:?}")).collect();
    format!("\"{}\"", format!("{} {unit}", numbers.join(", ")).trim_end())
}
