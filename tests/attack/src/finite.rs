//! Results are finite or errors, and the first input that is not finite is named.

use precess_dynamics::{
    Attitude, Each, Gravity, HubMode, JointStates, Mode, Mrp, Quantity, Quaternion, Scalar,
    SolveError, State,
};

use super::call_results::{CallResult, call_results};
use super::case::{Case, List, PreparedCase};
use super::shapes::{across, batched, in_every_shape};
use super::variants::batched_variants;
use super::{Checked, Verdict};

/// Whether every number is finite.
fn all_finite<T: Scalar>(call_results: &[(&'static str, CallResult<T>)], shape: &str) -> Verdict {
    for (name, result) in call_results {
        let bad = result.iter().flatten().find(|number| !number.is_finite());
        if let Some(bad) = bad {
            return Err(format!("{name} of {shape} has {bad:?}"));
        }
    }
    Ok(Checked::Holds)
}

/// `result-or-error`: every public call gives finite numbers or an error.
///
/// # Errors
/// Where it does not hold.
pub fn result_or_error(case: &Case) -> Verdict {
    let mut checked = Checked::Rejected;
    macro_rules! every_shape {
        ($number:tt) => {
            in_every_shape!(case, $number, |shape, placed| {
                if let Ok(placed) = placed {
                    let dt = <$number as Scalar>::from_f64(case.dt);
                    checked = all_finite(&call_results(&placed, dt), shape)?;
                }
            })
        };
    }
    every_shape!(f64);
    every_shape!(f32);
    all_finite(&across(case).unwrap_or_default(), "devices side by side")?;
    for each in [true, false] {
        let found = [batched(case, each), batched_variants(case, each)];
        for found in found.iter().flatten() {
            let all: Vec<_> =
                found.accelerations.iter().map(|found| ("batch", found.clone())).collect();
            all_finite(&all, "batch")?;
            for (state, end) in &found.runs {
                if end.is_ok() {
                    all_finite(&[("run", Ok(state.clone()))], "batch")?;
                }
            }
        }
    }
    if let Ok(list) = case.list() {
        with_parameters(&list, case.dt)?;
    }
    Ok(checked)
}

/// The same by modified Rodrigues parameters, which may be as large as they like.
fn with_parameters(list: &PreparedCase<List>, dt: f64) -> Verdict {
    let PreparedCase { craft, state, inputs } = list;
    let Quaternion { q1, q2, q3, .. } = state.attitude;
    for attitude in [Mrp::from(state.attitude), Mrp::from_components(q1, q2, q3)] {
        let state = State {
            r_b_n: state.r_b_n,
            r_b_n_dot: state.r_b_n_dot,
            attitude,
            omega: state.omega,
            devices: state.devices.clone(),
            modal: (),
        };
        let next = craft.step(&state, inputs, dt);
        let numbers = next.map(|next| {
            let mut all: Vec<f64> = next.attitude.0.iter().copied().collect();
            all.extend(next.omega.iter().chain(&next.r_b_n).chain(&next.r_b_n_dot));
            all
        });
        let found = craft.accelerations(&state, inputs);
        let found = found.map(|found| super::call_results::of_accelerations(&found));
        all_finite(&[("step", numbers), ("accelerations", found)], "MRPs")?;
    }
    Ok(Checked::Holds)
}

/// Every number of a state in the order in which they are checked.
fn of_state(list: &PreparedCase<List>) -> Vec<(Quantity, f64)> {
    let PreparedCase { craft, state, .. } = list;
    let mut all = Vec::new();
    all.extend(state.r_b_n.iter().map(|x| (Quantity::Position, *x)));
    all.extend(state.r_b_n_dot.iter().map(|x| (Quantity::Velocity, *x)));
    if !state.attitude.is_valid() {
        // A length that is zero is named like a number that is none.
        return [all, vec![(Quantity::Attitude, f64::NAN)]].concat();
    }
    all.extend(state.omega.iter().map(|x| (Quantity::BodyRate, *x)));
    for ([q, rate], (device, info)) in state.devices.states().zip(craft.joints()) {
        let joint = |field| Quantity::Joint { device, field };
        all.extend([(joint(info.coordinate), q), (joint(info.rate), rate)]);
    }
    all
}

/// Every number of inputs in the order in which they are checked.
fn of_inputs(list: &PreparedCase<List>) -> Vec<(Quantity, f64)> {
    let PreparedCase { craft, inputs, .. } = list;
    let mut all = Vec::new();
    all.extend(inputs.force.iter().map(|x| (Quantity::Force, *x)));
    all.extend(inputs.torque_b.iter().map(|x| (Quantity::TorqueB, *x)));
    let joints = inputs.motors.values().zip(inputs.modes.values()).zip(craft.joints());
    for ((motor, mode), (device, info)) in joints {
        let joint = info.body;
        all.push((Quantity::Motor { device, joint }, motor));
        if let Mode::Prescribed(acceleration) = mode {
            all.push((Quantity::JointAcceleration { device, joint }, acceleration));
        }
    }
    if let HubMode::Prescribed { r_b_n_ddot, omega_dot } = &inputs.hub {
        let both = r_b_n_ddot.iter().chain(omega_dot);
        all.extend(both.map(|x| (Quantity::HubAcceleration, *x)));
    }
    match inputs.gravity {
        Gravity::None => {}
        Gravity::Uniform(g) => all.extend(g.iter().map(|x| (Quantity::Gravity, *x))),
        Gravity::Central { mu } => all.push((Quantity::Gravity, mu)),
    }
    let wrenches = inputs.bodies.iter().flat_map(Each::values).zip(craft.joints());
    for (wrench, (device, info)) in wrenches {
        let what = Quantity::Wrench { device, body: info.body };
        all.extend(wrench.force.iter().chain(&wrench.moment).map(|x| (what, *x)));
    }
    all
}

/// What is rejected first; the value of an attitude is what the attitude shows.
fn first_bad(list: &PreparedCase<List>, all: &[(Quantity, f64)]) -> Option<(Quantity, f64)> {
    let (what, value) = *all.iter().find(|(_, value)| !value.is_finite())?;
    let shown = if what == Quantity::Attitude { list.state.attitude.extreme() } else { value };
    Some((what, shown))
}

/// Calls that depend only on the state.
const OF_STATE: [&str; 4] =
    ["energy", "momentum about the origin", "momentum about the centre of mass", "centre of mass"];

/// Whether the error is the one that names this, or none that names an input.
fn named<T: Scalar>(
    result: &CallResult<T>,
    expected: Option<(Quantity, f64)>,
    call: &str,
) -> Result<(), String> {
    match (result, expected) {
        (Err(SolveError::NotFinite { what, value }), Some((first, shown)))
            if *what == first && value.to_f64().to_bits() == shown.to_bits() =>
        {
            Ok(())
        }
        (Err(SolveError::NotFinite { what, value }), _) => {
            Err(format!("{call} names {what} with {value:?}; bad first: {expected:?}"))
        }
        (other, Some((first, shown))) => {
            let result = other.as_ref().map(|_| "numbers");
            Err(format!("{call} gives {result:?}; bad first: {first} with {shown:?}"))
        }
        _ => Ok(()),
    }
}

/// `first-bad-input-is-named`: the first input that is not finite is named with its value, and only
/// inputs are named.
///
/// # Errors
/// Where it does not hold.
pub fn first_bad_is_named(case: &Case) -> Verdict {
    let Ok(list) = case.list() else { return Ok(Checked::Rejected) };
    if !case.dt.is_finite() {
        let step = list.craft.step(&list.state, &list.inputs, case.dt);
        let refused = matches!(step, Err(SolveError::NotFinite { .. }));
        return if refused { Ok(Checked::Holds) } else { Err(format!("step of {}", case.dt)) };
    }
    let in_state = first_bad(&list, &of_state(&list));
    let first = in_state.or_else(|| first_bad(&list, &of_inputs(&list)));
    let check = |all: &[(&'static str, CallResult)], shape: &str| {
        for (call, result) in all {
            let expected = match *call {
                "momentum about a point" if in_state.is_none() => continue,
                call if OF_STATE.contains(&call) => in_state,
                _ => first,
            };
            named(result, expected, &format!("{call} of {shape}"))?;
        }
        Ok::<(), String>(())
    };
    in_every_shape!(case, f64, |shape, placed| {
        if let Ok(placed) = placed {
            check(&call_results(&placed, case.dt), shape)?;
        }
    });
    check(&across(case).unwrap_or_default(), "devices side by side")?;
    let first_state = Case { more: Vec::new(), ..case.clone() };
    for each in [false, true] {
        if let Some(found) = batched(&first_state, each) {
            for result in &found.accelerations {
                named(result, first, "accelerations of a batch")?;
            }
            for (_, end) in &found.runs {
                named(&end.map(|()| Vec::<f64>::new()), first, "run of a batch")?;
            }
        }
    }
    Ok(Checked::Holds)
}
