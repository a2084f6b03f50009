//! [`settle`]: the start of a run in the vibration that its rotors keep up, so that the state of the file is the mean motion.
//!
//! ```text
//! x(0) = Re sum_k x_k     x'(0) = Re sum_k i w_k x_k
//! ```
//!
//! over the tones of all rotors at their initial rates: imbalance, and harmonics of sources. A state at rest has neither
//! the momentum of the hub in this vibration nor its place; what is missing is a mean rate and a mean velocity.
//! Small motions: what is of second order in them stays. Gimbals and all joints without a spring count as held.

use nalgebra::{Complex, DVector, Vector3};
use precess_control::rotation::product;
use precess_dynamics::{Attitude, HubMode, JointStates, Quaternion};

use super::device::Steady;
use super::model::Model;
use crate::scenario::Scenario;
use crate::structure::dynamic_mass::Motor;
use crate::structure::{COORDINATES, Fault};

/// Rotors at their initial rates by motors of constant torque, other joints on springs free.
pub(super) const STEADY: Steady<'_> =
    Steady { motor: Motor::ConstantTorque, sprung: true, swept: None };

/// What [`settle`] found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settled {
    /// Sources that the vibration has not, each with the reason.
    pub left_out: Vec<String>,
    /// Of each joint the sum of the amplitudes of all tones: of its coordinate, rad or m, and of its rate.
    pub amplitudes: Vec<[f64; 2]>,
}

/// Adds the vibration of the rotors at their initial rates to the initial state, and keeps the state without it as the mean.
///
/// # Errors
/// Those of [`Model::new`]; [`Fault::Unbounded`] where a tone is at a resonance without damping.
pub fn settle(scenario: &mut Scenario) -> Result<Settled, Fault> {
    // Of a fixed hub nothing moves but the devices.
    if scenario.hub_mode != HubMode::Free {
        return Ok(Settled::default());
    }
    let mut model = Model::new(scenario, &[], &STEADY)?;
    let left_out = model.add_sources(scenario)?;
    scenario.mean = Some(scenario.present_mean());
    let amplitudes = add_vibration(scenario, &model, 0.0)?;
    Ok(Settled { left_out, amplitudes })
}

/// Adds the vibration of all tones at a speed of the swept rotors, rad/s, to the initial state. Returns, of each joint, the
/// sums of the amplitudes of its coordinate and rate.
pub(super) fn add_vibration(
    run: &mut Scenario,
    model: &Model,
    speed: f64,
) -> Result<Vec<[f64; 2]>, Fault> {
    let mut amplitudes = vec![[0.0; 2]; run.joint_count()];
    let mean = run.initial.attitude;
    // From B to N.
    let bn = mean.dcm();
    for (number, (_, device)) in model.devices.iter().enumerate() {
        for (index, tone) in device.tones.iter().enumerate() {
            let w = device.frequency(tone, speed);
            let place = [number, index];
            let mounted = model.mounted(speed, w, &[place])?;
            let [frame, modal] = model.accelerance().motion(w, &mounted.force)?;
            let by_rate = Complex::new(0.0, w).inv();
            let at = |first: usize, by: Complex<f64>| {
                Vector3::from_fn(|axis, _| (frame[(first + axis, 0)] * by).re)
            };
            run.initial.r_b_n += bn.transpose() * at(0, by_rate * by_rate);
            run.initial.r_b_n_dot += bn.transpose() * at(0, by_rate);
            run.initial.omega += at(3, by_rate);
            let turn = at(3, by_rate * by_rate) * 0.5;
            let small = Quaternion { q0: 1.0, q1: turn.x, q2: turn.y, q3: turn.z };
            run.initial.attitude = product(&run.initial.attitude, &small).normalised();
            if let Some(structure) = &mut run.structure {
                let modes = structure.coordinates.iter_mut().zip(&mut structure.rates);
                for ((eta, eta_dot), value) in modes.zip(modal.column(0).iter()) {
                    *eta += value.re;
                    *eta_dot += (value * Complex::new(0.0, w)).re;
                }
            }
            let of_mounts = COORDINATES * model.mounts.len();
            let moved = mounted.accelerance.rows(0, of_mounts) * &mounted.force;
            for (of, ((mount, device), condensed)) in
                model.devices.iter().zip(&mounted.devices).enumerate()
            {
                let joints = device.free.len();
                let mut cause = DVector::zeros(COORDINATES + joints);
                cause
                    .rows_mut(0, COORDINATES)
                    .copy_from(&moved.rows(COORDINATES * mount, COORDINATES));
                if of == number {
                    cause.rows_mut(COORDINATES, joints).copy_from(&device.joint_loads(tone, speed));
                }
                let accelerations = &condensed.joints * cause;
                for (joint, value) in device.free.iter().zip(accelerations.iter()) {
                    let joint = device.first_joint + joint;
                    let phasors = [value * by_rate * by_rate, value * by_rate];
                    if let Some([x, x_dot]) = run.initial.devices.states_mut().nth(joint) {
                        *x += phasors[0].re;
                        *x_dot += phasors[1].re;
                    }
                    if let Some(sums) = amplitudes.get_mut(joint) {
                        sums.iter_mut().zip(phasors).for_each(|(sum, of)| *sum += of.norm());
                    }
                }
            }
        }
    }
    Ok(amplitudes)
}
