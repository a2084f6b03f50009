//! The search for the input that is not finite.
//!
//! The hot path checks its results instead, which are fewer, and searches only once they fail.

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::error::{Joint, JointField, Quantity};
use crate::real::Scalar;
use crate::state::{Joints, State, Torques};
use crate::vec3::components;

/// The first part of a state that is not finite, and the value that spoils it.
pub(crate) fn culprit_in_state<const N: usize, T: Scalar, A: Attitude<T>>(
    state: &State<N, T, A>,
) -> Option<(Quantity, T)> {
    let attitude = || {
        let spoilt = !state.attitude.is_valid();
        spoilt.then(|| (Quantity::Attitude, state.attitude.extreme()))
    };
    culprit_in_vector(Quantity::Position, &state.r_b_n)
        .or_else(|| culprit_in_vector(Quantity::Velocity, &state.r_b_n_dot))
        .or_else(attitude)
        .or_else(|| culprit_in_vector(Quantity::BodyRate, &state.omega))
        .or_else(|| {
            let mut devices = state.devices.iter().enumerate();
            devices.find_map(|(device, joints)| {
                let (field, value) = first_not_finite(&fields(joints))?;
                Some((Quantity::Joint { device, field }, value))
            })
        })
}

/// The first part of the torques that is not finite, and its value.
pub(crate) fn culprit_in_torques<const N: usize, T: Scalar>(
    torques: &Torques<N, T>,
) -> Option<(Quantity, T)> {
    culprit_in_vector(Quantity::Force, &torques.force)
        .or_else(|| culprit_in_vector(Quantity::TorqueB, &torques.torque_b))
        .or_else(|| {
            let mut motors = torques.motors.iter().enumerate();
            motors.find_map(|(device, motor)| {
                let (joint, value) = first_not_finite(&[
                    (Joint::OuterGimbal, motor.u_o),
                    (Joint::InnerGimbal, motor.u_i),
                    (Joint::Wheel, motor.u_w),
                ])?;
                Some((Quantity::Motor { device, joint }, value))
            })
        })
}

/// The vector's name and its first component that is not finite.
pub(crate) fn culprit_in_vector<T: Scalar>(
    what: Quantity,
    v: &Vector3<T>,
) -> Option<(Quantity, T)> {
    first_not_finite(&components(v).map(|value| (what, value)))
}

fn first_not_finite<Name: Copy, T: Scalar>(named: &[(Name, T)]) -> Option<(Name, T)> {
    named.iter().find(|(_, value)| !value.is_finite()).copied()
}

fn fields<T: Scalar>(joints: &Joints<T>) -> [(JointField, T); 6] {
    [
        (JointField::GammaO, joints.gamma_o),
        (JointField::GammaI, joints.gamma_i),
        (JointField::Theta, joints.theta),
        (JointField::GammaODot, joints.gamma_o_dot),
        (JointField::GammaIDot, joints.gamma_i_dot),
        (JointField::Spin, joints.spin),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quaternion::Quaternion;
    use crate::state::MotorTorques;

    fn culprit(change: impl Fn(&mut State<2>)) -> Option<Quantity> {
        let mut state = State::at_rest();
        change(&mut state);
        culprit_in_state(&state).map(|(what, _)| what)
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
            culprit_in_torques(&torques).map(|(what, _)| what)
        };
        let motor = |joint| Some(Quantity::Motor { device: 0, joint });
        assert_eq!(culprit(|_| ()), None);
        assert_eq!(culprit(|t| t.force.x = f64::NAN), Some(Quantity::Force));
        assert_eq!(culprit(|t| t.torque_b.z = f64::NAN), Some(Quantity::TorqueB));
        let bad = MotorTorques { u_o: 0.0, u_i: f64::NAN, u_w: f64::NAN };
        let mut torques = Torques::<2>::none();
        torques.motors[0] = bad;
        assert_eq!(culprit_in_torques(&torques).map(|(what, _)| what), motor(Joint::InnerGimbal));
        assert_eq!(culprit(|t| t.motors[0].u_o = f64::NAN), motor(Joint::OuterGimbal));
        assert_eq!(culprit(|t| t.motors[0].u_w = f64::NAN), motor(Joint::Wheel));
    }

    /// Infinite values, since NaN equals nothing.
    #[test]
    fn the_value_comes_with_the_name() {
        let (up, down) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut state = State::<1>::at_rest();
        state.devices[0].spin = up;
        let spin = Quantity::Joint { device: 0, field: JointField::Spin };
        assert_eq!(culprit_in_state(&state), Some((spin, up)));
        state.omega = Vector3::new(1.0, down, up);
        assert_eq!(culprit_in_state(&state), Some((Quantity::BodyRate, down)));
        state.attitude = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 };
        assert_eq!(culprit_in_state(&state), Some((Quantity::Attitude, 0.0)));
        state.attitude = Quaternion { q2: down, ..Quaternion::identity() };
        assert_eq!(culprit_in_state(&state), Some((Quantity::Attitude, down)));

        let mut torques = Torques::<1>::none();
        torques.motors[0].u_w = down;
        let motor = Quantity::Motor { device: 0, joint: Joint::Wheel };
        assert_eq!(culprit_in_torques(&torques), Some((motor, down)));
        torques.torque_b.z = up;
        assert_eq!(culprit_in_torques(&torques), Some((Quantity::TorqueB, up)));
    }
}
