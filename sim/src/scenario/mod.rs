//! [`Scenario`]: a spacecraft, its initial state, what happens over time, and what is recorded; in
//! SI units and radians.
//!
//! It is what a scenario file says, after includes, defaults, layouts and units; and what a run
//! takes. Joints are numbered in the order of the set, from 0, through all devices.
//!
//! Invariants of a checked scenario ([`Scenario::check`]): names of devices are unique; every
//! joint number, time and bound is in range; [`Scenario::spacecraft`] succeeds.

mod body_point;
mod check;
mod control_law;
mod controller;
mod controller_sensors;
mod description;
mod disturbances;
mod friction;
mod margin_requirement;
pub mod mass;
mod mean;
mod member;
mod motor;
mod on_gpu;
mod orbital_frame;
pub mod profile;
mod projection;
mod reserved;
mod residual;
mod source_place;
pub mod steady;
mod structure;
mod time_scales;

use nalgebra::Vector3;
use precess_description::Turn;
use precess_dynamics::kind::JointInfo;
use precess_dynamics::{Gravity, Hub, HubMode, ParameterError, Quaternion, Spacecraft, State};

pub use body_point::BodyPoint;
pub use check::ScenarioError;
pub(crate) use control_law::BuiltGuidance;
pub use control_law::{AttitudeReference, ControlLaw};
pub use controller::{
    AllocationInverse, CommandedJoint, NullMotion, SampledController, ServoSettings,
    TorqueAllocation,
};
pub(crate) use controller::{COMMANDED_MAX, steered};
pub(crate) use controller_sensors::BuiltSensors;
pub use controller_sensors::{
    AccelerometerSettings, ControllerSensors, DumpingSettings, EstimatorSettings, FilterKind,
    FilterSettings, FilteredSignal, GyroSettings, StarTrackerSettings,
};
pub use description::UndescribedError;
pub use friction::{DryFriction, JointFriction};
pub use margin_requirement::{LoopMargin, MarginRequirement, decibels};
pub use mass::{MassMatrix, MassProperties};
pub use mean::MeanState;
pub use member::{Member, Set, members, set_of};
pub(crate) use member::{body_key, joint_key, with_device};
pub use motor::MotorLimits;
pub use on_gpu::NotOnGpu;
pub use orbital_frame::{OrbitalFrame, roll_pitch_yaw};
pub use profile::{Interpolation, NoDerivative, Profile, Table};
pub use projection::Projection;
#[cfg(test)]
pub(crate) use reserved::RESERVED_NAMES;
pub use source_place::{SourceBody, SourcePlace};
pub use structure::{ModalStructure, RecordedPoint, StructureNode};
pub(crate) use time_scales::steps_max;

use crate::disturbance::Disturbance;
use crate::pointing::Index;

/// Everything a run needs.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// The name in file names: lower case, digits, hyphens.
    pub name: String,
    /// What a heading says.
    pub title: String,
    /// What it shows and where its numbers come from; may be empty.
    pub description: String,
    /// The hub.
    pub hub: Hub,
    /// Edges of the box that stands for the hub in drawings, along B axes, m.
    pub hub_size: Vector3<f64>,
    /// The name of each device and platform, in the order of the set: lower case, digits,
    /// underscores.
    pub names: Vec<String>,
    /// The devices on the hub, and the platforms with the devices on them.
    pub devices: Set,
    /// The turns about coordinate axes that the mount of each member is written as, first from its
    /// base; none where it is written as numbers. Missing ones are none.
    pub mounts: Vec<Option<Vec<Turn>>>,
    /// The modes of the structure; none of a rigid hub. With them the hub is the whole structure,
    /// undeformed.
    pub structure: Option<ModalStructure>,
    /// Initial state.
    pub initial: State<Set>,
    /// The state about which a settled run vibrates; none where it starts in `initial` without more.
    pub mean: Option<MeanState>,
    /// The attitude that the columns `rotation` are from.
    pub reference: Quaternion,
    /// Mode of the hub.
    pub hub_mode: HubMode,
    /// Gravity on every body.
    pub gravity: Gravity,
    /// What drives each joint from the start, joint by joint.
    pub drives: Vec<Drive>,
    /// End stops of joints.
    pub stops: Vec<EndStop>,
    /// Friction of joints that sticks, and quadratic drag; a joint at most once.
    pub friction: Vec<JointFriction>,
    /// Wrenches from outside.
    pub wrenches: Vec<AppliedWrench>,
    /// Points of the hub and of the devices' bodies whose motion is recorded.
    pub points: Vec<BodyPoint>,
    /// Empirical sources of force and torque.
    pub disturbances: Vec<Disturbance>,
    /// Controllers that are computed at samples; a joint is commanded by at most one.
    pub controllers: Vec<SampledController>,
    /// Changes of drives at times, in the order of time.
    pub changes: Vec<Change>,
    /// Crossings that end the run or are only noted.
    pub crossings: Vec<Crossing>,
    /// Duration and integrator.
    pub settings: Settings,
    /// What is recorded.
    pub output: Output,
    /// Limits on recorded quantities.
    pub requirements: Vec<Requirement>,
    /// Limits on margins of the loops of controllers.
    pub margin_requirements: Vec<MarginRequirement>,
    /// The text it was read from; empty for one that a program built.
    pub source: Source,
}

/// What determines the motion of a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// A motor torque (force) as a function of time, within the limits of the motor, N m or N.
    Torque {
        /// Before clipping.
        profile: Profile,
        /// What the motor cannot exceed; none where there is no limit.
        limit: Option<MotorLimits>,
    },
    /// A prescribed acceleration as a function of time, rad/s² or m/s².
    Acceleration(Profile),
    /// Locked: the rate is zero.
    Locked,
}

/// End stops of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndStop {
    /// The joint.
    pub joint: usize,
    /// Lowest coordinate, rad or m; minus infinity where there is none.
    pub lower: f64,
    /// Highest coordinate, rad or m; infinity where there is none.
    pub upper: f64,
    /// What happens there.
    pub action: StopAction,
}

/// What happens at an end stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopAction {
    /// The run ends.
    End,
    /// The joint is stopped impulsively and locked; the loss is entered in the ledger.
    Lock,
}

/// A force and moment from outside, as functions of time.
#[derive(Clone, Debug, PartialEq)]
pub struct AppliedWrench {
    /// The body it acts on.
    pub body: Target,
    /// Components of the force, N.
    pub force: [Profile; 3],
    /// Components of the moment about `point`, N m.
    pub moment: [Profile; 3],
    /// Where the force acts, from B or from the body's origin, expressed in the body's axes, m.
    pub point: Vector3<f64>,
    /// The axes of force and moment.
    pub axes: WrenchAxes,
}

/// A body of the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The hub.
    Hub,
    /// The child body of a joint.
    Joint(usize),
    /// A node of the structure.
    Node(usize),
}

/// The axes in which a wrench is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrenchAxes {
    /// Those of the body.
    Body,
    /// N.
    Inertial,
}

/// A change at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// When, s. No integration step spans it.
    pub time: f64,
    /// The joint.
    pub joint: usize,
    /// What happens.
    pub action: Action,
}

/// What happens to a joint at a time.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// A drive replaces the present one. Its profile's time counts from the start of the run.
    Drive(Drive),
    /// Stopped impulsively, as by a rigid brake, and locked; the loss is entered in the ledger.
    Brake,
    /// Its controller commands it again, after a drive, a brake or an end stop took its place.
    Release,
}

/// A recorded quantity that passes a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// What a note says; the name of the event.
    pub name: String,
    /// The name of a column of state: a coordinate, a rate, a component of omega.
    pub column: String,
    /// The value, in SI.
    pub value: f64,
    /// The SI unit of the value.
    pub unit: String,
    /// Whether the run ends there.
    pub ends: bool,
}

/// Duration and integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Length of the run, s.
    pub duration: f64,
    /// The integrator.
    pub integrator: IntegratorChoice,
}

/// Which integrator, with its one setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IntegratorChoice {
    /// Dormand and Prince of order 8(5,3), steps chosen for a relative tolerance.
    Dop853 {
        /// Relative tolerance of one step.
        tolerance: f64,
    },
    /// Runge and Kutta of order 4 with fixed steps: that of the flight library.
    Rk4 {
        /// Length of a step, s.
        step: f64,
    },
}

/// What is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Samples per second, 1/s.
    pub rate: f64,
    /// Names of columns or of groups of columns (`omega`, `cmg1`, `loads`); empty for all but the
    /// loads.
    pub columns: Vec<String>,
    /// The files, each once.
    pub formats: Vec<Format>,
}

/// A format of a result file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// Comma-separated text.
    Csv,
    /// `NumPy`'s archive.
    Npz,
    /// Apache Parquet.
    Parquet,
    /// MCAP, for Foxglove and `PlotJuggler`.
    Mcap,
}

/// A limit on a recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    /// What a report calls it.
    pub name: String,
    /// The name of a column, or of a group of three, whose magnitude counts.
    pub quantity: String,
    /// Which components of a vector count.
    pub projection: Projection,
    /// Which number of its history.
    pub statistic: Statistic,
    /// The part of the run that counts, s.
    pub window: [f64; 2],
    /// Upper bound of the statistic, SI.
    pub limit: f64,
    /// The limit as it was written: `0.1 deg/s`.
    pub written: String,
    /// The unit in which limit and value are shown, and its size in SI.
    pub unit: (String, f64),
}

/// A number of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Statistic {
    /// Largest magnitude.
    Peak,
    /// Root of the mean square.
    Rms,
    /// The RMS of what lies in a band of frequencies, Hz.
    BandRms([f64; 2]),
    /// The magnitude at the end.
    Final,
    /// Largest departure from the first sample.
    Drift,
    /// RMS of the mean over exposures of a length, s, one after the other.
    Displacement(f64),
    /// RMS of the straight line within exposures of a length, s, their means left out.
    Smear(f64),
    /// RMS of the rest within exposures of a length, s.
    Jitter(f64),
    /// An index of ECSS over the time of the run (temporal interpretation).
    Index {
        /// Which, with its windows: not the PRE, which needs several runs.
        index: Index,
        /// The share of the time in which it is not exceeded, between zero and one.
        level: f64,
    },
}

/// The text that a scenario was read from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The file, as it was named.
    pub path: String,
    /// All files that were read and the overrides, one after the other, with a comment that names
    /// each.
    pub text: String,
    /// The same in one file, every default written out: what is not there the spacecraft does not
    /// have, such as a torque limit, an end stop, gravity.
    pub filled: String,
    /// The file of the structure, as it is named from the scenario's folder.
    pub structure: Option<String>,
}

impl Scenario {
    /// The spacecraft, prepared for evaluation; with a flexible structure, undeformed. See
    /// [`Self::flexible`].
    ///
    /// # Errors
    ///
    /// Parameters that the solver rejects.
    pub fn spacecraft(&self) -> Result<Spacecraft<Set>, ParameterError> {
        precess_craft::spacecraft(&self.bare_hub()?, &self.devices)
    }

    /// How many joints all devices have.
    #[must_use]
    pub fn joint_count(&self) -> usize {
        members(&self.devices).iter().map(|member| member.joints().len()).sum()
    }

    /// How many modes the structure has; zero of a rigid hub.
    #[must_use]
    pub fn mode_count(&self) -> usize {
        self.structure.as_ref().map_or(0, |structure| structure.modes.len())
    }

    /// The devices and platforms with their names, in the order of the set.
    pub fn members(&self) -> impl Iterator<Item = (&str, Member<'_>)> {
        self.names.iter().map(String::as_str).zip(members(&self.devices))
    }

    /// The joints in order: number and name of the device or platform, and the joint.
    pub fn joints(&self) -> impl Iterator<Item = (usize, &str, &'static JointInfo)> {
        self.members().enumerate().flat_map(|(index, (name, member))| {
            member.joints().iter().map(move |info| (index, name, info))
        })
    }
}
