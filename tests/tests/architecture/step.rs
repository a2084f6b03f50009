//! The step tree of docs/architecture.md: every function in it is in the file beside it, of the type before it, and
//! calls the functions one level below it.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens as _;
use syn::{Block, ImplItem, Item, TraitItem, Type};

use super::ROOT;

/// A function of the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Function {
    of: Option<String>,
    name: String,
    /// From `dynamics/src`.
    file: String,
    /// The number of the function that calls it.
    caller: Option<usize>,
    /// The closure by which the caller does so.
    closure: Option<Closure>,
}

/// A line `closure NAME of FUNCTION:`.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Closure {
    name: String,
    of: String,
}

/// What other lines are below.
enum Parent {
    Function(usize),
    Closure(Closure),
    /// A remark: `four times:`.
    Remark,
}

impl Function {
    fn titled(&self) -> String {
        self.of.as_ref().map_or_else(|| self.name.clone(), |of| format!("{of}::{}", self.name))
    }
}

/// The functions of a tree of the page. A line that has no file and ends without a colon continues the text above.
fn functions(tree: &str) -> Vec<Function> {
    let (mut found, mut above) = (Vec::<Function>::new(), Vec::<(usize, Parent)>::new());
    for line in tree.lines() {
        let text = line.trim_start_matches(['│', '├', '└', ' ']);
        let depth = line.chars().count() - text.chars().count();
        let words: Vec<&str> = text.split_whitespace().collect();
        let is_file =
            |word: &&str| Path::new(word).extension().is_some_and(|ending| ending == "rs");
        let file = words.iter().position(is_file);
        if file.is_none() && !text.ends_with(':') {
            continue;
        }
        above.retain(|(of, _)| *of < depth);
        let Some(file) = file else {
            above.push((depth, group(&words)));
            continue;
        };
        let caller = above.iter().rev().find_map(|(_, parent)| match parent {
            Parent::Function(index) => Some(*index),
            _ => None,
        });
        let closure = above.last().and_then(|(_, parent)| match parent {
            Parent::Closure(closure) => Some(closure.clone()),
            _ => None,
        });
        above.push((depth, Parent::Function(found.len())));
        let mut of = None;
        for word in words.iter().take(file).map(|word| word.trim_end_matches(',')) {
            let name = match word.split_once("::") {
                Some((of_function, name)) => {
                    of = Some(of_function.to_owned());
                    name
                }
                None => word,
            };
            let (name, file) = (name.to_owned(), words[file].to_owned());
            found.push(Function { of: of.clone(), name, file, caller, closure: closure.clone() });
        }
    }
    found
}

fn group(words: &[&str]) -> Parent {
    match words {
        ["closure", name, "of", of] => Parent::Closure(Closure {
            name: (*name).to_owned(),
            of: of.trim_end_matches(':').to_owned(),
        }),
        _ => Parent::Remark,
    }
}

/// The bodies of a function, of a type or trait where one is named; none of one that a trait only requires.
fn bodies<'a>(items: &'a [Item], of: Option<&str>, function: &str) -> Vec<Option<&'a Block>> {
    let is = |name: &syn::Ident| name == function;
    let named = |name: &syn::Ident| of.is_some_and(|of| name == of);
    let mut found = Vec::new();
    for item in items {
        match item {
            Item::Fn(item) if of.is_none() && is(&item.sig.ident) => found.push(Some(&*item.block)),
            Item::Trait(item) if named(&item.ident) => {
                found.extend(item.items.iter().filter_map(|item| match item {
                    TraitItem::Fn(item) if is(&item.sig.ident) => Some(item.default.as_ref()),
                    _ => None,
                }));
            }
            Item::Impl(item) => {
                let own = match &*item.self_ty {
                    Type::Path(of) => {
                        of.path.segments.last().is_some_and(|last| named(&last.ident))
                    }
                    _ => false,
                };
                let last = item.trait_.as_ref().and_then(|(path, _)| path.segments.last());
                if own || last.is_some_and(|last| named(&last.ident)) {
                    found.extend(item.items.iter().filter_map(|item| match item {
                        ImplItem::Fn(item) if is(&item.sig.ident) => Some(Some(&item.block)),
                        _ => None,
                    }));
                }
            }
            _ => {}
        }
    }
    found
}

/// The names that are called: `f(..)`, `a.f(..)`, `A::f::<B>(..)`.
fn calls(tokens: TokenStream, found: &mut BTreeSet<String>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (index, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => calls(group.stream(), found),
            TokenTree::Ident(name) => {
                let called = match tokens.get(index + 1) {
                    Some(TokenTree::Group(of)) => of.delimiter() == Delimiter::Parenthesis,
                    _ => [':', ':', '<'].into_iter().zip(index + 1..).all(|(sign, at)| {
                        let token = tokens.get(at);
                        matches!(token, Some(TokenTree::Punct(of)) if of.as_char() == sign)
                    }),
                };
                if called {
                    found.insert(name.to_string());
                }
            }
            _ => {}
        }
    }
}

/// What is wrong with a tree; `read` reads a file of the sources.
fn faults(tree: &[Function], read: impl Fn(&str) -> String) -> Vec<String> {
    let mut faults = Vec::new();
    let mut called = Vec::new();
    for function in tree {
        let items = syn::parse_file(&read(&function.file)).unwrap().items;
        let bodies = bodies(&items, function.of.as_deref(), &function.name);
        if bodies.is_empty() {
            faults.push(format!("{} is not in {}", function.titled(), function.file));
        }
        let mut names = BTreeSet::new();
        bodies.iter().flatten().for_each(|body| calls(body.to_token_stream(), &mut names));
        called.push(names);
    }
    let mut require = |caller: usize, name: &str| {
        if !called[caller].contains(name) {
            faults.push(format!("{} does not call {name}", tree[caller].titled()));
        }
    };
    for function in tree {
        let Some(caller) = function.caller else { continue };
        let Some(closure) = &function.closure else {
            require(caller, &function.name);
            continue;
        };
        require(caller, &closure.name);
        let mut above = std::iter::successors(Some(caller), |index| tree[*index].caller);
        let of = above.find(|index| tree[*index].titled() == closure.of);
        require(of.expect("a closure is one of a function above"), &function.name);
    }
    faults
}

#[test]
fn every_function_of_the_step_tree_is_in_its_file() {
    let root = Path::new(ROOT);
    let page = fs::read_to_string(root.join("docs/architecture.md")).unwrap();
    let tree = page.split("```text\n").find(|text| text.starts_with("Spacecraft::step ")).unwrap();
    let tree = functions(tree.split("```").next().unwrap());
    assert!(tree.len() > 45, "{} functions", tree.len());
    let read =
        |file: &str| fs::read_to_string(root.join("dynamics/src").join(file)).unwrap_or_default();
    let faults = faults(&tree, read);
    assert!(faults.is_empty(), "the step tree of docs/architecture.md:\n{}", faults.join("\n"));
}

#[test]
fn a_function_that_is_not_there_is_seen() {
    let text = "A::f, g   a/b.rs  text\n│                    goes on\n├ four times:\n│ └ h   a/c.rs   text\n";
    let line = |of: Option<&str>, name: &str, file: &str, caller: Option<usize>| Function {
        of: of.map(str::to_owned),
        name: name.to_owned(),
        file: file.to_owned(),
        caller,
        closure: None,
    };
    let expected = [
        line(Some("A"), "f", "a/b.rs", None),
        line(Some("A"), "g", "a/b.rs", None),
        line(None, "h", "a/c.rs", Some(0)),
    ];
    assert_eq!(functions(text), expected);
    let items =
        syn::parse_file("impl<T> A<T> { fn f() {} }\nimpl B for C { fn g() {} }\nfn h() {}")
            .unwrap();
    let seen = |of, function| !bodies(&items.items, of, function).is_empty();
    assert!(
        seen(Some("A"), "f") && seen(Some("B"), "g") && seen(Some("C"), "g") && seen(None, "h")
    );
    assert!(!seen(Some("A"), "g") && !seen(None, "f") && !seen(Some("A"), "h"));
}

#[test]
fn a_call_that_is_not_there_is_seen() {
    let source = "fn f() { g(|x| h::<u8>(x.i())) }\nfn g(c: C) { c(); }\nfn h() { let i = 1; }\n\
                  impl X { fn i() {} }";
    let faults = |tree: &str| faults(&functions(tree), |_| source.to_owned());
    let right = "f  a.rs\n├ g  a.rs\n│ └ closure c of f:\n│   └ h  a.rs\n└ X::i  a.rs\n";
    assert!(faults(right).is_empty());
    assert_eq!(faults("f  a.rs\n└ h  a.rs\n  └ X::i  a.rs\n"), ["h does not call i"]);
    assert_eq!(faults("f  a.rs\n└ g  a.rs\n  └ h  a.rs\n"), ["g does not call h"]);
    let wrong = "f  a.rs\n└ g  a.rs\n  └ closure d of g:\n    └ h  a.rs\n";
    assert_eq!(faults(wrong), ["g does not call d", "g does not call h"]);
    assert_eq!(faults("f  a.rs\n└ j  a.rs\n"), ["j is not in a.rs", "f does not call j"]);
}
