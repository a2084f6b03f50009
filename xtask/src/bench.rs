//! `bench`: times every service and the peers in one run.

use std::process::Command;

use clap::Args;

use crate::run::{cargo, root, run, target};
use crate::skip::skip;

/// Sets the peers up, and draws the spacecraft.
const SETUP: &str = "tests/peers/setup.py";

/// The folder of peers and spacecraft.
const PEERS: &str = "target/peers";

/// Options of `bench`.
#[derive(Args)]
pub(crate) struct Options {
    /// One round over few spacecraft; writes the page to the folder of the peers instead of docs
    #[arg(long)]
    quick: bool,
    /// Time only Precess, on the spacecraft that exist
    #[arg(long)]
    skip_peers: bool,
}

/// Sets up, builds, and leaves checking, timing and the page to the example `performance`.
pub(crate) fn bench(options: &Options) -> Result<(), String> {
    let mut peers = !options.skip_peers;
    if peers && !is_installed("python3") {
        skip("the peers", "apt-get install python3 python3-venv")?;
        peers = false;
    }
    if peers && run(Command::new("python3").args(["-B", SETUP, "--into", PEERS])).is_err() {
        skip("the peers", &format!("python3 {SETUP} --into {PEERS}"))?;
        peers = false;
    }
    if !root().join(PEERS).join("4.json").exists() {
        return Err(format!("no spacecraft in {PEERS}; run `python3 {SETUP} --into {PEERS}`"));
    }
    let examples = ["--example", "measure", "--example", "performance"];
    let build = ["build", "--release", "-p", "precess-tests", "--features", "bench"];
    cargo(&[&build[..], &examples].concat())?;
    let examples = target()?.join("release/examples");
    let mut performance = Command::new(examples.join("performance"));
    performance.arg("--measure").arg(examples.join("measure")).args(["--peers", PEERS]);
    performance.args(options.quick.then_some("--quick"));
    performance.args((!peers).then_some("--skip-peers"));
    run(&mut performance)
}

/// Whether a program can be started.
fn is_installed(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
}
