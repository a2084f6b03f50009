//! Every file of the emitted code: those of each kind, and what the kinds share.
//!
//! The list of kinds is that of the registry, whatever chains are emitted beside it.

use tera::Context;

use super::error::EmitError;
use super::file::{Emitted, EmittedFile, of_kind, record_text, rust_file, templates};
use super::target_crate::TargetCrate;
use super::text::fnv1a64;
use crate::derivation::chain::Chain;
use crate::kernel::shared_records;
use crate::kinds::{Entry, REGISTRY};

/// Every file of the emitted code and the table of operations, for these chains.
///
/// # Errors
/// When a template fails or a file would not parse.
pub fn files(chains: &[Chain<'_>]) -> Result<Vec<EmittedFile>, EmitError> {
    let kinds = chains.iter().map(|chain| of_kind(chain, TargetCrate::Dynamics));
    let kinds = kinds.collect::<Result<Vec<_>, _>>()?;
    let shared = shared(&REGISTRY, &kinds)?;
    Ok(kinds.into_iter().flat_map(|kind| kind.files).chain(shared).collect())
}

/// What the kinds share: the hub's records, the list of the registry's kinds, and the table of
/// operations of what is emitted.
///
/// # Errors
/// When a template fails or a file would not parse.
pub fn shared(registry: &[Entry], kinds: &[Emitted]) -> Result<Vec<EmittedFile>, EmitError> {
    let tera = templates()?;
    let target = TargetCrate::Dynamics;
    let rust_file = |name: &str, text| rust_file(target.path(name), text);
    let records = shared_records();
    let records: Vec<_> = records.iter().map(|record| record_text(record, target)).collect();
    let mut context = Context::new();
    context.insert(
        "hash",
        &fnv1a64(&(format!("{:?}", shared_records()) + include_str!("templates/hub.rs.tera"))),
    );
    context.insert("command", TargetCrate::Dynamics.command());
    context.insert("records", &records);
    let hub = rust_file("hub.rs", tera.render("hub.rs", &context)?)?;

    let mut context = Context::new();
    let mut listed: Vec<_> = registry
        .iter()
        .map(|entry| (entry.kind.type_name(), entry.kind.name, entry.number))
        .collect();
    context
        .insert("hash", &fnv1a64(&(format!("{listed:?}") + include_str!("templates/mod.rs.tera"))));
    context.insert("kinds", &listed);
    listed.sort_unstable_by_key(|(_, module, _)| *module);
    context.insert("by_module", &listed);
    let mut modules: Vec<_> = listed.iter().map(|(_, module, _)| *module).chain(["hub"]).collect();
    modules.sort_unstable();
    context.insert("modules", &modules);
    let list = rust_file("mod.rs", tera.render("mod.rs", &context)?)?;

    let mut context = Context::new();
    let rows: Vec<_> = kinds.iter().flat_map(|kind| &kind.counts).collect();
    context.insert("rows", &rows);
    let passes: Vec<_> = kinds.iter().map(Emitted::passes).collect();
    context.insert("passes", &passes);
    let factoring: Vec<_> = kinds.iter().map(|kind| (kind.module, &kind.factoring)).collect();
    context.insert("factoring", &factoring);
    let text = tera.render("operations.md", &context)?;
    Ok(vec![hub, list, EmittedFile { path: "docs/operations.md".to_owned(), text }])
}
