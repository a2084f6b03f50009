//! Names of states, inputs and outputs, made of the names of members and of their kinds' joints.

use precess_dynamics::{Axis, Output, Variable};

use super::Evaluator;
use crate::record::{Column, Columns};
use crate::scenario::Scenario;

/// The names of a joint: `cmg1.theta`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JointNames {
    /// The number of its device or platform, from 0 through the set.
    pub device: usize,
    /// Its child body: `cmg1.inner_gimbal`.
    pub body: String,
    /// Its coordinate: `cmg1.gamma_i`.
    pub coordinate: String,
    /// Its rate.
    pub rate: String,
    /// Its acceleration.
    pub acceleration: String,
    /// Its motor torque or force.
    pub motor: String,
    /// Units of coordinate, rate, acceleration and motor.
    pub units: [&'static str; 4],
    /// Whether it slides.
    pub slides: bool,
    /// Whether it has a motor; otherwise its kind keeps its rate.
    pub driven: bool,
}

impl JointNames {
    /// Those of a scenario, in the order of the set.
    pub(super) fn all(scenario: &Scenario) -> Vec<Self> {
        let joints = scenario.joints();
        let names = joints.map(|(device, name, info)| Self {
            device,
            body: format!("{name}.{}", info.body.replace(' ', "_")),
            coordinate: format!("{name}.{}", info.coordinate),
            rate: format!("{name}.{}", info.rate),
            acceleration: format!("{name}.{}", info.acceleration),
            motor: format!("{name}.{}", info.motor),
            units: info.units(),
            slides: info.slides,
            driven: info.driven,
        });
        names.collect()
    }
}

impl Evaluator {
    /// The joints in the order of the set.
    #[must_use]
    pub fn joints(&self) -> &[JointNames] {
        &self.joints
    }

    /// The columns of a run that the numbers of a flat state are, in its order.
    #[must_use]
    pub fn state_columns(&self) -> Vec<Column> {
        let place = |column: Column| Some((self.layout.place(column.quantity)?, column));
        let mut columns: Vec<_> =
            Columns::all(&self.scenario).into_iter().filter_map(place).collect();
        columns.sort_by_key(|(place, _)| *place);
        columns.into_iter().map(|(_, column)| column).collect()
    }

    /// The name of a variable of the linearised system: that of a column where there is one;
    /// `attitude_x` is a small rotation about an axis of B.
    #[must_use]
    pub fn variable_name(&self, variable: Variable) -> String {
        let of = |joint: usize, name: fn(&JointNames) -> &String| {
            self.joints.get(joint).map_or_else(String::new, |joint| name(joint).clone())
        };
        let wrench = |joint: usize, what: &str, axis| {
            along(&format!("{}.{what}", of(joint, |joint| &joint.body)), axis)
        };
        match variable {
            Variable::Position(axis) => along("position", axis),
            Variable::Attitude(axis) => along("attitude", axis),
            Variable::Velocity(axis) => along("velocity", axis),
            Variable::Omega(axis) => along("omega", axis),
            Variable::Coordinate(joint) => of(joint, |joint| &joint.coordinate),
            Variable::Rate(joint) => of(joint, |joint| &joint.rate),
            Variable::Force(axis) => along("force", axis),
            Variable::TorqueB(axis) => along("torque", axis),
            Variable::Motor(joint) => of(joint, |joint| &joint.motor),
            Variable::Acceleration(joint) => of(joint, |joint| &joint.acceleration),
            Variable::HubAcceleration(axis) => along("acceleration_b", axis),
            Variable::HubAngularAcceleration(axis) => along("omega_dot", axis),
            Variable::BodyForce(joint, axis) => wrench(joint, "force", axis),
            Variable::BodyMoment(joint, axis) => wrench(joint, "moment", axis),
            Variable::Gravity(axis) => along("gravity", axis),
            Variable::Mu => "gravity.mu".to_owned(),
            Variable::ModalCoordinate(mode) => format!("modes.eta_{}", mode + 1),
            Variable::ModalRate(mode) => format!("modes.eta_dot_{}", mode + 1),
            Variable::ModalForce(mode) => format!("modes.force_{}", mode + 1),
            Variable::MountForce(mount, axis) => along(&self.mount_wrench(mount, "force"), axis),
            Variable::MountMoment(mount, axis) => along(&self.mount_wrench(mount, "moment"), axis),
        }
    }

    /// The name of what acts on a mount, by its node: `tip.force`.
    fn mount_wrench(&self, mount: usize, what: &str) -> String {
        let of = self.scenario.structure.as_ref();
        let node = of.and_then(|of| of.nodes.get(of.mounts().get(mount).copied()?));
        node.map_or_else(String::new, |node| format!("{}.{what}", node.name))
    }

    /// The name of an output of the linearised system: that of a column where there is one;
    /// `acceleration_b_x` is the inertial acceleration of B along an axis of B.
    #[must_use]
    pub fn output_name(&self, output: Output) -> String {
        let of = |joint: usize, name: fn(&JointNames) -> &String| {
            self.joints.get(joint).map_or_else(String::new, |joint| name(joint).clone())
        };
        let load = |joint: usize, what: &str, axis| {
            along(&format!("{}.load_{what}", of(joint, |joint| &joint.body)), axis)
        };
        match output {
            Output::Acceleration(axis) => along("acceleration_b", axis),
            Output::AngularAcceleration(axis) => along("omega_dot", axis),
            Output::JointAcceleration(joint) => of(joint, |joint| &joint.acceleration),
            Output::ModalAcceleration(mode) => format!("structure.eta_ddot_{}", mode + 1),
            Output::Energy => "kinetic_energy".to_owned(),
            Output::LinearMomentum(axis) => along("linear_momentum", axis),
            Output::AngularMomentum(axis) => along("angular_momentum", axis),
            Output::JointForce(joint, axis) => load(joint, "force", axis),
            Output::JointMoment(joint, axis) => load(joint, "moment", axis),
            Output::HubForce(axis) => along("hub.load_force", axis),
            Output::HubMoment(axis) => along("hub.load_moment", axis),
        }
    }

    /// The names of all accelerations in order: of B and of the hub, both in B, of the joints, of
    /// the modal coordinates.
    #[must_use]
    pub fn acceleration_names(&self) -> Vec<String> {
        let hub = ["acceleration_b", "omega_dot"];
        let hub = hub.iter().flat_map(|base| Axis::ALL.map(|axis| along(base, axis)));
        let joints = self.joints.iter().map(|joint| joint.acceleration.clone());
        let modes = (0..self.layout.modes).map(|mode| format!("structure.eta_ddot_{}", mode + 1));
        hub.chain(joints).chain(modes).collect()
    }
}

/// The name of a component.
fn along(base: &str, axis: Axis) -> String {
    let letter = match axis {
        Axis::X => 'x',
        Axis::Y => 'y',
        Axis::Z => 'z',
    };
    format!("{base}_{letter}")
}
