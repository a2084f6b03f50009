//! Dynamic mass of any set of devices at its mount, by the exact linearisation of the solver, averaged over a
//! turn of each rotor.
//!
//! The mount is a hub whose motion is prescribed and that is at rest; rotors turn steadily. With `y` for the
//! accelerations of the mount (acceleration of the mount, angular acceleration) and of the free joints,
//! [`Spacecraft::linearize`] gives the load that acts on the mount and the motor torques that the free joints
//! need, for the motion `y exp(i w t)`:
//!
//! ```text
//! f = Z y      Z(w) = M + C / (i w) - K / w^2      M_w = Z_hh - Z_hq Z_qq^-1 Z_qh
//! ```
//!
//! with derivatives `M` by accelerations, `C` by rates and `K` by coordinates: gyroscopic terms, springs, dampers
//! and friction among them. A joint whose motor keeps its torque is free (`q`), one whose motor keeps its rate
//! has no row. About rotors that turn, `M`, `C` and `K` are trigonometric polynomials of second degree in each
//! angle: five angles give their means and harmonics exactly. The means are used; [`AveragedDevices::periodic`]
//! bounds what is left out. The derivative by the angle of a rotor has the mean zero, exactly: a free spin keeps
//! its angular momentum, and no inertia about its axis reaches the mount.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointInfo, JointStates};
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    Axis, DerivativeError, Hub, HubMode, Inputs, Linearization, LoadAxes, Mode, Output, Outputs,
    Spacecraft, State, Variable,
};

use super::accelerance::ComplexMatrix;
use super::condensed::{Derivatives, at, condensed};
use super::dynamic_mass::Motor;
use super::harmonics::{fourier, share};
use super::{COORDINATES, Fault, rigid_rows, within};
use precess_craft::Set;

/// Mass, kg, and inertia, kg m², of the hub that stands for the mount: less than rounding of any device.
const OF_MOUNT: f64 = 1e-60;
/// Angles that give the mean of a trigonometric polynomial of second degree, and its harmonics.
const ANGLES: usize = 5;
/// Rotors in one chain of joints, at most: angles are combined.
const ROTORS_MAX: usize = 4;
/// A mean stiffness about the axis of a rotor that is rounding, of the squared rate times the inertia.
const STIFFNESS_MAX: f64 = 1e-9;

/// Devices on a mount, linearised about steady rates and averaged over a turn of each rotor.
#[derive(Clone, Debug)]
pub struct AveragedDevices {
    mean: Derivatives,
    /// Harmonics of each rotor, without the mean.
    harmonics: Vec<[ComplexMatrix; 3]>,
    /// Roots of the diagonal of the mean of M.
    scale: DVector<f64>,
}

/// The hub that stands for the mount.
pub(crate) fn mount_hub() -> Hub {
    let i_b_bc = Matrix3::from_diagonal_element(OF_MOUNT);
    Hub { m_b: OF_MOUNT, r_bc_b: Vector3::zeros(), i_b_bc }
}

/// What linearises a set.
type Linearize<D> = fn(
    &Spacecraft<D>,
    &State<D>,
    &Inputs<D>,
    &Outputs,
) -> Result<Linearization<D>, DerivativeError>;

/// What is linearised.
struct Mounted<D: WithNumbers<Scalar = f64>> {
    craft: Spacecraft<D>,
    state: State<D>,
    inputs: Inputs<D>,
    /// Numbers of the free joints.
    free: Vec<usize>,
    linearize: Linearize<D>,
}

impl AveragedDevices {
    /// Devices with the parameters that they have on a hub, whose mount is at `mount`, m, from B: coordinate and
    /// rate of each joint, and what its motor does, in the order of [`Spacecraft::joints`].
    ///
    /// A joint at zero rate whose motor keeps its rate is locked. A joint that the kind does not drive keeps its
    /// rate. Every joint with a rate turns as a rotor does; its angle does not matter.
    ///
    /// # Errors
    /// [`Fault::Shape`] for other numbers of joints; [`Fault::Range`] for a rate of a joint that slides, and for
    /// a rotor on a spring; [`Fault::Number`] of more than four rotors in one chain; [`Fault::Device`] where
    /// parameters or state are rejected.
    pub fn new<D: WithNumbers<Scalar = f64>>(
        devices: &D,
        mount: &Vector3<f64>,
        joints: &[[f64; 2]],
        motors: &[Motor],
    ) -> Result<Self, Fault> {
        Self::by(Spacecraft::linearize, devices, mount, joints, motors)
    }

    /// The same of a scenario's set, whose derivatives are compiled with its solver.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_set(
        devices: &Set,
        mount: &Vector3<f64>,
        joints: &[[f64; 2]],
        motors: &[Motor],
    ) -> Result<Self, Fault> {
        Self::by(precess_craft::linearize_rigid, devices, mount, joints, motors)
    }

    fn by<D: WithNumbers<Scalar = f64>>(
        linearize: Linearize<D>,
        devices: &D,
        mount: &Vector3<f64>,
        joints: &[[f64; 2]],
        motors: &[Motor],
    ) -> Result<Self, Fault> {
        let rejected = |error| Fault::Device(DerivativeError::Parameter(error));
        let craft = Spacecraft::new(&mount_hub(), devices).map_err(rejected)?;
        let infos: Vec<_> = craft.joints().collect();
        for (what, found) in [("the joints", joints.len()), ("the motors", motors.len())] {
            if found != infos.len() {
                let (what, wanted) = (what.into(), vec![infos.len()]);
                return Err(Fault::Shape { what, found: vec![found], wanted });
            }
        }
        let rotors = rotors(&infos, joints)?;
        let mut mounted = Mounted::new(linearize, craft, joints, motors);
        let at_start = mounted.derivatives()?;
        let mut mean = at_start.clone();
        let mut harmonics = Vec::new();
        for chain in rotors.values() {
            let samples = mounted.turned(chain, joints, &at_start)?;
            let mut parts = fourier(&samples);
            // What turns with this chain is the only part that differs from the start.
            for ((mean, start), of_chain) in mean.iter_mut().zip(&at_start).zip(parts.remove(0)) {
                *mean += of_chain.map(|value| value.re) - start;
            }
            harmonics.extend(parts);
        }
        let turning: Vec<_> = rotors.into_values().flatten().collect();
        mounted.without_angles(&turning, joints, &mut mean)?;
        let motion = motion(mount, mounted.free.len());
        let moved = motion.map(|value| Complex::new(value, 0.0));
        let mean = mean.map(|matrix| motion.transpose() * matrix * &motion);
        let harmonics = harmonics
            .into_iter()
            .map(|parts| parts.map(|matrix| moved.transpose() * matrix * &moved))
            .collect();
        let [mass, ..] = &mean;
        let scale = mass.diagonal().map(|value| value.max(0.0).sqrt());
        Ok(Self { mean, harmonics, scale })
    }

    /// The number of free joints.
    #[must_use]
    pub fn free_joints(&self) -> usize {
        self.scale.len().saturating_sub(COORDINATES)
    }

    /// Means of the derivatives by accelerations, rates and coordinates: six rows and columns of the mount, and
    /// one of each free joint.
    #[must_use]
    pub fn mean(&self) -> &[DMatrix<f64>; 3] {
        &self.mean
    }

    /// The 6 × 6 dynamic mass about the mount at an angular frequency, rad/s: kg, kg m, kg m².
    ///
    /// # Errors
    /// [`Fault::Range`] for a frequency that is not above zero; [`Fault::Unbounded`] at a resonance of free
    /// joints without damping.
    pub fn dynamic_mass(&self, frequency: f64) -> Result<ComplexMatrix, Fault> {
        condensed(&self.mean, frequency).map(|condensed| condensed.mass)
    }

    /// What averaging leaves out, at an angular frequency, rad/s, as a share of the inertia: the sum over rotors
    /// and harmonics `k` of the norm of `S^-1 Z_k S^-1`, with `S^2` the diagonal of the mean of `M`.
    ///
    /// For a motion `y` at `w` and any angles of the rotors, the loads at `w ± Omega` and `w ± 2 Omega` that are
    /// left out are in this norm at most so many times the motion: `|S^-1 f| <= periodic(w) |S y|`. The load at
    /// `w` is changed in its second order.
    ///
    /// # Errors
    /// [`Fault::Range`] for a frequency that is not above zero.
    pub fn periodic(&self, frequency: f64) -> Result<f64, Fault> {
        let weights = self.scale.map(|s| if s > 0.0 { s.recip() } else { 0.0 });
        let mut sum = 0.0;
        for parts in &self.harmonics {
            let whole = at(parts, frequency)?;
            let weighted = DMatrix::from_fn(whole.nrows(), whole.ncols(), |row, column| {
                whole[(row, column)].norm() * weights[row] * weights[column]
            });
            sum += weighted.norm();
        }
        Ok(sum)
    }
}

/// The joints with a rate, by the device that they belong to.
fn rotors(
    infos: &[(usize, &'static JointInfo)],
    joints: &[[f64; 2]],
) -> Result<BTreeMap<usize, Vec<usize>>, Fault> {
    let mut rotors: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (joint, ((device, info), [_, rate])) in infos.iter().zip(joints).enumerate() {
        if *rate == 0.0 {
            continue;
        }
        if info.slides {
            let what = format!("{} of device {device}, m/s,", info.rate);
            return Err(Fault::Range { what, value: *rate, range: [0.0, 0.0] });
        }
        rotors.entry(*device).or_default().push(joint);
    }
    match rotors.values().map(Vec::len).find(|count| *count > ROTORS_MAX) {
        Some(found) => {
            let what = String::from("joints with a rate in one device");
            Err(Fault::Number { what, found, range: [0, ROTORS_MAX] })
        }
        None => Ok(rotors),
    }
}

impl<D: WithNumbers<Scalar = f64>> Mounted<D> {
    fn new(
        linearize: Linearize<D>,
        craft: Spacecraft<D>,
        joints: &[[f64; 2]],
        motors: &[Motor],
    ) -> Self {
        let mut state = State::at_rest_for(&craft);
        for (to, [at, rate]) in state.devices.states_mut().zip(joints) {
            let [coordinate, its_rate] = to;
            (*coordinate, *its_rate) = (*at, *rate);
        }
        let mut inputs = Inputs::none_for(&craft);
        let [r_b_n_ddot, omega_dot] = [Vector3::zeros(), Vector3::zeros()];
        inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot };
        let mut free = Vec::new();
        let modes = inputs.modes.values_mut().zip(craft.joints()).zip(motors).zip(joints);
        for (joint, (((mode, (_, info)), motor), [_, rate])) in modes.enumerate() {
            match motor {
                Motor::ConstantTorque if info.driven => {
                    *mode = Mode::Driven;
                    free.push(joint);
                }
                _ if *rate == 0.0 => *mode = Mode::Locked,
                _ => *mode = Mode::Prescribed(0.0),
            }
        }
        Self { craft, state, inputs, free, linearize }
    }

    /// Derivatives at the state, with the motors that keep its rates steady.
    fn derivatives(&self) -> Result<Derivatives, Fault> {
        let Self { craft, state, free, .. } = self;
        let free_ones = |of: fn(usize) -> Variable| free.iter().copied().map(of);
        let mut inputs = self.inputs.clone();
        let outputs = Outputs { momentum: None, loads: Some(LoadAxes::Hub) };
        let linearized = |inputs: &Inputs<D>| {
            (self.linearize)(craft, state, inputs, &outputs).map_err(Fault::Device)
        };
        let system = linearized(&inputs)?;
        let motors = places(&system.inputs, free_ones(Variable::Motor));
        let rates = places(&system.states, free_ones(Variable::Rate));
        let gain = system.b.select_rows(&rates).select_columns(&motors);
        let indefinite =
            || Fault::Indefinite { what: "mass matrix of the free joints", size: free.len() };
        let mass = gain.try_inverse().ok_or_else(indefinite)?;
        let found: Vec<_> = system.accelerations.devices.values().collect();
        let found = free.iter().filter_map(|joint| found.get(*joint).copied());
        let torques = -(&mass * DVector::from_iterator(free.len(), found));
        for (joint, torque) in free.iter().zip(&torques) {
            if let Some(motor) = inputs.motors.values_mut().nth(*joint) {
                *motor = *torque;
            }
        }
        let system = linearized(&inputs)?;
        let of_hub = Axis::ALL.map(Output::HubForce).into_iter();
        let of_hub = places(&system.outputs, of_hub.chain(Axis::ALL.map(Output::HubMoment)));
        let forces = system.d.select_rows(&of_hub).select_columns(&motors) * &mass;
        // At the accelerations as they are: load on the hub, and motors of the free joints.
        let rows = |slopes: DMatrix<f64>, loads: DMatrix<f64>| {
            stacked(&(loads - &forces * &slopes), &-(&mass * slopes))
        };
        let by_state = |columns: &[usize]| {
            let of = |matrix: &DMatrix<f64>, rows: &[usize]| {
                matrix.select_rows(rows).select_columns(columns)
            };
            rows(of(&system.a, &rates), of(&system.c, &of_hub))
        };
        let accelerations = Axis::ALL.map(Variable::HubAcceleration).into_iter();
        let accelerations = places(
            &system.inputs,
            accelerations.chain(Axis::ALL.map(Variable::HubAngularAcceleration)),
        );
        let of = |matrix: &DMatrix<f64>, rows: &[usize]| {
            matrix.select_rows(rows).select_columns(&accelerations)
        };
        let by_hub = rows(of(&system.b, &rates), of(&system.d, &of_hub));
        let omega = by_state(&places(&system.states, Axis::ALL.map(Variable::Omega)));
        let size = COORDINATES + free.len();
        let none = |columns| DMatrix::zeros(size, columns);
        Ok([
            beside(&[by_hub, stacked(&forces, &mass)]),
            beside(&[none(3), omega, by_state(&rates)]),
            beside(&[
                none(COORDINATES),
                by_state(&places(&system.states, free_ones(Variable::Coordinate))),
            ]),
        ])
    }

    /// Derivatives over the turns of the rotors of a chain: five angles of the first, and so on.
    fn turned(
        &mut self,
        chain: &[usize],
        joints: &[[f64; 2]],
        at_start: &Derivatives,
    ) -> Result<Vec<Derivatives>, Fault> {
        let count = (0..chain.len()).fold(1, |count, _| count * ANGLES);
        let mut samples = vec![at_start.clone()];
        for sample in 1..count {
            let mut stride = 1;
            for joint in chain {
                self.turn(*joint, joints, TAU * share(sample * stride % count, count));
                stride *= ANGLES;
            }
            samples.push(self.derivatives()?);
        }
        for joint in chain {
            self.turn(*joint, joints, 0.0);
        }
        Ok(samples)
    }

    /// Turns a joint from where it starts.
    fn turn(&mut self, joint: usize, joints: &[[f64; 2]], by: f64) {
        let start = joints.get(joint).map_or(0.0, |[coordinate, _]| *coordinate);
        if let Some([coordinate, _]) = self.state.devices.states_mut().nth(joint) {
            *coordinate = start + by;
        }
    }

    /// Without the derivatives by the angles of rotors, whose mean is zero.
    fn without_angles(
        &self,
        turning: &[usize],
        joints: &[[f64; 2]],
        [mass, _, stiffness]: &mut Derivatives,
    ) -> Result<(), Fault> {
        for (index, joint) in self.free.iter().enumerate() {
            if !turning.contains(joint) {
                continue;
            }
            let at = COORDINATES + index;
            let rate = joints.get(*joint).map_or(0.0, |[_, rate]| *rate);
            let bound = STIFFNESS_MAX * rate * rate * mass[(at, at)];
            let what =
                format!("mean stiffness about the axis of joint {joint}, which spins, N m/rad,");
            within(what, stiffness[(at, at)], [-bound, bound])?;
            stiffness.column_mut(at).fill(0.0);
        }
        Ok(())
    }
}

/// Where variables or outputs are in a list.
fn places<V: PartialEq>(all: &[V], wanted: impl IntoIterator<Item = V>) -> Vec<usize> {
    let place = |wanted: V| all.iter().position(|one| *one == wanted);
    wanted.into_iter().filter_map(place).collect()
}

/// One matrix above another.
fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = DMatrix::zeros(above.nrows() + below.nrows(), above.ncols());
    both.rows_mut(0, above.nrows()).copy_from(above);
    both.rows_mut(above.nrows(), below.nrows()).copy_from(below);
    both
}

/// Matrices side by side.
fn beside(parts: &[DMatrix<f64>]) -> DMatrix<f64> {
    let columns: Vec<_> = parts.iter().flat_map(DMatrix::column_iter).collect();
    DMatrix::from_columns(&columns)
}

/// Motion of B and of the joints by that of the mount and of the joints.
fn motion(mount: &Vector3<f64>, joints: usize) -> DMatrix<f64> {
    let mut motion = DMatrix::identity(COORDINATES + joints, COORDINATES + joints);
    motion.view_mut((0, 0), (COORDINATES, COORDINATES)).copy_from(&rigid_rows(&-mount));
    motion
}
