//! [`System`]: the equations of motion of a scenario, as an integrator evaluates them.
//!
//! Work is what sources other than gravity and springs do on the motion: motors, friction, wrenches
//! from outside, what holds a prescribed hub. Where only motors and a force on the hub act, it is
//! computed from the inputs; otherwise from the solver's ledger, at about the cost of another
//! evaluation.

use std::cell::{Cell, RefCell};

use precess_dynamics::kind::Each;
use precess_dynamics::{
    Accelerations, Attitude, Gravity, HubMode, ImbalanceModel, Inputs, JointArray, Mode, Passive,
    Power, SolveError, Spacecraft, State,
};

use super::inputs::Acting;
use super::packing::Layout;
use crate::scenario::{Scenario, Set};

/// The equations of motion.
pub(crate) struct System<'a> {
    pub(crate) spacecraft: Spacecraft<Set>,
    pub(crate) layout: Layout,
    pub(crate) acting: Acting<'a>,
    /// Whether something other than motors and a force on the hub does work, drives aside.
    sources: bool,
    /// Whether gravity or a spring acts.
    potential: bool,
    scratch: RefCell<Scratch>,
    evaluations: Cell<u64>,
}

/// What an evaluation writes before it calls the solver.
struct Scratch {
    state: State<Set>,
    inputs: Inputs<Set>,
}

impl<'a> System<'a> {
    pub(crate) fn new(scenario: &'a Scenario, spacecraft: Spacecraft<Set>) -> Self {
        let layout = Layout::new(scenario);
        let acting = Acting::new(scenario, &layout.joints);
        let passive = |is: fn(&Passive) -> bool| {
            scenario.devices.iter().any(|device| {
                let joints = device.kind().joints().len();
                device.parameters().passive.iter().take(joints).any(is)
            })
        };
        let potential =
            scenario.gravity != Gravity::None || passive(|joint| joint.stiffness != 0.0);
        let sources = potential
            || passive(|joint| *joint != Passive::none())
            || acting.on_joints()
            || lumped(scenario)
            || matches!(scenario.hub_mode, HubMode::Prescribed { .. });
        let inputs = acting.inputs(scenario, &spacecraft);
        let state = State::at_rest_for(&spacecraft);
        Self {
            spacecraft,
            layout,
            acting,
            sources,
            potential,
            scratch: RefCell::new(Scratch { state, inputs }),
            evaluations: Cell::new(0),
        }
    }

    /// Evaluations of the equations of motion so far.
    pub(crate) fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }

    /// Counts evaluations that an integrator makes by itself.
    pub(crate) fn count(&self, evaluations: u64) {
        self.evaluations.set(self.evaluations.get() + evaluations);
    }

    /// Whether the solver's ledger is needed for the work.
    pub(crate) fn needs_ledger(&self) -> bool {
        self.sources || !self.acting.all_driven()
    }

    /// Whether there is a potential energy.
    pub(crate) fn has_potential(&self) -> bool {
        self.potential
    }

    /// Inputs at a time and state.
    pub(crate) fn inputs(&self, time: f64, state: &State<Set>) -> Inputs<Set> {
        let mut inputs = self.scratch.borrow().inputs.clone();
        self.acting.fill(time, state, &mut inputs);
        inputs
    }

    /// Time derivatives of a flat state.
    pub(crate) fn rates(&self, time: f64, y: &[f64], dydt: &mut [f64]) -> Result<(), SolveError> {
        self.count(1);
        let Scratch { state, inputs } = &mut *self.scratch.borrow_mut();
        self.layout.unpack(y, state);
        self.acting.fill(time, state, inputs);
        let found = self.spacecraft.accelerations(state, inputs)?;
        let bn = state.attitude.dcm();
        // The solver's inertial acceleration is expressed in B; positions are expressed in N.
        let acceleration = bn.tr_mul(&found.r_b_n_ddot);
        let quaternion_rate = Layout::attitude(y).rate(&state.omega);
        let hub = [
            state.r_b_n_dot.as_slice(),
            acceleration.as_slice(),
            quaternion_rate.as_slice(),
            found.omega_dot.as_slice(),
        ];
        let powers = self.powers(state, inputs, &found)?;
        self.layout.pack_rates(y, hub, found.devices.values(), powers, dydt);
        Ok(())
    }

    /// Power of all sources but gravity and springs; and the sum of magnitudes that makes the unit
    /// of energy drift, W.
    fn powers(
        &self,
        state: &State<Set>,
        inputs: &Inputs<Set>,
        found: &Accelerations<Set>,
    ) -> Result<[f64; 2], SolveError> {
        let rates = state.devices.iter().flat_map(JointArray::as_slice);
        let motors = inputs.motors.values().zip(rates).zip(inputs.modes.values());
        let mut throughput = 0.0;
        if self.needs_ledger() {
            let power = self.spacecraft.ledger(state, inputs, found)?.power;
            let mut computed = power.motors;
            for ((torque, [_, rate]), mode) in motors {
                if mode == Mode::Driven {
                    throughput += (torque * rate).abs();
                    computed -= torque * rate;
                }
            }
            throughput += computed.abs() + power.friction.abs() + power.hub.abs();
            return Ok([work_of(&power), throughput]);
        }
        // dW/dt = F . v_B + L_B . omega + sum(u * rate)
        let mut power = inputs.force.dot(&(state.attitude.dcm() * state.r_b_n_dot));
        power += inputs.torque_b.dot(&state.omega);
        for ((torque, [_, rate]), _) in motors {
            power += torque * rate;
            throughput += (torque * rate).abs();
        }
        Ok([power, throughput])
    }
}

/// What is counted as work of a step or as its rate: all but gravity and springs, whose energy is
/// counted as energy.
pub(crate) fn work_of(power: &Power) -> f64 {
    power.external + power.hub + power.motors + power.friction
}

/// Whether a wheel's imbalance is modelled as a disturbance from outside.
pub(crate) fn lumped(scenario: &Scenario) -> bool {
    scenario.devices.iter().any(|device| device.parameters().model == ImbalanceModel::Lumped)
}
