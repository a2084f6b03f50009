//! Derivatives that the emitted functions return, against differences of what they return.

use nalgebra::{Matrix3x2, SMatrix, Vector3};

use super::law::Law;
use super::trial::{Residuals, Role, Trial, concerns, gap, slope};
use crate::mutation::device::{BodyKinematics, Device, Fault};
use crate::mutation::state::{Accelerations, Case, Mode, Motion};

pub(super) fn residuals(
    device: &Device<'_, '_>,
    trial: &Trial,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found = Vec::new();
    if concerns(role, &[Role::Body]) {
        for k in 0..device.joints() {
            found.extend(body(device, k, trial, fault));
        }
    }
    if concerns(role, &[Role::FirstMoment]) {
        found.push((Law::FirstMoment, first_moment(device, trial, fault)));
    }
    if concerns(role, &[Role::Momenta]) {
        found.push((Law::Momenta, momenta(device, &trial.case, fault)));
    }
    if concerns(role, &[Role::Solution, Role::Momenta]) {
        found.extend(joints(device, &trial.case, fault));
    }
    found
}

/// Position, velocity, axes and inertia of body `k`, along B: seen from B, those axes rest.
fn body(device: &Device<'_, '_>, k: usize, trial: &Trial, fault: &Fault) -> Residuals {
    let (case, any) = (&trial.case, &trial.any);
    let at = |time: f64| device.body(k, case, &case.motion.after(time, any), fault);
    let now = at(0.0);
    let rate = slope(|time| columns(&at(time)));
    let part = |column: usize| rate.fixed_columns::<3>(column).into_owned();
    // The body turns at omega: `A' = A tilde(omega)`, omega along its axes A.
    let omega = now.attitude.transpose() * now.omega_b();
    let turning = now.attitude.transpose() * part(0) - omega.cross_matrix();
    let inertia = gap(part(3).as_slice(), now.inertia_prime.as_slice());
    let about_b = gap(part(6).as_slice(), now.inertia_b_prime.as_slice());
    let (velocity, acceleration) = (rate.column(9), rate.column(10));
    let r_dprime = now.r_dprime(&any.joints);
    vec![
        (Law::Velocity, gap(velocity.as_slice(), now.r_prime.as_slice())),
        (Law::Acceleration, gap(acceleration.as_slice(), r_dprime.as_slice())),
        (Law::Turning, gap(turning.as_slice(), &[0.0; 9])),
        (Law::Inertia, inertia.max(about_b)),
    ]
}

/// What is differentiated: the body's axes, inertia, inertia about B; position, velocity.
fn columns(body: &BodyKinematics) -> SMatrix<f64, 3, 11> {
    let mut columns = SMatrix::<f64, 3, 11>::zeros();
    for (place, tensor) in [(0, body.attitude), (3, body.inertia), (6, body.inertia_b)] {
        columns.fixed_columns_mut::<3>(place).copy_from(&tensor);
    }
    columns.set_column(9, &body.r);
    columns.set_column(10, &body.r_prime);
    columns
}

fn first_moment(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, any) = (&trial.case, &trial.any);
    let at = |time: f64| device.moment(case, &case.motion.after(time, any), fault);
    let now = at(0.0);
    let rate = slope(|time| {
        let then = at(time);
        Matrix3x2::from_columns(&[then.mc, then.mc_prime])
    });
    let first = gap(rate.column(0).as_slice(), now.mc_prime.as_slice());
    first.max(gap(rate.column(1).as_slice(), now.mc_dprime(&any.joints).as_slice()))
}

/// The energy is quadratic in the velocities: half the difference over unit steps to either side is
/// its derivative, without truncation.
fn by_velocity(energy: impl Fn(f64) -> f64) -> f64 {
    0.5 * (energy(1.0) - energy(-1.0))
}

fn momenta(device: &Device<'_, '_>, case: &Case, fault: &Fault) -> f64 {
    let held = device.energy_momentum(case, &case.motion, fault);
    let energy = |motion: &Motion| device.energy_momentum(case, motion, fault).energy;
    let along = |change: &dyn Fn(&mut Motion, Vector3<f64>)| {
        Vector3::from_fn(|axis, _| {
            by_velocity(|step| {
                let mut motion = case.motion.clone();
                let mut by = Vector3::zeros();
                by[axis] = step;
                change(&mut motion, by);
                energy(&motion)
            })
        })
    };
    let linear = along(&|motion, by| motion.velocity += by);
    let angular = along(&|motion, by| motion.omega += by);
    let first = gap(linear.as_slice(), held.linear.as_slice());
    first.max(gap(angular.as_slice(), held.angular.as_slice()))
}

/// Each driven joint obeys Lagrange's equation, its motor's own inertia included; each that is given
/// an acceleration has it.
fn joints(device: &Device<'_, '_>, case: &Case, fault: &Fault) -> Residuals {
    let accelerations = device.accelerations(case, fault);
    let residual = |(k, mode): (usize, &Mode)| match *mode {
        Mode::Driven { inertia } => {
            let [momentum, by_coordinate] = lagrange(device, k, case, &accelerations, fault);
            let momentum = momentum + inertia * accelerations.joints[k];
            (Law::Lagrange, gap(&[momentum], &[case.drive.motors[k] + by_coordinate]))
        }
        Mode::Given { acceleration } => {
            let same = accelerations.joints[k] == acceleration;
            (Law::Given, if same { 0.0 } else { f64::INFINITY })
        }
    };
    case.drive.modes.iter().enumerate().map(residual).collect()
}

/// The two sides of Lagrange's equation of a joint, whose coordinate is a true one: the derivative of
/// its momentum, and the energy's slope along it.
pub(super) fn lagrange(
    device: &Device<'_, '_>,
    joint: usize,
    case: &Case,
    accelerations: &Accelerations,
    fault: &Fault,
) -> [f64; 2] {
    let energy = |motion: &Motion| device.energy_momentum(case, motion, fault).energy;
    let momentum = |time: f64| {
        let motion = case.motion.after(time, accelerations);
        by_velocity(|step| {
            let mut motion = motion.clone();
            motion.rates[joint] += step;
            energy(&motion)
        })
    };
    let by_coordinate = slope(|step| {
        let mut motion = case.motion.clone();
        motion.coordinates[joint] += step;
        energy(&motion)
    });
    [slope(momentum), by_coordinate]
}
