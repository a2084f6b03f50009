//! What can be wrong with a page.

use std::fmt;

/// What is wrong with a block or with a piece of emitted text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// A fence is not closed.
    OpenFence,
    /// A block without a heading.
    Empty,
    /// A heading of another form.
    Heading(String),
    /// A heading of an entry of another form.
    Section(String),
    /// A cause or a mend of another form.
    Cause(String),
    /// A special case of another form.
    Given(String),
    /// A note of another form.
    Note(String),
    /// Not an expression at all.
    Syntax(String),
    /// An expression form that has no meaning here.
    Form(String),
    /// A name that is neither a symbol nor defined before.
    Unknown(String),
    /// A `let` of a name that means something already.
    Taken(String),
    /// Parentheses nested too deeply to read.
    Depth(usize),
    /// An operation between kinds for which it is not defined.
    Kinds(String),
    /// The expression is of another kind than the heading says.
    NotThat(&'static str),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenFence => write!(f, "the block is not closed; end it with three backquotes"),
            Self::Empty => write!(f, "the block is empty; begin it with `(number) name: kind`"),
            Self::Heading(text) => write!(
                f,
                "heading `{text}` is not `(number) name: scalar`, `... vector along a b c` or \
                 `... tensor along a b c`"
            ),
            Self::Section(text) => {
                write!(f, "heading `{text}` is not `(number) title`, or `(before number) title`")
            }
            Self::Cause(text) => write!(
                f,
                "`{text}` is no cause `A. title` with one paragraph `In short: ...`, no printed \
                 block `(number) name`, or no mend `printed` -> `right`"
            ),
            Self::Given(text) => write!(
                f,
                "special case `{text}` is not `symbol = value`, the list ended by a semicolon"
            ),
            Self::Note(text) => write!(
                f,
                "`{text}` is not a note; write - `class`: `printed` -> `right`. How we tell: .. \
                 Cause A."
            ),
            Self::Syntax(text) => write!(f, "not an expression: {text}"),
            Self::Form(text) => write!(f, "`{text}` has no meaning in an equation"),
            Self::Unknown(name) => {
                write!(f, "`{name}` is neither a symbol nor defined above; define it first")
            }
            Self::Taken(name) => write!(f, "`{name}` means something already; choose another name"),
            Self::Depth(bound) => {
                write!(f, "brackets are nested more than {bound} deep; use `let` for the parts")
            }
            Self::Kinds(text) => write!(f, "`{text}` is not defined for these kinds"),
            Self::NotThat(kind) => {
                write!(f, "the expression is a {kind}, the heading says otherwise")
            }
        }
    }
}

impl std::error::Error for ReadError {}
