//! The plain reference and the suites that cross crates.
//!
//! - [`double_double`]: a scalar of 31 digits, for which solver and reference are both generic.
//! - [`newton_euler`]: Newton and Euler written out plainly, body by body: the yardstick.
//! - [`assembly`]: the paper's own equations in the forms of the hand-checked pages; [`spatial`]:
//!   a recursion over articulated bodies that takes nothing from the paper. Two more routes.
//! - [`random`]: seeded spacecraft over the declared ranges; [`case`]: one spacecraft in one state.
//! - [`table1`]: the paper's own numbers.
//! - [`blocks`]: the unit in which accelerations are compared.
//!
//! No suite invents a bound for what the project promises. The promises, as the constants cite
//! them; "block" is one kind of acceleration over all devices, in units of its largest
//! magnitude, and eps is the machine epsilon of `f64`:
//!
//! - A1, backward error of the accelerations: `abs(M q'' - h)` is below 50 eps of
//!   `abs(M) abs(q'') + abs(h)` in every row, whatever the conditioning.
//! - A2, accelerations against a reference in higher precision, on 1000 spacecraft: 1e-11 of the
//!   block at worst, 1e-13 in the median. A good engine reaches 3e-13 and 5e-15.
//! - A3, two routes against each other in double-double: 1e-25 of the block, which shows that the
//!   rest of A2 is rounding.
//! - A4, the same physics put differently (split devices, another order, whole turns): 1e-12 of the
//!   block, since only the rounding differs.
//! - A5, `f32` against `f64` over Table 1's ranges: 1e-4 of the block, `2^-23` times conditioning.
//! - E1, power balance of one state: `abs(dE/dt - P)` is below 50 eps of the sum of absolute terms,
//!   since there is no integrator in it.
//! - E2 and E3, drift of energy less work and of both momenta over 10 s of Table 1: 1e-12 of the
//!   energy moved and of the sum of magnitudes. They need an adaptive integrator: the desktop tool
//!   asserts them.
//! - E4, drift of the fixed-step method: falls 14- to 18-fold a halved step, down to rounding; the
//!   method is of fourth order.

pub mod assembly;
pub mod blocks;
pub mod case;
pub mod double_double;
pub mod newton_euler;
pub mod random;
pub mod spatial;
pub mod table1;
