//! The list of pages in four parts, which `docs/README.md` has for those who read in the repository: a heading of the
//! second level for a part, and the first link of each row of its table for a page.

use std::fs;
use std::path::Path;

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd};

use crate::path::joined;

/// The list itself.
pub(crate) const LIST: &str = "docs/README.md";

/// The parts of the site.
pub(crate) struct Navigation {
    pub(crate) parts: Vec<Part>,
}

/// A part: what it is called, and its pages.
pub(crate) struct Part {
    pub(crate) title: String,
    pub(crate) entries: Vec<Entry>,
}

/// A page of the list: its source from the root, and what the list calls it.
pub(crate) struct Entry {
    pub(crate) source: String,
    pub(crate) title: String,
}

impl Navigation {
    /// Reads the list of a repository.
    pub(crate) fn read(root: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(root.join(LIST));
        let text = text.map_err(|error| format!("cannot read {LIST}: {error}"))?;
        let parts = parts(&text)?;
        if parts.is_empty() || parts.iter().any(|part| part.entries.is_empty()) {
            return Err(format!(
                "{LIST}: a part without pages; give each heading a table of links"
            ));
        }
        Ok(Self { parts })
    }
}

/// The parts of a list.
fn parts(text: &str) -> Result<Vec<Part>, String> {
    let (mut parts, mut heading, mut link) = (Vec::<Part>::new(), None, None);
    for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::Heading { level: HeadingLevel::H2, .. }) => {
                heading = Some(String::new());
            }
            Event::End(TagEnd::Heading(HeadingLevel::H2)) => {
                parts.extend(heading.take().map(|title| Part { title, entries: Vec::new() }));
            }
            Event::Start(Tag::Link { dest_url, .. }) => {
                link = Some((dest_url.into_string(), String::new()));
            }
            Event::End(TagEnd::Link) => {
                if let (Some(part), Some((url, title))) = (parts.last_mut(), link.take()) {
                    let source = joined(LIST, &url).filter(|_| !url.contains('#'));
                    let source = source.ok_or_else(|| format!("{LIST}: `{url}` is no page"))?;
                    part.entries.push(Entry { source, title });
                }
            }
            Event::Text(text) | Event::Code(text) => {
                let open = heading.as_mut().or(link.as_mut().map(|(_, title)| title));
                if let Some(open) = open {
                    open.push_str(&text);
                }
            }
            _ => {}
        }
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_pages_are_read_in_order() {
        let text = "# All\n\n[not](in.md) a part\n\n## Learn\n\n| page | |\n|---|---|\n| [the `guide`](guide.md) | x |\n\
                    | [C](../flight/README.md) | y |\n\n## Use\n\n| page | |\n|---|---|\n| [c](c.md) | |\n";
        let parts = parts(text).unwrap();
        let read: Vec<_> = parts
            .iter()
            .flat_map(|part| {
                part.entries.iter().map(|entry| (&*part.title, &*entry.source, &*entry.title))
            })
            .collect();
        let wanted = [
            ("Learn", "docs/guide.md", "the guide"),
            ("Learn", "flight/README.md", "C"),
            ("Use", "docs/c.md", "c"),
        ];
        assert_eq!(read, wanted);
    }
}
