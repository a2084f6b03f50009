//! The page of causes: differences that share one, and how each is mended in the printed text.

use super::fence::fences;
use super::{Page, PageError, ReadError};

/// A cause as its page states it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CausePage {
    /// Its letter.
    pub letter: char,
    /// What it is.
    pub title: String,
    /// What it does to the print, in one line: the paragraph that begins with "In short:".
    pub in_short: String,
    /// The other paragraphs below the heading.
    pub prose: Vec<String>,
    /// The mends, in order.
    pub mends: Vec<Mend>,
    /// File name.
    pub page: String,
    /// Line of the heading.
    pub line: usize,
}

/// How one printed block is mended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mend {
    /// Tag of the printed block.
    pub tag: String,
    /// Its name.
    pub name: String,
    /// Printed text and what takes its place; `0` is mended by adding to the value.
    pub changes: Vec<(String, String)>,
    /// Line of the fence.
    pub line: usize,
}

/// How the paragraph begins that says it in one line.
const IN_SHORT: &str = "In short: ";

/// The causes of a page, in order.
///
/// # Errors
/// When a heading is not `## A. title`, nothing below it begins with "In short:", or a mend is not a
/// tag, a name and `` `printed` -> `right` ``.
pub fn causes(page: &Page) -> Result<Vec<CausePage>, PageError> {
    let wrong = |line, text: &str| PageError {
        page: page.name.clone(),
        line,
        error: ReadError::Cause(text.to_owned()),
    };
    let mut found: Vec<CausePage> = Vec::new();
    let mut fenced = false;
    for (line, text) in (1..).zip(page.text.lines()) {
        fenced ^= text.starts_with("```");
        if let (false, Some(heading)) = (fenced, text.strip_prefix("## ")) {
            found.push(heading_of(heading, page, line).ok_or_else(|| wrong(line, heading))?);
        } else if let (false, false, Some(cause)) =
            (fenced, text.starts_with("```"), found.last_mut())
        {
            cause.prose.push(text.trim_end().to_owned());
        }
    }
    for cause in &mut found {
        let (short, prose): (Vec<_>, Vec<_>) =
            paragraphs(&cause.prose).into_iter().partition(|text| text.starts_with(IN_SHORT));
        let [short] = &short[..] else { return Err(wrong(cause.line, &cause.title)) };
        cause.in_short = short.replacen(IN_SHORT, "", 1);
        cause.prose = prose;
    }
    for fence in fences(&page.name, &page.text, "mend")? {
        let mend = mend(&fence.inside, fence.line)
            .ok_or_else(|| wrong(fence.line, &fence.inside.join(" ")))?;
        let above = found.iter_mut().rfind(|cause| cause.line < fence.line);
        above.ok_or_else(|| wrong(fence.line, &mend.tag))?.mends.push(mend);
    }
    Ok(found)
}

fn heading_of(heading: &str, page: &Page, line: usize) -> Option<CausePage> {
    let (letter, title) = heading.split_once(". ")?;
    let [letter] = letter.chars().collect::<Vec<_>>()[..] else { return None };
    letter.is_ascii_uppercase().then(|| CausePage {
        letter,
        title: title.to_owned(),
        in_short: String::new(),
        prose: Vec::new(),
        mends: Vec::new(),
        page: page.name.clone(),
        line,
    })
}

/// Lines to paragraphs, at the blank ones; a table keeps its lines.
fn paragraphs(lines: &[String]) -> Vec<String> {
    let whole = lines.split(String::is_empty).filter(|lines| !lines.is_empty());
    let join = |lines: &[String]| lines.join(if lines[0].starts_with('|') { "\n" } else { " " });
    whole.map(join).collect()
}

/// `(14) r_wc_b_dprime`, then pairs of pieces of code.
fn mend(lines: &[&str], line: usize) -> Option<Mend> {
    let (heading, rest) = lines.split_first()?;
    let (tag, name) = heading.trim_end().rsplit_once(' ')?;
    let text = rest.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
    // Outside, inside, outside, ..: nothing, printed, arrow, right, nothing, ..
    let pieces: Vec<_> = text.split('`').collect();
    let (last, pairs) = pieces.split_last()?;
    let change = |piece: &[&str]| match piece {
        [before, printed, " -> ", right] if before.trim().is_empty() => {
            Some(((*printed).to_owned(), (*right).to_owned()))
        }
        _ => None,
    };
    let changes = pairs.chunks(4).map(change).collect::<Option<Vec<_>>>()?;
    let whole = tag.starts_with('(') && last.trim().is_empty() && !changes.is_empty();
    whole.then(|| Mend { tag: tag.to_owned(), name: name.to_owned(), changes, line })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(text: &str) -> Page {
        Page { name: "causes.md".into(), text: text.into() }
    }

    #[test]
    fn a_cause_has_prose_and_mends() {
        let text = "# Causes\n\n## A. A sign\n\nIn short: a\nsign.\n\nIt is\nwrong.\n\n\
                    ```mend\n(17) f_o\n`a` -> `b`\n`0`\n-> `c`\n```\n\nSo.\n";
        let [cause] = causes(&page(text)).unwrap().try_into().unwrap();
        assert_eq!((cause.letter, cause.title.as_str(), cause.line), ('A', "A sign", 3));
        assert_eq!(cause.in_short, "a sign.");
        assert_eq!(cause.prose, ["It is wrong.", "So."]);
        let [mend] = &cause.mends[..] else { panic!("one mend") };
        assert_eq!((mend.tag.as_str(), mend.name.as_str()), ("(17)", "f_o"));
        let changes = [("a", "b"), ("0", "c")];
        assert_eq!(mend.changes, changes.map(|(a, b)| (a.to_owned(), b.to_owned())));
    }

    #[test]
    fn what_is_no_mend_is_named_with_its_place() {
        let text = "## A. A sign\n\nIn short: it.\n\n```mend\n(17) f_o\n`a` => `b`\n```\n";
        let error = causes(&page(text)).unwrap_err();
        assert!(error.to_string().starts_with("causes.md:5: `(17) f_o `a` => `b`` is no cause"));
        assert!(causes(&page("## A sign\n\nIn short: it.\n")).is_err());
        assert!(causes(&page("## A. A sign\n")).is_err());
    }
}
