//! Momentum dumping: the hub stays at rest, and the momentum of the devices falls as the page has it.

use nalgebra::{Matrix3, Vector3};
use precess_control::{
    ControlError, Gyroscopic, Law as _, MomentumDumping, Motion, MrpFeedback, MrpGains, Reference,
    Sample,
};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::rigid_body::Body;

const PERIOD: f64 = 0.5;
const GAIN: f64 = 0.02;

/// Devices without inertia of their own: what they exert on the hub is taken from their momentum.
#[test]
fn momentum_falls_by_its_time_constant_and_within_the_limit() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(100.0, 180.0, 250.0));
    let attitude = Quaternion::identity();
    let mut body = Body::new(inertia, &Motion { attitude, omega: Vector3::zeros() });
    let gains = MrpGains::new(10.0, 60.0);
    let mut law = MrpFeedback::new(gains, inertia, Gyroscopic::Whole).unwrap();
    let wanted = Vector3::new(1.0, 0.0, -2.0);
    let limit = Vector3::new(f64::INFINITY, 0.05, f64::INFINITY);
    let dumping = MomentumDumping::new(GAIN, wanted, limit).unwrap();
    let mut momentum = Vector3::new(4.0, 20.0, -2.0);
    let mut by_hand = momentum;
    for _ in 0..400 {
        let external = dumping.torque(&momentum);
        let mut sample = Sample::new(body.motion(), Reference::at_rest(attitude));
        (sample.momentum, sample.external) = (momentum, external);
        let torque = law.torque(&sample);
        body.run(&(torque + external), PERIOD, 1);
        momentum -= torque * PERIOD;
        by_hand.x = 1.0 + (by_hand.x - 1.0) * (1.0 - GAIN * PERIOD);
        by_hand.y -= (by_hand.y * GAIN).min(0.05) * PERIOD;
        assert!((momentum - by_hand).amax() < 1e-12, "{momentum} {by_hand}");
    }
    assert_eq!(body.motion().omega, Vector3::zeros());
    // 17.5 s of 200 s at the limit, then the time constant of 50 s.
    assert!(momentum.x < 1.1 && momentum.y < 12.0 && momentum.z == -2.0);
}

#[test]
fn gains_and_limits_that_are_none_are_rejected() {
    let zero = Vector3::zeros();
    assert!(MomentumDumping::new(0.0, zero, Vector3::repeat(1.0)).is_err());
    assert_eq!(
        MomentumDumping::new(1.0, zero, zero),
        Err(ControlError::NotPositive { what: "torque limit", value: 0.0 })
    );
}
