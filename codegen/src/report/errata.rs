//! The errata: what the paper prints, what is right, by which terms they differ, why, and what it
//! does to the paper's scenario.

use serde::Serialize;

use super::derivation::NotationError;
use crate::consequence::{Consequence, DURATION, Drift, Effect, RESOLUTION};
use crate::graph::Graph;
use crate::notation::{Accent, Balance as Weight, equation, side_by_side, symbol, unit};
use crate::page::{Block, Kind, Note, Page, PageError, blocks, read_on};
use crate::verdict::{Cause, Component, Entry, Form, Printed, Verdicts};

/// So many differing terms are listed; of more, the number is told.
const LISTED: usize = 6;

/// What the template is filled with.
#[derive(Serialize)]
pub(super) struct Errata {
    tally: Vec<(String, usize)>,
    differing: usize,
    duration: f64,
    resolution: String,
    floor: DriftText,
    findings: Vec<FindingText>,
    causes: Vec<CauseText>,
    all: Vec<LineText>,
}

#[derive(Serialize)]
struct DriftText {
    energy: String,
    linear: String,
    angular: String,
}

/// One equation that differs.
#[derive(Serialize)]
struct FindingText {
    tag: String,
    title: String,
    in_short: String,
    label: String,
    causes: String,
    forms: Vec<FormText>,
    consequence: String,
    energy: String,
    linear: String,
    angular: String,
}

#[derive(Serialize)]
struct FormText {
    /// Tag of the block, with its special case.
    tag: String,
    /// The equation as printed and as it ought to be; empty where it stands above or is torn.
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

#[derive(Serialize)]
struct CauseText {
    letter: char,
    title: String,
    prose: Vec<String>,
    equations: String,
    mended: Vec<MendedText>,
}

#[derive(Serialize)]
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
    consequences: &[Consequence],
    floor: Drift,
    balance: &Balance,
) -> Result<Errata, NotationError> {
    let differs = |entry: &&Entry| {
        matches!(entry.printed, Printed::Differs { .. } | Printed::Unreadable { .. })
    };
    let mut shown: Vec<(String, usize)> = Vec::new();
    let mut findings = Vec::new();
    for entry in verdicts.entries.iter().filter(differs) {
        findings.push(finding(entry, consequences, balance, &mut shown)?);
    }
    let numbered = verdicts.entries.iter().filter(|entry| entry.number.is_some());
    let differing = numbered.filter(differs).count();
    Ok(Errata {
        tally: verdicts.tally(),
        differing,
        duration: DURATION,
        resolution: format!("{RESOLUTION:.0e}"),
        floor: drift_text(floor),
        findings,
        causes: verdicts.causes.iter().map(cause).collect(),
        all: verdicts.entries.iter().map(line).collect(),
    })
}

/// The printed blocks whose terms are of different units: what no author means.
pub(super) struct Balance(Vec<(String, usize)>);

impl Balance {
    /// Reads the print and weighs every component.
    pub(super) fn of(graph: &Graph, pages: &[Page], printed: &[Page]) -> Result<Self, PageError> {
        let (_, reader) = read_on(graph, pages)?;
        let mut unbalanced = Vec::new();
        for page in printed {
            let stated = blocks(&page.name, &page.text, "printed")?;
            for block in stated.iter().filter(|block| !block.is_words()) {
                let wrong = |error| PageError { page: page.name.clone(), line: block.line, error };
                let value = reader.body(&block.body).map_err(wrong)?;
                let components = reader.resolve(block, value).map_err(wrong)?;
                let units = components.iter().map(|(_, component)| unit(*component));
                // A symbol without a unit is nothing that the print could be blamed for.
                let all = units.flatten().fold(Weight::Any, Weight::with);
                if all == Weight::Not {
                    unbalanced.push(place(block));
                }
            }
        }
        Ok(Self(unbalanced))
    }
}

fn place(block: &Block) -> (String, usize) {
    (block.page.clone(), block.line)
}

fn finding(
    entry: &Entry,
    consequences: &[Consequence],
    balance: &Balance,
    shown: &mut Vec<(String, usize)>,
) -> Result<FindingText, NotationError> {
    let mut forms = Vec::new();
    for form in &entry.forms {
        let above = shown.contains(&place(&form.block));
        shown.push(place(&form.block));
        forms.push(form_text(form, above, balance)?);
    }
    let of_entry = |consequence: &&Consequence| {
        entry.forms.iter().any(|form| {
            place(&form.block) == (consequence.page.clone(), consequence.line)
                && !form.components.is_empty()
        })
    };
    let effects: Vec<_> = consequences.iter().filter(of_entry).collect();
    let several = effects.len() > 1;
    let told: Vec<_> = effects
        .iter()
        .map(|consequence| {
            let name = symbol(&consequence.name, Accent::Plain);
            if several {
                format!("${name}$ {}", consequence.effect)
            } else {
                consequence.effect.to_string()
            }
        })
        .collect();
    let worst = worst(&effects, entry.differing());
    let in_short = entry.in_short.as_deref().unwrap_or_default();
    Ok(FindingText {
        tag: entry.tag.clone(),
        title: entry.title.clone(),
        in_short: in_short.trim_end_matches('.').to_owned(),
        label: entry.printed.label(),
        causes: letters(entry.printed.causes()),
        consequence: told.join("; "),
        energy: worst[0].clone(),
        linear: worst[1].clone(),
        angular: worst[2].clone(),
        forms,
    })
}

/// The largest figures of an equation's forms, or what stands in their place.
fn worst(effects: &[&Consequence], differing: usize) -> [String; 3] {
    let words = |text: &str| [text.to_owned(), String::new(), String::new()];
    let mut largest: Option<Drift> = None;
    for effect in effects {
        match effect.effect {
            Effect::Diverges { .. } | Effect::Singular { .. } => {
                return words(&effect.effect.to_string());
            }
            Effect::Drift(drift) => {
                let before = largest.unwrap_or_default();
                largest = Some(Drift {
                    energy: before.energy.max(drift.energy),
                    linear: before.linear.max(drift.linear),
                    angular: before.angular.max(drift.angular),
                });
            }
            Effect::Unchanged | Effect::Vanishes => {}
        }
    }
    match (largest, effects.first()) {
        (Some(drift), _) => [drift.energy, drift.linear, drift.angular].map(|value| {
            if value < RESOLUTION { format!("< {RESOLUTION:.0e}") } else { format!("{value:.1e}") }
        }),
        (None, _) if effects.iter().any(|effect| effect.effect == Effect::Vanishes) => {
            words("vanishes")
        }
        (None, Some(_)) => words("not reached"),
        (None, None) if differing > 0 => words("special case"),
        (None, None) => words("no value"),
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
        equation(&left, &block.body)
            .map_err(|error| NotationError::Block(format!("{}:{}", block.page, block.line), error))
    };
    let words = block.kind == Kind::Text || above;
    let agrees = form.components.is_empty();
    let given: Vec<_> = block
        .given
        .iter()
        .map(|(a, b)| format!("${} = {}$", symbol(a, Accent::Plain), value(b)))
        .collect();
    let case = if given.is_empty() { String::new() } else { format!(" for {}", given.join(", ")) };
    let notes =
        block.notes.iter().map(|note| note_text(block, note)).collect::<Result<Vec<_>, _>>()?;
    Ok(FormText {
        tag: format!("{}{case}", block.tag),
        printed: if words { String::new() } else { set(block)? },
        right: match &form.right {
            Some(right) if !words && !agrees => set(right)?,
            _ => String::new(),
        },
        above: above && block.kind != Kind::Text,
        terms: terms_text(&form.components),
        unbalanced: balance.0.contains(&place(block)),
        notes,
    })
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
            label => format!(" (along `{label}`)"),
        };
        component.terms.iter().map(move |term| format!("{term}{axis}"))
    });
    let listed = listed.collect::<Vec<_>>().join("; ");
    match count {
        1 => format!("One term of the normal form differs: {listed}."),
        _ if count <= LISTED => format!("{count} terms of the normal form differ: {listed}."),
        _ => format!("{count} terms of the normal form differ."),
    }
}

fn note_text(block: &Block, note: &Note) -> Result<NoteText, NotationError> {
    let wrong = |error| NotationError::Block(format!("{}:{}", block.page, note.line), error);
    let body = if block.kind == Kind::Text { "" } else { &block.body };
    let change = match &note.change {
        Some(change) => {
            let sides = [("printed", change.printed.as_str()), ("right", change.right.as_str())];
            side_by_side(body, &sides).map_err(wrong)?
        }
        None => String::new(),
    };
    let best =
        note.best.as_ref().map(|best| side_by_side(body, &[("best reading", best.as_str())]));
    Ok(NoteText {
        class: note.class.to_string(),
        place: note.place.as_ref().map(|place| format!(", entry {place}")).unwrap_or_default(),
        text: note.words.clone(),
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

fn cause(cause: &Cause) -> CauseText {
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
        prose: cause.prose.clone(),
        equations: cause.entries.join(", "),
        mended: mended.collect(),
    }
}

fn line(entry: &Entry) -> LineText {
    let pages: Vec<String> = entry
        .hand_checked
        .blocks()
        .iter()
        .map(|block| format!("[{0}](../tests/derivation/{0})", block.page))
        .fold(Vec::new(), |mut pages, page| {
            if !pages.contains(&page) {
                pages.push(page);
            }
            pages
        });
    LineText {
        tag: entry.tag.clone(),
        title: entry.title.clone(),
        derived: entry.hand_checked.label().to_owned(),
        pages: pages.join(", "),
        label: entry.printed.label(),
    }
}
