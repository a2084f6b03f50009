//! Exact derivatives of the numbers of a row by the keys of a plan: those of each step of the run, or the run itself over
//! dual numbers.
//!
//! ```text
//! key -> parameters p -> state x(t; p) -> samples -> number F        dF/dkey = F'[x] (dx/dp) (dp/dkey)
//! ```
//!
//! | step | how | error |
//! |---|---|---|
//! | `dp/dkey` | the reader of files has no dual numbers: differences of its closed formulas, seven points (`parameters`) | 1e-11 of the parameter's own size over a standard deviation |
//! | `dx/dp` | by up to twelve keys, in a central field, with lumped imbalance, and of keys that change gravity or move a fixed hub, equations and integrator over [`Dual`](precess_dynamics::Dual) numbers, six keys in a run (`dual`); of more keys the exact derivatives of each step by the chain rule, all in one run (`chain`) | rounding: the derivative of the discrete run |
//! | `F'[x]` | of RMS values, also in bands and exposures, by polarisation of the quadratic form; of peaks at the sample that is largest (`statistic`) | rounding |
//!
//! So no step has to be chosen against the tolerance of a run. What this does not have, and says so: flexible structures,
//! platforms, sources and wrenches, drives that vary over time, changes, end stops, crossings, prescribed hubs, and
//! quantities that are neither of the state nor its accelerations (attitude, loads, energy). Central differences remain for them.
//!
//! A scenario with DOP853 is run by RK4 here, in steps of a hundredth of the fastest rotation; a number that this run and the
//! scenario's own give differently is not differentiated.

mod chain;
mod dual;
mod parameters;
mod run;
mod statistic;
#[cfg(test)]
mod tests;

use std::ops::ControlFlow;

use super::axis::set;
use super::{Reducer, Selection};
use crate::variation::Variation;

use crate::engine::run as engine_run;
use crate::file::{Override, Template};
use crate::record::{Columns, Header, Outcome};
use crate::scenario::Scenario;

/// Steps between the seven points of a key, of a standard deviation.
const STEP: f64 = 0.05;
/// A number of the run with derivatives differs by this share of that of the scenario's own, at most.
const AGREEMENT: f64 = 1e-3;

/// Derivatives of the requirements, then of RMS and peak of each column, by the keys that have a derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangents {
    /// Of each number, by each key, SI by the key's unit; none of a number that is not differentiated.
    pub slopes: Vec<Option<Vec<f64>>>,
    /// Largest share by which a number of this run differs from that of the scenario's own.
    pub difference: f64,
}

/// Exact derivatives about the middle of each distribution, as
/// [`central_differences`](super::central_differences) are.
///
/// # Errors
/// Why the scenario is not differentiated, in a sentence.
pub fn tangents(
    template: &Template,
    overrides: &[Override],
    variations: &[Variation],
    selection: &Selection,
) -> Result<Tangents, String> {
    let scaled: Vec<(&Variation, [f64; 2])> =
        variations.iter().filter_map(|of| Some((of, of.distribution.scale()?))).collect();
    let read = |changed: Option<(usize, f64)>| -> Result<Scenario, String> {
        let own = scaled.iter().enumerate().map(|(index, (of, [middle, _]))| {
            let value = changed.filter(|(at, _)| *at == index).map_or(*middle, |(_, value)| value);
            set(&of.key, value, &of.unit)
        });
        let all: Vec<Override> = overrides.iter().cloned().chain(own).collect();
        let (mut scenario, _) = template.scenario(&all).map_err(|errors| {
            errors.all.first().map_or_else(|| "it is not read".to_owned(), |of| of.message.clone())
        })?;
        scenario.output.columns.clone_from(&selection.columns);
        Ok(scenario)
    };
    let middle = read(None)?;
    parameters::supported(&middle)?;
    let columns = Columns::from_scenario(&middle).map_err(|error| error.to_string())?;
    let header = Header::new(&middle, &columns);
    let (outcome, own) = reduced(&middle, selection)?;
    let kinds = statistic::kinds(&middle, selection, &header)?;
    let mut found = Tangents { slopes: vec![Some(Vec::new()); kinds.len()], difference: 0.0 };
    let mut slopes = Vec::new();
    for (index, (_, [middle, deviation])) in scaled.iter().enumerate() {
        let at = |steps: i32| {
            let value = middle + f64::from(steps) * STEP * deviation;
            read(Some((index, value)))
        };
        slopes.push(parameters::slopes(&at, STEP * deviation)?);
    }
    run::samples(&middle, &header, &slopes, &mut |samples, keys| {
        for ((kind, slopes), own) in kinds.iter().zip(&mut found.slopes).zip(&own) {
            let Some(list) = slopes.as_mut() else { continue };
            let derived = kind.derivatives(samples, &header, &outcome, keys);
            match derived {
                Some((value, by)) if (value - own).abs() <= AGREEMENT * own.abs() => {
                    found.difference = found.difference.max((value / own - 1.0).abs());
                    list.extend(by);
                }
                _ => *slopes = None,
            }
        }
        Ok(())
    })?;
    Ok(found)
}

/// The scenario's own run: its outcome, and the numbers that are differentiated.
fn reduced(scenario: &Scenario, selection: &Selection) -> Result<(Outcome, Vec<f64>), String> {
    let mut reducer = Reducer::new(scenario, selection);
    let outcome = engine_run(scenario, &mut reducer, &mut |_| ControlFlow::Continue(()));
    let outcome = outcome.map_err(|error| error.to_string())?;
    let row = reducer.row().ok_or("its run has no numbers")?;
    let count = scenario.requirements.len();
    let of_columns = (0..selection.columns.len()).flat_map(|column| {
        let rms = selection.rms_of(column, count);
        [rms, rms + 1]
    });
    let number = |place: usize| row.get(place).copied().unwrap_or(f64::NAN);
    Ok((outcome, (0..count).chain(of_columns).map(number).collect()))
}
