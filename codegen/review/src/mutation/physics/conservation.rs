//! Energy and momenta: of hub and device together along the motion, and of the device as what its
//! bodies have.

use std::rc::Rc;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::differences::lagrange;
use super::law::Law;
use super::trial::{Residuals, Role, Trial, concerns, gap, slope};
use crate::mutation::device::{BodyKinematics, Device, Fault};
use crate::mutation::energy_momentum::{EnergyMomentum, Packed};
use crate::mutation::state::{Case, Motion};

pub(super) fn residuals(
    device: &Device<'_, '_>,
    trial: &Trial,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found = Vec::new();
    if concerns(role, &[Role::Solution, Role::Momenta]) {
        found.extend(balances(device, &trial.case, fault));
        found.push((Law::Pivots, pivots(device, &trial.case, fault)));
    }
    if concerns(role, &[Role::Body, Role::Momenta]) {
        found.push((Law::Bodies, bodies(device, &trial.case, fault)));
        found.push((Law::Forces, forces(device, trial, fault)));
    }
    if concerns(role, &[Role::FirstMoment, Role::Momenta]) {
        found.push((Law::CentreOfMass, centre_of_mass(device, trial, fault)));
    }
    found
}

/// Newton, Euler and the power balance for the whole spacecraft.
fn balances(device: &Device<'_, '_>, case: &Case, fault: &Fault) -> Residuals {
    let accelerations = device.accelerations(case, fault);
    let (motion, drive) = (&case.motion, &case.drive);
    let whole = |time: f64| {
        let motion = motion.after(time, &accelerations);
        let mut held = device.energy_momentum(case, &motion, fault);
        held.energy += drive.energy(&motion);
        held.packed() + case.hub.energy_momentum(&motion).packed()
    };
    let now = EnergyMomentum::unpacked(&whole(0.0));
    let rate = EnergyMomentum::unpacked(&slope(whole));
    // Components along axes that turn with B.
    let p_dot = rate.linear + motion.omega.cross(&now.linear);
    let h_dot = rate.angular + motion.omega.cross(&now.angular);
    let moment = drive.torque - motion.velocity.cross(&now.linear);
    let motor = |(k, rate): (usize, &f64)| {
        let torque = if drive.modes[k].is_driven() {
            drive.motors[k]
        } else {
            // What moves the joint as prescribed.
            let [momentum, by_coordinate] = lagrange(device, k, case, &accelerations, fault);
            momentum - by_coordinate
        };
        torque * rate
    };
    let motors: f64 = motion.rates.iter().enumerate().map(motor).sum();
    let power = drive.force.dot(&motion.velocity) + drive.torque.dot(&motion.omega) + motors;
    vec![
        (Law::LinearMomentum, gap(p_dot.as_slice(), drive.force.as_slice())),
        (Law::AngularMomentum, gap(h_dot.as_slice(), moment.as_slice())),
        (Law::Energy, gap(&[rate.energy], &[power])),
    ]
}

/// With the joints' mass matrix as energies: the diagonal itself, and what a unit of momentum
/// meets when the driven joints outboard are free to follow, each with its motor, which is where
/// the energy is least.
fn pivots(device: &Device<'_, '_>, case: &Case, fault: &Fault) -> f64 {
    let masses = device.joint_masses(case, fault);
    let modes = &case.drive.modes;
    let eliminated = device.eliminated(case, fault);
    let links = device.chain.kind.links.iter().enumerate().filter(|(_, link)| link.is_driven());
    let residual = |(j, link): (usize, &precess_codegen::kinds::Link)| {
        let behind = (j + 1..device.joints()).filter(|k| modes[*k].is_driven());
        let free: Vec<_> = std::iter::once(j).chain(behind).collect();
        let block = DMatrix::from_fn(free.len(), free.len(), |row, column| {
            let motor = if row == column && row > 0 { modes[free[row]].inertia() } else { 0.0 };
            masses[(free[row], free[column])] + motor
        });
        let mut push = DVector::zeros(free.len());
        push[0] = 1.0;
        let least = block.lu().solve(&push).map_or(f64::NAN, |rates| 1.0 / rates[0]);
        let [pivot, diagonal] =
            ["pivot", "diagonal"].map(|stem| format!("{stem}_{}", link.joint.tag));
        let pivot = eliminated.scalar(&pivot);
        // Where no outboard joint changes it, both are one number.
        let own = eliminated.returns(&diagonal);
        let diagonal = if own { eliminated.scalar(&diagonal) } else { pivot };
        let off = gap(&[pivot, diagonal], &[least, masses[(j, j)]]);
        if pivot > 0.0 && diagonal > 0.0 { off } else { f64::INFINITY }
    };
    links.map(residual).fold(0.0, f64::max)
}

fn every_body(
    device: &Device<'_, '_>,
    case: &Case,
    motion: &Motion,
    fault: &Fault,
) -> Vec<Rc<BodyKinematics>> {
    (0..device.joints()).map(|k| device.body(k, case, motion, fault)).collect()
}

/// König: the device's energy and momenta are those of its bodies, each with the inertia about its
/// own centre of mass; and with the joints at rest it turns as one body, by the inertias about B.
fn bodies(device: &Device<'_, '_>, case: &Case, fault: &Fault) -> f64 {
    let motion = &case.motion;
    let mut sum = Packed::zeros();
    let mut inertia = Matrix3::zeros();
    for body in every_body(device, case, motion, fault) {
        let velocity = motion.velocity + body.r_prime + motion.omega.cross(&body.r);
        let omega = motion.omega + body.omega_b();
        let (linear, spin) = (body.mass * velocity, body.inertia * omega);
        let energy = 0.5 * (velocity.dot(&linear) + omega.dot(&spin));
        sum += EnergyMomentum { energy, linear, angular: body.r.cross(&linear) + spin }.packed();
        inertia += body.inertia_b;
    }
    let held = device.energy_momentum(case, motion, fault).packed();
    let rigid = Motion { omega: motion.omega, ..motion.joints_alone(vec![0.0; device.joints()]) };
    let turned = device.energy_momentum(case, &rigid, fault).angular;
    let moments = inertia * motion.omega;
    gap(sum.as_slice(), held.as_slice()).max(gap(moments.as_slice(), turned.as_slice()))
}

/// Newton and Euler body by body, for accelerations that obey no law: with B's velocity zero,
/// `p = sum m (r' + omega x r)` and `H = sum [I_B] omega + r x m r' + [I] omega_{k/B}`.
fn forces(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, any) = (&trial.case, &trial.any);
    let mut motion = case.motion.clone();
    motion.velocity = Vector3::zeros();
    let (omega, omega_dot) = (motion.omega, any.omega);
    let after = |time: f64| {
        let mut after = motion.after(time, any);
        after.velocity = Vector3::zeros();
        after
    };
    let rate = EnergyMomentum::unpacked(&slope(|time| {
        device.energy_momentum(case, &after(time), fault).packed()
    }));
    let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
    for (k, body) in every_body(device, case, &motion, fault).into_iter().enumerate() {
        let r_dprime = body.r_dprime(&any.joints);
        let turning = slope(|time| device.body(k, case, &after(time), fault).omega_b());
        force += body.mass * (r_dprime + omega.cross(&body.r_prime) + omega_dot.cross(&body.r));
        moment += body.inertia_b_prime * omega
            + body.inertia_b * omega_dot
            + body.r.cross(&(body.mass * r_dprime))
            + body.inertia_prime * body.omega_b()
            + body.inertia * turning;
    }
    let linear = gap(rate.linear.as_slice(), force.as_slice());
    linear.max(gap(rate.angular.as_slice(), moment.as_slice()))
}

/// The device's momentum and its derivative as those of its mass at its centre.
fn centre_of_mass(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, any) = (&trial.case, &trial.any);
    let (motion, omega) = (&case.motion, case.motion.omega);
    let mass = device.mass(case);
    let moment = device.moment(case, motion, fault);
    let linear = |time: f64| device.energy_momentum(case, &motion.after(time, any), fault).linear;
    let momentum = mass * motion.velocity + moment.mc_prime + omega.cross(&moment.mc);
    let force = mass * (any.point - omega.cross(&motion.velocity))
        + moment.mc_dprime(&any.joints)
        + omega.cross(&moment.mc_prime)
        + any.omega.cross(&moment.mc);
    let first = gap(momentum.as_slice(), linear(0.0).as_slice());
    first.max(gap(force.as_slice(), slope(linear).as_slice()))
}
