//! The native module `precess._native`: the library behind the Python package.
//!
//! It contains no physics: it converts arrays and names, and calls the crate `precess`. Public classes are
//! in Python (`precess/`); this module is theirs alone.

mod batch;
mod campaign;
mod errors;
mod evaluator;
mod inputs;
mod jitter;
mod outcome;
mod run;
mod scenario;

use pyo3::prelude::*;

/// The native module.
#[pymodule(gil_used = false)]
mod _native {
    #[pymodule_export]
    use super::batch::NativeBatch;
    #[pymodule_export]
    use super::campaign::{
        estimate_percentile, estimate_probability, limits, plan_keys, plan_of_axes, plan_of_draws,
        plan_of_probabilities, rank_correlation, row, row_fields,
    };
    #[pymodule_export]
    use super::evaluator::NativeEvaluator;
    #[pymodule_export]
    use super::inputs::NativeInputs;
    #[pymodule_export]
    use super::jitter::{NativeBudget, jitter_budget};
    #[pymodule_export]
    use super::outcome::NativeResult;
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::scenario::NativeScenario;
    #[pymodule_export]
    use super::version;
}

/// The version of the package.
#[pyfunction]
fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
