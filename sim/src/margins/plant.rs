//! [`ControlledPlant`]: the averaged equations of motion of a scenario about rest, with the joints of a controller free.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector};
use precess_control::HeldPlant;
use precess_dynamics::{HubMode, Steered};

use super::MarginsError;
use super::measurement::{READ, sensed};
use crate::engine::{LinearAllocation, linear_allocation};
use crate::jitter::campbell::{device_rows, matrices, node_rows};
use crate::jitter::device::Steady;
use crate::jitter::model::{Model, Output};
use crate::scenario::{SampledController, Scenario, joint_key};
use crate::structure::dynamic_mass::Motor;
use crate::structure::{COORDINATES, Fault};

/// Coordinates of the translation, which are eliminated: nothing depends on place and velocity.
pub(super) const TRANSLATION: usize = 3;
/// A column of the stiffness that is less than this share of the largest element is rounding: nothing depends on the coordinate.
const STIFFNESS_MIN: f64 = 1e-12;

/// What is swept, and what motors of rotors that no controller commands do.
const STEADY: Steady<'_> = Steady { motor: Motor::ConstantTorque, sprung: true, swept: None };

/// Equations of first order: `x' = A x + B u`, and what the servo computes.
#[derive(Clone, Debug)]
pub struct ControlledPlant {
    /// The model of which these are the equations.
    pub model: Model,
    /// Speed of swept rotors, rad/s; of no effect where none is.
    pub speed: f64,
    /// `A`, of coordinates on which something depends, the attitude first, and all rates, the angular velocity first.
    pub a: DMatrix<f64>,
    /// `B`, by the torques of the motors that the controller commands.
    pub b: DMatrix<f64>,
    /// Steps of these.
    pub(super) held: HeldPlant,
    /// The servo: torques of motors by the state, by commands, and by loads on the coordinates.
    pub servo: [DMatrix<f64>; 3],
    /// What is commanded for small torques.
    pub(crate) allocation: LinearAllocation,
    /// Commands by the state beside those for the torque: by rates of joints.
    pub by_state: DMatrix<f64>,
    /// Commands by what the law reads, attitude and angular velocity.
    pub by_read: DMatrix<f64>,
    /// What sensors have of the motion, by the state: attitude of the star tracker, attitude and angular velocity of the gyro.
    pub sensed: DMatrix<f64>,
    /// Numbers of the coordinates that are states.
    pub(super) kept: Vec<usize>,
    /// How many coordinates there are, without the translation.
    pub(super) size: usize,
    /// What moves by each of these coordinates: `hub`, `mode 1`, `rw.tilt_y`.
    pub(super) names: Vec<String>,
    /// Accelerations by rates, gyroscopic terms only: `-M^-1 C_g`.
    pub(super) gyroscopic: DMatrix<f64>,
    /// Inverse of the mass matrix, without the translation.
    pub(super) inverse: DMatrix<f64>,
    /// From loads on all coordinates to those without the translation.
    pub(super) reduced: DMatrix<f64>,
    /// The translation by accelerations, rates, coordinates and loads on itself.
    pub(super) translation: [DMatrix<f64>; 4],
    /// Rows of the mount and of the free joints of each device.
    devices: Vec<DMatrix<f64>>,
    /// Rows of outputs by all coordinates.
    pub(super) outputs: DMatrix<f64>,
}

impl ControlledPlant {
    /// Of a scenario with its rotors at their initial rates.
    ///
    /// # Errors
    /// [`MarginsError`].
    pub fn new(
        scenario: &Scenario,
        of: &SampledController,
        outputs: &[Output],
    ) -> Result<Self, MarginsError> {
        let free: Vec<usize> = of.joints.iter().map(|own| own.joint).collect();
        let mut model = Model::with_free(scenario, outputs, &STEADY, &free)?;
        model.add_sources(scenario)?;
        Self::of_model(scenario, of, model, 0.0)
    }

    /// Of a model in which the commanded joints are free, at a speed of its swept rotors, rad/s.
    ///
    /// # Errors
    /// [`MarginsError`].
    pub(crate) fn of_model(
        scenario: &Scenario,
        of: &SampledController,
        model: Model,
        speed: f64,
    ) -> Result<Self, MarginsError> {
        if scenario.hub_mode != HubMode::Free {
            return Err(MarginsError::FixedHub);
        }
        let [mass, rates, stiffness] = matrices(&model, speed);
        let all = mass.nrows();
        let indefinite =
            || Fault::Indefinite { what: "mass matrix of structure and devices", size: all };
        let (t, size) = (TRANSLATION, all - TRANSLATION);
        let inverse_t =
            mass.view((0, 0), (t, t)).into_owned().try_inverse().ok_or_else(indefinite)?;
        let left = mass.view((t, 0), (size, t)) * &inverse_t;
        let without =
            |of: &DMatrix<f64>| of.view((t, t), (size, size)) - &left * of.view((0, t), (t, size));
        let [m, c, k] = [&mass, &rates, &stiffness].map(without);
        let mut reduced = DMatrix::zeros(size, all);
        reduced.columns_mut(0, t).copy_from(&-&left);
        reduced.view_mut((0, t), (size, size)).fill_with_identity();
        let of_translation = |of: &DMatrix<f64>| -&inverse_t * of.view((0, t), (t, size));
        let translation = [
            of_translation(&mass),
            of_translation(&rates),
            of_translation(&stiffness),
            inverse_t.clone(),
        ];
        let inverse = m.clone().try_inverse().ok_or_else(indefinite)?;
        let largest = k.amax();
        let rotations = COORDINATES - TRANSLATION;
        let moved = rotations + model.structure.modes.len();
        let kept: Vec<usize> = (0..size)
            .filter(|at| *at < moved || k.column(*at).amax() > STIFFNESS_MIN * largest)
            .collect();
        let states = kept.len() + size;
        let own = coordinates_of(&model);
        let coordinate = |joint: usize| -> Result<usize, MarginsError> {
            let found = own.iter().position(|of| *of == joint);
            let first = COORDINATES + model.structure.modes.len() - TRANSLATION;
            found.map(|index| first + index).ok_or(MarginsError::Joint { joint })
        };
        let commanded: Result<Vec<usize>, _> =
            of.joints.iter().map(|joint| coordinate(joint.joint)).collect();
        let commanded = commanded?;
        let (mut a, mut b) =
            (DMatrix::zeros(states, states), DMatrix::zeros(states, commanded.len()));
        for (row, at) in kept.iter().enumerate() {
            a[(row, kept.len() + at)] = 1.0;
        }
        let by_place = k.select_columns(&kept);
        a.view_mut((kept.len(), 0), (size, kept.len())).copy_from(&-(&inverse * &by_place));
        a.view_mut((kept.len(), kept.len()), (size, size)).copy_from(&-(&inverse * &c));
        b.rows_mut(kept.len(), size).copy_from(&inverse.select_columns(&commanded));
        let by_state = beside(&by_place, &c);
        let servo = servo(&m, &by_state, (&commanded, kept.len()), of).ok_or_else(indefinite)?;
        let joints: Vec<[f64; 2]> = states_of(scenario, &model, speed);
        let allocation = linear_allocation(scenario, of, &joints)?;
        let mut commands = DMatrix::zeros(commanded.len(), states);
        for (index, joint) in own.iter().enumerate() {
            let first = COORDINATES + model.structure.modes.len() - TRANSLATION;
            if *joint < allocation.by_rate.ncols() {
                let column = kept.len() + first + index;
                commands.column_mut(column).copy_from(&allocation.by_rate.column(*joint));
            }
        }
        let mut by_read = DMatrix::zeros(commanded.len(), READ);
        by_read.columns_mut(rotations, rotations).copy_from(&allocation.by_omega);
        let sensed = sensed(&model, of, (all, moved, kept.len()));
        let (devices, outputs) = (device_rows(&model), output_rows(&model, all));
        let names = names_of(scenario, &model, &own);
        Ok(Self {
            model,
            speed,
            held: HeldPlant::new(&a, &b),
            a,
            b,
            servo,
            allocation,
            by_state: commands,
            by_read,
            sensed,
            kept,
            size,
            names,
            gyroscopic: -(&inverse * (&c - c.transpose())) * 0.5,
            inverse,
            reduced,
            translation,
            devices,
            outputs,
        })
    }

    /// Rows of attitude and angular velocity of the hub, of the states.
    #[must_use]
    pub fn motion(&self) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(6, self.a.nrows());
        rows.view_mut((0, 0), (3, 3)).fill_with_identity();
        rows.view_mut((3, self.kept.len()), (3, 3)).fill_with_identity();
        rows
    }

    /// The load of a tone on the coordinates without the translation, and on the translation, for `exp(i w t)`, as its imbalance
    /// or its source exerts it; its angular frequency, rad/s.
    #[must_use]
    pub fn load(&self, device: usize, tone: usize) -> (f64, DVector<Complex<f64>>) {
        let none = || (0.0, DVector::zeros(self.reduced.ncols()));
        let Some((_, of)) = self.model.devices.get(device) else { return none() };
        let Some(tone) = of.tones.get(tone) else { return none() };
        let Some(rows) = self.devices.get(device) else { return none() };
        let force = of.force(tone, self.speed);
        let real = |part: DVector<f64>| rows.transpose() * part;
        let [re, im] = [force.map(|v| v.re), force.map(|v| v.im)].map(real);
        (of.frequency(tone, self.speed), re.zip_map(&im, Complex::new))
    }

    /// Loads on all coordinates by forces and moments on a mount, six columns.
    pub(super) fn mount_loads(&self, mount: usize) -> DMatrix<f64> {
        let node = self.model.mounts.get(mount).copied().unwrap_or(0);
        node_rows(&self.model, node, self.reduced.ncols()).transpose()
    }

    /// What averaging over the turns leaves out, as a share of the inertia, at an angular frequency, rad/s: the largest of all
    /// devices.
    ///
    /// # Errors
    /// Those of [`AveragedDevices::periodic`](crate::structure::averaged::AveragedDevices::periodic).
    pub fn periodic(&self, frequency: f64) -> Result<f64, Fault> {
        let each: Result<Vec<f64>, Fault> =
            self.model.devices.iter().map(|(_, of)| of.periodic(frequency)).collect();
        Ok(each?.into_iter().fold(0.0, f64::max))
    }

    /// Poles of the spacecraft by itself, in continuous time: frequency in Hz and damping ratio of each oscillation, rising.
    #[must_use]
    pub fn oscillations(&self) -> Vec<[f64; 2]> {
        let found = nalgebra::Schur::try_new(self.a.clone(), f64::EPSILON, 100_000);
        let values = found.map(|of| of.complex_eigenvalues()).unwrap_or_default();
        let mut all: Vec<[f64; 2]> = values
            .iter()
            .filter(|value| value.im > 1e-6)
            .map(|value| [value.norm() / TAU, -value.re / value.norm()])
            .collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        all
    }
}

/// The servo's torques `M_co x_o'' + M_cc a + C_c x' + K_c x - F_c`, with `x_o''` of the others from their equations and a of the
/// commanded joints as commanded.
fn servo(
    m: &DMatrix<f64>,
    by_state: &DMatrix<f64>,
    (commanded, first_rate): (&[usize], usize),
    of: &SampledController,
) -> Option<[DMatrix<f64>; 3]> {
    let size = m.nrows();
    let others: Vec<usize> = (0..size).filter(|at| !commanded.contains(at)).collect();
    let rows = |of: &DMatrix<f64>, at: &[usize]| of.select_rows(at);
    let inverse = rows(m, &others).select_columns(&others).try_inverse()?;
    // From the equations of the others to loads on the commanded joints.
    let coupled = rows(m, commanded).select_columns(&others) * inverse;
    let own = rows(m, commanded).select_columns(commanded)
        - &coupled * rows(m, &others).select_columns(commanded);
    let mut by_load = DMatrix::zeros(commanded.len(), size);
    for (index, at) in others.iter().enumerate() {
        by_load.column_mut(*at).copy_from(&coupled.column(index));
    }
    for (index, at) in commanded.iter().enumerate() {
        by_load[(index, *at)] = -1.0;
    }
    let mut states = rows(by_state, commanded) - &coupled * rows(by_state, &others);
    let mut commands = own.clone();
    for (index, (joint, at)) in of.joints.iter().zip(commanded).enumerate() {
        if joint.steered == Steered::Rate {
            let fed = own.column(index) * of.servo.gain;
            let mut column = states.column_mut(first_rate + at);
            column -= &fed;
            commands.column_mut(index).copy_from(&fed);
        }
    }
    Some([states, commands, by_load])
}

/// The joints of the scenario that are coordinates, in their order.
fn coordinates_of(model: &Model) -> Vec<usize> {
    let of = |(_, device): &(usize, crate::jitter::device::SweptDevice)| {
        let first = device.first_joint;
        device.free.iter().map(|joint| first + joint).collect::<Vec<_>>()
    };
    model.devices.iter().flat_map(of).collect()
}

/// What moves by each coordinate but those of the translation: the hub, modes, joints of these numbers.
fn names_of(scenario: &Scenario, model: &Model, joints: &[usize]) -> Vec<String> {
    let rotations = std::iter::repeat_n("hub".to_owned(), COORDINATES - TRANSLATION);
    let modes = (1..=model.structure.modes.len()).map(|number| format!("mode {number}"));
    let known: Vec<_> = scenario.joints().collect();
    let joint = |number: &usize| {
        let known = known.get(*number);
        known.map_or_else(String::new, |(_, device, info)| format!("{device}.{}", joint_key(info)))
    };
    rotations.chain(modes).chain(joints.iter().map(joint)).collect()
}

/// Coordinates and rates of all joints in the mean motion, rotors at their rates at a speed, all others at rest.
fn states_of(scenario: &Scenario, model: &Model, speed: f64) -> Vec<[f64; 2]> {
    let mut states: Vec<[f64; 2]> = scenario.mean_joints().map(|[at, _]| [at, 0.0]).collect();
    for (_, device) in &model.devices {
        for rotor in &device.rotors {
            if let Some([_, rate]) = states.get_mut(device.first_joint + rotor.joint) {
                *rate = rotor.rate(speed);
            }
        }
    }
    states
}

/// Rows of the model's outputs by all coordinates.
fn output_rows(model: &Model, all: usize) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(model.outputs.len(), all);
    for (index, node) in model.output_nodes.iter().enumerate() {
        let sensitivities = model.rows.columns(COORDINATES * index, COORDINATES);
        rows += sensitivities * node_rows(model, *node, all);
    }
    rows
}

fn beside(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = DMatrix::zeros(left.nrows(), left.ncols() + right.ncols());
    both.columns_mut(0, left.ncols()).copy_from(left);
    both.columns_mut(left.ncols(), right.ncols()).copy_from(right);
    both
}
