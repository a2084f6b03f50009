//! Paths between pages: from the repository's root, with `/`; addresses relative to the page that has them.

use std::path::{Component, Path};

/// A path from a page's folder, without `.` and `..`; none where it leaves the root.
pub(crate) fn joined(page: &str, link: &str) -> Option<String> {
    let mut parts: Vec<&str> = folder(page).split('/').filter(|part| !part.is_empty()).collect();
    for part in Path::new(link).components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                parts.pop()?;
            }
            Component::Normal(name) => parts.push(name.to_str()?),
            _ => return None,
        }
    }
    Some(parts.join("/"))
}

/// The address of a file from a page, both from the root.
pub(crate) fn relative(page: &str, file: &str) -> String {
    let from: Vec<&str> = folder(page).split('/').filter(|part| !part.is_empty()).collect();
    let to: Vec<&str> = file.split('/').collect();
    let common = from.iter().zip(&to[..to.len() - 1]).take_while(|(a, b)| a == b).count();
    let up = std::iter::repeat_n("..", from.len() - common);
    up.chain(to[common..].iter().copied()).collect::<Vec<_>>().join("/")
}

fn folder(page: &str) -> &str {
    page.rsplit_once('/').map_or("", |(folder, _)| folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_joined_and_led_back() {
        for (page, link, path) in [
            ("docs/guide.md", "../README.md", Some("README.md")),
            ("docs/guide.md", "./c.md", Some("docs/c.md")),
            ("README.md", "docs/c.md", Some("docs/c.md")),
            ("README.md", "../c.md", None),
            ("a/b/c.md", "../d/e.md", Some("a/d/e.md")),
        ] {
            assert_eq!(joined(page, link).as_deref(), path, "{link} of {page}");
        }
        for (page, file, address) in [
            ("docs/guide.html", "index.html", "../index.html"),
            ("docs/guide.html", "docs/c.html", "c.html"),
            ("index.html", "docs/c.html", "docs/c.html"),
            ("a/b/c.html", "a/d/e.html", "../d/e.html"),
        ] {
            assert_eq!(relative(page, file), address, "{file} from {page}");
        }
    }
}
