//! The fenced `equation` and `printed` blocks of a Markdown page.

use super::fence::fences;
use super::given::parse_given;
use super::note::{Class, Note, notes};
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

/// One block as it is written in the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The paper's number, `(14)`, or `(definition)`, or `(step)`.
    pub tag: String,
    /// The quantity in code: `r_wc_b_dprime`.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// The special case in which it holds: symbol and value, (`j_33`, `j_22`); else empty.
    pub given: Vec<(String, String)>,
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
        self.kind == Kind::Text || self.notes.iter().any(|note| note.class == Class::Definition)
    }

    /// Page and line, for messages.
    #[must_use]
    pub fn place(&self) -> String {
        format!("{}:{}", self.page, self.line)
    }
}

/// The blocks of a page that are fenced as `fence`, in order.
///
/// # Errors
/// When a fence is not closed or a heading is not `(tag) name: kind along a b c`.
pub fn blocks(page: &str, text: &str, fence: &str) -> Result<Vec<Block>, PageError> {
    let read = |fenced: super::fence::Fence<'_>| {
        let place = |error| PageError { page: page.to_owned(), line: fenced.line, error };
        let (heading, rest) = fenced.inside.split_first().ok_or_else(|| place(ReadError::Empty))?;
        let (tag, name, kind) =
            parse_heading(heading).ok_or_else(|| place(ReadError::Heading((*heading).into())))?;
        let (given, rest) = parse_given(rest).map_err(place)?;
        let notes = notes(&fenced.after).map_err(|(line, text)| PageError {
            page: page.to_owned(),
            line,
            error: ReadError::Note(text),
        })?;
        let (body, page) = (rest.join("\n"), page.to_owned());
        Ok(Block { tag, name, kind, given, body, page, line: fenced.line, notes })
    };
    fences(page, text, fence)?.into_iter().map(read).collect()
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
        assert!(block.given.is_empty());
    }

    #[test]
    fn a_special_case_is_no_part_of_the_body() {
        let text = "```equation\n(1) x: scalar\ngiven j_33 = j_22,\n    theta = 0;\nj_33\n```\n";
        let [block] = blocks("p.md", text, "equation").unwrap().try_into().unwrap();
        let pairs = [("j_33", "j_22"), ("theta", "0")];
        assert_eq!(block.given, pairs.map(|(a, b)| (a.to_owned(), b.to_owned())));
        assert_eq!(block.body, "j_33");
        let text = "```equation\n(1) x: scalar\ngiven j_33;\nj_33\n```\n";
        assert_eq!(
            blocks("p.md", text, "equation").unwrap_err().to_string(),
            "p.md:1: special case `j_33` is not `symbol = value`, the list ended by a semicolon"
        );
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
    fn a_note_belongs_to_the_block_before_it() {
        let text = "```printed\n(1) x: scalar\na\n```\n\n- `slip`: `a` -> `b`. Cause A.\n";
        let [block] = blocks("p.md", text, "printed").unwrap().try_into().unwrap();
        let [note] = &block.notes[..] else { panic!("one note") };
        assert_eq!((note.class, note.line, &note.causes[..]), (Class::Slip, 6, &['A'][..]));
    }

    #[test]
    fn an_open_fence_is_refused() {
        assert_eq!(
            blocks("p.md", "```equation\nx", "equation").unwrap_err().error,
            ReadError::OpenFence
        );
    }
}
