//! `check`: what a scenario is, before it is run.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use clap::Args;
use precess_dynamics::kind::JointInfo;
use precess_dynamics::{About, BuiltIn, Imbalance, Passive, units};

use super::error::CommandError;
use super::exit::Exit;
use super::limits_and_springs::{limits_and_springs, shown_rate};
use super::options::{Files, Form};
use super::table::{aligned, six};
use super::terminal::{note, print};
use super::{advice, sources};
use crate::engine::{Run, device_of};
use crate::evaluation::Evaluator;
use crate::file::{Diagnostic, Severity, from_file};
use crate::scenario::mass::{JointInertia, MassMatrix, MassProperties, imbalance};
use crate::scenario::{Drive, Scenario, joint_key};

/// The options of `check`.
#[derive(Debug, Args)]
pub(super) struct Check {
    #[command(flatten)]
    files: Files,
    /// How errors and warnings are printed.
    #[arg(long, value_enum, default_value_t)]
    format: Form,
}

impl Check {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let overrides = self.files.overrides.overrides();
        let mut failed = false;
        for path in &self.files.files {
            match from_file(path, &overrides) {
                Ok((scenario, mut reports)) => {
                    reports.all.extend(advice::initial(&scenario).iter().map(Into::into));
                    if let Some(error) = unsolvable(&scenario) {
                        failed = true;
                        reports.all.push(Diagnostic {
                            severity: Severity::Error,
                            span: None,
                            message: format!("the initial state cannot be solved: {error}"),
                            label: String::new(),
                            help: "a run of this scenario ends at its start".to_owned(),
                        });
                    }
                    if self.format == Form::Json {
                        print(&(reports.json() + "\n"))?;
                        continue;
                    }
                    print(&properties(&scenario))?;
                    if reports.has_errors() {
                        note(&reports.to_string());
                    } else if !reports.all.is_empty() {
                        print(&format!("\n{reports}"))?;
                    }
                }
                Err(errors) => {
                    failed = true;
                    match self.format {
                        Form::Json => print(&(errors.json() + "\n"))?,
                        Form::Text => note(&errors.to_string()),
                    }
                }
            }
        }
        Ok(if failed { Exit::Error } else { Exit::Success })
    }
}

/// Mass properties, momenta, imbalance and what each motor moves, as text.
fn properties(scenario: &Scenario) -> String {
    let mut text = format!("{}: {}\n", scenario.name, scenario.title);
    // A scenario that was read has a spacecraft.
    let Ok(spacecraft) = scenario.spacecraft() else { return text };
    let state = &scenario.initial;
    let mut rows = Vec::new();
    if let Ok(properties) = MassProperties::from_spacecraft(scenario, &spacecraft) {
        let MassProperties { mass, centre_of_mass, inertia_b: i } = properties;
        let (moments, axes) = properties.principal();
        rows.push(row("total mass", &[mass], "kg"));
        rows.push(row("centre of mass from B, B axes", centre_of_mass.as_slice(), "m"));
        rows.push(row("moments of inertia about B", i.diagonal().as_slice(), "kg m^2"));
        rows.push(row("elements 12, 13, 23 of it", &[i.m12, i.m13, i.m23], "kg m^2"));
        let of = properties.inertia_c();
        let moments_c = of.diagonal();
        rows.push(row(
            "moments of inertia about the centre of mass",
            moments_c.as_slice(),
            "kg m^2",
        ));
        rows.push(row("elements 12, 13, 23 of it", &[of.m12, of.m13, of.m23], "kg m^2"));
        rows.push(row("principal moments about the centre of mass", moments.as_slice(), "kg m^2"));
        for (number, axis) in ["first", "second", "third"].into_iter().zip(axes.column_iter()) {
            rows.push(row(&format!("axis of the {number}, B axes"), axis.as_slice(), ""));
        }
    }
    if let Ok(momentum) = spacecraft.momentum(state, About::CentreOfMass) {
        rows.push(row("linear momentum, N axes", momentum.linear.as_slice(), "kg m/s"));
        rows.push(row(
            "angular momentum about the centre of mass, N axes",
            momentum.angular.as_slice(),
            "N m s",
        ));
    }
    if let Ok(energy) = spacecraft.energy(state) {
        rows.push(row("kinetic energy", &[energy], "J"));
    }
    if let Some(structure) = &scenario.structure {
        let mut hertz: Vec<_> =
            structure.massive().iter().map(|mode| mode.frequency / TAU).collect();
        hertz.sort_by(f64::total_cmp);
        rows.push(row("modes of the structure", &hertz, "Hz"));
        if structure.residual > 0 {
            rows.push(vec!["residual coordinates".to_owned(), structure.residual.to_string()]);
        }
    }
    text.push_str(&aligned(&rows));
    let matrix = MassMatrix::from_spacecraft(scenario, &spacecraft);
    text.push_str(&joints(scenario, matrix.as_ref().ok()));
    text.push_str(&limits_and_springs(scenario, matrix.as_ref().ok()));
    text.push_str(&sources::sources(scenario));
    if let Ok(MassMatrix { condition: Some(condition), .. }) = &matrix {
        let _ = writeln!(
            text,
            "\ncondition number of the mass matrix, scaled to a unit diagonal: {} \
             (accelerations lose {:.1} of 16 digits)",
            six(*condition),
            condition.log10()
        );
    }
    text
}

/// Why a run cannot solve the initial state, with the drives, gravity and structure of the file; none
/// where it can.
fn unsolvable(scenario: &Scenario) -> Option<String> {
    let evaluator = match Evaluator::new(scenario) {
        Ok(evaluator) => evaluator,
        Err(error) => return Some(error.to_string()),
    };
    let state = evaluator.initial();
    let Ok(inputs) = evaluator.inputs(0.0, &state) else {
        // A joint that may stick: a run decides it.
        return Run::new(&scenario.without_controllers()).err().map(|error| error.to_string());
    };
    let error = evaluator.accelerations(&state, &inputs).err()?;
    let name = device_of(&error).and_then(|device| scenario.names.get(device));
    Some(name.map_or_else(|| error.to_string(), |name| format!("`{name}`: {error}")))
}

/// A row for each joint.
fn joints(scenario: &Scenario, matrix: Option<&MassMatrix>) -> String {
    let mut states = scenario.mean_joints();
    let mut drives = scenario.drives.iter();
    let mut inertias = matrix.into_iter().flat_map(|matrix| &matrix.joints);
    let heads = [
        "joint",
        "driven by",
        "mass",
        "rate",
        "inertia, all else held",
        "all else free",
        "imbalance",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (name, member) in scenario.members() {
        let springs = member.passive();
        for ((info, body), spring) in member.joints().iter().zip(&member.bodies()).zip(&springs) {
            let [_, rate] = states.next().unwrap_or_default();
            let JointInertia { held, free } = inertias.next().copied().unwrap_or_default();
            let unit = if info.slides { "kg" } else { "kg m^2" };
            let inertia = |inertia: Option<f64>| {
                inertia.map_or_else(|| "-".to_owned(), |value| format!("{} {unit}", six(value)))
            };
            rows.push(vec![
                format!("{name}.{}", joint_key(info)),
                drives.next().map_or("", |drive| driven_by(drive, info, spring)).to_owned(),
                format!("{} kg", six(body.mass)),
                shown_rate(info, rate),
                inertia(held),
                inertia(free),
                match member.device() {
                    Some(device) if info.tip => shown_imbalance(&device),
                    _ => String::new(),
                },
            ]);
        }
    }
    if rows.len() > 1 { format!("\n{}", aligned(&rows)) } else { String::new() }
}

/// The imbalance of a device's wheel, as a data sheet states it.
fn shown_imbalance(device: &BuiltIn) -> String {
    match imbalance(device) {
        None => String::new(),
        Some(found) if found.u_s == 0.0 && found.u_d == 0.0 => "balanced".to_owned(),
        Some(Imbalance { u_s, u_d, .. }) => format!(
            "U_s {} g cm, U_d {} g cm^2",
            six(units::to_g_cm(u_s)),
            six(units::to_g_cm2(u_d))
        ),
    }
}

/// What moves a joint at the start.
fn driven_by(drive: &Drive, info: &JointInfo, spring: &Passive) -> &'static str {
    match drive {
        _ if !info.driven => "its kind, at its rate",
        Drive::Locked => "nothing: locked",
        Drive::Acceleration(_) => "a prescribed motion",
        Drive::Torque { profile, .. } if profile.is_zero() && spring.stiffness != 0.0 => {
            "its spring"
        }
        Drive::Torque { profile, .. } if profile.is_zero() => "no torque: free",
        Drive::Torque { .. } if info.slides => "a force",
        Drive::Torque { .. } => "a torque",
    }
}

fn row(name: &str, values: &[f64], unit: &str) -> Vec<String> {
    let numbers: Vec<_> = values.iter().map(|value| six(*value)).collect();
    vec![name.to_owned(), format!("{} {unit}", numbers.join(", "))]
}
