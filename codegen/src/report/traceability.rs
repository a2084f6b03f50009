//! From equation to derivation line, page, emitted function and the laws that see it wrong.

use serde::Serialize;

use super::numbers::{Number, numbers};
use crate::derivation::chain::Chain;
use crate::kernel::{Kernel, kernels};
use crate::mutation::{Kind, Report};
use crate::page::Page;
use crate::verdict::{Entry, HandChecked, Verdicts};

/// What the template is filled with.
#[derive(Serialize)]
pub(super) struct Traceability {
    rows: Vec<RowText>,
    kinds: Vec<String>,
    system: Vec<SystemText>,
}

/// One equation of the paper.
#[derive(Serialize)]
struct RowText {
    tag: String,
    title: String,
    /// Where the derivation states or derives it.
    lines: String,
    pages: String,
    proof: String,
    emitted: String,
    /// Mutants under it, and how many of them each kind of law sees.
    mutants: usize,
    killed: String,
}

/// What the paper does not number.
#[derive(Serialize)]
struct SystemText {
    tag: String,
    emitted: String,
    mutants: usize,
    killed: String,
}

/// The table; `sources` are the files of the derivation, by path from the repository's root.
pub(super) fn traceability(
    chain: &Chain<'_>,
    verdicts: &Verdicts,
    report: &Report,
    sources: &[Page],
) -> Traceability {
    let kernels = kernels(chain);
    let places = places(sources);
    let numbered = verdicts.entries.iter().filter_map(|entry| Some((Number(entry.number?), entry)));
    let rows = numbered.map(|(number, entry)| {
        let (mutants, killed) = put_to_the_laws(report, |tag| numbers(tag).contains(&number));
        RowText {
            tag: entry.tag.clone(),
            title: entry.title.clone(),
            lines: lines_of(&places, number, entry),
            pages: pages(entry),
            proof: entry.hand_checked.label().to_owned(),
            emitted: emitted(&kernels, |tag| numbers(tag).contains(&number)),
            mutants,
            killed,
        }
    });
    let rows = rows.collect();
    let others = report.by_tag().into_iter().filter(|(tag, _)| numbers(tag).is_empty());
    let system = others.map(|(tag, _)| {
        let (mutants, killed) = put_to_the_laws(report, |other| other == tag);
        SystemText { emitted: emitted(&kernels, |other| other == tag), mutants, killed, tag }
    });
    Traceability {
        rows,
        kinds: Kind::ALL.map(|kind| kind.title().to_owned()).to_vec(),
        system: system.collect(),
    }
}

/// Mutants under the equations that fit, and how many of them each kind of law sees.
fn put_to_the_laws(report: &Report, fits: impl Fn(&str) -> bool) -> (usize, String) {
    let under =
        |outcome: &&crate::mutation::Outcome| outcome.mutant.tag.as_deref().is_some_and(&fits);
    let outcomes: Vec<_> = report.outcomes.iter().filter(under).collect();
    let seen = |kind| outcomes.iter().filter(|outcome| outcome.killed_by(kind)).count();
    (outcomes.len(), Kind::ALL.map(|kind| seen(kind).to_string()).join(" | "))
}

/// Function and names of the claims that fit.
fn emitted(kernels: &[Kernel<'_>], fits: impl Fn(&str) -> bool) -> String {
    let of_kernel = |kernel: &Kernel<'_>| {
        let names = kernel.claims.iter().filter(|claim| fits(&claim.tag));
        let names: Vec<_> = names.map(|claim| format!("`{}`", claim.name)).collect();
        (!names.is_empty()).then(|| format!("`fn {}`: {}", kernel.name, names.join(", ")))
    };
    kernels.iter().filter_map(of_kernel).collect::<Vec<_>>().join("; ")
}

fn pages(entry: &Entry) -> String {
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

/// A comment of the derivation that names equations.
struct Place {
    first: u16,
    last: u16,
    path: String,
    line: usize,
}

/// Every place that names an equation, a range being one place.
fn places(sources: &[Page]) -> Vec<Place> {
    let mut found = Vec::new();
    for source in sources {
        for (line, text) in (1..).zip(source.text.lines()) {
            let Some((_, comment)) = text.split_once("//") else { continue };
            let numbers = comment.split('(').skip(1).filter_map(|part| {
                let (number, rest) = part.split_once(')')?;
                Some((number.parse::<u16>().ok()?, rest))
            });
            let mut range_from = None;
            for (number, rest) in numbers {
                let first = range_from.take().unwrap_or(number);
                if [" to ", "-"].contains(&rest) {
                    range_from = Some(first);
                } else {
                    found.push(Place { first, last: number, path: source.name.clone(), line });
                }
            }
        }
    }
    found
}

/// The most particular places that name an equation.
fn lines_of(places: &[Place], Number(number): Number, entry: &Entry) -> String {
    if matches!(entry.hand_checked, HandChecked::Definition) {
        return String::new();
    }
    let naming = || places.iter().filter(|place| (place.first..=place.last).contains(&number));
    let Some(narrowest) = naming().map(|place| place.last - place.first).min() else {
        return String::new();
    };
    let shown = naming().filter(|place| place.last - place.first == narrowest).map(|place| {
        let name = place.path.rsplit('/').next().unwrap_or_default();
        format!("[{name}:{0}](../{1}#L{0})", place.line, place.path)
    });
    shown.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_name_equations_and_ranges() {
        let text = "// (31), (44): rates\nlet a = f(7);\n/// (20) to (76)\n// (49)-(52); (64)\n";
        let sources = [Page { name: "a.rs".to_owned(), text: text.to_owned() }];
        let found: Vec<_> =
            places(&sources).iter().map(|place| (place.first, place.last, place.line)).collect();
        assert_eq!(found, [(31, 31, 1), (44, 44, 1), (20, 76, 3), (49, 52, 4), (64, 64, 4)]);
    }
}
