//! The kernels of a chain with assumptions: files of a crate without dependencies.
//!
//! Invariant: the files are in one folder, `src/kernels`, and read nothing outside it.

use tera::Context;

use super::cost::CountText;
use super::device::Signatures;
use super::error::EmitError;
use super::file::{EmittedFile, kind_file, record_text, rust_file, templates};
use super::target_crate::TargetCrate;
use super::text::fnv1a64;
use crate::derivation::chain::Chain;
use crate::kernel::shared_records;

/// The records of the hub that an evaluation exchanges with a device.
const OF_HUB: [&str; 4] = ["BodyRate", "BodyAcceleration", "HubShare", "ConstantShare"];

/// What is emitted of a chain with assumptions.
#[derive(Clone, Debug)]
pub struct StandaloneKernels {
    /// Its functions.
    pub file: EmittedFile,
    /// Each function, the letters of its arguments and what a call of it costs.
    pub functions: Vec<(String, Vec<&'static str>, usize)>,
}

/// The kernels of a chain with assumptions, written by `command`.
///
/// # Errors
/// When a template fails or the file would not parse.
pub fn standalone_kernels(
    chain: &Chain<'_>,
    command: &str,
) -> Result<StandaloneKernels, EmitError> {
    let (mut counts, mut signatures) = (Vec::new(), Signatures::new());
    let (tera, target) = (templates()?, TargetCrate::Standalone(command));
    let file = kind_file(&tera, chain, target, &mut counts, &mut signatures)?;
    let function = |count: &CountText| {
        let letters = signatures.get(&count.function).map(|s| s.letters.clone());
        (count.function.clone(), letters.unwrap_or_default(), count.total)
    };
    Ok(StandaloneKernels { file, functions: counts.iter().map(function).collect() })
}

/// The records that kernels exchange with the hub.
///
/// # Errors
/// When a template fails or the file would not parse.
pub fn standalone_records(command: &str) -> Result<EmittedFile, EmitError> {
    let shared = shared_records();
    let records = shared.iter().filter(|record| OF_HUB.contains(&record.name.as_str()));
    let target = TargetCrate::Standalone(command);
    let records: Vec<_> = records.map(|record| record_text(record, target)).collect();
    let mut context = Context::new();
    context.insert("command", target.command());
    context.insert("hash", &fnv1a64(&format!("{shared:?}")));
    context.insert("records", &records);
    rust_file(target.path("hub.rs"), templates()?.render("hub.rs", &context)?)
}
