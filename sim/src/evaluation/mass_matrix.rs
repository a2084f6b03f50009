//! [`MassMatrix`]: `M a + bias = [F; L_B; u]`.
//!
//! ```text
//! M e_k = dT/dv at v = e_k,   bias = -M a at F = 0, L_B = 0, u = 0
//! ```
//!
//! T is the kinetic energy, whose derivatives are exact to rounding, so M is symmetric to rounding.

use nalgebra::{DMatrix, DVector};
use precess_dynamics::kind::Each;
use precess_dynamics::{About, Axis, HubMode, JointStates, Outputs, Quaternion, Variable};

use super::{CraftInputs, CraftState, EvaluationError, Evaluator};

/// Mass matrix and bias at a state.
#[derive(Clone, Debug, PartialEq)]
pub struct MassMatrix {
    /// Names of the accelerations: inertial of B and angular of the hub, both in B, then of every
    /// joint with a motor, and of the modal coordinates.
    pub coordinates: Vec<String>,
    /// M: kg, kg m, kg m²; one for a mode, and sqrt(kg), m sqrt(kg) beside it.
    pub matrix: DMatrix<f64>,
    /// Bias, N, N m, N/sqrt(kg): Coriolis and centrifugal, gravity, springs, dampers and friction,
    /// stiffness and damping of modes, wrenches on bodies.
    pub bias: DVector<f64>,
}

impl Evaluator {
    /// Mass matrix and bias of a free hub with every motor driven, whatever their modes are.
    ///
    /// # Errors
    ///
    /// As [`precess_dynamics::Spacecraft::accelerations`] in a pose that has no accelerations.
    pub fn mass_matrix(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<MassMatrix, EvaluationError> {
        let joints = self.joints();
        let driven: Vec<_> =
            joints.iter().enumerate().filter(|(_, joint)| joint.driven).map(|(k, _)| k).collect();
        let hub = [Variable::Velocity, Variable::Omega].into_iter();
        let variables: Vec<_> = hub
            .flat_map(|of| Axis::ALL.map(of))
            .chain(driven.iter().map(|joint| Variable::Rate(*joint)))
            .chain((0..self.layout.modes).map(Variable::ModalRate))
            .collect();
        let matrix = self.matrix(state, &variables)?;
        let mut free = inputs.clone();
        free.hub = HubMode::Free;
        free.force.fill(0.0);
        free.torque_b.fill(0.0);
        free.motors.values_mut().for_each(|motor| *motor = 0.0);
        free.modal = self.no_inputs().modal;
        let own = self.no_inputs();
        for (mode, own) in free.modes.values_mut().zip(own.modes.values()) {
            *mode = own;
        }
        let found = self.accelerations(state, &free)?;
        let all: Vec<_> = found.devices.values().collect();
        let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
        let joints_of = driven.iter().filter_map(|joint| all.get(*joint).copied());
        let of_modes = found.modal.eta_ddot.iter().copied();
        let accelerations = hub.chain(joints_of).chain(of_modes);
        let accelerations = DVector::from_iterator(variables.len(), accelerations);
        let bias = -(&matrix * accelerations);
        let names = self.acceleration_names();
        let of_joints = driven.iter().map(|joint| joint + 6);
        let first = 6 + joints.len();
        let places = (0..6).chain(of_joints).chain(first..first + self.layout.modes);
        let coordinates = places.filter_map(|place| names.get(place).cloned()).collect();
        Ok(MassMatrix { coordinates, matrix, bias })
    }

    /// Columns of M, one by one.
    fn matrix(
        &self,
        state: &CraftState,
        variables: &[Variable],
    ) -> Result<DMatrix<f64>, EvaluationError> {
        let inputs = self.no_inputs();
        let outputs = Outputs { momentum: Some(About::InertialOrigin), loads: None };
        let mut pose = self.at_rest();
        // B along N, so that velocities along N are those along B.
        pose.attitude = Quaternion { q0: 1.0, q1: 0.0, q2: 0.0, q3: 0.0 };
        pose.modal.eta.clone_from(&state.modal.eta);
        for ([coordinate, _], [own, _]) in pose.devices.states_mut().zip(state.devices.states()) {
            *coordinate = own;
        }
        let mut matrix = DMatrix::zeros(variables.len(), variables.len());
        for (mut column, variable) in matrix.column_iter_mut().zip(variables) {
            let mut moving = pose.clone();
            match *variable {
                Variable::Velocity(axis) => moving.r_b_n_dot[index(axis)] = 1.0,
                Variable::Omega(axis) => moving.omega[index(axis)] = 1.0,
                Variable::Rate(joint) => {
                    if let Some([_, rate]) = moving.devices.states_mut().nth(joint) {
                        *rate = 1.0;
                    }
                }
                Variable::ModalRate(mode) => moving.modal.eta_dot[mode] = 1.0,
                _ => {}
            }
            let mut elements = column.iter_mut();
            let at = (&moving, &inputs);
            let mut by = variables.iter().copied();
            precess_craft::derivatives(&self.craft, at, &outputs, &mut by, &mut |_, of| {
                if let (Some(element), Some(momentum)) = (elements.next(), &of.momentum) {
                    *element = momentum.energy;
                }
            })?;
        }
        Ok(matrix)
    }
}

fn index(axis: Axis) -> usize {
    match axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    }
}
