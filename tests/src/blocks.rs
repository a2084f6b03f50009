//! The unit of comparison: one block is one kind of acceleration over all devices, and its unit is
//! the block's own largest magnitude.

use precess_dynamics::{Accelerations, Scalar};

use crate::case::{Set, converted};
use crate::double_double::DoubleDouble;

/// Names of the blocks, in the order of [`errors`].
pub const NAMES: [&str; 5] =
    ["r_b_n_ddot", "omega_dot", "gamma_o_ddot", "gamma_i_ddot", "spin_dot"];

/// Largest difference in each block, in units of the largest magnitude of `expected` there.
///
/// The differences are taken in double-double. A block without entries, or zero in both, has no
/// error; one that is zero only in `expected` has an infinite one, as has one with a NaN.
#[must_use]
pub fn errors<const N: usize, T: Scalar, U: Scalar>(
    actual: &Accelerations<Set<N, T>>,
    expected: &Accelerations<Set<N, U>>,
) -> [f64; 5] {
    let (actual, expected) = (blocks(&converted(actual)), blocks(&converted(expected)));
    core::array::from_fn(|k| {
        let pairs = || actual[k].iter().zip(&expected[k]);
        let unit = largest(expected[k].iter().map(|e| e.abs().to_f64()));
        let difference = largest(pairs().map(|(a, e)| (*a - *e).abs().to_f64()));
        if difference == 0.0 { 0.0 } else { difference / unit }
    })
}

/// The largest of the five errors, with the name of its block.
#[must_use]
pub fn worst(errors: [f64; 5]) -> (f64, &'static str) {
    let mut worst = (0.0, NAMES[0]);
    for (error, name) in errors.into_iter().zip(NAMES) {
        if error > worst.0 || error.is_nan() {
            worst = (error, name);
        }
    }
    worst
}

/// The largest of some magnitudes, zero if there are none. Infinite if any is NaN, which
/// `f64::max` would drop, so that no bound lets it pass.
#[must_use]
pub fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}

fn blocks<const N: usize>(a: &Accelerations<Set<N, DoubleDouble>>) -> [Vec<DoubleDouble>; 5] {
    [
        a.r_b_n_ddot.iter().copied().collect(),
        a.omega_dot.iter().copied().collect(),
        a.devices.iter().map(|joint| joint.gamma_o_ddot).collect(),
        a.devices.iter().map(|joint| joint.gamma_i_ddot).collect(),
        a.devices.iter().map(|joint| joint.spin_dot).collect(),
    ]
}

/// Figures of many runs: what a suite asserts and prints.
#[derive(Clone, Debug, Default)]
pub struct Figures(Vec<f64>);

impl Figures {
    /// Takes one more figure; NaN counts as infinite.
    pub fn add(&mut self, figure: f64) {
        self.0.push(if figure.is_nan() { f64::INFINITY } else { figure });
    }

    /// The largest.
    #[must_use]
    pub fn worst(&self) -> f64 {
        largest(self.0.iter().copied())
    }

    /// The middle one.
    #[must_use]
    pub fn median(&self) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use precess_dynamics::Accelerations;
    use precess_dynamics::dgvscmg::JointAccelerations;

    use super::{Figures, errors, largest, worst};
    use crate::case::Set;

    fn sample() -> Accelerations<Set<1>> {
        Accelerations {
            r_b_n_ddot: Vector3::new(1.0, -4.0, 2.0),
            omega_dot: Vector3::new(0.0, 0.0, 0.0),
            devices: [JointAccelerations { gamma_o_ddot: 1.0, gamma_i_ddot: 2.0, spin_dot: 3.0 }],
            modal: (),
        }
    }

    #[test]
    fn error_is_in_units_of_the_largest_entry_of_its_block() {
        let mut actual = sample();
        actual.r_b_n_ddot.x += 1.0;
        assert_eq!(errors(&actual, &sample()), [0.25, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn neither_a_wrong_zero_nor_a_nan_passes() {
        let mut actual = sample();
        actual.omega_dot.x = 1e-300;
        assert_eq!(worst(errors(&actual, &sample())).0, f64::INFINITY);
        actual = sample();
        actual.devices[0].spin_dot = f64::NAN;
        assert_eq!(worst(errors(&actual, &sample())), (f64::INFINITY, "spin_dot"));
    }

    #[test]
    fn largest_number_does_not_lose_a_nan() {
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert_eq!(largest([]), 0.0);
        for numbers in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            assert_eq!(largest(numbers), f64::INFINITY);
        }
    }

    #[test]
    fn figures_know_their_worst_and_median() {
        let mut figures = Figures::default();
        for figure in [3.0, 1.0, 2.0] {
            figures.add(figure);
        }
        assert_eq!((figures.worst(), figures.median()), (3.0, 2.0));
        figures.add(f64::NAN);
        assert_eq!(figures.worst(), f64::INFINITY);
    }
}
