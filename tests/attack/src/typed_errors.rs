//! Typed errors: each exactly where it is documented.

use nalgebra::Vector3;
use precess_dynamics::{Each, Gravity, HubMode, JointStates, Mode, SolveError};
use proptest::prelude::{BoxedStrategy, Strategy};

use super::case::{Case, PreparedCase};
use super::draw::Profile;
use super::residual::numbers;
use super::shapes::across;
use super::{Checked, Verdict};

/// Cases with one thing that is rejected, or none.
pub fn cases() -> BoxedStrategy<Case> {
    (Profile { gravity: false, ..Profile::REAL }.cases(), 0_usize..5, 0_usize..15)
        .prop_map(|(mut case, form, joint)| {
            let infos: Vec<_> =
                case.devices.iter().flat_map(|device| device.kind().joints()).collect();
            match form {
                0 | 1 => {
                    let at = |info: &&precess_dynamics::kind::JointInfo| info.driven == (form == 0);
                    let count = infos.iter().filter(|info| at(info)).count();
                    let found = infos.iter().enumerate().filter(|(_, info)| at(info));
                    let index = found.map(|(index, _)| index).nth(joint % count.max(1));
                    if let Some(index) = index {
                        if let Some(mode) = case.inputs.modes.values_mut().nth(index) {
                            *mode = if form == 0 { Mode::Locked } else { Mode::Driven };
                        }
                        if let Some([_, rate]) = case.state.devices.states_mut().nth(index) {
                            *rate = case.inputs.force.x;
                        }
                    }
                }
                2 => {
                    case.inputs.hub = HubMode::Fixed;
                    (case.state.omega, case.state.r_b_n_dot) =
                        (case.inputs.torque_b, Vector3::zeros());
                }
                3 => {
                    case.inputs.gravity = Gravity::Central { mu: case.inputs.force.y };
                    case.state.r_b_n = Vector3::zeros();
                }
                _ => {}
            }
            case
        })
        .boxed()
}

/// What is to be rejected, in the order hub, joints, field.
fn expected(
    case: &Case,
    PreparedCase { craft, state, inputs }: &PreparedCase<super::List>,
) -> Vec<SolveError> {
    let _ = case;
    let mut all = Vec::new();
    if inputs.hub == HubMode::Fixed {
        let both = state.r_b_n_dot.iter().chain(&state.omega).copied();
        let value = both.fold(0.0, |most: f64, x| if x.abs() > most.abs() { x } else { most });
        if value != 0.0 {
            all.push(SolveError::FixedHubMoves { value });
        }
    }
    let joints = state.devices.states().zip(inputs.modes.values()).zip(craft.joints());
    for (([_, rate], mode), (device, info)) in joints {
        let joint = info.body;
        let held = mode == Mode::Prescribed(0.0) || (mode == Mode::Locked && rate == 0.0);
        if !info.driven && !held {
            all.push(SolveError::NotDriven { device, joint });
        } else if mode == Mode::Locked && rate != 0.0 {
            all.push(SolveError::LockedJointMoves { device, joint, rate });
        }
    }
    if matches!(inputs.gravity, Gravity::Central { .. }) && state.r_b_n == Vector3::zeros() {
        all.push(SolveError::AtCentre);
    }
    all
}

/// `errors-are-typed`: what is locked and moves, a mode that the kind has not, the centre of the
/// field and lists of another length are rejected by their own errors, and nothing else is.
///
/// # Errors
/// Where it does not hold.
pub fn errors_are_typed(case: &Case) -> Verdict {
    let Ok(list) = case.list() else { return Ok(Checked::Rejected) };
    let all = expected(case, &list);
    let PreparedCase { craft, state, inputs } = &list;
    let right = |error: Option<SolveError>, call: &str| match (error, &all[..]) {
        (Some(error), [first, ..]) if error == *first || all.contains(&error) && all.len() > 1 => {
            Ok(())
        }
        (None | Some(SolveError::Singular { .. }), []) => Ok(()),
        (error, _) => Err(format!("{call}: {error:?}, not {all:?}")),
    };
    right(craft.accelerations(state, inputs).err(), "accelerations")?;
    right(craft.step(state, inputs, 0.0).err(), "step")?;
    right(craft.step_with_work(state, inputs, 0.0).err(), "step with work")?;
    for (call, result) in across(case).unwrap_or_default() {
        if call.starts_with("accelerations") {
            right(result.err(), call)?;
        }
    }
    // A stop is there for what moves; what the kind has not is rejected all the same.
    let stopped = craft.stop(state, inputs).err();
    let not_driven = all.iter().find(|error| matches!(error, SolveError::NotDriven { .. }));
    match (stopped, not_driven) {
        (None | Some(SolveError::Singular { .. }), None) => {}
        (Some(found), Some(expected)) if found == *expected => {}
        (found, expected) => return Err(format!("stop: {found:?}, not {expected:?}")),
    }
    lists_of_another_length(&list)?;
    Ok(if all.is_empty() { Checked::Rejected } else { Checked::Holds })
}

fn lists_of_another_length(list: &PreparedCase<super::List>) -> Result<(), String> {
    let PreparedCase { craft, state, inputs } = list;
    let expected = state.devices.len();
    let Some(found) = expected.checked_sub(1) else { return Ok(()) };
    let count = SolveError::Count { expected, found };
    let refused = |error: Option<SolveError>, call: &str| {
        if error == Some(count) { Ok(()) } else { Err(format!("{call}: {error:?}, not {count:?}")) }
    };
    let mut short = state.clone();
    short.devices.truncate(found);
    refused(craft.accelerations(&short, inputs).map(|f| numbers(&f)).err(), "short state")?;
    refused(craft.step(&short, inputs, 0.0).err(), "step of a short state")?;
    refused(craft.stop(&short, inputs).err(), "stop of a short state")?;
    refused(craft.energy(&short).err(), "energy of a short state")?;
    let mut few = inputs.clone();
    few.motors.truncate(found);
    refused(craft.accelerations(state, &few).err(), "short motors")?;
    let mut few = inputs.clone();
    few.modes.truncate(found);
    refused(craft.accelerations(state, &few).err(), "short modes")
}
