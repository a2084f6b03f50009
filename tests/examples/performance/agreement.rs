//! Nothing is timed unless all results agree, block by block.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::contender::Contender;
use crate::plan::Plan;
use crate::subject::Subject;

/// Largest difference of results, of a block: only the order of summation differs.
const AGREEMENT: f64 = 1e-11;

/// What a contender finds: accelerations of hub and joints in a row, what moved, derivatives by name.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct ContenderResult {
    accelerations: Option<Vec<f64>>,
    motion: Option<BTreeMap<String, Vec<f64>>>,
    derivatives: Option<BTreeMap<String, Vec<f64>>>,
}

impl ContenderResult {
    /// The numbers of each form, by block: of accelerations the hub's two vectors, and those of all joints of one name.
    fn forms(&self) -> [Option<Vec<Vec<f64>>>; 3] {
        let named = |of: &BTreeMap<String, Vec<f64>>| of.values().cloned().collect();
        let accelerations = self.accelerations.as_ref().map(|all| {
            let mut blocks = vec![Vec::new(); 5];
            for (number, value) in all.iter().enumerate() {
                let block = if number < 6 { number / 3 } else { 2 + number % 3 };
                blocks[block].push(*value);
            }
            blocks
        });
        [accelerations, self.motion.as_ref().map(named), self.derivatives.as_ref().map(named)]
    }
}

/// Subjects whose results are compared with each other.
pub(crate) const GROUPS: [Subject; 4] =
    [Subject::Evaluation, Subject::Step, Subject::BatchStep, Subject::Baked];

/// The worst deviation of each contender from the first one that is a peer, or, without peers, from
/// the first service: by name.
pub(crate) fn check(
    contenders: &[Contender],
    groups: &[Subject],
    plan: &Plan,
    folder: &Path,
) -> Result<Vec<(String, f64)>, String> {
    let mut worst: Vec<(String, f64)> = Vec::new();
    for &group in groups {
        for case in plan.cases(group) {
            let takes = |who: &&Contender| who.subject.compares_with(group) && who.takes(&case);
            let all: Vec<_> = contenders.iter().filter(takes).collect();
            let mut results = Vec::new();
            for contender in &all {
                let found: ContenderResult = contender.query("check", folder, &case)?;
                results.push((*contender, found.forms()));
            }
            for (name, found) in compared(&results, &case)? {
                match worst.iter_mut().find(|(other, _)| *other == name) {
                    Some((_, largest)) => *largest = largest.max(found),
                    None => worst.push((name, found)),
                }
            }
        }
    }
    for (name, worst) in &worst {
        eprintln!("agrees to {worst:.1e}: {name}");
    }
    Ok(worst)
}

/// A contender with what it finds, by forms.
type Results<'a> = [(&'a Contender, [Option<Vec<Vec<f64>>>; 3])];

/// The deviation of each contender in each form that it finds: of one subject some find accelerations, others also
/// their derivatives.
fn compared(results: &Results<'_>, case: &str) -> Result<Vec<(String, f64)>, String> {
    let mut deviations = Vec::new();
    for (contender, forms) in results {
        if forms.iter().all(Option::is_none) {
            return Err(format!("{} finds nothing of {case}", contender.name));
        }
        for (form, found) in forms.iter().enumerate() {
            let Some(found) = found else { continue };
            let mut alike =
                results.iter().filter_map(|(who, forms)| Some((who, forms[form].as_ref()?)));
            let peer = alike.clone().find(|(who, _)| !who.is_ours());
            let Some((reference, expected)) = peer.or_else(|| alike.next()) else { continue };
            let found = deviation(found, expected).ok_or_else(|| {
                format!("{} and {} differ in form, {case}", contender.name, reference.name)
            })?;
            if found > AGREEMENT {
                return Err(format!(
                    "{} and {} disagree on {case}: by {found:.1e} of a block, bound {AGREEMENT:.0e}; nothing is timed",
                    contender.name, reference.name
                ));
            }
            deviations.push((contender.name.clone(), found));
        }
    }
    Ok(deviations)
}

/// The largest difference in units of the largest magnitude of its block, over all blocks.
fn deviation(found: &[Vec<f64>], expected: &[Vec<f64>]) -> Option<f64> {
    if found.len() != expected.len() {
        return None;
    }
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        // A service may compare fewer states of a batch.
        let length = found.len().min(expected.len());
        let whole = length > 0 && found.len() % length == 0 && expected.len() % length == 0;
        if !whole || !found.iter().all(|number| number.is_finite()) {
            return None;
        }
        let unit = expected.iter().fold(0.0_f64, |unit, number| unit.max(number.abs()));
        for (found, expected) in found.iter().zip(expected) {
            let difference = (found - expected).abs();
            if difference > 0.0 {
                worst = worst.max(difference / unit);
            }
        }
    }
    Some(worst)
}

#[cfg(test)]
mod tests {
    use super::{ContenderResult, deviation};

    #[test]
    fn deviation_is_in_units_of_the_block() {
        let expected = vec![1.0, 2.0, 4.0, 10.0, 0.0, 0.0, 8.0, 1.0, 100.0];
        let mut found = expected.clone();
        found[0] = 1.5;
        found[8] = 101.0;
        let of = |numbers: &[f64]| {
            let found =
                ContenderResult { accelerations: Some(numbers.to_vec()), ..Default::default() };
            let [accelerations, ..] = found.forms();
            accelerations.unwrap()
        };
        assert_eq!(deviation(&of(&found), &of(&expected)), Some(0.125));
        assert_eq!(deviation(&of(&found), &of(&expected[..8])), None);
    }
}
