//! What acts on the bodies, as what joints and hub receive of it.

use super::law::Law;
use super::trial::{Residuals, Role, Trial, concerns, gap};
use crate::mutation::device::{BodyPose, Device, Fault};
use crate::mutation::state::Wrench;

pub(super) fn residuals(
    device: &Device<'_, '_>,
    trial: &Trial,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found = Vec::new();
    if concerns(role, &[Role::External, Role::Body]) {
        found.push((Law::VirtualPower, power(device, trial, fault)));
    }
    if concerns(role, &[Role::External]) {
        found.push((Law::Resultants, resultants(device, trial, fault)));
    }
    found
}

/// The bodies move as their own functions say.
fn power(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let received = device.external(case, &trial.probe.acting, fault);
    let drives = received.drives.iter().zip(&motion.rates).map(|(drive, rate)| drive * rate);
    let joints: f64 = drives.sum();
    let hub = received.whole.power(&motion.velocity, &motion.omega);
    let stands = device.geometry(case, motion, fault);
    let on_body = |(k, (own, stand)): (usize, (&Wrench, &BodyPose))| {
        let body = device.body(k, case, motion, fault);
        let omega = motion.omega + body.omega_b();
        let centre = motion.velocity + body.r_prime + motion.omega.cross(&body.r);
        let origin = centre + omega.cross(&(stand.origin - body.r));
        own.turned(&stand.axes).power(&origin, &omega)
    };
    let given: f64 = trial.probe.acting.iter().zip(stands.iter()).enumerate().map(on_body).sum();
    gap(&[joints + hub], &[given])
}

/// Summed from the tip, each moved to the origin at hand.
fn resultants(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let received = device.external(case, &trial.probe.acting, fault);
    let (mut about_b, mut worst) = (Wrench::zero(), 0.0_f64);
    let stands = device.geometry(case, motion, fault);
    let outside = stands.iter().zip(&trial.probe.acting).zip(&received.joints).rev();
    for ((stand, own), joint) in outside {
        about_b = about_b.plus(own.turned(&stand.axes).moved(stand.origin));
        worst = worst.max(gap(&joint.moved(stand.origin).list(), &about_b.list()));
    }
    worst.max(gap(&received.whole.list(), &about_b.list()))
}
