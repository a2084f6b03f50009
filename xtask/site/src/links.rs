//! Every address of every page leads to a file of the site, and every fragment to an element with that name.

use std::collections::{BTreeMap, BTreeSet};

use crate::folder::Folder;
use crate::path::joined;

/// Names of the elements of a page, by page.
type Names<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// Follows all; `others` are files whose elements are not known. Returns how many addresses were followed.
pub(crate) fn check<'a>(
    folder: &'a Folder,
    others: impl Iterator<Item = &'a str>,
) -> Result<usize, String> {
    let others: BTreeSet<&str> = others.collect();
    let names: Names<'_> = folder
        .pages()
        .map(|(path, _)| (path, values(folder.html(path), " id=\"").collect()))
        .collect();
    let (mut followed, mut dead) = (0, Vec::new());
    for (path, _) in folder.pages() {
        let html = folder.html(path);
        for target in values(html, " href=\"").chain(values(html, " src=\"")) {
            if is_elsewhere(target) {
                continue;
            }
            followed += 1;
            if !leads(path, target, folder, &names, &others) {
                dead.push(format!("{path}: {target}"));
            }
        }
    }
    dead.dedup();
    match dead.len() {
        0 => Ok(followed),
        count => Err(format!("{count} links lead nowhere:\n{}", dead.join("\n"))),
    }
}

/// Whether an address is of the web or of mail.
fn is_elsewhere(target: &str) -> bool {
    target.split(['/', '#']).next().unwrap_or_default().contains(':')
}

fn leads(
    page: &str,
    target: &str,
    folder: &Folder,
    names: &Names<'_>,
    others: &BTreeSet<&str>,
) -> bool {
    let (file, fragment) =
        target.split_once('#').map_or((target, None), |(file, f)| (file, Some(f)));
    let there = if file.is_empty() { Some(page.to_owned()) } else { joined(page, file) };
    let Some(there) = there else { return false };
    if others.contains(there.as_str()) {
        return true;
    }
    match (fragment, names.get(there.as_str())) {
        (None, _) => folder.has(&there),
        (Some(fragment), Some(names)) => names.contains(fragment),
        (Some(_), None) => false,
    }
}

/// The values of an attribute.
fn values<'a>(html: &'a str, name: &'a str) -> impl Iterator<Item = &'a str> {
    html.split(name).skip(1).filter_map(|after| after.split('"').next())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::folder::Page;

    #[test]
    fn dead_links_and_fragments_are_named() {
        let mut folder = Folder::default();
        let page = || Page { title: String::new(), sections: Vec::new() };
        let good = "<a href=\"b.html#here\"></a><img src=\"../p.svg\"><a href=\"https://a.b\"><a href=\"rust/x.html#y\">";
        folder.page("docs/a.html", good.replace("rust", "../rust"), page());
        folder.page("docs/b.html", "<p id=\"here\">".to_owned(), page());
        folder.bytes("p.svg", Vec::new());
        assert_eq!(check(&folder, ["rust/x.html"].into_iter()), Ok(3));
        for wrong in ["gone.html", "#gone", "b.html#gone", "../../b.html", "p.svg#a"] {
            folder.page("docs/c.html", format!("<a href=\"{wrong}\">"), page());
            let error = check(&folder, ["rust/x.html"].into_iter()).unwrap_err();
            assert_eq!(error, format!("1 links lead nowhere:\ndocs/c.html: {wrong}"));
        }
    }
}
