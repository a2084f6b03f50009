//! Devices of a scenario on a mount, for `accelerance`: averaged at their initial rates and angles, and as the rigid
//! body that they are in the model of a structure.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use precess_dynamics::kind::JointStates;

use super::error::CommandError;
use crate::file::from_file;
use crate::scenario::{Drive, Member, Scenario, Set, members};
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
    motor: Keeps,
    /// Joints that do not spin: on their springs if they have any, or locked.
    #[arg(long, default_value = "sprung")]
    gimbals: Gimbals,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Keeps {
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

/// Joints of the chosen devices.
#[derive(Default)]
struct Joints {
    states: Vec<[f64; 2]>,
    at_rest: Vec<[f64; 2]>,
    motors: Vec<Motor>,
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
        let joints = self.joints(&scenario, &chosen);
        let members = members(&scenario.devices);
        let on_mount: Vec<_> = chosen.iter().filter_map(|index| members.get(*index)).collect();
        let on_hub = on_mount.iter().filter(|member| member.on().is_none());
        let devices: Set = (
            on_hub.filter_map(|member| member.device().copied()).collect(),
            on_mount.iter().filter_map(|member| member.platform().cloned()).collect(),
        );
        let names = chosen.iter().filter_map(|index| scenario.names.get(*index));
        let names = names.map(String::as_str).collect::<Vec<_>>().join(", ");
        for (name, member) in names.split(", ").zip(&on_mount) {
            if member.on().is_some() {
                continue;
            }
            let origin = member.bodies().first().map_or([0.0; 3], |body| body.origin);
            let arm = (Vector3::from(origin) - mount).norm();
            if arm > ARM_MAX {
                eprintln!(
                    "warning: {name}: {arm:.3} m from node `{node}`; taken as a rigid arm between them"
                );
            }
        }
        let failed = |fault| CommandError::Other(format!("{}: {names}: {fault}", path.display()));
        let held = vec![Motor::ConstantRate; joints.motors.len()];
        let averaged = AveragedDevices::new(&devices, mount, &joints.states, &joints.motors);
        let rigid = AveragedDevices::new(&devices, mount, &joints.at_rest, &held);
        let (averaged, rigid) = (averaged.map_err(failed)?, rigid.map_err(failed)?);
        Ok(Some(MountedDevices { names, averaged, rigid }))
    }

    /// Numbers of the devices, in the order of the scenario; a platform brings those on it.
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
            let on = member.on().and_then(|on| names.get(on));
            let is_named = is_chosen(names.get(index));
            if let (true, Some(on)) = (is_named && !is_chosen(on), on) {
                let message = format!(
                    "--device {}: it stands on a platform; name the platform, {on}",
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

    /// Coordinates, rates and motors of the joints of some devices.
    fn joints(&self, scenario: &Scenario, chosen: &[usize]) -> Joints {
        let (mut joints, members) = (Joints::default(), members(&scenario.devices));
        let states = scenario.initial.devices.states().zip(&scenario.drives);
        for ((device, name, info), ([coordinate, rate], drive)) in scenario.joints().zip(states) {
            if !chosen.contains(&device) {
                continue;
            }
            let member = members.get(device);
            let spins = info.tip && !info.slides && member.is_some_and(|of| of.device().is_some());
            if rate != 0.0 && !spins {
                eprintln!("warning: {name}: {} is {rate} at first; taken as at rest", info.rate);
            }
            let passive = member.map(Member::passive).unwrap_or_default();
            let passive = passive.get(info.index);
            let sprung = passive.is_some_and(|passive| passive.stiffness > 0.0)
                || member.is_some_and(Member::has_suspension);
            let is_driven = matches!(drive, Drive::Torque { .. });
            let motor = match (self.motor, self.gimbals) {
                _ if !is_driven => Motor::ConstantRate,
                (Keeps::Torque, _) if spins && !sprung => Motor::ConstantTorque,
                (_, Gimbals::Sprung) if sprung => Motor::ConstantTorque,
                _ => Motor::ConstantRate,
            };
            joints.states.push([coordinate, if spins && !sprung { rate } else { 0.0 }]);
            joints.at_rest.push([coordinate, 0.0]);
            joints.motors.push(motor);
        }
        joints
    }
}
