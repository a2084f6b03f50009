//! The plain reference and the suites that cross crates.
