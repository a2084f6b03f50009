//! The inputs of a [`JitterReport`]: rotors, other joints, sources, modes and lines of sight with their numbers.

use std::f64::consts::TAU;

use precess_dynamics::kind::{BodyParameters, JointInfo};
use precess_dynamics::{Imbalance, units};

use super::super::blocks::{Block, table};
use super::super::number::short;
use super::{JitterReport, rpm};
use crate::disturbance::{Broadband, COMPONENTS, Disturbance, Harmonic, Model, SourceTarget};
use crate::scenario::mass::imbalance;
use crate::scenario::{Drive, Member, ModalStructure, joint_key};

/// Rows of a table, at most.
const ROWS_MAX: usize = 100;

/// The rows of a table; what is left out is a row.
type Rows = Vec<(&'static str, Vec<String>)>;

fn inputs_table(
    caption: &str,
    columns: &[&str],
    numbers: std::ops::Range<usize>,
    mut rows: Rows,
) -> Option<Block> {
    if rows.is_empty() {
        return None;
    }
    let left_out = rows.len().saturating_sub(ROWS_MAX);
    rows.truncate(ROWS_MAX);
    if left_out > 0 {
        let mut cells = vec![String::new(); columns.len()];
        if let Some(first) = cells.first_mut() {
            *first = format!("{left_out} more are in the scenario");
        }
        rows.push(("", cells));
    }
    let columns: Vec<_> = columns.iter().map(|title| (*title, "")).collect();
    Some(table(caption, &columns, numbers, rows))
}

fn degrees(angle: f64) -> String {
    format!("{}°", short(units::to_deg(angle), 5))
}

/// Moments of inertia of a body about its centre of mass, along its axes.
fn moments(body: &BodyParameters<f64>, first: usize) -> [String; 3] {
    [0, 1, 2].map(|step| short(body.inertia[((first + step) % 3, (first + step) % 3)], 5))
}

/// Those of a rotor, about its spin axis and across it; of equal ones across it one.
fn moments_of_rotor(body: &BodyParameters<f64>, axis: usize) -> String {
    let [about, across, other] = moments(body, axis);
    if across == other { format!("{about}, {across}") } else { [about, across, other].join(", ") }
}

impl JitterReport<'_> {
    pub(super) fn inputs(&self) -> Vec<Block> {
        let all = [
            self.rotors(),
            self.other_joints(),
            self.tones(),
            self.noises(),
            self.other_sources(),
            self.hub(),
            self.mode_table(),
            self.sights(),
        ];
        all.into_iter().flatten().collect()
    }

    /// Each joint with its member and body, its state, and its number.
    fn each_joint(
        &self,
    ) -> impl Iterator<Item = (usize, &str, Member<'_>, &'static JointInfo, BodyParameters<f64>, [f64; 2])>
    {
        let mut states = self.scenario.mean_joints();
        let members = self.scenario.members();
        let joints = members.flat_map(|(name, member)| {
            let bodies = member.bodies().into_iter();
            member.joints().iter().zip(bodies).map(move |(info, body)| (name, member, info, body))
        });
        joints.enumerate().map(move |(joint, (name, member, info, body))| {
            (joint, name, member, info, body, states.next().unwrap_or_default())
        })
    }

    fn rotors(&self) -> Option<Block> {
        let rows = self.each_joint().filter(|(.., info, _, _)| info.body == "wheel");
        let row = |(_, name, member, info, body, [angle, rate]): (
            usize,
            &str,
            Member<'_>,
            &JointInfo,
            BodyParameters<f64>,
            [f64; 2],
        )| {
            let rotor = format!("{name}.{}", info.body);
            let swept = self.budget.swept.is_empty() || self.budget.swept.contains(&rotor);
            let speed = match (rate == 0.0, swept) {
                (true, _) => "at rest".to_owned(),
                (false, true) if rate > 0.0 => "swept, forward".to_owned(),
                (false, true) => "swept, backward".to_owned(),
                (false, false) => rpm(rate),
            };
            let [u_s, u_d, phase] = match member.device().as_ref().and_then(imbalance) {
                Some(Imbalance { u_s, u_d, phase }) => {
                    [short(units::to_g_cm(u_s), 5), short(units::to_g_cm2(u_d), 5), degrees(phase)]
                }
                None => ["–"; 3].map(str::to_owned),
            };
            let model = if member.is_lumped() { "lumped" } else { "coupled" };
            let cells = vec![
                rotor,
                self.place_of(name),
                short(body.mass, 6),
                moments_of_rotor(&body, info.axis),
                u_s,
                u_d,
                phase,
                degrees(angle),
                speed,
                model.to_owned(),
            ];
            ("", cells)
        };
        let mut columns = vec![
            "Rotor",
            "Stands on",
            "Mass (kg)",
            "Spin and transverse inertia (kg m²)",
            "U_s (g cm)",
            "U_d (g cm²)",
            "Phase of U_d",
            "Angle",
            "Speed",
            "Imbalance",
        ];
        let mut rows: Rows = rows.map(row).collect();
        // Where the imbalance of every rotor is coupled, as by default, that needs no column.
        let is_coupled =
            |(_, cells): &(&str, Vec<String>)| cells.last().is_none_or(|model| model == "coupled");
        if rows.iter().all(is_coupled) {
            columns.pop();
            for (_, cells) in &mut rows {
                cells.pop();
            }
        }
        inputs_table("Rotors", &columns, 2..8, rows)
    }

    /// The node or position of a device, from B.
    fn place_of(&self, name: &str) -> String {
        let found = self.scenario.members().position(|(known, _)| known == name);
        let member = found.and_then(|index| Some((index, self.scenario.members().nth(index)?.1)));
        let Some((index, member)) = member else { return String::new() };
        if let Some(carrier) = member.on().and_then(|on| self.scenario.names.get(on)) {
            return carrier.clone();
        }
        if let Some(structure) = &self.scenario.structure {
            let node = structure.on_node.get(index).and_then(|node| structure.nodes.get(*node));
            return node.map_or_else(String::new, |node| format!("node {}", node.name));
        }
        let origin = member.bodies().first().map_or([0.0; 3], |body| body.origin);
        // Broken after the hub only.
        format!("hub, {}\u{a0}m", origin.map(|value| short(value, 4)).join(",\u{a0}"))
    }

    fn other_joints(&self) -> Option<Block> {
        let rows = self.each_joint().filter(|(.., info, _, _)| info.body != "wheel");
        let row = |(joint, name, member, info, body, [at, rate]): (
            usize,
            &str,
            Member<'_>,
            &JointInfo,
            BodyParameters<f64>,
            [f64; 2],
        )| {
            let at = if info.slides { format!("{} mm", short(1e3 * at, 5)) } else { degrees(at) };
            let passive = member.passive().into_iter().nth(info.index);
            let [stiffness, viscous] =
                passive.map_or([0.0; 2], |passive| [passive.stiffness, passive.viscous]);
            let locked = matches!(self.scenario.drives.get(joint), Some(Drive::Locked));
            let held = match (locked, self.budget.sprung && stiffness > 0.0) {
                (true, _) => "locked",
                (false, true) => "free on its spring",
                (false, false) => "held",
            };
            let unit = if info.slides { "m/s" } else { "rad/s" };
            let cells = vec![
                format!("{name}.{}", joint_key(info)),
                short(body.mass, 6),
                moments(&body, 0).join(", "),
                at,
                format!("{} {unit}", short(rate, 4)),
                short(stiffness, 5),
                short(viscous, 5),
                held.to_owned(),
            ];
            ("", cells)
        };
        let columns = [
            "Joint",
            "Mass (kg)",
            "Inertia x, y, z (kg m²)",
            "Angle or place",
            "Rate",
            "Stiffness (SI)",
            "Damping (SI)",
            "In the budget",
        ];
        inputs_table("Other joints", &columns, 1..7, rows.map(row).collect())
    }

    fn tones(&self) -> Option<Block> {
        let rows = self.scenario.disturbances.iter().flat_map(|of| match &of.model {
            Model::Harmonic(tones) => tones.iter().map(|tone| self.tone(of, tone)).collect(),
            Model::Broadband(_) | Model::Measured(_) => Vec::new(),
        });
        let columns =
            ["Source", "Acts on", "h", "Coefficients (force kg m, moment kg m²) and phases"];
        inputs_table("Tones of sources", &columns, 2..3, rows.collect())
    }

    fn tone(&self, of: &Disturbance, tone: &Harmonic) -> (&'static str, Vec<String>) {
        let each = COMPONENTS.iter().zip(tone.amplitudes.iter().zip(&tone.phases));
        let acts = each.filter(|(_, (amplitude, _))| **amplitude != 0.0);
        let parts = acts.map(|(component, (amplitude, phase))| {
            format!(
                "{} {} at {}",
                component.replace('_', " "),
                short(*amplitude, 4),
                degrees(*phase)
            )
        });
        let parts: Vec<_> = parts.collect();
        ("", vec![of.name.clone(), self.acts_on(of), short(tone.number, 7), parts.join("; ")])
    }

    fn noises(&self) -> Option<Block> {
        let rows = self.scenario.disturbances.iter().flat_map(|of| match &of.model {
            Model::Broadband(noise) => self.noise_rows(of, noise),
            Model::Harmonic(_) | Model::Measured(_) => Vec::new(),
        });
        let columns =
            ["Source", "Acts on", "Component", "Band (Hz)", "Density (SI²/Hz)", "Grows with"];
        inputs_table("Broadband noise of sources", &columns, 3..5, rows.collect())
    }

    fn noise_rows(&self, of: &Disturbance, noise: &Broadband) -> Rows {
        let [from, to] = noise.band;
        let band = format!("{} to {}", short(from, 5), short(to, 5));
        let grows = noise.reference_rate.map_or_else(
            || "nothing".to_owned(),
            |rate| format!("the square of the rate; as stated at {}", rpm(rate.abs())),
        );
        let acting = COMPONENTS.iter().zip(&noise.densities).filter(|(_, list)| !list.is_empty());
        let mut rows: Rows = acting
            .map(|(component, list)| {
                let least = list.iter().copied().fold(f64::INFINITY, f64::min);
                let most = list.iter().copied().fold(0.0, f64::max);
                let density = if least == most {
                    short(most, 4)
                } else {
                    format!("{} to {}, {} frequencies", short(least, 4), short(most, 4), list.len())
                };
                let component = component.replace('_', " ");
                (
                    "",
                    vec![
                        of.name.clone(),
                        self.acts_on(of),
                        component,
                        band.clone(),
                        density,
                        grows.clone(),
                    ],
                )
            })
            .collect();
        rows.extend(noise.pairs.iter().map(|pair| {
            let [a, b] = pair.components.map(|of| COMPONENTS.get(of).copied().unwrap_or_default());
            let coherence = pair.coherence.iter().copied().fold(0.0, f64::max);
            let what = format!("coherence of {} and {}", a.replace('_', " "), b.replace('_', " "));
            let value = format!("{} at most", short(coherence, 3));
            ("", vec![of.name.clone(), self.acts_on(of), what, band.clone(), value, String::new()])
        }));
        rows
    }

    fn other_sources(&self) -> Option<Block> {
        let records = self.scenario.disturbances.iter();
        let records = records.filter(|of| matches!(of.model, Model::Measured(_)));
        let row = |of: &Disturbance| {
            ("", vec![of.name.clone(), self.acts_on(of), "record over time, left out".to_owned()])
        };
        let columns = ["Source", "Acts on", "What"];
        inputs_table("Other sources", &columns, 0..0, records.map(row).collect())
    }

    fn acts_on(&self, of: &Disturbance) -> String {
        let scenario = self.scenario;
        let on = match of.on {
            SourceTarget::Mount(member) => {
                format!("mount of {}", scenario.names.get(member).map_or("", String::as_str))
            }
            SourceTarget::Hub { .. } => "hub".to_owned(),
            SourceTarget::Node { node, .. } => {
                let nodes = scenario.structure.as_ref().map(|structure| &structure.nodes);
                let node = nodes.and_then(|nodes| nodes.get(node));
                format!("node {}", node.map_or("", |node| node.name.as_str()))
            }
            SourceTarget::Joint { joint, .. } => scenario
                .joints()
                .nth(joint)
                .map_or_else(String::new, |(_, name, info)| format!("{name}.{}", joint_key(info))),
        };
        let [from, to] = of.window.map(|end| short(end, 5));
        match of.window.map(f64::is_finite) {
            [false, false] => on,
            [true, false] => format!("{on}, from {from} s; here always"),
            [false, true] => format!("{on}, to {to} s; here always"),
            [true, true] => format!("{on}, {from} to {to} s; here always"),
        }
    }

    fn hub(&self) -> Option<Block> {
        let hub = &self.scenario.hub;
        let row = |what: &str, value: String| ("", vec![what.to_owned(), value]);
        let list = |values: [f64; 3]| values.map(|value| short(value, 6)).join(", ");
        let inertia = hub.i_b_bc;
        let mut rows = vec![
            row("Mass", format!("{} kg", short(hub.m_b, 7))),
            row("Centre of mass from B", format!("{} m", list(hub.r_bc_b.into()))),
            row(
                "Moments of inertia about it",
                format!("{} kg m²", list([inertia.m11, inertia.m22, inertia.m33])),
            ),
            row(
                "Elements 12, 13, 23 of it",
                format!("{} kg m²", list([inertia.m12, inertia.m13, inertia.m23])),
            ),
        ];
        if let Some(file) = &self.scenario.source.structure {
            rows.insert(0, row("File of the structure", file.clone()));
        }
        inputs_table("Hub or undeformed structure", &["Quantity", "Value"], 1..2, rows)
    }

    fn mode_table(&self) -> Option<Block> {
        let modes = self.scenario.structure.iter().flat_map(ModalStructure::massive);
        let row = |(index, mode): (usize, &crate::structure::Mode)| {
            let cells = vec![
                (index + 1).to_string(),
                short(mode.frequency / TAU, 6),
                short(100.0 * mode.damping, 4),
            ];
            ("", cells)
        };
        let columns = ["Mode", "Frequency (Hz)", "Damping ratio (%)"];
        inputs_table("Modes of the structure", &columns, 1..3, modes.enumerate().map(row).collect())
    }

    fn sights(&self) -> Option<Block> {
        let rows = self.budget.sights.iter().flat_map(|sight| {
            sight.line.sensitivities().iter().map(|of| {
                let list = |row: nalgebra::RowVector3<f64>| {
                    let values: Vec<_> = row.iter().map(|value| short(*value, 5)).collect();
                    values.join(", ")
                };
                let [d, r] = [&of.displacement, &of.rotation];
                let cells = vec![
                    sight.name.clone(),
                    of.node.clone(),
                    list(d.row(0).into_owned()),
                    list(r.row(0).into_owned()),
                    list(d.row(1).into_owned()),
                    list(r.row(1).into_owned()),
                ];
                ("", cells)
            })
        });
        let columns = [
            "Line of sight",
            "Node",
            "x by displacement (rad/m)",
            "x by rotation (rad/rad)",
            "y by displacement (rad/m)",
            "y by rotation (rad/rad)",
        ];
        inputs_table("Lines of sight", &columns, 2..6, rows.collect())
    }
}
