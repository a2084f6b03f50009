//! [`WatchedModel`]: the equations of a scenario along its telemetry: accelerations at what is measured, lines of the rotors' imbalances in
//! the body rate, what a torque of a motor accelerates.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Complex, Matrix3, Vector3};
use precess_dynamics::{Axis, Each as _, JointStates as _, Mode, Outputs, Variable};

use super::error::WatchError;
use crate::evaluation::{CraftInputs, CraftState, EvaluationError, Evaluator};
use crate::scenario::mass::imbalance;
use crate::scenario::{Scenario, body_key};

/// A rotor whose imbalance is a parameter.
#[derive(Clone, Debug)]
pub(crate) struct Rotor {
    /// Its device.
    pub(crate) name: String,
    /// Its joint.
    pub(crate) joint: usize,
}

/// Angular acceleration of the hub by static and dynamic imbalance, 1/(kg m s²) and 1/(kg m² s²), as the real part times
/// `exp(i theta)`, and the rate of the rotor at which it is that.
#[derive(Clone, Debug)]
pub(super) struct Signature {
    pub(super) by_imbalance: [Vector3<Complex<f64>>; 2],
    /// The same of each joint.
    pub(super) by_joint: Vec<[Complex<f64>; 2]>,
    pub(super) rate: f64,
    /// Derivative of the hub's angular acceleration by its angular velocity, 1/s: the wheels' momenta.
    pub(super) coupling: Matrix3<f64>,
}

pub(crate) struct WatchedModel {
    evaluator: Evaluator,
    /// What was measured last.
    state: CraftState,
    inputs: CraftInputs,
    rotors: Vec<Rotor>,
    /// Whether each joint is that of a wheel.
    wheels: Vec<bool>,
    /// Rate of each joint below which its dry friction falls to zero, rad/s.
    slow: Vec<f64>,
}

/// Accelerations of hub and joints.
#[derive(Clone, Debug, Default)]
pub(crate) struct Accelerations {
    pub(crate) hub: Vector3<f64>,
    pub(crate) joints: Vec<f64>,
}

impl WatchedModel {
    /// Of a scenario whose joints with a motor in the telemetry are driven by it; the others keep their rates.
    pub(crate) fn new(scenario: &Scenario, motors: &[usize]) -> Result<Self, WatchError> {
        let evaluator = Evaluator::new(scenario).map_err(WatchError::Scenario)?;
        let state = evaluator.initial();
        let mut inputs = evaluator.no_inputs();
        for (joint, mode) in inputs.modes.values_mut().enumerate() {
            if !motors.contains(&joint) {
                *mode = Mode::Prescribed(0.0);
            }
        }
        let wheels = scenario.joints().map(|(.., info)| info.body == "wheel").collect();
        let imbalanced: Vec<bool> = scenario
            .members()
            .map(|(_, member)| member.device().is_some_and(|of| imbalance(&of).is_some()))
            .collect();
        let rotors = scenario.joints().enumerate().filter_map(|(joint, (device, name, info))| {
            let known = body_key(info) == "wheel" && imbalanced.get(device) == Some(&true);
            known.then(|| Rotor { name: name.to_owned(), joint })
        });
        let rotors = rotors.collect();
        let passive = scenario.members().flat_map(|(_, member)| member.passive());
        let slow = passive.map(|of| if of.coulomb == 0.0 { 0.0 } else { of.coulomb_rate });
        let slow = slow.collect();
        Ok(Self { evaluator, state, inputs, rotors, wheels, slow })
    }

    pub(crate) fn rotors(&self) -> &[Rotor] {
        &self.rotors
    }

    /// Takes a measured body rate, rad/s.
    pub(crate) fn set_rate(&mut self, omega: Vector3<f64>) {
        self.state.omega = omega;
    }

    /// Takes a measured rate of a joint, rad/s.
    pub(crate) fn set_joint_rate(&mut self, joint: usize, value: f64) {
        if let Some([_, rate]) = self.state.devices.states_mut().nth(joint) {
            *rate = value;
        }
    }

    /// Takes a measured coordinate of a joint, rad.
    pub(crate) fn set_coordinate(&mut self, joint: usize, value: f64) {
        if let Some([coordinate, _]) = self.state.devices.states_mut().nth(joint) {
            *coordinate = value;
        }
    }

    /// Takes the torque of a motor, N m.
    pub(crate) fn set_motor(&mut self, joint: usize, value: f64) {
        if let Some(motor) = self.inputs.motors.values_mut().nth(joint) {
            *motor = value;
        }
    }

    pub(crate) fn joint_rate(&self, joint: usize) -> f64 {
        self.state.devices.states().nth(joint).map_or(0.0, |[_, rate]| rate)
    }

    /// Dry friction of a joint at the present rate where it is 1 N m, with the sense of a torque, N m.
    pub(super) fn friction(&self, joint: usize) -> f64 {
        let rate = self.joint_rate(joint);
        let slow = self.slow.get(joint).copied().unwrap_or(0.0);
        if rate == 0.0 { 0.0 } else { -rate / libm::hypot(rate, slow) }
    }

    pub(super) fn motor(&self, joint: usize) -> f64 {
        self.inputs.motors.values().nth(joint).unwrap_or(0.0)
    }

    /// Turns all wheels.
    fn turn(&self, angle: f64) -> CraftState {
        let mut state = self.state.clone();
        for ([coordinate, _], _) in
            state.devices.states_mut().zip(&self.wheels).filter(|(_, wheel)| **wheel)
        {
            *coordinate = angle;
        }
        state
    }

    fn at(&self, state: &CraftState, inputs: &CraftInputs) -> Result<Accelerations, WatchError> {
        let found = self.evaluator.accelerations(state, inputs).map_err(WatchError::Solve)?;
        Ok(Accelerations { hub: found.omega_dot, joints: found.devices.values().collect() })
    }

    /// Accelerations at what was measured last, without the imbalance of the wheels: the mean over two angles half a turn apart.
    pub(crate) fn mean(&self) -> Result<Accelerations, WatchError> {
        let [mut first, second] = [0.0, PI].map(|angle| self.at(&self.turn(angle), &self.inputs));
        if let (Ok(first), Ok(second)) = (&mut first, second) {
            first.hub = (first.hub + second.hub) * 0.5;
            for (to, other) in first.joints.iter_mut().zip(second.joints) {
                *to = f64::midpoint(*to, other);
            }
        }
        first
    }

    /// What one N m of a joint's motor accelerates the joint by, rad/s².
    pub(super) fn by_motor(&self, joint: usize) -> Result<f64, WatchError> {
        let mut inputs = self.inputs.clone();
        let without = self.at(&self.state, &inputs)?;
        if let Some(motor) = inputs.motors.values_mut().nth(joint) {
            *motor += 1.0;
        }
        let with = self.at(&self.state, &inputs)?;
        Ok(with.joints.get(joint).zip(without.joints.get(joint)).map_or(0.0, |(a, b)| a - b))
    }

    /// The line of each rotor at the present rates and gimbal angles; exact in the coupled equations of a rigid hub
    /// at rest.
    pub(super) fn signatures(&self) -> Result<Vec<Signature>, EvaluationError> {
        let names: Vec<String> = self
            .rotors
            .iter()
            .flat_map(|of| {
                ["static", "dynamic"].map(|kind| format!("{}.{kind}_imbalance", of.name))
            })
            .collect();
        let joints = (0..self.wheels.len()).map(Variable::Rate);
        let variables: Vec<Variable> =
            [Axis::X, Axis::Y, Axis::Z].map(Variable::Omega).into_iter().chain(joints).collect();
        let mut columns = Vec::new();
        let mut coupling = Matrix3::zeros();
        for angle in [0.0, FRAC_PI_2] {
            let mut state = self.turn(angle);
            state.omega = Vector3::zeros();
            let inputs = self.evaluator.no_inputs();
            let found =
                self.evaluator.linearize(&state, &inputs, &Outputs::accelerations(), &names)?;
            let row = |of: &Variable| {
                let name = self.evaluator.variable_name(*of);
                found.states.iter().position(|of| *of == name)
            };
            let rows: Vec<Option<usize>> = variables.iter().map(row).collect();
            let column = |index: usize| -> Vec<f64> {
                rows.iter().map(|row| row.map_or(0.0, |row| found.p[(row, index)])).collect()
            };
            let element = |i: usize, j: usize| match (rows.get(i), rows.get(j)) {
                (Some(Some(i)), Some(Some(j))) => found.a[(*i, *j)],
                _ => 0.0,
            };
            coupling += Matrix3::from_fn(element) * 0.5;
            columns.push((0..names.len()).map(column).collect::<Vec<_>>());
        }
        let [start, quarter] = [0, 1].map(|index| columns.get(index).cloned().unwrap_or_default());
        // Re(A exp(i theta)) is Re A at zero and -Im A at a quarter of a turn.
        let line = |index: usize| -> Vec<Complex<f64>> {
            match (start.get(index), quarter.get(index)) {
                (Some(re), Some(im)) => {
                    re.iter().zip(im).map(|(re, im)| Complex::new(*re, -im)).collect()
                }
                _ => vec![Complex::new(0.0, 0.0); variables.len()],
            }
        };
        let each = self.rotors.iter().enumerate().map(|(index, rotor)| {
            let both = [line(2 * index), line(2 * index + 1)];
            let of_joint = |joint: usize| both.each_ref().map(|of| of[3 + joint]);
            Signature {
                by_imbalance: both.each_ref().map(|of| Vector3::new(of[0], of[1], of[2])),
                by_joint: (0..self.wheels.len()).map(of_joint).collect(),
                rate: self.joint_rate(rotor.joint),
                coupling,
            }
        });
        Ok(each.collect())
    }
}
