//! What is done with one input: it is read, shown, written and read back, and stepped; [`tried`].
//!
//! The fuzz target (`targets/scenario.rs`) and the test of its corpus (`sim/tests/corpus.rs`) share
//! it. No input reads a file: one that names files (`base`, `table`) is skipped.

use std::path::Path;

use precess::engine::{Advance, Run};
use precess::file::{from_toml, to_toml};
use toml::de::{DeTable, DeValue};

/// Steps of a run; some mutated numbers show only after several.
const STEPS: usize = 8;
/// With more joints only the first moment is evaluated: a step takes 2 us a joint.
const JOINTS_MAX: usize = 256;

/// How far an input came.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reached {
    /// It is no text, or names a file.
    Skipped,
    /// An error of the reader or of the checks.
    Rejected,
    /// A scenario whose run cannot start.
    Read,
    /// Stepped, or rejected by the solver on the way.
    Stepped,
}

/// Tries an input.
///
/// # Panics
///
/// If an error has no message, or if a scenario is not read back as it was written.
pub(crate) fn tried(bytes: &[u8]) -> Reached {
    let Ok(text) = std::str::from_utf8(bytes) else { return Reached::Skipped };
    if names_a_file(&DeTable::parse_recoverable(text).0.into_inner()) {
        return Reached::Skipped;
    }
    let scenario = match from_toml("input.toml", text, Path::new("")) {
        Err(errors) => {
            assert!(!errors.to_string().trim().is_empty(), "an error without a message");
            assert!(is_json(&errors.json()), "errors are no JSON: {}", errors.json());
            return Reached::Rejected;
        }
        Ok((scenario, warnings)) => {
            assert_eq!(warnings.to_string().is_empty(), warnings.all.is_empty());
            assert!(is_json(&warnings.json()), "warnings are no JSON: {}", warnings.json());
            scenario
        }
    };
    let written = to_toml(&scenario);
    let again = from_toml("written.toml", &written, Path::new(""));
    let (again, _) = again.unwrap_or_else(|errors| panic!("{errors}\n{written}"));
    assert_eq!(to_toml(&again), written, "a scenario that is read back differs");
    let Ok(mut run) = Run::new(&scenario) else { return Reached::Read };
    let steps = if scenario.joint_count() > JOINTS_MAX { 0 } else { STEPS };
    for _ in 0..steps {
        match run.advance() {
            Ok(Advance::Stepped) => {}
            Ok(Advance::Ended) | Err(_) => break,
        }
    }
    let state = run.state();
    assert!(state.omega.iter().all(|w| w.is_finite()), "the state is not finite");
    Reached::Stepped
}

fn is_json(text: &str) -> bool {
    serde_json::from_str::<serde_json::Value>(text).is_ok()
}

/// Whether a key at any depth is one whose value names a file.
fn names_a_file(table: &DeTable<'_>) -> bool {
    table.iter().any(|(key, value)| {
        matches!(key.get_ref().as_ref(), "base" | "table" | "file") || in_value(value.get_ref())
    })
}

fn in_value(value: &DeValue<'_>) -> bool {
    match value {
        DeValue::Table(table) => names_a_file(table),
        DeValue::Array(list) => list.iter().any(|node| in_value(node.get_ref())),
        _ => false,
    }
}
