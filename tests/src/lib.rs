//! The plain reference and the suites that cross crates.
//!
//! - [`double_double`]: a scalar of 31 digits, for which solver and reference are both generic.
//! - [`newton_euler`]: the paper's equations written out plainly, body by body: the yardstick.
//! - [`random`]: seeded spacecraft over the declared ranges; [`case`]: one spacecraft in one state.
//! - [`table1`]: the paper's own numbers.
//! - [`blocks`]: the unit in which accelerations are compared.
//!
//! The bounds of the suites are those of the project's page of numbers; each constant cites its
//! row.

pub mod blocks;
pub mod case;
pub mod double_double;
pub mod newton_euler;
pub mod random;
pub mod table1;
