//! The distance of the centre of mass from B: hub and devices of a random spacecraft are moved, and
//! what acts on it from outside with them.

use precess_dynamics::Scalar;

use super::drawn::Drawn;
use super::kinds::RandomDgvscmg;
use super::{AccuracyAtDistance, SPACECRAFT, decades};
use crate::case::Case;
use crate::double_double::DoubleDouble as Wide;
use crate::random::{Random, Sample, Visitor, visit};

/// The distances of the sweep, rising, m.
#[must_use]
pub fn distances() -> Vec<f64> {
    let mut distances = decades(0..=7);
    distances.push(1e8);
    distances
}

/// Measures one distance over the seeded spacecraft.
#[must_use]
pub fn at(distance: f64) -> AccuracyAtDistance {
    let mut measurement = Measurement(AccuracyAtDistance::new(distance));
    visit(SPACECRAFT, &mut measurement);
    measurement.0
}

struct Measurement(AccuracyAtDistance);

impl Visitor for Measurement {
    fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
        let (whose, distance) = (sample.to_string(), self.0.distance);
        let found = Drawn::new(&case::<f64, N>(sample, distance)).solved::<RandomDgvscmg>(&whose);
        let expected =
            || Drawn::new(&case::<Wide, N>(sample, distance)).solved::<RandomDgvscmg>(&whose);
        self.0.add(found, expected, &whose);
    }
}

/// The spacecraft with all of it moved in a direction drawn at random, the external force through the
/// point that B was: the same doubles in every scalar, but for mounts, which are orthonormal to its
/// rounding.
#[must_use]
pub fn case<T: Scalar, const N: usize>(sample: &Sample<N>, distance: f64) -> Case<N, T> {
    let by = Random::new(!sample.seed).vector(distance);
    let (drawn, mut moved) = (sample.case::<f64>(), sample.case::<T>());
    moved.hub.r_bc_b = (drawn.hub.r_bc_b + by).map(T::from_f64);
    for (moved, drawn) in moved.devices.iter_mut().zip(&drawn.devices) {
        moved.r_go_b = (drawn.r_go_b + by).map(T::from_f64);
    }
    let torque_b = drawn.inputs.torque_b + by.cross(&drawn.inputs.force);
    moved.inputs.torque_b = torque_b.map(T::from_f64);
    moved
}
