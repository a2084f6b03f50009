//! [`Controls`]: the controllers of a run: when they sample, what they read, and when what they command acts.
//!
//! At one time, after the changes of `[[at]]` have been made: every controller that samples then reads the state and
//! computes; then what is due acts, controller by controller in their order, and is held. That of a sample without delay
//! is due at its own time. It is the same at the start of a run as at any other time.

mod allocation;
mod checkpoint;
mod clock;
mod limits;
pub(crate) mod linear;
mod own;
mod sensing;
mod servo;
mod specific_force;

use std::collections::VecDeque;

use nalgebra::Vector3;
use precess_control::Sample;
use precess_craft::{SteeringDevices, SteeringSums};
use precess_dynamics::JointStates;

use super::equations::motors::MotorState;
use super::equations::system::System;
use super::integration::Moment;
use crate::control::{Command, Controller, ControllerError, ControllerSample};
use crate::record::RunError;
use crate::scenario::{BuiltGuidance, SampledController, Scenario};
use allocation::{Allocated, Allocator, Available, Pose};
use clock::{Clock, reached};
use limits::limited;
use own::controller_of;
use sensing::{Measured, Sensing};
use servo::{ServoCommands, motor_torques};

/// All controllers of a run.
pub(crate) struct Controls<'a> {
    each: Vec<Control<'a>>,
    /// The devices on the hub.
    steering: Option<SteeringDevices>,
    /// Whether each joint is that of a wheel.
    wheels: Vec<bool>,
    duration: f64,
}

/// A controller in a run.
struct Control<'a> {
    of: &'a SampledController,
    guidance: BuiltGuidance,
    controller: Box<dyn Controller>,
    allocator: Allocator,
    sensing: Sensing,
    samples: Clock,
    /// When torques are computed from commands, beside the times at which these come to act.
    ticks: Option<Clock>,
    /// What is to act, and when.
    pending: VecDeque<Pending>,
    /// Rates and accelerations in force, from which torques are computed at ticks.
    present: Option<Vec<f64>>,
    /// Whether there was a sample before.
    sampled: bool,
    /// How many commands were at a bound at the last one.
    bounded: usize,
    /// Whether commands, torques or motors were at a limit since the last one.
    limited: bool,
}

/// What acts after a delay.
struct Pending {
    /// When, s.
    at: f64,
    /// External torque, B, N m; none of a controller without it.
    external: Option<Vector3<f64>>,
    joints: JointCommands,
}

/// What joints and motors are to do.
enum JointCommands {
    /// Torques of motors.
    Torques(Vec<f64>),
    /// Rates and accelerations, for the servo.
    Commands(Vec<f64>),
}

impl<'a> Controls<'a> {
    /// Those of a checked scenario; those of a program in the place of laws.
    pub(crate) fn new(
        scenario: &'a Scenario,
        own: Vec<(String, Box<dyn Controller>)>,
    ) -> Result<Self, RunError> {
        let mut each = Vec::new();
        let mut own = own;
        for of in &scenario.controllers {
            let failed = |source| RunError::Controller { time: 0.0, name: of.name.clone(), source };
            let guidance = of.reference.built();
            let controller = match own.iter().position(|(name, _)| *name == of.name) {
                Some(index) => own.swap_remove(index).1,
                None => controller_of(scenario, of).map_err(failed)?,
            };
            each.push(Control {
                of,
                guidance: guidance.map_err(|error| failed(ControllerError::Parameter(error)))?,
                controller,
                allocator: Allocator::new(of),
                sensing: Sensing::new(scenario, of).map_err(failed)?,
                samples: Clock::new(of.offset, of.rate),
                ticks: of.servo.rate.map(|rate| Clock::new(of.offset, rate)),
                pending: VecDeque::new(),
                present: None,
                sampled: false,
                bounded: 0,
                limited: false,
            });
        }
        if let Some((name, _)) = own.pop() {
            return Err(RunError::NoController { name });
        }
        let steering = if each.is_empty() {
            None
        } else {
            let (on_hub, ..) = &scenario.devices;
            Some(SteeringDevices::new(on_hub).map_err(RunError::Parameters)?)
        };
        let wheels = scenario.joints().map(|(.., info)| info.body == "wheel").collect();
        Ok(Self { each, steering, wheels, duration: scenario.settings.duration })
    }

    /// The next time after this one at which a controller samples or something comes to act, s; infinite where there is
    /// none before the end of the run. What is due at this time has been done.
    pub(crate) fn next_after(&self, time: f64) -> f64 {
        let times = self.each.iter().flat_map(|control| {
            let acting = control.pending.front().map(|of| of.at);
            let tick = control.ticks.as_ref().map(Clock::next);
            [Some(control.samples.next()), acting, tick]
        });
        let coming = times.flatten().filter(|at| *at > time && !reached(self.duration, *at));
        coming.fold(f64::INFINITY, f64::min)
    }

    /// Lets the bias of every gyro jump, rad/s, its axes.
    pub(crate) fn add_gyro_bias(&mut self, jump: &Vector3<f64>) {
        for control in &mut self.each {
            control.sensing.add_gyro_bias(jump);
        }
    }

    /// Does what is due at a time before the end of the run: samples, then what acts.
    pub(crate) fn act(
        &mut self,
        system: &mut System<'_>,
        time: f64,
        moment: &Moment,
    ) -> Result<(), RunError> {
        let Some(steering) = &mut self.steering else { return Ok(()) };
        if reached(self.duration, time) {
            return Ok(());
        }
        for (index, control) in self.each.iter_mut().enumerate() {
            if control.samples.due(time) {
                control.sample(index, (system, time, moment), (steering, &self.wheels))?;
            }
        }
        for (index, control) in self.each.iter_mut().enumerate() {
            control.hold_due(index, system, time, moment)?;
        }
        Ok(())
    }
}

impl Control<'_> {
    fn error(&self, time: f64, source: ControllerError) -> RunError {
        RunError::Controller { time, name: self.of.name.clone(), source }
    }

    /// Its joints as they are at present.
    fn joints(&self, system: &System<'_>, states: &[[f64; 2]]) -> Vec<Available> {
        let at_limit = |joint: usize| {
            system.acting.motors().get(joint).is_some_and(|motor| *motor != MotorState::Commanded)
        };
        let joint = |of: &crate::scenario::CommandedJoint| Available {
            joint: of.joint,
            steered: of.steered,
            limits: system.acting.drive(of.joint).limits(),
            state: states.get(of.joint).copied().unwrap_or_default(),
            commanded: system.acting.held.torque(of.joint).is_some(),
            at_limit: at_limit(of.joint),
        };
        self.of.joints.iter().map(joint).collect()
    }

    /// Coordinates and rates of all joints; those of its own as they are read.
    fn read_joints(&self, moment: &Moment) -> Vec<[f64; 2]> {
        let mut all: Vec<_> = moment.state.devices.states().collect();
        for of in &self.of.joints {
            if let Some(joint) = all.get_mut(of.joint) {
                *joint = self.sensing.joint(*joint);
            }
        }
        all
    }

    /// Reads the state, computes, and puts the answer off by the delay.
    fn sample(
        &mut self,
        index: usize,
        (system, time, moment): (&mut System<'_>, f64, &Moment),
        (steering, wheels): (&mut SteeringDevices, &[bool]),
    ) -> Result<(), RunError> {
        let measured = self.sensing.measure(system, time, &moment.state);
        let Measured { motion, values, specific_force } =
            measured.map_err(|error| self.error(time, error))?;
        let all = self.read_joints(moment);
        let sums = steering.terms(all.iter().copied(), &motion.omega);
        let mut sums = sums.map_err(|error| self.error(time, error.into()))?;
        // What the imbalance of a wheel requires turns with it: held, it would be a torque of its own.
        let turning = sums.by_rate.iter_mut().zip(&sums.by_acceleration).zip(wheels);
        for ((by_rate, n), _) in turning.filter(|(_, wheel)| **wheel) {
            *by_rate = motion.omega.cross(n);
        }
        let external = self.sensing.external(&sums.momentum);
        if let Some(written) = system.acting.held.values_mut(index) {
            written.measured = values;
            written.external = external.unwrap_or_default().into();
        }
        let joints = self.joints(system, &all);
        let elapsed = if self.sampled { 1.0 / self.of.rate } else { 0.0 };
        let of = Sample {
            motion,
            reference: self.guidance.at(time),
            momentum: sums.momentum,
            external: external.unwrap_or_default(),
            elapsed,
            limited: self.limited || joints.iter().any(|of| of.commanded && of.at_limit),
        };
        let own: Vec<_> =
            self.of.joints.iter().filter_map(|of| all.get(of.joint)).copied().collect();
        let answered =
            self.controller.sample(&ControllerSample { time, of, joints: &own, specific_force });
        let answer = answered.and_then(|answer| checked(answer, own.len()));
        let answer = answer.map_err(|error| self.error(time, error))?;
        self.sampled = true;
        let rates: Vec<f64> = all.iter().map(|[_, rate]| *rate).collect();
        let computed = match answer {
            Command::Motors(torques) => {
                let at_limit = limited(&joints, &torques, &rates);
                (self.bounded, self.limited) = (0, at_limit > 0);
                write(index, system, None, at_limit);
                JointCommands::Torques(torques)
            }
            Command::Torque(torque) => {
                let torque = self.sensing.torque(&torque);
                let pose = Pose { joints: &joints, rates: &rates, omega: &motion.omega };
                let acting = of.external;
                self.commanded(index, (system, time, moment), (&torque, &acting, pose), &sums)?
            }
        };
        // By the clock, not by `time`, which rounds up to what is due with it: else each command would be later than the one before.
        let at = self.samples.last() + self.of.delay;
        self.pending.push_back(Pending { at, external, joints: computed });
        Ok(())
    }

    /// What joints and motors are to do for a torque on the spacecraft.
    fn commanded(
        &mut self,
        index: usize,
        (system, time, moment): (&mut System<'_>, f64, &Moment),
        (torque, external, pose): (&Vector3<f64>, &Vector3<f64>, Pose<'_>),
        sums: &SteeringSums,
    ) -> Result<JointCommands, RunError> {
        let allocated = self.allocator.allocate(self.of, (time, torque), pose, sums);
        let allocated = allocated.map_err(|error| self.error(time, error.into()))?;
        let joints = pose.joints;
        let (pending, at_limit) = if self.ticks.is_some() {
            (JointCommands::Commands(allocated.commands.clone()), 0)
        } else {
            let commands = ServoCommands {
                joints,
                rates: pose.rates,
                commands: &allocated.commands,
                gain: self.of.servo.gain,
            };
            let torques = motor_torques(system, (time, moment), &commands, external);
            let torques = torques.map_err(|source| RunError::solve(system, time, source))?;
            let at_limit = limited(joints, &torques, pose.rates);
            (JointCommands::Torques(torques), at_limit)
        };
        let at_limit = at_limit.max(allocated.bounded);
        (self.bounded, self.limited) = (allocated.bounded, at_limit > 0);
        write(index, system, Some((torque, &allocated)), at_limit);
        Ok(pending)
    }

    /// Holds what is due, and the torques of commands in force.
    fn hold_due(
        &mut self,
        index: usize,
        system: &mut System<'_>,
        time: f64,
        moment: &Moment,
    ) -> Result<(), RunError> {
        let mut computes = self.ticks.as_mut().is_some_and(|ticks| ticks.due(time));
        while self.pending.front().is_some_and(|of| reached(of.at, time)) {
            let Some(pending) = self.pending.pop_front() else { break };
            if let Some(external) = pending.external {
                system.acting.held.hold_external(index, external);
            }
            match pending.joints {
                JointCommands::Torques(torques) => {
                    self.present = None;
                    hold(self.of, system, &torques);
                }
                JointCommands::Commands(commands) => {
                    self.present = Some(commands);
                    computes = true;
                }
            }
        }
        let Some(commands) = self.present.as_ref().filter(|_| computes) else { return Ok(()) };
        let states = self.read_joints(moment);
        let joints = self.joints(system, &states);
        let rates: Vec<f64> = states.iter().map(|[_, rate]| *rate).collect();
        let gain = self.of.servo.gain;
        let commands = ServoCommands { joints: &joints, rates: &rates, commands, gain };
        let external = system.acting.held.external().unwrap_or_default();
        let torques = motor_torques(system, (time, moment), &commands, &external);
        let torques = torques.map_err(|source| RunError::solve(system, time, source))?;
        let at_limit = limited(&joints, &torques, &rates).max(self.bounded);
        self.limited |= at_limit > 0;
        if let Some(values) = system.acting.held.values_mut(index) {
            #[expect(clippy::cast_precision_loss, reason = "as many as joints")]
            let count = at_limit as f64;
            values.limited = count;
        }
        hold(self.of, system, &torques);
        Ok(())
    }
}

/// Writes what was computed for the columns; of torques of motors nothing is but how many are at a limit.
fn write(
    index: usize,
    system: &mut System<'_>,
    computed: Option<(&Vector3<f64>, &Allocated)>,
    at_limit: usize,
) {
    let Some(values) = system.acting.held.values_mut(index) else { return };
    #[expect(clippy::cast_precision_loss, reason = "as many as joints")]
    let count = at_limit as f64;
    values.limited = count;
    let Some((torque, allocated)) = computed else { return values.clear() };
    values.torque = (*torque).into();
    values.torque_error = allocated.torque_error.into();
    values.commands.clone_from(&allocated.commands);
    values.measure = allocated.measure;
}

/// Holds torques of the joints of a controller.
fn hold(of: &SampledController, system: &mut System<'_>, torques: &[f64]) {
    for (of, torque) in of.joints.iter().zip(torques) {
        system.acting.held.hold(of.joint, *torque);
    }
}

/// An answer, where its numbers are finite and as many as there are joints.
fn checked(answer: Command, count: usize) -> Result<Command, ControllerError> {
    let numbers = match &answer {
        Command::Torque(torque) => torque.as_slice(),
        Command::Motors(torques) if torques.len() != count => {
            return Err(ControllerError::Count { expected: count, found: torques.len() });
        }
        Command::Motors(torques) => torques,
    };
    let wrong = numbers.iter().enumerate().find(|(_, value)| !value.is_finite());
    match wrong {
        Some((index, value)) => Err(ControllerError::NotFinite { index, value: *value }),
        None => Ok(answer),
    }
}
