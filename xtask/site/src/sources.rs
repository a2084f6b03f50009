//! Pages of the repository's own files: those of the list, and whatever their pages link to, however far.

use std::collections::{BTreeSet, VecDeque};
use std::fs;
use std::path::Path;

use crate::folder::{Folder, Page, Section};
use crate::markdown::{Rendered, escaped, render};
use crate::navigation::LIST;
use crate::notebook;
use crate::page::Layout;
use crate::path::{joined, relative};
use crate::reference;

/// The page that opens first.
const FIRST: &str = "README.md";

/// A text that is longer is not shown as a page, but given as it is.
const LONGEST: usize = 400_000;

/// What a file of the repository is on the site.
enum Kind {
    Markdown,
    Notebook,
    /// A folder: a page that lists its files.
    Folder,
    /// Shown with numbered lines.
    Text,
    /// As it is: a picture, data.
    Bytes,
}

impl Kind {
    fn of(root: &Path, source: &str) -> Result<Self, String> {
        let path = root.join(source);
        if path.is_dir() {
            return Ok(Self::Folder);
        }
        let data = fs::metadata(&path).map_err(|error| format!("cannot read {source}: {error}"))?;
        let length = usize::try_from(data.len()).unwrap_or(usize::MAX);
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        Ok(match ending {
            "md" => Self::Markdown,
            "ipynb" => Self::Notebook,
            "svg" | "png" | "npz" => Self::Bytes,
            _ if length > LONGEST => Self::Bytes,
            _ => Self::Text,
        })
    }

    /// The path of the page, or of the file.
    fn path(&self, source: &str) -> String {
        match self {
            Self::Markdown if source == FIRST => "index.html".to_owned(),
            Self::Markdown => {
                source.strip_suffix("md").map_or_else(String::new, |s| format!("{s}html"))
            }
            Self::Notebook => {
                source.strip_suffix("ipynb").map_or_else(String::new, |s| format!("{s}html"))
            }
            Self::Folder => format!("{source}/index.html"),
            Self::Text => format!("{source}.html"),
            Self::Bytes => source.to_owned(),
        }
    }
}

/// The path on the site of a file of the repository.
pub(crate) fn path_of(root: &Path, source: &str) -> Result<String, String> {
    Ok(Kind::of(root, source)?.path(source))
}

/// Writes the pages.
pub(crate) fn pages(root: &Path, layout: &Layout, folder: &mut Folder) -> Result<(), String> {
    let mut found = Found { root, waiting: VecDeque::new(), seen: BTreeSet::new() };
    for source in layout.sources().chain([FIRST, LIST]) {
        if !reference::is_made(source) {
            found.add(source)?;
        }
    }
    while let Some(source) = found.waiting.pop_front() {
        found.make(&source, layout, folder)?;
    }
    Ok(())
}

/// What is to be made, and what was met before.
struct Found<'a> {
    root: &'a Path,
    waiting: VecDeque<String>,
    seen: BTreeSet<String>,
}

impl Found<'_> {
    /// Notes a file; returns its path on the site.
    fn add(&mut self, source: &str) -> Result<String, String> {
        let path = path_of(self.root, source)?;
        if self.seen.insert(source.to_owned()) {
            self.waiting.push_back(source.to_owned());
        }
        Ok(path)
    }

    fn make(&mut self, source: &str, layout: &Layout, folder: &mut Folder) -> Result<(), String> {
        let kind = Kind::of(self.root, source)?;
        let path = kind.path(source);
        let file = self.root.join(source);
        let wrong = |error| format!("cannot read {source}: {error}");
        let rendered = match kind {
            Kind::Markdown => {
                let text = fs::read_to_string(file).map_err(wrong)?;
                render(&text, &mut |link| self.lead(source, &path, link))?
            }
            Kind::Notebook => {
                let text = fs::read_to_string(file).map_err(wrong)?;
                let text = notebook::markdown(source, &text)?;
                render(&text, &mut |link| self.lead(source, &path, link))?
            }
            Kind::Folder => self.listed(source, &path)?,
            Kind::Text => shown(source, &fs::read_to_string(file).map_err(wrong)?),
            Kind::Bytes => {
                folder.bytes(&path, fs::read(file).map_err(wrong)?);
                return Ok(());
            }
        };
        let title = rendered.title().unwrap_or(source).to_owned();
        let html = layout.page(&path, source, &title, &rendered)?;
        // Of a text of code every word would be found; its name is enough.
        let sections = if matches!(kind, Kind::Text) { Vec::new() } else { rendered.sections };
        folder.page(&path, html, Page { title, sections });
        Ok(())
    }

    /// The address that a link of a page has on the site.
    fn lead(&mut self, source: &str, path: &str, link: &str) -> Result<String, String> {
        let scheme = link.split(['/', '#']).next().unwrap_or_default();
        if scheme.contains(':') || link.starts_with('#') {
            return Ok(link.to_owned());
        }
        let (file, fragment) =
            link.split_once('#').map_or((link, None), |(file, f)| (file, Some(f)));
        let target = joined(source, file).filter(|target| self.root.join(target).exists());
        let target = target.ok_or_else(|| format!("{source}: the link `{link}` leads nowhere"))?;
        let target = relative(path, &self.add(&target)?);
        Ok(fragment.map_or_else(|| target.clone(), |fragment| format!("{target}#{fragment}")))
    }

    /// The page of a folder: its texts and folders by name.
    fn listed(&mut self, source: &str, path: &str) -> Result<Rendered, String> {
        let wrong = |error| format!("cannot read {source}: {error}");
        let mut names = Vec::new();
        for entry in fs::read_dir(self.root.join(source)).map_err(wrong)? {
            names.push(entry.map_err(wrong)?.file_name().to_string_lossy().into_owned());
        }
        names.sort();
        let mut text = format!("# {source}\n\n");
        for name in names {
            put!(text, "- [{name}]({name})\n");
        }
        render(&text, &mut |link| {
            let target = self.add(&format!("{source}/{link}"))?;
            Ok(relative(path, &target))
        })
    }
}

/// A text with numbered lines, to which links lead.
fn shown(source: &str, text: &str) -> Rendered {
    let mut body = format!("<h1>{}</h1>\n<pre class=\"lines\"><code>", escaped(source));
    for (line, number) in text.lines().zip(1..) {
        put!(body, "<span id=\"L{number}\">{}</span>\n", escaped(line));
    }
    body.push_str("</code></pre>\n");
    let section = Section { address: String::new(), title: String::new(), text: String::new() };
    Rendered { body, headings: Vec::new(), sections: vec![section] }
}
