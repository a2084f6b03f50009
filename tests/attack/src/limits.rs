//! At the limits of the range of numbers: the field far from and near its centre, gimbals near
//! lock.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Dgvscmg, Gravity, Hub, JointStates, SolveError};
use precess_tests::double_double::DoubleDouble;
use proptest::prelude::{BoxedStrategy, Strategy};

use super::call_results::of_accelerations;
use super::case::{Case, PreparedCase};
use super::number::Number;
use super::residual::{numbers, wide};
use super::sizes::sizes;
use super::{Checked, Verdict};

/// A field's rounding: a root, a reciprocal and some products.
const FIELD: f64 = 1e-14;

/// Error of accelerations near a singular pose, in epsilons over the square of the distance.
const NEAR: f64 = 100.0;

/// A hub without devices at any distance from a centre, so small that no gradient matters.
pub fn far_and_near() -> BoxedStrategy<Case> {
    let direction = [(); 3].map(|()| Number::within(-1.0, 1.0));
    let (distance, field) = (Number::within(-140.0, 160.0), Number::within(-20.0, 20.0));
    (direction, distance, field)
        .prop_map(|(direction, distance, field)| {
            let toward = Vector3::from(direction);
            let toward = if toward.norm() < 1e-3 { Vector3::x() } else { toward };
            let r = 10.0_f64.powf(distance);
            let inertia = (1e-10 * r) * (1e-10 * r);
            let i_b_bc = Matrix3::identity() * inertia;
            let mut case =
                Case::still(Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc }, Vec::new());
            case.state.r_b_n = toward * (r / toward.norm());
            // As strong as that, where the parameter is a number.
            let g = 10.0_f64.powf(field);
            let mu = g * r * r;
            let mu = if mu.is_finite() { mu } else { 1e300 };
            case.inputs.gravity = Gravity::Central { mu };
            case
        })
        .boxed()
}

/// `central-gravity`: the field is `mu / r²` towards the centre wherever that is a number.
///
/// # Errors
/// Where it does not hold.
pub fn central_gravity(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let Gravity::Central { mu } = inputs.gravity else { return Ok(Checked::Rejected) };
    let size = state.r_b_n.amax();
    let unit = state.r_b_n / size;
    let expected = -(mu / size / size) * unit / (unit.norm() * unit.norm_squared());
    if !expected.iter().all(|x| x.is_finite()) || expected.norm() < 1e-290 {
        return Ok(Checked::Rejected);
    }
    match craft.accelerations(&state, &inputs) {
        Ok(found) => {
            let error = (found.r_b_n_ddot - expected).norm() / expected.norm();
            if error <= FIELD {
                Ok(Checked::Holds)
            } else {
                Err(format!("{:?}, not {expected:?}", found.r_b_n_ddot))
            }
        }
        Err(error) => Err(format!("{error}, not {expected:?}")),
    }
}

/// Mass of the spacecraft near lock, kg, least moment of its hub and of its wheel, kg m².
const MASS: f64 = 24.0;
const INERTIA: f64 = 6.0;
const WHEEL: f64 = 0.1;

/// A bare wheel in massless gimbals, near lock.
pub fn near_lock() -> BoxedStrategy<Case> {
    let distance = Number::log_within(1e-9, 0.1);
    let position = [(); 3].map(|()| Number::within(-1.0, 1.0));
    let omega = [(); 3].map(|()| Number::within(-1.0, 1.0));
    let motion = [(); 5].map(|()| Number::within(-1.0, 1.0));
    let torques = [(); 3].map(|()| Number::within(-1.0, 1.0));
    (distance, position, omega, motion, torques)
        .prop_map(|(distance, position, omega, [a, b, c, d, e], torques)| {
            let i_b_bc = Matrix3::from_diagonal(&Vector3::new(9.0, 8.0, 6.0));
            let hub = Hub { m_b: 20.0, r_bc_b: Vector3::new(0.1, 0.0, 0.0), i_b_bc };
            let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
            let bare = Dgvscmg::bare_wheel(4.0, disc);
            let mut case =
                Case::still(hub, vec![Dgvscmg { r_go_b: position.into(), ..bare }.into()]);
            case.state.omega = omega.into();
            let joints = [[3.0 * a, b], [FRAC_PI_2 - distance, c], [3.0 * d, 100.0 * e]];
            for ([q, rate], [to_q, to_rate]) in
                joints.into_iter().zip(case.state.devices.states_mut())
            {
                (*to_q, *to_rate) = (q, rate);
            }
            for (motor, torque) in case.inputs.motors[0].as_mut_slice().iter_mut().zip(torques) {
                *motor = torque;
            }
            case
        })
        .boxed()
}

/// `near-singular`: near gimbal lock the error is that of its conditioning, or the pose is
/// rejected.
///
/// # Errors
/// Where it does not hold.
pub fn near_singular(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs: given }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let found = match craft.accelerations(&state, &given) {
        Ok(found) => numbers(&found),
        Err(SolveError::Singular { .. }) => return Ok(Checked::Holds),
        Err(error) => return Err(error.to_string()),
    };
    let reference = case
        .placed(&case.devices_in::<DoubleDouble>())
        .map_err(|error| format!("in double-double: {error}"))?;
    let PreparedCase { craft, state: exact, inputs } = &reference;
    let exact = craft.accelerations(exact, inputs).map_err(|error| error.to_string())?;
    let exact = wide(&of_accelerations(&exact));
    let gamma_i = state.devices.states().nth(1).map_or(0.0, |[q, _]| q);
    let distance = gamma_i.cos().abs();
    let bound = NEAR * f64::EPSILON / (distance * distance);
    // What is left of gyroscopic terms that cancel has the rounding of the terms.
    let terms = sizes(case, &state, &given, &[]);
    let joint = terms.joints.iter().fold(0.0, |most: f64, x| most.max(*x));
    let least = [terms.force / MASS, terms.moment / INERTIA, joint / WHEEL];
    let blocks = [("r''", 0..3), ("omega'", 3..6), ("the joints", 6..9)];
    for ((what, range), least) in blocks.into_iter().zip(least) {
        let (Some(found), Some(exact)) = (found.get(range.clone()), exact.get(range)) else {
            return Ok(Checked::Rejected);
        };
        let most = exact.iter().fold(least, |most: f64, x| most.max(x.abs()));
        let error = found.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if error > bound * most {
            let error = error / most;
            return Err(format!(
                "{what} is off by {error:e} at {distance:e} from lock: {found:?}, not {exact:?}"
            ));
        }
    }
    Ok(Checked::Holds)
}
