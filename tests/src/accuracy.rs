//! Error of the accelerations where they are ill conditioned: the solver in `f64` against the
//! same kernels in double-double, over two sweeps.
//!
//! - [`pose`]: the distance from the pose in which massless gimbals are singular;
//! - [`offset`]: the distance of the centre of mass from B.
//!
//! Both computations take the same doubles, angles among them, so that their difference is the
//! solver's rounding. `docs/accuracy.md` is written from these sweeps and the suite `accuracy`
//! asserts their bounds.

mod drawn;
pub mod kinds;
pub mod offset;
pub mod pose;

use core::ops::RangeInclusive;

use precess_dynamics::kind::{Each, Kind};
use precess_dynamics::{Accelerations, Scalar, SolveError};

use crate::blocks::{Figures, largest};
use crate::case::{Case, Set};
use crate::double_double::DoubleDouble as Wide;
use drawn::Drawn;
use kinds::RandomDgvscmg;

/// How many seeded spacecraft are measured at each distance: every number of devices fifty times.
pub const SPACECRAFT: u64 = 450;

/// Accelerations of some devices of a kind, or why there are none.
type Solved<K> = Result<Accelerations<Vec<K>>, SolveError<<K as Kind>::Scalar>>;

/// Largest difference of each kind of acceleration, in units of its largest magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Of the acceleration of B.
    pub r_b_n_ddot: f64,
    /// Of the angular acceleration of the hub.
    pub omega_dot: f64,
    /// The worst of the blocks of the joints.
    pub joints: f64,
}

impl Errors {
    /// The errors of accelerations in `f64`; a block of the joints is one joint of every device.
    fn between<A: Kind<Scalar = f64>, B: Kind<Scalar = Wide>>(
        found: &Accelerations<Vec<A>>,
        expected: &Accelerations<Vec<B>>,
    ) -> Self {
        let joint = |index: usize| {
            let found = found.devices.values().skip(index).step_by(A::JOINTS.len());
            let expected = expected.devices.values().skip(index).step_by(A::JOINTS.len());
            block(&found.collect::<Vec<_>>(), &expected.collect::<Vec<_>>())
        };
        Self {
            r_b_n_ddot: block(found.r_b_n_ddot.as_slice(), expected.r_b_n_ddot.as_slice()),
            omega_dot: block(found.omega_dot.as_slice(), expected.omega_dot.as_slice()),
            joints: largest((0..A::JOINTS.len()).map(joint)),
        }
    }
}

/// Largest difference, in units of the largest magnitude expected; as in
/// [`errors`](crate::blocks::errors).
fn block(found: &[f64], expected: &[Wide]) -> f64 {
    let unit = largest(expected.iter().map(|e| e.abs().to_f64()));
    let pairs = found.iter().zip(expected);
    let difference = largest(pairs.map(|(f, e)| (Wide::from_f64(*f) - *e).abs().to_f64()));
    if difference == 0.0 { 0.0 } else { difference / unit }
}

/// What was measured at one distance, over many spacecraft.
#[derive(Clone, Debug, Default)]
pub struct AccuracyAtDistance {
    /// The distance, rad or m.
    pub distance: f64,
    /// Of each spacecraft that is solved, its worst block.
    pub worst_block: Figures,
    /// The error of the acceleration of B.
    pub r_b_n_ddot: Figures,
    /// The error of the angular acceleration of the hub.
    pub omega_dot: Figures,
    /// The worst block of the joints.
    pub joints: Figures,
    /// Spacecraft that are solved.
    pub solved: usize,
    /// Spacecraft that the solver rejects as singular.
    pub rejected: usize,
}

impl AccuracyAtDistance {
    /// Nothing measured yet.
    fn new(distance: f64) -> Self {
        Self { distance, ..Self::default() }
    }

    /// Takes one more spacecraft.
    ///
    /// # Panics
    ///
    /// If the solver gives another error than `Singular`, or double-double gives any.
    fn add<A: Kind<Scalar = f64>, B: Kind<Scalar = Wide>>(
        &mut self,
        found: Solved<A>,
        expected: impl FnOnce() -> Solved<B>,
        whose: &str,
    ) {
        let found = match found {
            Ok(found) => found,
            Err(SolveError::Singular { .. }) => {
                self.rejected += 1;
                return;
            }
            Err(error) => panic!("{whose}: {error}"),
        };
        let expected = expected().unwrap_or_else(|error| panic!("{whose}, double-double: {error}"));
        let errors = Errors::between(&found, &expected);
        self.solved += 1;
        self.r_b_n_ddot.add(errors.r_b_n_ddot);
        self.omega_dot.add(errors.omega_dot);
        self.joints.add(errors.joints);
        self.worst_block.add(largest([errors.r_b_n_ddot, errors.omega_dot, errors.joints]));
    }
}

/// What the sweeps compare with: the same kernels in double-double.
///
/// # Panics
///
/// If the solver gives an error, naming the case.
#[must_use]
pub fn reference<const N: usize>(case: &Case<N, Wide>, whose: &str) -> Accelerations<Set<N, Wide>> {
    let found = Drawn::new(case).solved::<RandomDgvscmg>(whose);
    let found = found.unwrap_or_else(|error| panic!("{whose}, double-double: {error}"));
    Accelerations {
        r_b_n_ddot: found.r_b_n_ddot,
        omega_dot: found.omega_dot,
        devices: core::array::from_fn(|device| found.devices[device]),
        modal: (),
    }
}

/// One, two and five times each power of ten in a range: the distances of a sweep, rising.
fn decades(powers: RangeInclusive<i32>) -> Vec<f64> {
    let times = |power: i32| {
        // Exact up to the 22nd power, so that a distance is the double nearest to its decimal.
        let ten = 10_f64.powi(power.abs());
        [1.0, 2.0, 5.0].map(|part| if power < 0 { part / ten } else { part * ten })
    };
    powers.flat_map(times).collect()
}

#[cfg(test)]
mod tests {
    use super::decades;

    #[test]
    fn distances_are_the_doubles_of_their_decimals() {
        assert_eq!(decades(-2..=-1), [0.01, 0.02, 0.05, 0.1, 0.2, 0.5]);
        assert_eq!(decades(0..=1), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
    }
}
