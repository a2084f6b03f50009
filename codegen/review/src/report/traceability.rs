//! From equation to derivation line, page, emitted function and the laws that see it wrong.

use serde::Serialize;

use super::derivation::claims;
use super::page_links;
use crate::mutation::{Kind, Outcome, Report};
use crate::verdict::{Entry, HandChecked, Verdicts};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::graph::Graph;
use precess_codegen::kernel::kernels;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::page::{Page, numbers};

/// What the template is filled with.
#[derive(Serialize)]
pub(super) struct Traceability {
    rows: Vec<EquationText>,
    kinds: Vec<String>,
    system: Vec<SystemText>,
    /// Mutants under no number.
    unnumbered: usize,
}

/// What is emitted and not numbered by the paper, in the order of the page.
const UNNUMBERED: [(&str, &str); 22] = [
    ("(step)", "positions, velocities and first moments, behind (11) to (14)"),
    ("(M_ij)", "mass matrix of the joints"),
    ("(energy)", "kinetic energy"),
    ("(momentum)", "linear momentum"),
    ("(D1)", "axes of the bodies"),
    ("(D2)", "origins of the joints"),
    ("(D3)", "origins moved along their axes"),
    ("(D4)", "base inertial parameters and constant share of the hub"),
    ("(D5)", "motion of a joint's parent body, no joint accelerating"),
    ("(D6)", "outboard composite"),
    ("(D7)", "columns of the mass matrix"),
    ("(D8)", "Coriolis and centrifugal wrench of a joint's rate"),
    ("(D9)", "bias of a joint row"),
    ("(D10)", "divisor, gains and free acceleration of a joint"),
    ("(D11)", "a joint eliminated from the rows of the inboard joints"),
    ("(D12)", "share of the hub's mass matrix and right side"),
    ("(D13)", "joint accelerations from those of the hub"),
    ("(D14)", "applied wrenches at joints and hub"),
    ("(D15)", "the same along a joint"),
    ("(D16)", "a field of acceleration at a joint"),
    ("(D17)", "what it does to a body"),
    ("(D18)", "second moment of the device"),
];

/// So many groups of names are shown of one function, the others counted.
const SHOWN: usize = 4;

/// One equation of the paper.
#[derive(Serialize)]
struct EquationText {
    tag: String,
    title: String,
    /// Where the derivation states or derives it.
    lines: String,
    pages: String,
    /// The derivation against the page.
    derived: &'static str,
    /// The emitted values that are proven to be what it states.
    proven: String,
    /// All emitted values under it.
    emitted: String,
    /// Mutants under it, and how many of them each kind of law sees.
    mutants: usize,
    killed: String,
}

/// What the paper does not number.
#[derive(Serialize)]
struct SystemText {
    tag: String,
    what: &'static str,
    emitted: String,
    mutants: usize,
    killed: String,
}

/// The table; `sources` are the files of the derivation, by path from the repository's root.
pub(super) fn traceability(verdicts: &Verdicts, report: &Report, sources: &[Page]) -> Traceability {
    let (graph, citations) = (Graph::new(), citations(sources));
    let kernels = kernels(&Chain::new(&graph, &DGVSCMG));
    let numbered = verdicts.entries.iter().filter_map(|entry| Some((entry.number?, entry)));
    let rows = numbered.map(|(number, entry)| {
        let under = |tag: &str| names(tag, number);
        let (mutants, killed) = put_to_the_laws(report, under);
        EquationText {
            tag: entry.tag.clone(),
            title: entry.title.clone(),
            lines: lines_of(&citations, number, entry),
            pages: page_links(entry),
            derived: entry.derivation(),
            proven: claims(&kernels, |tag, _| names(tag, number)).join("; "),
            emitted: emitted(report, under),
            mutants,
            killed,
        }
    });
    Traceability {
        rows: rows.collect(),
        kinds: Kind::ALL.map(|kind| kind.title().to_owned()).to_vec(),
        system: unnumbered(report),
        unnumbered: report.unnumbered(),
    }
}

/// Whether a tag names a number: `(17), (78)` names both of its own.
fn names(tag: &str, number: u16) -> bool {
    numbered(tag).any(|named| named == number)
}

/// Every number that a tag names; what the text asserts before a number is none.
fn numbered(tag: &str) -> impl Iterator<Item = u16> {
    let named = tag.split(", ").flat_map(numbers).filter(|named| named.numbered);
    named.map(|named| named.number)
}

/// Whether a tag is one of those that another consists of: `(D4)` of `(D3), (D4)`.
fn cites(tag: &str, one: &str) -> bool {
    tag.split(", ").any(|part| part == one)
}

/// A row for every tag without a number, the known ones first.
fn unnumbered(report: &Report) -> Vec<SystemText> {
    let mut tags = UNNUMBERED.to_vec();
    for tag in report.computed.iter().filter_map(|value| value.tag.as_deref()) {
        if numbered(tag).next().is_none() && !tags.iter().any(|(known, _)| cites(tag, known)) {
            tags.push((tag, ""));
        }
    }
    let row = |(tag, what): (&str, &'static str)| {
        let (mutants, killed) = put_to_the_laws(report, |other| cites(other, tag));
        let emitted = emitted(report, |other| cites(other, tag));
        SystemText { tag: tag.to_owned(), what, emitted, mutants, killed }
    };
    tags.into_iter().map(row).collect()
}

/// Mutants under the equations that fit, and how many of them each kind of law sees.
fn put_to_the_laws(report: &Report, fits: impl Fn(&str) -> bool) -> (usize, String) {
    let under = |outcome: &&Outcome| outcome.mutant.tag.as_deref().is_some_and(&fits);
    let outcomes: Vec<_> = report.outcomes.iter().filter(under).collect();
    let seen = |kind| outcomes.iter().filter(|outcome| outcome.killed_by(kind)).count();
    (outcomes.len(), Kind::ALL.map(|kind| seen(kind).to_string()).join(" | "))
}

/// Functions and names of the values that are computed under the equations that fit.
fn emitted(report: &Report, fits: impl Fn(&str) -> bool) -> String {
    let mut functions: Vec<(&str, Vec<&str>)> = Vec::new();
    let under = |tag: &Option<String>| tag.as_deref().is_some_and(&fits);
    for value in report.computed.iter().filter(|value| under(&value.tag)) {
        match functions.last_mut().filter(|(kernel, _)| *kernel == value.kernel) {
            Some((_, names)) => names.push(&value.name),
            None => functions.push((&value.kernel, vec![&value.name])),
        }
    }
    let shown = functions.iter().map(|(kernel, names)| format!("`fn {kernel}`: {}", short(names)));
    shown.collect::<Vec<_>>().join("; ")
}

/// Names that differ in their last part only as one, `mc_*`, and of many the first.
fn short(names: &[&str]) -> String {
    let stem = |name: &str| name.rsplit_once('_').map(|(stem, _)| stem.to_owned());
    let mut groups: Vec<String> = Vec::new();
    for name in names {
        let own = stem(name);
        let alike = names.iter().filter(|other| own.is_some() && stem(other) == own).count();
        let group = own
            .filter(|_| alike > 1)
            .map_or_else(|| format!("`{name}`"), |stem| format!("`{stem}_*`"));
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    let more = groups.len().saturating_sub(SHOWN);
    groups.truncate(SHOWN);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    groups.join(", ") + &rest
}

/// A comment of the derivation that names equations.
struct Citation {
    first: u16,
    last: u16,
    path: String,
    line: usize,
    /// The function that it is in, or is the summary of.
    function: Option<String>,
}

/// Every place that names an equation, a range being one place. A module's own comment is none: it
/// computes nothing.
fn citations(sources: &[Page]) -> Vec<Citation> {
    let mut found = Vec::new();
    for source in sources {
        let lines: Vec<_> = source.text.lines().collect();
        let mut inside = None;
        for (line, text) in (1..).zip(&lines) {
            inside = function(text).or(inside);
            let Some((_, comment)) = text.split_once("//") else { continue };
            if comment.starts_with('!') {
                continue;
            }
            let mut below = lines[line..].iter().map(|text| text.trim_start());
            let own = if comment.starts_with('/') {
                below.find(|text| !text.starts_with(['/', '#'])).and_then(function)
            } else {
                inside
            };
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
                    let (path, function) = (source.name.clone(), own.map(str::to_owned));
                    found.push(Citation { first, last: number, path, line, function });
                }
            }
        }
    }
    found
}

/// The name of the function that begins on a line.
fn function(line: &str) -> Option<&str> {
    let (before, rest) = line.split_once("fn ")?;
    let begins = before.split_whitespace().all(|word| word.starts_with("pub") || word == "const");
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    begins.then_some(&rest[..end])
}

/// The most particular citations that name an equation.
fn lines_of(citations: &[Citation], number: u16, entry: &Entry) -> String {
    if matches!(entry.hand_checked, HandChecked::Definition) {
        return String::new();
    }
    let naming = || citations.iter().filter(|place| (place.first..=place.last).contains(&number));
    let Some(narrowest) = naming().map(|place| place.last - place.first).min() else {
        return String::new();
    };
    let shown = naming().filter(|place| place.last - place.first == narrowest).map(|place| {
        let file = place.path.rsplit('/').next().unwrap_or_default();
        let name = match &place.function {
            Some(function) => format!("`{}::{function}`", file.trim_end_matches(".rs")),
            None => format!("{file}:{}", place.line),
        };
        format!("[{name}](../{}#L{})", place.path, place.line)
    });
    shown.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_short_and_many_are_counted() {
        let names = ["mc_bx", "mc_by", "energy", "f_o_bx_w", "f_o_by_w", "f_i", "f_w"];
        assert_eq!(short(&names[..3]), "`mc_*`, `energy`");
        assert_eq!(short(&names), "`mc_*`, `energy`, `f_o_bx_w`, `f_o_by_w` and 1 more");
    }

    #[test]
    fn a_tag_names_each_of_its_numbers() {
        assert!(names("(17), (78)", 17) && names("(17), (78)", 78));
        assert!(names("(49)-(52)", 51));
        assert!(cites("(76), (D6)", "(D6)") && !cites("(D10)", "(D1)"));
        assert!(!names("(D10)", 1) && !names("(17), (78)", 7));
    }

    #[test]
    fn comments_name_equations_and_ranges() {
        let text = "//! (8)\n// (31), (44): rates\nlet a = f(7);\n/// (20) to (76)\n#[must_use]\n\
                    pub(super) fn b(c: u8) {\n    // (49)-(52); (64)\n}\n";
        let sources = [Page { name: "a.rs".to_owned(), text: text.to_owned() }];
        let citations = citations(&sources);
        let found = citations.iter().map(|place| (place.first, place.last, place.line));
        let found: Vec<_> = found.collect();
        assert_eq!(found, [(31, 31, 2), (44, 44, 2), (20, 76, 4), (49, 52, 7), (64, 64, 7)]);
        let functions: Vec<_> = citations.iter().map(|place| place.function.as_deref()).collect();
        assert_eq!(functions, [None, None, Some("b"), Some("b"), Some("b")]);
    }
}
