//! The registry of kinds against every list of kinds: emitted ones have a kind that is added to the
//! registry, lists by hand name every kind of it, and C has the numbers.

use std::fs;
use std::path::Path;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::{TargetCrate, of_kind, shared};
use precess_codegen::graph::Graph;
use precess_codegen::kinds::{Entry, Kind, Link, REGISTRY};
use precess_codegen::space::Axis;

/// How a list names a kind.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// `balanced_vscmg`.
    Module,
    /// `BalancedVscmg`.
    Type,
    /// `PRECESS_KIND_BALANCED_VSCMG`.
    C,
}

use Form::{C, Module, Type};

/// Lists of all kinds that nothing emits, from the repository's root.
const BY_HAND: [(&str, Form); 26] = [
    ("docs/guide.md", Type),
    ("flight/capi/include/precess_constants.h", C),
    ("flight/capi/tests/layout.c", C),
    ("flight/firmware/library/src/lib.rs", Type),
    ("flight/firmware/src/bin/instructions.rs", Module),
    ("flight/firmware/src/bin/instructions.rs", Type),
    ("flight/firmware/src/devices.rs", Type),
    ("flight/firmware/src/sets.rs", Type),
    ("tests/attack/src/code.rs", Module),
    ("tests/attack/src/code.rs", Type),
    ("tests/attack/src/draw.rs", Type),
    ("tests/attack/src/properties.rs", Type),
    ("tests/attack/src/shapes.rs", Type),
    ("tests/engines/chains.py", Module),
    ("tests/fixtures/every_entry_point.rs", Type),
    ("tests/src/measured.rs", Module),
    ("tests/src/measured.rs", Type),
    ("tests/ledger/tests/ledger_and_loads/craft.rs", Type),
    ("tests/ledger/tests/ledger_and_loads/draw.rs", Type),
    ("tests/tests/dynamics/kinds_and_modes/balance.rs", Type),
    ("tests/tests/dynamics/kinds_and_modes/devices.rs", Type),
    ("tests/tests/dynamics/kinds_and_modes/loads.rs", Type),
    ("tests/tests/dynamics/kinds_and_modes/modes.rs", Type),
    ("tests/tests/dynamics/kinds_and_modes/rigid.rs", Type),
    ("tests/tests/dynamics/operations.rs", Module),
    ("tests/tests/engines/kinds/judge.rs", Module),
];

fn read(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    fs::read_to_string(root.join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Whether the text has the name as a whole word.
fn names(text: &str, name: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(name)
        .any(|(at, _)| !text[..at].ends_with(part) && !text[at + name.len()..].starts_with(part))
}

/// The kinds that a list lacks.
fn missing(text: &str, form: Form, registry: &[Entry]) -> Vec<&'static str> {
    let name = |entry: &Entry| match form {
        Module => entry.kind.name.to_owned(),
        Type => entry.kind.type_name(),
        C => entry.c_name(),
    };
    let lacks = |entry: &&Entry| !names(text, &name(entry));
    registry.iter().filter(lacks).map(|entry| entry.kind.name).collect()
}

/// The registry with one more kind, and that entry.
fn extended() -> (Vec<Entry>, Entry) {
    let link = Link::turning("a", "arm", Axis::Z, "alpha").unnumbered();
    let kind = Kind::builder("swing_arm", "swing arm").link(link).build().unwrap();
    let added = Entry { number: REGISTRY.last().unwrap().number + 1, kind };
    (REGISTRY.iter().copied().chain([added]).collect(), added)
}

#[test]
fn lists_by_hand_name_every_kind() {
    let (extended, added) = extended();
    for (path, form) in BY_HAND {
        let text = read(path);
        let none: Vec<&str> = Vec::new();
        assert_eq!(missing(&text, form, &REGISTRY), none, "{path} as {form:?}");
        // A kind that is added is missed.
        assert_eq!(missing(&text, form, &extended), [added.kind.name], "{path} as {form:?}");
    }
}

#[test]
fn c_gives_each_kind_its_number_and_no_other() {
    let expected: Vec<_> =
        REGISTRY.iter().map(|entry| format!("{} = {}", entry.c_name(), entry.number)).collect();
    let header = read("flight/capi/include/precess_constants.h");
    let lines = header.lines().map(str::trim).filter(|line| line.starts_with("PRECESS_KIND_"));
    let stated = |line: &str| line.split([',', '/']).next().unwrap_or(line).trim().to_owned();
    assert_eq!(lines.map(stated).collect::<Vec<_>>(), expected);
}

#[test]
fn kind_added_to_the_registry_is_in_every_emitted_list() {
    let (registry, added) = extended();
    let graph = Graph::new();
    let emitted = of_kind(&Chain::new(&graph, added.kind), TargetCrate::Dynamics).unwrap();
    let files = shared(&registry, &[emitted]).unwrap();
    let text = |end: &str| &files.iter().find(|file| file.path.ends_with(end)).unwrap().text;
    let (list, operations) = (text("mod.rs"), text("operations.md"));
    assert_eq!(missing(list, Module, &registry), [""; 0]);
    assert_eq!(missing(list, Type, &registry), [""; 0]);
    assert_eq!(missing(operations, Module, &[added]), [""; 0]);
    for line in [
        "pub mod swing_arm;",
        "    pub use super::swing_arm::device as swing_arm;",
        "    pub use super::swing_arm::device::SwingArm;",
        "            SwingArm swing_arm 15;",
    ] {
        assert!(list.lines().any(|found| found == line), "no `{line}` in\n{list}");
    }
}
