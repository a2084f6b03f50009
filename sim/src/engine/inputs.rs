//! [`Acting`]: forces, torques and modes at a time, from drives, profiles and wrenches.
//!
//! Between two changes no profile jumps, because a segment ends at each of its breaks. At the end
//! of a segment a profile has its value before the jump, at the start the one after it.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{Attitude, Inputs, Mode, Spacecraft, State, Wrench};

use super::kinematics::Chain;
use super::packing::JointPlace;
use crate::scenario::{AppliedWrench, Drive, Profile, Scenario, Set, Target, WrenchAxes};

/// A locked joint.
pub(crate) const LOCKED: &Drive = &Drive::Locked;

/// What acts on the spacecraft during a segment.
#[derive(Clone, Debug)]
pub(crate) struct Acting<'a> {
    /// The present drive of each joint.
    drives: Vec<&'a Drive>,
    /// Whether each joint has a motor as an input; otherwise its kind keeps its rate.
    driven: Vec<bool>,
    wrenches: Vec<Placed<'a>>,
    chains: Vec<Chain>,
    start: f64,
    end: f64,
}

/// A wrench, and of which body.
#[derive(Clone, Debug)]
struct Placed<'a> {
    wrench: &'a AppliedWrench,
    /// Device, joint in the device, joint in the set; none for the hub.
    body: Option<(usize, usize, usize)>,
}

impl<'a> Acting<'a> {
    pub(crate) fn new(scenario: &'a Scenario, joints: &[JointPlace]) -> Self {
        let placed = |wrench: &'a AppliedWrench| {
            let body = match wrench.body {
                Target::Hub => None,
                Target::Joint(joint) => {
                    let place = joints.get(joint);
                    place.map(|place| (place.device, place.info.index, joint))
                }
            };
            Placed { wrench, body }
        };
        let acts = |wrench: &&AppliedWrench| {
            !wrench.force.iter().chain(&wrench.moment).all(Profile::is_zero)
        };
        Self {
            drives: scenario.drives.iter().collect(),
            driven: joints.iter().map(|place| place.info.driven).collect(),
            wrenches: scenario.wrenches.iter().filter(acts).map(placed).collect(),
            chains: scenario.devices.iter().map(Chain::new).collect(),
            start: 0.0,
            end: 0.0,
        }
    }

    /// Inputs with everything that does not depend on time.
    pub(crate) fn inputs(&self, scenario: &Scenario, spacecraft: &Spacecraft<Set>) -> Inputs<Set> {
        let mut inputs = Inputs::none_for(spacecraft);
        inputs.hub = scenario.hub_mode;
        inputs.gravity = scenario.gravity;
        if self.on_joints() {
            inputs.bodies = Some(Inputs::no_wrenches_for(spacecraft));
        }
        inputs
    }

    /// Begins a segment.
    pub(crate) fn begin(&mut self, start: f64, end: f64) {
        (self.start, self.end) = (start, end);
    }

    /// The present drive of a joint.
    pub(crate) fn drive(&self, joint: usize) -> &'a Drive {
        self.drives.get(joint).copied().unwrap_or(LOCKED)
    }

    /// Replaces the drive of a joint.
    pub(crate) fn set_drive(&mut self, joint: usize, drive: &'a Drive) {
        if let Some(present) = self.drives.get_mut(joint) {
            *present = drive;
        }
    }

    /// The bodies of each device.
    pub(crate) fn chains(&self) -> &[Chain] {
        &self.chains
    }

    /// Whether a wrench from outside acts.
    pub(crate) fn has_wrenches(&self) -> bool {
        !self.wrenches.is_empty()
    }

    /// Whether one acts on the child body of a joint.
    pub(crate) fn on_joints(&self) -> bool {
        self.wrenches.iter().any(|placed| placed.body.is_some())
    }

    /// Whether the motor torque of every moving joint is an input.
    pub(crate) fn all_driven(&self) -> bool {
        let joints = self.drives.iter().zip(&self.driven);
        joints
            .into_iter()
            .all(|(drive, driven)| *driven && matches!(drive, Drive::Torque { .. } | Drive::Locked))
    }

    /// Writes what depends on time, and on the attitude of the bodies.
    pub(crate) fn fill(&self, time: f64, state: &State<Set>, inputs: &mut Inputs<Set>) {
        let time = time.clamp(self.start, self.end);
        let from_below = time > self.start;
        let at = |profile: &Profile| profile.at(time, from_below);
        let joints = inputs.motors.values_mut().zip(inputs.modes.values_mut());
        for ((motor, mode), (drive, driven)) in joints.zip(self.drives.iter().zip(&self.driven)) {
            if !driven {
                continue;
            }
            (*motor, *mode) = match drive {
                Drive::Torque { profile, limit } => (clipped(at(profile), *limit), Mode::Driven),
                Drive::Acceleration(profile) => (0.0, Mode::Prescribed(at(profile))),
                Drive::Locked => (0.0, Mode::Locked),
            };
        }
        if self.wrenches.is_empty() {
            return;
        }
        let bn = state.attitude.dcm();
        (inputs.force, inputs.torque_b) = (Vector3::zeros(), Vector3::zeros());
        if let Some(bodies) = &mut inputs.bodies {
            for wrench in bodies.values_mut() {
                *wrench = Wrench::none();
            }
        }
        for Placed { wrench, body } in &self.wrenches {
            let vector = |of: &[Profile; 3]| Vector3::from(of.each_ref().map(at));
            let (mut force, mut moment) = (vector(&wrench.force), vector(&wrench.moment));
            if wrench.axes == WrenchAxes::Inertial {
                (force, moment) = (bn * force, bn * moment);
            }
            let Some((device, index, joint)) = *body else {
                inputs.torque_b += moment;
                inputs.add_force(&wrench.point, &force);
                continue;
            };
            if wrench.axes == WrenchAxes::Inertial
                && let (Some(chain), Some(joints)) =
                    (self.chains.get(device), state.devices.get(device))
            {
                let axes = chain.axes(index, joints);
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

/// A torque within its limit.
fn clipped(torque: f64, limit: Option<f64>) -> f64 {
    limit.map_or(torque, |limit| torque.clamp(-limit.abs(), limit.abs()))
}
