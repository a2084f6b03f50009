//! A field of acceleration `G r`: its work is the change of `G : S / 2`.

use nalgebra::Matrix3;

use super::law::Law;
use super::trial::{Residuals, Role, Trial, concerns, gap, slope};
use crate::mutation::device::{BodyKinematics, BodyPose, Device, Fault};
use crate::mutation::state::Wrench;

pub(super) fn residuals(
    device: &Device<'_, '_>,
    trial: &Trial,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found = Vec::new();
    if concerns(role, &[Role::Gravity, Role::Body]) {
        found.push((Law::FieldWork, work(device, trial, fault)));
        found.push((Law::SecondMoment, second_moment(device, trial, fault)));
        found.push((Law::FieldPower, power(device, trial, fault)));
    }
    found
}

/// `integral of r r^T dm` about B.
fn spread(body: &BodyKinematics) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(0.5 * body.inertia_b.trace()) - body.inertia_b
}

/// Each body is moved as if it were free: `S' = (w x) S + m c u^T` and the same transposed, for a
/// velocity u of the point at B and an angular velocity w.
fn work(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion, probe) = (&trial.case, &trial.case.motion, &trial.probe);
    let (velocity, omega) = (probe.twist.force, probe.twist.moment);
    let pulled = device.gravity(case, motion, &probe.gradient, fault);
    let stands = device.geometry(case, motion, fault);
    let residual = |(k, (own, stand)): (usize, (&Wrench, &BodyPose))| {
        let body = device.body(k, case, motion, fault);
        let half = omega.cross_matrix() * spread(&body) + body.mass * body.r * velocity.transpose();
        let change = 0.5 * probe.gradient.component_mul(&(half + half.transpose())).sum();
        gap(&[own.moved(stand.origin).power(&velocity, &omega)], &[change])
    };
    pulled.bodies.iter().zip(stands.iter()).enumerate().map(residual).fold(0.0, f64::max)
}

fn second_moment(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let pulled = device.gravity(case, motion, &trial.probe.gradient, fault);
    let sum = (0..device.joints()).map(|k| spread(&device.body(k, case, motion, fault)));
    gap(pulled.second_moment.as_slice(), sum.sum::<Matrix3<f64>>().as_slice())
}

/// Only the joints move, and the field rests.
fn power(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion, gradient) = (&trial.case, &trial.case.motion, &trial.probe.gradient);
    let pulled = device.gravity(case, motion, gradient, fault);
    let stands = device.geometry(case, motion, fault);
    let on_body = |(k, (own, stand)): (usize, (&Wrench, &BodyPose))| {
        let body = device.body(k, case, motion, fault);
        let omega = body.omega_b();
        own.power(&(body.r_prime + omega.cross(&(stand.origin - body.r))), &omega)
    };
    let given: f64 = pulled.bodies.iter().zip(stands.iter()).enumerate().map(on_body).sum();
    let stored = |time: f64| {
        let motion = motion.after(time, &trial.any);
        let second_moment = device.gravity(case, &motion, gradient, fault).second_moment;
        0.5 * gradient.component_mul(&second_moment).sum()
    };
    gap(&[given], &[slope(stored)])
}
