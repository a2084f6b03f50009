//! [`notes`]: what a linear loop has otherwise than a run, or has not, with the remedy where there is one.

use nalgebra::Vector3;
use precess_control::GyroOutput;

use super::measurement::star_ratio;
use crate::scenario::{AllocationInverse, AttitudeReference, SampledController, Scenario};
use crate::units::Plain;

/// Of a controller of a scenario.
#[must_use]
pub fn notes(scenario: &Scenario, of: &SampledController) -> Vec<String> {
    let mut notes = Vec::new();
    if let AttitudeReference::Turning { omega, .. } = &of.reference
        && omega.norm() > 0.0
    {
        notes.push(format!(
            "the reference turns at {} rad/s; margins are about one at rest",
            Plain(omega.norm())
        ));
    }
    match of.allocation.inverse {
        AllocationInverse::LeastLargest => notes.push(
            "the least largest command is taken as the pseudo-inverse, which gives the same torque"
                .to_owned(),
        ),
        AllocationInverse::Generalised(..) => {
            notes.push(
                "the dither of the generalised inverse is taken as it is at the start".to_owned(),
            );
        }
        AllocationInverse::Exact | AllocationInverse::SingularityRobust(_) => {}
    }
    let null = &of.allocation.null_motion;
    if !(null.preferred_angles.is_empty() && null.keep_out.is_empty()) {
        notes.push(
            "preferred angles and keep-out bands are left out: that motion exerts no torque to first order, and nothing of the loop moves it"
                .to_owned(),
        );
    }
    measured(&mut notes, of);
    if let Some(dumping) = &of.dumping {
        notes.push(format!(
            "`dumping` is left out: devices exert the opposite of its torque; margins hold where `dumping.gain`, {} 1/s, is a hundredth of the loop's bandwidth, 2 pi times its crossover, or less",
            Plain(dumping.gain)
        ));
        if !has_external(of) {
            notes.push(
                "rate damping does not compensate the torque of `dumping`, which turns the hub; take `mrp_feedback`, `quaternion` or `eigen_axis`"
                    .to_owned(),
            );
        }
    }
    if scenario.controllers.len() > 1 {
        notes.push("joints of the other controllers keep their motor torques".to_owned());
    }
    if scenario.gravity != precess_dynamics::Gravity::None {
        notes.push("gravity is left out".to_owned());
    }
    if scenario.structure.as_ref().is_some_and(|of| of.massive().len() < of.modes.len()) {
        notes.push("residual flexibility is left out; the modes are in it".to_owned());
    }
    notes
}

/// Of sensors and estimator.
fn measured(notes: &mut Vec<String>, of: &SampledController) {
    let sensors = &of.sensors;
    let ratio = star_ratio(of);
    if of.estimator.is_some() {
        notes.push("the estimator has the gains that it comes to after a long time".to_owned());
    }
    if ratio > 1.0 {
        let star = Plain(of.rate / ratio);
        notes.push(if of.estimator.is_some() {
            format!(
                "the star tracker at {star} Hz is taken as one at each sample with {} times the variance",
                Plain(ratio)
            )
        } else {
            format!(
                "the attitude is held between measurements at {star} Hz: it is taken with its mean age, and motion near {star} Hz and its multiples is not seen aliased; take the controller's rate for the star tracker, or an estimator, for margins without that"
            )
        });
    }
    let mut quanta = vec![
        ("encoder_quantum", sensors.encoder_quantum),
        ("tachometer_quantum", sensors.tachometer_quantum),
    ];
    if let Some(gyro) = &sensors.gyro {
        quanta.push(("gyro.quantum", gyro.quantum));
        if gyro.bias != Vector3::zeros() {
            notes.push(if of.estimator.is_some() {
                "the bias of the gyro is a constant that the estimator takes away".to_owned()
            } else {
                "the bias of the gyro is left out: a constant, no part of a margin; an `estimator` takes it away".to_owned()
            });
        }
        if gyro.rate_random_walk > 0.0 {
            notes.push(if of.estimator.is_some() {
                "noise of `margins` is without the drift of the gyro's bias by its rate random walk; `jitter --controller` and a run have it".to_owned()
            } else {
                "noise is without the drift of the gyro's bias by its rate random walk, which grows without bound; an `estimator` bounds it, and a run has it".to_owned()
            });
        }
        if gyro.output == GyroOutput::Sampled && of.estimator.is_some() {
            notes.push(
                "the estimator takes the sampled reading of the gyro for the mean over a sample"
                    .to_owned(),
            );
        }
    }
    for (key, _) in quanta.into_iter().filter(|(_, quantum)| *quantum > 0.0) {
        notes.push(format!("`sensors.{key}` is left out; a run has it"));
    }
}

/// Whether the law has the external torque.
fn has_external(of: &SampledController) -> bool {
    !matches!(of.law, crate::scenario::ControlLaw::RateDamping { .. })
}
