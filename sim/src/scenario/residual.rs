//! Residual coordinates without mass: those that move a node only where a joint on it moves freely.

use precess_craft::{Craft, CraftInputs, FlexibleCraft};
use precess_dynamics::kind::Each;
use precess_dynamics::{JointStates, Mode, SolveError};

use super::check::range;
use super::mass::drive_at_start;
use super::{ModalStructure, Scenario, ScenarioError};

impl Scenario {
    /// What is wrong with the residual coordinates: one that moves a mount only where a joint on it
    /// moves freely has no mass, and the joint is named.
    pub(super) fn check_residual(
        &self,
        structure: &ModalStructure,
        craft: FlexibleCraft,
    ) -> Option<ScenarioError> {
        if structure.residual == 0 {
            return None;
        }
        let craft = Craft::from(craft);
        let mut state = craft.at_rest();
        state.modal.eta.clone_from(&structure.coordinates);
        let initial = self.initial.devices.states();
        for ([own, _], [coordinate, _]) in state.devices.states_mut().zip(initial) {
            *own = coordinate;
        }
        let mut inputs = craft.no_inputs();
        drive_at_start(self, &mut inputs.modes);
        let massless = |inputs: &CraftInputs| match craft.accelerations(&state, inputs) {
            Err(error @ SolveError::ModalMass { .. }) => Some(error),
            _ => None,
        };
        let error = massless(&inputs)?;
        let free: Vec<_> = inputs.modes.values().map(|mode| mode == Mode::Driven).collect();
        let held = |inputs: &mut CraftInputs, released: Option<usize>| {
            let modes = inputs.modes.values_mut().zip(&free).enumerate();
            for (joint, (mode, _)) in modes.filter(|(_, (_, free))| **free) {
                *mode = if released == Some(joint) { Mode::Driven } else { Mode::Locked };
            }
        };
        held(&mut inputs, None);
        if massless(&inputs).is_some() {
            return Some(range("structure", error.to_string()));
        }
        let joints = self.joints().enumerate().filter(|(joint, _)| {
            held(&mut inputs, Some(*joint));
            free.get(*joint) == Some(&true) && massless(&inputs).is_some()
        });
        let names: Vec<_> = joints
            .map(|(_, (member, name, info))| {
                let node =
                    structure.on_node.get(member).and_then(|node| structure.nodes.get(*node));
                let node = node.map_or("", |node| node.name.as_str());
                let (verb, axis) =
                    if info.slides { ("slides", "along") } else { ("turns", "about") };
                format!(
                    "{name}.{} {verb} freely, so node `{node}` moves no inertia {axis} that axis",
                    info.body.replace(' ', "_")
                )
            })
            .collect();
        if names.is_empty() {
            // Only several joints together take the mass of a direction.
            return Some(range("structure", error.to_string()));
        }
        let message = format!(
            "residual flexibility without mass: {}; leave that direction of the node out of the \
             residual flexibility (zeros in its row and column, or in the shapes), or lock the joint",
            names.join("; ")
        );
        Some(range("structure", message))
    }
}
