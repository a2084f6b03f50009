//! Derivation, proof and emission, and what breaks them on purpose: commands of `cargo xtask` that link the generator.

mod bake;
mod mutate;
mod pages;
mod printed;
mod regen;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Derives, proves, emits.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
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
    /// Make each term that the emitted functions compute wrong, and each sine and cosine, one at a
    /// time, and check that a law of physics fails
    #[command(after_help = "Example: cargo xtask mutate --kernel wheel")]
    Mutate(mutate::Options),
}

fn main() -> ExitCode {
    xtask::ended(match Arguments::parse().command {
        Command::Regen(options) => regen::regen(&options),
        Command::Bake(options) => bake::bake(&options),
        Command::Mutate(options) => mutate::mutate(&options),
    })
}
