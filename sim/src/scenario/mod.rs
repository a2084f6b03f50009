//! A scenario: a spacecraft, its initial state and what acts on it, constant over the run.

pub mod table1;

use nalgebra::Matrix3;
use precess_dynamics::{Dgvscmg, Hub, Inputs, State};

/// The set of devices that is run: `N` of the paper's.
pub type Set<const N: usize> = [Dgvscmg; N];

/// Everything a run needs, SI and radians.
#[derive(Clone, Debug)]
pub struct Scenario<const N: usize> {
    /// The name in file names, lower case with hyphens.
    pub name: String,
    /// What a heading says.
    pub title: String,
    /// The hub.
    pub hub: Hub,
    /// The devices.
    pub devices: Set<N>,
    /// Initial state.
    pub state: State<Set<N>>,
    /// Force, torque and motor torques; every joint is driven, the hub free.
    pub inputs: Inputs<Set<N>>,
}

impl<const N: usize> Scenario<N> {
    /// The same scenario with balanced wheels: no offset, no products of inertia.
    ///
    /// The wheels keep their mass and their moments of inertia, so that only the imbalance differs.
    #[must_use]
    pub fn balanced(&self) -> Self {
        let devices = self.devices.map(|device| {
            let i_w_wc = Matrix3::from_diagonal(&device.i_w_wc.diagonal());
            Dgvscmg { d: 0.0, i_w_wc, ..device }
        });
        Self {
            name: format!("{}-balanced", self.name),
            title: format!("{}, wheels balanced", self.title),
            devices,
            ..self.clone()
        }
    }
}
