//! Markdown to HTML: formulas as `MathML`, headings with the addresses that viewers of Markdown give them, tables that
//! scroll by themselves, links led where a function says.

use std::collections::BTreeMap;

use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{RenderConfig, Storage, push_mathml};

use crate::folder::Section;

/// A heading: its level, address and text.
pub(crate) struct Heading {
    pub(crate) level: usize,
    pub(crate) address: String,
    pub(crate) title: String,
}

impl Heading {
    pub(crate) fn new(level: usize, address: &str, title: &str) -> Self {
        Self { level, address: address.to_owned(), title: title.to_owned() }
    }
}

/// A text as HTML.
#[derive(Default)]
pub(crate) struct Rendered {
    pub(crate) body: String,
    pub(crate) headings: Vec<Heading>,
    pub(crate) sections: Vec<Section>,
}

impl Rendered {
    /// The first heading of the first level.
    pub(crate) fn title(&self) -> Option<&str> {
        let first = self.headings.iter().find(|heading| heading.level == 1);
        first.map(|heading| heading.title.as_str())
    }
}

/// The HTML of a text. `lead` turns the target of a link or a picture into its address.
pub(crate) fn render(
    text: &str,
    lead: &mut dyn FnMut(&str) -> Result<String, String>,
) -> Result<Rendered, String> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let mut writer = Writer::default();
    writer.rendered.sections.push(section(String::new(), String::new()));
    let mut events = Vec::new();
    for event in Parser::new_ext(text, options) {
        writer.event(event, lead, &mut events)?;
    }
    pulldown_cmark::html::push_html(&mut writer.rendered.body, events.into_iter());
    Ok(writer.rendered)
}

fn section(address: String, title: String) -> Section {
    Section { address, title, text: String::new() }
}

/// What is known of a text while it is read.
#[derive(Default)]
struct Writer {
    rendered: Rendered,
    /// The heading that is open: its text, and where its tag goes.
    heading: Option<(String, usize)>,
    addresses: BTreeMap<String, usize>,
}

impl Writer {
    fn event<'a>(
        &mut self,
        event: Event<'a>,
        lead: &mut dyn FnMut(&str) -> Result<String, String>,
        events: &mut Vec<Event<'a>>,
    ) -> Result<(), String> {
        self.read(&event);
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
            Event::Start(Tag::Image { link_type, dest_url, title, id }) => {
                let dest_url = lead(&dest_url)?.into();
                events.push(Event::Start(Tag::Image { link_type, dest_url, title, id }));
            }
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                let dest_url = lead(&dest_url)?.into();
                events.push(Event::Start(Tag::Link { link_type, dest_url, title, id }));
            }
            Event::Start(Tag::Heading { .. }) => {
                self.heading = Some((String::new(), events.len()));
                events.push(raw(""));
            }
            Event::End(TagEnd::Heading(level)) => {
                if let Some((title, place)) = self.heading.take() {
                    let address = self.opened(level, title);
                    events[place] = raw(format!("<{level} id=\"{address}\">"));
                    let mark = format!(
                        "<a class=\"mark\" href=\"#{address}\" aria-hidden=\"true\" tabindex=\"-1\">#</a>"
                    );
                    events.push(raw(format!("{mark}</{level}>\n")));
                }
            }
            other => events.push(other),
        }
        Ok(())
    }

    /// Adds the words of an event to the heading that is open, and to the section.
    fn read(&mut self, event: &Event<'_>) {
        let words: &str = match event {
            Event::Text(text) | Event::Code(text) | Event::InlineMath(text) => text,
            Event::SoftBreak
            | Event::HardBreak
            | Event::End(TagEnd::TableCell | TagEnd::Paragraph | TagEnd::Item) => " ",
            _ => return,
        };
        if let Some((title, _)) = &mut self.heading {
            title.push_str(words);
        } else if let Some(section) = self.rendered.sections.last_mut() {
            section.text.push_str(words);
        }
    }

    /// Closes a heading: a section begins. Returns its address.
    fn opened(&mut self, level: HeadingLevel, title: String) -> String {
        let address = self.address(&title);
        self.rendered.sections.push(section(address.clone(), title.clone()));
        self.rendered.headings.push(Heading {
            level: level as usize,
            address: address.clone(),
            title,
        });
        address
    }

    /// The address of a heading, numbered where it repeats.
    fn address(&mut self, title: &str) -> String {
        let address = slug(title);
        let before = self.addresses.entry(address.clone()).or_default();
        *before += 1;
        if *before == 1 { address } else { format!("{address}-{}", *before - 1) }
    }
}

/// GitHub's rule: lower case, spaces to hyphens, everything else that is no letter, digit, hyphen or underscore dropped.
pub(crate) fn slug(heading: &str) -> String {
    let kept = |c: &char| {
        c.is_alphabetic()
            || c.is_ascii_digit()
            || "_- ".contains(*c)
            || ('\u{300}'..='\u{36f}').contains(c)
    };
    heading.to_lowercase().chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect()
}

fn raw<'a>(text: impl Into<CowStr<'a>>) -> Event<'a> {
    Event::InlineHtml(text.into())
}

fn math<'a>(latex: &str, display_mode: DisplayMode) -> Result<Event<'a>, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("formula `{latex}` has no MathML: {error}");
    let storage = Storage::new();
    let mut checked = Vec::new();
    let prepared = prepared(latex);
    for event in pulldown_latex::Parser::new(&prepared, &storage) {
        checked.push(event.map_err(|error| wrong(&error))?);
    }
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let mut mathml = String::new();
    let events = checked.into_iter().map(Ok::<_, pulldown_latex::ParserError>);
    push_mathml(&mut mathml, events, config).map_err(|error| wrong(&error))?;
    Ok(raw(mathml))
}

/// What the converter reads otherwise than LaTeX does: numbers of equations, and a bracket at the beginning of a row.
fn prepared(latex: &str) -> String {
    let mut parts = latex.split("\\tag{");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (number, after) = part.split_once('}').unwrap_or((part, ""));
        put!(text, "\\qquad \\text{{({number})}}{after}");
    }
    let mut rows = text.split("\\\\");
    let mut text = rows.next().unwrap_or_default().to_owned();
    for row in rows {
        text.push_str("\\\\");
        // A length is written against the end of its row.
        text.push_str(if row.starts_with(char::is_whitespace) { " {}" } else { "" });
        text.push_str(row);
    }
    text
}

/// Text between tags and in attributes.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_tables_links_and_pictures_are_put_in() {
        let text = "# Title\n\nBefore $a$.\n\n## Part one\n\n[b](errata.md)\n\n## Part one\n\n![axes](a.svg)\n\n\
                    $$\nx^{2}\n$$\n\n| a |\n|---|\n| $y$ |\n";
        let mut led = Vec::new();
        let rendered = render(text, &mut |target| {
            led.push(target.to_owned());
            Ok(format!("there/{target}"))
        });
        let rendered = rendered.unwrap();
        for part in [
            "<h2 id=\"part-one\">Part one<a",
            "<h2 id=\"part-one-1\">",
            "href=\"there/errata.md\"",
            "src=\"there/a.svg\" alt=\"axes\"",
            "<span class=\"formula\"><math",
            "<div class=\"wide\"><table>",
        ] {
            assert!(rendered.body.contains(part), "{part} is not in\n{}", rendered.body);
        }
        assert_eq!(led, ["errata.md", "a.svg"]);
        assert_eq!(rendered.title(), Some("Title"));
        let sections: Vec<_> =
            rendered.sections.iter().map(|s| (&*s.address, s.text.trim())).collect();
        assert_eq!(sections[1..3], [("title", "Before a."), ("part-one", "b")]);
    }

    #[test]
    fn a_formula_that_cannot_be_set_and_a_dead_link_are_errors() {
        let wrong =
            |text: &str| render(text, &mut |target| Err(format!("{target} is not there"))).err();
        assert!(
            wrong("$\\nonsense{x}$\n")
                .is_some_and(|e| e.starts_with("formula `\\nonsense{x}` has no MathML"))
        );
        assert_eq!(wrong("[a](gone.md)").as_deref(), Some("gone.md is not there"));
    }
}
