//! The exceptions of `precess.errors`, and errors of the library as them.

use precess::evaluation::EvaluationError;
use precess::file::Diagnostics;
use precess::record::{RecordError, RunError};
use precess_dynamics::{DerivativeError, SolveError};
use pyo3::PyErr;
use pyo3::exceptions::PyKeyError;

/// Classes of Python, made by `precess/errors.py`.
pub(crate) mod class {
    use pyo3::import_exception;

    import_exception!(precess.errors, DerivativeError);
    import_exception!(precess.errors, ParameterError);
    import_exception!(precess.errors, RecordError);
    import_exception!(precess.errors, RunError);
    import_exception!(precess.errors, ScenarioError);
    import_exception!(precess.errors, SignalError);
    import_exception!(precess.errors, SolveError);
    import_exception!(precess.errors, UnsupportedError);
}

/// A scenario that is rejected: the command line's message, and the same as JSON.
pub(crate) fn scenario(errors: &Diagnostics) -> PyErr {
    class::ScenarioError::new_err((errors.to_string().trim_end().to_owned(), errors.json()))
}

/// A run that cannot be started, or that an error has ended.
pub(crate) fn run(error: &RunError) -> PyErr {
    let message = error.to_string();
    match error {
        RunError::Scenario(_) => class::ScenarioError::new_err((message, "[]")),
        RunError::Parameters(_) | RunError::Modes(_) => class::ParameterError::new_err(message),
        RunError::Record(source) => record(source),
        _ => class::RunError::new_err((message, error.time())),
    }
}

/// Samples that cannot be recorded or written.
pub(crate) fn record(error: &RecordError) -> PyErr {
    class::RecordError::new_err(error.to_string())
}

/// A signal or a setting that has no spectrum, no metric or no fit.
pub(crate) fn signal(error: &dyn std::error::Error) -> PyErr {
    class::SignalError::new_err(error.to_string())
}

/// A state and inputs that have no accelerations.
pub(crate) fn solve(error: &SolveError) -> PyErr {
    class::SolveError::new_err(error.to_string())
}

/// What cannot be evaluated.
pub(crate) fn evaluation(error: &EvaluationError) -> PyErr {
    let message = error.to_string();
    match error {
        EvaluationError::Solve(error) => solve(error),
        EvaluationError::Derivative(DerivativeError::Parameter(_)) => {
            class::ParameterError::new_err(message)
        }
        EvaluationError::Derivative(_) => class::DerivativeError::new_err(message),
        EvaluationError::Flexible
        | EvaluationError::Sticks { .. }
        | EvaluationError::AtLargestRate { .. }
        | EvaluationError::Friction { .. } => class::UnsupportedError::new_err(message),
        EvaluationError::UnknownParameter { .. } => PyKeyError::new_err(message),
    }
}
