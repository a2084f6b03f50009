//! The native module `precess._native`: the library behind the Python package.
//!
//! It contains no physics: it converts arrays and names, and calls the crate `precess`. Public classes are
//! in Python (`precess/`); only they use this module.

#![expect(clippy::needless_pass_by_value, reason = "PyO3 hands arguments over by value")]

mod batch;
mod campaign;
mod controller;
mod errors;
mod evaluator;
mod fit;
mod identify;
mod inputs;
mod jitter;
mod outcome;
mod pointing;
mod run;
mod scenario;
mod spectra;
mod watch;
mod xla;

use pyo3::prelude::*;

/// The native module.
#[pymodule(gil_used = false)]
mod _native {
    #[pymodule_export]
    use super::batch::NativeBatch;
    #[pymodule_export]
    use super::campaign::{
        estimate_percentile, estimate_probability, keep_out, limits, plan_keys, plan_of_axes,
        plan_of_draws, plan_of_probabilities, plan_sensitivities, rank_correlation, row_fields,
        rows, side_by_side,
    };
    #[pymodule_export]
    use super::evaluator::NativeEvaluator;
    #[pymodule_export]
    use super::fit::{NativeFit, fit_file, fit_records};
    #[pymodule_export]
    use super::identify::{NativeIdentified, identify};
    #[pymodule_export]
    use super::inputs::NativeInputs;
    #[pymodule_export]
    use super::jitter::{NativeBudget, jitter_budget};
    #[pymodule_export]
    use super::outcome::NativeResult;
    #[pymodule_export]
    use super::pointing::{
        pointing_index, pointing_index_of_psd, pointing_of_history, pointing_of_lines,
        pointing_of_psd, pointing_of_table, pointing_weights,
    };
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::scenario::NativeScenario;
    #[pymodule_export]
    use super::spectra::{
        NativeAmplitudes, NativePsd, spectrum_amplitudes, spectrum_cross, spectrum_welch,
    };
    #[pymodule_export]
    use super::version;
    #[pymodule_export]
    use super::watch::{NativeWatched, watch};
    #[pymodule_export]
    use super::xla::{NativeFunction, xla_functions};
}

/// The version of the package.
#[pyfunction]
fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
