//! [`MeanState`]: the state about which a settled run vibrates, which is that of its file.

use precess_dynamics::{JointStates, State};

use super::{Scenario, Set};

/// The state of a file before the vibration of the rotors is added to it.
#[derive(Clone, Debug)]
pub struct MeanState {
    /// Of hub and devices.
    pub state: State<Set>,
    /// Coordinates and rates of the structure's modes; empty of a rigid hub.
    pub modes: [Vec<f64>; 2],
}

impl Scenario {
    /// The present initial state as that about which the run vibrates.
    pub(crate) fn present_mean(&self) -> MeanState {
        let of = self.structure.as_ref();
        let modes = of.map(|of| [of.coordinates.clone(), of.rates.clone()]).unwrap_or_default();
        MeanState { state: self.initial.clone(), modes }
    }

    /// Coordinate and rate of each joint in the mean motion: those of the file, also where the run starts in its
    /// vibration.
    pub fn mean_joints(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let state = self.mean.as_ref().map_or(&self.initial, |mean| &mean.state);
        state.devices.states()
    }

    /// Starts in the mean motion, without the vibration.
    pub(crate) fn start_in_mean(&mut self) {
        let Some(MeanState { state, modes: [coordinates, rates] }) = self.mean.take() else {
            return;
        };
        self.initial = state;
        if let Some(of) = &mut self.structure {
            (of.coordinates, of.rates) = (coordinates, rates);
        }
    }
}
