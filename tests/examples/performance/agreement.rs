//! Nothing is timed unless all results agree, block by block.

use std::path::Path;

use serde::Deserialize;

use crate::contender::Contender;
use crate::race::{Plan, file};

/// Largest difference of results, of a block: only the order of summation differs.
const AGREEMENT: f64 = 1e-11;

/// What a contender finds.
#[derive(Deserialize)]
struct Found {
    accelerations: Vec<f64>,
}

/// The worst deviation of each contender from the first one that is a peer, or, without peers, from
/// the first service: by name, in the order of the contenders.
pub(crate) fn check(
    contenders: &[Contender],
    plan: &Plan,
    folder: &Path,
) -> Result<Vec<(String, f64)>, String> {
    let checked: Vec<_> = contenders.iter().filter(|contender| contender.checked).collect();
    let peer = checked.iter().find(|contender| contender.service.is_none());
    let Some(reference) = peer.or(checked.first()) else { return Ok(Vec::new()) };
    let mut worst: Vec<_> =
        checked.iter().map(|contender| (contender.name.clone(), 0.0_f64)).collect();
    eprintln!("compared with {}", reference.name);
    for count in plan.checked() {
        let file = file(folder, count);
        let expected = reference.query::<Found>("check", &file)?.accelerations;
        for (contender, (_, worst)) in checked.iter().zip(&mut worst) {
            if !contender.takes(count) {
                continue;
            }
            let found = contender.query::<Found>("check", &file)?.accelerations;
            let deviation = deviation(&found, &expected, count)
                .ok_or_else(|| format!("{}: {} numbers", contender.name, found.len()))?;
            *worst = worst.max(deviation);
            if deviation > AGREEMENT {
                return Err(format!(
                    "{} and {} disagree on {}: by {deviation:.1e} of a block, bound {AGREEMENT:.0e}; \
                     nothing is timed",
                    contender.name,
                    reference.name,
                    file.display()
                ));
            }
        }
    }
    for (name, worst) in &worst {
        eprintln!("agrees to {worst:.1e}: {name}");
    }
    Ok(worst)
}

/// The largest difference in units of the largest magnitude of its block, over all blocks: the
/// hub's two vectors, and the accelerations of all joints of one name.
fn deviation(found: &[f64], expected: &[f64], count: usize) -> Option<f64> {
    if found.len() != expected.len() || expected.len() != 6 + 3 * count {
        return None;
    }
    let block = |number: usize| if number < 6 { number / 3 } else { 2 + number % 3 };
    let mut blocks = [[0.0_f64; 2]; 5];
    for (number, (found, expected)) in found.iter().zip(expected).enumerate() {
        if !found.is_finite() {
            return None;
        }
        let [difference, unit] = blocks.get_mut(block(number))?;
        *difference = difference.max((found - expected).abs());
        *unit = unit.max(expected.abs());
    }
    let shares = blocks.iter().filter(|[_, unit]| *unit > 0.0).map(|[d, unit]| d / unit);
    Some(shares.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::deviation;

    #[test]
    fn deviation_is_in_units_of_the_block() {
        let expected = [1.0, 2.0, 4.0, 10.0, 0.0, 0.0, 8.0, 1.0, 100.0];
        let mut found = expected;
        found[0] = 1.5;
        found[8] = 101.0;
        assert_eq!(deviation(&found, &expected, 1), Some(0.125));
        assert_eq!(deviation(&found, &expected, 2), None);
    }
}
