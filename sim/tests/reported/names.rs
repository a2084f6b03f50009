//! Names, and the files named after them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use precess::file::{Diagnostics, budget_from_toml, from_toml, to_toml};
use precess::record::Columns;

use super::{folder, precess};

/// A scenario with a structure: `@` stands for the name of one thing, which `%` names elsewhere.
const SCENARIO: &str = "format = 1\n[hub]\nmass = \"50 kg\"\ninertia = \"9, 8, 7 kg m^2\"\n[run]\nduration = \"0.1 s\"\n\
    [output]\nrate = \"1 kHz\"\n[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
    imbalance.static = \"0.1 g cm\"\nwheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\", rate = \"3000 rpm\" }\n";

/// Tables with a name, each with the key of its list: `@` is the name, `#` the number of the table.
const NAMED: [(&str, &str); 12] = [
    ("device", "name = @\nkind = \"slosh_mass\"\nslosh_mass.mass = \"1 kg\"\n"),
    ("platform", "name = @\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n"),
    (
        "platform.strut",
        "name = @\nposition = \"0, 0, 1 cm\"\ndirection = [0, 0, 1]\nlength = \"1 cm\"\n",
    ),
    (
        "source",
        "name = @\non = \"rw\"\nseed = 1\nharmonic = [{ number = 2.0, radial_force = \"1 g mm\" }]\n",
    ),
    ("requirement", "name = @\nquantity = \"omega\"\nstatistic = \"peak\"\nlimit = \"1 rad/s\"\n"),
    ("crossing", "name = @\ncolumn = \"rw.spin\"\nvalue = \"1 rpm\"\n"),
    ("at", "name = @\ntime = \"1 ms\"\njoint = \"rw.wheel\"\ntorque = \"1 mN m\"\n"),
    ("wrench", "name = @\non = \"hub\"\nforce = \"0, 0, 1 mN\"\n"),
    ("point", "name = @\nposition = \"0, 0, 1 cm\"\n"),
    (
        "controller",
        "name = @\nrate = \"20 Hz\"\ndevices = [\"own#\"]\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
         [[device]]\nname = \"own#\"\nkind = \"balanced_reaction_wheel\"\n\
         wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n",
    ),
    ("structure.node", "name = @\nposition = \"0, 0, 1 m\"\n"),
    ("structure.point", "name = @\nnode = \"tip\"\n"),
];
const STRUCTURE: &str = "[structure]\ncontains_devices = false\n[[structure.mode]]\nfrequency = \"9 Hz\"\n\
    [[structure.mode.shape]]\nnode = \"tip\"\ntranslation = [0, 0, 1]\n\
    [[structure.node]]\nname = \"tip\"\nposition = \"0, 0, 1 m\"\n";
const PLATFORM: &str =
    "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n";

/// A scenario with tables of a list, each with one of some names.
fn with_names(key: &str, table: &str, names: &[&str]) -> String {
    let mut text = SCENARIO.to_owned();
    if key.starts_with("structure") {
        text = text.replace("kind =", "node = \"tip\"\nkind =") + STRUCTURE;
    }
    if key.starts_with("platform.") {
        text += PLATFORM;
    }
    for (index, name) in names.iter().enumerate() {
        let quoted = serde_json::to_string(name).expect("a text");
        let numbered = table.replace('#', &index.to_string());
        text.extend(["[[", key, "]]\n", &numbered.replace('@', &quoted)]);
    }
    text
}

fn errors(text: &str) -> Diagnostics {
    match from_toml("named", text, Path::new("")) {
        Ok((scenario, _)) => panic!("accepted:\n{text}\n{}", scenario.name),
        Err(errors) => errors,
    }
}

/// Every table of the schema with a name, budgets aside, is in the list above.
#[test]
fn the_list_of_names_is_that_of_the_schema() {
    fn walk(at: &str, value: &serde_json::Value, found: &mut BTreeSet<String>) {
        if let Some(map) = value.as_object() {
            if map.get("properties").is_some_and(|keys| keys.get("name").is_some()) {
                found.insert(at.to_owned());
            }
            for (key, value) in map {
                let skipped = ["properties", "items", "$defs"].contains(&key.as_str());
                let at = match (skipped, at) {
                    (true, _) => at.to_owned(),
                    (false, "") => key.clone(),
                    (false, at) => format!("{at}.{key}"),
                };
                walk(&at, value, found);
            }
        }
    }
    let schema = include_str!("../../schema/scenario-1.json");
    let schema: serde_json::Value = serde_json::from_str(schema).expect("JSON");
    let mut found = BTreeSet::new();
    walk("", &schema, &mut found);
    found.remove("");
    // It is the name of a device that the layout has.
    found.remove("layout_member");
    let listed: BTreeSet<_> = NAMED.iter().map(|(key, _)| (*key).to_owned()).collect();
    assert_eq!(found, listed);
}

#[test]
fn no_name_of_any_kind_is_empty_long_hidden_or_twice() {
    let long = "r".repeat(101);
    for (key, table) in NAMED {
        let good = from_toml("named", &with_names(key, table, &["one", "two"]), Path::new(""));
        assert!(good.is_ok(), "{key}: {}", good.expect_err("an error"));
        for (name, part) in [
            ("", "at least one letter"),
            (long.as_str(), "of 101 letters; at most 100"),
            ("a\nb", "U+000A"),
            ("a\u{1b}[31mb", "U+001B"),
            ("a\u{202e}b", "U+202E"),
            (" a", "begins or ends with a space"),
        ] {
            let found = errors(&with_names(key, table, &[name]));
            let error = found.all.iter().find(|error| error.message.contains(part));
            let error = error.unwrap_or_else(|| panic!("{key}, {name:?}: {found}"));
            assert!(error.span.is_some(), "{key}: {found}");
            // What is not shown does not reach the terminal, and a long name not whole.
            assert!(found.all.iter().all(|error| !error.message.contains(['\u{1b}', '\u{202e}'])));
            assert!(found.all.iter().all(|error| error.message.len() < 300), "{found}");
        }
        let twice = errors(&with_names(key, table, &["same", "same"]));
        let said = twice.all.iter().filter(|error| error.message.contains("are named `same`"));
        assert_eq!(said.count(), 1, "{key}: {twice}");
    }
}

/// A device may not be called as what has columns of its own in every scenario, or as a word of `on`.
#[test]
fn names_of_other_columns_are_no_names_of_devices() {
    let (scenario, _) = from_toml("named", SCENARIO, Path::new("")).expect("a scenario");
    let columns = Columns::all(&scenario);
    let own = |name: &String| name != "rw" && !name.contains('.');
    let names = columns.as_slice().iter().flat_map(|column| {
        [Some(column.name.clone()), Some(column.group.clone()), column.vector.clone()]
    });
    let mut names: BTreeSet<String> = names.flatten().filter(own).collect();
    names.extend(["hub", "loads", "modes"].map(str::to_owned));
    for wanted in ["omega", "time", "energy", "attitude", "q0"] {
        assert!(names.contains(wanted), "{names:?}");
    }
    for (key, table) in NAMED.iter().filter(|(key, _)| ["device", "platform"].contains(key)) {
        for name in &names {
            let found = errors(&with_names(key, table, &[name]));
            assert!(found.to_string().contains("choose another name"), "{key} {name}: {found}");
        }
    }
}

/// Names that are one in the name of a file: every picture is there, each once.
#[test]
fn each_name_has_a_file_of_its_own() {
    let out = folder("collide");
    let names = ["a b", "a-b", "A.B", "é", "è", "a-b-2"];
    let (key, table) = NAMED[4];
    fs::write(out.join("bus.toml"), with_names(key, table, &names)).expect("written");
    let file = out.join("bus.toml").display().to_string();
    let results = out.join("results");
    let to = results.display().to_string();
    let over = "hub.mass=50..60 kg:2";
    let ended = precess(&["sweep", &file, "--over", over, "--lines", "0", "--out", &to]);
    assert_eq!(ended.code, Some(0), "{}", ended.error);
    let pictures = fs::read_dir(&results).expect("results").filter(|entry| {
        let path = entry.as_ref().expect("an entry").path();
        path.extension().is_some_and(|extension| extension == "svg")
    });
    // Of each requirement, and RMS and peak of omega.
    assert_eq!(pictures.count(), names.len() + 2);
    let budget = "format = 1\nscenario = \"bus.toml\"\n[speed]\nfrom = \"1000 rpm\"\nto = \"3000 rpm\"\ncount = 3\n\
        [[line_of_sight]]\nname = \"cam,1\"\nnode = \"hub\"\n[[line_of_sight]]\nname = \"cam-1\"\nnode = \"hub\"\n\
        [[requirement]]\nline_of_sight = \"cam,1\"\nname = \"a b\"\nlimit = \"1 deg\"\n\
        [[requirement]]\nline_of_sight = \"cam-1\"\nname = \"a,b\"\nlimit = \"1 deg\"\n\
        [[requirement]]\nline_of_sight = \"cam-1\"\nlimit = \"1 deg\"\n\
        [[requirement]]\nline_of_sight = \"cam,1\"\nlimit = \"1 deg\"\n";
    fs::write(out.join("budget.toml"), budget).expect("written");
    let file = out.join("budget.toml").display().to_string();
    let to = out.join("budget").display().to_string();
    let ended = precess(&["jitter", &file, "--out", &to, "--no-compare"]);
    assert_eq!(ended.code, Some(0), "{}", ended.error);
    for name in ["budget-waterfall-cam-1.svg", "budget-waterfall-cam-1-2.svg"] {
        assert!(out.join("budget").join(name).is_file(), "{name}");
    }
    let table = fs::read_to_string(out.join("budget/budget-requirements.csv")).expect("a table");
    assert_eq!(table.lines().next(), Some("speed_rad_per_s,a_b,a_b_2,RMS,RMS_2"));
}

/// Names of a budget: the same rule.
#[test]
fn names_of_a_budget_are_short_text_in_one_line() {
    let out = folder("budget-names");
    fs::write(out.join("bus.toml"), SCENARIO).expect("written");
    let long = "r".repeat(101);
    for (sight, requirement, part) in [
        ("cam,1\\nx", "a", "U+000A"),
        ("cam", long.as_str(), "of 101 letters"),
        ("cam", "\\u001b[2J", "U+001B"),
    ] {
        let text = format!(
            "format = 1\nscenario = \"bus.toml\"\n[speed]\nfrom = \"1000 rpm\"\nto = \"3000 rpm\"\n\
             [[line_of_sight]]\nname = \"{sight}\"\nnode = \"hub\"\n\
             [[requirement]]\nname = \"{requirement}\"\nlimit = \"1 deg\"\n"
        );
        let path = out.join("budget.toml");
        fs::write(&path, text).expect("written");
        let shown = budget_from_toml(&path, &[]).expect_err("an error").to_string();
        assert!(shown.contains(part), "{shown}");
    }
}

/// Crossings without a name have one each, and the file that the tool writes is read again.
#[test]
fn what_has_no_name_has_one_of_its_own() {
    let crossing = "[[crossing]]\ncolumn = \"rw.spin\"\nvalue = \"1 rpm\"\n";
    let text = format!("{SCENARIO}{crossing}{crossing}");
    let (scenario, _) = from_toml("named", &text, Path::new("")).expect("a scenario");
    let names: Vec<_> = scenario.crossings.iter().map(|of| of.name.as_str()).collect();
    assert_eq!(names, ["crossing", "crossing 2"]);
    assert!(from_toml("named", &to_toml(&scenario), Path::new("")).is_ok());
}
