//! The generated page: `docs/mutation.md`, and the same as HTML.

use serde::Serialize;
use tera::Context;

use super::NOTICED;
use super::physics::{Kind, Law};
use super::report::{Fate, Outcome, Report, Tally};
use crate::emit::EmittedFile;
use crate::report::{ReportError, document};

/// What the template is filled with.
#[derive(Serialize)]
struct Page {
    kinds: [&'static str; 3],
    functions: Vec<Row>,
    noticed: String,
    margins: Vec<Margin>,
    weakest: Option<Weakest>,
    engines: usize,
    laws: Vec<LawText>,
    equations: Vec<Row>,
    /// Mutants that stand under no number.
    unnumbered: usize,
    survivors: Vec<String>,
    equivalent: Vec<String>,
}

/// A tally and what it counts.
#[derive(Serialize)]
struct Row {
    of: String,
    mutants: usize,
    killed: [usize; 3],
    any: usize,
    equivalent: usize,
    survivors: usize,
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

impl Report {
    /// The page that states what became of every mutant. The same report gives the same bytes.
    ///
    /// # Errors
    /// When the template cannot be filled.
    pub fn page(&self) -> Result<Vec<EmittedFile>, ReportError> {
        let total = std::iter::once(Row::new("all".to_owned(), self.total()));
        let functions = self.by_kernel().into_iter();
        let functions = functions.map(|(kernel, tally)| Row::new(format!("`{kernel}`"), tally));
        let equations = self.by_tag().into_iter().map(|(tag, tally)| Row::new(tag, tally));
        let page = Page {
            kinds: Kind::ALL.map(Kind::title),
            functions: functions.chain(total).collect(),
            noticed: format!("{NOTICED:.0e}"),
            margins: Kind::ALL.into_iter().map(|kind| self.margin(kind)).collect(),
            weakest: self.weakest(),
            engines: self.engines,
            laws: Law::ALL.into_iter().map(|law| self.law(law)).collect(),
            equations: equations.collect(),
            unnumbered: self.unnumbered(),
            survivors: self.listed(Fate::Survivor),
            equivalent: self.listed(Fate::Equivalent),
        };
        let mut context = Context::new();
        context.insert("page", &page);
        document("docs/mutation", include_str!("templates/mutation.md.tera"), &context, &[])
    }

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

    fn listed(&self, fate: Fate) -> Vec<String> {
        self.outcomes.iter().filter(|outcome| outcome.fate == fate).map(shown).collect()
    }
}

impl Row {
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
