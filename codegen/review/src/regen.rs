//! Regeneration: hand-checked pages in, proofs and files out. Pure; reading and writing is xtask's.

use std::fmt;
use std::thread::scope;

use crate::report::{self, KindText, ReportError};
use crate::verdict::{JudgementError, VerdictError, Verdicts, verdicts};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::quantities::quantities;
use precess_codegen::emit::{self, EmitError, Emitted, EmittedFile, TargetCrate, shared};
use precess_codegen::graph::Graph;
use precess_codegen::kinds::{DGVSCMG, KINDS, Kind, REGISTRY};
use precess_codegen::normal::Ring;
use precess_codegen::page::{Page, PageError, read};
use precess_codegen::proof::{Comparison, EmittedError, KernelPages, against_pages, prove_kind};
use precess_codegen::threads::{joined, side_by_side};

/// The hand-checked pages, and what is printed.
#[derive(Clone, Debug)]
pub struct Pages {
    /// The paper's equations.
    pub paper: Vec<Page>,
    /// Our own equations that the kernels rest on.
    pub kernels: Vec<Page>,
    /// Those of the elimination.
    pub elimination: Vec<Page>,
    /// The paper's equations as printed.
    pub printed: Vec<Page>,
}

/// What a regeneration yields.
#[derive(Clone, Debug)]
pub struct Regeneration {
    /// The files, by path from the repository's root.
    pub files: Vec<EmittedFile>,
    /// The proofs.
    pub rows: Vec<Comparison>,
    /// What is said of each equation as it is printed; nothing when a proof before it fails.
    pub verdicts: Verdicts,
}

impl Regeneration {
    /// Whether every row is a proof.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.rows.iter().all(Comparison::holds)
    }
}

/// Why there is nothing to compare.
#[derive(Debug)]
pub enum RegenError {
    /// A hand-checked page cannot be read.
    Page(PageError),
    /// A file cannot be laid out.
    Emit(EmitError),
    /// Emitted text cannot be read back.
    Emitted(EmittedError),
    /// A document cannot be laid out.
    Report(ReportError),
    /// The print, its notes and their causes do not fit together.
    Verdict(VerdictError),
}

impl fmt::Display for RegenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Page(error) => error.fmt(f),
            Self::Emit(error) => error.fmt(f),
            Self::Emitted(error) => error.fmt(f),
            Self::Report(error) => error.fmt(f),
            Self::Verdict(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RegenError {}

impl From<PageError> for RegenError {
    fn from(error: PageError) -> Self {
        Self::Page(error)
    }
}

impl From<EmitError> for RegenError {
    fn from(error: EmitError) -> Self {
        Self::Emit(error)
    }
}

impl From<EmittedError> for RegenError {
    fn from(error: EmittedError) -> Self {
        Self::Emitted(error)
    }
}

impl From<ReportError> for RegenError {
    fn from(error: ReportError) -> Self {
        Self::Report(error)
    }
}

impl From<JudgementError> for RegenError {
    fn from(error: JudgementError) -> Self {
        match error {
            JudgementError::Page(error) => Self::Page(error),
            JudgementError::Verdict(error) => Self::Verdict(error),
        }
    }
}

/// Derives, emits and proves every kind, and judges the print: side by side, in one order.
///
/// # Errors
/// When a page or an emitted file cannot be read, or when an equation of the paper lacks its
/// verdict. A failed proof is no error but a row.
pub fn regenerate(all: &Pages) -> Result<Regeneration, RegenError> {
    let (pages, printed) = (&all.paper[..], &all.printed[..]);
    let (kinds, by_hand, own, verdicts, documents) = scope(|threads| {
        let by_hand = threads.spawn(|| prove_pages(pages));
        let own = threads.spawn(|| prove_kernel_pages(all));
        let verdicts = threads.spawn(|| verdicts(pages, printed));
        let documents = threads.spawn(|| documents(pages));
        let kinds = side_by_side(KINDS, of_kind);
        (kinds, joined(by_hand), joined(own), joined(verdicts), joined(documents))
    });
    let (mut rows, mut emitted, mut told) = (by_hand?, Vec::new(), Vec::new());
    rows.extend(own?);
    for kind in kinds {
        let Proven { files, text, rows: proofs } = kind?;
        emitted.push(files);
        told.push(text);
        rows.extend(proofs);
    }
    let shared = shared(&REGISTRY, &emitted)?;
    let files = emitted.into_iter().flat_map(|kind| kind.files).chain(shared);
    let mut files: Vec<_> = files.collect();
    // The print is judged by pages that hold, and documents state nothing else: what was found
    // meanwhile is worth nothing where a proof fails.
    if !rows.iter().all(Comparison::holds) {
        return Ok(Regeneration { files, rows, verdicts: Verdicts::default() });
    }
    let verdicts = verdicts?;
    rows.extend(verdicts.rows.iter().cloned());
    files.extend(documents?);
    files.push(report::kinds(&told)?);
    files.extend(report::errata(pages, printed, &verdicts)?);
    Ok(Regeneration { files, rows, verdicts })
}

/// One kind: what is emitted, what is stated of it, what is proven.
struct Proven {
    files: Emitted,
    text: KindText,
    rows: Vec<Comparison>,
}

/// One kind, from its derivation to its proofs.
fn of_kind(kind: &'static Kind) -> Result<Proven, RegenError> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, kind);
    let files = emit::of_kind(&chain, TargetCrate::Dynamics)?;
    let rows = prove_kind(&chain, &files.files)?;
    Ok(Proven { text: KindText::of_chain(&chain, &files), files, rows })
}

/// The documents that print what was derived.
///
/// # Errors
/// When a page cannot be read or set.
pub fn documents(pages: &[Page]) -> Result<Vec<EmittedFile>, RegenError> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let blocks: Vec<_> = read(&graph, pages)?.into_iter().map(|e| e.block).collect();
    Ok(report::derivation(&chain, &blocks)?)
}

/// Compares the pages with the derivation; they are of one kind only.
fn prove_pages(pages: &[Page]) -> Result<Vec<Comparison>, RegenError> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let equations = read(&graph, pages)?;
    let rows = against_pages(&mut Ring::new(&graph), &chain, &quantities(&chain), &equations);
    Ok(rows.into_iter().map(|row| row.about(&DGVSCMG)).collect())
}

/// Compares the pages of our own equations with the kernels that rest on them.
fn prove_kernel_pages(pages: &Pages) -> Result<Vec<Comparison>, RegenError> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut rows = KernelPages::composites(&chain, &pages.paper, &pages.kernels)?.rows();
    rows.extend(KernelPages::elimination(&chain, &pages.elimination)?.rows());
    Ok(rows.into_iter().map(|row| row.about(&DGVSCMG)).collect())
}
