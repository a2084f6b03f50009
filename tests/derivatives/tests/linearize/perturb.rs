//! Variables of a random spacecraft changed by hand, and how large they are.

use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Gravity, HubMode, Mode, Scalar, Variable};
use precess_tests::differences::{index, turned};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::draw::Case;

/// The scale on which a variable's effect changes.
pub(crate) fn size(case: &Case<Wide>, variable: Variable) -> f64 {
    match variable {
        Variable::Position(_) => case.state.r_b_n.iter().map(|x| x.abs().to_f64()).sum(),
        Variable::Mu => 1e14,
        _ => 1.0,
    }
}

/// How large a variable is, for the comparison of outputs by different ones.
pub(crate) fn magnitude(case: &Case<Wide>, variable: Variable, spins: bool) -> f64 {
    match variable {
        Variable::Velocity(_) | Variable::Gravity(_) => 10.0,
        Variable::Rate(_) if spins => 600.0,
        Variable::Force(_) => 30.0,
        Variable::TorqueB(_) | Variable::Motor(_) => 5.0,
        _ => size(case, variable),
    }
}

/// The case with a variable changed.
pub(crate) fn changed<T: Scalar>(case: &Case<T>, variable: Variable, by: T) -> Case<T> {
    let mut case = case.clone();
    let (state, inputs) = (&mut case.state, &mut case.inputs);
    let of = match variable {
        Variable::Position(axis) => &mut state.r_b_n[index(axis)],
        Variable::Velocity(axis) => &mut state.r_b_n_dot[index(axis)],
        Variable::Omega(axis) => &mut state.omega[index(axis)],
        Variable::Force(axis) => &mut inputs.force[index(axis)],
        Variable::TorqueB(axis) => &mut inputs.torque_b[index(axis)],
        Variable::Coordinate(joint) => state.devices.states_mut().nth(joint).unwrap()[0],
        Variable::Rate(joint) => {
            let [_, rate] = state.devices.states_mut().nth(joint).unwrap();
            rate
        }
        Variable::Motor(joint) => inputs.motors.values_mut().nth(joint).unwrap(),
        Variable::Acceleration(joint) => match inputs.modes.values_mut().nth(joint).unwrap() {
            Mode::Prescribed(acceleration) => acceleration,
            mode => panic!("{mode:?} is not prescribed"),
        },
        Variable::BodyForce(joint, axis) => {
            let mut wrenches = inputs.bodies.iter_mut().flat_map(Each::values_mut);
            &mut wrenches.nth(joint).unwrap().force[index(axis)]
        }
        Variable::BodyMoment(joint, axis) => {
            let mut wrenches = inputs.bodies.iter_mut().flat_map(Each::values_mut);
            &mut wrenches.nth(joint).unwrap().moment[index(axis)]
        }
        Variable::HubAcceleration(axis) | Variable::HubAngularAcceleration(axis) => {
            let HubMode::Prescribed { r_b_n_ddot, omega_dot } = &mut inputs.hub else {
                panic!("the hub is not prescribed");
            };
            let linear = matches!(variable, Variable::HubAcceleration(_));
            let of = if linear { r_b_n_ddot } else { omega_dot };
            &mut of[index(axis)]
        }
        Variable::Gravity(axis) => match &mut inputs.gravity {
            Gravity::Uniform(g) => &mut g[index(axis)],
            other => panic!("{other:?} is not uniform"),
        },
        Variable::Mu => match &mut inputs.gravity {
            Gravity::Central { mu } => mu,
            other => panic!("{other:?} is not central"),
        },
        Variable::Attitude(axis) => {
            state.attitude = turned(&state.attitude, axis, by);
            return case;
        }
        Variable::ModalCoordinate(_)
        | Variable::ModalRate(_)
        | Variable::ModalForce(_)
        | Variable::MountForce(..)
        | Variable::MountMoment(..) => panic!("{variable} is of a flexible structure"),
    };
    *of = *of + by;
    case
}

#[test]
fn a_turned_attitude_has_its_direction_cosines() {
    use precess_dynamics::{Attitude, Axis, Quaternion};
    let attitude = Quaternion { q0: 0.5, q1: -0.5, q2: 0.1, q3: 0.7 };
    for axis in Axis::ALL {
        let mut e = nalgebra::Vector3::zeros();
        e[index(axis)] = 1.0;
        let angle = 1e-5;
        let expected = (nalgebra::Matrix3::identity() - e.cross_matrix() * angle) * attitude.dcm();
        assert!((turned(&attitude, axis, angle).dcm() - expected).amax() < 1e-10);
    }
}
