//! The entries of a printed page: a heading for each of the paper's numbers.

use super::{Page, PageError, ReadError};

/// A number of the paper, or an equality that its text asserts before a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Number {
    /// The number.
    pub number: u16,
    /// Whether it is the numbered equation; otherwise what the text asserts before it.
    pub numbered: bool,
}

/// `### (14) wheel's centre of mass`, with the text between it and the first block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// `(14)`, `(before 67)`.
    pub tag: String,
    /// The same, to compare.
    pub number: Number,
    /// Of a tensor that several numbers share, the entries that are this one's: `at 11 22 33:`.
    pub entries: Vec<String>,
    /// What the equation states.
    pub title: String,
    /// The finding in one line.
    pub in_short: Option<String>,
    /// Other paragraphs before the first block.
    pub prose: Vec<String>,
    /// File name.
    pub page: String,
    /// Line of the heading.
    pub line: usize,
}

/// The sections of a page, in order.
///
/// # Errors
/// When a heading of the third level is not `### (number) title`.
pub fn sections(page: &Page) -> Result<Vec<Section>, PageError> {
    let mut found: Vec<Section> = Vec::new();
    let mut paragraph: Vec<&str> = Vec::new();
    let mut open = false;
    for (line, text) in (1..).zip(page.text.lines()) {
        if text.trim().is_empty() || text.starts_with("```") || text.starts_with('#') {
            let whole = std::mem::take(&mut paragraph).join(" ");
            if let (false, Some(section)) = (whole.is_empty(), found.last_mut()) {
                section.paragraph(whole);
            }
        } else if open {
            paragraph.push(text.trim());
        }
        if let Some(heading) = text.strip_prefix("### ") {
            let error = || PageError {
                page: page.name.clone(),
                line,
                error: ReadError::Section(heading.to_owned()),
            };
            found.push(section(heading, &page.name, line).ok_or_else(error)?);
            open = true;
        }
        open &= !text.starts_with("```");
    }
    Ok(found)
}

fn section(heading: &str, page: &str, line: usize) -> Option<Section> {
    let (tag, rest) = heading.split_once(") ")?;
    let tag = format!("{tag})");
    let [number] = numbers(&tag)[..] else { return None };
    let (entries, title) = match rest.strip_prefix("at ").and_then(|rest| rest.split_once(": ")) {
        Some((entries, title)) => (entries.split(' ').map(str::to_owned).collect(), title),
        None => (Vec::new(), rest),
    };
    Some(Section {
        tag,
        number,
        entries,
        title: title.to_owned(),
        in_short: None,
        prose: Vec::new(),
        page: page.to_owned(),
        line,
    })
}

impl Section {
    fn paragraph(&mut self, text: String) {
        match text.strip_prefix("In short: ") {
            Some(finding) => self.in_short = Some(finding.to_owned()),
            None => self.prose.push(text),
        }
    }
}

/// The numbers that a block's tag stands for: `(14)`, `(32 first line)`, `(49)-(52)`,
/// `(before 67)`; none for `(step)` and `(definition)`.
#[must_use]
pub fn numbers(tag: &str) -> Vec<Number> {
    let one = |text: &str| -> Option<Number> {
        let inside = text.strip_prefix('(')?.strip_suffix(')')?;
        match inside.strip_prefix("before ") {
            Some(before) => Some(Number { number: before.parse().ok()?, numbered: false }),
            None => {
                Some(Number { number: inside.split(' ').next()?.parse().ok()?, numbered: true })
            }
        }
    };
    match tag.split_once('-').map(|(first, last)| (one(first), one(last))) {
        Some((Some(first), Some(last))) => {
            let range = first.number..=last.number;
            range.map(|number| Number { number, numbered: true }).collect()
        }
        _ => one(tag).into_iter().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(text: &str) -> Page {
        Page { name: "p.md".into(), text: text.into() }
    }

    #[test]
    fn a_section_is_its_heading_and_what_stands_before_the_block() {
        let text = "### (50) at 12: inertia\n\nIn short: a\nsign.\n\nThe text: so.\n\n```printed\n\
                    (50) x: scalar\n0\n```\n\n- `agrees`\n";
        let [section] = sections(&page(text)).unwrap().try_into().unwrap();
        assert_eq!((section.tag.as_str(), section.title.as_str()), ("(50)", "inertia"));
        assert_eq!(section.entries, ["12"]);
        assert_eq!(section.in_short.as_deref(), Some("a sign."));
        assert_eq!(section.prose, ["The text: so."]);
    }

    #[test]
    fn a_tag_stands_for_its_numbers() {
        let plain = |tag| numbers(tag).iter().map(|n| n.number).collect::<Vec<_>>();
        assert_eq!(plain("(14)"), [14]);
        assert_eq!(plain("(49)-(52)"), [49, 50, 51, 52]);
        assert_eq!(plain("(32 first line)"), [32]);
        assert_eq!(numbers("(before 67)"), [Number { number: 67, numbered: false }]);
        assert!(numbers("(step)").is_empty());
        assert!(numbers("(before 67)") < numbers("(67)"));
    }

    #[test]
    fn a_heading_without_a_number_is_named() {
        let error = sections(&page("\n### Wheel\n")).unwrap_err();
        assert_eq!(
            error.to_string(),
            "p.md:2: heading `Wheel` is not `(number) title`, or `(before number) title`"
        );
    }
}
