//! How print, notes and causes can fail to fit together.

use std::fmt;

use precess_codegen::page::PageError;

/// Why the print is not judged.
#[derive(Debug)]
pub enum JudgementError {
    /// A page cannot be read.
    Page(PageError),
    /// The print, its notes and their causes do not fit together.
    Verdict(VerdictError),
}

/// A fault with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerdictError {
    /// File name.
    pub page: String,
    /// Line, from one.
    pub line: usize,
    /// What is wrong.
    pub fault: Fault,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// No entry for a number of the paper; the place is where it would be.
    Missing(u16),
    /// Two entries for one number.
    Twice(String),
    /// An entry without a printed block.
    NoBlock(String),
    /// A printed block without an entry.
    NoEntry(String),
    /// An equation that no hand-checked block states.
    NotDerived(String),
    /// A block that is said to agree and differs in so many terms.
    SaidToAgree(usize),
    /// Notes that name a difference where there is none.
    NoDifference(String),
    /// Neither a class nor an equality.
    Unclassified(String),
    /// A note names a cause that is not on the page of causes.
    UnknownCause(char),
    /// A note names a term and no cause.
    NoCause,
    /// A cause that no note names.
    UnusedCause(char),
    /// A cause that a note names has no mend for the note's block.
    NoMend(char),
    /// A mend of a block of which no note names the cause.
    NoNote(char, String),
    /// A mend of a block that is not printed.
    NoTarget(String),
    /// A mend of text that occurs so many times in the block, not once.
    Found(String, usize),
    /// A piece of code that is none.
    Code(String),
}

impl fmt::Display for VerdictError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.page, self.line, self.fault)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(number) => write!(
                f,
                "equation ({number}) has no entry; add `### ({number}) title` before this line"
            ),
            Self::Twice(tag) => write!(f, "{tag} has an entry already; join the two"),
            Self::NoBlock(tag) => write!(f, "{tag} has no block; transcribe it below the heading"),
            Self::NoEntry(tag) => write!(f, "{tag} has no entry; add `### {tag} title` above it"),
            Self::NotDerived(tag) => write!(
                f,
                "{tag} is printed and no hand-checked block states it; derive it on its page"
            ),
            Self::SaidToAgree(terms) => write!(
                f,
                "the block is said to agree and differs in {terms} terms; name them in notes"
            ),
            Self::NoDifference(tag) => write!(
                f,
                "notes name a difference of {tag} and there is none; write `agrees` or mend them"
            ),
            Self::Unclassified(tag) => {
                write!(f, "{tag} is equal and no note says `agrees`; add the note")
            }
            Self::UnknownCause(letter) => {
                write!(f, "cause {letter} is not on the page of causes; add it or name another")
            }
            Self::NoCause => {
                write!(f, "the note names a term and no cause; end it with `Cause A.` or its like")
            }
            Self::UnusedCause(letter) => {
                write!(f, "no note names cause {letter}; name it in one or strike it")
            }
            Self::NoMend(letter) => write!(
                f,
                "cause {letter}, which the note names, has no mend for this block; add a `mend`"
            ),
            Self::NoNote(letter, block) => write!(
                f,
                "cause {letter} mends {block}, and no note there names it; end one with `Cause \
                 {letter}.`"
            ),
            Self::NoTarget(block) => {
                write!(f, "there is no printed block {block}; see tag and name of its heading")
            }
            Self::Found(text, times) => write!(
                f,
                "`{text}` occurs {times} times in the block, not once; copy a longer or exact piece"
            ),
            Self::Code(text) => write!(f, "`{text}` is not a piece of code; close its brackets"),
        }
    }
}

impl std::error::Error for VerdictError {}

impl fmt::Display for JudgementError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Page(error) => error.fmt(f),
            Self::Verdict(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for JudgementError {}

impl From<PageError> for JudgementError {
    fn from(error: PageError) -> Self {
        Self::Page(error)
    }
}

impl From<VerdictError> for JudgementError {
    fn from(error: VerdictError) -> Self {
        Self::Verdict(error)
    }
}
