//! A case as lists, with its devices made those of another kind.
//!
//! Lists, because the solver is compiled once for them and not once for every number of devices.

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::{Joints, MotorTorques};
use precess_dynamics::kind::{Each, JointStates, Kind};
use precess_dynamics::{Dgvscmg, Hub, Inputs, Scalar, Spacecraft, State};

use super::Solved;
use super::kinds::Form;
use crate::case::Case;

/// Parameters, state and inputs.
#[derive(Clone, Debug)]
pub(super) struct Drawn<T: Scalar> {
    hub: Hub<T>,
    devices: Vec<Dgvscmg<T>>,
    joints: Vec<Joints<T>>,
    omega: Vector3<T>,
    force: Vector3<T>,
    torque_b: Vector3<T>,
    motors: Vec<MotorTorques<T>>,
}

impl<T: Scalar> Drawn<T> {
    /// What the accelerations depend on.
    pub(super) fn new<const N: usize>(case: &Case<N, T>) -> Self {
        Self {
            hub: case.hub,
            devices: case.devices.to_vec(),
            joints: case.state.devices.to_vec(),
            omega: case.state.omega,
            force: case.inputs.force,
            torque_b: case.inputs.torque_b,
            motors: case.inputs.motors.to_vec(),
        }
    }

    /// The solver's accelerations with devices of another form; a single gimbal moves as the outer one.
    pub(super) fn solved<F: Form>(&self, whose: &str) -> Solved<F::Device<T>> {
        let devices: Vec<_> = self.devices.iter().map(F::from_dgvscmg).collect();
        let craft = Spacecraft::new(&self.hub, &devices)
            .unwrap_or_else(|error| panic!("{}, {whose}: {error}", F::NAME));
        let single = F::Device::<T>::JOINTS.len() == 2;
        let kept = |joint: usize| !(single && joint % 3 == 1);

        let mut state: State<Vec<F::Device<T>>> = State::at_rest_for(&craft);
        state.omega = self.omega;
        let drawn = self.joints.iter().flat_map(JointStates::states).enumerate();
        let drawn = drawn.filter(|(joint, _)| kept(*joint));
        for ([coordinate, rate], (_, drawn)) in state.devices.states_mut().zip(drawn) {
            [*coordinate, *rate] = drawn;
        }
        let mut inputs = Inputs::none_for(&craft);
        (inputs.force, inputs.torque_b) = (self.force, self.torque_b);
        let drawn = self.motors.iter().flat_map(Each::values).enumerate();
        let drawn = drawn.filter(|(joint, _)| kept(*joint));
        for (motor, (_, drawn)) in inputs.motors.values_mut().zip(drawn) {
            *motor = drawn;
        }
        craft.accelerations(&state, &inputs)
    }
}
