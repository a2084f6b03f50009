//! Markdown to one self-contained page: mathematics as `MathML`, pictures inline, no script and
//! no network.

use std::fmt;

use rustc_hash::FxHashMap;

use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{RenderConfig, Storage, push_mathml};
use tera::{Context, Tera};

/// Why a page has no HTML: a fault of the generator.
#[derive(Debug)]
pub enum HtmlError {
    /// A formula that the converter does not know.
    Formula {
        /// The formula.
        latex: String,
        /// What the converter says.
        error: String,
    },
    /// An image that no picture is given for.
    Picture(String),
    /// The page's template failed.
    Template(tera::Error),
}

impl fmt::Display for HtmlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Formula { latex, error } => {
                write!(f, "formula `{latex}` has no MathML: {error}")
            }
            Self::Picture(name) => write!(f, "image `{name}` has no picture; give one"),
            Self::Template(error) => write!(f, "template: {error}"),
        }
    }
}

impl std::error::Error for HtmlError {}

impl From<tera::Error> for HtmlError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}

/// The documents that are built as HTML, side by side in `target/docs`.
const DOCUMENTS: [&str; 6] =
    ["derivation.md", "errata.md", "kinds.md", "letter.md", "mutation.md", "traceability.md"];

/// The page; `pictures` are put where an image of that name is.
///
/// # Errors
/// When a formula cannot be converted.
pub(super) fn html(markdown: &str, pictures: &[(&str, &str)]) -> Result<String, HtmlError> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let mut page = Page::default();
    let mut events = Vec::new();
    for event in Parser::new_ext(markdown, options) {
        page.event(event, pictures, &mut events)?;
    }
    let mut body = String::new();
    pulldown_cmark::html::push_html(&mut body, events.into_iter());

    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    tera.add_raw_template("page", include_str!("templates/page.html.tera"))?;
    let mut context = Context::new();
    context.insert("title", &page.title);
    context.insert("style", include_str!("templates/page.css"));
    context.insert("contents", &page.contents);
    context.insert("body", &body);
    Ok(tera.render("page", &context)?)
}

/// What is known of a page while it is read.
#[derive(Default)]
struct Page {
    title: String,
    /// Address and title of each chapter.
    contents: Vec<(String, String)>,
    /// The heading that is open: its level and its text so far.
    heading: Option<(HeadingLevel, String, usize)>,
    addresses: FxHashMap<String, usize>,
    /// Inside an image: what it says is not shown.
    image: bool,
}

impl Page {
    fn event<'a>(
        &mut self,
        event: Event<'a>,
        pictures: &[(&str, &str)],
        events: &mut Vec<Event<'a>>,
    ) -> Result<(), HtmlError> {
        if let (Some((_, text, _)), Event::Text(t) | Event::Code(t)) = (&mut self.heading, &event) {
            text.push_str(t);
        }
        match event {
            Event::InlineMath(latex) => events.push(math(&latex, DisplayMode::Inline)?),
            Event::DisplayMath(latex) => {
                let formula = math(&latex, DisplayMode::Block)?;
                events.extend([raw("<span class=\"formula\">"), formula, raw("</span>")]);
            }
            Event::Start(Tag::Table(columns)) => {
                events.extend([raw("<div class=\"wide\">"), Event::Start(Tag::Table(columns))]);
            }
            Event::End(TagEnd::Table) => {
                events.extend([Event::End(TagEnd::Table), raw("</div>")]);
            }
            Event::Start(Tag::Image { dest_url, .. }) => {
                let picture = pictures.iter().find(|(name, _)| *name == &*dest_url);
                let (_, picture) =
                    picture.ok_or_else(|| HtmlError::Picture(dest_url.to_string()))?;
                events.push(raw(format!("<span class=\"picture\">{picture}</span>")));
                self.image = true;
            }
            Event::End(TagEnd::Image) => self.image = false,
            _ if self.image => {}
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                let dest_url = from_target(&dest_url).into();
                events.push(Event::Start(Tag::Link { link_type, dest_url, title, id }));
            }
            Event::Start(Tag::Heading { level, .. }) => {
                self.heading = Some((level, String::new(), events.len()));
                events.push(raw(""));
            }
            Event::End(TagEnd::Heading(_)) => {
                if let Some((level, text, place)) = self.heading.take() {
                    let address = self.address(&text);
                    events[place] = raw(format!("<{level} id=\"{address}\">"));
                    events.push(raw(format!("</{level}>\n")));
                    match level {
                        HeadingLevel::H1 => self.title = text,
                        HeadingLevel::H2 => self.contents.push((address, text)),
                        _ => {}
                    }
                }
            }
            other => events.push(other),
        }
        Ok(())
    }

    /// The address that Markdown viewers give a heading.
    fn address(&mut self, text: &str) -> String {
        let kept = text.to_lowercase();
        let kept = kept.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        let address: String = kept.map(|c| if c == ' ' { '-' } else { c }).collect();
        let before = self.addresses.entry(address.clone()).or_default();
        *before += 1;
        if *before == 1 { address } else { format!("{address}-{}", *before - 1) }
    }
}

/// Where a link of a document in `docs` leads to from its HTML in `target/docs`.
fn from_target(link: &str) -> String {
    if DOCUMENTS.contains(&link) {
        return link.replace(".md", ".html");
    }
    if link.starts_with('#') || link.contains("://") {
        return link.to_owned();
    }
    match link.strip_prefix("../") {
        Some(above) => format!("../../{above}"),
        None => format!("../../docs/{link}"),
    }
}

fn raw<'a>(text: impl Into<CowStr<'a>>) -> Event<'a> {
    Event::InlineHtml(text.into())
}

fn math<'a>(latex: &str, display_mode: DisplayMode) -> Result<Event<'a>, HtmlError> {
    let wrong = |error: &dyn fmt::Display| HtmlError::Formula {
        latex: latex.to_owned(),
        error: error.to_string(),
    };
    let storage = Storage::new();
    let mut checked = Vec::new();
    for event in pulldown_latex::Parser::new(latex, &storage) {
        checked.push(event.map_err(|error| wrong(&error))?);
    }
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let mut mathml = String::new();
    let events = checked.into_iter().map(Ok::<_, pulldown_latex::ParserError>);
    push_mathml(&mut mathml, events, config).map_err(|error| wrong(&error))?;
    Ok(raw(mathml))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_tables_and_pictures_are_put_in() {
        let text = "# Title\n\n## Part one\n\n## Part two\n\n[b](errata.md)\n\n![axes](a.svg)\n\n$$\nx^{2}\n$$\n\n| a |\n|---|\n| $y$ |\n";
        let page = html(text, &[("a.svg", "<svg></svg>")]).unwrap();
        for part in [
            "<title>Title</title>",
            "href=\"#part-one\"",
            "href=\"errata.html\"",
            "<svg></svg>",
            "<math",
            "<div class=\"wide\">",
        ] {
            assert!(page.contains(part), "{part} is not in\n{page}");
        }
        assert!(!page.contains("axes"), "an inline picture needs no second text:\n{page}");
    }

    #[test]
    fn links_lead_from_the_folder_of_the_html() {
        let links = ["letter.md", "operations.md", "../codegen/src/lib.rs#L1", "#a", "https://a.b"];
        let found = links.map(from_target);
        let wanted = ["letter.html", "../../docs/operations.md", "../../codegen/src/lib.rs#L1"];
        assert_eq!(found[..3], wanted);
        assert_eq!(found[3..], links[3..]);
    }

    #[test]
    fn a_formula_that_cannot_be_set_is_an_error() {
        let error = html("$\\nonsense{x}$\n", &[]).unwrap_err();
        assert!(error.to_string().starts_with("formula `\\nonsense{x}` has no MathML"), "{error}");
    }
}
