//! The C reference, from the headers of the library: each comment in front of what it says, in the headers' order.

use std::fs;
use std::path::Path;

use crate::folder::Section;
use crate::markdown::{Heading, Rendered, escaped};

use super::Add;

/// What the list names it by.
pub(super) const SOURCE: &str = "flight/capi/include/precess.h";

/// Where the headers are, and what each is about.
const FOLDER: &str = "flight/capi/include";
const HEADERS: [(&str, &str); 4] = [
    ("precess.h", "spacecraft, states, accelerations, steps"),
    ("precess_steering.h", "steering, servo"),
    ("precess_tracking.h", "imbalance line and drag torque of a rotor"),
    ("precess_constants.h", "kinds, error codes, sizes"),
];

/// A page for each header, and one in front of them.
pub(super) fn pages(root: &Path, add: &mut Add<'_>) -> Result<(), String> {
    let mut contents = Rendered {
        body: "<h1 id=\"c\">C</h1>\n<p>The library for flight software: its headers.</p>\n<ul>\n"
            .to_owned(),
        headings: vec![Heading::new(1, "c", "C")],
        sections: Vec::new(),
    };
    for (header, about) in HEADERS {
        let source = format!("{FOLDER}/{header}");
        let text = fs::read_to_string(root.join(&source));
        let text = text.map_err(|error| format!("cannot read {source}: {error}"))?;
        let rendered = rendered(header, &text);
        let page = format!("c/{}.html", header.trim_end_matches(".h"));
        let address = page.trim_start_matches("c/");
        put!(contents.body, "<li><a href=\"{address}\"><code>{header}</code></a>: {about}</li>\n");
        add(&page, &source, header, rendered)?;
    }
    contents.body.push_str("</ul>\n");
    add("c/index.html", FOLDER, "C", contents)
}

/// A header as a page.
fn rendered(header: &str, text: &str) -> Rendered {
    let mut rendered = Rendered {
        body: format!("<h1>{header}</h1>\n"),
        headings: vec![Heading::new(1, "", header)],
        sections: Vec::new(),
    };
    for chunk in chunks(text) {
        let (comment, code) = parted(&chunk);
        let names = names(&code);
        for name in &names {
            let kind = if code.contains(&format!("{name}(")) { "()" } else { "" };
            put!(rendered.body, "<h2 id=\"{name}\"><code>{name}{kind}</code></h2>\n");
            rendered.headings.push(Heading::new(2, name, name));
        }
        for paragraph in &comment {
            put!(rendered.body, "<p>{}</p>\n", escaped(paragraph));
        }
        if !code.trim().is_empty() {
            put!(rendered.body, "<pre><code>{}</code></pre>\n", escaped(code.trim_end()));
        }
        let title = names.join(", ");
        let address = names.first().cloned().unwrap_or_default();
        rendered.sections.push(Section {
            address,
            title,
            text: format!("{} {code}", comment.join(" ")),
        });
    }
    rendered
}

/// The header in parts: each ends at an empty line outside of braces and comments.
fn chunks(text: &str) -> Vec<String> {
    let (mut chunks, mut chunk, mut depth, mut in_comment) =
        (Vec::new(), String::new(), 0_i32, false);
    for line in text.lines() {
        if line.trim().is_empty() && depth == 0 && !in_comment {
            if !chunk.trim().is_empty() {
                chunks.push(std::mem::take(&mut chunk));
            }
            continue;
        }
        let mut rest = line;
        while !rest.is_empty() {
            let mark = if in_comment { "*/" } else { "/*" };
            let (code, after) = rest.split_once(mark).map_or((rest, ""), |parts| parts);
            if !in_comment {
                let braces = code.chars().map(|c| i32::from(c == '{') - i32::from(c == '}'));
                depth += braces.sum::<i32>();
            }
            if rest.contains(mark) {
                in_comment = !in_comment;
            }
            rest = after;
        }
        // What a C++ compiler needs is no block.
        if line.starts_with("extern \"C\" {") {
            depth -= 1;
        } else if line == "}" && depth < 0 {
            depth += 1;
        }
        chunk.push_str(line);
        chunk.push('\n');
    }
    if !chunk.trim().is_empty() {
        chunks.push(chunk);
    }
    chunks
}

/// The comment at the beginning of a part, by paragraphs, and the rest.
fn parted(chunk: &str) -> (Vec<String>, String) {
    let Some((comment, code)) = chunk.strip_prefix("/*").and_then(|rest| rest.split_once("*/"))
    else {
        return (Vec::new(), chunk.to_owned());
    };
    let lines = comment.lines().map(|line| line.trim().trim_start_matches('*').trim());
    let mut paragraphs = vec![String::new()];
    for line in lines {
        match paragraphs.last_mut() {
            Some(last) if !line.is_empty() => {
                if !last.is_empty() {
                    last.push(' ');
                }
                last.push_str(line);
            }
            _ => paragraphs.push(String::new()),
        }
    }
    paragraphs.retain(|paragraph| !paragraph.is_empty());
    (paragraphs, code.trim_start_matches('\n').to_owned())
}

/// What a part declares: functions, and types at their ends.
fn names(code: &str) -> Vec<String> {
    let mut names = Vec::new();
    for line in code.lines().filter(|line| !line.starts_with('#') && !line.starts_with(' ')) {
        let before = if let Some(name) = line.strip_prefix("} ") {
            name.trim_end_matches(';')
        } else if line.contains('(') && !line.starts_with("typedef") && !line.starts_with('/') {
            line.split('(').next().unwrap_or_default()
        } else {
            continue;
        };
        let name = before.rsplit([' ', '*']).next().unwrap_or_default();
        if name.starts_with("precess_") {
            names.push(name.to_owned());
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_and_types_have_their_comments() {
        let text = "/* All of it. */\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n/* A place:\n *\n * x, y. */\n\
                    typedef struct precess_place {\n    double x; /* m */\n\n    double y;\n} precess_place;\n\n\
                    /* Moves < it. */\nint32_t precess_move(const precess_place *place,\n                     double *out);\n\n\
                    #ifdef __cplusplus\n}\n#endif\n";
        let page = rendered("a.h", text);
        let names: Vec<_> = page.headings.iter().map(|heading| heading.address.as_str()).collect();
        assert_eq!(names, ["", "precess_place", "precess_move"]);
        for part in [
            "<h2 id=\"precess_move\"><code>precess_move()</code></h2>\n<p>Moves &lt; it.</p>",
            "<p>A place:</p>\n<p>x, y.</p>\n<pre><code>typedef struct precess_place {",
            "double y;\n} precess_place;</code></pre>",
        ] {
            assert!(page.body.contains(part), "{part} is not in\n{}", page.body);
        }
    }
}
