//! A run that is killed, a hundred times at random moments: each result file is the old one or the
//! new one, whole, and everything else is named `*.partial`; what is in a partial CSV file is read
//! to its last row.

#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[path = "shared/contents.rs"]
mod contents;
#[path = "shared/numbers.rs"]
mod numbers;

use contents::contents;
use numbers::Numbers;
use precess_tests::cases;

/// How often a run is killed.
const ROUNDS: u64 = 100;
/// Moments are within this many times the duration of a run that is not killed, so that some come
/// after its end.
const SPREAD: f64 = 1.2;
/// What stands for an earlier result; no run writes it.
const OLD: &[u8] = b"an earlier result\n";

/// The formats that this build writes.
const FORMATS: &[&str] = match (cfg!(feature = "mcap"), cfg!(feature = "parquet")) {
    (false, false) => &["csv", "npz"],
    (true, false) => &["csv", "npz", "mcap"],
    (false, true) => &["csv", "npz", "parquet"],
    (true, true) => &["csv", "npz", "mcap", "parquet"],
};

/// A share of one.
fn share(number: u64) -> f64 {
    f64::from(u32::try_from(number >> 32).unwrap_or(0)) / f64::from(u32::MAX)
}

/// A run of one wheel into a folder.
fn command(file: &Path, out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.arg("run").arg(file).arg("--out").arg(out).args(["--force", "--no-report"]);
    command.args(["--set", "run.duration=0.2 s", "--set", "output.rate=10 kHz"]);
    command.args(["--set", &format!("output.formats={FORMATS:?}")]);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// A scenario file of one wheel, and an empty folder.
fn scenario() -> (PathBuf, PathBuf) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kill");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let mut new = Command::new(env!("CARGO_BIN_EXE_precess"));
    let example = new.args(["new", "reaction_wheel"]).output().expect("the command starts");
    let file = folder.join("wheel.toml");
    fs::write(&file, example.stdout).expect("a file");
    (file, folder)
}

/// A CSV file but for the line with the number of samples, which is written last.
fn without_count(file: &[u8]) -> Vec<u8> {
    let lines = file.split_inclusive(|byte| *byte == b'\n');
    lines.filter(|line| !line.starts_with(b"# samples: ")).flatten().copied().collect()
}

/// Whole rows of a CSV file: all begin as the complete file does, so all can be read. A row that was
/// cut off is the last one, without the end of its line.
fn rows(partial: &[u8], complete: &[u8]) -> usize {
    let [counted, whole] = [partial, complete].map(without_count);
    assert!(whole.starts_with(&counted), "a partial CSV file is no beginning of the whole");
    let whole = partial.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let text = std::str::from_utf8(&partial[..whole]).expect("text");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let columns = lines.next().map_or(0, |names| names.split(',').count());
    lines
        .map(|line| {
            let numbers = line.split(',').map(|number| number.parse::<f64>().expect("a number"));
            assert_eq!(numbers.count(), columns, "{line}");
        })
        .count()
}

#[test]
fn a_run_that_is_killed_leaves_the_old_result_or_the_new_one_or_partial_ones() {
    let (file, folder) = scenario();
    let complete = folder.join("complete");
    let started = Instant::now();
    assert!(command(&file, &complete).status().expect("the command starts").success());
    let whole_run = started.elapsed();
    let complete = contents(&complete);
    assert_eq!(complete.len(), FORMATS.len(), "{:?}", complete.keys());

    let out = folder.join("out");
    let (mut killed, mut partial, mut replaced, mut rows_kept) = (0, 0, 0, 0);
    let shares = Numbers(0x9e37_79b9_7f4a_7c15).map(share);
    let rounds = usize::try_from(cases(ROUNDS)).expect("few");
    for (round, share) in shares.take(rounds).enumerate() {
        let _ = fs::remove_dir_all(&out);
        fs::create_dir_all(&out).expect("a folder");
        for name in complete.keys() {
            fs::write(out.join(name), OLD).expect("a file");
        }
        let mut child = command(&file, &out).spawn().expect("the command starts");
        std::thread::sleep(whole_run.mul_f64(share * SPREAD).min(Duration::from_secs(2)));
        let _ = child.kill();
        killed += usize::from(!child.wait().expect("it ends").success());
        for (name, bytes) in contents(&out) {
            if let Some(new) = complete.get(&name) {
                replaced += usize::from(bytes == *new);
                assert!(bytes == *new || bytes == OLD, "round {round}: {name} is cut off");
            } else {
                assert!(name.ends_with(".partial"), "round {round}: {name}");
                partial += 1;
            }
            if name == "wheel.csv.partial" {
                rows_kept += rows(&bytes, &complete["wheel.csv"]);
            }
        }
        assert!(
            complete.keys().all(|name| out.join(name).exists()),
            "round {round}: a result went"
        );
    }
    println!(
        "{whole_run:?} a run; {killed} of {rounds} killed, {partial} partial files with {rows_kept} \
         rows, {replaced} new results"
    );
    // Otherwise the moments were not those at which something can go wrong.
    assert!(killed > 0 && partial > 0 && rows_kept > 0, "{killed} killed, {partial} partial");
}
