//! The fenced `equation` blocks of a Markdown page.

use super::{PageError, ReadError};

/// What an equation is, and the axes along which it is compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One number.
    Scalar,
    /// Three components along named axes.
    Vector([String; 3]),
    /// Nine entries along named axes.
    Tensor([String; 3]),
    /// Words: nothing to compare.
    Text,
}

/// One block as it stands in the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The paper's number, `(14)`, or `(definition)`, or `(step)`.
    pub tag: String,
    /// The quantity in code: `r_wc_b_dprime`.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// `let` lines and the final expression.
    pub body: String,
    /// File name.
    pub page: String,
    /// Line of the fence, from one.
    pub line: usize,
    /// The notes that follow.
    pub notes: Vec<Note>,
}

impl Block {
    /// Whether there is nothing to compare: words, or a symbol that is given its value.
    #[must_use]
    pub fn is_words(&self) -> bool {
        self.kind == Kind::Text || self.notes.iter().any(|note| note.class == "definition")
    }
}

/// What a page says of an equation as printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// `agrees`, `slip`, `scan`, `unreadable` or `definition`.
    pub class: String,
    /// Whether it names a term, and so a difference in value: `` `a` -> `b` ``. Others speak of a
    /// left side, a reading, notation or wording.
    pub changes_value: bool,
}

/// The blocks of a page that are fenced as `fence`, in order.
///
/// # Errors
/// When a fence is not closed or a heading is not `(tag) name: kind along a b c`.
pub fn blocks(page: &str, text: &str, fence: &str) -> Result<Vec<Block>, PageError> {
    let mut found: Vec<Block> = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((start, line)) = lines.next() {
        if let (Some(note), Some(block)) = (parse_note(line), found.last_mut()) {
            block.notes.push(note);
        }
        if line.trim().strip_prefix("```") != Some(fence) {
            continue;
        }
        let place = |error| PageError { page: page.to_owned(), line: start + 1, error };
        let mut inside = Vec::new();
        loop {
            match lines.next() {
                Some((_, line)) if line.trim() == "```" => break,
                Some((_, line)) => inside.push(line),
                None => return Err(place(ReadError::OpenFence)),
            }
        }
        let (heading, body) = inside.split_first().ok_or_else(|| place(ReadError::Empty))?;
        let (tag, name, kind) =
            parse_heading(heading).ok_or_else(|| place(ReadError::Heading((*heading).into())))?;
        let (page, body) = (page.to_owned(), body.join("\n"));
        found.push(Block { tag, name, kind, body, page, line: start + 1, notes: Vec::new() });
    }
    Ok(found)
}

/// ``- `slip`: `a` -> `b` ``, and its kin.
fn parse_note(line: &str) -> Option<Note> {
    let (class, text) = line.strip_prefix("- `")?.split_once('`')?;
    let known = ["agrees", "slip", "scan", "unreadable", "definition"].contains(&class);
    let term = text.starts_with(": `") || text.starts_with(": at ");
    let changes_value = term && class != "agrees" && class != "definition";
    known.then(|| Note { class: class.to_owned(), changes_value })
}

fn parse_heading(heading: &str) -> Option<(String, String, Kind)> {
    let (left, kind) = heading.split_once(": ")?;
    let (tag, name) = left.rsplit_once(' ')?;
    let kind = match kind.split(' ').collect::<Vec<_>>()[..] {
        ["scalar"] => Kind::Scalar,
        ["text"] => Kind::Text,
        ["vector", "along", a, b, c] => Kind::Vector([a, b, c].map(str::to_owned)),
        ["tensor", "along", a, b, c] => Kind::Tensor([a, b, c].map(str::to_owned)),
        _ => return None,
    };
    tag.starts_with('(').then(|| (tag.to_owned(), name.to_owned(), kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_read() {
        let text =
            "prose\n\n```equation\n(49)-(52) t: tensor along s_x s_y g_z\nlet a = 1;\na\n```\n";
        let [block] = blocks("p.md", text, "equation").unwrap().try_into().unwrap();
        assert_eq!((block.tag.as_str(), block.name.as_str(), block.line), ("(49)-(52)", "t", 3));
        assert_eq!(block.kind, Kind::Tensor(["s_x", "s_y", "g_z"].map(str::to_owned)));
        assert_eq!(block.body, "let a = 1;\na");
    }

    #[test]
    fn a_bad_heading_is_named_with_its_place() {
        let error = blocks("p.md", "```equation\n(1) x: spinor\n```\n", "equation").unwrap_err();
        assert_eq!(
            error.to_string(),
            "p.md:1: heading `(1) x: spinor` is not `(number) name: scalar`, \
             `... vector along a b c` or `... tensor along a b c`"
        );
    }

    #[test]
    fn an_open_fence_is_refused() {
        assert_eq!(
            blocks("p.md", "```equation\nx", "equation").unwrap_err().error,
            ReadError::OpenFence
        );
    }
}
