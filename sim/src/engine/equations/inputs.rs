//! [`SegmentInputs`]: forces, torques and modes at a time, from drives, profiles, wrenches and disturbances.
//!
//! Between two changes no profile jumps, because a segment ends at each of its breaks. At the end
//! of a segment a profile has its value before the jump, at the start the one after it.

use std::{iter, ptr};

use nalgebra::Vector3;
use precess_control::Checkpoint;
use precess_dynamics::kind::Each;
use precess_dynamics::{Attitude, JointStates, ListedModes, ModalPoint, Mode, Wrench};

use super::commands::HeldCommands;
use super::disturbances::Disturbances;
use super::friction::{Contact, Frictions};
use super::kinematics::{Chain, axes};
use super::motors::MotorState;
use super::packing::JointPlace;
use crate::disturbance::Six;
use crate::scenario::{
    Action, AppliedWrench, Drive, JointFriction, Profile, Scenario, Target, WrenchAxes,
};
use precess_craft::{Craft, CraftInputs, CraftState};

/// Steps in a cycle of the fastest profile while the state does not show it: each step is searched at five times.
const STEPS_PER_CYCLE: f64 = 4.0;

/// A locked joint.
pub(crate) const LOCKED: &Drive = &Drive::Locked;

/// What acts on the spacecraft during a segment.
#[derive(Clone, Debug)]
pub(crate) struct SegmentInputs<'a> {
    /// The present drive of each joint.
    drives: Vec<&'a Drive>,
    /// Whether each joint has a motor as an input; otherwise its kind keeps its rate.
    driven: Vec<bool>,
    /// Which limit each motor is at.
    motors: Vec<MotorState>,
    /// What controllers and a program command.
    pub(crate) held: HeldCommands,
    wrenches: Vec<WrenchOnBody<'a>>,
    disturbances: Disturbances<'a>,
    pub(crate) friction: Frictions<'a>,
    chains: Vec<Chain>,
    /// Highest frequency of a torque or a wrench, Hz.
    highest: f64,
    start: f64,
    end: f64,
}

/// What a wrench acts on.
#[derive(Clone, Debug)]
enum WrenchBody {
    /// The hub.
    Hub,
    /// Device, joint in the device, joint in the set.
    Body(usize, usize, usize),
    /// A point of the structure.
    Node(Box<ModalPoint<ListedModes>>),
}

/// A wrench, and of which body.
#[derive(Clone, Debug)]
struct WrenchOnBody<'a> {
    wrench: &'a AppliedWrench,
    on: WrenchBody,
}

impl<'a> SegmentInputs<'a> {
    pub(crate) fn new(scenario: &'a Scenario, joints: &[JointPlace]) -> Self {
        let placed = |wrench: &'a AppliedWrench| {
            let on = match wrench.body {
                Target::Hub => Some(WrenchBody::Hub),
                Target::Joint(joint) => {
                    let place = joints.get(joint);
                    place.map(|place| WrenchBody::Body(place.device, place.info.index, joint))
                }
                Target::Node(node) => {
                    let nodes = scenario.structure.as_ref().map(|structure| &structure.nodes);
                    let node = nodes.and_then(|nodes| nodes.get(node));
                    node.map(|node| WrenchBody::Node(Box::new(node.point())))
                }
            };
            // A checked scenario has every joint and node that it names.
            on.map(|on| WrenchOnBody { wrench, on })
        };
        let acts = |wrench: &&AppliedWrench| {
            !wrench.force.iter().chain(&wrench.moment).all(Profile::is_zero)
        };
        Self {
            drives: scenario.drives.iter().collect(),
            driven: joints.iter().map(|place| place.info.driven).collect(),
            motors: vec![MotorState::default(); joints.len()],
            held: HeldCommands::new(scenario),
            wrenches: scenario.wrenches.iter().filter(acts).filter_map(placed).collect(),
            disturbances: Disturbances::new(scenario, joints),
            friction: Frictions::new(scenario),
            highest: scenario.profiles().map(Profile::highest_frequency).fold(0.0, f64::max),
            chains: Chain::all(&scenario.devices),
            start: 0.0,
            end: 0.0,
        }
    }

    /// Inputs with everything that does not depend on time.
    pub(crate) fn inputs(&self, scenario: &Scenario, craft: &Craft) -> CraftInputs {
        let mut inputs = craft.no_inputs();
        inputs.hub = scenario.hub_mode;
        inputs.gravity = scenario.gravity;
        if self.on_joints() {
            inputs.bodies = Some(craft.no_wrenches());
        }
        inputs
    }

    /// Visits what changes from segment to segment. Turns of angles are those of an integration with a tolerance.
    pub(crate) fn visit(&mut self, scenario: &'a Scenario, checkpoint: &mut Checkpoint<'_>) {
        let changed = scenario.changes.iter().filter_map(|change| match &change.action {
            Action::Drive(drive) => Some(drive),
            Action::Brake | Action::Release => None,
        });
        let all: Vec<&'a Drive> =
            iter::once(LOCKED).chain(&scenario.drives).chain(changed).collect();
        for present in &mut self.drives {
            // One that no file states is that of a brake or a stop, the first.
            let found = all.iter().position(|of| ptr::eq(*of, *present));
            let mut index = found.unwrap_or_default();
            checkpoint.index(&mut index, all.len());
            *present = all.get(index).copied().unwrap_or(LOCKED);
        }
        for motor in &mut self.motors {
            motor.visit(checkpoint);
        }
        self.held.visit(checkpoint);
        self.friction.visit(checkpoint);
        checkpoint.numbers([&mut self.start, &mut self.end]);
    }

    /// Begins a segment.
    pub(crate) fn begin(&mut self, start: f64, end: f64) {
        (self.start, self.end) = (start, end);
    }

    /// The present drive of a joint.
    pub(crate) fn drive(&self, joint: usize) -> &'a Drive {
        self.drives.get(joint).copied().unwrap_or(LOCKED)
    }

    /// Replaces the drive of a joint, and its controller where it has one.
    pub(crate) fn set_drive(&mut self, joint: usize, drive: &'a Drive) {
        if let Some(present) = self.drives.get_mut(joint) {
            *present = drive;
        }
        self.held.set_replaced(joint, true);
        self.set_motor(joint, MotorState::Commanded);
    }

    /// Gives a joint back to its controller, with the drive that it had at the start.
    pub(crate) fn release(&mut self, joint: usize, drive: &'a Drive) {
        self.set_drive(joint, drive);
        self.held.set_replaced(joint, false);
    }

    /// Which limit each motor is at.
    pub(crate) fn motors(&self) -> &[MotorState] {
        &self.motors
    }

    /// Sets which limit a motor is at.
    pub(crate) fn set_motor(&mut self, joint: usize, state: MotorState) {
        if let Some(present) = self.motors.get_mut(joint) {
            *present = state;
        }
    }

    /// The torque of a joint's profile or controller within the largest one, N m or N; zero of another drive.
    pub(crate) fn commanded(&self, joint: usize, time: f64) -> f64 {
        let time = time.clamp(self.start, self.end);
        match self.drive(joint) {
            drive @ Drive::Torque { profile, .. } => {
                let of_profile = || profile.at(time, time > self.start);
                drive.limits().clipped(self.held.torque(joint).unwrap_or_else(of_profile))
            }
            Drive::Acceleration(_) | Drive::Locked => 0.0,
        }
    }

    /// The largest magnitude of that torque at any time, or a bound of it, N m or N.
    pub(crate) fn largest_torque(&self, joint: usize) -> f64 {
        let drive = self.drive(joint);
        let of_profile = drive.profile().map_or(0.0, Profile::bound);
        let of_profile = self.held.torque(joint).map_or(of_profile, f64::abs);
        drive.limits().torque.map_or(of_profile, |limit| limit.abs().min(of_profile))
    }

    /// Lets joints with dry friction slide with the rates of a state; returns the first that is at rest by itself.
    pub(crate) fn sliding_at(&mut self, time: f64, state: &CraftState) -> Option<usize> {
        let rates: Vec<_> = state.devices.states().map(|[_, rate]| rate).collect();
        let dry: Vec<_> = self.friction.dry().map(|(of, _)| of.joint).collect();
        for joint in &dry {
            let rate = rates.get(*joint).copied().unwrap_or_default();
            self.friction.set(*joint, Contact::Slides(rate.signum()));
        }
        let at_rest = |joint: &usize| rates.get(*joint) == Some(&0.0);
        dry.into_iter().find(|joint| at_rest(joint) && self.motor(*joint, time).is_some())
    }

    /// The bodies of each device and platform.
    pub(crate) fn chains(&self) -> &[Chain] {
        &self.chains
    }

    /// Whether a wrench, a disturbance, or what a controller or a program commands acts from outside.
    pub(crate) fn has_wrenches(&self) -> bool {
        let none = self.wrenches.is_empty() && self.disturbances.is_empty();
        !none || self.held.external().is_some() || self.held.on_hub().is_some()
    }

    /// Whether one acts on the child body of a joint.
    pub(crate) fn on_joints(&self) -> bool {
        self.wrenches.iter().any(|placed| matches!(placed.on, WrenchBody::Body(..)))
            || self.disturbances.on_joints()
    }

    /// Takes over the whole turns that were taken off each joint's angle.
    pub(crate) fn set_turns(&self, turns: &[f64]) {
        self.disturbances.set_turns(turns);
    }

    /// Force, N, and moment, N m, of each disturbance, along the axes of its data sheet.
    pub(crate) fn disturbances(&self, time: f64, state: &CraftState) -> Vec<Six<f64>> {
        let time = time.clamp(self.start, self.end);
        self.disturbances.wrenches(time, time > self.start, state)
    }

    /// The longest step that resolves the disturbances at these rates of the joints and, while a joint sticks or a motor is
    /// at one of its limits, the profiles, s: the state does not show them then.
    pub(crate) fn longest_step(&self, rate: impl Fn(usize) -> f64) -> f64 {
        let sticks = |(of, contact): (&JointFriction, Contact)| {
            contact == Contact::Sticks && self.motor(of.joint, self.start).is_some()
        };
        let limited = self.motors.iter().any(|motor| *motor != MotorState::Commanded);
        let hidden = limited || self.friction.dry().any(sticks);
        let of_profiles =
            if hidden { 1.0 / (STEPS_PER_CYCLE * self.highest) } else { f64::INFINITY };
        self.disturbances.longest_step(rate).min(of_profiles)
    }

    /// The torque or force of a joint's motor at a time, of a joint at rest, N m or N; none where its motion is
    /// prescribed.
    pub(crate) fn motor(&self, joint: usize, time: f64) -> Option<f64> {
        let is_driven = self.driven.get(joint) == Some(&true);
        let drive = Some(self.drive(joint))
            .filter(|drive| is_driven && matches!(drive, Drive::Torque { .. }))?;
        match self.motors.get(joint) {
            Some(MotorState::LargestRate(_)) => None,
            Some(MotorState::Beyond(sign)) => Some(-sign * drive.limits().torque?.abs()),
            _ => Some(self.commanded(joint, time)),
        }
    }

    /// The same, none also of a motor whose torque depends on the rate.
    pub(crate) fn motor_of_profile(&self, joint: usize, time: f64) -> Option<f64> {
        let depends = self.motors.get(joint) == Some(&MotorState::LargestPower);
        self.motor(joint, time).filter(|_| !depends)
    }

    /// Gives motors the state that they have at the rates of a state by themselves; returns the first of which the rate is
    /// the largest or beyond it.
    pub(crate) fn limited_at(&mut self, time: f64, state: &CraftState) -> Option<usize> {
        let rates: Vec<_> = state.devices.states().map(|[_, rate]| rate).collect();
        for (joint, rate) in rates.into_iter().enumerate() {
            let limits = self.drive(joint).limits();
            if limits.rate.is_some_and(|limit| rate.abs() >= limit) {
                return Some(joint);
            }
            if limits.power.is_some_and(|power| self.commanded(joint, time) * rate > power) {
                self.set_motor(joint, MotorState::LargestPower);
            }
        }
        None
    }

    /// Whether the motor torque of every moving joint is an input.
    pub(crate) fn all_driven(&self) -> bool {
        let held = |motor: &MotorState| matches!(motor, MotorState::LargestRate(_));
        let joints = self.drives.iter().zip(&self.driven);
        !self.motors.iter().any(held)
            && joints.into_iter().all(|(drive, driven)| {
                *driven && matches!(drive, Drive::Torque { .. } | Drive::Locked)
            })
    }

    /// Whether nothing that acts depends on time or state, until a drive is replaced.
    #[cfg(feature = "lanes")]
    pub(crate) fn is_constant(&self) -> bool {
        let constant = |drive: &&Drive| match drive {
            Drive::Torque { profile, .. } | Drive::Acceleration(profile) => {
                profile.is_constant() && !drive.limits().depend_on_rate()
            }
            Drive::Locked => true,
        };
        !self.has_wrenches() && self.drives.iter().all(constant)
    }

    /// Writes what depends on time, and on the attitude of the bodies.
    pub(crate) fn fill(&self, time: f64, state: &CraftState, inputs: &mut CraftInputs) {
        self.fill_without_friction(time, state, inputs);
        self.friction.add(state, inputs);
    }

    /// As [`Self::fill`], but for friction that sticks and drag.
    pub(crate) fn fill_without_friction(
        &self,
        time: f64,
        state: &CraftState,
        inputs: &mut CraftInputs,
    ) {
        let time = time.clamp(self.start, self.end);
        let from_below = time > self.start;
        let at = |profile: &Profile| profile.at(time, from_below);
        let joints = inputs.motors.values_mut().zip(inputs.modes.values_mut());
        let drives = self.drives.iter().zip(&self.driven).zip(&self.motors);
        let of_states = state.devices.states();
        for (joint, (((motor, mode), ((drive, driven), at_limit)), [_, rate])) in
            joints.zip(drives).zip(of_states).enumerate()
        {
            if !driven {
                continue;
            }
            let commanded =
                |profile: &Profile| self.held.torque(joint).unwrap_or_else(|| at(profile));
            (*motor, *mode) = match drive {
                Drive::Torque { profile, limit: None } => (commanded(profile), Mode::Driven),
                Drive::Torque { profile, limit: Some(limits) } => {
                    at_limit.acting(commanded(profile), limits, rate)
                }
                Drive::Acceleration(profile) => (0.0, Mode::Prescribed(at(profile))),
                Drive::Locked => (0.0, Mode::Locked),
            };
        }
        // Of a program, which may have acted on the hub before.
        inputs.force = Vector3::zeros();
        inputs.torque_b = self.held.external().unwrap_or_else(Vector3::zeros);
        if !self.has_wrenches() {
            return;
        }
        let bn = state.attitude.dcm();
        if let Some(bodies) = &mut inputs.bodies {
            for wrench in bodies.values_mut() {
                *wrench = Wrench::none();
            }
        }
        inputs.modal.forces.fill(0.0);
        inputs.modal.mounts.fill(Wrench::none());
        if let Some([force, torque]) = self.held.on_hub() {
            inputs.force += force;
            inputs.torque_b += torque;
        }
        self.disturbances.add(time, from_below, state, inputs);
        for WrenchOnBody { wrench, on } in &self.wrenches {
            let vector = |of: &[Profile; 3]| Vector3::from(of.each_ref().map(at));
            let (mut force, mut moment) = (vector(&wrench.force), vector(&wrench.moment));
            if wrench.axes == WrenchAxes::Inertial {
                (force, moment) = (bn * force, bn * moment);
            }
            let (device, index, joint) = match on {
                WrenchBody::Hub => {
                    inputs.torque_b += moment;
                    inputs.add_force(&wrench.point, &force);
                    continue;
                }
                WrenchBody::Node(point) => {
                    inputs.add_wrench(point, &force, &moment);
                    continue;
                }
                WrenchBody::Body(device, index, joint) => (*device, *index, *joint),
            };
            if wrench.axes == WrenchAxes::Inertial {
                let joints: Vec<_> = state.devices.states().collect();
                let axes = axes(&self.chains, device, index, &joints);
                (force, moment) = (axes.tr_mul(&force), axes.tr_mul(&moment));
            }
            let bodies = inputs.bodies.as_mut();
            if let Some(sum) = bodies.and_then(|bodies| bodies.values_mut().nth(joint)) {
                let wrench = Wrench::at(&wrench.point, &force).plus(&Wrench::torque(&moment));
                *sum = sum.plus(&wrench);
            }
        }
    }
}
