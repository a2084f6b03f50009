//! What crosses the joints, for accelerations that obey no law: as changes of what the bodies have.

use nalgebra::{DMatrix, Vector3};

use super::law::Law;
use super::trial::{Residuals, Role, Trial, concerns, gap, slope};
use crate::mutation::device::{Device, Fault};
use crate::mutation::state::{Motion, Wrench};

pub(super) fn residuals(
    device: &Device<'_, '_>,
    trial: &Trial,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found = Vec::new();
    if concerns(role, &[Role::Loads, Role::Body]) {
        found.push((Law::JointMomentum, momentum(device, trial, fault)));
    }
    if concerns(role, &[Role::Loads, Role::Momenta]) {
        found.push((Law::JointPower, power(device, trial, fault)));
    }
    if concerns(role, &[Role::Steering]) {
        found.push((Law::Steering, steering(device, trial, fault)));
    }
    // What `loads` or `prepare` have wrong, other laws show: differences of wrong loads take long.
    if role == Some(Role::LoadDerivatives) || role.is_none() && fault.is_none() {
        let derivatives = device.load_derivatives(&trial.case, &trial.any, fault);
        let slopes = device.load_slopes(&trial.case, &trial.any, fault);
        found.push((Law::LoadDerivatives, gap(&derivatives, &slopes)));
    }
    found
}

/// Newton and Euler, about the moving point B, for the bodies outside each joint.
fn momentum(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let loads = device.loads(case, &trial.any, fault);
    let stands = device.geometry(case, motion, fault);
    let moving = |time: f64| momenta(device, trial, &motion.after(time, &trial.any), fault);
    let (now, rates) = (moving(0.0), slope(moving));
    let (mut sum, mut worst) = (Wrench::zero(), 0.0_f64);
    for (k, stand) in stands.iter().enumerate().rev() {
        let part = |all: &DMatrix<f64>, row: usize| {
            Vector3::from_fn(|component, _| all[(row + component, k)])
        };
        let (p, h) = (part(&now, 0), part(&now, 3));
        // Components along axes that turn with B, moments about a point that moves with B.
        sum = sum.plus(Wrench {
            force: part(&rates, 0) + motion.omega.cross(&p),
            moment: part(&rates, 3) + motion.omega.cross(&h) + motion.velocity.cross(&p),
        });
        let load = loads.joints[k].moved(stand.origin);
        worst = worst.max(gap(&load.list(), &sum.list()));
    }
    worst.max(gap(&loads.whole.list(), &sum.list()))
}

/// Momentum and angular momentum about B of each body, one column each.
fn momenta(device: &Device<'_, '_>, trial: &Trial, motion: &Motion, fault: &Fault) -> DMatrix<f64> {
    let column = |k: usize| {
        let body = device.body(k, &trial.case, motion, fault);
        let velocity = motion.velocity + body.r_prime + motion.omega.cross(&body.r);
        let linear = body.mass * velocity;
        let spin = body.inertia * (motion.omega + body.omega_b());
        Wrench { force: linear, moment: body.r.cross(&linear) + spin }.list()
    };
    let columns: Vec<_> = (0..device.joints()).flat_map(column).collect();
    DMatrix::from_vec(6, device.joints(), columns)
}

/// The terms of `steer` against `loads`, and against `energy_momentum` of a hub at rest.
fn steering(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let [moment, relative] = device.steered(&trial.case, &trial.any, fault);
    let loads = device.loads(&trial.case, &trial.any, fault);
    let zero = Vector3::zeros();
    let at_rest = Motion { omega: zero, velocity: zero, ..trial.case.motion.clone() };
    let momentum = device.energy_momentum(&trial.case, &at_rest, fault).angular;
    let pairs = [(moment, loads.whole.moment), (relative, momentum)];
    pairs.iter().map(|(a, b)| gap(a.as_slice(), b.as_slice())).fold(0.0, f64::max)
}

fn power(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let loads = device.loads(case, &trial.any, fault);
    let drives = loads.drives.iter().zip(&motion.rates).map(|(drive, rate)| drive * rate);
    let given = drives.sum::<f64>() + loads.whole.power(&motion.velocity, &motion.omega);
    let energy =
        |time: f64| device.energy_momentum(case, &motion.after(time, &trial.any), fault).energy;
    gap(&[given], &[slope(energy)])
}
