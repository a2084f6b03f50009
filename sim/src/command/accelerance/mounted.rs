//! Devices of a scenario on a mount, for `accelerance`: averaged at their initial rates and angles, and as the rigid
//! body that they are in the model of a structure.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;

use crate::command::error::CommandError;
use crate::command::terminal::note;
use crate::file::from_file;
use crate::scenario::steady::SteadyJoints;
use crate::scenario::{Member, Scenario, members, set_of};
use crate::structure::averaged::AveragedDevices;
use crate::structure::dynamic_mass::Motor;

/// A device that is farther from its node than this, m, may be at the wrong node.
const ARM_MAX: f64 = 0.01;

/// The options about devices.
#[derive(Debug, Args)]
pub(super) struct DeviceOptions {
    /// A scenario whose devices are mounted at the first node, at their initial rates and angles: adds
    /// their dynamic mass, and the transmission from blocked to mounted force.
    #[arg(long, value_name = "FILE")]
    scenario: Option<PathBuf>,
    /// A device of the scenario; may be repeated. All without this option.
    #[arg(long, value_name = "NAME", requires = "scenario")]
    device: Vec<String>,
    /// What motors of wheels do to small changes of their rates.
    #[arg(long, default_value = "torque")]
    motor: MotorCondition,
    /// Joints that do not spin: on their springs if they have any, or locked.
    #[arg(long, default_value = "sprung")]
    gimbals: Gimbals,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum MotorCondition {
    /// They keep their torque: wheels spin freely.
    Torque,
    /// They keep the relative rates.
    Rate,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Gimbals {
    /// Free where they have a spring and are not locked by the scenario.
    Sprung,
    /// Locked.
    Locked,
}

/// Devices on a mount.
pub(super) struct MountedDevices {
    /// Their names.
    pub(super) names: String,
    pub(super) averaged: AveragedDevices,
    /// The same, locked and at rest.
    pub(super) rigid: AveragedDevices,
}

impl DeviceOptions {
    /// The devices at a node; none without a scenario.
    pub(super) fn mounted(
        &self,
        node: &str,
        mount: &Vector3<f64>,
    ) -> Result<Option<MountedDevices>, CommandError> {
        let Some(path) = &self.scenario else { return Ok(None) };
        let (scenario, _) = from_file(path, &[]).map_err(CommandError::Scenario)?;
        let chosen = self.chosen(&scenario)?;
        let motor = match self.motor {
            MotorCondition::Torque => Motor::ConstantTorque,
            MotorCondition::Rate => Motor::ConstantRate,
        };
        let joints = SteadyJoints::new(&scenario, &chosen, motor, self.gimbals == Gimbals::Sprung);
        for (name, rate) in &joints.stopped {
            note(&format!("warning: {name} is {rate} at first; taken as at rest"));
        }
        let members = members(&scenario.devices);
        let on_mount: Vec<_> = chosen.iter().filter_map(|index| members.get(*index)).collect();
        let devices = set_of(&scenario, &chosen);
        let names = chosen.iter().filter_map(|index| scenario.names.get(*index));
        let names = names.map(String::as_str).collect::<Vec<_>>().join(", ");
        for (name, member) in names.split(", ").zip(&on_mount) {
            if member.on().is_some() {
                continue;
            }
            let origin = member.bodies().first().map_or([0.0; 3], |body| body.origin);
            let arm = (Vector3::from(origin) - mount).norm();
            if arm > ARM_MAX {
                note(&format!(
                    "warning: {name}: {arm:.3} m from node `{node}`; taken as a rigid arm between them"
                ));
            }
        }
        let failed = |fault| CommandError::Other(format!("{}: {names}: {fault}", path.display()));
        let held = vec![Motor::ConstantRate; joints.motors.len()];
        let averaged = AveragedDevices::of_set(&devices, mount, &joints.states, &joints.motors);
        let at_rest: Vec<_> = joints.states.iter().map(|[x, _]| [*x, 0.0]).collect();
        let rigid = AveragedDevices::of_set(&devices, mount, &at_rest, &held);
        let (averaged, rigid) = (averaged.map_err(failed)?, rigid.map_err(failed)?);
        Ok(Some(MountedDevices { names, averaged, rigid }))
    }

    /// Numbers of the devices, in the order of the scenario; a platform or panel brings what stands on it.
    fn chosen(&self, scenario: &Scenario) -> Result<Vec<usize>, CommandError> {
        let Scenario { names, .. } = scenario;
        if let Some(device) = self.device.iter().find(|device| !names.contains(device)) {
            let message = format!(
                "--device {device}: the scenario has no such device, but {}",
                names.join(", ")
            );
            return Err(CommandError::Other(message));
        }
        let is_chosen = |name: Option<&String>| {
            name.is_some_and(|name| self.device.is_empty() || self.device.contains(name))
        };
        let (mut chosen, members) = (Vec::new(), members(&scenario.devices));
        for (index, member) in members.iter().enumerate() {
            // Of what stands on several platforms or panels, the one on the hub.
            let below = |on: &usize| members.get(*on).and_then(Member::on);
            let on = std::iter::successors(member.on(), below).last().and_then(|on| names.get(on));
            let is_named = is_chosen(names.get(index));
            if let (true, Some(on)) = (is_named && !is_chosen(on), on) {
                let message = format!(
                    "--device {}: it stands on `{on}`; name that",
                    names.get(index).map_or("", String::as_str)
                );
                return Err(CommandError::Other(message));
            }
            if is_named || is_chosen(on) {
                chosen.push(index);
            }
        }
        Ok(chosen)
    }
}
