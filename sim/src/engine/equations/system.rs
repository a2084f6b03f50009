//! [`System`]: the equations of motion of a scenario, as an integrator evaluates them.
//!
//! Work is what sources other than gravity and springs do on the motion: motors, friction, wrenches
//! from outside, what holds a prescribed hub. Where only motors and a force on the hub act, it is
//! computed from the inputs; otherwise from the solver's ledger, at about the cost of another
//! evaluation.

use std::cell::{Cell, RefCell};

use precess_control::Checkpoint;
use precess_dynamics::kind::Each;
use precess_dynamics::{Attitude, Gravity, HubMode, JointStates, Mode, Passive, Power, SolveError};

use super::inputs::SegmentInputs;
use super::packing::Layout;
use super::run_quantities::RunQuantities;
use crate::scenario::Scenario;
use precess_craft::{Craft, CraftAccelerations, CraftInputs, CraftState};

/// The equations of motion.
pub(crate) struct System<'a> {
    scenario: &'a Scenario,
    pub(crate) craft: Craft,
    pub(crate) layout: Layout,
    pub(crate) acting: SegmentInputs<'a>,
    pub(crate) quantities: RunQuantities,
    /// Whether something other than motors and a force on the hub does work, drives aside.
    sources: bool,
    /// Whether gravity or a spring acts.
    potential: bool,
    scratch: RefCell<Scratch>,
    evaluations: Cell<u64>,
}

/// What an evaluation writes before it calls the solver.
struct Scratch {
    state: CraftState,
    inputs: CraftInputs,
}

impl<'a> System<'a> {
    pub(crate) fn new(scenario: &'a Scenario, craft: Craft, quantities: RunQuantities) -> Self {
        let layout = Layout::new(scenario);
        let acting = SegmentInputs::new(scenario, &layout.joints);
        let passive = |is: fn(&Passive) -> bool| {
            scenario.members().any(|(_, member)| member.passive().iter().any(is))
        };
        let potential = scenario.gravity != Gravity::None
            || scenario.structure.is_some()
            || passive(|joint| joint.stiffness != 0.0)
            || scenario.members().any(|(_, member)| member.has_suspension());
        let sources = potential
            || passive(|joint| *joint != Passive::none())
            || acting.on_joints()
            || lumped(scenario)
            || matches!(scenario.hub_mode, HubMode::Prescribed { .. });
        let inputs = acting.inputs(scenario, &craft);
        let state = craft.at_rest();
        Self {
            scenario,
            craft,
            layout,
            acting,
            quantities,
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

    /// Visits what changes in the course of a run.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        self.acting.visit(self.scenario, checkpoint);
        checkpoint.count(self.evaluations.get_mut());
    }

    /// A joint's coordinate in the state that was evaluated last.
    pub(crate) fn evaluated_coordinate(&self, joint: usize) -> Option<f64> {
        let scratch = self.scratch.borrow();
        scratch.state.devices.states().nth(joint).map(|[coordinate, _]| coordinate)
    }

    /// Whether the solver's ledger is needed for the work.
    pub(crate) fn needs_ledger(&self) -> bool {
        self.sources || !self.acting.all_driven()
    }

    /// Whether there is a potential energy.
    pub(crate) fn has_potential(&self) -> bool {
        self.potential
    }

    /// The longest step that resolves what varies faster than the motion shows, s.
    pub(crate) fn longest_step(&self, y: &[f64]) -> f64 {
        self.acting.longest_step(|joint| self.layout.rate(joint, y))
    }

    /// What varies fastest of what is known of the scenario and of a flat state, which may be empty: for messages.
    pub(crate) fn fastest(&self, y: &[f64]) -> Option<String> {
        let joints = self.layout.joints.iter().enumerate().filter(|(_, place)| !place.info.slides);
        let turning = joints.filter(|_| !y.is_empty()).map(|(joint, place)| {
            let rate = self.layout.rate(joint, y).abs();
            let device = place.name.split('.').next().unwrap_or_default();
            (
                rate,
                format!("the {} of `{device}`, which turns at {rate:.3e} rad/s", place.info.body),
            )
        });
        let scales = self.scenario.time_scales().into_iter();
        let scales = scales.map(|scale| (scale.rate, scale.described()));
        let fastest = scales.chain(turning).filter(|(rate, _)| *rate > 0.0);
        fastest.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, what)| what)
    }

    /// Inputs at a time and state.
    pub(crate) fn inputs(&self, time: f64, state: &CraftState) -> CraftInputs {
        let mut inputs = self.scratch.borrow().inputs.clone();
        self.acting.fill(time, state, &mut inputs);
        inputs
    }

    /// Inputs at a time and state but for friction that sticks and drag.
    pub(crate) fn inputs_without_friction(&self, time: f64, state: &CraftState) -> CraftInputs {
        let mut inputs = self.scratch.borrow().inputs.clone();
        self.acting.fill_without_friction(time, state, &mut inputs);
        inputs
    }

    /// Time derivatives of a flat state.
    pub(crate) fn rates(&self, time: f64, y: &[f64], dydt: &mut [f64]) -> Result<(), SolveError> {
        self.count(1);
        let Scratch { state, inputs } = &mut *self.scratch.borrow_mut();
        self.layout.unpack(y, state);
        self.acting.fill(time, state, inputs);
        self.rates_of(y, (state, inputs), dydt)
    }

    /// The same with inputs held but for friction, which follows the rates.
    pub(crate) fn held_rates(
        &self,
        held: &CraftInputs,
        y: &[f64],
        dydt: &mut [f64],
    ) -> Result<(), SolveError> {
        self.count(1);
        let Scratch { state, .. } = &mut *self.scratch.borrow_mut();
        self.layout.unpack(y, state);
        let mut inputs = held.clone();
        self.acting.friction.add(state, &mut inputs);
        self.rates_of(y, (state, &inputs), dydt)
    }

    fn rates_of(
        &self,
        y: &[f64],
        (state, inputs): (&CraftState, &CraftInputs),
        dydt: &mut [f64],
    ) -> Result<(), SolveError> {
        let found = self.craft.accelerations(state, inputs)?;
        self.layout.pack_rates(y, state, &found, dydt);
        self.layout.pack_powers(self.powers(state, inputs, &found)?, dydt);
        Ok(())
    }

    /// Power of all sources but gravity and springs; and the sum of magnitudes that makes the unit
    /// of energy drift, W.
    fn powers(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<[f64; 2], SolveError> {
        let rates = state.devices.states();
        let motors = inputs.motors.values().zip(rates).zip(inputs.modes.values());
        let mut throughput = 0.0;
        if self.needs_ledger() {
            let power = self.craft.ledger(state, inputs, found)?.power;
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
    scenario.members().any(|(_, member)| member.is_lumped())
}
