//! [`Axis`]: a key of the scenario and the values that it takes, from `KEY=600..6000 rpm:181`.

use super::{CampaignError, SAMPLES_MAX};
use crate::file::is_key;
use crate::spectra::float;
use crate::units::{Dimension, parse_quantity};
use crate::variation::label;

/// A key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The key, as in `--set`.
    pub key: String,
    /// The values, in their unit.
    pub values: Vec<f64>,
    /// The unit as written; empty of a pure number.
    pub unit: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// The unit in SI.
    pub size: f64,
    /// How the values are spaced.
    pub spacing: Spacing,
}

/// How the values of an axis are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Logarithmic,
    /// Listed.
    Listed,
}

impl Axis {
    /// The axis of a text: `KEY=FROM..TO UNIT:COUNT` with equal differences, `KEY=FROM..TO UNIT:log COUNT` with equal
    /// ratios, or `KEY=A,B,C UNIT`. Both ends are values.
    ///
    /// # Errors
    /// What is wrong with the text, or a count that is not within 2 and [`SAMPLES_MAX`].
    pub fn parse(text: &str) -> Result<Self, CampaignError> {
        let wrong = |reason| CampaignError::Axis { text: text.to_owned(), reason };
        let (key, values) = text.split_once('=').ok_or_else(|| wrong("an `=` is missing"))?;
        let key = key.trim();
        if !is_key(key) {
            return Err(wrong("the key is not that of a scenario file"));
        }
        let Some((from, rest)) = values.split_once("..") else {
            let (numbers, unit, dimension, size) = quantity(values)?;
            return Self::checked(key, numbers, unit, dimension, size, Spacing::Listed);
        };
        let (to, count) = rest.rsplit_once(':').ok_or_else(|| wrong("the count is missing"))?;
        let (numbers, unit, dimension, size) = quantity(&format!("{from}, {to}"))?;
        let [from, to] = numbers[..] else {
            return Err(wrong("a range is from one number to another"));
        };
        let (spacing, count) = match count.trim().strip_prefix("log") {
            Some(count) => (Spacing::Logarithmic, count),
            None => (Spacing::Linear, count),
        };
        let count: usize = count.trim().parse().map_err(|_| wrong("the count is no number"))?;
        if count < 2 {
            return Err(wrong("a range has two values at least"));
        }
        if count > SAMPLES_MAX {
            return Err(CampaignError::Samples { found: count, most: SAMPLES_MAX });
        }
        if from == to {
            return Err(wrong("the range is empty"));
        }
        if spacing == Spacing::Logarithmic && !(from > 0.0 && to > 0.0) {
            return Err(wrong("logarithmic values are above zero"));
        }
        let last = float(count - 1);
        let value = |index: usize| {
            let share = float(index) / last;
            match (index, spacing) {
                (0, _) => from,
                _ if index + 1 == count => to,
                (_, Spacing::Logarithmic) => from * libm::pow(to / from, share),
                _ => from + (to - from) * share,
            }
        };
        Self::checked(key, (0..count).map(value).collect(), unit, dimension, size, spacing)
    }

    fn checked(
        key: &str,
        values: Vec<f64>,
        unit: String,
        dimension: Dimension,
        size: f64,
        spacing: Spacing,
    ) -> Result<Self, CampaignError> {
        if values.iter().any(|value| !(value * size).is_finite()) {
            let reason = "a value is not finite".to_owned();
            return Err(CampaignError::Value { text: key.to_owned(), reason });
        }
        Ok(Self { key: key.to_owned(), values, unit, dimension, size, spacing })
    }

    /// What sets the key to a value: `key = "VALUE UNIT"`.
    #[must_use]
    pub fn set(&self, value: f64) -> String {
        set(&self.key, value, &self.unit)
    }

    /// Key and unit, for tables and pictures: `device.rw.wheel.rate [rpm]`.
    #[must_use]
    pub fn label(&self) -> String {
        label(&self.key, &self.unit)
    }
}

/// What sets a key to a value in a unit.
pub(super) fn set(key: &str, value: f64, unit: &str) -> String {
    let value = super::digits(value);
    if unit.is_empty() { format!("{key} = {value}") } else { format!("{key} = \"{value} {unit}\"") }
}

/// Numbers as written, their unit, its dimension and size.
fn quantity(text: &str) -> Result<(Vec<f64>, String, Dimension, f64), CampaignError> {
    let wrong = |reason: String| CampaignError::Value { text: text.trim().to_owned(), reason };
    let found = parse_quantity(text).map_err(|error| wrong(error.kind.to_string()))?;
    let numbers = text.trim().strip_suffix(found.unit.as_str()).unwrap_or(text);
    let numbers: Vec<f64> = numbers
        .split(',')
        .map(|number| number.trim().parse().map_err(|_| wrong(format!("`{number}` is no number"))))
        .collect::<Result<_, _>>()?;
    let one = format!("1 {}", found.unit);
    let one = parse_quantity(&one).map_err(|error| wrong(error.kind.to_string()))?;
    let size = one.values.first().copied().unwrap_or(f64::NAN);
    Ok((numbers, found.unit, found.dimension, size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_lists_are_read_in_their_unit() {
        let axis = Axis::parse("device.rw.wheel.rate=600..6000 rpm:4").expect("an axis");
        assert_eq!(axis.values, [600.0, 2400.0, 4200.0, 6000.0]);
        assert_eq!((axis.key.as_str(), axis.unit.as_str()), ("device.rw.wheel.rate", "rpm"));
        assert!((axis.size * 60.0 - std::f64::consts::TAU).abs() < 1e-14);
        assert_eq!(axis.set(600.0), "device.rw.wheel.rate = \"600 rpm\"");
        let axis = Axis::parse("k=1..1000 N/m:log 4").expect("an axis");
        // Rounding of the power.
        let near = |(a, b): (&f64, f64)| (a / b - 1.0).abs() < 1e-14;
        assert!(axis.values.iter().zip([1.0, 10.0, 100.0, 1000.0]).all(near), "{:?}", axis.values);
        let axis = Axis::parse("hub.mass = 1,2.5, 5e2 kg").expect("an axis");
        assert_eq!((axis.values, axis.spacing), (vec![1.0, 2.5, 500.0], Spacing::Listed));
        let axis = Axis::parse("seed=1,2,3").expect("an axis");
        assert_eq!(axis.set(3.0), "seed = 3");
    }

    #[test]
    fn what_is_no_axis_is_refused_with_the_remedy() {
        for (text, part) in [
            ("hub.mass", "an `=` is missing"),
            ("hub mass=1..2 kg:3", "not that of a scenario file"),
            ("a=1..2 kg", "the count is missing"),
            ("a=1..2 kg:x", "the count is no number"),
            ("a=1..2 kg:1", "two values at least"),
            ("a=1..2 kg:9999999", "9999999 samples are not within"),
            ("a=1..1 kg:3", "the range is empty"),
            ("a=0..1 kg:log 3", "above zero"),
            ("a=1..2 kgg:3", "no such unit"),
            ("a=", "a number is missing"),
            ("a=1,2..3 kg:3", "from one number to another"),
            ("a=1e308..1.7e308 km:3", "not finite"),
        ] {
            let error = Axis::parse(text).expect_err(text).to_string();
            assert!(error.contains(part), "{text}: {error}");
            assert!(error.contains("write"), "{text}: {error}");
        }
    }
}
