//! The generated page: `docs/mutation.md`, and the same as HTML.

use serde::Serialize;
use tera::Context;

use super::{ReportError, document};
use crate::mutation::{Kind, Law, MutantStatus, NOTICED, Outcome, Report, Tally};
use precess_codegen::emit::EmittedFile;
use precess_codegen::kinds::DGVSCMG;

/// What the template is filled with.
#[derive(Serialize)]
struct Page {
    kinds: [&'static str; 3],
    devices: Vec<DeviceRow>,
    /// What the mutants of kinds other than the one that is listed in full survive as.
    elsewhere: Vec<String>,
    /// The kind that is listed in full.
    name: &'static str,
    functions: Vec<TallyRow>,
    noticed: String,
    margins: Vec<Margin>,
    weakest: Option<Weakest>,
    engines: usize,
    laws: Vec<LawText>,
    equations: Vec<TallyRow>,
    /// Mutants under no number.
    unnumbered: usize,
    survivors: Vec<String>,
    equivalent: Vec<String>,
}

/// A tally and what it counts.
#[derive(Serialize)]
struct TallyRow {
    of: String,
    mutants: usize,
    killed: [usize; 3],
    any: usize,
    equivalent: usize,
    survivors: usize,
}

/// One kind of device.
#[derive(Serialize)]
struct DeviceRow {
    tally: TallyRow,
    weakest: String,
}

/// How far the threshold is from what stays below it and from what exceeds it.
#[derive(Serialize)]
struct Margin {
    kind: &'static str,
    floor: String,
    least: String,
}

#[derive(Serialize)]
struct Weakest {
    signal: String,
    mutant: String,
}

#[derive(Serialize)]
struct LawText {
    kind: &'static str,
    statement: &'static str,
    read: usize,
    killed: usize,
}

/// The page that states what became of every mutant of every kind, and lists the DGVSCMG in full.
/// The same reports give the same bytes.
///
/// # Errors
/// When the template cannot be filled; when no report is of the DGVSCMG, there is no page.
pub fn mutation(reports: &[Report]) -> Result<Option<EmittedFile>, ReportError> {
    let full = |report: &&Report| report.kind.name == DGVSCMG.name;
    let Some(report) = reports.iter().find(full) else { return Ok(None) };
    let elsewhere = reports.iter().filter(|report| !full(report));
    let elsewhere = elsewhere.flat_map(|report| {
        let survivors = report.listed(MutantStatus::Survivor).into_iter();
        survivors.map(|mutant| format!("`{}`: {mutant}", report.kind.name))
    });
    let total = std::iter::once(TallyRow::new("all".to_owned(), report.total()));
    let functions = report.by_kernel().into_iter();
    let functions = functions.map(|(kernel, tally)| TallyRow::new(format!("`{kernel}`"), tally));
    let equations = report.by_tag().into_iter().map(|(tag, tally)| TallyRow::new(tag, tally));
    let page = Page {
        kinds: Kind::ALL.map(Kind::title),
        devices: reports.iter().map(DeviceRow::new).collect(),
        elsewhere: elsewhere.collect(),
        name: report.kind.name,
        functions: functions.chain(total).collect(),
        noticed: format!("{NOTICED:.0e}"),
        margins: Kind::ALL.into_iter().map(|kind| report.margin(kind)).collect(),
        weakest: report.weakest(),
        engines: report.engines,
        laws: Law::ALL.into_iter().map(|law| report.law(law)).collect(),
        equations: equations.collect(),
        unnumbered: report.unnumbered(),
        survivors: report.listed(MutantStatus::Survivor),
        equivalent: report.listed(MutantStatus::Equivalent),
    };
    let mut context = Context::new();
    context.insert("page", &page);
    document("docs/mutation", include_str!("templates/mutation.md.tera"), &context).map(Some)
}

impl DeviceRow {
    fn new(report: &Report) -> Self {
        let weakest = report.weakest().map(|weakest| weakest.signal);
        let tally = TallyRow::new(format!("`{}`", report.kind.name), report.total());
        Self { tally, weakest: weakest.unwrap_or_default() }
    }
}

impl Report {
    fn margin(&self, kind: Kind) -> Margin {
        let floors = self.floors.iter().filter(|(law, _)| law.kind() == kind);
        let floor = floors.map(|(_, residual)| *residual).fold(0.0, f64::max);
        let signals = self.outcomes.iter().map(|outcome| outcome.signal(kind));
        let least = signals.filter(|signal| *signal > NOTICED).fold(f64::INFINITY, f64::min);
        let [floor, least] = [floor, least].map(|residual| format!("{residual:.0e}"));
        Margin { kind: kind.title(), floor, least }
    }

    /// The killed mutant whose strongest signal is the weakest.
    fn weakest(&self) -> Option<Weakest> {
        let strongest = |outcome: &Outcome| {
            Kind::ALL.map(|kind| outcome.signal(kind)).into_iter().fold(0.0, f64::max)
        };
        let killed = self.outcomes.iter().filter(|outcome| outcome.killed());
        let weakest = killed.min_by(|a, b| strongest(a).total_cmp(&strongest(b)))?;
        let signal = format!("{:.0e}", strongest(weakest));
        Some(Weakest { signal, mutant: shown(weakest) })
    }

    fn law(&self, law: Law) -> LawText {
        let all = self.outcomes.iter().flat_map(|outcome| &outcome.signals);
        let own: Vec<f64> = all.filter(|(of, _)| *of == law).map(|(_, r)| *r).collect();
        let killed = own.iter().filter(|residual| **residual > NOTICED).count();
        let (kind, statement) = (law.kind().title(), law.statement());
        LawText { kind, statement, read: own.len(), killed }
    }

    fn listed(&self, status: MutantStatus) -> Vec<String> {
        self.outcomes.iter().filter(|outcome| outcome.status == status).map(shown).collect()
    }
}

impl TallyRow {
    fn new(of: String, tally: Tally) -> Self {
        let Tally { mutants, killed, any, equivalent, survivors } = tally;
        Self { of, mutants, killed, any, equivalent, survivors }
    }
}

/// A mutant with its place.
fn shown(outcome: &Outcome) -> String {
    let mutant = &outcome.mutant;
    format!(
        "`{}`, {}: {} `{}` of `{}`",
        mutant.kernel, mutant.name, mutant.change, mutant.operand, mutant.whole
    )
}
