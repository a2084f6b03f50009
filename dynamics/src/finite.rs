//! The search for the input that is not finite.
//!
//! The hot path checks its results instead, which are fewer, and searches only once they fail.

use crate::attitude::Attitude;
use crate::error::{Joint, JointField, Quantity};
use crate::real::Scalar;
use crate::state::{Joints, State, Torques};
use crate::vec3::{components, finite};

/// The first part of a state that is not finite.
pub(crate) fn culprit_in_state<const N: usize, T: Scalar, A: Attitude<T>>(
    state: &State<N, T, A>,
) -> Option<Quantity> {
    if !finite(components(&state.r_b_n)) {
        return Some(Quantity::Position);
    }
    if !finite(components(&state.r_b_n_dot)) {
        return Some(Quantity::Velocity);
    }
    if !state.attitude.is_valid() {
        return Some(Quantity::Attitude);
    }
    if !finite(components(&state.omega)) {
        return Some(Quantity::BodyRate);
    }
    let mut devices = state.devices.iter().enumerate();
    devices.find_map(|(device, joints)| {
        culprit_in_joints(joints).map(|field| Quantity::Joint { device, field })
    })
}

/// The first part of the torques that is not finite.
pub(crate) fn culprit_in_torques<const N: usize, T: Scalar>(
    torques: &Torques<N, T>,
) -> Option<Quantity> {
    if !finite(components(&torques.force)) {
        return Some(Quantity::Force);
    }
    if !finite(components(&torques.torque_b)) {
        return Some(Quantity::TorqueB);
    }
    let mut motors = torques.motors.iter().enumerate();
    motors.find_map(|(device, motor)| {
        let fields = [
            (Joint::OuterGimbal, motor.u_o),
            (Joint::InnerGimbal, motor.u_i),
            (Joint::Wheel, motor.u_w),
        ];
        fields
            .iter()
            .find(|(_, value)| !value.is_finite())
            .map(|&(joint, _)| Quantity::Motor { device, joint })
    })
}

fn culprit_in_joints<T: Scalar>(joints: &Joints<T>) -> Option<JointField> {
    let fields = [
        (JointField::GammaO, joints.gamma_o),
        (JointField::GammaI, joints.gamma_i),
        (JointField::Theta, joints.theta),
        (JointField::GammaODot, joints.gamma_o_dot),
        (JointField::GammaIDot, joints.gamma_i_dot),
        (JointField::Spin, joints.spin),
    ];
    fields.iter().find(|(_, value)| !value.is_finite()).map(|&(field, _)| field)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quaternion::Quaternion;
    use crate::state::MotorTorques;

    fn culprit(change: impl Fn(&mut State<2>)) -> Option<Quantity> {
        let mut state = State::at_rest();
        change(&mut state);
        culprit_in_state(&state)
    }

    #[test]
    fn every_field_of_a_state_is_searched() {
        const BAD: f64 = f64::NAN;
        let joint = |field| Some(Quantity::Joint { device: 1, field });
        assert_eq!(culprit(|_| ()), None);
        assert_eq!(culprit(|s| s.r_b_n.y = BAD), Some(Quantity::Position));
        assert_eq!(culprit(|s| s.r_b_n_dot.z = f64::INFINITY), Some(Quantity::Velocity));
        assert_eq!(
            culprit(|s| s.attitude = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 }),
            Some(Quantity::Attitude)
        );
        assert_eq!(culprit(|s| s.omega.x = BAD), Some(Quantity::BodyRate));
        assert_eq!(culprit(|s| s.devices[1].gamma_o = BAD), joint(JointField::GammaO));
        assert_eq!(culprit(|s| s.devices[1].gamma_i = BAD), joint(JointField::GammaI));
        assert_eq!(culprit(|s| s.devices[1].theta = BAD), joint(JointField::Theta));
        assert_eq!(culprit(|s| s.devices[1].gamma_o_dot = BAD), joint(JointField::GammaODot));
        assert_eq!(culprit(|s| s.devices[1].gamma_i_dot = BAD), joint(JointField::GammaIDot));
        assert_eq!(culprit(|s| s.devices[1].spin = BAD), joint(JointField::Spin));
    }

    #[test]
    fn every_field_of_torques_is_searched() {
        let culprit = |change: fn(&mut Torques<2>)| {
            let mut torques = Torques::none();
            change(&mut torques);
            culprit_in_torques(&torques)
        };
        let motor = |joint| Some(Quantity::Motor { device: 0, joint });
        assert_eq!(culprit(|_| ()), None);
        assert_eq!(culprit(|t| t.force.x = f64::NAN), Some(Quantity::Force));
        assert_eq!(culprit(|t| t.torque_b.z = f64::NAN), Some(Quantity::TorqueB));
        let bad = MotorTorques { u_o: 0.0, u_i: f64::NAN, u_w: f64::NAN };
        let mut torques = Torques::<2>::none();
        torques.motors[0] = bad;
        assert_eq!(culprit_in_torques(&torques), motor(Joint::InnerGimbal));
        assert_eq!(culprit(|t| t.motors[0].u_o = f64::NAN), motor(Joint::OuterGimbal));
        assert_eq!(culprit(|t| t.motors[0].u_w = f64::NAN), motor(Joint::Wheel));
    }
}
