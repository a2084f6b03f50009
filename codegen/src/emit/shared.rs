//! Every file of the emitted code: those of each kind, and what the kinds share.

use tera::Context;

use super::file::{EmitError, Emitted, EmittedFile, of_kind, record_text, rust_file, templates};
use super::home::Home;
use super::text::fnv1a64;
use crate::derivation::chain::Chain;
use crate::graph::Graph;
use crate::kernel::shared_records;
use crate::kinds::KINDS;

/// Every file of the emitted code and the table of operations, for these chains.
///
/// # Errors
/// When a template fails or a file would not parse.
pub fn files(chains: &[Chain<'_>]) -> Result<Vec<EmittedFile>, EmitError> {
    let kinds = chains.iter().map(|chain| of_kind(chain, Home::Dynamics));
    let kinds = kinds.collect::<Result<Vec<_>, _>>()?;
    let shared = shared(&kinds)?;
    Ok(kinds.into_iter().flat_map(|kind| kind.files).chain(shared).collect())
}

/// What these kinds share: the hub's records, the list of modules, the table of operations.
///
/// # Errors
/// When a template fails or a file would not parse.
pub fn shared(kinds: &[Emitted]) -> Result<Vec<EmittedFile>, EmitError> {
    let tera = templates()?;
    let rust_file = |name: &str, text| rust_file(Home::Dynamics.path(name), text);
    let records: Vec<_> = shared_records().iter().map(record_text).collect();
    let mut context = Context::new();
    context.insert("hash", &fnv1a64(&format!("{:?}", shared_records())));
    context.insert("records", &records);
    let hub = rust_file("hub.rs", tera.render("hub.rs", &context)?)?;

    let mut modules: Vec<_> = kinds.iter().map(|kind| kind.module).collect();
    modules.push("hub");
    modules.sort_unstable();
    let mut context = Context::new();
    context.insert("hash", &fnv1a64(&modules.join(" ")));
    context.insert("modules", &modules);
    let mut types: Vec<_> =
        kinds.iter().map(|kind| [kind.module.to_owned(), kind.device_type.clone()]).collect();
    types.sort_unstable();
    context.insert("kinds", &types);
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

/// Derives every kind and lays out the files.
///
/// # Errors
/// When a file cannot be laid out.
pub fn every_kind() -> Result<Vec<EmittedFile>, EmitError> {
    let graphs: Vec<_> = KINDS.iter().map(|_| Graph::new()).collect();
    let pairs = graphs.iter().zip(KINDS);
    let chains: Vec<_> = pairs.map(|(graph, kind)| Chain::new(graph, kind)).collect();
    files(&chains)
}
