//! [`StepWorkspace`]: what a linearisation of a step writes besides its results, kept so that it is allocated once.

use alloc::vec::Vec;
use core::fmt::{self, Debug, Formatter};

use nalgebra::DMatrix;

use crate::derivatives::step::device_chain::DeviceChain;
use crate::derivatives::step::hub_accelerations::StageAccelerations;
use crate::derivatives::step::stage_chain::StageChain;
use crate::derivatives::workspace::Workspace;

/// No part of a result: all are equal and look alike, and a copy has none of it yet.
pub(crate) struct StepWorkspace {
    pub(crate) of_stage: Workspace<f64>,
    pub(crate) chain: ChainWorkspace,
    pub(crate) devices: DevicesWorkspace,
}

/// What is carried device by device.
#[derive(Debug, Default)]
pub(crate) struct DevicesWorkspace {
    /// Of the hub's rows.
    pub(crate) hub: StageChain,
    pub(crate) accelerations: StageAccelerations,
    pub(crate) devices: DeviceChain,
}

/// What is carried through the stages of a step.
pub(crate) struct ChainWorkspace {
    pub(crate) chain: StageChain,
    /// Derivatives of the accelerations at a stage, by states and by what is held.
    pub(crate) by_states: DMatrix<f64>,
    pub(crate) by_held: DMatrix<f64>,
    /// The joints that are not locked.
    pub(crate) moving: Vec<usize>,
}

impl StepWorkspace {
    pub(crate) fn new() -> Self {
        let (of_stage, chain) = (Workspace::new(), ChainWorkspace::new());
        Self { of_stage, chain, devices: DevicesWorkspace::default() }
    }
}

impl ChainWorkspace {
    pub(crate) fn new() -> Self {
        let [by_states, by_held] = [(); 2].map(|()| DMatrix::zeros(0, 0));
        Self { chain: StageChain::default(), by_states, by_held, moving: Vec::new() }
    }
}

impl Clone for StepWorkspace {
    fn clone(&self) -> Self {
        Self::new()
    }
}

impl PartialEq for StepWorkspace {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Debug for StepWorkspace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("StepWorkspace").finish_non_exhaustive()
    }
}
