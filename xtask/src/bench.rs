//! `bench`: times every service and the peers in one run.

use std::path::PathBuf;
use std::process::Command;

use clap::Args;

use xtask::capi::MANIFEST;
use xtask::run::{cargo, root, run, target};
use xtask::skip::skip;

/// Sets the peers up, and draws the spacecraft.
const SETUP: &str = "tests/peers/setup.py";

/// The folder of peers and spacecraft.
const PEERS: &str = "target/peers";

/// Options of `bench`.
#[derive(Args)]
#[expect(clippy::struct_excessive_bools, reason = "options of a command line")]
pub(crate) struct Options {
    /// One round over few spacecraft; writes the page to the folder of the peers instead of docs
    #[arg(long)]
    quick: bool,
    /// Time only Precess, on the spacecraft that exist
    #[arg(long)]
    skip_peers: bool,
    /// Time only wheels on bearings, on a platform and on a flexible structure, and write their page
    #[arg(long)]
    flexible: bool,
    /// Time only derivatives of accelerations and of steps, and write their page
    #[arg(long, conflicts_with = "flexible")]
    derivatives: bool,
}

/// Sets up, builds, and leaves checking, timing and the page to the example `performance`.
pub(crate) fn bench(options: &Options) -> Result<(), String> {
    let mut peers = !options.skip_peers;
    if peers && !is_installed("python3") {
        skip("the peers", "apt-get install python3 python3-venv")?;
        peers = false;
    }
    if peers {
        let mut setup = Command::new("python3");
        setup.args(["-B", SETUP, "--into", PEERS]);
        if options.flexible {
            setup.args(["--subject", "flexible"]);
        } else if options.derivatives {
            setup.args(["--subject", "derivatives"]);
        } else {
            setup.arg("--library").arg(library()?);
        }
        if run(&mut setup).is_err() {
            skip("the peers", &format!("python3 {SETUP} --into {PEERS}"))?;
            peers = false;
        }
    }
    if !options.derivatives && !root().join(PEERS).join("steps").join("4.json").exists() {
        return Err(format!("no spacecraft in {PEERS}; run `python3 {SETUP} --into {PEERS}`"));
    }
    // The same program with lanes and, portable, without: features of one build would be joined.
    let service = ["build", "--release", "-p", "precess-measure"];
    let portable = !options.flexible && !options.derivatives;
    if portable {
        cargo(&[&service[..], &["--bin", "portable"]].concat())?;
    }
    cargo(&[&service[..], &["--features", "lanes", "--bin", "measure"]].concat())?;
    cargo(&["build", "--release", "-p", "precess-tests", "--example", "performance"])?;
    let release = target()?.join("release");
    let mut performance = Command::new(release.join("examples/performance"));
    performance.arg("--measure").arg(release.join("measure"));
    performance.args(["--peers", PEERS]).args(options.quick.then_some("--quick"));
    performance.args(options.flexible.then_some("--flexible"));
    performance.args(options.derivatives.then_some("--derivatives"));
    if portable {
        performance.arg("--portable").arg(release.join("portable"));
    }
    performance.args((!peers).then_some("--skip-peers"));
    run(&mut performance)
}

/// Builds the library for flight software; returns the static one.
fn library() -> Result<PathBuf, String> {
    let folder = target()?.join("flight");
    let text = folder.to_string_lossy().into_owned();
    cargo(&["build", "--release", "--manifest-path", MANIFEST, "--target-dir", &text])?;
    Ok(folder.join("release/libprecess.a"))
}

/// Whether a program can be started.
fn is_installed(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
}
