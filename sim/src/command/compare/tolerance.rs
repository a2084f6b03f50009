//! [`Tolerance`]: which differences of two results `compare` lets pass.

use super::difference::{Difference, Differences};
use crate::command::error::CommandError;
use crate::nearest::nearest;
use crate::units::{Dimension, parse_quantity};

/// A difference that is no larger passes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Tolerance {
    /// This share of the largest magnitude of the column, or of the vector of which it is a component.
    Relative(f64),
    /// This much, in SI units, in a column or the components of a vector.
    Absolute {
        /// The column or vector.
        name: String,
        value: f64,
        dimension: Dimension,
    },
}

impl Tolerance {
    /// From a number, or a name with a quantity: `1e-9`, `omega=1e-12 rad/s`.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let example = "write a share of the largest value: 1e-9, or a column and a quantity: omega='1e-12 rad/s'";
        let wrong = |what: &str| format!("`{text}`: {what}; {example}");
        let is_bound = |value: f64| value.is_finite() && value >= 0.0;
        let Some((name, quantity)) = text.split_once('=') else {
            let share = text.trim().parse().ok().filter(|share| is_bound(*share));
            return share.map(Self::Relative).ok_or_else(|| wrong("no number from zero up"));
        };
        let quantity = parse_quantity(quantity).map_err(|error| wrong(&error.kind.to_string()))?;
        match quantity.values[..] {
            [value] if is_bound(value) => {
                let (name, dimension) = (name.trim().to_owned(), quantity.dimension);
                Ok(Self::Absolute { name, value, dimension })
            }
            _ => Err(wrong("no number from zero up")),
        }
    }

    /// Marks the columns whose difference is larger than every tolerance of them.
    ///
    /// # Errors
    /// A name that no column has, or a unit that is not of its dimension.
    pub(super) fn mark(all: &[Self], found: &mut Differences) -> Result<(), CommandError> {
        for tolerance in all {
            tolerance.check(found)?;
        }
        let scales: Vec<f64> = found.columns.iter().map(|of| scale(of, &found.columns)).collect();
        for (column, scale) in found.columns.iter_mut().zip(scales) {
            let bounds = all.iter().filter_map(|of| match of {
                Self::Relative(share) => Some(share * scale),
                Self::Absolute { name, value, .. } => is_of(&column.name, name).then_some(*value),
            });
            // A difference that is no number is larger than every bound.
            column.differs = column.peak.is_nan() || column.peak > bounds.fold(0.0, f64::max);
        }
        Ok(())
    }

    fn check(&self, found: &Differences) -> Result<(), CommandError> {
        let Self::Absolute { name, dimension, .. } = self else { return Ok(()) };
        let mut columns = found.columns.iter().filter(|of| is_of(&of.name, name)).peekable();
        if columns.peek().is_none() {
            let known = found.columns.iter().map(|of| of.name.as_str());
            let near = nearest(name, known).join("`, `");
            let near = if near.is_empty() { near } else { format!("; nearest: `{near}`") };
            let message = format!("--tolerance: the results have no column `{name}`{near}");
            return Err(CommandError::Other(message));
        }
        let unit = columns.map(|of| of.unit.as_str()).find(|unit| {
            let pure = matches!(*unit, "" | "1");
            let of_unit = if pure { Some(Dimension::default()) } else { dimension_of(unit) };
            of_unit.is_some_and(|of_unit| of_unit != *dimension)
        });
        let wrong = |unit: &str| {
            let unit = if unit.is_empty() { "1" } else { unit };
            CommandError::Other(format!(
                "--tolerance: `{name}` is in {unit}, and the tolerance in {dimension}; write it in {unit}"
            ))
        };
        unit.map_or(Ok(()), |unit| Err(wrong(unit)))
    }
}

fn dimension_of(unit: &str) -> Option<Dimension> {
    parse_quantity(&format!("1 {unit}")).ok().map(|quantity| quantity.dimension)
}

/// The vector of which a column is a component; itself where it is none.
fn vector(column: &str) -> &str {
    ["_x", "_y", "_z"].iter().find_map(|axis| column.strip_suffix(axis)).unwrap_or(column)
}

/// Whether a column has a name, or is a component of a vector with it.
fn is_of(column: &str, name: &str) -> bool {
    column == name || vector(column) == name
}

/// The largest magnitude of a column, or of all components of its vector, in both results.
fn scale(column: &Difference, all: &[Difference]) -> f64 {
    let same = all.iter().filter(|of| vector(&of.name) == vector(&column.name));
    same.flat_map(|of| of.largest).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, unit: &str, peak: f64, largest: f64) -> Difference {
        let mut column = Difference::default();
        (column.name, column.unit) = (name.to_owned(), unit.to_owned());
        (column.peak, column.largest) = (peak, [largest; 2]);
        column
    }

    /// Whether each column differs.
    fn marked(tolerances: &[&str]) -> Result<Vec<bool>, CommandError> {
        let columns = vec![
            column("omega_x", "rad/s", 1e-10, 1.0),
            column("omega_y", "rad/s", 1e-10, 1e-10),
            column("energy", "J", 1e-3, 1.0),
            column("share", "1", f64::NAN, 1.0),
            column("mass", "kg", 0.0, 1.0),
        ];
        let mut found = Differences { columns, ..Differences::default() };
        let all: Result<Vec<_>, _> = tolerances.iter().map(|text| Tolerance::parse(text)).collect();
        Tolerance::mark(&all.expect("tolerances"), &mut found)?;
        Ok(found.columns.iter().map(|of| of.differs).collect())
    }

    #[test]
    fn a_share_is_of_the_whole_vector_and_a_quantity_of_its_column() {
        let of = |tolerances: &[&str]| marked(tolerances).expect("known columns");
        assert_eq!(of(&[]), [true, true, true, true, false]);
        assert_eq!(of(&["1e-9"]), [false, false, true, true, false]);
        assert_eq!(of(&["1e-9", "energy=1 mJ"]), [false, false, false, true, false]);
        assert_eq!(of(&["omega=1e-5 deg/s", "share=1"]), [false, false, true, true, false]);
    }

    #[test]
    fn an_unknown_column_and_a_wrong_unit_are_refused() {
        let error = |text: &str| marked(&[text]).expect_err(text).to_string();
        assert!(error("omga=1 rad/s").contains("nearest: `omega"), "{}", error("omga=1 rad/s"));
        assert!(error("omega=1 m").contains("in rad/s"), "{}", error("omega=1 m"));
        for text in ["-1", "nan", "inf", "omega=-1 rad/s", "1e-9 rad", "omega"] {
            assert!(Tolerance::parse(text).is_err(), "{text}");
        }
    }
}
