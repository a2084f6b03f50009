//! The longest step that an error names: it is accepted, and no vibration grows with it.

use nalgebra::Vector3;
use precess_dynamics::{JointStates, SolveError, Spacecraft, State};

use super::case::{Case, List, PreparedCase};
use super::{Checked, Verdict};

/// A step that is too long for any spring and damper of the cases, in steps of the case.
const LONG: f64 = 1e4;

/// Deflection, of what the case has: so small that the pose stays.
const SMALL: f64 = 1e-6;

/// Steps of each half of a run.
const STEPS: usize = 100;

/// By how much the largest energy of the second half may exceed that of the first: truncation of the
/// motion of the pose.
const GROWTH: f64 = 1e-4;

/// `longest-step-holds`: the longest step that `Unstable` names is accepted, no vibration grows
/// with it, and a longer one is rejected.
///
/// # Errors
/// Where it does not hold.
pub fn longest_step_holds(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let mut start = state;
    (start.omega, start.r_b_n_dot) = (Vector3::zeros(), Vector3::zeros());
    for [coordinate, rate] in start.devices.states_mut() {
        (*coordinate, *rate) = (SMALL * *coordinate, 0.0);
    }
    let rejected = craft.step(&start, &inputs, LONG * case.dt);
    let Err(SolveError::Unstable { longest, .. }) = rejected else { return Ok(Checked::Rejected) };
    if craft.step(&start, &inputs, 1.001 * longest).is_ok() {
        return Err(format!("a step longer than {longest:?} s is accepted"));
    }
    let energy = |craft: &Spacecraft<List>, state: &State<List>| -> Result<f64, String> {
        let found = craft.accelerations(state, &inputs).map_err(|error| error.to_string())?;
        let ledger = craft.ledger(state, &inputs, &found).map_err(|error| error.to_string())?;
        Ok(ledger.energy())
    };
    let mut most = [0.0_f64; 2];
    for half in &mut most {
        for step in 1..=STEPS {
            start = craft
                .step(&start, &inputs, 0.999 * longest)
                .map_err(|error| format!("step {step} of {longest:?} s: {error}"))?;
            *half = half.max(energy(&craft, &start)?);
        }
    }
    let [first, second] = most;
    if second > (1.0 + GROWTH) * first {
        return Err(format!("energy grows from {first:?} J to {second:?} J at {longest:?} s"));
    }
    Ok(Checked::Holds)
}
