//! The same bits for every shape of the set, in a batch and side by side.

use precess_dynamics::Scalar;

use super::call_results::{CallResult, call_results, of_accelerations, of_state};
use super::case::{Case, PreparedCase};
use super::shapes::{Batched, across, batched, in_every_shape};
use super::variants::{batched_variants, first_inputs, variant};
use super::{Checked, Verdict};

/// Numbers by their bits, errors as text: NaN equals itself.
fn text<T: Scalar>(result: &CallResult<T>) -> String {
    match result {
        Ok(all) => {
            let bits = all.iter().map(|x| format!("{:x}", x.to_f64().to_bits()));
            bits.collect::<Vec<_>>().join(" ")
        }
        Err(error) => format!("{error:?}"),
    }
}

/// `shapes-are-bit-identical`: an array, a tuple, a nested tuple, a list and the set on board give
/// the same bits or the same error.
///
/// # Errors
/// Where it does not hold.
pub fn shapes_are_identical(case: &Case) -> Verdict {
    let mut checked = Checked::Rejected;
    macro_rules! every_shape {
        ($number:tt) => {
            let mut first = None;
            in_every_shape!(case, $number, |shape, placed| {
                let dt = <$number as Scalar>::from_f64(case.dt);
                let texts: Result<Vec<_>, _> = match &placed {
                    Ok(placed) => Ok(call_results(placed, dt)
                        .into_iter()
                        .map(|(call, result)| (call, text(&result)))
                        .collect()),
                    Err(error) => Err(format!("{error:?}")),
                };
                if texts.is_ok() {
                    checked = Checked::Holds;
                }
                let first = first.get_or_insert_with(|| texts.clone());
                compare(first, &texts, shape)?;
            });
        };
    }
    every_shape!(f64);
    every_shape!(f32);
    Ok(checked)
}

type Texts = Result<Vec<(&'static str, String)>, String>;

fn compare(first: &Texts, other: &Texts, shape: &str) -> Result<(), String> {
    match (first, other) {
        (Ok(first), Ok(other)) => {
            for ((call, first), (_, other)) in first.iter().zip(other) {
                if first != other {
                    return Err(format!("{call} of {shape}: {other}, not {first}"));
                }
            }
            Ok(())
        }
        (Err(first), Err(other)) if first == other => Ok(()),
        _ => Err(format!("{shape} is {other:?}, not {first:?}")),
    }
}

/// What single evaluations and steps make of each state; of a case of its own each, or of one.
fn single(case: &Case, each: bool, varied: bool) -> Option<Batched> {
    let mut all = Batched { accelerations: Vec::new(), runs: Vec::new() };
    for (index, (state, inputs)) in case.all().iter().enumerate() {
        let one = if varied { variant(case, index)? } else { case.with(state, inputs) };
        let PreparedCase { craft, state, inputs } = one.list().ok()?;
        let inputs = match (each, varied) {
            (true, _) => inputs,
            (false, true) => first_inputs(case)?,
            (false, false) => case.inputs.clone(),
        };
        let found = craft.accelerations(&state, &inputs);
        all.accelerations.push(found.map(|found| of_accelerations(&found)));
        let mut now = state;
        let end = (0..case.steps).try_for_each(|_| {
            now = craft.step(&now, &inputs, case.dt)?;
            Ok(())
        });
        all.runs.push((of_state(&now), end));
    }
    Some(all)
}

fn across_is_spacecraft(case: &Case) -> Verdict {
    let (Some(found), Ok(list)) = (across(case), case.list()) else { return Ok(Checked::Rejected) };
    let PreparedCase { craft, state, inputs } = &list;
    for (call, found) in found {
        let alone = match call {
            "accelerations across" | "accelerations one after another" => {
                craft.accelerations(state, inputs).map(|found| of_accelerations(&found))
            }
            "step across" | "step one after another" => {
                craft.step(state, inputs, case.dt).map(|next| of_state(&next))
            }
            _ => continue,
        };
        if text(&found) != text(&alone) {
            return Err(format!("{call}: {found:?}, not {alone:?}"));
        }
    }
    Ok(Checked::Holds)
}

/// `batch-is-spacecraft`: each state of a batch, each spacecraft of a batch of spacecraft, and a
/// spacecraft whose devices are side by side, has the result or error that it has by itself, to the
/// bit, whatever its neighbours are.
///
/// # Errors
/// Where it does not hold.
pub fn batch_is_spacecraft(case: &Case) -> Verdict {
    let mut checked = across_is_spacecraft(case)?;
    for (each, varied) in [(false, false), (true, false), (false, true), (true, true)] {
        let of_lanes = if varied { batched_variants } else { batched };
        let found = of_lanes(case, each);
        let (Some(found), Some(one_state)) = (found, single(case, each, varied)) else {
            continue;
        };
        checked = Checked::Holds;
        let what = if varied { "spacecraft" } else { "state" };
        let all = found.accelerations.iter().zip(&one_state.accelerations);
        for (index, (found, one_state)) in all.enumerate() {
            if text(found) != text(one_state) {
                return Err(format!(
                    "accelerations of {what} {index}: {found:?}, not {one_state:?}"
                ));
            }
        }
        for (index, ((found, end), (one_state, end_of_one))) in
            found.runs.iter().zip(&one_state.runs).enumerate()
        {
            let [f, a] = [found, one_state].map(|state| text::<f64>(&Ok(state.clone())));
            if f != a || format!("{end:?}") != format!("{end_of_one:?}") {
                return Err(format!(
                    "run of {what} {index}: {end:?} {found:?}, not {end_of_one:?} {one_state:?}"
                ));
            }
        }
    }
    Ok(checked)
}
