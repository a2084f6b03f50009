//! What a state's numbers may be without changing the motion: wrapped angles, other parameters of
//! the attitude, another order of devices.

use std::f64::consts::PI;

use precess_dynamics::{
    Attitude, BuiltIn, Gravity, JointStates, Mrp, Passive, Quaternion, SolveError, State,
};

use super::case::{Case, List, PreparedCase};
use super::residual::{from_numbers, numbers, solves};
use super::shapes::wrapped;
use super::sizes::motion;
use super::{Checked, Verdict};

/// Energies of equal states: some tens of terms, each with its rounding.
const ENERGY: f64 = 200.0;

/// Attitudes after one small step: the fifth power of a milliradian, and rounding.
const ATTITUDE: f64 = 1e-12;

/// Spring, damper and friction of each joint.
fn passives(list: &List) -> Vec<Passive> {
    let of_device = |device: &BuiltIn| {
        let count = device.kind().joints().len();
        device.parameters().passive.into_iter().take(count)
    };
    list.iter().flat_map(of_device).collect()
}

/// `wrapping-changes-nothing`: accelerations and energies are those before, and a joint with a
/// spring keeps its coordinate.
///
/// # Errors
/// Where it does not hold.
pub fn wrapping_changes_nothing(case: &Case) -> Verdict {
    let Ok(list) = case.list() else { return Ok(Checked::Rejected) };
    let after = PreparedCase { state: wrapped(&list), ..list.clone() };
    let joints = list.state.devices.states().zip(after.state.devices.states());
    for (([q, _], [found, _]), ((device, info), passive)) in
        joints.zip(list.craft.joints().zip(passives(&case.devices)))
    {
        let kept = q.to_bits() == found.to_bits();
        let what = format!("{} of device {device} was {q:?} and became {found:?}", info.coordinate);
        if !kept && (info.slides || passive.stiffness != 0.0) {
            return Err(what);
        }
        if passive.stiffness == 0.0 && !info.slides && found.abs() > PI {
            return Err(what);
        }
    }
    let PreparedCase { craft, state, inputs } = &list;
    let before = craft.accelerations(state, inputs).map(|found| numbers(&found));
    let found = craft.accelerations(&after.state, inputs).map(|found| numbers(&found));
    let (before, found) = match (&before, &found) {
        (Ok(before), Ok(found)) => (before, found),
        (Err(before), Err(found)) if same_kind(before, found) => return Ok(Checked::Rejected),
        _ => return Err(format!("{found:?}, not {before:?}")),
    };
    solves(case, &list, found, "accelerations of wrapped angles")?;
    let accelerations = from_numbers(craft, before)?;
    let ledger = |placed: &PreparedCase<List>| craft.ledger(&placed.state, inputs, &accelerations);
    let (Ok(old), Ok(new)) = (ledger(&list), ledger(&after)) else {
        return Ok(Checked::Rejected);
    };
    let field = match inputs.gravity {
        Gravity::None => 0.0,
        Gravity::Uniform(g) => g.norm(),
        Gravity::Central { mu } => mu / state.r_b_n.norm_squared(),
    };
    let reach = state.r_b_n.norm() + 20.0;
    for (what, old, new, unit) in [
        ("kinetic energy", old.kinetic, new.kinetic, motion(case, state).energy),
        ("energy in the field", old.gravity, new.gravity, craft.mass() * field * reach),
        ("energy of the springs", old.springs, new.springs, 0.0),
    ] {
        if (old - new).abs() > ENERGY * f64::EPSILON * unit {
            return Err(format!("{what} was {old:?} and became {new:?}"));
        }
    }
    Ok(Checked::Holds)
}

fn same_kind(a: &SolveError, b: &SolveError) -> bool {
    std::mem::discriminant(a) == std::mem::discriminant(b)
}

/// `order-changes-only-rounding`: devices in another order solve the same equations.
///
/// # Errors
/// Where it does not hold.
pub fn order_changes_only_rounding(case: &Case) -> Verdict {
    let Ok(list) = case.list() else { return Ok(Checked::Rejected) };
    let mut other = case.clone();
    other.devices.reverse();
    other.state.devices.reverse();
    other.inputs.motors.reverse();
    other.inputs.modes.reverse();
    other.inputs.bodies.iter_mut().for_each(|bodies| bodies.reverse());
    let reversed = other.list().map_err(|error| format!("in another order: {error}"))?;
    let given = list.craft.accelerations(&list.state, &list.inputs);
    let found = reversed.craft.accelerations(&reversed.state, &reversed.inputs);
    match (given, found) {
        (Ok(_), Ok(mut found)) => {
            found.devices.reverse();
            solves(case, &list, &numbers(&found), "accelerations in another order")
        }
        (Err(given), Err(found)) if same_kind(&given, &found) => Ok(Checked::Rejected),
        (given, found) => Err(format!("in another order {found:?}, not {given:?}")),
    }
}

/// `attitudes-agree`: quaternions of any length and both sets of MRPs that stand for one attitude
/// move alike.
///
/// # Errors
/// Where it does not hold.
pub fn attitudes_agree(case: &Case) -> Verdict {
    let Ok(list) = case.list() else { return Ok(Checked::Rejected) };
    // So short that what RK4 leaves out of either parameters' motion is nothing: wheels turn by
    // 6e-3.
    let dt = case.dt.clamp(-1e-5, 1e-5);
    let mut checked = Checked::Rejected;
    // From near the identity, where the outer set is large, to any attitude.
    for share in [1.0, 1e-2, 1e-3] {
        let Quaternion { q0, q1, q2, q3 } = list.state.attitude;
        let q = Quaternion { q0, q1: share * q1, q2: share * q2, q3: share * q3 };
        for length in [1.0, 1e-3, 1e-150, 1e-165, 1e-300, 1e-310, 1e165, 1e300] {
            let scaled = q.map(|x| length * x);
            // The same attitude with the digits that are left, of about unit length.
            let power = if length < 1.0 { f64::powi(2.0, 600) } else { f64::powi(2.0, -600) };
            let near =
                if length == 1.0 { scaled } else { scaled.map(|x| x * power * power.sqrt()) };
            let unit = near.normalised();
            if !(unit.is_valid() && scaled.is_valid()) {
                continue;
            }
            let what = format!("quaternion of length {length:e}, vector part times {share:e}");
            checked = moves_alike(case, &list, unit, scaled, dt, &what)?;
        }
        let inner = Mrp::from(q.normalised());
        let what = format!("MRPs {:?}", inner.0.norm());
        moves_alike(case, &list, q.normalised(), inner, dt, &what)?;
        let outer = inner.shadow();
        if outer.is_valid() {
            let what = format!("MRPs {:?}", outer.0.norm());
            moves_alike(case, &list, q.normalised(), outer, dt, &what)?;
        }
    }
    Ok(checked)
}

/// A quaternion with each number changed.
trait Map {
    fn map(&self, change: impl Fn(f64) -> f64) -> Self;
}

impl Map for Quaternion {
    fn map(&self, change: impl Fn(f64) -> f64) -> Self {
        let Self { q0, q1, q2, q3 } = *self;
        Self { q0: change(q0), q1: change(q1), q2: change(q2), q3: change(q3) }
    }
}

fn with_attitude<A>(state: &State<List>, attitude: A) -> State<List, A> {
    State {
        r_b_n: state.r_b_n,
        r_b_n_dot: state.r_b_n_dot,
        attitude,
        omega: state.omega,
        devices: state.devices.clone(),
        modal: (),
    }
}

fn moves_alike<A: Attitude<f64>>(
    case: &Case,
    list: &PreparedCase<List>,
    unit: Quaternion,
    other: A,
    dt: f64,
    what: &str,
) -> Verdict {
    let PreparedCase { craft, state, inputs } = list;
    let (state, other) = (with_attitude(state, unit), with_attitude(state, other));
    let of_unit = craft.accelerations(&state, inputs);
    let found = craft.accelerations(&other, inputs);
    match (&of_unit, &found) {
        (Ok(_), Ok(found)) => {
            let case = case.with(&state, inputs);
            let list = PreparedCase { state: state.clone(), ..list.clone() };
            solves(&case, &list, &numbers(found), &format!("accelerations with {what}"))?;
        }
        (Err(unit), Err(found)) if same_kind(unit, found) => return Ok(Checked::Rejected),
        _ => return Err(format!("{what}: {found:?}, not {of_unit:?}")),
    }
    match (craft.step(&state, inputs, dt), craft.step(&other, inputs, dt)) {
        (Ok(expected), Ok(found)) => {
            let error = (expected.attitude.dcm() - found.attitude.dcm()).amax();
            if error <= ATTITUDE {
                Ok(Checked::Holds)
            } else {
                Err(format!("attitude after a step with {what} is off by {error:e}"))
            }
        }
        (Err(unit), Err(found)) if same_kind(&unit, &found) => Ok(Checked::Rejected),
        (unit, found) => {
            let [unit, found] = [unit.err(), found.err()];
            Err(format!("step with {what}: {found:?}, not {unit:?}"))
        }
    }
}
