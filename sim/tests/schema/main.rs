//! The JSON Schema against the reader. Every scenario file, and every one that the tool writes,
//! is valid; an unknown key is refused by both in every table; and in each table both know the same
//! keys.
//!
//! The reader tells which keys it knows: an unknown one that is like none of them lists them all.

mod documents;
mod validator;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use precess::file::{from_toml, to_toml};
use serde_json::Value;
use toml::Table;

use documents::OTHERS;
use validator::faults;

/// Like no key, so that the help of its error lists the known ones.
const UNKNOWN: &str = "QQQQ";
/// Keys that are taken away before the reader sees a table, and where.
const TAKEN: [(&str, &str); 1] = [("", "base")];
const MINIMAL: &str = "format = 1\n[run]\nduration = \"1 s\"\nintegrator = \"rk4\"\nstep = \"1 ms\"\n\
    [output]\nrate = \"1 kHz\"\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
    [[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
    [device.wheel]\nmass = \"1 kg\"\ninertia = \"2, 1, 1 g m^2\"\n";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

fn schema() -> Value {
    serde_json::from_str(include_str!("../../schema/scenario-1.json")).expect("JSON")
}

/// The scenario files with their names.
fn files() -> Vec<(String, String)> {
    let entries = std::fs::read_dir(folder()).expect("the folder").map(|e| e.expect("an entry"));
    let paths = entries.map(|entry| entry.path());
    let mut files: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| (path.display().to_string(), std::fs::read_to_string(&path).expect("text")))
        .collect();
    files.sort();
    assert!(files.len() >= 18, "{} files", files.len());
    files
}

/// The files, and minimal scenarios with what no file has.
fn documents() -> Vec<(String, Table)> {
    let table = |(name, text): (String, String)| {
        let table = text.parse::<Table>().unwrap_or_else(|error| panic!("{name}: {error}"));
        (name, table)
    };
    let others = OTHERS.iter().map(|other| ((*other).to_owned(), format!("{MINIMAL}{other}\n")));
    files().into_iter().chain(others).map(table).collect()
}

fn json(table: &Table) -> Value {
    serde_json::to_value(table).expect("no dates")
}

#[test]
fn every_scenario_file_is_valid_and_so_is_what_the_tool_writes() {
    let schema = schema();
    let check = |name: &str, text: &str| {
        let table = text.parse::<Table>().expect("TOML");
        let faults = faults(&schema, &json(&table));
        assert!(faults.is_empty(), "{name}: {faults:#?}\n{text}");
    };
    for (name, text) in files() {
        check(&name, &text);
        let (scenario, _) = from_toml(&name, &text, &folder()).unwrap_or_else(|e| panic!("{e}"));
        check(&name, &to_toml(&scenario));
    }
    for other in OTHERS {
        check(other, &format!("{MINIMAL}{other}\n"));
    }
}

/// A table of a document: the keys and indices that lead to it, and the part of the schema for it.
struct DocumentTable<'a> {
    steps: Vec<Step>,
    /// Tables with one definition are one place: `#/$defs/body`.
    name: String,
    properties: &'a serde_json::Map<String, Value>,
}

#[derive(Clone)]
enum Step {
    Key(String),
    Index(usize),
}

/// Every table of a document with its part of the schema.
fn places<'a>(schema: &'a Value, table: &Table) -> Vec<DocumentTable<'a>> {
    let mut found = Vec::new();
    let value = toml::Value::Table(table.clone());
    walk(schema, (schema, String::new()), &value, &mut Vec::new(), &mut found);
    found
}

fn walk<'a>(
    schema: &'a Value,
    (mut part, mut name): (&'a Value, String),
    value: &toml::Value,
    steps: &mut Vec<Step>,
    found: &mut Vec<DocumentTable<'a>>,
) {
    if let Some(reference) = part["$ref"].as_str() {
        reference.clone_into(&mut name);
        part = schema.pointer(reference.trim_start_matches('#')).expect("a definition");
    }
    if let Some(branches) = part["anyOf"].as_array() {
        // Of the branches, the one for such a value; those for text and numbers have no keys.
        let key = if value.is_table() { "properties" } else { "items" };
        let Some(branch) = branches.iter().find(|branch| branch.get(key).is_some()) else { return };
        part = branch;
    }
    match value {
        toml::Value::Table(table) => {
            let properties = part["properties"].as_object();
            let properties = properties.unwrap_or_else(|| panic!("`{name}` has no table"));
            found.push(DocumentTable { steps: steps.clone(), name: name.clone(), properties });
            for (key, value) in table {
                let part = properties.get(key).unwrap_or_else(|| panic!("`{name}` has no {key}"));
                steps.push(Step::Key(key.clone()));
                walk(schema, (part, format!("{name}/{key}")), value, steps, found);
                steps.pop();
            }
        }
        toml::Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                steps.push(Step::Index(index));
                walk(schema, (&part["items"], format!("{name}[]")), value, steps, found);
                steps.pop();
            }
        }
        _ => {}
    }
}

/// The document with an unknown key in one of its tables.
fn with_unknown_key(table: &Table, steps: &[Step]) -> Table {
    let mut value = toml::Value::Table(table.clone());
    let mut at = &mut value;
    for step in steps {
        at = match step {
            Step::Key(key) => &mut at[key.as_str()],
            Step::Index(index) => &mut at[*index],
        };
    }
    let changed = at.as_table_mut().expect("a table");
    changed.insert(UNKNOWN.to_owned(), toml::Value::Integer(1));
    match value {
        toml::Value::Table(table) => table,
        _ => unreachable!("a document is a table"),
    }
}

/// The keys that the reader lists where it refuses the unknown one.
fn known_keys(name: &str, changed: &Table) -> BTreeSet<String> {
    let text = changed.to_string();
    let errors = from_toml("changed.toml", &text, &folder()).expect_err("an unknown key");
    let unknown = errors.all.iter().find(|error| {
        error.message.starts_with("unknown key") && error.message.ends_with(&format!("{UNKNOWN}`"))
    });
    let unknown = unknown.unwrap_or_else(|| panic!("{name}: no unknown key:\n{errors}\n{text}"));
    let keys = unknown.help.strip_prefix("known here: ").unwrap_or_else(|| panic!("{errors}"));
    keys.split(", ").map(str::to_owned).collect()
}

#[test]
fn an_unknown_key_is_refused_in_every_table_and_both_know_the_same_keys() {
    let schema = schema();
    // By table: the keys that the reader knows in any document, and those of the schema.
    let mut known: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut listed: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (name, table) in documents() {
        for place in places(&schema, &table) {
            let changed = with_unknown_key(&table, &place.steps);
            let faults = faults(&schema, &json(&changed));
            let unknown = |fault: &String| fault.contains(UNKNOWN) || fault.contains("none of");
            assert!(faults.iter().any(unknown), "{name}: {}: {faults:?}", place.name);
            let keys = known_keys(&name, &changed);
            known.entry(place.name.clone()).or_default().extend(keys);
            let properties = place.properties.keys().cloned();
            listed.entry(place.name).or_default().extend(properties);
        }
    }
    for (place, key) in TAKEN {
        assert!(known.entry(place.to_owned()).or_default().insert(key.to_owned()), "{key} is read");
    }
    for (place, keys) in &listed {
        assert_eq!(&known[place], keys, "`{place}`: the reader's keys, those of the schema");
    }
    // Every table of the schema is in some document.
    let tables = tables(&schema);
    println!("{} tables: {:?}", listed.len(), listed.keys());
    assert_eq!(listed.len(), tables, "{:?}", listed.keys());
}

/// The words of a part of the schema.
fn words<'a>(schema: &'a Value, mut part: &'a Value) -> Vec<&'a str> {
    if let Some(reference) = part["$ref"].as_str() {
        part = schema.pointer(reference.trim_start_matches('#')).expect("a definition");
    }
    let own = part["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let branches = part["anyOf"].as_array().into_iter().flatten();
    own.chain(branches.flat_map(|branch| words(schema, branch))).collect()
}

/// Where the schema lists the words of a key, the reader takes these and no other.
#[test]
fn both_know_the_same_words_of_every_key() {
    let schema = schema();
    let mut compared: BTreeMap<String, usize> = BTreeMap::new();
    for (name, table) in documents() {
        for place in places(&schema, &table) {
            for (key, part) in place.properties {
                let known = words(&schema, part);
                let at = format!("{}/{key}", place.name);
                let with = |word: &str| with_word(&table, &place.steps, key, word);
                let Some(other) = with(UNKNOWN).filter(|_| !known.is_empty()) else { continue };
                if compared.contains_key(&at) {
                    continue;
                }
                let reads = |changed: &Table| {
                    let read = from_toml("changed.toml", &changed.to_string(), &folder());
                    read.err().map_or_else(String::new, |errors| errors.to_string())
                };
                assert!(!reads(&other).is_empty(), "{name}: {at} takes any word");
                assert!(!faults(&schema, &json(&other)).is_empty(), "{name}: {at}");
                for word in &known {
                    let changed = with(word).expect("the key is there");
                    let refused = format!("is \"{word}\"\n");
                    let shown = reads(&changed);
                    assert!(!shown.contains(&refused), "{name}: {at} = {word}\n{shown}");
                }
                compared.insert(at, known.len());
            }
        }
    }
    println!("{compared:?}");
    for at in ["#/$defs/device/kind", "/hub/mode"] {
        assert!(compared.contains_key(at), "{at} in {compared:?}");
    }
}

/// The document with a word for a key of one of its tables; none where that key is not there or is no text.
fn with_word(table: &Table, steps: &[Step], key: &str, word: &str) -> Option<Table> {
    let mut value = toml::Value::Table(table.clone());
    let mut at = &mut value;
    for step in steps {
        at = match step {
            Step::Key(key) => &mut at[key.as_str()],
            Step::Index(index) => &mut at[*index],
        };
    }
    let entry = at.as_table_mut()?.get_mut(key).filter(|value| value.is_str())?;
    *entry = toml::Value::String(word.to_owned());
    match value {
        toml::Value::Table(table) => Some(table),
        _ => None,
    }
}

/// How many tables a schema has.
fn tables(part: &Value) -> usize {
    match part {
        Value::Object(map) => {
            let below: usize =
                map.iter().filter(|(key, _)| *key != "properties").map(|(_, v)| tables(v)).sum();
            let own = map.get("properties").and_then(Value::as_object);
            below + own.map_or(0, |own| 1 + own.values().map(tables).sum::<usize>())
        }
        Value::Array(list) => list.iter().map(tables).sum(),
        _ => 0,
    }
}
