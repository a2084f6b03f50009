//! The hand-checked pages: equations in fenced blocks of Markdown, read with `syn`.
//!
//! A block is a tag (the paper's number), a name, a kind, the axes in which it is compared, and an
//! expression over scalars, vectors and tensors. The only primitive vectors are the axes of the
//! inner gimbal; everything else a page defines for itself, so it shares nothing with the
//! generator but the names of the symbols.

mod block;
mod reader;
mod value;

pub use block::{Block, Kind, Note, blocks};
pub use reader::{ReadError, Reader};
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
    let mut equations = Vec::new();
    for page in pages {
        for block in blocks(&page.name, &page.text, "equation")? {
            let place = |error| PageError { page: page.name.clone(), line: block.line, error };
            let value = reader.body(&block.body).map_err(place)?;
            let components = reader.resolve(&block, value).map_err(place)?;
            reader.define(&block.name, value);
            equations.push(Equation { block, components });
        }
    }
    Ok((equations, reader))
}

/// Reads the blocks that state an equation as it is printed, with the names of the hand-checked
/// pages. What is words, or gives a symbol its value, has no components.
///
/// # Errors
/// The first block that is malformed or uses an unknown name.
pub fn read_printed<'g>(
    reader: &mut Reader<'g>,
    pages: &[Page],
) -> Result<Vec<Equation<'g>>, PageError> {
    let mut equations = Vec::new();
    for page in pages {
        for block in blocks(&page.name, &page.text, "printed")? {
            let place = |error| PageError { page: page.name.clone(), line: block.line, error };
            let components = if block.is_words() {
                Vec::new()
            } else {
                let value = reader.body(&block.body).map_err(place)?;
                reader.resolve(&block, value).map_err(place)?
            };
            equations.push(Equation { block, components });
        }
    }
    Ok(equations)
}
