//! The hand-checked pages: equations in fenced blocks of Markdown, read with `syn`.
//!
//! A block is a tag (the paper's number), a name, a kind, the axes in which it is compared, and an
//! expression over scalars, vectors and tensors. The only primitive vectors are the axes of the
//! inner gimbal; everything else a page defines for itself, so it shares nothing with the
//! generator but the names of the symbols.

mod block;
mod cause;
mod error;
mod fence;
mod given;
mod note;
mod reader;
mod section;
mod value;

pub use block::{Block, Kind, blocks};
pub use cause::{CausePage, Mend, causes};
pub use error::ReadError;
pub use given::in_the_case;
pub use note::{Change, Class, Note, Subject};
pub use reader::Reader;
pub use section::{Number, Section, numbers, sections};
pub use value::Value;

use crate::graph::{Expr, Graph};

/// One hand-checked page: its name and its text.
#[derive(Clone, Debug)]
pub struct Page {
    /// File name, for messages.
    pub name: String,
    /// Markdown.
    pub text: String,
}

/// One equation as a page states it, by components.
#[derive(Clone, Debug)]
pub struct Equation<'g> {
    /// The block it was read from.
    pub block: Block,
    /// Component label (`g_x`, `11`, empty for a scalar) and value.
    pub components: Vec<(String, Expr<'g>)>,
}

/// Why a page cannot be read: where and what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PageError {
    /// File name.
    pub page: String,
    /// Line of the block's fence, from one.
    pub line: usize,
    /// What is wrong.
    pub error: ReadError,
}

impl std::fmt::Display for PageError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}: {}", self.page, self.line, self.error)
    }
}

impl std::error::Error for PageError {}

/// Reads every equation of the pages, in order; later blocks see the names of earlier ones.
///
/// # Errors
/// The first block that is malformed or uses an unknown name.
pub fn read<'g>(graph: &'g Graph, pages: &[Page]) -> Result<Vec<Equation<'g>>, PageError> {
    Ok(read_on(graph, pages)?.0)
}

/// The same, with the reader that knows every name of the pages.
///
/// # Errors
/// The first block that is malformed or uses an unknown name.
pub fn read_on<'g>(
    graph: &'g Graph,
    pages: &[Page],
) -> Result<(Vec<Equation<'g>>, Reader<'g>), PageError> {
    let mut reader = Reader::new(graph);
    for (axis, name) in ["s_x_hat", "s_y_hat", "g_z_hat"].into_iter().enumerate() {
        reader.define(name, Value::unit(graph, axis));
    }
    let equations = reader.pages(pages, |_, value| value)?;
    Ok((equations, reader))
}

impl<'g> Reader<'g> {
    /// Reads every equation of further pages. `meaning` is what a name stands for once its block is
    /// read: its value, or symbols in place of it.
    ///
    /// # Errors
    /// The first block that is malformed or uses an unknown name.
    pub fn pages(
        &mut self,
        pages: &[Page],
        meaning: impl Fn(&Block, Value<'g>) -> Value<'g>,
    ) -> Result<Vec<Equation<'g>>, PageError> {
        let mut equations = Vec::new();
        for page in pages {
            for block in blocks(&page.name, &page.text, "equation")? {
                let place = |error| PageError { page: page.name.clone(), line: block.line, error };
                let value = self.body(&block.body).map_err(place)?;
                let components = self.resolve(&block, value).map_err(place)?;
                let components =
                    in_the_case(self.graph(), &block.given, components).map_err(place)?;
                // What holds in a special case is no other meaning of the name.
                if block.given.is_empty() {
                    self.define(&block.name, meaning(&block, value));
                }
                equations.push(Equation { block, components });
            }
        }
        Ok(equations)
    }
}
