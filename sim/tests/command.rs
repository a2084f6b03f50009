//! The command line of `precess`: files, messages and exit codes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
#[cfg(unix)]
use std::time::{Duration, Instant};

fn precess(arguments: &[&str], out: Option<&Path>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.args(arguments);
    if let Some(out) = out {
        command.arg("--out").arg(out);
    }
    command.output().expect("the command starts")
}

/// A folder that is not there yet.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry"));
    entries
        .map(|e| {
            let name = e.file_name().into_string().expect("text");
            (name, fs::read(e.path()).expect("a file"))
        })
        .collect()
}

const SHORT: [&str; 8] =
    ["run", "table1", "--imbalance", "printed", "--drive", "200", "--duration", "0.6"];

#[test]
fn the_same_run_writes_the_same_bytes() {
    let (first, second) = (folder("bytes-first"), folder("bytes-second"));
    let ran = precess(&SHORT, Some(&first));
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    assert!(ran.stderr.is_empty(), "no progress bar in a pipe");
    assert!(precess(&SHORT, Some(&second)).status.success());
    let files = contents(&first);
    let names: Vec<_> = files.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "precess-files.txt",
            "report.html",
            "table1-printed-200-angular-velocity.svg",
            "table1-printed-200-conservation.svg",
            "table1-printed-200-position.svg",
            "table1-printed-200.csv",
        ]
    );
    assert_eq!(files, contents(&second));
}

#[test]
fn the_report_needs_nothing_but_itself() {
    let out = folder("report");
    assert!(precess(&SHORT, Some(&out)).status.success());
    let report = fs::read_to_string(out.join("report.html")).expect("a report");
    assert_eq!(report.matches("<svg").count(), 3);
    for fetched in ["src=", "<link", "@import", "url("] {
        assert!(!report.contains(fetched), "{fetched}");
    }
    assert!(report.contains("prefers-color-scheme: dark"));
    assert!(report.contains("Angular velocity ω (deg/s)"));
}

#[test]
fn all_variants_are_summed_up_in_ten_lines() {
    let out = folder("ten-lines");
    let ran = precess(&["run", "--duration", "0.3"], Some(&out));
    assert!(ran.status.success());
    let text = String::from_utf8(ran.stdout).expect("text");
    assert_eq!(text.lines().count(), 10, "{text}");
    assert!(text.contains("all drifts within 1e-12"), "{text}");
}

#[test]
fn a_setting_out_of_bounds_is_rejected_and_nothing_written() {
    let out = folder("rejected");
    let ran = precess(&["run", "--tolerance", "1"], Some(&out));
    assert_eq!(ran.status.code(), Some(1));
    let text = String::from_utf8(ran.stderr).expect("text");
    let expected = "precess: tolerance 1e0 is outside 1e-15 to 1e-3; the default is 1e-13\n";
    assert_eq!(text, expected);
    assert!(!out.exists());
}

#[test]
fn a_loosened_tolerance_makes_a_broken_bound_a_note() {
    let out = folder("loose");
    let ran = precess(&[&SHORT[..], &["--tolerance", "1e-6"]].concat(), Some(&out));
    let text = String::from_utf8(ran.stdout).expect("text");
    assert!(text.contains("NOT all drifts within 1e-12"), "{text}");
    assert!(ran.status.success());
}

#[test]
fn the_shortest_run_needs_no_rate_and_says_why_it_shows_no_jitter() {
    let out = folder("shortest");
    let ran = precess(&["run", "--duration", "0.001"], Some(&out));
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let text = String::from_utf8(ran.stdout).expect("text");
    assert!(text.contains("2000 samples/s"), "{text}");
    assert!(text.contains("- for jitter: it takes a whole turn"), "{text}");
    let report = fs::read_to_string(out.join("report.html")).expect("a report");
    assert!(report.contains("A dash for jitter: it takes a whole turn"));
}

/// A link to nowhere: nothing is there, and yet no folder can be made.
#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_made_is_rejected_before_the_work() {
    let link = folder("link");
    let _ = fs::remove_file(&link);
    std::os::unix::fs::symlink("nowhere-at-all", &link).expect("a link");
    let started = Instant::now();
    let ran = precess(&["run", "--duration", "10000"], Some(&link));
    assert_eq!(ran.status.code(), Some(1));
    let text = String::from_utf8(ran.stderr).expect("text");
    assert!(text.contains("choose a folder you may write to with --out"), "{text}");
    // The work would take minutes; a rejection takes none of it.
    assert!(started.elapsed() < Duration::from_secs(10), "{:?}", started.elapsed());
}

/// The hub, the start and the columns: what a reader needs to run it again elsewhere.
#[test]
fn the_report_and_the_help_tell_what_was_run() {
    let out = folder("parameters");
    assert!(precess(&SHORT, Some(&out)).status.success());
    let report = fs::read_to_string(out.join("report.html")).expect("a report");
    for value in ["810 kg", "900, 800, 600 kg m²", "4.15, 2.93, 2.75 kg m²", "4.85, 0.57, 0 deg/s"]
    {
        assert!(report.contains(&format!(">{value}<")), "{value}");
    }
    assert!(report.contains("Wheel at the start</td><td class=\"number\">500 rpm<"));
    let help = String::from_utf8(precess(&["run", "--help"], None).stdout).expect("text");
    assert!(help.contains("device_0_*"));
    let table = fs::read_to_string(out.join("table1-printed-200.csv")).expect("samples");
    assert!(table.contains("device_0_spin_rad_per_s"));
}

#[test]
fn a_file_of_somebody_else_stays_and_the_run_is_rejected() {
    let out = folder("foreign");
    fs::create_dir_all(&out).expect("a folder");
    fs::write(out.join("report.html"), "mine").expect("a file");
    let ran = precess(&SHORT, Some(&out));
    assert_eq!(ran.status.code(), Some(1));
    let text = String::from_utf8(ran.stderr).expect("text");
    assert!(text.contains("report.html exists and no earlier run wrote it"), "{text}");
    assert_eq!(contents(&out), BTreeMap::from([("report.html".to_owned(), b"mine".to_vec())]));
}

#[test]
fn every_command_shows_an_example() {
    for arguments in [&["--help"][..], &["run", "--help"], &["list", "--help"]] {
        let text = String::from_utf8(precess(arguments, None).stdout).expect("text");
        assert!(text.contains("Example"), "{arguments:?}");
    }
    let list = String::from_utf8(precess(&["list"], None).stdout).expect("text");
    assert!(list.contains("table1-catalogue-250"));
}
