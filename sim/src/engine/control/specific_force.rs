//! [`specific_force`]: what an accelerometer reads without errors: inertial acceleration less gravity, at a point of the hub or at a node.

use nalgebra::Vector3;
use precess_craft::CraftState;
use precess_dynamics::{Attitude as _, Gravity, ListedModes, ModalPoint, SolveError};

use crate::engine::equations::system::System;

/// Where an accelerometer stands.
pub(super) enum Place {
    /// At a point of the hub, from B, m.
    Hub(Vector3<f64>),
    /// At a node of the structure.
    Node(Box<ModalPoint<ListedModes>>),
}

/// Along the axes of the hub or of the node, m/s², by one evaluation with the torques that act before the sample.
pub(super) fn specific_force(
    system: &System<'_>,
    place: &Place,
    time: f64,
    state: &CraftState,
) -> Result<Vector3<f64>, SolveError> {
    let inputs = system.inputs(time, state);
    let found = system.craft.accelerations(state, &inputs)?;
    system.count(1);
    let bn = state.attitude.dcm();
    // Expressed in B, and the axes of the sensor in these.
    let (acceleration, arm, axes) = match place {
        Place::Hub(arm) => {
            let turning = state.omega.cross(&state.omega.cross(arm));
            let acceleration = found.r_b_n_ddot + found.omega_dot.cross(arm) + turning;
            (acceleration, *arm, None)
        }
        Place::Node(node) => {
            let structure = system.craft.structure();
            let motion = structure.point_motion(node, state)?;
            let acceleration = structure.point_acceleration(node, state, &found)?.acceleration;
            (acceleration, node.position + motion.displacement, Some(motion.axes))
        }
    };
    let gravity = match inputs.gravity {
        Gravity::None => Vector3::zeros(),
        Gravity::Uniform(gravity) => gravity,
        Gravity::Central { mu } => {
            let place = state.r_b_n + bn.tr_mul(&arm);
            let distance = place.norm();
            place * (-mu / (distance * distance * distance))
        }
    };
    let force = acceleration - bn * gravity;
    Ok(axes.map_or(force, |axes| axes.tr_mul(&force)))
}
