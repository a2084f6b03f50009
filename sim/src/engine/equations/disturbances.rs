//! [`Disturbances`]: the wrenches of a scenario's sources at a time and state, and where they act.
//!
//! ```text
//! f_body = R f_sheet,   m_body = R m_sheet + p x f_body
//! ```
//!
//! R is constant: columns are the axes of the data sheet, expressed in those of what the source acts on. On
//! the child body of a joint whose parent's axes are meant it is turned back by the joint. On a flexible
//! structure a mount is the library's, so the wrench turns with it; a node has the axes of B.

use std::cell::RefCell;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointInfo};
use precess_dynamics::{JointStates, ListedModes, ModalPoint, Wrench};

use super::kinematics::turn;
use super::packing::JointPlace;
use crate::disturbance::{
    COMPONENT_COUNT, Disturbance, Harmonic, Model, Noise, Playback, Six, WheelAngle,
};
use crate::scenario::{Scenario, SourceBody, SourcePlace};
use precess_craft::{CraftInputs, CraftState};

/// All sources of a scenario.
#[derive(Clone, Debug)]
pub(crate) struct Disturbances<'a> {
    sources: Vec<Source<'a>>,
    /// Whole turns taken off each joint's angle.
    turns: RefCell<Vec<f64>>,
}

/// Cycles of the highest frequency of a source in a step: eleven evaluations at different times.
const CYCLES_PER_STEP: f64 = 0.5;

/// One source.
#[derive(Clone, Debug)]
struct Source<'a> {
    of: &'a Disturbance,
    exerts: SourceSignal<'a>,
    wheel: Option<usize>,
    on: SourceBodyPoint,
    /// R.
    axes: Matrix3<f64>,
    /// p, from the point that moments are about, in the body's axes, m.
    point: Vector3<f64>,
}

/// What a source exerts, as functions of time and angle.
#[derive(Clone, Debug)]
enum SourceSignal<'a> {
    Tones(&'a [Harmonic]),
    Noise(Box<Noise>),
    Record(Box<Playback<'a>>),
}

/// What a source acts on.
#[derive(Clone, Debug)]
enum SourceBodyPoint {
    Hub,
    /// A mount of a structure, by its number in the library.
    Mount(usize),
    Node(Box<ModalPoint<ListedModes>>),
    /// The child body of a joint; with the joint that turns the axes back.
    Body(usize, Option<&'static JointInfo>),
}

impl<'a> Disturbances<'a> {
    /// Of a checked scenario.
    pub(crate) fn new(scenario: &'a Scenario, joints: &[JointPlace]) -> Self {
        let sources = scenario.disturbances.iter();
        let sources = sources.filter_map(|of| Source::new(of, scenario, joints)).collect();
        Self { sources, turns: RefCell::new(vec![0.0; joints.len()]) }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.sources.is_empty()
    }

    /// Whether one acts on the child body of a joint.
    pub(crate) fn on_joints(&self) -> bool {
        self.sources.iter().any(|source| matches!(source.on, SourceBodyPoint::Body(..)))
    }

    pub(crate) fn set_turns(&self, turns: &[f64]) {
        self.turns.borrow_mut().copy_from_slice(turns);
    }

    /// The longest step that resolves all of them at these rates of the joints, s: half a cycle of the
    /// highest frequency. A source that moves the spacecraft by less than the tolerance would otherwise
    /// be sampled less often than it varies.
    pub(crate) fn longest_step(&self, rate: impl Fn(usize) -> f64) -> f64 {
        let highest = self.sources.iter().map(|source| {
            let rate = source.wheel.map_or(0.0, &rate);
            source.of.model.highest_frequency(rate)
        });
        CYCLES_PER_STEP / highest.fold(0.0, f64::max)
    }

    /// Force and moment of each, along the axes of its data sheet, N and N m.
    pub(crate) fn wrenches(
        &self,
        time: f64,
        from_below: bool,
        state: &CraftState,
    ) -> Vec<Six<f64>> {
        let each = self.sources.iter();
        each.map(|source| source.at(time, from_below, self.angle(source.wheel, state))).collect()
    }

    /// Adds all of them to inputs.
    pub(crate) fn add(
        &self,
        time: f64,
        from_below: bool,
        state: &CraftState,
        all: &mut CraftInputs,
    ) {
        for source in &self.sources {
            let six = source.at(time, from_below, self.angle(source.wheel, state));
            let [force, moment] = source.in_body(&six);
            source.add(force, moment, state, all);
        }
    }

    fn angle(&self, wheel: Option<usize>, state: &CraftState) -> WheelAngle {
        let Some(joint) = wheel else { return WheelAngle::default() };
        let [theta, rate] = state.devices.states().nth(joint).unwrap_or_default();
        let turns = self.turns.borrow().get(joint).copied().unwrap_or_default();
        WheelAngle { theta, turns, rate }
    }
}

impl<'a> Source<'a> {
    fn new(of: &'a Disturbance, scenario: &Scenario, joints: &[JointPlace]) -> Option<Self> {
        let place = scenario.source_place(of)?;
        let on = match place.body {
            SourceBody::Hub => SourceBodyPoint::Hub,
            SourceBody::Mount(mount) => SourceBodyPoint::Mount(mount),
            SourceBody::Node(node) => SourceBodyPoint::Node(Box::new(
                scenario.structure.as_ref()?.nodes.get(node)?.point(),
            )),
            SourceBody::Joint(joint) => {
                let info = joints.get(joint)?.info;
                SourceBodyPoint::Body(joint, place.of_parent.then_some(info))
            }
        };
        let exerts = match &of.model {
            Model::Harmonic(tones) => SourceSignal::Tones(tones),
            Model::Broadband(noise) => {
                SourceSignal::Noise(Box::new(noise.realise(of.seed.unwrap_or_default(), &of.name)))
            }
            Model::Measured(record) => SourceSignal::Record(Box::new(Playback::new(record))),
        };
        let SourcePlace { axes, point, .. } = place;
        Some(Self { of, exerts, wheel: of.wheel, on, axes, point })
    }

    /// Along the axes of the data sheet.
    fn at(&self, time: f64, from_below: bool, wheel: WheelAngle) -> Six<f64> {
        if !self.of.acts(time, from_below) {
            return [0.0; COMPONENT_COUNT];
        }
        match &self.exerts {
            SourceSignal::Tones(tones) => Harmonic::sum(tones, &wheel),
            SourceSignal::Noise(noise) => noise.at(time, wheel.rate),
            SourceSignal::Record(record) => record.at(time, from_below),
        }
    }

    /// Along the axes of the body, or of its parent.
    fn in_body(&self, six: &Six<f64>) -> [Vector3<f64>; 2] {
        let [fx, fy, fz, mx, my, mz] = *six;
        [self.axes * Vector3::new(fx, fy, fz), self.axes * Vector3::new(mx, my, mz)]
    }

    fn add(
        &self,
        force: Vector3<f64>,
        moment: Vector3<f64>,
        state: &CraftState,
        all: &mut CraftInputs,
    ) {
        let about = |force: &Vector3<f64>, moment: &Vector3<f64>| {
            Wrench::at(&self.point, force).plus(&Wrench::torque(moment))
        };
        match &self.on {
            SourceBodyPoint::Hub => {
                all.torque_b += moment;
                all.add_force(&self.point, &force);
            }
            SourceBodyPoint::Mount(mount) => {
                if let Some(sum) = all.modal.mounts.get_mut(*mount) {
                    *sum = sum.plus(&about(&force, &moment));
                }
            }
            SourceBodyPoint::Node(node) => {
                all.add_wrench(node, &force, &(moment + self.point.cross(&force)));
            }
            SourceBodyPoint::Body(joint, turned) => {
                let (mut force, mut moment) = (force, moment);
                if let Some(info) = turned {
                    let [angle, _] = state.devices.states().nth(*joint).unwrap_or_default();
                    let rotation = turn(info, angle);
                    (force, moment) = (rotation.tr_mul(&force), rotation.tr_mul(&moment));
                }
                let bodies = all.bodies.as_mut();
                if let Some(sum) = bodies.and_then(|bodies| bodies.values_mut().nth(*joint)) {
                    *sum = sum.plus(&about(&force, &moment));
                }
            }
        }
    }
}
