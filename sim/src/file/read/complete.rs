//! Completes the initial state by what is known of the whole spacecraft only: a state of the centre of mass, and the
//! vibration of a settled start.

use super::check::place_of_joint;
use super::devices::initial::whole;
use crate::file::document::Node;
use crate::file::keys::{Keys, Reports};
use crate::jitter::settled::settle;
use crate::scenario::{Scenario, joint_key};
use crate::units::{Plain, parse_quantity, parse_unit};

/// The digits of a message after the first, as a part of a number.
const ROUNDING: f64 = 1e-9;

/// What is done with the initial state once the whole spacecraft is known.
pub(super) type Completion = fn(&Node, &mut Scenario, &Reports);

/// Completes the initial state; reports where that cannot be.
pub(super) fn complete(node: &Node, scenario: &mut Scenario, reports: &Reports) {
    let Some(keys) = Keys::new(node, "", reports) else { return };
    let whole = whole(&keys);
    let Some(initial) = keys.table("initial") else { return };
    if whole.of_centre
        && let Err(error) = scenario.start_from_centre_of_mass()
    {
        initial.error("state_of", error.to_string(), "give the state of B");
    }
    if !whole.settled {
        return;
    }
    match settle(scenario) {
        Ok(found) => {
            found.left_out.iter().for_each(|reason| initial.warn("settled", reason, ""));
            check_excursions(node, scenario, &found.amplitudes, reports);
        }
        Err(fault) => {
            let message = format!("the vibration of the rotors cannot be computed: {fault}");
            initial.error("settled", message, "remove `settled`, or give the state itself");
        }
    }
}

/// Reports joints whose vibration about the state of the file passes an end stop or the largest rate of the motor: a run
/// would end, or the motor would brake, within a turn of the rotor.
fn check_excursions(node: &Node, scenario: &Scenario, amplitudes: &[[f64; 2]], reports: &Reports) {
    let joints = scenario.joints().zip(scenario.mean_joints()).zip(amplitudes).enumerate();
    for (joint, (((_, name, info), [coordinate, rate]), [moved, swung])) in joints {
        let [unit, rate_unit, ..] = info.units();
        let name = format!("{name}.{}", joint_key(info));
        let beyond = |key: &str, reached: f64, bound: f64, unit: &str, remedy: &str| {
            let span = place_of_joint(node, scenario, joint, key);
            let mut reports = reports.borrow_mut();
            let written = span.as_ref().and_then(|span| {
                let text = reports.sources.get(span.source)?.text.get(span.range.clone())?;
                let unit = parse_quantity(text.trim_matches(['"', '\''])).ok()?.unit;
                let (size, _) = parse_unit(&unit).ok()?;
                Some((unit, size))
            });
            let (unit, size) = written.unwrap_or_else(|| (unit.to_owned(), 1.0));
            // Further out by rounding: a limit that is moved to what is shown is not passed.
            let reached = reached + (reached - bound).signum() * ROUNDING * reached.abs();
            let [reached, bound] = [reached, bound].map(|value| Plain(rounded(value / size)));
            let message = format!(
                "of a settled run {name} vibrates, up to {reached} {unit}: beyond its `{key}`, {bound} {unit}"
            );
            let help = format!("{remedy}, or remove `initial.settled`");
            match span {
                Some(span) => reports.error(&span, message, "", &help),
                None => reports.error_anywhere(message, &help),
            }
        };
        let limit = scenario.drives.get(joint).and_then(|drive| drive.limits().rate);
        if let Some(limit) = limit.filter(|limit| *swung > 0.0 && rate.abs() + swung > *limit) {
            let key = if info.slides { "speed_limit" } else { "rate_limit" };
            let reached = rate.abs() + swung;
            beyond(key, reached, limit, rate_unit, "raise the limit to that, start slower");
        }
        for stop in scenario.stops.iter().filter(|stop| stop.joint == joint && *moved > 0.0) {
            let remedy = "lock the joint, move the stop by the vibration";
            if coordinate - moved < stop.lower {
                beyond("lower_stop", coordinate - moved, stop.lower, unit, remedy);
            }
            if coordinate + moved > stop.upper {
                beyond("upper_stop", coordinate + moved, stop.upper, unit, remedy);
            }
        }
    }
}

/// A number with ten digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
