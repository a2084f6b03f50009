//! The Python reference, from the docstrings of the package as its sources have them: nothing is imported.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;
use xtask::run::{is_there, output};
use xtask::skip::skip;

use crate::folder::Section;
use crate::markdown::{Heading, Rendered, escaped};

use super::Add;

/// What the list names it by.
pub(super) const SOURCE: &str = "python/precess/__init__.py";

/// What reads the sources.
const READER: &str = include_str!("python.py");

#[derive(Deserialize)]
struct Module {
    name: String,
    doc: String,
    items: Vec<Item>,
}

/// A function, a class, or a member of one.
#[derive(Deserialize)]
struct Item {
    name: String,
    signature: String,
    doc: String,
    members: Vec<Item>,
}

/// A page for each module, and one in front of them.
pub(super) fn pages(root: &Path, add: &mut Add<'_>) -> Result<(), String> {
    let mut contents = Rendered {
        body: "<h1 id=\"python\">Python</h1>\n".to_owned(),
        headings: vec![Heading::new(1, "python", "Python")],
        sections: Vec::new(),
    };
    if !is_there("python3") {
        skip("the Python reference", "apt-get install python3")?;
        contents
            .body
            .push_str("<p>This copy was made without it, on a machine without Python.</p>\n");
        return add("python/index.html", SOURCE, "Python", contents);
    }
    let folder = root.join("python/precess");
    let read = output(Command::new("python3").args(["-I", "-c", READER]).arg(&folder))?;
    let modules: Vec<Module> = serde_json::from_str(&read)
        .map_err(|error| format!("what Python says of python/precess: {error}"))?;
    contents.body.push_str("<ul>\n");
    for module in modules {
        let address = format!("{}.html", module.name);
        let first = module.doc.lines().next().unwrap_or_default();
        let name = &module.name;
        put!(
            contents.body,
            "<li><a href=\"{address}\"><code>{name}</code></a>: {}</li>\n",
            inline(first)
        );
        add(&format!("python/{address}"), &format!("python/precess: {name}"), name, page(&module))?;
    }
    contents.body.push_str("</ul>\n");
    add("python/index.html", SOURCE, "Python", contents)
}

fn page(module: &Module) -> Rendered {
    let name = &module.name;
    let mut rendered = Rendered {
        body: format!("<h1 id=\"{name}\"><code>{name}</code></h1>\n{}", docstring(&module.doc)),
        headings: vec![Heading::new(1, name, name)],
        sections: vec![section(name, &module.doc)],
    };
    for item in &module.items {
        put(item, "", 2, &mut rendered);
    }
    rendered
}

fn section(name: &str, doc: &str) -> Section {
    Section { address: name.to_owned(), title: name.to_owned(), text: doc.to_owned() }
}

/// A function or a class with its members.
fn put(item: &Item, of: &str, level: usize, rendered: &mut Rendered) {
    let name = format!("{of}{}", item.name);
    put!(
        rendered.body,
        "<h{level} id=\"{name}\"><code>{name}</code></h{level}>\n<pre><code>{}</code></pre>\n{}",
        escaped(&item.signature),
        docstring(&item.doc)
    );
    rendered.headings.push(Heading::new(level, &name, &name));
    rendered.sections.push(section(&name, &item.doc));
    for member in &item.members {
        put(member, &format!("{name}."), 3, rendered);
    }
}

/// A docstring of numpydoc: paragraphs, sections whose titles are underlined, examples, entries with what is said of
/// each below it.
fn docstring(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let (mut html, mut index) = (String::new(), 0);
    while index < lines.len() {
        let line = lines[index];
        let is_underline = |line: &&str| line.len() > 2 && line.chars().all(|c| c == '-');
        let end = |from: usize, goes_on: &dyn Fn(&str) -> bool| {
            let more = lines[from..].iter().take_while(|line| goes_on(line));
            from + more.count()
        };
        if line.trim().is_empty() {
            index += 1;
        } else if lines.get(index + 1).is_some_and(is_underline) {
            put!(html, "<p class=\"part\">{}</p>\n", escaped(line));
            index += 2;
        } else if line.starts_with(">>>") || line.starts_with("    ") {
            let last = end(index, &|line| !line.trim().is_empty());
            put!(html, "<pre><code>{}</code></pre>\n", escaped(&lines[index..last].join("\n")));
            index = last;
        } else if lines.get(index + 1).is_some_and(|next| next.starts_with("    ")) {
            let last = end(index + 1, &|line| line.starts_with("    "));
            let said =
                lines[index + 1..last].iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
            put!(
                html,
                "<dl><dt><code>{}</code></dt><dd>{}</dd></dl>\n",
                escaped(line),
                inline(&said)
            );
            index = last;
        } else {
            let last = end(index, &|line| !line.trim().is_empty() && !line.starts_with("    "));
            put!(html, "<p>{}</p>\n", inline(&lines[index..last].join(" ")));
            index = last;
        }
    }
    html
}

/// A line of a docstring: ``code`` and the names that roles refer to.
fn inline(text: &str) -> String {
    let mut html = String::new();
    for (part, index) in escaped(text).split("``").zip(0..) {
        if index % 2 == 1 {
            put!(html, "<code>{part}</code>");
            continue;
        }
        for (part, index) in part.split('`').zip(0..) {
            if index % 2 == 1 {
                put!(html, "<code>{}</code>", part.trim_start_matches('~'));
            } else {
                html.push_str(without_role(part));
            }
        }
    }
    html
}

/// What is before a name without the role at its end, as `:class:`.
fn without_role(text: &str) -> &str {
    let Some(before) = text.strip_suffix(':') else { return text };
    let role = before.rsplit(':').next().unwrap_or_default();
    let is_role = before.len() > role.len()
        && !role.is_empty()
        && role.chars().all(|c| c.is_ascii_lowercase());
    if is_role { &before[..before.len() - role.len() - 1] } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn docstrings_are_set() {
        let text = "Runs it: ``a < b``.\n\nSee :class:`~precess.State`.\n\nParameters\n----------\ndt : float\n    Step, s.\n    Above 0.\n\n>>> run()\n1";
        let wanted = "<p>Runs it: <code>a &lt; b</code>.</p>\n<p>See <code>precess.State</code>.</p>\n\
                      <p class=\"part\">Parameters</p>\n<dl><dt><code>dt : float</code></dt><dd>Step, s. Above 0.</dd></dl>\n\
                      <pre><code>&gt;&gt;&gt; run()\n1</code></pre>\n";
        assert_eq!(docstring(text), wanted);
        assert_eq!(inline("no: `a`"), "no: <code>a</code>");
    }
}
