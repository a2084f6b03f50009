//! The command `spectrum`: a result of a run, a known line, and what is refused.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

#[path = "../shared/contents.rs"]
mod contents;

use contents::contents;

/// Of printed amplitudes of a line on a bin, and of the sum of its exposures.
const ROUNDING: f64 = 1e-9;

fn precess(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_precess")).args(arguments).output().expect("it starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

fn path(path: &Path) -> &str {
    path.to_str().expect("text")
}

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("spectrum").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// A result with `7 + 3 cos(2 pi 25 t)` and a ramp, 1 s at 1000 Hz and a last sample between two.
fn result(folder: &Path) -> PathBuf {
    let mut rows = "# columns: name [unit] (frame) meaning\n#   time [s] time\n\
        #   omega_x [rad/s] (B) a\n#   omega_y [rad/s] (B) b\n#   w1.spin [rad/s] c\n\
        time,omega_x,omega_y,w1.spin\n"
        .to_owned();
    for i in 0..1000 {
        let time = f64::from(i) * 1e-3;
        let _ = writeln!(rows, "{time},{},{time},1", 7.0 + 3.0 * (TAU * 25.0 * time).cos());
    }
    rows += "0.9993,0,0,0\n";
    let file = folder.join("known.csv");
    fs::write(&file, rows).expect("a file");
    file
}

fn refused(arguments: &[&str]) -> String {
    let output = precess(arguments);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    text(&output.stderr)
}

#[test]
fn a_known_line_has_its_numbers() {
    let folder = folder("line");
    let file = result(&folder);
    let arguments = [
        "spectrum",
        path(&file),
        "--out",
        path(&folder),
        "--format",
        "json",
        "--segment",
        "0.2 s",
        "--band",
        "15, 35 Hz",
        "--exposure",
        "20 ms",
    ];
    let output = precess(&arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let number = |pointer: &str| found.pointer(pointer).and_then(Value::as_f64).expect(pointer);
    let near = |pointer: &str, expected: f64| {
        let value = number(pointer);
        assert!((value - expected).abs() < ROUNDING, "{pointer}: {value} for {expected}");
    };
    assert_eq!((number("/spectrum/samples"), number("/spectrum/segments")), (1000.0, 9.0));
    assert_eq!(found["columns"].as_array().map(Vec::len), Some(2), "omega, not w1.spin");
    near("/columns/0/mean", 7.0);
    near("/columns/0/rms", 4.5_f64.sqrt());
    near("/columns/0/lines/0/frequency", 25.0);
    near("/columns/0/lines/0/amplitude", 3.0);
    assert_eq!(found["columns"][0]["lines"].as_array().map(Vec::len), Some(1));
    // Hann's window spreads the line to 20 and 30 Hz, and each bin is 5 Hz wide.
    near("/columns/0/bands/0/rms", 4.5_f64.sqrt());
    // Half a period from its crest or trough: means 7 ± 3 / 20, by the first sample, which has no opposite one.
    let parts = ["displacement", "smear", "jitter"];
    let parts = parts.map(|part| number(&format!("/columns/0/exposures/0/{part}")).powi(2));
    assert!((parts[0] - 49.0 - 0.15 * 0.15).abs() < ROUNDING, "{parts:?}");
    assert!((parts.iter().sum::<f64>() - 49.0 - 4.5).abs() < ROUNDING, "{parts:?}");
    let files = contents(&folder);
    let names: Vec<_> = files.keys().map(String::as_str).collect();
    assert_eq!(names, ["known-spectrum-omega.svg", "known-spectrum.csv", "known.csv"]);
    let table = text(&files["known-spectrum.csv"]);
    let line = table.lines().find(|line| line.starts_with("25.0,")).expect("a bin of 25 Hz");
    let amplitude: f64 = line.split(',').nth(2).expect("a cell").parse().expect("a number");
    assert!((amplitude - 3.0).abs() < ROUNDING, "{line}");
    let again = precess(&arguments);
    assert!(text(&again.stderr).contains("exists") && !again.status.success());
}

#[test]
fn results_in_both_formats_have_one_spectrum() {
    let folder = folder("formats");
    let example = precess(&["new", "reaction_wheel"]);
    let file = folder.join("wheel.toml");
    fs::write(&file, example.stdout).expect("a file");
    let formats = "output.formats=[\"csv\", \"npz\"]";
    let short = "run.duration=0.2 s";
    let run = ["run", path(&file), "--out", path(&folder), "--set", short, "--set", formats];
    assert!(precess(&run).status.success());
    let of = |result: &str, out: &str| {
        let (result, out) = (folder.join(result), folder.join(out));
        let output = precess(&["spectrum", path(&result), "--out", path(&out)]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        (text(&output.stdout).replace(path(&out), ""), contents(&out))
    };
    let (shown, files) = of("wheel.csv", "a");
    assert!((shown.clone(), files) == of("wheel.npz", "b"), "two spectra");
    assert!(shown.contains("omega_z") && shown.contains("window hann"), "{shown}");
}

#[test]
fn what_has_no_spectrum_is_refused_with_the_remedy() {
    let folder = folder("refused");
    let file = result(&folder);
    let file = path(&file);
    let scenario = folder.join("other.csv");
    fs::write(&scenario, "a,b\n1,2\n").expect("a file");
    let uneven = folder.join("uneven.csv");
    fs::write(&uneven, "time,a\n0,1\n1,2\n2.5,3\n3,4\n4,5\n").expect("a file");
    let broken = folder.join("broken.npz");
    fs::write(&broken, "PK").expect("a file");
    for (arguments, part) in [
        (vec!["spectrum", file, "--column", "omga"], "nearest: `omega_x`"),
        (vec!["spectrum", file, "--segment", "2 s"], "a segment of 2000 samples is not within"),
        (vec!["spectrum", file, "--exposure", "1.5 ms"], "is 1.5000 samples"),
        (vec!["spectrum", file, "--band", "10, 600 Hz"], "half the sampling rate"),
        (vec!["spectrum", file, "--from", "0.9995 s"], "fewer than three samples"),
        (vec!["spectrum", path(&scenario)], "its first column is not `time`"),
        (
            vec!["spectrum", path(&uneven)],
            "sample 2 of the interval, at 2.5 s, is not evenly spaced",
        ),
        (vec!["spectrum", path(&broken)], "broken.npz"),
        (vec!["spectrum", "no.csv"], "no.csv"),
    ] {
        let message = refused(&[&arguments[..], &["--out", path(&folder.join("out"))]].concat());
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
    assert!(!folder.join("out").exists());
    let wrong = precess(&["spectrum", file, "--band", "30, 20 Hz"]);
    assert!(text(&wrong.stderr).contains("write two rising frequencies and their unit"));
}
