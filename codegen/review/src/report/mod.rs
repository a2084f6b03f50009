//! The documents that are generated with the code, as Markdown.

mod balance;
mod derivation;
mod errata;
mod figures;
mod frames;
mod kinds;
mod mutation;
mod traceability;
mod words;

use std::fmt;

use balance::Balance;
pub use derivation::NotationError;
use figures::Figures;
pub use kinds::KindText;
pub use mutation::mutation;
use tera::{Context, Tera};

use crate::consequence::ConsequenceError;
use crate::mutation::Report;
use crate::verdict::{Entry, Verdicts};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::EmittedFile;
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::page::{Block, Page, PageError};

/// Why a document cannot be laid out: a fault of the generator, or of a page that it sets.
#[derive(Debug)]
pub enum ReportError {
    /// Something cannot be set as mathematics.
    Notation(NotationError),
    /// A template failed.
    Template(tera::Error),
    /// A page cannot be read.
    Page(PageError),
    /// The print cannot be put into the system.
    Consequence(ConsequenceError),
}

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Notation(error) => error.fmt(f),
            Self::Template(error) => write!(f, "template: {error}"),
            Self::Page(error) => error.fmt(f),
            Self::Consequence(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ReportError {}

impl From<NotationError> for ReportError {
    fn from(error: NotationError) -> Self {
        Self::Notation(error)
    }
}

impl From<tera::Error> for ReportError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}

impl From<PageError> for ReportError {
    fn from(error: PageError) -> Self {
        Self::Page(error)
    }
}

impl From<ConsequenceError> for ReportError {
    fn from(error: ConsequenceError) -> Self {
        Self::Consequence(error)
    }
}

/// The derivation, printed.
///
/// # Errors
/// When a block or a quantity cannot be set.
pub fn derivation(chain: &Chain<'_>, blocks: &[Block]) -> Result<Vec<EmittedFile>, ReportError> {
    let mut context = Context::new();
    context.insert("derivation", &derivation::derivation(chain, blocks)?);
    let template = include_str!("templates/derivation.md.tera");
    let picture = frames::drawing(chain);
    let page = document("docs/derivation", template, &context)?;
    Ok(vec![page, EmittedFile { path: "docs/frames.svg".to_owned(), text: picture }])
}

/// The kinds: chains, symbols, what is zero, costs.
///
/// # Errors
/// When a symbol cannot be set.
pub fn kinds(kinds: &[KindText]) -> Result<EmittedFile, ReportError> {
    let mut context = Context::new();
    context.insert("kinds", kinds);
    context.insert("costs", &kinds::Costs::of_kinds(kinds));
    document("docs/kinds", include_str!("templates/kinds.md.tera"), &context)
}

/// The errata of the paper: what is printed, what is right, and what the difference does; and the
/// letter that says it to its authors on one page.
///
/// # Errors
/// When a block or a note cannot be set, or the print cannot be put into the system.
pub fn errata(
    pages: &[Page],
    printed: &[Page],
    verdicts: &Verdicts,
) -> Result<Vec<EmittedFile>, ReportError> {
    let graph = Graph::new();
    let _symbols = Chain::new(&graph, &DGVSCMG);
    let balance = Balance::of_pages(&graph, pages, printed)?;
    let figures = Figures::of_pages(pages, printed, verdicts)?;
    let mut context = Context::new();
    context.insert("errata", &errata::errata(verdicts, &figures, &balance)?);
    let [errata, letter] =
        [include_str!("templates/errata.md.tera"), include_str!("templates/letter.md.tera")];
    Ok(vec![document("docs/errata", errata, &context)?, document("docs/letter", letter, &context)?])
}

/// From each equation to the line, the page, the code and the laws that see it wrong; `sources` are
/// the files of the derivation, by path from the repository's root.
///
/// # Errors
/// When a title cannot be set.
pub fn traceability(
    verdicts: &Verdicts,
    report: &Report,
    sources: &[Page],
) -> Result<EmittedFile, ReportError> {
    let mut context = Context::new();
    context.insert("trace", &traceability::traceability(verdicts, report, sources));
    let template = include_str!("templates/traceability.md.tera");
    document("docs/traceability", template, &context)
}

/// The pages that work an equation out, each once.
fn page_links(entry: &Entry) -> String {
    let mut pages: Vec<String> = Vec::new();
    for block in entry.hand_checked.blocks() {
        let page = &block.page;
        let link = format!("[{page}](../tests/derivation/{page})");
        if !pages.contains(&link) {
            pages.push(link);
        }
    }
    pages.join(", ")
}

/// A document.
fn document(path: &str, template: &str, context: &Context) -> Result<EmittedFile, ReportError> {
    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    tera.add_raw_template("document", template)?;
    let text = tera.render("document", context)?;
    Ok(EmittedFile { path: format!("{path}.md"), text })
}
