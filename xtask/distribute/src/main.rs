//! What leaves the workspace: boards, archives, the Python package, and whose crates are in them. Commands of `cargo xtask` that read object files
//! or pack.

mod crates_of;
mod dependencies;
mod dist;
mod flight;
mod python;
mod wheel;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Builds what leaves the workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Build for boards, run under emulation, compare with this machine bit for bit, pass the
    /// gates; measure, write the page
    #[command(after_help = "Example: cargo xtask flight --check")]
    Flight(flight::Options),
    /// Build what is distributed: sources, crates, C library, desktop tool, Python package; install each in an empty
    /// place and run its first example
    #[command(
        after_help = "Examples: cargo xtask dist --check\n          cargo xtask dist --only precess-c-"
    )]
    Dist(dist::Options),
    /// Check licences, bans and sources of the crates of every workspace against deny.toml
    #[command(after_help = "Example: cargo xtask dependencies")]
    Dependencies,
    /// Build the wheel of the Python package, install it in an environment of its own, run its tests
    #[command(after_help = "Examples: cargo xtask python\n          cargo xtask python --quick")]
    Python(python::Options),
}

fn main() -> ExitCode {
    // Cargo starts this program in place of rustc when `dist` builds.
    if let Some(code) = dist::called() {
        return code;
    }
    xtask::ended(match Arguments::parse().command {
        Command::Flight(options) => flight::flight(&options),
        Command::Dist(options) => dist::dist(&options),
        Command::Dependencies => dependencies::dependencies(),
        Command::Python(options) => python::python(&options),
    })
}
