//! Plans of Monte Carlo campaigns: TOML with a table `[[vary]]` for each key and its distribution, and `[[correlation]]` for pairs
//! that are correlated. Units as in scenario files; every error at once.

use std::path::Path;

use super::budget::SCENARIO_KEYS;
use super::diagnostic::Diagnostics;
use super::keys::Keys;
use super::overrides::is_key;
use super::read_file::read_file;
use crate::units::{Dimension, Quantity, parse_quantity};
use crate::variation::{Correlation, Distribution, Variation};

/// The number of the format that this program reads.
const FORMAT: u32 = 1;

#[derive(Clone, Copy, PartialEq, Eq)]
enum DistributionName {
    Uniform,
    Normal,
    Lognormal,
    List,
    Phase,
}

const WORDS: [(&str, DistributionName); 5] = [
    ("uniform", DistributionName::Uniform),
    ("normal", DistributionName::Normal),
    ("lognormal", DistributionName::Lognormal),
    ("list", DistributionName::List),
    ("phase", DistributionName::Phase),
];

/// Reads a plan.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn variations_from_toml(path: &Path) -> Result<Vec<Variation>, Diagnostics> {
    read_file(path, "plan", ("", &[]), |keys| {
        if let Some(key) = SCENARIO_KEYS.into_iter().find(|key| keys.has(key)) {
            let help =
                "a plan states what varies: tables `[[vary]]` with a key and its distribution";
            keys.error(key, "this is a scenario, and no plan", help);
            return None;
        }
        if !keys.has("format") {
            keys.missing("format", "format = 1");
        }
        keys.count("format", FORMAT, FORMAT);
        if !keys.has("vary") {
            keys.missing("vary", "[[vary]]` with `key = \"hub.mass\"");
        }
        let mut all: Vec<_> = keys.tables("vary").iter().filter_map(variation).collect();
        for table in keys.tables("correlation") {
            correlation(&table, &mut all);
        }
        keys.finish();
        Some(all)
    })
}

fn variation(keys: &Keys<'_>) -> Option<Variation> {
    let key = keys.text("key");
    for (name, example) in
        [("key", "key = \"hub.mass\""), ("distribution", "distribution = \"normal\"")]
    {
        if !keys.has(name) {
            keys.missing(name, example);
        }
    }
    let word = keys.choice("distribution", &WORDS);
    let names: &[(&str, &str)] = match word? {
        DistributionName::Uniform => &[("from", "from = \"1 kg\""), ("to", "to = \"2 kg\"")],
        DistributionName::Normal => {
            &[("mean", "mean = \"1 kg\""), ("deviation", "deviation = \"0.1 kg\"")]
        }
        DistributionName::Lognormal => &[("median", "median = \"1 kg\""), ("sigma", "sigma = 0.2")],
        DistributionName::List => &[("values", "values = \"1, 2, 5 kg\"")],
        DistributionName::Phase => &[],
    };
    let mut found: Vec<Quantity> = Vec::new();
    for (name, example) in names {
        if !keys.has(name) {
            keys.missing(name, example);
        }
        found.extend(keys.any_quantity(name));
    }
    keys.finish();
    if found.len() != names.len() {
        return None;
    }
    let key = key?;
    if !is_key(key) {
        let message = format!("`{key}` is no key of a scenario");
        keys.error("key", message, "write for example `key = \"hub.mass\"`");
        return None;
    }
    let unit = found.first().map_or_else(|| "deg".to_owned(), |of| of.unit.clone());
    let distribution = match distribution(word?, &found, &unit) {
        Ok(distribution) => distribution,
        Err((at, message)) => {
            let place = names.get(at).map_or("key", |(name, _)| *name);
            keys.error(place, message, "see docs/campaigns.md");
            return None;
        }
    };
    Some(Variation { key: key.to_owned(), unit, distribution, correlations: Vec::new() })
}

/// `[[correlation]]`: `between` two keys, `coefficient`. It is stated at the second one.
fn correlation(keys: &Keys<'_>, all: &mut [Variation]) {
    let between = r#"between = ["hub.mass", "device.rw.wheel.rate"]"#;
    for (key, example) in [("between", between), ("coefficient", "coefficient = 0.5")] {
        if !keys.has(key) {
            keys.missing(key, example);
        }
    }
    let (names, coefficient) = (keys.texts("between"), keys.number("coefficient"));
    keys.finish();
    let (Some(names), Some(coefficient)) = (names, coefficient) else { return };
    let help = format!("write for example `{between}`");
    let [first, second] = names[..] else {
        keys.error("between", "a correlation is between two keys", &help);
        return;
    };
    let known: Vec<String> = all.iter().map(|of| of.key.clone()).collect();
    for name in [first, second] {
        if !known.iter().any(|key| key == name) {
            let message = format!("no `[[vary]]` has the key `{name}`");
            keys.error("between", message, &format!("the keys are {}", known.join(", ")));
            return;
        }
    }
    if let Some(of) = all.iter_mut().find(|of| of.key == second) {
        of.correlations.push(Correlation { key: first.to_owned(), coefficient });
    }
}

/// The distribution of quantities, in a unit; or which of them is wrong.
fn distribution(
    word: DistributionName,
    found: &[Quantity],
    unit: &str,
) -> Result<Distribution, (usize, &'static str)> {
    let one = format!("1 {unit}");
    let size = parse_quantity(&one).ok().and_then(|one| one.values.first().copied());
    let size = size.unwrap_or(1.0);
    let dimension = found.first().map_or_else(Dimension::default, |of| of.dimension);
    let single = |at: usize, of: Dimension| {
        let quantity = found.get(at).ok_or((at, "a number is missing"))?;
        match quantity.values[..] {
            [value] if quantity.dimension == of => Ok(value),
            [_] => Err((at, "this is of another dimension")),
            _ => Err((at, "this is one number with its unit")),
        }
    };
    match word {
        DistributionName::Uniform => {
            let (from, to) = (single(0, dimension)? / size, single(1, dimension)? / size);
            let rises = from < to;
            if rises {
                Ok(Distribution::Uniform([from, to]))
            } else {
                Err((1, "`to` is not above `from`"))
            }
        }
        DistributionName::Normal => {
            let (mean, deviation) = (single(0, dimension)? / size, single(1, dimension)? / size);
            let is = deviation > 0.0;
            if is {
                Ok(Distribution::Normal { mean, deviation })
            } else {
                Err((1, "a deviation is above zero"))
            }
        }
        DistributionName::Lognormal => {
            let (median, sigma) = (single(0, dimension)? / size, single(1, Dimension::default())?);
            match (median > 0.0, sigma > 0.0 && sigma <= 5.0) {
                (false, _) => Err((0, "a median is above zero")),
                (_, false) => Err((1, "sigma is above zero and at most five")),
                _ => Ok(Distribution::Lognormal { median, sigma }),
            }
        }
        DistributionName::List => {
            let values = found.first().map_or(&[][..], |of| &of.values);
            Ok(Distribution::List(values.iter().map(|value| value / size).collect()))
        }
        DistributionName::Phase => Ok(Distribution::Phase),
    }
}
