//! [`Graph`]: what imports what, and the circles in it.

use std::collections::{BTreeMap, BTreeSet};

use super::imports::{Crate, Import};

/// Folders or files, and for each pair the imports of one from the other.
#[derive(Debug, Default)]
pub(crate) struct Graph<'a> {
    arrows: BTreeMap<(String, String), Vec<&'a Import>>,
}

impl<'a> Graph<'a> {
    /// The folders of a crate, and its files outside them; the root itself is none.
    pub(crate) fn of_folders(source: &'a Crate) -> Self {
        Self::by(source, |file| first(file).filter(|name| *name != "lib" && *name != "main"))
    }

    /// The files of a folder; a folder in it counts as one.
    pub(crate) fn of_files(source: &'a Crate, folder: &str) -> Self {
        let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        Self::by(source, |file| first(file.strip_prefix(&prefix)?))
    }

    fn by(source: &'a Crate, node: impl Fn(&'a str) -> Option<&'a str>) -> Self {
        let mut graph = Self::default();
        for import in &source.imports {
            if let (Some(from), Some(to)) = (node(&import.from), node(&import.to))
                && from != to
            {
                graph.arrows.entry((from.to_owned(), to.to_owned())).or_default().push(import);
            }
        }
        graph
    }

    /// What is reached from a node, itself only by a circle.
    fn reached(&self, from: &str) -> BTreeSet<&str> {
        let (mut reached, mut next) = (BTreeSet::new(), vec![from.to_owned()]);
        while let Some(node) = next.pop() {
            for (_, to) in self.arrows.keys().filter(|(from, _)| *from == node) {
                if reached.insert(to.as_str()) {
                    next.push(to.clone());
                }
            }
        }
        reached
    }

    /// The sets of nodes each of which imports every other, by others where not itself; sorted.
    pub(crate) fn circles(&self) -> Vec<Vec<String>> {
        let nodes: BTreeSet<&str> = self.arrows.keys().map(|(from, _)| from.as_str()).collect();
        let reached: BTreeMap<_, _> =
            nodes.iter().map(|node| (*node, self.reached(node))).collect();
        let mut circles = BTreeSet::new();
        for (node, all) in reached.iter().filter(|(node, all)| all.contains(**node)) {
            let circle =
                all.iter().filter(|other| reached.get(**other).is_some_and(|of| of.contains(node)));
            circles.insert(circle.map(|other| (*other).to_owned()).collect());
        }
        circles.into_iter().collect()
    }

    /// A circle with an import for each of its arrows.
    pub(crate) fn described(&self, circle: &[String]) -> String {
        let within = |(from, to): &(String, String)| circle.contains(from) && circle.contains(to);
        let arrows = self.arrows.iter().filter(|(arrow, _)| within(arrow));
        let lines = arrows.map(|((from, to), imports)| {
            let Import { from: file, path, .. } = imports[0];
            format!("\n  {from} -> {to}: {file} imports {path} ({} in all)", imports.len())
        });
        format!("{}{}", circle.join(", "), lines.collect::<String>())
    }
}

/// The first part of a path, without the ending of a file.
fn first(file: &str) -> Option<&str> {
    file.split('/').next().map(|name| name.trim_end_matches(".rs"))
}

#[test]
fn a_circle_is_named_with_file_and_import() {
    let texts = [
        ("lib.rs", "mod a; mod b; mod c;"),
        ("a/one.rs", "use crate::b::f;"),
        ("a/mod.rs", "mod one;"),
        ("b.rs", "fn g() { crate::c::h() }"),
        ("c.rs", "use crate::a::one::X;"),
        ("d.rs", "use crate::a::one::X;"),
    ];
    let texts = texts.map(|(file, text)| (file.to_owned(), text.to_owned())).into();
    let source = Crate::of_texts(&texts);
    let graph = Graph::of_folders(&source);
    let [circle] = graph.circles().try_into().expect("one circle");
    assert_eq!(circle, ["a", "b", "c"]);
    let described = graph.described(&circle);
    assert!(described.contains("b -> c: b.rs imports c::h"), "{described}");
    assert!(Graph::of_files(&source, "a").circles().is_empty());
}
