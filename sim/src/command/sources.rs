//! The sources of a scenario as rows of `check`: what each acts on, and what it exerts.

use super::table::{aligned, six};
use crate::disturbance::{Broadband, Disturbance, Model, SourceTarget};
use crate::scenario::{Scenario, joint_key};

/// A row for each source; nothing without one.
pub(super) fn sources(scenario: &Scenario) -> String {
    let heads = ["source", "acts on", "exerts", "seed"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for of in &scenario.disturbances {
        rows.push(vec![
            of.name.clone(),
            place(scenario, of),
            exerts(scenario, of),
            of.seed.map_or_else(String::new, |seed| seed.to_string()),
        ]);
    }
    if rows.len() > 1 { format!("\n{}", aligned(&rows)) } else { String::new() }
}

fn place(scenario: &Scenario, of: &Disturbance) -> String {
    match of.on {
        SourceTarget::Mount(member) => {
            format!("the mount of {}", scenario.names.get(member).map_or("", String::as_str))
        }
        SourceTarget::Hub { .. } => "the hub".to_owned(),
        SourceTarget::Node { node, .. } => {
            let nodes = scenario.structure.as_ref().map(|structure| &structure.nodes);
            let node = nodes.and_then(|nodes| nodes.get(node));
            format!("node {}", node.map_or("", |node| node.name.as_str()))
        }
        SourceTarget::Joint { joint, .. } => joint_name(scenario, joint),
    }
}

fn joint_name(scenario: &Scenario, joint: usize) -> String {
    let found = scenario.joints().nth(joint);
    found.map_or_else(String::new, |(_, name, info)| format!("{name}.{}", joint_key(info)))
}

fn exerts(scenario: &Scenario, of: &Disturbance) -> String {
    let rate = of.wheel.and_then(|wheel| scenario.mean_joints().nth(wheel));
    match &of.model {
        Model::Harmonic(tones) => {
            let [_, rate] = rate.unwrap_or_default();
            let highest = of.model.highest_frequency(rate);
            let wheel = of.wheel.map_or_else(String::new, |wheel| joint_name(scenario, wheel));
            format!("{} harmonics of {wheel}, up to {} Hz at the start", tones.len(), six(highest))
        }
        Model::Broadband(noise) => {
            let [force, moment] = root_mean_squares(noise);
            let [from, to] = noise.band.map(six);
            format!(
                "noise from {from} Hz to {to} Hz, RMS {} N, {} N m, repeated after {} s",
                six(force),
                six(moment),
                six(noise.period)
            )
        }
        Model::Measured(record) => {
            let [first, last] = [record.times.first(), record.times.last()]
                .map(|time| six(time.copied().unwrap_or(0.0)));
            let again = if record.repeats { ", repeated" } else { "" };
            format!("{} rows from {first} s to {last} s{again}", record.times.len())
        }
    }
}

/// Of the magnitude of the force, N, and of the moment, N m: the sum of `S / T` over lines and
/// components, at the reference rate.
fn root_mean_squares(noise: &Broadband) -> [f64; 2] {
    let square = |component: usize| -> f64 {
        let lines = noise.lines(component, 0, "");
        lines.iter().map(|line| 0.5 * line.amplitude * line.amplitude).sum()
    };
    [0, 3].map(|from| (from..from + 3).map(square).sum::<f64>().sqrt())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::file::from_toml;

    #[test]
    fn each_source_has_a_row() {
        let text = include_str!("../../../scenarios/wheel-data-sheet.toml");
        let (scenario, _) = from_toml("sheet", text, Path::new("")).expect("a scenario");
        let shown = sources(&scenario);
        for part in [
            "bearing  the mount of rw ",
            "3 harmonics of rw.wheel, up to 259 Hz at the start",
            "noise from 5 Hz to 400 Hz, RMS ",
            "repeated after 2 s",
        ] {
            assert!(shown.contains(part), "{part}:\n{shown}");
        }
        // Noise of 5 to 400 Hz in 0.5 Hz: the axial force by itself has 791 lines of 1e-10 N².
        let noise = scenario.disturbances.iter().find_map(|of| match &of.model {
            Model::Broadband(noise) => Some(noise.clone()),
            _ => None,
        });
        let mut noise = noise.expect("noise");
        noise.densities[0].clear();
        noise.densities[1].clear();
        let [force, _] = root_mean_squares(&noise);
        assert!((force / (791.0 * 1e-10_f64).sqrt() - 1.0).abs() < 1e-12, "{force}");
    }
}
