//! [`Crate`]: which file of a crate imports what of which other file, tests left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens as _;
use syn::{Attribute, ImplItem, Item, UseTree, Visibility};

/// An import: the file that has it, the file that it is of, and the path from the crate's root.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Import {
    pub(crate) from: String,
    pub(crate) to: String,
    pub(crate) path: String,
}

/// A crate: its files from the folder of its root, and their imports.
#[derive(Debug, Default)]
pub(crate) struct Crate {
    pub(crate) files: BTreeSet<String>,
    pub(crate) imports: BTreeSet<Import>,
}

/// What a file names, as written: paths that begin with `crate`, `self`, `super` or a module of its own.
#[derive(Debug, Default)]
struct Names {
    used: Vec<Vec<String>>,
    /// The name that is exported, and the path that it stands for.
    exported: BTreeMap<String, Vec<String>>,
    /// Modules of tests.
    tests: Vec<String>,
}

impl Crate {
    pub(crate) fn read(root: &Path) -> Self {
        let mut texts = BTreeMap::new();
        read(root, "", &mut texts);
        // A program beside a library is a crate of its own.
        if texts.contains_key("lib.rs") {
            texts.remove("main.rs");
        }
        Self::of_texts(&texts)
    }

    /// Of files by their paths from the root.
    pub(crate) fn of_texts(texts: &BTreeMap<String, String>) -> Self {
        let parsed = texts.iter().map(|(file, text)| {
            let items =
                syn::parse_file(text).unwrap_or_else(|error| panic!("{file}: {error}")).items;
            let mut names = Names::default();
            names.add(items);
            (module(file), (file.clone(), names))
        });
        let mut modules: BTreeMap<Vec<String>, (String, Names)> = parsed.collect();
        let tests: Vec<Vec<String>> = modules
            .iter()
            .flat_map(|(path, (_, names))| names.tests.iter().map(|test| below(path, test)))
            .collect();
        modules.retain(|path, _| !tests.iter().any(|test| path.starts_with(test)));
        let mut imports = BTreeSet::new();
        for (own, (file, names)) in &modules {
            for used in &names.used {
                let Some(path) = absolute(own, used, &modules) else { continue };
                let Some(to) = home(&path, &modules, 0).filter(|to| to != file) else { continue };
                imports.insert(Import { from: file.clone(), to, path: path.join("::") });
            }
        }
        let files = modules.into_values().map(|(file, _)| file).collect();
        Self { files, imports }
    }

    /// The folders that hold files, the root as an empty text.
    pub(crate) fn folders(&self) -> BTreeSet<String> {
        let folder =
            |file: &String| file.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        self.files.iter().map(folder).collect()
    }
}

fn read(folder: &Path, name: &str, texts: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{name}: {error}")) {
        let path = entry.unwrap().path();
        let file = path.file_name().unwrap().to_str().unwrap();
        let inner = if name.is_empty() { file.to_owned() } else { format!("{name}/{file}") };
        if path.is_dir() {
            // Programs are crates of their own.
            if inner != "bin" {
                read(&path, &inner, texts);
            }
        } else if path.extension().is_some_and(|ending| ending == "rs") && !is_kernels(&inner) {
            texts.insert(inner, fs::read_to_string(&path).unwrap());
        }
    }
}

/// Whether a file has emitted kernels: a third of all text, which imports the records beside it only.
fn is_kernels(file: &str) -> bool {
    let name = file.strip_prefix("generated/").filter(|name| !name.contains('/'));
    name.is_some_and(|name| name != "mod.rs" && name != "hub.rs")
}

/// The module that a file is.
fn module(file: &str) -> Vec<String> {
    let mut path: Vec<_> = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if file == "lib.rs" || file == "main.rs" || path.last().is_some_and(|last| last == "mod") {
        path.pop();
    }
    path
}

fn below(path: &[String], name: &str) -> Vec<String> {
    path.iter().cloned().chain([name.to_owned()]).collect()
}

type Modules = BTreeMap<Vec<String>, (String, Names)>;

/// A path from the crate's root; none of another crate.
fn absolute(own: &[String], path: &[String], modules: &Modules) -> Option<Vec<String>> {
    let mut base = match path.first()?.as_str() {
        "crate" => Vec::new(),
        "self" | "super" => own.to_vec(),
        first if modules.contains_key(&below(own, first)) => own.to_vec(),
        _ => return None,
    };
    let rest = path.iter().skip_while(|part| match part.as_str() {
        "super" => {
            base.pop();
            true
        }
        "crate" | "self" => true,
        _ => false,
    });
    let rest: Vec<_> = rest.cloned().collect();
    base.extend(rest);
    Some(base)
}

/// The file of a path: that of its module, or of what the module exports by this name.
fn home(path: &[String], modules: &Modules, depth: usize) -> Option<String> {
    let length = (0..=path.len()).rev().find(|length| modules.contains_key(&path[..*length]))?;
    let (file, names) = &modules[&path[..length]];
    let exported = path.get(length).and_then(|name| names.exported.get(name));
    let further = exported.and_then(|of| absolute(&path[..length], of, modules));
    match further {
        Some(further) if depth < 8 => home(&further, modules, depth + 1),
        _ => Some(file.clone()),
    }
}

impl Names {
    fn add(&mut self, items: Vec<Item>) {
        for item in items {
            let tested = attributes(&item).iter().any(is_test);
            match item {
                Item::Mod(of) if tested => self.tests.push(of.ident.to_string()),
                _ if tested => {}
                Item::Use(of) => {
                    let is_private = matches!(of.vis, Visibility::Inherited);
                    self.add_use(&of.tree, &mut Vec::new(), is_private);
                }
                Item::Mod(of) => self.add(of.content.map_or_else(Vec::new, |(_, items)| items)),
                Item::Impl(mut of) => {
                    of.items.retain(
                        |item| !matches!(item, ImplItem::Fn(of) if of.attrs.iter().any(is_test)),
                    );
                    self.add_tokens(of.to_token_stream());
                }
                other => self.add_tokens(other.to_token_stream()),
            }
        }
    }

    /// The paths of an import, or of what a file exports for others.
    fn add_use(&mut self, tree: &UseTree, before: &mut Vec<String>, is_private: bool) {
        let (name, exported) = match tree {
            UseTree::Path(of) => {
                before.push(of.ident.to_string());
                self.add_use(&of.tree, before, is_private);
                before.pop();
                return;
            }
            UseTree::Group(of) => {
                of.items.iter().for_each(|tree| self.add_use(tree, before, is_private));
                return;
            }
            UseTree::Glob(_) => (None, None),
            UseTree::Name(of) => (Some(of.ident.to_string()), Some(of.ident.to_string())),
            UseTree::Rename(of) => (Some(of.ident.to_string()), Some(of.rename.to_string())),
        };
        let name = name.filter(|name| name != "self");
        let path: Vec<_> = before.iter().cloned().chain(name).collect();
        match exported {
            _ if is_private => self.used.push(path),
            Some(exported) => {
                self.exported.insert(exported, path);
            }
            None => {}
        }
    }

    /// Paths in code: of every `a::b::C` the whole.
    fn add_tokens(&mut self, tokens: TokenStream) {
        let (mut path, mut colons) = (Vec::<String>::new(), 0);
        for token in tokens {
            match token {
                TokenTree::Ident(of) if colons == 2 => path.push(of.to_string()),
                TokenTree::Ident(of) => {
                    self.end(&mut path);
                    path.push(of.to_string());
                }
                TokenTree::Punct(of) if of.as_char() == ':' => {
                    colons += 1;
                    continue;
                }
                TokenTree::Group(of) => {
                    // `pub(in crate::a)` imports nothing.
                    let restricts = path == ["pub"];
                    self.end(&mut path);
                    if !restricts {
                        self.add_tokens(of.stream());
                    }
                }
                _ => self.end(&mut path),
            }
            colons = 0;
        }
        self.end(&mut path);
    }

    fn end(&mut self, path: &mut Vec<String>) {
        let path = std::mem::take(path);
        if path.len() > 1 {
            self.used.push(path);
        }
    }
}

/// Whether what has the attribute is compiled for tests only.
fn is_test(attribute: &Attribute) -> bool {
    let text = || attribute.to_token_stream().to_string().replace(' ', "");
    attribute.path().is_ident("cfg")
        && ["#[cfg(test)", "#[cfg(all(test,"].iter().any(|start| text().starts_with(start))
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(of) => &of.attrs,
        Item::Enum(of) => &of.attrs,
        Item::Fn(of) => &of.attrs,
        Item::Impl(of) => &of.attrs,
        Item::Macro(of) => &of.attrs,
        Item::Mod(of) => &of.attrs,
        Item::Static(of) => &of.attrs,
        Item::Struct(of) => &of.attrs,
        Item::Trait(of) => &of.attrs,
        Item::Type(of) => &of.attrs,
        Item::Use(of) => &of.attrs,
        _ => &[],
    }
}

#[test]
fn imports_of_a_text_are_found() {
    let texts = [
        ("lib.rs", "mod a; mod b;\npub use b::Reached;\n#[cfg(test)]\nmod tests;"),
        (
            "a.rs",
            "use crate::b::{self, one::{Two, Three as Four}};\nfn f() -> crate::Reached { super::b::g() }",
        ),
        (
            "b/mod.rs",
            "pub mod one;\npub(crate) use one::Reached;\n#[cfg(test)]\nmod checks {\n use crate::a::f;\n}",
        ),
        ("b/one.rs", "// crate::a::not_code\nconst TEXT: &str = \"crate::a::f\";"),
        ("tests.rs", "use crate::a::f;"),
    ];
    let texts = texts.map(|(file, text)| (file.to_owned(), text.to_owned())).into();
    let source = Crate::of_texts(&texts);
    let found =
        source.imports.iter().map(|of| (of.from.as_str(), of.to.as_str(), of.path.as_str()));
    let expected = [
        ("a.rs", "b/mod.rs", "b"),
        ("a.rs", "b/mod.rs", "b::g"),
        ("a.rs", "b/one.rs", "Reached"),
        ("a.rs", "b/one.rs", "b::one::Three"),
        ("a.rs", "b/one.rs", "b::one::Two"),
    ];
    assert_eq!(found.collect::<Vec<_>>(), expected);
    assert!(!source.files.contains("tests.rs"));
}
