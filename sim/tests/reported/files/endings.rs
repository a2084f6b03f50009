//! Exit codes, interrupts, and formats that are said by the ending of a name.

use std::fs;
use std::time::{Duration, Instant};

use super::commands::{cases, error_of, names, writing};
use crate::precess;

/// The table of exit codes in a help.
fn table(help: &str) -> &str {
    help.split_once("Exit codes:\n").map_or("", |(_, table)| table).trim_end()
}

#[test]
fn every_help_and_the_page_have_one_table_of_exit_codes() {
    let codes = table(&precess(&["--help"]).out).to_owned();
    for code in ["0 ", "1 ", "2 ", "3 ", "64 ", "130 "] {
        assert!(codes.lines().any(|line| line.trim_start().starts_with(code)), "{code}: {codes}");
    }
    for name in names() {
        let arguments: Vec<_> = name.split(' ').chain(["--help"]).collect();
        assert_eq!(table(&precess(&arguments).out), codes, "{name}");
    }
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/commands.md");
    assert!(fs::read_to_string(page).expect("a page").contains(&codes), "{codes}");
}

#[test]
fn a_wrong_command_line_ends_with_64() {
    assert_eq!(precess(&["nonsense"]).code, Some(64));
    for name in names() {
        let arguments: Vec<_> = name.split(' ').chain(["--nonsense"]).collect();
        assert_eq!(precess(&arguments).code, Some(64), "{name}");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
#[cfg(unix)]
fn sigterm_ends_a_run_early_with_results_that_say_so() {
    for mut case in writing("terminated") {
        let long = match case.name.as_str() {
            "run" | "plot" => ["--set", "run.duration=2000 s"].as_slice(),
            "sweep" | "montecarlo" => &["--set", "run.duration=2000 s", "--threads", "1"],
            _ => continue,
        };
        case.arguments.extend(long.iter().map(|text| (*text).to_owned()));
        let out = case.empty_out().to_owned();
        let child = case.command().stdout(std::process::Stdio::null()).spawn().expect("it starts");
        // When these files are there the signal is awaited; `plot` has none until its end.
        let begun = || match case.name.as_str() {
            "run" => fs::metadata(out.join("wheel.csv.partial")).is_ok_and(|of| of.len() > 0),
            name => out.join(format!("wheel-{name}.journal")).exists(),
        };
        let started = Instant::now();
        let most = Duration::from_secs(if case.name == "plot" { 4 } else { 60 });
        while !begun() && started.elapsed() < most {
            std::thread::sleep(Duration::from_millis(20));
        }
        let kill = format!("kill -TERM {}", child.id());
        let killed = std::process::Command::new("sh").args(["-c", &kill]).status();
        assert!(killed.expect("it starts").success());
        let ended = child.wait_with_output().expect("it ends");
        assert_eq!(ended.status.code(), Some(2), "{}: {}", case.name, error_of(&ended));
        if case.name == "run" {
            let text = fs::read_to_string(out.join("wheel.csv")).expect("a result");
            let counted =
                text.lines().find(|line| line.starts_with("# samples: ")).expect("a line");
            let rows = text.lines().filter(|line| !line.starts_with('#')).count() - 1;
            assert_eq!(counted.trim_end(), format!("# samples: {rows} (cancelled)"));
            assert!(rows > 100 && out.join("wheel.html").exists());
        }
        let partial = fs::read_dir(&out).expect("a folder").filter(|entry| {
            entry.as_ref().is_ok_and(|of| of.path().extension().is_some_and(|e| e == "partial"))
        });
        assert_eq!(partial.count(), 0, "{}", case.name);
    }
}

#[test]
fn an_ending_of_no_format_is_refused() {
    let cases = cases("formats");
    let folder = &cases.first().expect("a case").folder;
    let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let bus = path("bus.npz");
    for (arguments, file) in [
        (["structure", "convert", &bus, "--to"], "z.xyz"),
        (["structure", "convert", &bus, "--to"], "z"),
        (["structure", "show", &bus, "--shapes"], "z.png"),
    ] {
        let file = path(file);
        let ended = precess(&[&arguments[..], &[&file]].concat());
        assert_eq!(ended.code, Some(1), "{file}: {}", ended.out);
        assert!(ended.error.contains("ending"), "{}", ended.error);
        assert!(!std::path::Path::new(&file).exists(), "{file}");
    }
    let upper = path("z.NPZ");
    assert_eq!(precess(&["structure", "convert", &bus, "--to", &upper]).code, Some(0));
    // What is read: an archive is no CSV file.
    let ended = precess(&["compare", &bus, &bus]);
    assert_eq!(ended.code, Some(1));
    assert!(ended.error.contains("not a CSV file"), "{}", ended.error);
}

#[test]
fn no_columns_are_not_all_columns() {
    let case = &writing("no-columns")[0];
    let wheel = case.folder.join("wheel.toml");
    let wheel = wheel.to_str().expect("text");
    for command in ["check", "evaluate"] {
        let ended = precess(&[command, wheel, "--set", "output.columns=[]"]);
        assert_eq!(ended.code, Some(1), "{command}: {}", ended.out);
        assert!(ended.error.contains("`columns` names no column"), "{}", ended.error);
    }
}

#[test]
#[cfg(not(feature = "parquet"))]
fn without_parquet_the_error_and_the_page_of_formats_name_the_feature() {
    let case =
        writing("without-parquet").into_iter().find(|case| case.name == "run").expect("a case");
    let out = case.empty_out();
    let ended = case.command().args(["--set", "output.formats=[\"csv\", \"parquet\"]"]).output();
    let ended = ended.expect("it starts");
    assert_eq!(ended.status.code(), Some(1));
    assert!(error_of(&ended).contains("--features parquet"), "{}", error_of(&ended));
    assert_eq!(fs::read_dir(out).expect("a folder").count(), 0, "before the run");
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenarios.md");
    assert!(fs::read_to_string(page).expect("a page").contains("--features parquet"));
}

#[test]
#[cfg(not(feature = "mcap"))]
fn without_mcap_the_error_and_the_page_of_formats_name_the_feature() {
    let case = &writing("without-mcap")[0];
    let out = case.folder.join("none");
    let wheel = case.folder.join("wheel.toml");
    let arguments =
        ["run", wheel.to_str().expect("text"), "--set", "output.formats=[\"mcap\"]", "--out"];
    let ended = precess(&[&arguments[..], &[out.to_str().expect("text")]].concat());
    assert_eq!(ended.code, Some(1));
    assert!(ended.error.contains("--features mcap"), "{}", ended.error);
    assert!(!out.exists(), "before the run");
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenarios.md");
    assert!(fs::read_to_string(page).expect("a page").contains("--features mcap"));
}
