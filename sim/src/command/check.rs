//! `check`: what a scenario is, before it is run.

use std::fmt::Write as _;
use std::process::ExitCode;

use clap::Args;
use precess_dynamics::{About, BuiltIn, Inputs, JointStates, WheelImbalance};

use super::table::{aligned, six};
use super::{Files, Form, print};
use crate::file::read::body_key;
use crate::file::{Diagnostics, Severity, from_file};
use crate::scenario::Scenario;

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
    pub(super) fn execute(&self) -> ExitCode {
        let overrides = self.files.overrides.overrides();
        let mut failed = false;
        for path in &self.files.files {
            match from_file(path, &overrides) {
                Ok((scenario, mut reports)) => {
                    sampling(&scenario, &mut reports);
                    if self.format == Form::Json {
                        print(&(reports.json() + "\n"));
                        continue;
                    }
                    print(&properties(&scenario));
                    if !reports.all.is_empty() {
                        print(&format!("\n{reports}"));
                    }
                }
                Err(errors) => {
                    failed = true;
                    match self.format {
                        Form::Json => print(&(errors.json() + "\n")),
                        Form::Text => eprint!("{errors}"),
                    }
                }
            }
        }
        if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
    }
}

/// Turns of the fastest joint that one sample interval may hold before a figure shows another
/// frequency: half of one, by the sampling theorem.
const TURNS_MAX: f64 = 0.5;

/// Warns where the samples do not resolve a turn of a wheel.
pub(super) fn sampling(scenario: &Scenario, reports: &mut Diagnostics) {
    let rates = scenario.initial.devices.states().map(|[_, rate]| rate.abs());
    let joints = scenario.joints().zip(rates).filter(|((_, _, info), _)| !info.slides);
    let Some(((_, name, info), rate)) = joints.max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    let turns = rate / std::f64::consts::TAU / scenario.output.rate;
    if turns >= TURNS_MAX {
        let needed = rate / std::f64::consts::TAU / TURNS_MAX;
        reports.all.push(crate::file::Diagnostic {
            severity: Severity::Warning,
            span: None,
            message: format!(
                "{name}.{} turns {turns:.2} times between two samples at {} Hz, so figures show \
                 another frequency than its own (aliasing)",
                body_key(info),
                six(scenario.output.rate)
            ),
            label: String::new(),
            help: format!(
                "record above {0} Hz, for example `output.rate = \"{0} Hz\"`, or read the \
                 samples as a slow record",
                (needed * 10.0).ceil()
            ),
        });
    }
}

/// Mass properties, momenta, imbalance and pivots, as text.
fn properties(scenario: &Scenario) -> String {
    let mut text = format!("{}: {}\n", scenario.name, scenario.title);
    // A scenario that was read has a spacecraft.
    let Ok(spacecraft) = scenario.spacecraft() else { return text };
    let state = &scenario.initial;
    let mut rows = vec![row("total mass", &[spacecraft.mass()], "kg")];
    if let Ok(c) = spacecraft.centre_of_mass(state) {
        rows.push(row("centre of mass from B, B axes", c.c.as_slice(), "m"));
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
    text.push_str(&aligned(&rows));
    let mut rows = Vec::new();
    let mut states = state.devices.states();
    for (name, device) in scenario.names.iter().zip(&scenario.devices) {
        let parameters = device.parameters();
        for (info, body) in device.kind().joints().iter().zip(&parameters.bodies) {
            let [_, rate] = states.next().unwrap_or_default();
            let mut cells = vec![
                format!("{name}.{}", body_key(info)),
                format!("{} kg", six(body.mass)),
                if info.slides {
                    format!("{} m/s", six(rate))
                } else {
                    format!("{} rpm", six(rate * 30.0 / std::f64::consts::PI))
                },
            ];
            cells.push(if info.tip { imbalance(device) } else { String::new() });
            rows.push(cells);
        }
    }
    if !rows.is_empty() {
        text.push('\n');
        text.push_str(&aligned(&rows));
    }
    // The initial state tells whether the solver can solve it at all.
    let mut inputs = Inputs::none_for(&spacecraft);
    inputs.hub = scenario.hub_mode;
    inputs.gravity = scenario.gravity;
    if let Err(error) = spacecraft.accelerations(state, &inputs) {
        let _ = writeln!(text, "\nthe initial state cannot be solved: {error}");
    }
    text
}

/// The imbalance of a device's wheel, as a data sheet states it.
fn imbalance(device: &BuiltIn) -> String {
    let parameters = device.parameters();
    let joints = device.kind().joints();
    let Some(wheel) = parameters.bodies.get(joints.len().saturating_sub(1)) else {
        return String::new();
    };
    if joints.last().is_none_or(|joint| joint.slides) || wheel.centre[0] != 0.0 {
        return String::new();
    }
    let of =
        WheelImbalance { d: wheel.centre[1], j_12: wheel.inertia.m12, j_13: wheel.inertia.m13 };
    match of.lumped(wheel.mass) {
        Ok(found) if found.u_s == 0.0 && found.u_d == 0.0 => "balanced".to_owned(),
        Ok(found) => format!(
            "U_s {} g cm, U_d {} g cm^2",
            six(precess_dynamics::units::to_g_cm(found.u_s)),
            six(precess_dynamics::units::to_g_cm2(found.u_d))
        ),
        Err(_) => String::new(),
    }
}

fn row(name: &str, values: &[f64], unit: &str) -> Vec<String> {
    let numbers: Vec<_> = values.iter().map(|value| six(*value)).collect();
    vec![name.to_owned(), format!("{} {unit}", numbers.join(", "))]
}
