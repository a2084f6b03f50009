//! [`ModalStructure`]: the modes of a scenario's structure, the nodes that it uses, and the
//! [`Spacecraft`] of both with the devices.
//!
//! Numbers are in SI units, vectors are expressed in B. Nodes are those that carry a device, are
//! recorded, or take a wrench; every node has one row of shapes for each mode. What the equations of
//! a flexible structure do not have is listed in one place: [`Scenario::not_on_a_structure`].

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_craft::{FlexibleCraft, OfMembers};
use precess_dynamics::{
    About, ContainedBody, Hub, JointStates, ListedModes, ModalMount, ModalPoint, Modes, ModesError,
    ParameterError, ResidualFault, Spacecraft, State, platform,
};

use super::check::range;
use super::{Scenario, ScenarioError, Set, Target, WrenchAxes, set_of};
use crate::structure::{COORDINATES, Mode, RigidMass};

/// A flexible structure.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalStructure {
    /// The modes: mass-normalised, in a floating frame B; after them the residual coordinates.
    pub modes: Vec<Mode>,
    /// How many of the last are residual coordinates, without a modal mass: the static response of
    /// the modes left out.
    pub residual: usize,
    /// The nodes that the scenario uses.
    pub nodes: Vec<StructureNode>,
    /// The node that carries each member, device or platform; what stands on a platform or panel has the
    /// node of that.
    pub on_node: Vec<usize>,
    /// Whether hub and modes contain the mass of the devices, as a rigid body at their initial
    /// coordinates: it is subtracted.
    pub contains_devices: bool,
    /// What is recorded of the motion of nodes.
    pub points: Vec<RecordedPoint>,
    /// Modal coordinates at the start, one for each mode and residual coordinate, m kg^1/2.
    pub coordinates: Vec<f64>,
    /// Their rates, m kg^1/2/s.
    pub rates: Vec<f64>,
}

/// A node of a structure, with its shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct StructureNode {
    /// Its name.
    pub name: String,
    /// Its position from B, m.
    pub position: Vector3<f64>,
    /// Of each mode: translation, kg^-1/2, then rotation, rad m^-1 kg^-1/2.
    pub shapes: Vec<[f64; COORDINATES]>,
}

/// A node whose motion is recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordedPoint {
    /// The name of its columns: lower case, digits, underscores.
    pub name: String,
    /// The node.
    pub node: usize,
}

impl StructureNode {
    /// The node as a point of the library.
    #[must_use]
    pub fn point(&self) -> ModalPoint<ListedModes> {
        let three = |from: usize| {
            let of = |shape: &[f64; COORDINATES]| Vector3::from_fn(|axis, _| shape[from + axis]);
            self.shapes.iter().map(of).collect()
        };
        ModalPoint { position: self.position, translation: three(0), rotation: three(3) }
    }
}

impl ModalStructure {
    /// The modes, without the residual coordinates.
    #[must_use]
    pub fn massive(&self) -> &[Mode] {
        let count = self.modes.len().saturating_sub(self.residual);
        self.modes.get(..count).unwrap_or_default()
    }

    /// The shapes: six rows for each node, a column for each mode and residual coordinate.
    pub(crate) fn shapes(&self) -> DMatrix<f64> {
        DMatrix::from_fn(COORDINATES * self.nodes.len(), self.modes.len(), |row, mode| {
            let node = self.nodes.get(row / COORDINATES);
            let shape = node.and_then(|node| node.shapes.get(mode));
            shape.map_or(0.0, |shape| shape[row % COORDINATES])
        })
    }

    /// The nodes that carry devices and platforms, each once: the mounts of the library, in their order.
    pub(crate) fn mounts(&self) -> Vec<usize> {
        let mut mounts = Vec::new();
        for node in &self.on_node {
            if !mounts.contains(node) {
                mounts.push(*node);
            }
        }
        mounts
    }
}

impl Scenario {
    /// The flexible structure, with the devices on it; none of a rigid hub.
    ///
    /// # Errors
    ///
    /// Parameters that the solver rejects.
    #[must_use]
    pub fn flexible(&self) -> Option<Result<FlexibleCraft, ModesError>> {
        let structure = self.structure.as_ref()?;
        Some(self.flexible_with(structure))
    }

    fn flexible_with(&self, structure: &ModalStructure) -> Result<FlexibleCraft, ModesError> {
        let of = |of: fn(&Mode) -> f64| structure.modes.iter().map(of).collect();
        let mounts = structure.mounts();
        let mut modal = Vec::new();
        for node in &mounts {
            let point = structure.nodes.get(*node).map(StructureNode::point);
            let carried = structure.on_node.iter().zip(0..).filter(|(on, _)| *on == node);
            let carried: Vec<usize> = carried.map(|(_, member)| member).collect();
            let contained = self.contained(&carried)?;
            modal.extend(point.map(|point| ModalMount { point, contained }));
        }
        let modes = Modes {
            frequencies: of(|mode| mode.frequency),
            damping: of(|mode| mode.damping),
            linear: structure.modes.iter().map(|mode| mode.linear).collect(),
            angular: structure.modes.iter().map(|mode| mode.angular).collect(),
            mounts: modal,
        };
        let mount = |node: &usize| mounts.iter().position(|known| known == node).unwrap_or(0);
        let on = self.of_members(structure.on_node.iter().map(mount));
        let residual = structure.residual;
        precess_craft::flexible(&self.hub, &modes, residual, &self.devices, &on)
    }

    /// A value for each member, in their order, as the library has them.
    fn of_members(&self, mut values: impl Iterator<Item = usize>) -> OfMembers<usize> {
        let (on_hub, isolated, rows) = &self.devices;
        let values = &mut values as &mut dyn Iterator<Item = usize>;
        let devices = next(values, on_hub.len());
        let platforms = isolated.iter().map(|of| {
            let (carrier, devices) = carrier_and(values, of.carried.0.len());
            let platforms = of.carried.1.iter().map(|of| data(values, of.carried.len()));
            let platforms = platforms.collect();
            platform::Data { carrier, carried: (devices, platforms) }
        });
        let platforms = platforms.collect();
        let rows = rows.iter().map(|first| {
            let (carrier, devices) = carrier_and(values, first.carried.0.len());
            let seconds = first.carried.1.iter().map(|second| {
                let (carrier, devices) = carrier_and(values, second.carried.0.len());
                let thirds = second.carried.1.iter().map(|third| data(values, third.carried.len()));
                let thirds = thirds.collect();
                platform::Data { carrier, carried: (devices, thirds) }
            });
            let seconds = seconds.collect();
            platform::Data { carrier, carried: (devices, seconds) }
        });
        let rows = rows.collect();
        (devices, platforms, rows)
    }

    /// What hub and modes contain of members: nothing, or their bodies at the initial coordinates.
    fn contained(&self, members: &[usize]) -> Result<Option<ContainedBody>, ParameterError> {
        if !self.structure.as_ref().is_some_and(|structure| structure.contains_devices) {
            return Ok(None);
        }
        let whole = self.as_one(members)?;
        let centre = whole.centre();
        let cross = centre.cross_matrix();
        let inertia = whole.inertia + whole.mass * cross * cross;
        let inertia = 0.5 * (inertia + inertia.transpose());
        Ok(Some(ContainedBody { mass: whole.mass, centre, inertia }))
    }

    /// Members as one rigid body about B, joints at their initial coordinates; a platform is listed
    /// with what stands on it.
    fn as_one(&self, chosen: &[usize]) -> Result<RigidMass, ParameterError> {
        let nothing =
            RigidMass { mass: 0.0, first_moment: Vector3::zeros(), inertia: Matrix3::zeros() };
        let groups = self.groups().into_iter();
        let mut chosen = groups.filter(|group| group.iter().any(|member| chosen.contains(member)));
        chosen.try_fold(nothing, |sum, group| {
            let joints = self.joints().zip(self.initial.devices.states());
            let of_group = joints.filter(|((member, ..), _)| group.contains(member));
            let coordinates = of_group.map(|(_, [coordinate, _])| coordinate);
            let body = set_as_one(&set_of(self, &group), coordinates)?;
            Ok(RigidMass {
                mass: sum.mass + body.mass,
                first_moment: sum.first_moment + body.first_moment,
                inertia: sum.inertia + body.inertia,
            })
        })
    }

    /// The hub without what it contains of the devices: that of the rigid spacecraft.
    pub(crate) fn bare_hub(&self) -> Result<Hub, ParameterError> {
        if !self.structure.as_ref().is_some_and(|structure| structure.contains_devices) {
            return Ok(self.hub);
        }
        let Hub { m_b, r_bc_b, i_b_bc } = self.hub;
        let whole = RigidMass::about_centre(m_b, r_bc_b, i_b_bc);
        let all: Vec<usize> = (0..self.members().count()).collect();
        let devices = self.as_one(&all)?;
        let m_b = whole.mass - devices.mass;
        let r_bc_b = (whole.first_moment - devices.first_moment) / m_b;
        let cross = r_bc_b.cross_matrix();
        let inertia = whole.inertia - devices.inertia + m_b * cross * cross;
        Ok(Hub { m_b, r_bc_b, i_b_bc: 0.5 * (inertia + inertia.transpose()) })
    }

    /// What is wrong with the structure and what is on it; nothing of a rigid hub.
    pub(super) fn check_structure(&self) -> Vec<ScenarioError> {
        let Some(structure) = &self.structure else { return Vec::new() };
        let mut errors = self.check_counts(structure);
        if errors.is_empty() {
            errors.extend(self.not_on_a_structure());
            match self.flexible_with(structure) {
                Ok(craft) => errors.extend(self.check_residual(structure, craft)),
                Err(error) => errors.push(named(structure, error)),
            }
        }
        errors
    }

    fn check_counts(&self, structure: &ModalStructure) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let (modes, nodes) = (structure.modes.len(), structure.nodes.len());
        for (key, found) in
            [("coordinates", structure.coordinates.len()), ("rates", structure.rates.len())]
        {
            if found != modes {
                let message = format!("{found} numbers for {modes} modes; write one for each");
                errors.push(range(&format!("structure.{key}"), message));
            }
        }
        let (found, members) = (structure.on_node.len(), self.members().count());
        if found != members {
            let message =
                format!("{found} nodes for {members} devices and platforms; give each its `node`");
            errors.push(range("structure", message));
        }
        let of_wrenches = self.wrenches.iter().filter_map(|wrench| match wrench.body {
            Target::Node(node) => Some(node),
            Target::Hub | Target::Joint(_) => None,
        });
        let of_points = structure.points.iter().map(|point| point.node);
        for node in structure.on_node.iter().copied().chain(of_points).chain(of_wrenches) {
            if node >= nodes {
                errors.push(range("structure.node", format!("node {node} of {nodes}")));
            }
        }
        for node in structure.nodes.iter().filter(|node| node.shapes.len() != modes) {
            let message =
                format!("`{}` has {} shapes for {modes} modes", node.name, node.shapes.len());
            errors.push(range("structure.node", message));
        }
        for (index, point) in structure.points.iter().enumerate() {
            let name = point.name.as_str();
            let earlier = structure.points.iter().take(index).any(|other| other.name == name);
            let node = structure.nodes.get(point.node).map_or("", |node| node.name.as_str());
            let remedy = format!("choose another `name`, with `node = \"{node}\"`");
            errors.extend(self.point_name_error(("structure.point", name), earlier, &remedy));
        }
        errors
    }

    /// What a scenario has and the equations of a flexible structure do not; each with its key
    /// and the remedy.
    fn not_on_a_structure(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        let mut reject = |key: String, message: &str| errors.push(range(&key, message.to_owned()));
        for (index, wrench) in self.wrenches.iter().enumerate() {
            match wrench.body {
                Target::Hub => {
                    let message = "a force on a flexible structure acts on one of its nodes; \
                                   write `on = \"NODE\"`";
                    reject(format!("wrench.{index}.on"), message);
                }
                Target::Node(_) if wrench.point != Vector3::zeros() => {
                    let message = "a force on a node acts at the node; remove `point`, or add a \
                                   node there";
                    reject(format!("wrench.{index}.point"), message);
                }
                Target::Joint(_) if wrench.axes == WrenchAxes::Inertial => {
                    let message = "on a device of a flexible structure, wrenches are in the \
                                   axes of the body; write `axes = \"body\"`, or put it on a node";
                    reject(format!("wrench.{index}.axes"), message);
                }
                Target::Node(_) | Target::Joint(_) => {}
            }
        }
        errors
    }
}

/// An error of the modes; one about a mount with the name of its node.
fn named(structure: &ModalStructure, error: ModesError) -> ScenarioError {
    let (ModesError::Contained { mount, .. }
    | ModesError::Residual { fault: ResidualFault::Contained { mount }, .. }) = error
    else {
        return ScenarioError::Modes(error);
    };
    let mounts = structure.mounts();
    let node = mounts.get(mount).and_then(|node| structure.nodes.get(*node));
    match node {
        Some(node) => {
            range("structure", format!("{error} (mount {mount} is node `{}`)", node.name))
        }
        None => ScenarioError::Modes(error),
    }
}

/// A set as one rigid body about B, joints at these coordinates.
fn set_as_one(
    set: &Set,
    coordinates: impl Iterator<Item = f64>,
) -> Result<RigidMass, ParameterError> {
    // Beside a massive body at B, which is subtracted again.
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    let craft = Spacecraft::new(&hub, set)?;
    let mut state: State<Set> = State::at_rest_for(&craft);
    for ([to, _], coordinate) in state.devices.states_mut().zip(coordinates) {
        *to = coordinate;
    }
    // H = I_B omega and p = omega x (m c), at omega = e_k.
    let mut inertia = Matrix3::zeros();
    let mut first_moment = Vector3::zeros();
    for axis in 0..3 {
        state.omega = Vector3::ith(axis, 1.0);
        let Ok(momentum) = craft.momentum(&state, About::InertialOrigin) else {
            let value = f64::NAN;
            return Err(ParameterError::TotalMass { value });
        };
        inertia.set_column(axis, &momentum.angular);
        first_moment += momentum.linear.cross(&state.omega) / 2.0;
    }
    Ok(RigidMass { mass: craft.mass() - hub.m_b, first_moment, inertia: inertia - hub.i_b_bc })
}

/// The next values.
fn next(values: &mut dyn Iterator<Item = usize>, count: usize) -> Vec<usize> {
    values.take(count).collect()
}

/// That of a carrier, and those of the devices on it.
fn carrier_and(values: &mut dyn Iterator<Item = usize>, devices: usize) -> (usize, Vec<usize>) {
    (values.next().unwrap_or(0), next(values, devices))
}

/// The same of a carrier that carries devices only.
fn data(
    values: &mut dyn Iterator<Item = usize>,
    devices: usize,
) -> platform::Data<usize, Vec<usize>> {
    let (carrier, carried) = carrier_and(values, devices);
    platform::Data { carrier, carried }
}
