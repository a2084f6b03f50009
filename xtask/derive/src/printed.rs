//! `regen --printed`: the three-way verdict on every equation of the paper, and the causes.

use precess_review::verdict::{Cause, Component, Entry, Mended, Verdicts};

use xtask::say;

/// So many differing terms of an equation are listed, the others counted: past these a reader wants
/// the notes, which say in one line what a thousand terms of the normal form do.
const SHOWN: usize = 40;

/// Prints the table, the differing terms and what each mend mends.
pub(crate) fn show(verdicts: &Verdicts) {
    let heading = ["equation", "derivation = page", "print = page", "terms", "causes"];
    row(&heading.map(str::to_owned), "states");
    for entry in &verdicts.entries {
        row(&cells(entry), &entry.title);
    }
    say!("");
    for entry in verdicts.entries.iter().filter(|entry| entry.differing() > 0) {
        differing(entry);
    }
    say!("");
    let heading = ["mend", "", "before", "alone", "so far", "all"].map(str::to_owned);
    mend_row(&heading);
    for cause in &verdicts.causes {
        mends(cause);
    }
    say!("");
    for (label, count) in verdicts.tally() {
        say!("{count:>4} {label}");
    }
}

fn cells(entry: &Entry) -> [String; 5] {
    let terms = match entry.differing() {
        0 => String::new(),
        terms => terms.to_string(),
    };
    let causes: Vec<_> = entry.printed.causes().iter().map(char::to_string).collect();
    let hand_checked = entry.hand_checked.label().to_owned();
    [entry.tag.clone(), hand_checked, entry.printed.label(), terms, causes.join(" ")]
}

fn row([tag, derived, printed, terms, causes]: &[String; 5], title: &str) {
    say!("{tag:<12} {derived:<17} {printed:<24} {terms:>6}  {causes:<12} {title}");
}

fn differing(entry: &Entry) {
    say!("{} {}", entry.tag, entry.title);
    let components = entry.forms.iter().flat_map(|form| &form.components);
    let line = |component: &Component| {
        let along = if component.label.is_empty() { "" } else { " along " };
        let position = format!("{along}{} of {}", component.label, component.name);
        let lines = component.terms.iter().map(move |term| format!("    {term}{position}"));
        lines.collect::<Vec<_>>()
    };
    let lines: Vec<_> = components.flat_map(line).collect();
    for line in lines.iter().take(SHOWN) {
        say!("{line}");
    }
    if lines.len() > SHOWN {
        say!("    and {} more", lines.len() - SHOWN);
    }
}

fn mends(cause: &Cause) {
    say!("{}. {}", cause.letter, cause.title);
    for mended in &cause.mended {
        let Mended { tag, name, before, alone, so_far, all, .. } = mended;
        let counts = [before, alone, so_far, all].map(usize::to_string);
        let [before, alone, so_far, all] = counts;
        mend_row(&[tag.clone(), name.clone(), before, alone, so_far, all]);
    }
}

fn mend_row([tag, name, before, alone, so_far, all]: &[String; 6]) {
    say!("    {tag:<16} {name:<16} {before:>6} {alone:>6} {so_far:>6} {all:>6}");
}
