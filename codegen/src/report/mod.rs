//! The documents that are generated with the code: Markdown, and the same as self-contained HTML.

mod derivation;
mod frames;
mod html;
mod numbers;

use std::fmt;

pub use derivation::NotationError;
pub use html::HtmlError;
use tera::{Context, Tera};

use crate::derivation::chain::Chain;
use crate::emit::EmittedFile;
use crate::page::Block;

/// Why a document cannot be laid out: a fault of the generator, or of a page that it sets.
#[derive(Debug)]
pub enum ReportError {
    /// Something cannot be set as mathematics.
    Notation(NotationError),
    /// A page has no HTML.
    Html(HtmlError),
    /// A template failed.
    Template(tera::Error),
}

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Notation(error) => error.fmt(f),
            Self::Html(error) => error.fmt(f),
            Self::Template(error) => write!(f, "template: {error}"),
        }
    }
}

impl std::error::Error for ReportError {}

impl From<NotationError> for ReportError {
    fn from(error: NotationError) -> Self {
        Self::Notation(error)
    }
}

impl From<HtmlError> for ReportError {
    fn from(error: HtmlError) -> Self {
        Self::Html(error)
    }
}

impl From<tera::Error> for ReportError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}

/// The derivation, printed.
///
/// # Errors
/// When a block or a quantity cannot be set.
pub fn derivation(chain: &Chain<'_>, blocks: &[Block]) -> Result<Vec<EmittedFile>, ReportError> {
    let mut context = Context::new();
    context.insert("derivation", &derivation::derivation(chain, blocks)?);
    let template = include_str!("templates/derivation.md.tera");
    let picture = frames::drawing(chain);
    let mut files = document("docs/derivation", template, &context, &[("frames.svg", &picture)])?;
    files.push(EmittedFile { path: "docs/frames.svg".to_owned(), text: picture });
    Ok(files)
}

/// A document as Markdown and as HTML.
fn document(
    path: &str,
    template: &str,
    context: &Context,
    pictures: &[(&str, &str)],
) -> Result<Vec<EmittedFile>, ReportError> {
    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    tera.add_raw_template("document", template)?;
    let text = tera.render("document", context)?;
    let page = html::html(&text, pictures)?;
    let file = |ending: &str, text| EmittedFile { path: format!("{path}.{ending}"), text };
    Ok(vec![file("md", text), file("html", page)])
}
