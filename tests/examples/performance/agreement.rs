//! Nothing is timed unless all results agree, block by block.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::contender::Contender;
use crate::plan::Plan;
use crate::subject::Subject;

/// Largest difference of results, of a block: only the order of summation differs.
const AGREEMENT: f64 = 1e-11;

/// What a contender finds: accelerations of hub and joints in a row, or what moved, or derivatives, by name.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum ContenderResult {
    Accelerations(Vec<f64>),
    Motion(BTreeMap<String, Vec<f64>>),
    Derivatives(BTreeMap<String, Vec<f64>>),
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
                results.push((contender, contender.query("check", folder, &case)?));
            }
            // Of one subject some find accelerations, others their derivatives.
            let form = |of: &ContenderResult| core::mem::discriminant(of);
            for (contender, found) in &results {
                let mut alike = results.iter().filter(|(_, of)| form(of) == form(found));
                let peer = alike.clone().find(|(who, _)| !who.is_ours());
                let Some((reference, expected)) = peer.or_else(|| alike.next()) else { continue };
                let found = deviation(found, expected);
                let found = found.ok_or_else(|| {
                    format!("{} and {} differ in form, {case}", contender.name, reference.name)
                })?;
                if found > AGREEMENT {
                    return Err(format!(
                        "{} and {} disagree on {case}: by {found:.1e} of a block, bound \
                         {AGREEMENT:.0e}; nothing is timed",
                        contender.name, reference.name
                    ));
                }
                match worst.iter_mut().find(|(name, _)| *name == contender.name) {
                    Some((_, largest)) => *largest = largest.max(found),
                    None => worst.push((contender.name.clone(), found)),
                }
            }
        }
    }
    for (name, worst) in &worst {
        eprintln!("agrees to {worst:.1e}: {name}");
    }
    Ok(worst)
}

/// The largest difference in units of the largest magnitude of its block, over all blocks.
fn deviation(found: &ContenderResult, expected: &ContenderResult) -> Option<f64> {
    let (found, expected) = (blocks(found), blocks(expected));
    if found.len() != expected.len() {
        return None;
    }
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(&expected) {
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

/// The numbers by block: of accelerations the hub's two vectors, and those of all joints of one name.
fn blocks(found: &ContenderResult) -> Vec<Vec<f64>> {
    match found {
        ContenderResult::Motion(blocks) | ContenderResult::Derivatives(blocks) => {
            blocks.values().cloned().collect()
        }
        ContenderResult::Accelerations(all) => {
            let mut blocks = vec![Vec::new(); 5];
            for (number, value) in all.iter().enumerate() {
                let block = if number < 6 { number / 3 } else { 2 + number % 3 };
                blocks[block].push(*value);
            }
            blocks
        }
    }
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
        let of = |numbers: &[f64]| ContenderResult::Accelerations(numbers.to_vec());
        assert_eq!(deviation(&of(&found), &of(&expected)), Some(0.125));
        assert_eq!(deviation(&of(&found), &of(&expected[..8])), None);
    }
}
