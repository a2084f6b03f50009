//! Runs of minutes to thirteen digits: DOP853 over the state and the works of all sources.
//!
//! Attitude as a quaternion, normalised wherever it is read. A wheel's angle is brought back by
//! whole turns, since rounding it in every step would change the hub's momentum step by step.

use core::cell::RefCell;
use core::f64::consts::TAU;

use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use nalgebra::Vector3;
use precess_dynamics::{Attitude, Each, JointStates, Ledger, Mode, Quaternion, SolveError};

use super::craft::{Case, Craft};
use super::kinematics;

/// Of a step: relative, and absolute in tenths of SI units, the size of the motion inside.
const TOLERANCE: f64 = 1e-13;
const ABSOLUTE: f64 = 1e-14;
/// Position, velocity, quaternion, angular velocity.
const HUB: usize = 13;
/// Of external forces, motors, friction, gravity and springs, and the three of an impulse.
const WORKS: usize = 8;
/// A wheel of 100 rad/s takes 300 a second.
const STEPS_MAX: usize = 100_000;
/// A step halved this often is 1e-9 of what it was and will not succeed.
const REJECTIONS_MAX: usize = 30;

/// Integrals over time since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Works {
    /// Of the power of external forces, J.
    pub(crate) external: f64,
    /// Of the motors.
    pub(crate) motors: f64,
    /// Of friction.
    pub(crate) friction: f64,
    /// Of gravity.
    pub(crate) gravity: f64,
    /// Of springs.
    pub(crate) springs: f64,
    /// Of gravity's force on the whole, N axes, N s.
    pub(crate) impulse: Vector3<f64>,
    /// Of the sum of the magnitudes of the motors' powers. It has kinks and is not controlled: a
    /// unit, and two digits of it do.
    pub(crate) throughput: f64,
}

/// The equations of motion in the integrator's terms.
struct Motion<'a, D: Craft> {
    case: &'a Case<D>,
    /// The integrator's interface has no errors: the error is kept here, and the step is rejected.
    failure: RefCell<Option<SolveError>>,
}

/// Runs a case for some seconds; shows the start and the end of every accepted step, and returns
/// their number.
pub(crate) fn run<D: Craft>(
    case: &Case<D>,
    duration: f64,
    mut show: impl FnMut(&Case<D>, &Ledger, &Works),
) -> usize {
    let motion = Motion { case, failure: RefCell::new(None) };
    let mut y = motion.packed();
    let report = |y: &[f64], show: &mut dyn FnMut(&Case<D>, &Ledger, &Works)| {
        let here = motion.at(y);
        let ledger = here.craft.ledger(&here.state, &here.inputs, &here.accelerations());
        let ledger = ledger.unwrap_or_else(|error| panic!("{here}: {error}"));
        show(&here, &ledger, &Motion::<D>::works(y));
    };
    report(&y, &mut show);
    let mut controlled = vec![ABSOLUTE; y.len()];
    controlled[y.len() - 1] = f64::INFINITY;
    let mut method =
        ExplicitRungeKutta::dop853().rtol(TOLERANCE).atol(controlled).max_steps(STEPS_MAX).h0(1e-4);
    let rejected = |error| -> ! { panic!("{case}: {error:?}, {:?}", motion.failure.borrow()) };
    method.init(&motion, 0.0, duration, &y).unwrap_or_else(|error| rejected(error));
    let mut steps = 0;
    // The last sum of times may miss the end by its rounding.
    while duration - method.t() > 4.0 * f64::EPSILON * duration {
        method.set_h(method.h().min(duration - method.t()));
        let mut rejections = 0;
        loop {
            method.step(&motion).unwrap_or_else(|error| rejected(error));
            if !matches!(method.status(), Status::RejectedStep) {
                break;
            }
            rejections += 1;
            assert!(rejections < REJECTIONS_MAX, "{case}: {:?}", motion.failure.borrow());
        }
        motion.failure.replace(None);
        steps += 1;
        y.clone_from(method.y());
        if wrap::<D>(&mut y) {
            let rest = duration - method.t();
            method.h0 = method.h().min(rest);
            let time = method.t();
            if rest > 0.0 {
                method.init(&motion, time, duration, &y).unwrap_or_else(|error| rejected(error));
            }
        }
        report(&y, &mut show);
    }
    steps
}

/// Brings angles beyond a turn back by whole turns.
fn wrap<D: Craft>(y: &mut [f64]) -> bool {
    let mut wrapped = false;
    for (joint, info) in y[HUB..].chunks_mut(2).zip(D::joint_infos()) {
        if !info.slides && joint[0].abs() > TAU {
            joint[0] -= TAU * libm::round(joint[0] / TAU);
            wrapped = true;
        }
    }
    wrapped
}

impl<D: Craft> Motion<'_, D> {
    /// The start, with all integrals at zero.
    fn packed(&self) -> Vec<f64> {
        let state = &self.case.state;
        let Quaternion { q0, q1, q2, q3 } = state.attitude;
        let mut y = Vec::new();
        y.extend(&state.r_b_n);
        y.extend(&state.r_b_n_dot);
        y.extend([q0, q1, q2, q3]);
        y.extend(&state.omega);
        y.extend(state.devices.states().flatten());
        y.extend([0.0; WORKS + 1]);
        y
    }

    /// The case with a state of the run.
    fn at(&self, y: &[f64]) -> Case<D> {
        let mut case = self.case.clone();
        let vector = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
        case.state.r_b_n = vector(0);
        case.state.r_b_n_dot = vector(3);
        case.state.attitude = quaternion(y).normalised();
        case.state.omega = vector(10);
        for ([coordinate, rate], joint) in case.state.devices.states_mut().zip(y[HUB..].chunks(2)) {
            (*coordinate, *rate) = (joint[0], joint[1]);
        }
        case
    }

    fn works(y: &[f64]) -> Works {
        let (_, works) = y.split_at(y.len() - WORKS - 1);
        let &[external, motors, friction, gravity, springs, x, y, z, throughput] = works else {
            panic!("{} works", works.len());
        };
        let impulse = Vector3::new(x, y, z);
        Works { external, motors, friction, gravity, springs, impulse, throughput }
    }

    /// Time derivatives of everything packed.
    fn rates(&self, y: &[f64]) -> Result<Vec<f64>, SolveError> {
        let case = self.at(y);
        let found = case.craft.accelerations(&case.state, &case.inputs)?;
        let power = case.craft.ledger(&case.state, &case.inputs, &found)?.power;
        let nb = case.state.attitude.dcm().transpose();
        let mut rates = Vec::with_capacity(y.len());
        rates.extend(&case.state.r_b_n_dot);
        rates.extend(&(nb * found.r_b_n_ddot));
        rates.extend(&quaternion(y).rate(&case.state.omega));
        rates.extend(&found.omega_dot);
        let joints = case.state.devices.states();
        rates.extend(
            joints.zip(found.devices.values()).flat_map(|([_, rate], found)| [rate, found]),
        );
        rates.extend([power.external, power.motors, power.friction, power.gravity, power.springs]);
        rates.extend(&(nb * kinematics::weight(&case, &found)));
        let given = case.inputs.motors.values().zip(case.inputs.modes.values());
        let throughput =
            given.zip(case.state.devices.states()).map(|((torque, mode), [_, rate])| {
                if mode == Mode::Driven { (torque * rate).abs() } else { 0.0 }
            });
        rates.push(throughput.sum());
        Ok(rates)
    }
}

fn quaternion(y: &[f64]) -> Quaternion {
    Quaternion { q0: y[6], q1: y[7], q2: y[8], q3: y[9] }
}

impl<D: Craft> ODE<f64, Vec<f64>> for Motion<'_, D> {
    fn diff(&self, _: f64, y: &Vec<f64>, dydt: &mut Vec<f64>) {
        match self.rates(y) {
            Ok(rates) => dydt.copy_from_slice(&rates),
            Err(error) => {
                // No step is accepted on NaN: it is shortened instead.
                dydt.fill(f64::NAN);
                self.failure.borrow_mut().get_or_insert(error);
            }
        }
    }
}
