//! Records and function heads as C declares them, with their documentation.

use crate::emit::body::Counts;
use crate::emit::parts::Part;
use crate::emit::text::{COMMENT, LINE, wrapped};
use crate::kernel::{Field, Record, Source};

/// The tag of a record: `precess_hub_share`, or `precess_dgvscmg_prepared`.
#[must_use]
pub fn tag(kind: &str, record: &Record) -> String {
    let name = snake(&record.name);
    if record.shared { format!("precess_{name}") } else { format!("precess_{kind}_{name}") }
}

/// A function's name: `precess_dgvscmg_eliminate`.
#[must_use]
pub fn function(kind: &str, name: &str) -> String {
    format!("precess_{kind}_{name}")
}

/// The structure of a record.
pub(super) fn structure(kind: &str, record: &Record) -> String {
    let mut lines = comment(&[&plain(&record.doc)], 0);
    lines.push(format!("struct {} {{", tag(kind, record)));
    for Field { name, doc, source } in &record.fields {
        lines.extend(comment(&[&plain(doc)], 4));
        lines.push(match source {
            Source::Nested(record) => format!("    struct {} {name};", tag(kind, record)),
            Source::Own | Source::Named(_) => format!("    double {name};"),
        });
    }
    lines.push("};".to_owned());
    lines.join("\n")
}

/// The declaration of a function, with what it costs.
pub(super) fn declaration(kind: &str, part: &Part) -> String {
    let Counts { mul, add, neg, div } = part.body.counts;
    let doc = plain(&part.doc.join(" "));
    let cost = format!("Operations: {mul} mul, {add} add, {neg} neg, {div} div, 0 trig.");
    let mut lines = comment(&[&doc, &cost], 0);
    lines.push(format!("{};", head(kind, part)));
    lines.join("\n")
}

/// Name and arguments of a function; what it finds is the last of them.
pub(super) fn head(kind: &str, part: &Part) -> String {
    let input =
        |(letter, record): &(&str, Record)| format!("const struct {} *{letter}", tag(kind, record));
    let output = format!("struct {} *out", tag(kind, &part.output));
    let arguments: Vec<_> = part.inputs.iter().map(input).chain([output]).collect();
    let name = function(kind, &part.name);
    let line = format!("void {name}({})", arguments.join(", "));
    if line.len() < LINE {
        return line;
    }
    format!("void {name}(\n    {})", arguments.join(",\n    "))
}

/// Paragraphs as a comment that documentation tools read.
fn comment(paragraphs: &[&str], indent: usize) -> Vec<String> {
    let pad = " ".repeat(indent);
    let wrapped: Vec<_> = paragraphs.iter().map(|text| wrapped(text, COMMENT - indent)).collect();
    if let [[line]] = wrapped.iter().map(Vec::as_slice).collect::<Vec<_>>().as_slice() {
        return vec![format!("{pad}/** {line} */")];
    }
    let mut lines = vec![format!("{pad}/**")];
    for (k, paragraph) in wrapped.iter().enumerate() {
        if k > 0 {
            lines.push(format!("{pad} *"));
        }
        lines.extend(paragraph.iter().map(|line| format!("{pad} * {line}")));
    }
    lines.push(format!("{pad} */"));
    lines
}

/// A title above statements; none where they have none.
pub(super) fn title(text: &str) -> Vec<String> {
    if text.is_empty() {
        return Vec::new();
    }
    let lines = wrapped(text, COMMENT);
    let last = lines.len() - 1;
    let frame = |(k, line): (usize, &String)| {
        let (open, close) =
            (if k == 0 { "/* " } else { " * " }, if k == last { " */" } else { "" });
        format!("{open}{line}{close}")
    };
    lines.iter().enumerate().map(frame).collect()
}

/// Documentation without the links of Rust's.
fn plain(doc: &str) -> String {
    doc.replace("[`", "`").replace("`]", "`")
}

/// `HubShare` to `hub_share`.
fn snake(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_in_snake_case() {
        assert_eq!(snake("HubShare"), "hub_share");
        assert_eq!(snake("Axes"), "axes");
    }

    #[test]
    fn a_comment_takes_as_many_lines_as_it_needs() {
        assert_eq!(comment(&["Mass, kg."], 4), ["    /** Mass, kg. */"]);
        let two = comment(&["One.", "Two."], 0);
        assert_eq!(two, ["/**", " * One.", " *", " * Two.", " */"]);
        let long = title(&"word ".repeat(30));
        assert!(long.len() == 2 && long[0].starts_with("/* ") && long[1].ends_with(" */"));
    }
}
