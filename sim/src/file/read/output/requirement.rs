//! Limits on what is recorded, and on margins of loops: `[[requirement]]`.

use super::margin_requirement::margin_requirement;
use crate::file::keys::Keys;
use crate::file::read::values::mount::direction;
use crate::pointing::Index;
use crate::scenario::{
    MarginRequirement, Projection, Requirement, SampledController, Settings, Statistic,
};
use crate::units::{Dimension, Measure, Plain, UnitError, parse_unit};

/// The level of an index of ECSS without `level`: that of three standard deviations of Gaussian errors.
const LEVEL: f64 = 0.9973;

/// Words of `statistic`, and the keys that each of them needs.
const STATISTICS: [(&str, StatisticName); 12] = [
    ("peak", StatisticName::Peak),
    ("rms", StatisticName::Rms),
    ("band_rms", StatisticName::BandRms),
    ("final", StatisticName::Final),
    ("drift", StatisticName::Drift),
    ("displacement", StatisticName::Displacement),
    ("smear", StatisticName::Smear),
    ("jitter", StatisticName::Jitter),
    ("ape", StatisticName::Ape),
    ("mpe", StatisticName::Mpe),
    ("rpe", StatisticName::Rpe),
    ("pde", StatisticName::Pde),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StatisticName {
    Peak,
    Rms,
    BandRms,
    Final,
    Drift,
    Displacement,
    Smear,
    Jitter,
    Ape,
    Mpe,
    Rpe,
    Pde,
}

/// Keys that only some statistics have, with an example.
const OWN: [(&str, &str); 5] = [
    ("band", "band = \"1, 100 Hz\""),
    ("exposure", "exposure = \"10 ms\""),
    ("window", "window = \"0.1 s\""),
    ("stability", "stability = \"1 s\""),
    ("level", "level = 0.9973"),
];

impl StatisticName {
    /// Whether it has one of the keys in [`OWN`].
    fn has(self, key: &str) -> bool {
        match key {
            "band" => self == Self::BandRms,
            "exposure" => matches!(self, Self::Displacement | Self::Smear | Self::Jitter),
            "window" => matches!(self, Self::Mpe | Self::Rpe | Self::Pde),
            "stability" => self == Self::Pde,
            _ => matches!(self, Self::Ape | Self::Mpe | Self::Rpe | Self::Pde),
        }
    }
}

/// Those on what is recorded, and those on margins of loops, which have the key `margin`.
pub(in crate::file::read) fn requirements(
    keys: &Keys<'_>,
    settings: Option<&Settings>,
    controllers: &[SampledController],
) -> (Vec<Requirement>, Vec<MarginRequirement>) {
    let duration = settings.map_or(f64::INFINITY, |settings| settings.duration);
    let (margins, recorded): (Vec<_>, Vec<_>) =
        keys.tables("requirement").into_iter().partition(|keys| keys.has("margin"));
    let recorded = recorded.iter().filter_map(|keys| requirement(keys, duration)).collect();
    let margins = margins.iter().filter_map(|keys| margin_requirement(keys, controllers)).collect();
    (recorded, margins)
}

fn requirement(keys: &Keys<'_>, duration: f64) -> Option<Requirement> {
    let name = keys.text("name");
    let quantity = keys.text("quantity");
    for (key, example) in [("name", "name = \"pointing\""), ("quantity", "quantity = \"omega\"")] {
        if !keys.has(key) {
            keys.missing(key, example);
        }
    }
    let projection = projection(keys);
    let statistic = statistic(keys);
    let from = keys.quantity("from", Measure::TIME).unwrap_or(0.0);
    let to = keys.quantity("to", Measure::TIME).unwrap_or(duration);
    if keys.has("from") && !keys.has("to") && from >= duration {
        let message = format!(
            "a window from {} s on is empty in a run of {} s",
            Plain(from),
            Plain(duration)
        );
        keys.error("from", message, "begin earlier, or raise `run.duration`");
    }
    if !keys.has("limit") {
        keys.missing("limit", "limit = \"0.1 deg/s\"");
    }
    let limit = keys.any_quantity("limit");
    keys.finish();
    let (statistic, limit) = (statistic?, limit?);
    let (&[value], Ok((size, _))) = (limit.values.as_slice(), unit_of(&limit.unit)) else {
        keys.error("limit", "a limit is one number with its unit", "");
        return None;
    };
    Some(Requirement {
        name: name?.to_owned(),
        quantity: quantity?.to_owned(),
        projection,
        statistic,
        window: [from, to],
        limit: value,
        written: keys.text_or_list("limit").map_or_else(|| format!("{value:?}"), str::to_owned),
        unit: (limit.unit, size),
    })
}

/// `along` or `across`: the components of the vector that count.
fn projection(keys: &Keys<'_>) -> Projection {
    let [along, across] = ["along", "across"].map(|key| (keys.has(key), direction(keys, key)));
    if along.0 && across.0 {
        let message = "`along` and `across` are given, and only one direction counts";
        keys.error("across", message, "remove one, or state a requirement for each");
    }
    match (along.1, across.1) {
        (Some(direction), _) => Projection::Along(direction),
        (None, Some(direction)) => Projection::Across(direction),
        (None, None) => Projection::None,
    }
}

/// The statistic with its own keys. All keys are read, so that an error about an unknown one lists them.
fn statistic(keys: &Keys<'_>) -> Option<Statistic> {
    if !keys.has("statistic") {
        keys.missing("statistic", "statistic = \"peak\"");
    }
    let word = keys.choice("statistic", &STATISTICS);
    let band = keys.quantities::<2>("band", Measure::FREQUENCY);
    let [exposure, window, stability] =
        ["exposure", "window", "stability"].map(|key| keys.quantity(key, Measure::TIME));
    let level = if keys.has("level") { keys.number("level") } else { Some(LEVEL) };
    let word = word?;
    for (key, example) in OWN {
        match (word.has(key), keys.has(key)) {
            (true, false) if key != "level" => keys.missing(key, example),
            (false, true) => {
                let with = STATISTICS.iter().filter(|(_, word)| word.has(key));
                let with: Vec<_> = with.map(|(word, _)| format!("`{word}`")).collect();
                let message = format!("only {} has `{key}`", with.join(", "));
                keys.error(key, message, "remove it");
            }
            _ => {}
        }
    }
    let index = |index: Index| Some(Statistic::Index { index, level: level? });
    match word {
        StatisticName::Peak => Some(Statistic::Peak),
        StatisticName::Rms => Some(Statistic::Rms),
        StatisticName::BandRms => rising(keys, band?).map(Statistic::BandRms),
        StatisticName::Final => Some(Statistic::Final),
        StatisticName::Drift => Some(Statistic::Drift),
        StatisticName::Displacement => Some(Statistic::Displacement(exposure?)),
        StatisticName::Smear => Some(Statistic::Smear(exposure?)),
        StatisticName::Jitter => Some(Statistic::Jitter(exposure?)),
        StatisticName::Ape => index(Index::Ape),
        StatisticName::Mpe => index(Index::Mpe { window: window? }),
        StatisticName::Rpe => index(Index::Rpe { window: window? }),
        StatisticName::Pde => index(Index::Pde { window: window?, stability: stability? }),
    }
}

/// A band whose frequencies rise.
fn rising(keys: &Keys<'_>, band: [f64; 2]) -> Option<[f64; 2]> {
    let [from, to] = band;
    if 0.0 <= from && from < to {
        return Some(band);
    }
    let message = format!(
        "a band rises from zero or above, and this one is from {} Hz to {} Hz",
        Plain(from),
        Plain(to)
    );
    keys.error("band", message, "write the lower frequency first: `band = \"1, 200 Hz\"`");
    None
}

fn unit_of(unit: &str) -> Result<(f64, Dimension), UnitError> {
    if unit.is_empty() { Ok((1.0, Dimension::default())) } else { parse_unit(unit) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::from_toml;

    const SCENARIO: &str = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
        [run]\nduration = \"2 s\"\n[output]\nrate = \"1 kHz\"\n\
        [[requirement]]\nname = \"a\"\nquantity = \"omega\"\nlimit = \"1 rad/s\"\n";

    /// What a scenario with these keys in its requirement is read as.
    fn read(keys: &str) -> Result<Statistic, String> {
        let (scenario, _) = from_toml("test", &format!("{SCENARIO}{keys}\n"), "".as_ref())
            .map_err(|errors| errors.to_string())?;
        Ok(scenario.requirements.first().expect("a requirement").statistic)
    }

    #[test]
    fn exposures_and_indices_are_read_with_their_keys() {
        let jitter = "statistic = \"jitter\"\nexposure = \"5 ms\"";
        assert_eq!(read(jitter), Ok(Statistic::Jitter(5e-3)));
        let ape = Statistic::Index { index: Index::Ape, level: LEVEL };
        assert_eq!(read("statistic = \"ape\""), Ok(ape));
        let index = Index::Pde { window: 0.1, stability: 0.5 };
        let pde = "statistic = \"pde\"\nwindow = \"0.1 s\"\nstability = \"0.5 s\"\nlevel = 0.95";
        assert_eq!(read(pde), Ok(Statistic::Index { index, level: 0.95 }));
    }

    #[test]
    fn keys_that_are_missing_or_of_another_statistic_are_errors_with_a_remedy() {
        for (keys, part) in [
            ("statistic = \"smear\"", "add `exposure = \"10 ms\"`"),
            ("statistic = \"rpe\"", "add `window = \"0.1 s\"`"),
            ("statistic = \"pde\"\nwindow = \"0.1 s\"", "add `stability = \"1 s\"`"),
            ("statistic = \"rms\"\nlevel = 0.9", "only `ape`, `mpe`, `rpe`, `pde` has `level`"),
            ("statistic = \"peak\"\nband = \"1, 2 Hz\"", "only `band_rms` has `band`"),
            ("statistic = \"band_rms\"\nband = \"200, 1 Hz\"", "this one is from 200 Hz to 1 Hz"),
            (
                "statistic = \"rms\"\nfrom = \"3 s\"",
                "a window from 3 s on is empty in a run of 2 s",
            ),
            ("statistic = \"ape\"\nlevel = 1", "a level of 1 is not between 0 and 1"),
            ("statistic = \"jitter\"\nexposure = \"1.5 ms\"", "is 1.5000 samples at 1000 1/s"),
            (
                "statistic = \"pde\"\nwindow = \"0.2 s\"\nstability = \"0.5 s\"",
                "is not a whole multiple of the window",
            ),
        ] {
            let shown = read(keys).expect_err("an error");
            assert!(shown.contains(part), "{keys}: {shown}");
        }
    }
}
