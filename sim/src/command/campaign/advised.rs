//! What the samples of a campaign would be warned of as runs of their own: too few samples or steps a turn, a hub that
//! drifts.
//!
//! The scenario of the file is one of many, so its own warnings say little: its wheels may be slow where those of a
//! sample alias.

use super::Prepared;
use crate::campaign::Plan;
use crate::command::advice::{Advice, initial, of_rates};
use crate::file::Diagnostic;

/// Samples that are looked at, beside the last: reading one takes as long as some steps of its run.
const LOOKED_AT_MAX: usize = 1000;

/// A warning of some samples.
struct Advised {
    advice: Advice,
    /// The first sample that it is of.
    first: usize,
    samples: usize,
}

/// A sentence for each kind of warning: how many samples it is of, and what it says of the first of them. Whether the
/// hub drifts is computed for the first and the last sample only.
pub(super) fn advised(prepared: &Prepared, plan: &Plan) -> Vec<String> {
    let count = plan.samples.len();
    let stride = stride(count);
    let mut found: Vec<Advised> = Vec::new();
    let mut looked_at = 0;
    for (index, sample) in plan.samples.iter().enumerate() {
        let is_end = index == 0 || index + 1 == count;
        if index % stride != 0 && !is_end {
            continue;
        }
        let overrides = [&prepared.overrides[..], &sample.overrides].concat();
        let Ok((scenario, _)) = prepared.template.scenario(&overrides) else { continue };
        looked_at += 1;
        for advice in if is_end { initial(&scenario) } else { of_rates(&scenario) } {
            match found.iter_mut().find(|of| of.advice.is_like(&advice)) {
                Some(known) => known.samples += 1,
                None => found.push(Advised { advice, first: index, samples: 1 }),
            }
        }
    }
    found.iter().map(|of| of.sentence(plan, looked_at)).collect()
}

/// Every how many samples one is looked at: a number without a factor of theirs, so that of two keys each value is met.
fn stride(count: usize) -> usize {
    let least = count.div_ceil(LOOKED_AT_MAX).max(1);
    (least..=count.max(least)).find(|stride| has_no_common_factor(*stride, count)).unwrap_or(least)
}

/// By Euclid's algorithm.
fn has_no_common_factor(a: usize, b: usize) -> bool {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a <= 1
}

impl Advised {
    fn sentence(&self, plan: &Plan, looked_at: usize) -> String {
        let Self { advice, first, samples } = self;
        let at = plan.shown(*first);
        let Diagnostic { message, help, .. } = advice.into();
        let of_how_many = match (advice.is_of_rates(), looked_at == plan.samples.len()) {
            (false, _) => String::new(),
            (true, true) => format!("{samples} of {looked_at} samples: "),
            (true, false) => format!("{samples} of {looked_at} samples that were looked at: "),
        };
        format!("{of_how_many}sample {first}, {at}: {message}; {help}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_that_are_looked_at_have_every_value_of_each_of_two_keys() {
        for (first, second) in [(50, 40), (1, 13), (100, 100), (37, 1000)] {
            let count = first * second;
            let stride = stride(count);
            assert!(count.div_ceil(stride) <= LOOKED_AT_MAX);
            let met: std::collections::BTreeSet<usize> =
                (0..count).step_by(stride).map(|index| index % second).collect();
            assert_eq!(met.len(), second.min(count.div_ceil(stride)), "{first} by {second}");
        }
    }
}
