//! [`MeanAcceleration`]: how a settled run departs from its mean, in the second order of the imbalances.
//!
//! Rotors of one speed move each other's mounts at their own frequency, so that each exchanges power with the others, and
//! with what is damped: those that lose power slow down, and the hub turns the other way, at a constant acceleration at first.
//! Of a rotor `i` whose motor keeps its torque, with the tone's force `F_i` on mount and free joints and their velocity
//! `v`, which all tones of the frequency cause,
//!
//! ```text
//! tau_i = -1/2 Re(F_i* . v) / Omega_i
//! ```
//!
//! is the mean torque about its axis; the accelerations are those of the spacecraft as rigid bodies under these torques.
//! Rotors at other speeds each exchange none with one another, on average. Sources are left out: they are forces that no
//! rotor supplies. Gyroscopic torques of the turning hub, which follow later, are left out, and what a rotor's inertia varies
//! by over its turn.

use nalgebra::{Complex, DVector, Vector3};
use precess_dynamics::kind::Each;
use precess_dynamics::{DerivativeError, HubMode, Inputs, JointStates, Mode, State};

use super::device::SweptDevice;
use super::model::Model;
use super::settled::STEADY;
use crate::scenario::{Scenario, Set};
use crate::structure::accelerance::ComplexMatrix;
use crate::structure::{COORDINATES, Fault};

/// Frequencies that differ by less than this part are one.
const SAME: f64 = 1e-9;

/// Accelerations of the hub at first, and the vibration beside which they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanAcceleration {
    /// Of the hub's angular velocity, expressed in B, rad/s².
    pub angular: Vector3<f64>,
    /// Of the velocity of B, expressed in B, m/s².
    pub linear: Vector3<f64>,
    /// The RMS of the magnitudes in the vibration: of displacement, m, and velocity, m/s.
    pub moved: [f64; 2],
    /// The same of rotation, rad, and angular velocity, rad/s.
    pub turned: [f64; 2],
}

impl MeanAcceleration {
    /// Of a scenario at its initial rates; none of a hub that is not free.
    ///
    /// # Errors
    /// Those of [`settle`](super::settled::settle); [`Fault::Device`] where the solver rejects the spacecraft.
    pub fn new(scenario: &Scenario) -> Result<Option<Self>, Fault> {
        if scenario.hub_mode != HubMode::Free {
            return Ok(None);
        }
        let model = Model::new(scenario, &[], &STEADY)?;
        let mut torques = vec![0.0; scenario.joint_count()];
        // Squares: of the magnitudes of displacement, velocity, rotation and angular velocity.
        let mut squares = [0.0; 4];
        for (w, tones) in by_frequency(&model) {
            let vibration = Vibration::new(&model, w, &tones)?;
            for (number, index) in tones.iter().map(|[number, index]| (*number, *index)) {
                let Some((_, device)) = model.devices.get(number) else { continue };
                let Some(tone) = device.tones.get(index) else { continue };
                let Some(rotor) = device.rotors.get(tone.rotor) else { continue };
                let Some(velocity) = vibration.velocities.get(number) else { continue };
                // A motor that keeps the rate supplies the power.
                if !device.free.contains(&rotor.joint) {
                    continue;
                }
                let power = 0.5 * device.force(tone, 0.0).dotc(velocity).re;
                if let Some(torque) = torques.get_mut(device.first_joint + rotor.joint) {
                    *torque -= power / rotor.rate(0.0);
                }
            }
            let squared = |first: usize| {
                let rows = vibration.frame.rows(first, 3);
                0.5 * rows.iter().map(Complex::norm_sqr).sum::<f64>() / (w * w)
            };
            let [moved, turned] = [squared(0), squared(3)];
            let of = [moved / (w * w), moved, turned / (w * w), turned];
            squares.iter_mut().zip(of).for_each(|(sum, square)| *sum += square);
        }
        let [moved, velocity, turned, rate] = squares.map(f64::sqrt);
        let [linear, angular] = accelerations(scenario, &torques)?;
        let (moved, turned) = ([moved, velocity], [turned, rate]);
        Ok(Some(Self { angular, linear, moved, turned }))
    }
}

/// The tones of each frequency, rad/s, by numbers of device and tone.
fn by_frequency(model: &Model) -> Vec<(f64, Vec<[usize; 2]>)> {
    let all = model.devices.iter().enumerate().flat_map(|(number, (_, device))| {
        let tones = device.tones.iter().enumerate();
        tones.map(move |(index, tone)| (device.frequency(tone, 0.0), [number, index]))
    });
    let mut all: Vec<(f64, [usize; 2])> = all.collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let groups = all.chunk_by(|a, b| b.0 - a.0 <= SAME * b.0);
    let frequency = |group: &[(f64, [usize; 2])]| group.first().map_or(0.0, |(w, _)| *w);
    groups.map(|group| (frequency(group), group.iter().map(|(_, of)| *of).collect())).collect()
}

/// What all tones of a frequency make move: phasors.
struct Vibration {
    /// Accelerations of the floating frame, six.
    frame: DVector<Complex<f64>>,
    /// Velocities of the mount and of the free joints of each device.
    velocities: Vec<DVector<Complex<f64>>>,
}

impl Vibration {
    fn new(model: &Model, w: f64, tones: &[[usize; 2]]) -> Result<Self, Fault> {
        let mounted = model.mounted(0.0, w, tones)?;
        let force: ComplexMatrix = {
            let sum = mounted.force.column_sum();
            ComplexMatrix::from_column_slice(sum.len(), 1, sum.as_slice())
        };
        let [frame, _] = model.accelerance().motion(w, &force)?;
        let of_mounts = COORDINATES * model.mounts.len();
        let moved = mounted.accelerance.rows(0, of_mounts) * &force;
        let velocity = |(number, (mount, device)): (usize, &(usize, SweptDevice))| {
            let joints = device.free.len();
            let mut cause = DVector::zeros(COORDINATES + joints);
            let of_mount = moved.rows(COORDINATES * mount, COORDINATES);
            cause.rows_mut(0, COORDINATES).copy_from(&of_mount.column(0));
            let own = tones.iter().filter(|[of, _]| *of == number);
            for tone in own.filter_map(|[_, index]| device.tones.get(*index)) {
                let mut loads = cause.rows_mut(COORDINATES, joints);
                loads += device.joint_loads(tone, 0.0);
            }
            let mut all = cause.clone();
            if let Some(condensed) = mounted.devices.get(number) {
                all.rows_mut(COORDINATES, joints).copy_from(&(&condensed.joints * cause));
            }
            all * Complex::new(0.0, w).inv()
        };
        let velocities = model.devices.iter().enumerate().map(velocity).collect();
        Ok(Self { frame: frame.column(0).into_owned(), velocities })
    }
}

/// Accelerations of B and of the angular velocity of a spacecraft of rigid bodies at rest under motor torques of its
/// rotors, all other joints locked.
fn accelerations(scenario: &Scenario, torques: &[f64]) -> Result<[Vector3<f64>; 2], Fault> {
    let rejected = |error| Fault::Device(DerivativeError::Parameter(error));
    let spacecraft = scenario.spacecraft().map_err(rejected)?;
    let mut state: State<Set> = State::at_rest_for(&spacecraft);
    for ([to, _], [coordinate, _]) in state.devices.states_mut().zip(scenario.mean_joints()) {
        *to = coordinate;
    }
    let mut inputs = Inputs::none_for(&spacecraft);
    let joints = inputs.modes.values_mut().zip(spacecraft.joints()).zip(torques);
    for ((mode, (_, info)), torque) in joints {
        if info.driven {
            *mode = if *torque == 0.0 { Mode::Locked } else { Mode::Driven };
        }
    }
    for (motor, torque) in inputs.motors.values_mut().zip(torques) {
        *motor = *torque;
    }
    let found = spacecraft.accelerations(&state, &inputs);
    let found = found.map_err(|error| Fault::Device(DerivativeError::Solve(error)))?;
    Ok([found.r_b_n_ddot, found.omega_dot])
}
