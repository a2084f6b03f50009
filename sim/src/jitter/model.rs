//! [`Model`]: a structure with devices in steady spin, and lines of sight, at one speed.

use nalgebra::{Complex, DMatrix, Vector3};

use super::device::{Steady, SweptDevice};
use super::sources::MountNoise;
use crate::scenario::steady::SteadyJoints;
use crate::scenario::{ModalStructure, Scenario, set_of};
use crate::structure::accelerance::{Accelerance, Base, ComplexMatrix};
use crate::structure::averaged::AveragedDevices;
use crate::structure::condensed::Condensed;
use crate::structure::dynamic_mass::Motor;
use crate::structure::{COORDINATES, Fault, Mode, Node, RigidMass, Structure};

/// The node of a rigid hub: B.
pub const HUB: &str = "hub";

/// A quantity that is a sum over small displacements and rotations of nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Its name: `camera x`.
    pub name: String,
    /// Node and sensitivities to its displacement, 1/m, and rotation, each expressed in B.
    pub terms: Vec<(String, [f64; COORDINATES])>,
}

/// Structure, devices and outputs.
#[derive(Clone, Debug)]
pub struct Model {
    /// The devices, each with the number of its mount.
    pub devices: Vec<(usize, SweptDevice)>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
    /// The structure; a rigid hub has no modes.
    pub structure: Structure,
    /// Nodes of the mounts.
    pub mounts: Vec<usize>,
    /// What the structure's model has of the devices at each mount, to be taken off.
    pub(super) contained: Vec<Option<DMatrix<f64>>>,
    /// Broadband noise on mounts.
    pub noises: Vec<MountNoise>,
    accelerance: Accelerance,
    /// A row for each output, six columns for each of its nodes.
    pub(crate) rows: DMatrix<f64>,
    /// The nodes of these columns.
    pub(crate) output_nodes: Vec<usize>,
    /// The accelerance of mounts, and below it of the outputs.
    to_outputs: Accelerance,
}

/// A tone of a device in a list of all.
#[derive(Clone, Debug, PartialEq)]
pub struct Contributor {
    /// The rotor: `rw1.wheel`.
    pub rotor: String,
    /// What causes it.
    pub cause: String,
    /// Harmonic number.
    pub order: f64,
    /// Number of the device, and of the tone in it.
    pub place: [usize; 2],
}

/// What a tone does at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Number of the contributor.
    pub contributor: usize,
    /// Angular frequency, rad/s.
    pub frequency: f64,
    /// Complex amplitude of each output, for `exp(i w t)`.
    pub values: Vec<Complex<f64>>,
}

impl Model {
    /// Of a scenario: its hub or structure, all its devices, and outputs at nodes that it records (of a rigid hub, the
    /// node `hub`).
    ///
    /// # Errors
    /// [`Fault::UnknownNode`] for an output at no node; those of [`SweptDevice::new`] and [`Accelerance::new`].
    pub fn new(
        scenario: &Scenario,
        outputs: &[Output],
        steady: &Steady<'_>,
    ) -> Result<Self, Fault> {
        Self::with_free(scenario, outputs, steady, &[])
    }

    /// The same with more joints free, by their numbers among those of the scenario: those that a controller commands.
    pub(crate) fn with_free(
        scenario: &Scenario,
        outputs: &[Output],
        steady: &Steady<'_>,
        free: &[usize],
    ) -> Result<Self, Fault> {
        let structure = structure_of(scenario);
        let of_scenario = scenario.structure.as_ref();
        let mut mounts: Vec<usize> = Vec::new();
        let (mut devices, mut contained) = (Vec::new(), Vec::new());
        for group in scenario.groups() {
            let first = group.first().copied().unwrap_or(0);
            let node = of_scenario.map_or(Some(0), |s| s.on_node.get(first).copied()).unwrap_or(0);
            let place = structure.nodes.get(node).map_or_else(Vector3::zeros, |n| n.position);
            let known = mounts.iter().position(|mount| *mount == node);
            let mount = known.unwrap_or_else(|| {
                mounts.push(node);
                contained.push(None);
                mounts.len() - 1
            });
            if of_scenario.is_some_and(|structure| structure.contains_devices) {
                let mass = rigid_mass(scenario, &group, &place)?;
                if let Some(contained) = contained.get_mut(mount) {
                    *contained = Some(contained.take().map_or(mass.clone(), |sum| sum + mass));
                }
            }
            let device = SweptDevice::with_free(scenario, &group, &place, steady, free)?;
            devices.push((mount, device));
        }
        let mut nodes = Vec::new();
        for (node, _) in outputs.iter().flat_map(|output| &output.terms) {
            let node = structure.node(node)?;
            if !nodes.contains(&node) {
                nodes.push(node);
            }
        }
        let mut rows = DMatrix::zeros(outputs.len(), COORDINATES * nodes.len());
        for (row, output) in outputs.iter().enumerate() {
            for (node, sensitivities) in &output.terms {
                let node = structure.node(node)?;
                let column = nodes.iter().position(|known| *known == node).unwrap_or(0);
                for (axis, value) in sensitivities.iter().enumerate() {
                    let what = format!("a sensitivity of `{}`", output.name);
                    crate::structure::within(what, *value, [-1e12, 1e12])?;
                    rows[(row, COORDINATES * column + axis)] += value;
                }
            }
        }
        let to: Vec<usize> = mounts.iter().chain(&nodes).copied().collect();
        let accelerance = Accelerance::new(&structure, Base::Free, &to, &mounts)?;
        let to_outputs = accelerance.combined(&below_mounts(&rows, COORDINATES * mounts.len()));
        Ok(Self {
            devices,
            outputs: outputs.iter().map(|output| output.name.clone()).collect(),
            structure,
            mounts,
            contained,
            noises: Vec::new(),
            accelerance,
            rows,
            output_nodes: nodes,
            to_outputs,
        })
    }

    /// The tones of all devices, in order.
    #[must_use]
    pub fn contributors(&self) -> Vec<Contributor> {
        let mut all = Vec::new();
        for (device, (_, of)) in self.devices.iter().enumerate() {
            for (index, tone) in of.tones.iter().enumerate() {
                let rotor = of.rotors.get(tone.rotor).map(|rotor| rotor.name.clone());
                all.push(Contributor {
                    rotor: rotor.unwrap_or_default(),
                    cause: tone.cause.clone(),
                    order: tone.order,
                    place: [device, index],
                });
            }
        }
        all
    }

    /// What every tone does to every output at a speed, rad/s, in the order of the contributors.
    ///
    /// # Errors
    /// [`Fault::Unbounded`] at a resonance without damping; [`Fault::Range`] for a speed of zero.
    pub fn lines(&self, speed: f64) -> Result<Vec<Line>, Fault> {
        // Frequency, number of the contributor, and its place.
        let mut tones: Vec<(f64, usize, [usize; 2])> = Vec::new();
        for (device, (_, of)) in self.devices.iter().enumerate() {
            for (tone, place) in of.tones.iter().zip((0..).map(|index| [device, index])) {
                tones.push((of.frequency(tone, speed), tones.len(), place));
            }
        }
        tones.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut lines = Vec::with_capacity(tones.len());
        for shared in tones.chunk_by(|a, b| a.0.to_bits() == b.0.to_bits()) {
            let frequency = shared.first().map_or(0.0, |(frequency, ..)| *frequency);
            let places: Vec<[usize; 2]> = shared.iter().map(|(.., place)| *place).collect();
            let found = self.at(speed, frequency, &places)?;
            for ((_, contributor, _), column) in shared.iter().zip(found.column_iter()) {
                let values = column.iter().copied().collect();
                lines.push(Line { contributor: *contributor, frequency, values });
            }
        }
        lines.sort_by_key(|line| line.contributor);
        Ok(lines)
    }

    /// Amplitudes of the outputs, a column for each tone, all of one frequency.
    fn at(&self, speed: f64, frequency: f64, tones: &[[usize; 2]]) -> Result<ComplexMatrix, Fault> {
        let mounted = self.mounted(speed, frequency, tones)?;
        self.outputs_of(&mounted, frequency)
    }

    /// Outputs of mounted forces.
    fn outputs_of(&self, mounted: &MountedTones, frequency: f64) -> Result<ComplexMatrix, Fault> {
        let of_mounts = COORDINATES * self.mounts.len();
        let moved = mounted.accelerance.rows(of_mounts, mounted.accelerance.nrows() - of_mounts);
        let rows = self.rows.map(|value| Complex::new(-value / (frequency * frequency), 0.0));
        let found = rows * (moved * &mounted.force);
        if found.iter().all(|value| value.re.is_finite() && value.im.is_finite()) {
            Ok(found)
        } else {
            Err(Fault::Unbounded { frequency })
        }
    }

    /// Mounted forces of tones of one frequency.
    pub(super) fn mounted(
        &self,
        speed: f64,
        frequency: f64,
        tones: &[[usize; 2]],
    ) -> Result<MountedTones, Fault> {
        let of_mounts = COORDINATES * self.mounts.len();
        let devices = self.condensed(speed, frequency)?;
        let mut blocked = ComplexMatrix::zeros(of_mounts, tones.len());
        for (column, [of, tone]) in tones.iter().enumerate() {
            let of = self.devices.get(*of).zip(devices.get(*of));
            let tone = of.and_then(|((_, device), _)| device.tones.get(*tone));
            if let (Some(((mount, device), condensed)), Some(tone)) = (of, tone) {
                let force = device.blocked(tone, speed, condensed);
                blocked.view_mut((COORDINATES * mount, column), (COORDINATES, 1)).copy_from(&force);
            }
        }
        self.forced(frequency, devices, blocked)
    }

    /// The devices at a frequency, in order.
    pub(super) fn condensed(&self, speed: f64, frequency: f64) -> Result<Vec<Condensed>, Fault> {
        self.devices.iter().map(|(_, device)| device.condensed(speed, frequency)).collect()
    }

    /// Mounted forces of blocked ones.
    fn forced(
        &self,
        frequency: f64,
        devices: Vec<Condensed>,
        blocked: ComplexMatrix,
    ) -> Result<MountedTones, Fault> {
        let accelerance = self.accelerance.at(frequency)?;
        let system = self.system(&accelerance, &devices);
        let mut force = blocked;
        if !system.lu().solve_mut(&mut force) {
            return Err(Fault::Unbounded { frequency });
        }
        Ok(MountedTones { accelerance, force, devices })
    }

    /// `1 + M A_mm`, a row of blocks for each mount.
    pub(super) fn system(
        &self,
        accelerance: &ComplexMatrix,
        devices: &[Condensed],
    ) -> ComplexMatrix {
        let (size, of_mounts) = (COORDINATES, COORDINATES * self.mounts.len());
        let own = accelerance.rows(0, of_mounts);
        let mut masses: Vec<_> = vec![ComplexMatrix::zeros(size, size); self.mounts.len()];
        for (sum, contained) in masses.iter_mut().zip(&self.contained) {
            if let Some(mass) = contained {
                sum.zip_apply(mass, |sum, mass| *sum -= mass);
            }
        }
        for ((mount, _), condensed) in self.devices.iter().zip(devices) {
            if let Some(sum) = masses.get_mut(*mount) {
                *sum += &condensed.mass;
            }
        }
        let mut system = ComplexMatrix::identity(of_mounts, of_mounts);
        for (mount, mass) in masses.iter().enumerate() {
            let mut rows = system.rows_mut(size * mount, size);
            rows += mass * own.rows(size * mount, size);
        }
        system
    }

    /// Scales the frequency (0) or the damping ratio (1) of a mode.
    pub(super) fn scale_mode(&mut self, mode: usize, which: usize, factor: f64) {
        if let Some(of) = self.structure.modes.get_mut(mode) {
            if which == 0 {
                of.frequency *= factor;
            } else {
                of.damping *= factor;
            }
            let values = [of.frequency, of.damping];
            self.accelerance.set_mode(mode, values);
            self.to_outputs.set_mode(mode, values);
        }
    }

    /// Each device as a rigid body at rest: 6 × 6 about its mount.
    pub(super) fn rigid_masses(&self, scenario: &Scenario) -> Result<Vec<DMatrix<f64>>, Fault> {
        let groups = scenario.groups().into_iter().zip(&self.devices);
        let of = |(group, (mount, _)): (Vec<usize>, &(usize, SweptDevice))| {
            let node = self.mounts.get(*mount).and_then(|node| self.structure.nodes.get(*node));
            let place = node.map_or_else(Vector3::zeros, |node| node.position);
            rigid_mass(scenario, &group, &place)
        };
        groups.map(of).collect()
    }

    /// The accelerance of mounts and nodes by forces on the mounts.
    pub(super) fn accelerance(&self) -> &Accelerance {
        &self.accelerance
    }

    /// The accelerance of mounts and outputs by forces on the mounts.
    pub(super) fn to_outputs(&self) -> &Accelerance {
        &self.to_outputs
    }
}

/// Rows of the mounts as they are, and below them rows that combine those of the nodes.
fn below_mounts(rows: &DMatrix<f64>, of_mounts: usize) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(of_mounts + rows.nrows(), of_mounts + rows.ncols());
    all.view_mut((0, 0), (of_mounts, of_mounts)).fill_with_identity();
    all.view_mut((of_mounts, of_mounts), rows.shape()).copy_from(rows);
    all
}

/// Tones of one frequency on their mounts.
pub(super) struct MountedTones {
    /// Of mounts, then nodes, by forces on the mounts.
    pub(super) accelerance: ComplexMatrix,
    /// Mounted forces: six rows for each mount, a column for each tone.
    pub(super) force: ComplexMatrix,
    /// The devices at this frequency.
    pub(super) devices: Vec<Condensed>,
}

/// Devices as a rigid body at rest: 6 × 6 about their mount.
fn rigid_mass(
    scenario: &Scenario,
    group: &[usize],
    mount: &Vector3<f64>,
) -> Result<DMatrix<f64>, Fault> {
    let joints = SteadyJoints::new(scenario, group, Motor::ConstantRate, false);
    let still: Vec<_> = joints.states.iter().map(|[x, _]| [*x, 0.0]).collect();
    let held = vec![Motor::ConstantRate; still.len()];
    let averaged = AveragedDevices::of_set(&set_of(scenario, group), mount, &still, &held)?;
    let [mass, ..] = averaged.mean();
    Ok(mass.clone())
}

/// The static response of the residual coordinates, whose shapes these are, at all nodes.
fn residual_flexibility(coordinates: &[Mode], shapes: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let shares = coordinates.iter().zip(shapes.column_iter()).map(|(of, shape)| {
        let scaled = shape / (of.frequency * of.frequency);
        scaled * shape.transpose()
    });
    shares.reduce(|sum, share| sum + share)
}

/// The structure of a scenario; a rigid hub is one without modes.
fn structure_of(scenario: &Scenario) -> Structure {
    let hub = &scenario.hub;
    let mass = RigidMass::about_centre(hub.m_b, hub.r_bc_b, hub.i_b_bc);
    let mut structure = Structure {
        name: scenario.name.clone(),
        nodes: vec![Node { name: HUB.to_owned(), position: Vector3::zeros() }],
        modes: Vec::new(),
        shapes: DMatrix::zeros(COORDINATES, 0),
        mass: Some(mass),
        mass_matrix: None,
        residual: None,
        has_devices: None,
        initial: Vec::new(),
    };
    if let Some(of) = &scenario.structure {
        let ModalStructure { nodes, contains_devices, .. } = of;
        let modes = of.massive();
        let node = |of: &crate::scenario::StructureNode| Node {
            name: of.name.clone(),
            position: of.position,
        };
        structure.nodes = nodes.iter().map(node).collect();
        structure.modes = modes.to_vec();
        structure.has_devices = Some(*contains_devices);
        let (shapes, first) = (of.shapes(), modes.len());
        structure.shapes = shapes.columns(0, first).into_owned();
        let coordinates = of.modes.get(first..).unwrap_or_default();
        let of_coordinates = shapes.columns(first, coordinates.len()).into_owned();
        structure.residual = residual_flexibility(coordinates, &of_coordinates);
    }
    structure
}
