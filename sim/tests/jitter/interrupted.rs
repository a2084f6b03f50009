//! Ctrl-C and SIGTERM during a command that has its answer only at the end: a message, an exit code of its own, no files.

use std::io::Read as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::cubesat::{files, folder};

/// How long a command may take to listen to signals, and to end by one.
const PATIENCE: Duration = Duration::from_secs(60);
/// The bit of SIGINT, 2, in a mask of signals, whose first bit is that of signal 1.
const SIGINT_BIT: u64 = 1 << 1;

/// Whether a process has a handler of SIGINT.
fn listens(child: &Child) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id()));
    let status = status.unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    caught
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| mask & SIGINT_BIT != 0)
}

/// Starts a command in a folder, sends it a signal as soon as it listens, and returns its exit code and its notes.
fn interrupted(arguments: &[&str], folder: &Path, signal: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.args(arguments).args(["--out", "out"]).current_dir(folder);
    let mut child =
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
    let started = Instant::now();
    while !listens(&child) {
        assert!(started.elapsed() < PATIENCE, "it listens to no signal");
        assert_eq!(child.try_wait().expect("a process"), None, "it ended by itself");
        std::thread::sleep(Duration::from_millis(1));
    }
    // SIGTERM has its handler a moment after SIGINT.
    std::thread::sleep(Duration::from_millis(200));
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(sent.expect("kill").success(), "it ended by itself");
    let status = child.wait().expect("it ends");
    let mut notes = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut notes).expect("text");
    (status.code(), notes)
}

#[test]
fn an_interrupt_ends_a_budget_with_a_message_and_without_files() {
    let folder = files("interrupted-budget", "given");
    let arguments = ["jitter", "budget.toml", "--set", "budget.speed.count=1000000"];
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let (found, notes) = interrupted(&arguments, &folder, signal);
        assert_eq!(found, Some(code), "{signal}: {notes}");
        assert!(notes.ends_with("interrupted: nothing is written\n"), "{signal}: {notes}");
        assert!(!folder.join("out").exists(), "{signal}: nothing is left behind");
    }
    std::fs::remove_dir_all(folder).expect("it was made");
}

#[test]
fn an_interrupt_ends_a_fit_with_a_message_and_without_files() {
    let folder = folder("interrupted-fit");
    let mut example = Command::new(env!("CARGO_BIN_EXE_precess"));
    let done = example.args(["fit", "--example", "."]).current_dir(&folder).output();
    assert!(done.expect("it starts").status.success());
    let (found, notes) = interrupted(&["fit", "wheel-measurement.toml"], &folder, "-INT");
    assert_eq!(found, Some(130), "{notes}");
    assert!(notes.ends_with("interrupted: nothing is written\n"), "{notes}");
    assert!(!folder.join("out").exists(), "nothing is left behind");
    std::fs::remove_dir_all(folder).expect("it was made");
}
