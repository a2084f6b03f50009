//! Derivatives by differences in double-double: variables changed by hand, central differences
//! extrapolated twice.

use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Axis, Gravity, HubMode, Mode, Quaternion, Real, Scalar, Variable};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::draw::Case;
use crate::outputs::Named;

/// The step of the differences relative to the variable's size: the error of the extrapolated
/// difference is of its sixth power, rounding of `1e-31` over it.
const STEP: f64 = 1.0 / 1_048_576.0;

/// The number of an axis.
pub(crate) fn index(axis: Axis) -> usize {
    match axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    }
}

/// The derivative of a list of numbers, of a variable changed by some amount from where it is.
/// `size` is the scale on which they change.
pub(crate) fn difference(size: f64, of: impl Fn(Wide) -> Named<Wide>) -> Named<Wide> {
    let central = |step: Wide| {
        let (up, down) = (of(step), of(-step));
        let share = (step + step).recip();
        up.into_iter().zip(down).map(move |((name, up), (_, down))| (name, (up - down) * share))
    };
    let wide = Wide::from_f64;
    let h = wide(STEP) * wide(size);
    let [full, half, quarter] =
        [1.0, 0.5, 0.25].map(|part| central(h * wide(part)).collect::<Vec<_>>());
    // Errors of second and fourth order cancel.
    let extrapolated = full.into_iter().zip(half).zip(quarter);
    extrapolated
        .map(|(((name, full), (_, half)), (_, quarter))| {
            let first = half + (half - full) * wide(3.0).recip();
            let second = quarter + (quarter - half) * wide(3.0).recip();
            (name, second + (second - first) * wide(15.0).recip())
        })
        .collect()
}

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
pub(crate) fn changed(case: &Case<Wide>, variable: Variable, by: Wide) -> Case<Wide> {
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
    };
    *of = *of + by;
    case
}

/// The attitude after a rotation about an axis of B: `[BN]` becomes `exp(-angle tilde(e)) [BN]`.
pub(crate) fn turned<T: Scalar>(attitude: &Quaternion<T>, axis: Axis, angle: T) -> Quaternion<T> {
    let (sine, d0) = (angle * T::from_f64(0.5)).sin_cos();
    let mut d = [T::from_f64(0.0); 3];
    d[index(axis)] = sine;
    let Quaternion { q0, q1, q2, q3 } = *attitude;
    let q = [q1, q2, q3];
    let cross = [d[1] * q[2] - d[2] * q[1], d[2] * q[0] - d[0] * q[2], d[0] * q[1] - d[1] * q[0]];
    let along = d[0] * q[0] + d[1] * q[1] + d[2] * q[2];
    let [q1, q2, q3] = std::array::from_fn(|k| q0 * d[k] + d0 * q[k] - cross[k]);
    Quaternion { q0: d0 * q0 - along, q1, q2, q3 }
}

#[test]
fn a_turned_attitude_has_its_direction_cosines() {
    use precess_dynamics::Attitude;
    let attitude = Quaternion { q0: 0.5, q1: -0.5, q2: 0.1, q3: 0.7 };
    for axis in Axis::ALL {
        let mut e = nalgebra::Vector3::zeros();
        e[index(axis)] = 1.0;
        let angle = 1e-5;
        let expected = (nalgebra::Matrix3::identity() - e.cross_matrix() * angle) * attitude.dcm();
        assert!((turned(&attitude, axis, angle).dcm() - expected).amax() < 1e-10);
    }
}
