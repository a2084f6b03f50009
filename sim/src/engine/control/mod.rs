//! [`Controls`]: the controllers of a run: when they sample, what they read, and when what they command acts.
//!
//! At one time, after the changes of `[[at]]` have been made: every controller that samples then reads the state and
//! computes; then what is due acts, controller by controller in their order, and is held. That of a sample without delay
//! is due at its own time. It is the same at the start of a run as at any other time.

mod allocation;
mod clock;
pub(crate) mod linear;
mod servo;

use std::collections::VecDeque;

use nalgebra::Vector3;
use precess_control::{Motion, Sample};
use precess_craft::{SteeringDevices, SteeringSums};
use precess_dynamics::{JointStates, Steered};

use super::equations::motors::{MotorState, POWER};
use super::equations::system::System;
use super::integration::Moment;
use crate::control::{
    Command, Controller, ControllerError, ControllerSample, Greeting, LawController,
    ProgramController,
};
use crate::record::RunError;
use crate::scenario::{BuiltGuidance, ControlLaw, SampledController, Scenario, body_key};
use allocation::{Allocated, Allocator, Available, Pose};
use clock::{Clock, reached};
use servo::motor_torques;

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
    samples: Clock,
    /// When torques are computed from commands, beside the times at which these come to act.
    ticks: Option<Clock>,
    /// What is to act, and when.
    pending: VecDeque<(f64, Pending)>,
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
enum Pending {
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
            let acting = control.pending.front().map(|(at, _)| *at);
            let tick = control.ticks.as_ref().map(Clock::next);
            [Some(control.samples.next()), acting, tick]
        });
        let coming = times.flatten().filter(|at| *at > time && !reached(self.duration, *at));
        coming.fold(f64::INFINITY, f64::min)
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
    fn joints(&self, system: &System<'_>) -> Vec<Available> {
        let at_limit = |joint: usize| {
            system.acting.motors().get(joint).is_some_and(|motor| *motor != MotorState::Commanded)
        };
        let joint = |of: &crate::scenario::CommandedJoint| Available {
            joint: of.joint,
            steered: of.steered,
            limits: system.acting.drive(of.joint).limits(),
            commanded: system.acting.held.torque(of.joint).is_some(),
            at_limit: at_limit(of.joint),
        };
        self.of.joints.iter().map(joint).collect()
    }

    /// Reads the state, computes, and puts the answer off by the delay.
    fn sample(
        &mut self,
        index: usize,
        (system, time, moment): (&mut System<'_>, f64, &Moment),
        (steering, wheels): (&mut SteeringDevices, &[bool]),
    ) -> Result<(), RunError> {
        let state = &moment.state;
        let all: Vec<[f64; 2]> = state.devices.states().collect();
        let sums = steering.terms(all.iter().copied(), &state.omega);
        let mut sums = sums.map_err(|error| self.error(time, error.into()))?;
        // What the imbalance of a wheel requires turns with it: held, it would be a torque of its own.
        let turning = sums.by_rate.iter_mut().zip(&sums.by_acceleration).zip(wheels);
        for ((by_rate, n), _) in turning.filter(|(_, wheel)| **wheel) {
            *by_rate = state.omega.cross(n);
        }
        let joints = self.joints(system);
        let elapsed = if self.sampled { 1.0 / self.of.rate } else { 0.0 };
        let of = Sample {
            motion: Motion { attitude: state.attitude, omega: state.omega },
            reference: self.guidance.at(time),
            momentum: sums.momentum,
            external: Vector3::zeros(),
            elapsed,
            limited: self.limited || joints.iter().any(|of| of.commanded && of.at_limit),
        };
        let own: Vec<_> =
            self.of.joints.iter().filter_map(|of| all.get(of.joint)).copied().collect();
        let answered = self.controller.sample(&ControllerSample { time, of, joints: &own });
        let answer = answered.and_then(|answer| checked(answer, own.len()));
        let answer = answer.map_err(|error| self.error(time, error))?;
        self.sampled = true;
        let rates: Vec<f64> = all.iter().map(|[_, rate]| *rate).collect();
        let computed = match answer {
            Command::Motors(torques) => {
                let at_limit = limited(&joints, &torques, &rates);
                (self.bounded, self.limited) = (0, at_limit > 0);
                write(index, system, None, at_limit);
                Pending::Torques(torques)
            }
            Command::Torque(torque) => {
                let pose = Pose { joints: &joints, rates: &rates, omega: &state.omega };
                self.commanded(index, (system, time, moment), (&torque, pose), &sums)?
            }
        };
        self.pending.push_back((time + self.of.delay, computed));
        Ok(())
    }

    /// What joints and motors are to do for a torque on the spacecraft.
    fn commanded(
        &mut self,
        index: usize,
        (system, time, moment): (&mut System<'_>, f64, &Moment),
        (torque, pose): (&Vector3<f64>, Pose<'_>),
        sums: &SteeringSums,
    ) -> Result<Pending, RunError> {
        let allocated = self.allocator.allocate(self.of, (time, torque), pose, sums);
        let allocated = allocated.map_err(|error| self.error(time, error.into()))?;
        let joints = pose.joints;
        let (pending, at_limit) = if self.ticks.is_some() {
            (Pending::Commands(allocated.commands.clone()), 0)
        } else {
            let gain = self.of.servo.gain;
            let of = motor_torques(system, (time, moment), joints, &allocated.commands, gain);
            let torques = of.map_err(|source| RunError::solve(system, time, source))?;
            let at_limit = limited(joints, &torques, pose.rates);
            (Pending::Torques(torques), at_limit)
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
        while self.pending.front().is_some_and(|(at, _)| reached(*at, time)) {
            match self.pending.pop_front() {
                Some((_, Pending::Torques(torques))) => {
                    self.present = None;
                    hold(self.of, system, &torques);
                }
                Some((_, Pending::Commands(commands))) => {
                    self.present = Some(commands);
                    computes = true;
                }
                None => {}
            }
        }
        let Some(commands) = self.present.as_ref().filter(|_| computes) else { return Ok(()) };
        let joints = self.joints(system);
        let torques = motor_torques(system, (time, moment), &joints, commands, self.of.servo.gain);
        let torques = torques.map_err(|source| RunError::solve(system, time, source))?;
        let rates: Vec<f64> = moment.state.devices.states().map(|[_, rate]| rate).collect();
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

/// The controller of a scenario.
fn controller_of(
    scenario: &Scenario,
    of: &SampledController,
) -> Result<Box<dyn Controller>, ControllerError> {
    let law = of.law.built(|| scenario.inertia_at_start()).map_err(ControllerError::Parameter)?;
    if let Some(law) = law {
        return Ok(Box::new(LawController(law)));
    }
    let ControlLaw::Program { command, folder, time_limit } = &of.law else {
        return Err(ControllerError::Program { reason: "it has no law".to_owned() });
    };
    let all: Vec<_> = scenario.joints().collect();
    let named = |own: &crate::scenario::CommandedJoint| {
        let (_, device, info) = all.get(own.joint)?;
        let name = format!("{device}.{}", body_key(info));
        Some((name, own.steered == Steered::Rate))
    };
    let joints: Vec<_> = of.joints.iter().filter_map(named).collect();
    let greeting = Greeting {
        name: &of.name,
        times: [of.rate, of.offset, of.delay],
        joints: &joints,
        inertia: scenario.inertia_at_start(),
    };
    Ok(Box::new(ProgramController::start(command, folder, *time_limit, &greeting)?))
}

/// Holds torques of the joints of a controller.
fn hold(of: &SampledController, system: &mut System<'_>, torques: &[f64]) {
    for (of, torque) in of.joints.iter().zip(torques) {
        system.acting.held.hold(of.joint, *torque);
    }
}

/// Of how many joints the motor is at a limit that depends on the rate, or the torque is beyond the largest one or the
/// power.
fn limited(joints: &[Available], torques: &[f64], rates: &[f64]) -> usize {
    let beyond = |(of, torque): &(&Available, &f64)| {
        let rate = rates.get(of.joint).copied().unwrap_or_default();
        let power = of.limits.power.map_or(f64::INFINITY, |power| power * (1.0 + POWER));
        let torque_max = of.limits.torque.map_or(f64::INFINITY, f64::abs);
        of.commanded && (of.at_limit || torque.abs() > torque_max || **torque * rate > power)
    };
    joints.iter().zip(torques).filter(beyond).count()
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
