//! Bounds that several suites assert; docs/promises.md lists them with the measured values.
//!
//! "Block" is one kind of acceleration over all devices, in units of its largest magnitude
//! ([`blocks`](crate::blocks)); eps is the machine epsilon of `f64`.
//!
//! The drift of energy less work and of both momenta over 10 s of Table 1 (1e-12 of the energy
//! moved and of the sum of magnitudes) needs an adaptive integrator: the desktop tool asserts it.

use core::ops::RangeInclusive;

/// Number of seeded spacecraft on which the bounds below are asserted.
pub const SPACECRAFT: u64 = 1000;

/// Backward error of the accelerations: `abs(M q'' - h)` in eps of `abs(M) abs(q'') + abs(h)`,
/// in every row, independent of the conditioning.
pub const BACKWARD_EPSILONS: f64 = 50.0;

/// Largest error of accelerations against a reference in higher precision, of the block: a good
/// engine reaches 3e-13.
pub const ACCELERATIONS_WORST: f64 = 1e-11;

/// Median of that error: a good engine reaches 5e-15.
pub const ACCELERATIONS_MEDIAN: f64 = 1e-13;

/// Largest error of a derivative of the solver against differences in double-double, of the block:
/// accelerations themselves reach 1e-11.
pub const DERIVATIVES_WORST: f64 = 1e-10;

/// Largest median of the spacecraft's worst blocks of derivatives.
pub const DERIVATIVES_MEDIAN: f64 = 1e-12;

/// Largest error of `MuJoCo`'s accelerations against the same reference, of the block: it refers
/// every body to the spacecraft's centre of mass, where a fast wheel metres away costs digits.
/// Measured beside ours, so that a difference larger than its rounding shows.
pub const MUJOCO_WORST: f64 = 1e-8;

/// Median of that error.
pub const MUJOCO_MEDIAN: f64 = 1e-12;

/// Largest difference of two formulations in double-double, of the block: the errors in `f64` are
/// rounding.
pub const ROUTES_IN_DOUBLE_DOUBLE: f64 = 1e-25;

/// Largest difference of the same physics described differently (split devices, another order,
/// whole turns), of the block: only rounding differs.
pub const LIMITS: f64 = 1e-12;

/// Largest difference of a run of three imbalanced reaction wheels, 20,000 steps of RK4, from
/// Basilisk's, in units of each quantity's largest magnitude: the rounding of both adds up over the
/// steps. Measured: 4.2e-14. A change of any input by 1e-8 shows as at least 2.8e-12.
pub const WHEELS_BESIDE_BASILISK: f64 = 2e-13;

/// The same of two imbalanced VSCMGs, whose gimbals turn back and forth. Measured: 1.3e-13. A change
/// of any parameter of a gyro by 1e-8 shows as at least 7e-10.
pub const GYROS_BESIDE_BASILISK: f64 = 1e-12;

/// Largest difference of `f32` from `f64` over Table 1's ranges, in units of the size of what is
/// compared: `2^-23` times conditioning.
pub const SINGLE_PRECISION: f64 = 1e-4;

/// Power balance of one state: `abs(dE/dt - P)` in eps of the sum of the absolute values of all
/// terms. Small, since there is no integrator in it.
pub const POWER_EPSILONS: f64 = 50.0;

/// Ratio of the drifts of the fixed-step method at a step and at half of it, down to rounding: 2^4,
/// the method being of fourth order.
pub const ORDER: RangeInclusive<f64> = 14.0..=18.0;
