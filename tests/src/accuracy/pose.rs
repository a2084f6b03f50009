//! The distance from the pose in which massless gimbals are singular: every inner gimbal is turned
//! from a right angle by it.

use core::f64::consts::FRAC_PI_2;
use core::marker::PhantomData;

use precess_dynamics::Scalar;

use super::drawn::Drawn;
use super::kinds::{BareDgvscmg, Form};
use super::{AccuracyAtDistance, SPACECRAFT, decades};
use crate::case::Case;
use crate::double_double::DoubleDouble as Wide;
use crate::random::{Random, Sample, Visitor, visit};

/// The distances of the sweep, rising, rad.
#[must_use]
pub fn distances() -> Vec<f64> {
    let mut distances = decades(-8..=-1);
    distances.push(1.0);
    distances
}

/// Measures bare wheels of a form at one distance, over the seeded spacecraft that have devices.
#[must_use]
pub fn at<F: Form>(distance: f64) -> AccuracyAtDistance {
    let mut measurement =
        Measurement::<F> { row: AccuracyAtDistance::new(distance), form: PhantomData };
    visit(SPACECRAFT, &mut measurement);
    measurement.row
}

struct Measurement<F> {
    row: AccuracyAtDistance,
    form: PhantomData<F>,
}

impl<F: Form> Visitor for Measurement<F> {
    fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
        if N == 0 {
            return;
        }
        let (whose, distance) = (sample.to_string(), self.row.distance);
        let found = Drawn::new(&case::<f64, N>(sample, distance)).solved::<F>(&whose);
        let expected = || Drawn::new(&case::<Wide, N>(sample, distance)).solved::<F>(&whose);
        self.row.add(found, expected, &whose);
    }
}

/// The spacecraft with massless gimbals, the inner ones at the distance from a right angle, on a side
/// drawn at random: the same doubles in every scalar, but for mounts, which are orthonormal to its
/// rounding.
#[must_use]
pub fn case<T: Scalar, const N: usize>(sample: &Sample<N>, distance: f64) -> Case<N, T> {
    let random = &mut Random::new(!sample.seed);
    let mut sign = || if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
    let mut case = sample.case::<T>();
    for (device, joints) in case.devices.iter_mut().zip(&mut case.state.devices) {
        *device = BareDgvscmg::from_dgvscmg(device);
        joints.gamma_i = T::from_f64(sign() * (FRAC_PI_2 + sign() * distance));
    }
    case
}
