//! Relative links and images of the Markdown pages lead to files that exist, and fragments to headings.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Folders of pages, each with whether the folders in it are searched too.
const FOLDERS: [(&str, bool); 3] = [("docs", false), ("flight", true), ("tests", true)];

#[test]
fn every_link_of_the_pages_leads_somewhere() {
    let root = Path::new(ROOT);
    let pages = pages(root);
    assert!(pages.len() > 20, "{} pages", pages.len());
    let broken: Vec<String> = pages.iter().flat_map(|page| broken_in(root, page)).collect();
    assert!(broken.is_empty(), "broken links:\n{}", broken.join("\n"));
}

#[test]
fn broken_links_of_a_text_are_found() {
    let headings = |page: &str| match page {
        "docs/other.md" => Some("# Other\n\n## Same\n\n## Same\n".to_owned()),
        "docs/picture.svg" => Some(String::new()),
        _ => None,
    };
    let found = |text: &str| {
        let text = format!("# The guide\n\n## `sin` and cos, 2 of them\n\n{text}");
        broken("docs/guide.md", &text, &headings)
    };
    for text in [
        "[other](other.md) and ![a picture](picture.svg)",
        "[here](#sin-and-cos-2-of-them), [above](#the-guide)",
        "[second](other.md#same-1) [root](../docs/other.md#other \"a title\")",
        "[web](https://example.org/no.md) [mail](mailto:a@example.org)",
        "`[code](no.md)`\n\n```text\n[block](no.md)\n```\n",
        "[![linked picture](picture.svg)](other.md)",
        "[by name][name]\n\n[name]: other.md",
    ] {
        assert_eq!(found(text), Vec::<String>::new(), "{text}");
    }
    for (text, target) in [
        ("[gone](gone.md)", "gone.md"),
        ("![gone](gone.svg)", "gone.svg"),
        ("[heading](#no-such-heading)", "#no-such-heading"),
        ("[third](other.md#same-2)", "other.md#same-2"),
        ("[case](Other.md)", "Other.md"),
        ("a [link\nacross lines](gone.md)", "gone.md"),
        ("[![linked picture](gone.svg)](other.md)", "gone.svg"),
        ("[![linked picture](picture.svg)](gone.md)", "gone.md"),
        ("[by name][name]\n\n[name]: gone.md", "gone.md"),
        ("<img src=\"gone.svg\" width=\"50%\">", "gone.svg"),
        ("[above the root](../../gone.md)", "../../gone.md"),
    ] {
        assert_eq!(found(text), [format!("docs/guide.md: {target}")], "{text}");
    }
}

#[test]
fn slugs_are_those_of_github() {
    for (heading, expected) in [
        ("How good it is", "how-good-it-is"),
        ("What is *not* here: f32, `f64`!", "what-is-not-here-f32-f64"),
        ("Names, [linked](a.md)", "names-linked"),
        ("snake_case & two  spaces", "snake_case--two--spaces"),
        ("Größe ²", "größe-"),
    ] {
        assert_eq!(slugs(&format!("# {heading}\n")), BTreeSet::from([expected.to_owned()]));
    }
}

/// The pages by their paths from the root, sorted.
fn pages(root: &Path) -> Vec<String> {
    let mut pages = vec!["CHANGELOG.md".to_owned(), "README.md".to_owned()];
    for (folder, deep) in FOLDERS {
        add_pages(root, folder, deep, &mut pages);
    }
    pages.sort();
    pages
}

fn add_pages(root: &Path, folder: &str, deep: bool, pages: &mut Vec<String>) {
    let entries = fs::read_dir(root.join(folder)).expect("a folder of pages");
    for entry in entries.map(|entry| entry.expect("an entry")) {
        let name = entry.file_name().into_string().expect("a name in Unicode");
        let path = format!("{folder}/{name}");
        let is_folder = entry.file_type().expect("a type").is_dir();
        if is_folder && deep && name != "target" && !name.starts_with('.') {
            add_pages(root, &path, deep, pages);
        } else if !is_folder && has_ending(&name, "md") {
            pages.push(path);
        }
    }
}

fn has_ending(path: &str, ending: &str) -> bool {
    Path::new(path).extension().is_some_and(|found| found == ending)
}

fn broken_in(root: &Path, page: &str) -> Vec<String> {
    let text = fs::read_to_string(root.join(page)).expect("a page");
    // Only Markdown has headings to look up; of everything else it is enough that it exists.
    broken(page, &text, &|path| {
        let text = || fs::read_to_string(root.join(path)).ok();
        if has_ending(path, "md") { text() } else { root.join(path).exists().then(String::new) }
    })
}

/// The links of a page that lead nowhere. `read` returns the text of a path from the root, none where
/// there is nothing.
fn broken(page: &str, text: &str, read: &dyn Fn(&str) -> Option<String>) -> Vec<String> {
    let folder = Path::new(page).parent().unwrap_or(Path::new(""));
    let holds = |target: &str| {
        let (path, fragment) = target.split_once('#').unwrap_or((target, ""));
        let path = match path {
            "" => Some(page.to_owned()),
            _ => normal(&folder.join(path)),
        };
        let Some(path) = path else { return false };
        let text = if path == page { Some(text.to_owned()) } else { read(&path) };
        let of_page = fragment.is_empty() || !has_ending(&path, "md");
        text.is_some_and(|text| of_page || slugs(&text).contains(fragment))
    };
    let targets = targets(text).into_iter().filter(|target| is_relative(target));
    targets.filter(|target| !holds(target)).map(|target| format!("{page}: {target}")).collect()
}

/// The path without `.` and `..`, with `/` between its parts; none where it leaves the root.
fn normal(path: &Path) -> Option<String> {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if parts.pop() => {}
            Component::Normal(name) => parts.push(name),
            _ => return None,
        }
    }
    let parts: Option<Vec<&str>> = parts.iter().map(|part| part.to_str()).collect();
    Some(parts?.join("/"))
}

/// Whether a target is neither an address of the web nor of mail.
fn is_relative(target: &str) -> bool {
    let scheme = target.split(['/', '#']).next().unwrap_or_default();
    !scheme.contains(':')
}

/// The text as a viewer of Markdown reads it, formulas and tables included.
fn events(text: &str) -> Parser<'_> {
    Parser::new_ext(text, Options::ENABLE_TABLES | Options::ENABLE_MATH)
}

/// Targets of links and images, `src` and `href` attributes among them.
fn targets(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for event in events(text) {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                found.push(dest_url.into_string());
            }
            Event::Html(tags) | Event::InlineHtml(tags) => {
                for after in
                    [" src=\"", " href=\""].into_iter().flat_map(|name| tags.split(name).skip(1))
                {
                    found.extend(after.split('"').next().map(str::to_owned));
                }
            }
            _ => {}
        }
    }
    found
}

/// The fragments that lead into a page: its headings, numbered where they repeat.
fn slugs(text: &str) -> BTreeSet<String> {
    let (mut slugs, mut heading) = (BTreeSet::new(), None);
    for event in events(text) {
        match event {
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(text) | Event::Code(text) | Event::InlineMath(text) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&text);
                }
            }
            Event::End(TagEnd::Heading(_)) => {
                let slug = slug(&heading.take().unwrap_or_default());
                let numbered = (1..).map(|number| format!("{slug}-{number}"));
                let mut all = std::iter::once(slug.clone()).chain(numbered);
                slugs.extend(all.find(|slug| !slugs.contains(slug)));
            }
            _ => {}
        }
    }
    slugs
}

/// GitHub's rule: lower case, spaces to hyphens, everything else that is no letter, digit, hyphen or
/// underscore dropped.
fn slug(heading: &str) -> String {
    let kept = |c: char| c.is_alphabetic() || c.is_ascii_digit() || matches!(c, '_' | '-' | ' ');
    let accent = |c: char| ('\u{300}'..='\u{36f}').contains(&c);
    let slug =
        heading.to_lowercase().chars().filter(|c| kept(*c) || accent(*c)).collect::<String>();
    slug.replace(' ', "-")
}
