//! The errata: what the paper prints, what is right, by which terms they differ, why, and what it
//! does to the paper's scenario.

use serde::Serialize;

use super::balance::Balance;
use super::derivation::NotationError;
use super::figures::Figures;
use super::page_links;
use super::words::mathematics;
use crate::consequence::{Consequence, DURATION, Drift, Effect, RESOLUTION, table1};
use crate::notation::{Accent, equation, expression, side_by_side, symbol};
use crate::verdict::{Cause, Component, Counts, Entry, Form, Verdicts};
use precess_codegen::page::{Block, Kind, Note};

/// A change of so many characters is written on the line of its note.
const INLINE: usize = 100;
/// So many differing terms are listed; of more, the number is stated.
const LISTED: usize = 6;

/// What the templates of the errata and of the letter are filled with.
#[derive(Serialize)]
pub(super) struct Errata {
    tally: Vec<(String, usize)>,
    counts: Counts,
    /// Length of the run that the figures are of, s.
    duration: String,
    /// The wheel's offset, mm, and its motor's torque, mN m, in that run.
    offset: String,
    motor: String,
    resolution: String,
    floor: DriftText,
    parts: [PartText; 2],
    causes: Vec<CauseText>,
    /// The cause of most slips.
    most: Option<CauseText>,
    /// The other causes of slips, from the one that does most on Table 1 to those that vanish there.
    weighed: Vec<CauseText>,
    all: Vec<LineText>,
}

#[derive(Serialize)]
struct DriftText {
    energy: String,
    linear: String,
    angular: String,
}

/// Equations that differ.
#[derive(Serialize)]
struct PartText {
    /// With a slip, or with what cannot be distinguished from one; otherwise the scan explains everything.
    papers: bool,
    findings: Vec<FindingText>,
}

/// One equation that differs.
#[derive(Serialize)]
struct FindingText {
    tag: String,
    title: String,
    in_short: String,
    label: String,
    of_the_paper: bool,
    causes: String,
    forms: Vec<FormText>,
    /// What the form as read does, and what only its slips do.
    as_read: String,
    slips: String,
    energy: String,
    linear: String,
    angular: String,
}

#[derive(Serialize)]
struct FormText {
    /// Tag of the block, with its special case.
    tag: String,
    /// The equation as printed and as it ought to be; empty where it is above or torn.
    printed: String,
    right: String,
    above: bool,
    terms: String,
    unbalanced: bool,
    notes: Vec<NoteText>,
}

#[derive(Serialize)]
struct NoteText {
    class: String,
    place: String,
    text: String,
    change: String,
    best: String,
    tried: String,
    how: String,
    causes: String,
}

#[derive(Clone, Serialize)]
struct CauseText {
    letter: char,
    title: String,
    in_short: String,
    prose: Vec<String>,
    equations: String,
    /// How many differences that are slips have it.
    slips: usize,
    mended: Vec<MendedText>,
    /// What all its differences do to Table 1.
    effect: String,
}

#[derive(Clone, Serialize)]
struct MendedText {
    equation: String,
    before: usize,
    alone: usize,
    so_far: usize,
    all: usize,
}

/// One line of the table of all equations.
#[derive(Serialize)]
struct LineText {
    tag: String,
    title: String,
    derived: String,
    pages: String,
    label: String,
}

/// The errata of a verdict.
pub(super) fn errata(
    verdicts: &Verdicts,
    figures: &Figures,
    balance: &Balance,
) -> Result<Errata, NotationError> {
    let told = |entry: &&Entry| entry.differs() || entry.is_lost() || entry.is_contradicted();
    let mut shown = Vec::new();
    let mut findings = Vec::new();
    for entry in verdicts.entries.iter().filter(told) {
        findings.push(finding(entry, figures, balance, &mut shown)?);
    }
    let (papers, scans) =
        findings.into_iter().partition(|finding: &FindingText| finding.of_the_paper);
    let causes: Vec<_> =
        verdicts.causes.iter().map(|cause| cause_text(cause, verdicts, figures)).collect();
    let most = causes.iter().max_by_key(|cause| cause.slips).cloned();
    let first = most.as_ref().map(|cause| cause.letter);
    let weighed = weighed(&causes, figures).into_iter();
    let weighed = weighed.filter(|cause| Some(cause.letter) != first);
    Ok(Errata {
        tally: verdicts.tally(),
        counts: verdicts.counts(),
        duration: DURATION.to_string(),
        offset: (table1::parameter("d").unwrap_or_default() * 1e3).to_string(),
        motor: (table1::TORQUES[2] * 1e3).to_string(),
        resolution: format!("{RESOLUTION:.0e}"),
        floor: drift_text(figures.floor),
        parts: [
            PartText { papers: true, findings: papers },
            PartText { papers: false, findings: scans },
        ],
        most,
        weighed: weighed.collect(),
        causes,
        all: verdicts.entries.iter().map(line).collect(),
    })
}

fn finding(
    entry: &Entry,
    figures: &Figures,
    balance: &Balance,
    shown: &mut Vec<String>,
) -> Result<FindingText, NotationError> {
    let mut forms = Vec::new();
    for form in &entry.forms {
        let above = shown.contains(&form.block.place());
        shown.push(form.block.place());
        forms.push(form_text(form, above, balance)?);
    }
    let of_entry = |consequence: &&Consequence| {
        entry.forms.iter().any(|form| {
            let Block { page, line, .. } = &form.block;
            (page, *line) == (&consequence.page, consequence.line) && !form.components.is_empty()
        })
    };
    let as_read: Vec<_> = figures.forms.iter().filter(of_entry).collect();
    let several = as_read.len() > 1;
    let as_read = as_read.iter().map(|consequence| {
        let name = symbol(&consequence.name, Accent::Plain);
        let name = if several { format!("${name}$ ") } else { String::new() };
        format!("{name}{}", consequence.effect)
    });
    let slips = figures.of_entry(&entry.tag);
    let [energy, linear, angular] = columns(slips);
    let in_short = entry.in_short.as_deref().unwrap_or_default();
    Ok(FindingText {
        tag: entry.tag.clone(),
        title: mathematics(&entry.title),
        in_short: mathematics(in_short.trim_end_matches('.')),
        of_the_paper: entry.is_papers() || entry.is_contradicted(),
        label: entry.printed.label(),
        causes: letters(entry.printed.causes()),
        as_read: as_read.collect::<Vec<_>>().join("; "),
        slips: slips.map(|effect| effect.to_string()).unwrap_or_default(),
        energy,
        linear,
        angular,
        forms,
    })
}

/// An effect in three columns, in words where there is no figure.
fn columns(effect: Option<Effect>) -> [String; 3] {
    let words = |text: String| [text, String::new(), String::new()];
    match effect {
        None => words(String::new()),
        Some(Effect::Vanishes) => words("vanishes".to_owned()),
        Some(Effect::Unchanged) => words("not reached".to_owned()),
        Some(effect @ (Effect::Diverges { .. } | Effect::Singular { .. })) => {
            words(effect.to_string())
        }
        Some(Effect::Drift(drift)) => [drift.energy, drift.linear, drift.angular].map(|value| {
            let resolved = value >= RESOLUTION;
            if resolved { format!("{value:.1e}") } else { format!("< {RESOLUTION:.0e}") }
        }),
    }
}

fn drift_text(drift: Drift) -> DriftText {
    let [energy, linear, angular] =
        [drift.energy, drift.linear, drift.angular].map(|value| format!("{value:.1e}"));
    DriftText { energy, linear, angular }
}

fn form_text(form: &Form, above: bool, balance: &Balance) -> Result<FormText, NotationError> {
    let block = &form.block;
    let set = |block: &Block| {
        let left = symbol(&form.block.name, Accent::Plain);
        equation(&left, &block.body).map_err(|error| NotationError::Block(block.place(), error))
    };
    let words = block.kind == Kind::Text || above;
    let agrees = form.components.is_empty();
    // Of a block that several numbers share, what concerns them all is with the first.
    let notes = block.notes.iter().filter(|note| !above || note.place.is_some());
    let notes = notes.map(|note| note_text(block, note)).collect::<Result<Vec<_>, _>>()?;
    Ok(FormText {
        tag: tag_and_case(block),
        printed: if words { String::new() } else { set(block)? },
        right: match &form.right {
            Some(right) if !words && !agrees => set(right)?,
            _ => String::new(),
        },
        above: above && block.kind != Kind::Text,
        terms: terms_text(&form.components),
        unbalanced: balance.fails(block),
        notes,
    })
}

/// The tag of a block, with the special case in which it holds.
pub(super) fn tag_and_case(block: &Block) -> String {
    let given = block.given.iter();
    let given: Vec<_> =
        given.map(|(a, b)| format!("${} = {}$", symbol(a, Accent::Plain), value(b))).collect();
    if given.is_empty() {
        block.tag.clone()
    } else {
        format!("{} for {}", block.tag, given.join(", "))
    }
}

fn value(text: &str) -> String {
    if text.starts_with(char::is_numeric) { text.to_owned() } else { symbol(text, Accent::Plain) }
}

/// The machine's own account: the differing terms, or how many there are.
fn terms_text(components: &[Component]) -> String {
    let count: usize = components.iter().map(|component| component.terms.len()).sum();
    if count == 0 {
        return String::new();
    }
    let listed = components.iter().flat_map(|component| {
        let axis = match component.label.as_str() {
            "" => String::new(),
            label if label.starts_with(char::is_numeric) => format!(" (entry {label})"),
            label => format!(" (along `{label}_hat`)"),
        };
        component.terms.iter().map(move |term| format!("{term}{axis}"))
    });
    let listed = listed.collect::<Vec<_>>().join("; ");
    match count {
        1 => format!("One term of the normal form differs: {}.", mathematics(&listed)),
        _ if count <= LISTED => {
            format!("{count} terms of the normal form differ: {}.", mathematics(&listed))
        }
        _ => format!("{count} terms of the normal form differ."),
    }
}

fn note_text(block: &Block, note: &Note) -> Result<NoteText, NotationError> {
    let wrong = |error| NotationError::Block(format!("{}:{}", block.page, note.line), error);
    let body = if block.kind == Kind::Text { "" } else { &block.body };
    let mut inline = String::new();
    let change = match &note.change {
        Some(change) => {
            let sides = [("printed", change.printed.as_str()), ("right", change.right.as_str())];
            let length = change.printed.len() + change.right.len();
            if length > INLINE || note.best.is_some() {
                side_by_side(body, &sides).map_err(wrong)?
            } else {
                let [printed, right] = sides.map(|(_, side)| match side {
                    "0" => Ok("nothing".to_owned()),
                    side => expression(body, side).map(|latex| format!("${latex}$")),
                });
                inline = format!("{} → {}", printed.map_err(wrong)?, right.map_err(wrong)?);
                String::new()
            }
        }
        None => String::new(),
    };
    let best =
        note.best.as_ref().map(|best| side_by_side(body, &[("best reading", best.as_str())]));
    Ok(NoteText {
        class: note.class.to_string(),
        place: note.place.as_ref().map(|place| format!(", entry {place}")).unwrap_or_default(),
        text: [inline.as_str(), note.words.as_str()]
            .into_iter()
            .filter(|part| !part.is_empty())
            .collect::<Vec<_>>()
            .join("; "),
        change,
        best: best.transpose().map_err(wrong)?.unwrap_or_default(),
        tried: note.tried.clone().unwrap_or_default(),
        how: note.how.clone().unwrap_or_default(),
        causes: letters(&note.causes),
    })
}

fn letters(causes: &[char]) -> String {
    causes.iter().map(char::to_string).collect::<Vec<_>>().join(", ")
}

/// The causes of slips, heaviest first.
fn weighed(causes: &[CauseText], figures: &Figures) -> Vec<CauseText> {
    let mut causes: Vec<_> = causes.iter().filter(|cause| cause.slips > 0).cloned().collect();
    let weight = |cause: &CauseText| figures.of_cause(cause.letter).map_or(0.0, weight);
    causes.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    causes
}

/// The largest drift.
fn weight(effect: Effect) -> f64 {
    match effect {
        Effect::Diverges { .. } | Effect::Singular { .. } => f64::INFINITY,
        Effect::Drift(Drift { energy, linear, angular }) => energy.max(linear).max(angular),
        Effect::Vanishes | Effect::Unchanged => 0.0,
    }
}

fn cause_text(cause: &Cause, verdicts: &Verdicts, figures: &Figures) -> CauseText {
    let mended = cause.mended.iter().map(|mended| MendedText {
        equation: format!("{} ${}$", mended.tag, symbol(&mended.name, Accent::Plain)),
        before: mended.before,
        alone: mended.alone,
        so_far: mended.so_far,
        all: mended.all,
    });
    CauseText {
        letter: cause.letter,
        title: cause.title.clone(),
        in_short: cause.in_short.trim_end_matches('.').to_owned(),
        prose: cause.prose.clone(),
        slips: verdicts.slips_of(cause.letter),
        equations: cause.entries.join(", "),
        mended: mended.collect(),
        effect: figures.of_cause(cause.letter).map(|effect| effect.to_string()).unwrap_or_default(),
    }
}

fn line(entry: &Entry) -> LineText {
    LineText {
        tag: entry.tag.clone(),
        title: entry.title.clone(),
        derived: entry.derivation().to_owned(),
        pages: page_links(entry),
        label: entry.printed.label(),
    }
}
