//! The page around every text: list of pages, search, theme, headings of the text.

use serde::Serialize;
use tera::{Context, Tera};

use crate::markdown::{Rendered, escaped};
use crate::navigation::Navigation;
use crate::path::relative;
use crate::reference;
use crate::sources::path_of;

/// Files that every page needs.
pub(crate) const ASSETS: [(&str, &str); 2] = [
    ("site.css", include_str!("template/site.css")),
    ("site.js", include_str!("template/site.js")),
];

/// Headings that a page has at most and still lists two levels of them.
const MANY: usize = 24;

/// What all pages have.
pub(crate) struct Layout {
    navigation: Navigation,
    tera: Tera,
}

#[derive(Serialize)]
struct Part {
    title: String,
    entries: Vec<Entry>,
}

#[derive(Serialize)]
struct Entry {
    title: String,
    address: String,
    level: usize,
    here: bool,
}

impl Layout {
    /// The layout with this list of pages.
    pub(crate) fn new(navigation: Navigation) -> Result<Self, String> {
        let mut tera = Tera::default();
        tera.autoescape_on(Vec::<&str>::new());
        let added = tera.add_raw_template("page", include_str!("template/page.html.tera"));
        added.map_err(|error| format!("the template of a page: {error}"))?;
        Ok(Self { navigation, tera })
    }

    /// The sources of the pages in the list.
    pub(crate) fn sources(&self) -> impl Iterator<Item = &str> {
        let parts = self.navigation.parts.iter();
        parts.flat_map(|part| part.entries.iter().map(|entry| entry.source.as_str()))
    }

    /// The page at a path, of a source, around a text.
    pub(crate) fn page(
        &self,
        path: &str,
        source: &str,
        title: &str,
        rendered: &Rendered,
    ) -> Result<String, String> {
        let root = xtask::run::root();
        let mut parts = Vec::new();
        for part in &self.navigation.parts {
            let mut entries = Vec::new();
            for entry in &part.entries {
                let there = match reference::path(&entry.source) {
                    Some(there) => there.to_owned(),
                    None => path_of(&root, &entry.source)?,
                };
                entries.push(Entry {
                    title: escaped(&entry.title),
                    address: relative(path, &there),
                    level: 1,
                    here: there == path,
                });
            }
            parts.push(Part { title: escaped(&part.title), entries });
        }
        let mut context = Context::new();
        context.insert("title", &escaped(title));
        context.insert("source", &escaped(source));
        context.insert("top", relative(path, "x").strip_suffix('x').unwrap_or_default());
        context.insert("parts", &parts);
        context.insert("headings", &headings(rendered));
        context.insert("body", &rendered.body);
        self.tera.render("page", &context).map_err(|error| format!("{path}: {error}"))
    }
}

/// Headings below the title: of the second level, and of the third where they are not many.
fn headings(rendered: &Rendered) -> Vec<Entry> {
    let all = rendered.headings.iter();
    let deepest = if all.clone().filter(|heading| matches!(heading.level, 2 | 3)).count() > MANY {
        2
    } else {
        3
    };
    all.filter(|heading| (2..=deepest).contains(&heading.level))
        .map(|heading| Entry {
            title: escaped(&heading.title),
            address: heading.address.clone(),
            level: heading.level,
            here: false,
        })
        .collect()
}
