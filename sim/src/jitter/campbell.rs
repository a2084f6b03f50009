//! Natural frequencies over the speed (a Campbell diagram), and where the orders of tones cross them.
//!
//! With the means of the devices' derivatives, and coordinates `[rigid motion; modal coordinates; free joints]`,
//!
//! ```text
//! M x'' + C x' + K x = 0      eigenvalues s of [0, 1; -M^-1 K, -M^-1 C]
//! ```
//!
//! A pair `s = -zeta w_n ± i w` is an oscillation of frequency `w`. Gyroscopic terms split modes of rotors into a
//! forward whirl, which rises with the speed, and a backward one, which falls.

use nalgebra::{DMatrix, Schur};

use super::model::Model;
use crate::structure::{COORDINATES, Fault, rigid_rows};

/// Sweeps of the eigenvalue iteration; a handful per eigenvalue is usual.
const ITERATIONS_MAX: usize = 100_000;
/// An oscillation is slower than this share of the fastest one only by rounding: a rigid motion.
const RIGID_MAX: f64 = 1e-6;
/// A branch turns with the speed if its frequency changes by more than this share of the speed's change.
const WHIRL_MIN: f64 = 1e-2;

/// An oscillation at one speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// Angular frequency, rad/s.
    pub frequency: f64,
    /// Damping ratio.
    pub damping: f64,
}

/// A branch of natural frequencies over the speeds.
#[derive(Clone, Debug)]
pub struct Branch {
    /// At each speed; none where it is not there.
    pub points: Vec<Option<Oscillation>>,
}

/// How a branch moves with the speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whirl {
    /// Its frequency rises with the speed.
    Forward,
    /// It falls.
    Backward,
    /// It hardly changes.
    None,
}

/// An order that crosses a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Number of the branch.
    pub branch: usize,
    /// Harmonic number.
    pub order: f64,
    /// Speed, rad/s.
    pub speed: f64,
    /// The oscillation there.
    pub oscillation: Oscillation,
    /// How the branch moves there.
    pub whirl: Whirl,
}

/// Oscillations of a model at a speed, rad/s, rising.
///
/// # Errors
/// [`Fault::Indefinite`] of a mass matrix without inverse; [`Fault::Range`] where the iteration fails.
pub fn oscillations(model: &Model, speed: f64) -> Result<Vec<Oscillation>, Fault> {
    let [mass, rates, stiffness] = matrices(model, speed);
    let size = mass.nrows();
    let indefinite = || Fault::Indefinite { what: "mass matrix of structure and devices", size };
    let factors = mass.lu();
    let [by_rate, by_place] = [rates, stiffness].map(|matrix| factors.solve(&matrix));
    let (by_rate, by_place) = by_rate.zip(by_place).ok_or_else(indefinite)?;
    let mut first_order = DMatrix::zeros(2 * size, 2 * size);
    first_order.view_mut((0, size), (size, size)).fill_diagonal(1.0);
    first_order.view_mut((size, 0), (size, size)).copy_from(&-by_place);
    first_order.view_mut((size, size), (size, size)).copy_from(&-by_rate);
    let schur = Schur::try_new(first_order, f64::EPSILON, ITERATIONS_MAX).ok_or_else(indefinite)?;
    let values = schur.complex_eigenvalues();
    let fastest = values.iter().map(|value| value.im.abs()).fold(0.0, f64::max);
    let mut found: Vec<Oscillation> = values
        .iter()
        .filter(|value| value.im > RIGID_MAX * fastest)
        .map(|value| Oscillation { frequency: value.im, damping: -value.re / value.norm() })
        .collect();
    found.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    Ok(found)
}

/// Mass, rate and stiffness matrix, of coordinates `[rigid motion; modal coordinates; free joints]`.
pub(crate) fn matrices(model: &Model, speed: f64) -> [DMatrix<f64>; 3] {
    let structure = &model.structure;
    let modes = structure.modes.len();
    let means: Vec<_> = model.devices.iter().map(|(_, device)| device.mean(speed)).collect();
    let joints = |mean: &[DMatrix<f64>; 3]| mean[0].nrows().saturating_sub(COORDINATES);
    let rigid = COORDINATES + modes;
    let size = rigid + means.iter().map(joints).sum::<usize>();
    let mut all: [DMatrix<f64>; 3] = std::array::from_fn(|_| DMatrix::zeros(size, size));
    if let Some(mass) = &structure.mass {
        all[0].view_mut((0, 0), (COORDINATES, COORDINATES)).copy_from(&mass.matrix());
    }
    let momenta = structure.momenta();
    all[0].view_mut((0, COORDINATES), (COORDINATES, modes)).copy_from(&momenta);
    all[0].view_mut((COORDINATES, 0), (modes, COORDINATES)).copy_from(&momenta.transpose());
    for (index, mode) in structure.modes.iter().enumerate() {
        let at = (COORDINATES + index, COORDINATES + index);
        all[0][at] = 1.0;
        all[1][at] = 2.0 * mode.damping * mode.frequency;
        all[2][at] = mode.frequency * mode.frequency;
    }
    for (rows, mean) in device_rows(model).iter().zip(&means) {
        for (sum, part) in all.iter_mut().zip(mean) {
            *sum += rows.transpose() * part * rows;
        }
    }
    for (mount, contained) in model.contained.iter().enumerate() {
        if let Some(mass) = contained {
            let node = model.mounts.get(mount).copied().unwrap_or(0);
            let rows = node_rows(model, node, size);
            all[0] -= rows.transpose() * mass * rows;
        }
    }
    all
}

/// Motion of a node by the coordinates of [`matrices`]: six rows.
pub(crate) fn node_rows(model: &Model, node: usize, size: usize) -> DMatrix<f64> {
    let (structure, modes) = (&model.structure, model.structure.modes.len());
    let mut rows = DMatrix::zeros(COORDINATES, size);
    if let Some(place) = structure.nodes.get(node) {
        rows.view_mut((0, 0), (COORDINATES, COORDINATES)).copy_from(&rigid_rows(&place.position));
        let shapes = structure.shapes.rows(COORDINATES * node, COORDINATES);
        rows.view_mut((0, COORDINATES), (COORDINATES, modes)).copy_from(&shapes);
    }
    rows
}

/// Motion of the mount and of the free joints of each device by the coordinates of [`matrices`].
pub(crate) fn device_rows(model: &Model) -> Vec<DMatrix<f64>> {
    let rigid = COORDINATES + model.structure.modes.len();
    let size = rigid + model.devices.iter().map(|(_, device)| device.free.len()).sum::<usize>();
    let mut next = rigid;
    let of = |(mount, device): &(usize, super::device::SweptDevice)| {
        let own = device.free.len();
        let node = model.mounts.get(*mount).copied().unwrap_or(0);
        let mut rows = DMatrix::zeros(COORDINATES + own, size);
        rows.rows_mut(0, COORDINATES).copy_from(&node_rows(model, node, size));
        rows.view_mut((COORDINATES, next), (own, own)).fill_diagonal(1.0);
        next += own;
        rows
    };
    model.devices.iter().map(of).collect()
}

/// Branches through the oscillations at rising speeds: each goes on to the nearest frequency that its slope predicts.
#[must_use]
pub fn branches(speeds: &[f64], oscillations: &[Vec<Oscillation>]) -> Vec<Branch> {
    let mut branches: Vec<Branch> = Vec::new();
    for (index, found) in oscillations.iter().enumerate() {
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (number, branch) in branches.iter().enumerate() {
            let Some(expected) = predicted(branch, speeds, index) else { continue };
            let differences = found.iter().enumerate();
            pairs.extend(differences.map(|(k, of)| ((of.frequency - expected).abs(), number, k)));
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut continued, mut used) = (vec![false; branches.len()], vec![false; found.len()]);
        for branch in &mut branches {
            branch.points.push(None);
        }
        for (_, number, k) in pairs {
            if continued[number] || used[k] {
                continue;
            }
            (continued[number], used[k]) = (true, true);
            if let Some(last) = branches[number].points.last_mut() {
                *last = found.get(k).copied();
            }
        }
        for (of, used) in found.iter().zip(used) {
            if !used {
                let mut points = vec![None; index];
                points.push(Some(*of));
                branches.push(Branch { points });
            }
        }
    }
    branches
}

/// The frequency that a branch would have at a speed, from its last two points.
fn predicted(branch: &Branch, speeds: &[f64], at: usize) -> Option<f64> {
    let before = |back: usize| {
        let index = at.checked_sub(back)?;
        let point = (*branch.points.get(index)?)?;
        Some((*speeds.get(index)?, point.frequency))
    };
    let (s1, f1) = before(1)?;
    let Some((s0, f0)) = before(2) else { return Some(f1) };
    let speed = speeds.get(at)?;
    Some(f1 + (f1 - f0) * (speed - s1) / (s1 - s0))
}

/// Where orders cross branches, by rising speed: between neighbouring speeds both are straight lines.
#[must_use]
pub fn crossings(speeds: &[f64], branches: &[Branch], orders: &[f64]) -> Vec<Crossing> {
    let mut crossings = Vec::new();
    for (number, branch) in branches.iter().enumerate() {
        let points = speeds.iter().zip(&branch.points).collect::<Vec<_>>();
        for pair in points.windows(2) {
            let ([(s0, Some(a)), (s1, Some(b))], Some(_)) = (pair, pair.first()) else { continue };
            for order in orders {
                let [d0, d1] = [a.frequency - order * *s0, b.frequency - order * *s1];
                if d0 == d1 || !(d0 <= 0.0 && d1 > 0.0 || d0 >= 0.0 && d1 < 0.0) {
                    continue;
                }
                let share = d0 / (d0 - d1);
                let between = |from: f64, to: f64| from + share * (to - from);
                let slope = (b.frequency - a.frequency) / (*s1 - *s0);
                crossings.push(Crossing {
                    branch: number,
                    order: *order,
                    speed: between(**s0, **s1),
                    oscillation: Oscillation {
                        frequency: between(a.frequency, b.frequency),
                        damping: between(a.damping, b.damping),
                    },
                    whirl: match slope {
                        slope if slope > WHIRL_MIN => Whirl::Forward,
                        slope if slope < -WHIRL_MIN => Whirl::Backward,
                        _ => Whirl::None,
                    },
                });
            }
        }
    }
    crossings.sort_by(|a, b| a.speed.total_cmp(&b.speed).then(a.order.total_cmp(&b.order)));
    crossings
}
