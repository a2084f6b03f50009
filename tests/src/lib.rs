//! The Newton-Euler reference, two other formulations, and the suites that cross crates.
//!
//! - [`double_double`]: a scalar of 31 digits, for which solver and reference are both generic.
//! - [`newton_euler`]: Newton and Euler, body by body: the reference.
//! - [`assembly`]: the paper's own equations in the forms of the hand-checked pages; [`spatial`]:
//!   a recursion over articulated bodies that takes nothing from the paper. Two more routes.
//! - [`chains`]: Newton and Euler for devices of every kind, with springs, wrenches and modes.
//! - [`random`]: seeded spacecraft over the declared ranges; [`case`]: one spacecraft in one state.
//! - [`table1`]: the paper's own numbers.
//! - [`stored`]: spacecraft as files hold them, for engines and peers.
//! - [`measured`]: spacecraft of every kind, for what is measured; [`counted`]: a scalar that
//!   counts
//!   its operations.
//! - [`bending`]: flexible structures, for what is measured.
//! - [`vibrations`]: the longest stable step, from eigenvalues.
//! - [`wheels`]: a run of three reaction wheels beside Basilisk's.
//! - [`accuracy`]: where the bound on the accelerations holds and where it is lost.
//! - [`blocks`]: the unit in which accelerations are compared.
//! - [`differences`]: derivatives by differences in double-double; [`derivative_blocks`]: errors of
//!   derivatives.
//! - [`bounds`]: what the project promises, as the suites assert it.

pub use precess_double_double as double_double;

pub mod accuracy;
pub mod assembly;
pub mod bearings;
pub mod bending;
pub mod blocks;
pub mod bounds;
pub mod case;
pub mod chains;
pub mod counted;
pub mod derivative_blocks;
pub mod differences;
pub mod measured;
pub mod newton_euler;
pub mod random;
pub mod spatial;
pub mod stored;
pub mod table1;
pub mod vibrations;
pub mod wheels;

/// The examples of the README and of the pages compile and run.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../README.md")]
    struct Readme;

    // It has examples in lanes.
    #[cfg(feature = "lanes")]
    #[doc = include_str!("../../docs/guide.md")]
    struct Guide;
}

/// How many of so many seeded cases a test takes: each in `cargo xtask test --all`, which sets `PRECESS_TESTS` to
/// `all`; otherwise the first tenth, and fifteen at least, one more than there are kinds.
#[must_use]
pub fn cases(all: u64) -> u64 {
    all_or(all, all.min(all.div_ceil(10).max(15)))
}

/// The first number in `cargo xtask test --all`, the second otherwise: for what takes long with few cases.
#[must_use]
pub fn all_or(all: u64, some: u64) -> u64 {
    let each = std::env::var_os("PRECESS_TESTS").is_some_and(|value| value == "all");
    if each { all } else { some }
}
