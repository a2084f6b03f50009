//! The workbench: one short file per command.

mod accuracy;
mod attack;
mod bake;
mod bench;
mod callgrind;
mod capi;
mod check;
mod demo;
mod dist;
mod engines;
mod files;
mod flight;
mod instructions;
mod members;
mod mutate;
mod object_code;
mod printed;
mod python;
mod regen;
mod run;
mod skip;
mod test;
mod wheel;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// The workbench of Precess.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", after_help = "Example: cargo xtask demo")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Derive, emit and prove every kernel; write the files if every proof holds
    #[command(
        after_help = "Examples: cargo xtask regen --check\n          cargo xtask regen --emit c --out DIR"
    )]
    Regen(regen::Options),
    /// Derive, prove and write kernels of one spacecraft; without a file, those of the tests
    #[command(
        after_help = "Examples: cargo xtask bake --check\n          cargo xtask bake --scenario scenarios/imaging-satellite.toml --language c"
    )]
    Bake(bake::Options),
    /// The quick loop: `regen --check`, `mutate --check`, format, clippy, unit tests
    #[command(after_help = "Example: cargo xtask check")]
    Check,
    /// Format and clippy, warnings denied
    #[command(after_help = "Example: cargo xtask lint")]
    Lint,
    /// Make each term that the emitted functions compute wrong, and each sine and cosine, one at a
    /// time, and check that a law of physics fails
    #[command(after_help = "Example: cargo xtask mutate --kernel wheel")]
    Mutate(mutate::Options),
    /// Run all tests
    #[command(after_help = "Example: cargo xtask test")]
    Test,
    /// Try to break the promises of docs/promises.md with random spacecraft, on every core; print
    /// what fails as a test to paste
    #[command(
        after_help = "Examples: cargo xtask attack --minutes 10\n          cargo xtask attack --property singular-is-refused --seed 7"
    )]
    Attack(attack::Options),
    /// Compute the stored values again with the engines, if their Python packages are installed
    #[command(
        after_help = "Examples: cargo xtask engines\n          cargo xtask engines --more 1000"
    )]
    Engines(engines::Options),
    /// Time every service and the peers in one run on one core, and write the page
    #[command(
        after_help = "Examples: cargo xtask bench --quick --skip-peers\n          cargo xtask bench --flexible"
    )]
    Bench(bench::Options),
    /// Measure the error of the accelerations where they are ill conditioned; write the page and
    /// draw it
    #[command(after_help = "Example: cargo xtask accuracy --check")]
    Accuracy(accuracy::Options),
    /// Count the instructions of a call under callgrind; write the table
    #[command(after_help = "Example: cargo xtask instructions --check")]
    Instructions(instructions::Options),
    /// Build for boards, run under emulation, compare with this machine bit for bit, pass the
    /// gates; measure, write the page
    #[command(after_help = "Example: cargo xtask flight --check")]
    Flight(flight::Options),
    /// Build the library for flight software, and test it from C and C++
    #[command(after_help = "Example: cargo xtask capi")]
    Capi,
    /// Build what is distributed: sources, crates, C library, Python package; install each in an empty
    /// place and run its first example
    #[command(
        after_help = "Examples: cargo xtask dist --check\n          cargo xtask dist --only precess-c-"
    )]
    Dist(dist::Options),
    /// Build the wheel of the Python package, install it in an environment of its own, run its tests
    #[command(after_help = "Example: cargo xtask python")]
    Python,
    /// Derive, prove, solve the paper's scenario and draw the report
    #[command(after_help = "Example: cargo xtask demo")]
    Demo,
}

fn main() -> ExitCode {
    // Cargo starts this program in place of rustc when `dist` builds.
    if let Some(code) = dist::called() {
        return code;
    }
    let done = match Arguments::parse().command {
        Command::Regen(options) => regen::regen(&options),
        Command::Bake(options) => bake::bake(&options),
        Command::Check => check::check(),
        Command::Lint => check::lint(),
        Command::Mutate(options) => mutate::mutate(&options),
        Command::Test => test::test(),
        Command::Attack(options) => attack::attack(&options),
        Command::Engines(options) => engines::engines(&options),
        Command::Bench(options) => bench::bench(&options),
        Command::Accuracy(options) => accuracy::accuracy(&options),
        Command::Instructions(options) => instructions::instructions(&options),
        Command::Flight(options) => flight::flight(&options),
        Command::Capi => capi::host(),
        Command::Dist(options) => dist::dist(&options),
        Command::Python => python::python(),
        Command::Demo => demo::demo(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
