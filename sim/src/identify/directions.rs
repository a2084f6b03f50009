//! [`Direction`]: what the data do not tell: directions of the unknowns along which the readings do not change, or less than noise hides.
//!
//! Of the information `J' R^-1 J` of the data, each number in units of its scale (its prior's standard deviation, where it has one), the
//! eigenvectors with an eigenvalue below one are not told: along them the data are worth less than knowing the scale.

use std::fmt;

use nalgebra::DMatrix;

use super::component::Component;
use super::solve::{TOLD, scaled};
use crate::units::Plain;

/// Shares below this of the largest are left out where a direction is printed.
const SHOWN: f64 = 0.1;

/// A direction that the data do not tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// Names, and what each changes by along it, SI, as it is for a step of one scale; the largest share first.
    pub changes: Vec<(String, f64, &'static str)>,
    /// Standard deviation along it by the data, in units of the scale; infinite where they do not depend on it.
    pub deviation: f64,
    /// Whether everything in it has a prior, which then tells it.
    pub has_prior: bool,
    /// The eigenvector, in units of the scales.
    pub(super) vector: Vec<f64>,
}

impl Direction {
    /// The direction of numbers of unit scale, in SI.
    pub(super) fn in_units_of(mut self, components: &[Component]) -> Self {
        for (name, change, _) in &mut self.changes {
            if let Some(of) = components.iter().find(|of| of.name == *name) {
                *change *= of.scale;
            }
        }
        self
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (name, change, unit)) in self.changes.iter().enumerate() {
            let sign = match (place, *change < 0.0) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            write!(f, "{sign}{} {unit} of {name}", Plain(rounded(change.abs())))?;
        }
        Ok(())
    }
}

/// The directions that the information of the data, without priors, does not tell: those with the largest deviation first.
pub(super) fn untold(information: &DMatrix<f64>, components: &[Component]) -> Vec<Direction> {
    let (scaled, _) = scaled(information, components);
    let eigen = scaled.symmetric_eigen();
    let mut all: Vec<(f64, usize)> =
        eigen.eigenvalues.iter().copied().zip(0..).filter(|(value, _)| *value < TOLD).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let of = |(value, column): (f64, usize)| {
        let vector: Vec<f64> = eigen.eigenvectors.column(column).iter().copied().collect();
        let largest = vector.iter().fold(0.0, |most: f64, of| most.max(of.abs()));
        let mut shown: Vec<(usize, f64)> = vector
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, share)| share.abs() >= SHOWN * largest)
            .collect();
        shown.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let sense = shown.first().map_or(1.0, |(_, share)| share.signum());
        let change = |(index, share): &(usize, f64)| {
            let of = components.get(*index)?;
            Some((of.name.clone(), sense * share * of.scale, of.unit))
        };
        let has_prior = shown
            .iter()
            .all(|(index, _)| components.get(*index).is_some_and(|of| of.prior.is_some()));
        let deviation = if value > 0.0 { value.sqrt().recip() } else { f64::INFINITY };
        Direction {
            changes: shown.iter().filter_map(change).collect(),
            deviation,
            has_prior,
            vector,
        }
    };
    all.into_iter().map(of).collect()
}

/// With four digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
