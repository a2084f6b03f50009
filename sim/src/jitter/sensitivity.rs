//! Sensitivities of a metric at one speed: by how many percent it changes for one percent of a parameter.
//!
//! With `s` the metric, one percent more of the amplitude of a tone changes `s` by its share of `s^2` in percent, exactly, where the
//! shares are those of the budget's phases ([`Sweep::shares`](super::sweep::Sweep::shares)). Frequencies and damping ratios of modes change the transmission; their
//! derivatives are central differences of the same model, whose error is the square of the step.

use super::budget::{Assessed, Budget, outputs_of};
use super::model::Model;
use super::sweep::sweep;
use super::weight::Weight;
use crate::structure::Fault;

/// Step of a central difference, of the parameter: its error is 1e-7 of a width of a mode of 0.5 % damping.
const STEP: f64 = 1e-6;

/// What a metric is sensitive to.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// The parameter, in words.
    pub parameter: String,
    /// `d ln s / d ln p`: percent by percent.
    pub ratio: f64,
}

/// Sensitivities of an assessed limit at its worst speed, the largest magnitude first.
///
/// # Errors
/// Those of a sweep.
pub fn sensitivities(
    model: &Model,
    budget: &Budget,
    of: &Assessed,
    speed: f64,
    names: &[String],
) -> Result<Vec<Sensitivity>, Fault> {
    let mut all: Vec<Sensitivity> = of
        .shares
        .iter()
        .filter_map(|(index, share)| {
            let parameter = format!("amplitude of {}", names.get(*index)?);
            Some(Sensitivity { parameter, ratio: *share })
        })
        .collect();
    if of.noise > 0.0 {
        let parameter = "amplitude of the broadband noise".to_owned();
        all.push(Sensitivity { parameter, ratio: of.noise });
    }
    let Ok(weight) = Weight::of_metric(&of.limit.metric) else { return Ok(all) };
    let outputs = outputs_of(of.sight);
    let metric = |model: &Model| -> Result<f64, Fault> {
        let found = sweep(model, &[speed], 1, &|_| {})?;
        Ok(found.mean_square(0, &outputs, budget.phases, &weight).sqrt())
    };
    let here = metric(model)?;
    for mode in 0..model.structure.modes.len() {
        for (which, word) in [(0, "frequency"), (1, "damping ratio")] {
            let at = |factor: f64| -> Result<f64, Fault> {
                let mut changed = model.clone();
                changed.scale_mode(mode, which, factor);
                metric(&changed)
            };
            let ratio = (at(1.0 + STEP)? - at(1.0 - STEP)?) / (2.0 * STEP * here);
            let parameter = format!("{word} of mode {}", mode + 1);
            if ratio.is_finite() && ratio != 0.0 {
                all.push(Sensitivity { parameter, ratio });
            }
        }
    }
    all.sort_by(|a, b| b.ratio.abs().total_cmp(&a.ratio.abs()));
    Ok(all)
}
