//! What the project promises, as the suites assert it: no suite invents a bound of its own for it.
//!
//! "Block" is one kind of acceleration over all devices, in units of its largest magnitude
//! ([`blocks`](crate::blocks)); eps is the machine epsilon of `f64`.
//!
//! E2 and E3, drift of energy less work and of both momenta over 10 s of Table 1 (1e-12 of the
//! energy moved and of the sum of magnitudes), have no constant here: they need an adaptive
//! integrator, and the desktop tool asserts them.

use core::ops::RangeInclusive;

/// How many seeded spacecraft A2 asks for; the rows beside it are tried on the same ones.
pub const SPACECRAFT: u64 = 1000;

/// A1, backward error of the accelerations: `abs(M q'' - h)` in eps of `abs(M) abs(q'') + abs(h)`,
/// in every row, whatever the conditioning.
pub const BACKWARD_EPSILONS: f64 = 50.0;

/// A2, accelerations against a reference in higher precision, of the block, worst: a good engine
/// reaches 3e-13.
pub const ACCELERATIONS_WORST: f64 = 1e-11;

/// A2, the same in the median: a good engine reaches 5e-15.
pub const ACCELERATIONS_MEDIAN: f64 = 1e-13;

/// A3, two routes against each other in double-double, of the block: shows that the rest of A2 is
/// rounding.
pub const ROUTES_IN_DOUBLE_DOUBLE: f64 = 1e-25;

/// A4, the same physics put differently (split devices, another order, whole turns), of the block:
/// other rounding, nothing else.
pub const LIMITS: f64 = 1e-12;

/// A5, `f32` against `f64` over Table 1's ranges, in units of the size of what is compared: `2^-23`
/// times conditioning.
pub const SINGLE_PRECISION: f64 = 1e-4;

/// E1, power balance of one state: `abs(dE/dt - P)` in eps of the sum of the absolute values of all
/// terms. Small, since there is no integrator in it.
pub const POWER_EPSILONS: f64 = 50.0;

/// E4, by what the drift of the fixed-step method falls for a halved step, down to rounding: 2^4,
/// the method being of fourth order.
pub const ORDER: RangeInclusive<f64> = 14.0..=18.0;
