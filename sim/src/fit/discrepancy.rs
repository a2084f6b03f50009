//! [`Discrepancy`]: what a fitted model does not explain, and whether it holds all the same.
//!
//! The imbalance of a rigid rotor turns with the wheel: at h = 1 it has no axial force and nothing that turns backward. A
//! spin axis that is stated wrong by the angle e turns a force across the axis into
//!
//! ```text
//! forward cos²(e/2)        backward sin²(e/2)        axial sin e        of the true one
//! ```
//!
//! so up to a fifth of the forward one, axial or backward, a wrong axis is no more than 11.4 degrees, and the imbalance
//! is within 1 %. A wrong rate or wrong speeds leave the imbalance at another number, and another line or noise at 1.

use std::fmt;

use statrs::distribution::{ChiSquared, ContinuousCDF as _};

use super::estimate::Estimate;
use super::lines::float;
use super::measurement::Group;
use super::powers::{GroupFit, Sense};
use super::{Coefficient, Harmonic};

/// A mean square of weighted residuals above it shows what the model does not have.
pub const SQUARES_MAX: f64 = 1.5;
/// Unless so few residuals reach it by chance, which is allowed this often.
const SQUARES_CHANCE: f64 = 1e-4;
/// A line whose power is this by its noise is well above it: then the power is nearly normal.
const STRONG: f64 = 10.0;
/// An axial or backward line at h = 1 is up to this share of the forward one.
const BESIDE_MAX: f64 = 0.2;
/// Another line has up to this many times the coefficient of the imbalance.
const LARGER_MAX: f64 = 10.0;
/// Names in a message.
const NAMES: usize = 3;

/// What a fitted model does not explain.
#[derive(Clone, Debug, PartialEq)]
pub enum Discrepancy {
    /// Residuals that noise does not have.
    Residuals {
        /// Of which forces or moments.
        group: Group,
        /// Mean square of the residuals by their variance.
        mean_square: f64,
        /// What noise reaches.
        bound: f64,
        /// The record with the largest residual, and its line.
        record: String,
        /// `h` of the line.
        number: f64,
        /// That residual by its standard deviation.
        deviations: f64,
    },
    /// An axial line, or one that turns backward, at h = 1, beside the imbalance.
    Fundamental {
        /// Of which forces or moments.
        group: Group,
        /// Which way it turns.
        sense: Sense,
        /// Its coefficient, kg m or kg m².
        found: Estimate,
        /// That of the imbalance.
        imbalance: Estimate,
    },
    /// A line that is much larger than the imbalance.
    Larger {
        /// Of which forces or moments.
        group: Group,
        /// `h`.
        number: f64,
        /// Its coefficient, kg m or kg m².
        found: f64,
        /// That of the imbalance.
        imbalance: Estimate,
        /// Whether the line is fitted; else it is in the residuals only.
        fitted: bool,
    },
    /// A line in the residuals: it follows the speed, and is not among the stated ones.
    LeftOut {
        /// Of which forces or moments.
        group: Group,
        /// `h`.
        number: f64,
        /// About its coefficient, kg m or kg m².
        found: f64,
    },
    /// Records that take no part: no line shows their speed within its accuracy.
    Lost {
        /// Their names.
        records: Vec<String>,
        /// How many records there are.
        of: usize,
    },
}

/// A line in the residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Remainder {
    pub(super) group: Group,
    pub(super) number: f64,
    /// About its coefficient, kg m or kg m².
    pub(super) size: f64,
}

impl Discrepancy {
    /// Whether the model does not hold because of it; else it is a remark.
    #[must_use]
    pub const fn fails(&self) -> bool {
        match self {
            Self::Residuals { .. } | Self::Fundamental { .. } | Self::Larger { .. } => true,
            Self::LeftOut { .. } | Self::Lost { .. } => false,
        }
    }
}

/// The mean square of weighted residuals that noise reaches: 1.5, or of few degrees of freedom what once in 10,000 fits is
/// above it. Of a line below the noise the power is exponential: the largest of so many reaches `ln(freedom / chance)`.
#[must_use]
pub fn squares_bound(freedom: f64) -> f64 {
    let largest = (freedom / SQUARES_CHANCE).ln() - 1.0;
    SQUARES_MAX.max(largest * largest / freedom)
}

/// The same where all lines are well above the noise: of chi-square.
fn strong_bound(freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(SQUARES_MAX, |distribution| {
        SQUARES_MAX.max(distribution.inverse_cdf(1.0 - SQUARES_CHANCE) / freedom)
    })
}

/// Residuals of groups beyond what noise has: of all lines, or of those well above the noise.
pub(super) fn of_residuals(
    groups: &[GroupFit],
    harmonics: &[Harmonic],
    names: &[String],
) -> Vec<Discrepancy> {
    let mut all = Vec::new();
    for fit in groups {
        let strong = fit.points.iter().filter(|point| fit.model(point) > STRONG * point.noise);
        let residuals: Vec<f64> = strong.map(|point| fit.residual(point)).collect();
        let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let freedom = float(residuals.len()) * fit.freedom / float(fit.points.len());
        let means = [
            (fit.squares / fit.freedom, squares_bound(fit.freedom)),
            (squares / freedom.max(1.0), strong_bound(freedom.max(1.0))),
        ];
        // Also not a number.
        let holds = |(mean, bound): &(f64, f64)| mean <= bound;
        let above = means.into_iter().find(|pair| !holds(pair));
        let Some((mean_square, bound)) = above else { continue };
        let each = fit.points.iter().map(|point| (point, fit.residual(point)));
        let worst = each.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let Some((point, deviations)) = worst else { continue };
        all.push(Discrepancy::Residuals {
            group: fit.group,
            mean_square,
            bound,
            record: names.get(point.record).cloned().unwrap_or_default(),
            number: harmonics.get(point.line).map_or(f64::NAN, |line| line.number.value),
            deviations,
        });
    }
    all
}

/// Lines that contradict the imbalance where they are `compared` with it: beside it at h = 1, or much larger at other
/// numbers; and lines that are left.
pub(super) fn of_lines(
    harmonics: &[Harmonic],
    left: &[Remainder],
    compared: bool,
) -> Vec<Discrepancy> {
    let first = harmonics.iter().find(|line| compared && line.number.value == 1.0);
    let mut all = first.map_or_else(Vec::new, beside_imbalance);
    let imbalance = first.and_then(imbalance_of);
    let larger = |group: Group, least: f64| {
        let same = imbalance.filter(|c| c.group == group).map(|c| c.c);
        same.filter(|imbalance| least > LARGER_MAX * imbalance.interval[1])
    };
    for line in harmonics.iter().filter(|line| line.number.value != 1.0) {
        for c in line.coefficients.iter().filter(|c| c.seen && c.sense == Sense::Forward) {
            if let Some(imbalance) = larger(c.group, c.c.interval[0]) {
                let (group, number, found) = (c.group, line.number.value, c.c.value);
                all.push(Discrepancy::Larger { group, number, found, imbalance, fitted: true });
            }
        }
    }
    for Remainder { group, number, size: found } in left.iter().copied() {
        all.push(match larger(group, found) {
            Some(imbalance) => {
                Discrepancy::Larger { group, number, found, imbalance, fitted: false }
            }
            None => Discrepancy::LeftOut { group, number, found },
        });
    }
    all
}

/// The forward line of a radial group.
fn forward(line: &Harmonic, group: Group) -> Option<Coefficient> {
    let own = |c: &&Coefficient| c.group == group && c.sense == Sense::Forward;
    line.coefficients.iter().find(own).copied()
}

/// What other lines are compared with: the static imbalance, or the dynamic one where only that is above the noise.
fn imbalance_of(first: &Harmonic) -> Option<Coefficient> {
    let [force, torque] = [Group::RadialForce, Group::RadialTorque].map(|of| forward(first, of));
    let seen = |c: &Coefficient| c.seen;
    force.filter(seen).or(torque.filter(seen)).or(force)
}

/// Axial and backward lines at h = 1 that are large beside the imbalance.
fn beside_imbalance(first: &Harmonic) -> Vec<Discrepancy> {
    let each = first.coefficients.iter().filter(|c| c.seen).filter_map(|c| {
        let beside = match (c.group, c.sense) {
            (Group::AxialForce, _) | (Group::RadialForce, Sense::Backward) => Group::RadialForce,
            (Group::RadialTorque, Sense::Backward) => Group::RadialTorque,
            // A motor's torque has a ripple once a turn, too.
            _ => return None,
        };
        let imbalance = forward(first, beside)?.c;
        let (group, sense, found) = (c.group, c.sense, c.c);
        let large = found.interval[0] > BESIDE_MAX * imbalance.interval[1];
        large.then_some(Discrepancy::Fundamental { group, sense, found, imbalance })
    });
    each.collect()
}

fn sense_of(group: Group, sense: Sense) -> &'static str {
    match (group.is_radial(), sense) {
        (false, _) => "",
        (true, Sense::Forward) => ", forward",
        (true, Sense::Backward) => ", backward",
    }
}

impl fmt::Display for Discrepancy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Residuals { group, mean_square, bound, record, number, deviations } => write!(
                f,
                "{group}: mean square of the residuals by variance {mean_square:.2}, above {bound:.2}; the largest, \
                 {deviations:.1} standard deviations, is of h = {number:.4} in {record}; check its speed, \
                 the sign of the speed, and whether other lines or modes are in it"
            ),
            Self::Fundamental { group, sense, found, imbalance } => write!(
                f,
                "{group}{}: a line at h = 1 of {:.4e} {unit} beside an imbalance of {:.4e} {unit}, more than \
                 {BESIDE_MAX} of it, which a rotor's imbalance does not have; check `table.spin_axis`, the sense of \
                 the speed and the order of the columns, or state `compare_with_imbalance = false` if the wheel has it",
                sense_of(*group, *sense),
                found.value,
                imbalance.value,
                unit = group.coefficient_unit()
            ),
            Self::Larger { group, number, found, imbalance, fitted } => write!(
                f,
                "{group}: {} h = {number:.3} has {found:.4e} {unit}, the imbalance at h = 1 has {:.4e} {unit}, less \
                 than a tenth; if that line is the imbalance, the true speeds are {number:.3} times the stated ones, \
                 or the true rate {:.3} times the stated one; check speeds, their unit and the rate, or state \
                 `compare_with_imbalance = false` if the wheel is so",
                if *fitted { "the line" } else { "a line that is not fitted," },
                imbalance.value,
                1.0 / number,
                unit = group.coefficient_unit()
            ),
            Self::LeftOut { group, number, found } => write!(
                f,
                "{group}: a line at h = {number:.4}, about {found:.2e} {}, is in the residuals and not fitted; state \
                 it as `[[harmonic]]` if it is the wheel's",
                group.coefficient_unit()
            ),
            Self::Lost { records, of } => {
                let shown = records.iter().take(NAMES).map(String::as_str).collect::<Vec<_>>();
                let more = if records.len() > NAMES { ", .." } else { "" };
                write!(
                    f,
                    "{} of {of} records take no part: no line shows their speed within `speed_accuracy`: {}{more}",
                    records.len(),
                    shown.join(", ")
                )
            }
        }
    }
}
