//! No test is lost: every test function of the committed list, and every number of cases, is in the sources.
//!
//! The list is that of the day on which the default run was made short (`names.txt`), made by [`list`] from the
//! sources of that day. A test that is moved or renamed has a line in [`MOVED`], one that went with what it tested a
//! line in [`REMOVED`].

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use xtask::run::root;

/// Test functions and numbers as they were: `path name`, and for numbers `path name value`.
const BEFORE: &str = include_str!("names.txt");

/// Beginnings of lines, before and now.
const MOVED: &[(&str, &str)] = &[
    ("xtask/src/regen.rs ", "xtask/derive/src/regen.rs "),
    ("xtask/src/bake.rs ", "xtask/derive/src/bake.rs "),
    ("xtask/src/mutate.rs ", "xtask/derive/src/mutate.rs "),
    ("xtask/src/dist/licences.rs ", "xtask/distribute/src/crates_of.rs "),
    ("xtask/src/dist/", "xtask/distribute/src/dist/"),
    ("xtask/src/flight/", "xtask/distribute/src/flight/"),
    ("xtask/src/wheel.rs ", "xtask/distribute/src/wheel.rs "),
    (
        "dynamics/tests/floors.rs no_floor_uses_one_above_it",
        "tests/tests/architecture/main.rs no_circle_between_folders",
    ),
    (
        "dynamics/tests/floors.rs an_arrow_upwards_is_seen",
        "tests/tests/architecture/graph.rs a_circle_is_named_with_file_and_import",
    ),
    ("codegen/src/derivation/assumed.rs ", "codegen/src/derivation/chain/assumed.rs "),
    ("codegen/src/derivation/parallel.rs ", "codegen/src/derivation/chain/parallel_axes.rs "),
    (
        "codegen/review/src/mutation/physics/mod.rs ",
        "codegen/review/src/mutation/physics/trial.rs ",
    ),
    (
        "sim/src/command/mod.rs an_override_needs_no_quotation_marks_of_its_own",
        "sim/src/command/options.rs an_override_needs_no_quotation_marks_of_its_own",
    ),
    ("sim/fmu/src/lib.rs ", "sim/fmu/src/tests.rs "),
    ("sim/src/engine/checks/", "sim/src/engine/tests/"),
    ("sim/src/engine/clipping.rs ", "sim/src/engine/events/clipping.rs "),
    ("sim/src/engine/roots.rs ", "sim/src/engine/events/roots.rs "),
    ("sim/src/file/read/check.rs ", "sim/src/file/read/check/mod.rs "),
    ("sim/src/file/read/columns.rs ", "sim/src/file/read/output/columns.rs "),
    ("sim/src/file/read/places.rs ", "sim/src/file/read/check/spans.rs "),
    ("sim/src/file/read/requirement.rs ", "sim/src/file/read/output/requirement.rs "),
    ("sim/src/file/read/turns.rs ", "sim/src/file/read/values/turns.rs "),
    ("sim/src/record/checks.rs ", "sim/src/record/tests.rs "),
    ("sim/tests/platforms.rs ", "sim/tests/platforms/main.rs "),
    (
        "dynamics/src/numbers/sincos_checks.rs fused_sine_is_odd_and_cosine_even_to_the_bit",
        "dynamics/src/numbers/sincos_tests.rs sine_is_odd_and_cosine_even_to_the_bit",
    ),
    (
        "tests/tests/dynamics/lane_loads.rs devices_side_by_side_agree_to_rounding_with_loads",
        "tests/tests/lanes/loads.rs devices_side_by_side_have_the_bits_of_one_state_with_loads",
    ),
    ("tests/tests/dynamics/lane_loads.rs ", "tests/tests/lanes/loads.rs "),
    ("tests/tests/dynamics/lane_runs.rs ", "tests/tests/lanes/runs.rs "),
    ("tests/tests/dynamics/lanes.rs ", "tests/tests/lanes/batch.rs "),
    (
        "tests/tests/dynamics/locked.rs lanes_keep_locked_coordinates_and_have_the_bits_of_steps",
        "tests/tests/lanes/locked.rs lanes_keep_locked_coordinates_and_have_the_bits_of_steps",
    ),
    ("tests/tests/dynamics/locked.rs STEPS", "tests/tests/dynamics/locked_gyros.rs STEPS"),
    ("tests/tests/dynamics/parameter_batch.rs ", "tests/tests/lanes/one_spacecraft_each.rs "),
    ("dynamics/src/attitude/attitude_checks.rs ", "dynamics/src/attitude/attitude_tests.rs "),
    ("dynamics/src/equations/error_checks.rs ", "dynamics/src/equations/error_tests.rs "),
    ("dynamics/src/flexible/turn.rs ", "dynamics/src/flexible/equations/turn.rs "),
    ("dynamics/src/lanes/fallback_checks.rs ", "dynamics/src/lanes/fallback_tests.rs "),
    ("dynamics/src/model/parameter_info_checks.rs ", "dynamics/src/model/parameter_info_tests.rs "),
    ("dynamics/src/numbers/sincos_checks.rs ", "dynamics/src/numbers/sincos_tests.rs "),
    ("dynamics/src/sets/built_in_checks.rs ", "dynamics/src/sets/built_in_tests.rs "),
    ("dynamics/src/solve/overflow_checks.rs ", "dynamics/src/solve/overflow_tests.rs "),
    ("dynamics/src/solve/spacecraft_checks.rs ", "dynamics/src/solve/spacecraft_tests.rs "),
    ("dynamics/src/validation/check_checks.rs ", "dynamics/src/validation/check_tests.rs "),
    ("dynamics/src/validation/imbalance_checks.rs ", "dynamics/src/validation/imbalance_tests.rs "),
];

/// Tests that are no longer in the sources: why, and beginnings of their lines in the list.
const REMOVED: &[(&str, &[&str])] = &[
    (
        "pages for a browser are made by `precess-site`, whose own tests hold formulas, tables and links",
        &["codegen/review/src/report/html.rs "],
    ),
    (
        "crates that the suite `agreement` of `precess-baked` emits, whose tests it runs",
        &[
            "tests/baked/imaging_satellite_constants/",
            "tests/baked/parked_spare/",
            "tests/baked/table1/",
        ],
    ),
    (
        "products and sums that are rounded once were removed: there is one result",
        &[
            "codegen/tests/mutation/sites.rs a_product_that_is_one_operation_with_a_sum_is_a_site",
            "dynamics/src/numbers/real.rs mul_add_rounds_the_product_first",
            "dynamics/src/numbers/sincos_checks.rs fused_sines_are_next_to_the_others",
            "tests/tests/dynamics/lane_loads.rs fused_loads_agree_to_rounding",
            "tests/tests/dynamics/lanes.rs fused_spacecraft_answers_all_questions_of_a_plain_one",
            "tests/tests/dynamics/lanes.rs services_agree_with_higher_precision",
            "tests/tests/dynamics/parameter_batch.rs fused_lanes_agree_to_rounding",
        ],
    ),
];

/// Folders that hold tests, from the root.
const FOLDERS: [&str; 7] = ["codegen", "dynamics", "flight", "python", "sim", "tests", "xtask"];

/// Every test function of Rust and Python below a folder, and every whole number that a file of tests names or counts
/// to.
fn list(root: &Path) -> BTreeMap<String, u64> {
    let mut found = BTreeMap::new();
    for folder in FOLDERS {
        walk(&root.join(folder), folder, &mut found);
    }
    found
}

fn walk(folder: &Path, name: &str, found: &mut BTreeMap<String, u64>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let (path, file) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let inner = format!("{name}/{file}");
        if path.is_dir() {
            // What is built or installed is no source.
            if !["target", "node_modules", "generated"].contains(&file.as_str()) {
                walk(&path, &inner, found);
            }
        } else if path.extension().is_some_and(|ending| ending == "rs" || ending == "py") {
            let text = fs::read_to_string(&path).unwrap_or_default();
            functions(&inner, &text, found);
            numbers(&inner, &text, found);
        }
    }
}

/// Test functions: after `#[test]` and other attributes in Rust, by their names in Python.
fn functions(file: &str, text: &str, found: &mut BTreeMap<String, u64>) {
    let mut is_test = false;
    for line in text.lines().map(str::trim) {
        // No function of Rust begins so.
        is_test |= line == "#[test]" || line.starts_with("def test_");
        let name = line.split_once("fn ").or_else(|| line.split_once("def "));
        if let (true, Some((_, name))) = (is_test, name) {
            let name = name.split(['(', '<']).next().unwrap_or(name);
            *found.entry(format!("{file} {name}")).or_insert(0) += 1;
            is_test = false;
        }
    }
}

/// Whole numbers by name, and the sum of the ends of ranges that are written as numbers.
fn numbers(file: &str, text: &str, found: &mut BTreeMap<String, u64>) {
    if !file.contains("tests/") {
        return;
    }
    for line in text.lines().map(str::trim) {
        let constant = line.split_once("const ").and_then(|(_, rest)| rest.split_once(": "));
        if let Some((name, rest)) = constant
            && let Some((_, value)) = rest.split_once(" = ")
            && let Ok(value) = value.trim_end_matches(';').replace('_', "").parse::<u64>()
        {
            *found.entry(format!("{file} {name} =")).or_insert(0) += value;
        }
        // The end of a range, or the number of cases of which a default run takes a tenth.
        let range = line.split_once(" in ").and_then(|(_, range)| range.split_once(".."));
        let ends = [range, line.split_once("cases(")];
        for (_, end) in ends.into_iter().flatten() {
            let digits = end.trim_start_matches('=').chars().take_while(char::is_ascii_digit);
            if let Ok(end) = digits.collect::<String>().parse::<u64>() {
                *found.entry(format!("{file} ranges =")).or_insert(0) += end;
            }
        }
    }
}

/// A line of the list, and its number: 1 for a function.
fn read(line: &str) -> (String, u64) {
    let line = MOVED
        .iter()
        .find_map(|(before, now)| Some(format!("{now}{}", line.strip_prefix(before)?)))
        .unwrap_or_else(|| line.to_owned());
    match line.split_once(" = ") {
        Some((name, value)) => (format!("{name} ="), value.parse().expect("a number")),
        None => (line, 1),
    }
}

#[test]
fn no_test_and_no_case_of_the_list_is_lost() {
    let now = list(&root());
    let removed = |line: &&str| {
        REMOVED.iter().flat_map(|(_, lines)| *lines).any(|beginning| line.starts_with(beginning))
    };
    let lost: Vec<_> = BEFORE
        .lines()
        .filter(|line| !removed(line))
        .map(read)
        .filter(|(name, count)| now.get(name).is_none_or(|found| found < count))
        .map(|(name, count)| format!("{name} {count} (now {:?})", now.get(&name)))
        .collect();
    assert!(lost.is_empty(), "lost since the list was made:\n{}", lost.join("\n"));
}

/// What is still tested was not removed, and what no list names needs no reason.
#[test]
fn a_removed_test_is_of_the_list_and_gone() {
    let now = list(&root());
    for line in REMOVED.iter().flat_map(|(_, lines)| *lines) {
        let of_list = BEFORE.lines().any(|before| before.starts_with(line));
        assert!(of_list, "{line} is not in the list");
        assert!(!now.keys().any(|name| name.starts_with(line)), "{line} is there");
    }
}

/// Prints the list of the sources in a folder, `PRECESS_TREE`; of these without it.
#[test]
#[ignore = "prints the list; in `cargo xtask test --all` that it can be made"]
fn the_list_can_be_made_again() {
    let tree = std::env::var_os("PRECESS_TREE").map_or_else(root, Into::into);
    let list = list(&tree);
    assert!(list.len() > 1000, "{}", list.len());
    for (name, value) in list {
        if name.ends_with('=') { println!("{name} {value}") } else { println!("{name}") }
    }
}
