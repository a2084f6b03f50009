//! The step tree of docs/architecture.md: every function in it is in the file beside it, of the type before it.

use std::fs;
use std::path::Path;

use syn::{ImplItem, Item, TraitItem, Type};

use super::ROOT;

/// A line of the tree: type, function, file from `dynamics/src`.
#[derive(Debug, PartialEq, Eq)]
struct Line {
    of: Option<String>,
    function: String,
    file: String,
}

/// The functions of a tree of the page; lines without a file go on with the text of the line above.
fn lines(tree: &str) -> Vec<Line> {
    let mut found = Vec::new();
    for line in tree.lines() {
        let line = line.trim_start_matches(['│', '├', '└', ' ']);
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_file =
            |word: &&str| Path::new(word).extension().is_some_and(|ending| ending == "rs");
        let Some(file) = words.iter().position(is_file) else { continue };
        let mut of = None;
        for name in words.iter().take(file).map(|name| name.trim_end_matches(',')) {
            let function = match name.split_once("::") {
                Some((of_function, function)) => {
                    of = Some(of_function.to_owned());
                    function
                }
                None => name,
            };
            let (function, file) = (function.to_owned(), words[file].to_owned());
            found.push(Line { of: of.clone(), function, file });
        }
    }
    found
}

/// Whether a file has a function, of a type or trait where one is named.
fn has(items: &[Item], of: Option<&str>, function: &str) -> bool {
    let is = |name: &syn::Ident| name == function;
    let named = |name: &syn::Ident| of.is_some_and(|of| name == of);
    items.iter().any(|item| match item {
        Item::Fn(item) => of.is_none() && is(&item.sig.ident),
        Item::Trait(item) if named(&item.ident) => {
            item.items.iter().any(|item| matches!(item, TraitItem::Fn(item) if is(&item.sig.ident)))
        }
        Item::Impl(item) => {
            let own = match &*item.self_ty {
                Type::Path(of) => of.path.segments.last().is_some_and(|last| named(&last.ident)),
                _ => false,
            };
            let last = item.trait_.as_ref().and_then(|(path, _)| path.segments.last());
            let of_type = own || last.is_some_and(|last| named(&last.ident));
            let mut functions = item.items.iter();
            of_type
                && functions.any(|item| matches!(item, ImplItem::Fn(item) if is(&item.sig.ident)))
        }
        _ => false,
    })
}

#[test]
fn every_function_of_the_step_tree_is_in_its_file() {
    let root = Path::new(ROOT);
    let page = fs::read_to_string(root.join("docs/architecture.md")).unwrap();
    let tree = page.split("```text\n").find(|text| text.starts_with("Spacecraft::step ")).unwrap();
    let tree = tree.split("```").next().unwrap();
    let lines = lines(tree);
    assert!(lines.len() > 35, "{} functions", lines.len());
    let mut missing = Vec::new();
    for Line { of, function, file } in &lines {
        let text = fs::read_to_string(root.join("dynamics/src").join(file)).unwrap_or_default();
        let items = syn::parse_file(&text).unwrap().items;
        if !has(&items, of.as_deref(), function) {
            missing.push(format!("{} {function} in {file}", of.as_deref().unwrap_or_default()));
        }
    }
    assert!(
        missing.is_empty(),
        "docs/architecture.md names functions that are not there:\n{}",
        missing.join("\n")
    );
}

#[test]
fn a_function_that_is_not_there_is_seen() {
    let text = "A::f, g   a/b.rs  text\n│                    goes on\n├ four times:\n│ └ h   a/c.rs   text\n";
    let line = |of: Option<&str>, function: &str, file: &str| Line {
        of: of.map(str::to_owned),
        function: function.to_owned(),
        file: file.to_owned(),
    };
    let expected =
        [line(Some("A"), "f", "a/b.rs"), line(Some("A"), "g", "a/b.rs"), line(None, "h", "a/c.rs")];
    assert_eq!(lines(text), expected);
    let items =
        syn::parse_file("impl<T> A<T> { fn f() {} }\nimpl B for C { fn g() {} }\nfn h() {}")
            .unwrap();
    let seen = |of, function| has(&items.items, of, function);
    assert!(
        seen(Some("A"), "f") && seen(Some("B"), "g") && seen(Some("C"), "g") && seen(None, "h")
    );
    assert!(!seen(Some("A"), "g") && !seen(None, "f") && !seen(Some("A"), "h"));
}
