//! The workbench: one short file per command, and three programs for those that link much, built when they are called
//! for.

mod accuracy;
mod attack;
mod bench;
mod callgrind;
mod check;
mod demo;
mod engines;
mod instructions;
mod measured;
mod members;
mod object_code;
mod program;
mod reports;
mod test;

use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use xtask::capi;

use program::{DERIVE, DISTRIBUTE, Program, SITE};

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
    #[command(disable_help_flag = true)]
    Regen(Forwarded),
    /// Derive, prove and write kernels of one spacecraft; without a file, those of the tests
    #[command(disable_help_flag = true)]
    Bake(Forwarded),
    /// The quick loop: `regen --check`, `bake --check`, `mutate --check`, format, clippy, unit tests
    #[command(after_help = "Example: cargo xtask check")]
    Check,
    /// Format and clippy, warnings denied
    #[command(after_help = "Example: cargo xtask lint")]
    Lint,
    /// Make each term that the emitted functions compute wrong, and each sine and cosine, one at a
    /// time, and check that a law of physics fails
    #[command(disable_help_flag = true)]
    Mutate(Forwarded),
    /// Test most promises, each once; everything with `--all`, what a change can break with `--for`
    #[command(
        after_help = "Examples: cargo xtask test\n          cargo xtask test --for dynamics/src/solve\n          cargo xtask test --all"
    )]
    Test(test::Options),
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
    /// Build the script and the style of the report again, compare them with the committed files, and
    /// check two pages in a browser, if Node.js and Chromium are installed
    #[command(after_help = "Example: cargo xtask reports")]
    Reports,
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
    #[command(disable_help_flag = true)]
    Flight(Forwarded),
    /// Build the library for flight software, and test it from C and C++
    #[command(after_help = "Example: cargo xtask capi")]
    Capi,
    /// Build what is distributed: sources, crates, C library, desktop tool, Python package; install each in an empty
    /// place and run its first example
    #[command(disable_help_flag = true)]
    Dist(Forwarded),
    /// Check licences, bans and sources of the crates of every workspace against deny.toml
    #[command(disable_help_flag = true)]
    Dependencies(Forwarded),
    /// Build the wheel of the Python package, install it in an environment of its own, run its tests
    #[command(disable_help_flag = true)]
    Python(Forwarded),
    /// Write documents, references and notebooks as one folder of pages that need no network
    #[command(disable_help_flag = true)]
    Site(Forwarded),
    /// Derive, prove, solve the paper's scenario and draw the report
    #[command(after_help = "Example: cargo xtask demo")]
    Demo,
}

/// Arguments of a command in a program of its own, which explains them: `--help` among them.
#[derive(Args)]
struct Forwarded {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTIONS")]
    arguments: Vec<String>,
}

impl Forwarded {
    /// Builds the program and runs the command.
    fn run(&self, program: Program, command: &str) -> Result<(), String> {
        let arguments = self.arguments.iter().map(String::as_str);
        program.run(&[command].into_iter().chain(arguments).collect::<Vec<_>>())
    }
}

fn main() -> ExitCode {
    // `test` starts this program in place of others, to measure them.
    if let Some(code) = measured::called() {
        return code;
    }
    xtask::ended(match Arguments::parse().command {
        Command::Regen(arguments) => arguments.run(DERIVE, "regen"),
        Command::Bake(arguments) => arguments.run(DERIVE, "bake"),
        Command::Check => check::check(),
        Command::Lint => check::lint(),
        Command::Mutate(arguments) => arguments.run(DERIVE, "mutate"),
        Command::Test(options) => test::test(&options),
        Command::Attack(options) => attack::attack(&options),
        Command::Engines(options) => engines::engines(&options),
        Command::Reports => reports::reports(),
        Command::Bench(options) => bench::bench(&options),
        Command::Accuracy(options) => accuracy::accuracy(&options),
        Command::Instructions(options) => instructions::instructions(&options),
        Command::Flight(arguments) => arguments.run(DISTRIBUTE, "flight"),
        Command::Capi => capi::host(),
        Command::Dist(arguments) => arguments.run(DISTRIBUTE, "dist"),
        Command::Dependencies(arguments) => arguments.run(DISTRIBUTE, "dependencies"),
        Command::Python(arguments) => arguments.run(DISTRIBUTE, "python"),
        Command::Site(arguments) => arguments.run(SITE, "site"),
        Command::Demo => demo::demo(),
    })
}
