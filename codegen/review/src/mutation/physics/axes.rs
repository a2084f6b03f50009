//! Where the axes of the bodies point: axes that stay square, turn with the bodies and lead to their centres.

use nalgebra::{DMatrix, Matrix3};

use super::law::Law;
use super::trial::{Residuals, Role, Trial, concerns, gap, slope};
use crate::mutation::device::{BodyPose, Device, Fault};
use precess_codegen::kinds::{Link, Motion};

pub(super) fn residuals(
    device: &Device<'_, '_>,
    trial: &Trial,
    fault: &Fault,
    role: Option<Role>,
) -> Residuals {
    let mut found = Vec::new();
    if concerns(role, &[Role::Axes, Role::Body]) {
        found.push((Law::Axes, axes(device, trial, fault)));
        found.push((Law::Origins, origins(device, trial, fault)));
    }
    found
}

/// `A^T A = 1`, `det A = 1` and `A' = A (omega x)` with omega along the axes themselves.
fn axes(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let all = |time: f64| {
        let stands = device.poses(case, &motion.after(time, &trial.any), fault);
        let numbers = stands.iter().flat_map(|stand| stand.axes.as_slice().to_vec());
        DMatrix::from_vec(9, stands.len(), numbers.collect())
    };
    let rates = slope(all);
    let stands = device.poses(case, motion, fault);
    let residual = |(k, link): (usize, &Link)| {
        let own = stands[k].axes;
        let square = gap((own.transpose() * own).as_slice(), Matrix3::identity().as_slice());
        let mut omega = device.body(k, case, motion, fault).omega;
        // Axes that do not turn with the joint turn with the parent body.
        if let (Motion::Turn(axis), false) = (link.joint.motion, device.chain.kind.axes_turn(k)) {
            omega[axis.cycle()[0]] -= motion.rates[k];
        }
        let turning = own * omega.cross_matrix();
        let turns = gap(rates.column(k).as_slice(), turning.as_slice());
        square.max(turns).max(gap(&[own.determinant()], &[1.0]))
    };
    device.chain.kind.links.iter().enumerate().map(residual).fold(0.0, f64::max)
}

fn origins(device: &Device<'_, '_>, trial: &Trial, fault: &Fault) -> f64 {
    let (case, motion) = (&trial.case, &trial.case.motion);
    let stands = device.poses(case, motion, fault);
    let residual = |(k, stand): (usize, &BodyPose)| {
        let led = stand.origin + stand.axes * device.centre(k, case);
        gap(led.as_slice(), device.body(k, case, motion, fault).r.as_slice())
    };
    stands.iter().enumerate().map(residual).fold(0.0, f64::max)
}
