//! Results that are read again: whether they are whole, and whether two differ.

use std::fs;
use std::path::{Path, PathBuf};

use super::commands::cases;
use crate::{CommandResult, precess};

/// A result of 401 samples, and its text.
fn result(folder: &str) -> (PathBuf, String) {
    let folder = cases(folder).remove(0).folder;
    let file = folder.join("results/wheel.csv");
    let text = fs::read_to_string(&file).expect("a result");
    (folder, text)
}

fn put(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("a file");
    path.to_str().expect("text").to_owned()
}

fn spectrum(folder: &Path, file: &str) -> CommandResult {
    let out = folder.join("spectra");
    precess(&["spectrum", file, "--force", "--out", out.to_str().expect("text")])
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_result_that_was_cut_is_refused() {
    let (folder, text) = result("cut");
    assert!(text.contains("# samples: 401 (finished)"));
    let ends: Vec<usize> = text.match_indices('\n').map(|(at, _)| at + 1).collect();
    let rows_from = ends.len() - 401;
    // At ends of lines: without the last sample, half of them, all of them. Within the last number, and before its end.
    let lengths = [
        ends[ends.len() - 2],
        ends[ends.len() - 200],
        ends[rows_from - 1],
        text.len() - 2,
        text.len() - 1,
    ];
    for length in lengths {
        let file = put(&folder, "cut.csv", &text[..length]);
        for ended in [precess(&["compare", &file, &file]), spectrum(&folder, &file)] {
            assert_eq!(ended.code, Some(1), "{length} of {}: {}", text.len(), ended.out);
            assert!(ended.error.contains("it was cut or changed"), "{}", ended.error);
        }
    }
    // Nor has a cut archive the list of its members.
    let wheel = folder.join("wheel.toml");
    let wheel = wheel.to_str().expect("text");
    let out = folder.join("archive");
    let npz = ["--set", "output.formats=[\"npz\"]", "--out", out.to_str().expect("text")];
    assert_eq!(precess(&[&["run", wheel][..], &npz].concat()).code, Some(0));
    let bytes = fs::read(out.join("wheel.npz")).expect("a result");
    for length in [bytes.len() - 1, bytes.len() / 2, 100] {
        let file = out.join("cut.npz");
        fs::write(&file, &bytes[..length]).expect("a file");
        let ended = spectrum(&folder, file.to_str().expect("text"));
        assert_eq!(ended.code, Some(1), "{length} of {}: {}", bytes.len(), ended.out);
        assert!(ended.error.contains("it was cut"), "{}", ended.error);
    }
    // A row more is not of the run, either.
    let last = &text[ends[ends.len() - 2]..];
    let file = put(&folder, "long.csv", &format!("{text}{last}"));
    assert_eq!(precess(&["compare", &file, &file]).code, Some(1));
    // So is a table of a scenario.
    let wheel = fs::read_to_string(folder.join("wheel.toml")).expect("a file");
    let table = wheel.replace("push.csv\", column = \"f\"", "cut.csv\", column = \"energy\"");
    put(&folder, "cut.csv", &text[..ends[ends.len() - 2]].replace("\ntime,", "\ntime_s,"));
    let ended = precess(&["check", &put(&folder, "table.toml", &table)]);
    assert_eq!(ended.code, Some(1), "{}", ended.out);
    assert!(ended.error.contains("it was cut or changed"), "{}", ended.error);
}

#[test]
fn results_of_others_and_of_runs_in_progress_are_read() {
    let (folder, text) = result("uncounted");
    let counted = text.lines().find(|line| line.starts_with("# samples: ")).expect("a line");
    let earlier = put(&folder, "earlier.csv", &text.replace(&format!("{counted}\n"), ""));
    let not_yet = "# samples: not counted, the run has not ended";
    let partial = text.replace(counted, &format!("{not_yet:<width$}", width = counted.len()));
    let partial = put(&folder, "a.csv.partial", &partial);
    let rows = text.split_inclusive('\n').filter(|line| !line.starts_with('#'));
    let plain: String = rows.collect();
    let plain = put(&folder, "plain.csv", &plain);
    for (file, warned) in [(earlier, false), (plain, false), (partial, true)] {
        for ended in [precess(&["compare", &file, &file]), spectrum(&folder, &file)] {
            assert_eq!(ended.code, Some(0), "{file}: {}", ended.error);
            assert_eq!(ended.error.contains("has not ended"), warned, "{file}: {}", ended.error);
        }
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_difference_is_an_exit_code_within_a_tolerance_it_is_none() {
    let (folder, text) = result("differ");
    let first = folder.join("results/wheel.csv");
    let first = first.to_str().expect("text");
    assert_eq!(precess(&["compare", first, first]).code, Some(0));
    // One number of one row, by one part in 1e9 of itself; its column is named in the row of names.
    let names = text.lines().find(|line| !line.starts_with('#')).expect("names");
    let place = names.split(',').position(|name| name == "rw.spin").expect("a column");
    let rows = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let mut count = 0;
    let changed: Vec<String> = rows
        .map(|mut cells| {
            let number = cells.get(place).and_then(|cell| cell.parse::<f64>().ok());
            let moved =
                number.map_or_else(String::new, |number| (number * (1.0 + 1e-9)).to_string());
            count += usize::from(number.is_some());
            if count == 100 && number.is_some() {
                cells[place] = moved;
            }
            cells.join(",")
        })
        .collect();
    let second = put(&folder, "second.csv", &(changed.join("\n") + "\n"));
    let code = |more: &[&str]| precess(&[&["compare", first, &second], more].concat()).code;
    assert_eq!(code(&[]), Some(2));
    assert_eq!(code(&["--tolerance", "1e-8"]), Some(0));
    assert_eq!(code(&["--tolerance", "1e-10"]), Some(2));
    assert_eq!(code(&["--tolerance", "rw.spin=1 rpm"]), Some(0));
    assert_eq!(code(&["--tolerance", "omega=1 rpm"]), Some(2));
    assert_eq!(code(&["--tolerance", "rw.spin=1 kg"]), Some(1));
    assert_eq!(code(&["--tolerance", "rw.spni=1 rpm"]), Some(1));
    assert_eq!(code(&["--tolerance", "-1"]), Some(64));
    let shown = precess(&["compare", first, &second]);
    assert!(shown.out.contains("1 differ"), "{}", shown.out);
    let json = precess(&["compare", first, &second, "--format", "json"]);
    assert_eq!(json.code, Some(2));
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    assert_eq!(found[0]["differs"], true);
    // A column or a result that only one has.
    let fewer: String = text.replacen(",omega_x,", ",omega_w,", 1);
    let fewer = put(&folder, "fewer.csv", &fewer);
    let ended = precess(&["compare", first, &fewer]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.out.contains("only in the first: omega_x"), "{}", ended.out);
    let [a, b] = ["a", "b"].map(|name| folder.join(name));
    for folder in [&a, &b] {
        fs::create_dir_all(folder).expect("a folder");
        put(folder, "same.csv", &text);
    }
    let folders = [a.to_str().expect("text"), b.to_str().expect("text")];
    let compared = || precess(&[&["compare"][..], &folders].concat()).code;
    assert_eq!(compared(), Some(0));
    put(&b, "more.csv", &text);
    assert_eq!(compared(), Some(2));
    // Scenarios: every bit is the same.
    let wheel = folder.join("wheel.toml");
    let wheel = wheel.to_str().expect("text");
    assert_eq!(precess(&["compare", wheel, wheel]).code, Some(0));
}
