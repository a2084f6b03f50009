//! The plain structures that kernels take and return, with a line for every field.

use crate::derivation::script::{sextuple, triple};
use crate::kinds::{Kind, Link, Motion};

/// One field: its name and what it is, with frame and unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// In code.
    pub name: String,
    /// Symbol, equation, frame, unit.
    pub doc: String,
    /// Where a kernel that returns the record finds the value.
    pub source: Source,
}

/// Where a returned field comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// The named value of the same name.
    Own,
    /// A value of another name.
    Named(String),
    /// A record of its own, filled in the same way.
    Nested(Box<Record>),
}

/// A structure of numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// Type name.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// In order.
    pub fields: Vec<Field>,
    /// Whether it is the same for every kind and is in `hub.rs`.
    pub shared: bool,
}

impl Record {
    /// A record of one kind's file.
    pub(super) fn new(name: &str, doc: &str) -> Self {
        Self { name: name.to_owned(), doc: doc.to_owned(), fields: Vec::new(), shared: false }
    }

    /// Every number of the record: its field, and the name of the value that a function returning
    /// the record computes for it.
    #[must_use]
    pub fn leaves(&self) -> Vec<(String, String)> {
        let leaf = |field: &Field| match &field.source {
            Source::Own => vec![(field.name.clone(), field.name.clone())],
            Source::Named(name) => vec![(field.name.clone(), name.clone())],
            Source::Nested(record) => record.leaves(),
        };
        self.fields.iter().flat_map(leaf).collect()
    }

    /// The names of the values that a function returning this record must compute.
    #[must_use]
    pub fn sources(&self) -> Vec<String> {
        self.leaves().into_iter().map(|(_, source)| source).collect()
    }

    /// The records it is made of, each before the one that contains it.
    #[must_use]
    pub fn with_nested(&self) -> Vec<Self> {
        let nested = self.fields.iter().filter_map(|field| match &field.source {
            Source::Nested(record) => Some(record.with_nested()),
            Source::Own | Source::Named(_) => None,
        });
        nested.flatten().chain([self.clone()]).collect()
    }

    fn shared(mut self) -> Self {
        self.shared = true;
        self
    }

    pub(super) fn field(&mut self, name: impl Into<String>, doc: impl Into<String>) {
        self.fields.push(Field { name: name.into(), doc: doc.into(), source: Source::Own });
    }

    pub(super) fn alias(&mut self, name: String, value: &str, doc: String) {
        self.fields.push(Field { name, doc, source: Source::Named(value.to_owned()) });
    }

    pub(super) fn nested(&mut self, name: &str, record: Self, doc: &str) {
        let source = Source::Nested(Box::new(record));
        self.fields.push(Field { name: name.to_owned(), doc: doc.to_owned(), source });
    }

    /// Three components of one vector.
    pub(super) fn vector(&mut self, stem: &str, frame: &str, doc: &str, unit: &str) {
        for name in triple(stem, frame) {
            let axis = name.rsplit('_').next().unwrap_or_default().to_owned();
            self.field(name, format!("{doc}, along {axis}, {unit}."));
        }
    }

    /// A force and its moment about the point that `about` names, `f_load_gox`, `n_load_gox`.
    pub(super) fn wrench(&mut self, what: &str, frame: &str, on: &str, about: &str) {
        self.vector(&format!("f_{what}"), frame, &format!("Force on {on}"), "N");
        let doc = format!("Moment about {about} on {on}");
        self.vector(&format!("n_{what}"), frame, &doc, "N m");
    }

    /// Six entries of a symmetric tensor.
    pub(super) fn tensor(&mut self, stem: &str, doc: &str, unit: &str) {
        for name in sextuple(stem) {
            let entry = name[name.len() - 2..].to_owned();
            self.field(name, format!("{doc}, entry {entry}, {unit}."));
        }
    }
}

/// Constants and pose, which every kernel takes.
pub(super) fn placed(kind: &Kind) -> Vec<(&'static str, Record)> {
    std::iter::once(("p", Record::new("Prepared", ""))).chain(pose(kind)).collect()
}

/// Joint coordinates: the arguments of a kernel that contain them, as many as the kind has.
#[must_use]
pub fn pose(kind: &Kind) -> Vec<(&'static str, Record)> {
    let arguments = [("q", trig(kind)), ("s", positions(kind))];
    arguments.into_iter().filter(|(_, record)| !record.fields.is_empty()).collect()
}

/// Positions along the sliding joints.
fn positions(kind: &Kind) -> Record {
    let mut record = Record::new("Positions", "Positions along the sliding joints.");
    for link in kind.sliding().filter(|link| !link.is_locked()) {
        let doc = format!("Of the {} along its joint, m.", link.body.title);
        record.field(link.joint.coordinate, doc);
    }
    record
}

/// Sines and cosines of the joint angles.
fn trig(kind: &Kind) -> Record {
    let mut record = Record::new("Trig", "Sines and cosines of the joint angles.");
    for link in kind.turning().filter(|link| !link.is_locked()) {
        let angle = link.joint.coordinate;
        record.field(format!("sin_{angle}"), format!("Sine of `{angle}`."));
        record.field(format!("cos_{angle}"), format!("Cosine of `{angle}`."));
    }
    record
}

/// The joint rates.
#[must_use]
pub fn rates(kind: &Kind) -> Record {
    let mut record = Record::new("Rates", "Joint rates, each relative to the parent body.");
    for link in kind.links.iter().filter(|link| !link.is_locked()) {
        let (symbol, unit) = (link.joint.symbols[0], link.joint.motion.units().rate);
        let doc = format!("{symbol}: rate of the {}, {unit}.", link.body.title);
        record.field(link.joint.rate, doc);
    }
    record
}

/// The motor torques.
#[must_use]
pub fn motors(kind: &Kind) -> Record {
    let what =
        if kind.sliding().next().is_some() { "Motor torques and forces" } else { "Motor torques" };
    let mut record = Record::new(
        "Motors",
        &format!("{what}, each on the child body and reversed on the parent body."),
    );
    for link in kind.driven() {
        let (what, unit) = match link.joint.motion {
            Motion::Turn(_) => ("Torque", link.joint.motion.units().drive),
            Motion::Slide(_) => ("Force along its joint", link.joint.motion.units().drive),
        };
        record.field(link.joint.torque, format!("{what} on the {}, {unit}.", link.body.title));
    }
    record
}

/// What is given of each joint that has a motor: the torque or the acceleration.
#[must_use]
pub fn modes(kind: &Kind) -> Record {
    let doc = "What is given of each joint: its torque (driven), or its acceleration (prescribed; \
               zero where it is locked).";
    let mut record = Record::new("Modes", doc);
    for link in kind.driven() {
        let (tag, title, units) = (link.joint.tag, link.body.title, link.joint.motion.units());
        let what = match link.joint.motion {
            Motion::Turn(_) => "torque",
            Motion::Slide(_) => "force",
        };
        record.field(
            format!("driven_{tag}"),
            format!("One where the {what} on the {title} is given, else zero."),
        );
        record.field(
            format!("held_{tag}"),
            format!(
                "Zero where the {what} on the {title} is given, else one, {}: added to the pivot \
                 that is divided by.",
                units.pivot
            ),
        );
        record.field(
            format!("given_{tag}"),
            format!(
                "Acceleration of the {title} where it is given, else zero, {}.",
                units.acceleration
            ),
        );
    }
    record
}

/// The second-order joint states.
#[must_use]
pub fn joint_accelerations(kind: &Kind) -> Record {
    let mut record = Record::new("JointAccelerations", "The second-order states of the joints.");
    for link in kind.links.iter().filter(|link| !link.is_locked()) {
        let symbol = link.joint.symbols[1];
        let unit = link.joint.motion.units().acceleration;
        let doc = format!("{symbol}: acceleration of the {}, {unit}.", link.body.title);
        record.field(link.joint.acceleration, doc);
    }
    record
}

/// Wrench on each body.
#[must_use]
pub fn wrenches(kind: &Kind) -> Record {
    let doc = "Wrench on each body, expressed in its own axes, moments about its joint's origin.";
    let mut record = Record::new("Wrenches", doc);
    for Link { body, .. } in kind.links {
        record.wrench("on", body.frame, &format!("the {}", body.title), body.letters[0]);
    }
    record
}

/// The records that are the same for every kind.
#[must_use]
pub fn shared_records() -> [Record; 7] {
    [
        body_rate(),
        body_velocity(),
        body_acceleration(),
        hub_share(),
        constant_share(),
        energy_momentum(),
        gradient(),
    ]
}

/// Angular velocity of B.
#[must_use]
pub(super) fn body_rate() -> Record {
    let doc = "ω_{B/N}, expressed in B; in functions without the mount, in the device's axes.";
    let mut record = Record::new("BodyRate", doc).shared();
    record.vector("omega", "b", "ω_{B/N}", "rad/s");
    record
}

/// Velocity of point B and angular velocity of B.
#[must_use]
pub(super) fn body_velocity() -> Record {
    let doc = "Velocity of point B and angular velocity of B, expressed in the device's axes.";
    let mut record = Record::new("BodyVelocity", doc).shared();
    record.vector("r_b_n_dot", "b", "ṙ_{B/N}", "m/s");
    record.vector("omega", "b", "ω_{B/N}", "rad/s");
    record
}

/// Acceleration of point B and angular acceleration of B.
#[must_use]
pub(super) fn body_acceleration() -> Record {
    let doc = "Acceleration of point B and angular acceleration of B, expressed in B; in functions \
               without the mount, in the device's axes.";
    let mut record = Record::new("BodyAcceleration", doc).shared();
    record.vector("r_b_n_ddot", "b", "r̈_{B/N}", "m/s²");
    record.vector("omega_dot", "b", "ω̇_{B/N}", "rad/s²");
    record
}

/// One device's share of the hub's equations.
#[must_use]
pub(super) fn hub_share() -> Record {
    let doc = "Share of a device in `M [r̈_{B/N}; ω̇] = [F; L_B] - h`, expressed in B: what the elimination \
               of its joints subtracts from M and adds to h, and its first moment and inertia \
               without the constant share.";
    let mut record = Record::new("HubShare", doc).shared();
    record.tensor("m_vv", "Subtracted from M_vv", "kg");
    for row in 1..=3 {
        for column in 1..=3 {
            let doc =
                format!("Subtracted from M_vw, row {row} (force), column {column} (ω̇), kg m.");
            record.field(format!("m_vw_{row}{column}"), doc);
        }
    }
    record.tensor("m_ww", "Subtracted from M_ww", "kg m²");
    for row in 1..=3 {
        record.field(
            format!("h_v_{row}"),
            format!("Force that the joints require, component {row}, N."),
        );
    }
    for row in 1..=3 {
        let doc = format!("Moment about B that the joints require, component {row}, N m.");
        record.field(format!("h_w_{row}"), doc);
    }
    record.vector("mr_moving", "b", "First moment about B without the constant share", "kg m");
    record.tensor("i_moving", "Inertia about B without the constant share", "kg m²");
    record
}

/// The constant share of the hub.
#[must_use]
pub(super) fn constant_share() -> Record {
    let doc = "Constant share of the hub: the mass of a device, and the part of its first moment and \
               inertia about B that no joint changes, expressed in B.";
    let mut record = Record::new("ConstantShare", doc).shared();
    record.field("constant_m", "Mass of the device, kg.");
    record.vector("constant_mr", "b", "First moment about B", "kg m");
    record.tensor("constant_i", "Inertia about B", "kg m²");
    record
}

/// One device's energy and momenta.
#[must_use]
pub(super) fn energy_momentum() -> Record {
    let doc = "A device's share of kinetic energy and momenta, expressed in the device's axes.";
    let mut record = Record::new("EnergyMomentum", doc).shared();
    record.field("energy", "Kinetic energy, J.");
    record.vector("linear", "b", "Linear momentum", "kg m/s");
    record.vector("angular_b", "b", "Angular momentum about B, Σ r × m ṙ + I ω", "kg m²/s");
    record
}

/// The gradient of a field of acceleration.
#[must_use]
pub(super) fn gradient() -> Record {
    let doc = "A field of acceleration that grows linearly from B, `G r`, expressed in the device's axes.";
    let mut record = Record::new("Gradient", doc).shared();
    record.tensor("g", "G, symmetric", "1/s²");
    record
}
