//! Errors of the solver in a run: the device that they are about, by its name, and turns at a right angle.

use precess_dynamics::{Quantity, SolveError};

use super::equations::system::System;
use crate::record::RunError;

/// A cosine of the y turn below it is a right angle: the inertia of the x turn has fallen by its square.
const NEAR: f64 = 1e-3;

impl RunError {
    /// An error of the solver at a time.
    pub(crate) fn solve(system: &System<'_>, time: f64, source: SolveError) -> Self {
        let device = device_of(&source).and_then(|device| {
            let joint = system.layout.joints.iter().find(|joint| joint.device == device)?;
            joint.name.split('.').next().map(str::to_owned)
        });
        match (turn_at_right_angle(system, &source), device) {
            (Some((angle, pivot)), Some(platform)) => {
                Self::TurnAtRightAngle { time, platform, angle, pivot }
            }
            (_, device) => Self::Solve { time, device, source },
        }
    }
}

/// The angle of a platform's y turn, rad, in the state that was evaluated last, and pivot and bound of
/// its x turn, where that is singular and the angle near 90 degrees.
fn turn_at_right_angle(system: &System<'_>, error: &SolveError) -> Option<(f64, [f64; 2])> {
    let (device, pivot) = match *error {
        SolveError::Singular { device: Some(device), joint: Some("x turn"), pivot, bound } => {
            (device, [pivot, bound])
        }
        _ => return None,
    };
    let mut joints = system.layout.joints.iter();
    let turn = joints.position(|of| of.device == device && of.info.body == "y turn")?;
    let angle = system.evaluated_coordinate(turn)?;
    (angle.cos().abs() < NEAR).then_some((angle, pivot))
}

/// The device that an error of the solver is about.
pub(crate) fn device_of(error: &SolveError) -> Option<usize> {
    match error {
        SolveError::Singular { device, .. } => *device,
        SolveError::LockedJointMoves { device, .. }
        | SolveError::NotDriven { device, .. }
        | SolveError::Unstable { device, .. } => Some(*device),
        SolveError::NotFinite { what, .. } | SolveError::Overflow { what } => match what {
            Quantity::Joint { device, .. }
            | Quantity::Motor { device, .. }
            | Quantity::JointAcceleration { device, .. }
            | Quantity::Wrench { device, .. }
            | Quantity::Load { device, .. } => Some(*device),
            _ => None,
        },
        _ => None,
    }
}
