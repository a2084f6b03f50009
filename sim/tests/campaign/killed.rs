//! A sweep that is killed again and again at random moments, and continued: the result is that of a sweep that was not, byte for
//! byte; no finished sample is run twice, and none is lost.

use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use super::shared::{command, folder, path, results, text};

#[path = "../shared/numbers.rs"]
mod numbers;

/// Kills until the sweep is complete, at most.
const ROUNDS: usize = 200;
/// Moments are within this share of the duration of a whole sweep, so that a sweep takes several starts.
const SPREAD: f64 = 0.35;
/// Kills that there have to be.
const KILLS: usize = 4;

fn arguments<'a>(file: &'a Path, out: &'a Path) -> Vec<&'a str> {
    let over = "device.rw.wheel.rate=600..6000 rpm:60";
    let set = "run.duration=0.6 s";
    vec!["sweep", path(file), "--over", over, "--set", set, "--threads", "2", "--out", path(out)]
}

/// Records of a journal: whole ones, by their lengths.
fn records(bytes: &[u8]) -> Vec<u32> {
    let mut rest = bytes.get(18 + 32 + 4..).unwrap_or_default();
    let mut samples = Vec::new();
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = usize::try_from(u32::from_le_bytes(*length)).expect("small");
        let Some(content) = after.get(4..4 + length) else { break };
        samples.push(u32::from_le_bytes(*content.first_chunk().expect("a number")));
        rest = &after[4 + length..];
    }
    samples
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_sweep_that_is_killed_and_continued_has_the_result_of_one_that_was_not() {
    let (folder, file) = folder("killed");
    let whole = folder.join("whole");
    let started = Instant::now();
    let output = command(&arguments(&file, &whole)).output().expect("it starts");
    // 2: the requirement is violated at high rates.
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let whole_run = started.elapsed();
    let whole = results(&whole);

    let out = folder.join("out");
    let journal = out.join("wheel-sweep.journal");
    let mut kills = 0;
    let mut before: Vec<u32> = Vec::new();
    let mut shares = numbers::Numbers(0x2545_f491_4f6c_dd1d)
        .map(|number| f64::from(u32::try_from(number >> 32).unwrap_or(0)) / f64::from(u32::MAX));
    for round in 0..ROUNDS {
        let mut command = command(&arguments(&file, &out));
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().expect("it starts");
        let share = shares.next().expect("no end");
        std::thread::sleep(whole_run.mul_f64(SPREAD * share).min(Duration::from_secs(5)));
        let _ = child.kill();
        let ended = child.wait().expect("it ends");
        let now = std::fs::read(&journal).map(|bytes| records(&bytes)).unwrap_or_default();
        assert!(now.starts_with(&before), "round {round}: a finished sample is lost");
        let mut once = now.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), now.len(), "round {round}: a sample is there twice");
        before = now;
        if let Some(code) = ended.code() {
            // 2: it is complete, or 1: it was complete when it was killed, and its result is there.
            assert!(code == 2 || whole.keys().all(|name| out.join(name).exists()), "round {round}");
            break;
        }
        kills += 1;
        assert!(
            results(&out).iter().all(|(name, bytes)| {
                name.ends_with(".partial") || whole.get(name) == Some(bytes)
            })
        );
    }
    println!("{whole_run:?} a sweep, {kills} kills");
    assert!(kills >= KILLS, "{kills} kills in {whole_run:?}");
    assert_eq!(before.len(), 60);
    let mut found = results(&out);
    found.retain(|name, _| !name.ends_with(".partial"));
    assert!(found == whole, "another result");
}
