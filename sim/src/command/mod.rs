//! The command line: its commands and options. Each command is a file; all they do is in the
//! library.

mod accelerance;
mod advice;
mod bake;
mod benchmark;
mod campaign;
mod check;
mod compare;
mod error;
mod evaluate;
mod exit;
mod export;
mod fit;
mod generator;
mod identify;
mod jitter;
mod kinds;
mod limits_and_springs;
mod margins;
mod new;
mod options;
mod outputs;
mod plot;
mod progress;
mod result;
mod run;
mod scenarios;
mod schema;
mod shell;
mod sources;
mod spectrum;
mod structure;
mod table;
mod terminal;
mod watch;

use std::io::{ErrorKind, Write as _};
use std::process::ExitCode;

use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

pub use error::CommandError;

use exit::Exit;
use terminal::{note, notes_are_written};

use campaign::{montecarlo, sweep};

/// Runs spacecraft with imbalanced wheels, gyros, panels and slosh masses, from a scenario file to
/// a report.
#[derive(Debug, Parser)]
#[command(
    name = "precess",
    version,
    after_help = "Examples:\n  precess new reaction_wheel > bus.toml\n  precess check bus.toml\n  \
                  precess run bus.toml --out results"
)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Print a commented example of a scenario file, with typical values
    #[command(after_help = "Example:\n  precess new pyramid > pyramid.toml")]
    New(new::New),
    /// Check scenario files: mass properties, momenta, imbalance, pivots, sampling, warnings
    #[command(after_help = "Example:\n  precess check bus.toml --set hub.mass='\"900 kg\"'")]
    Check(check::Check),
    /// Run scenario files and write results and reports
    #[command(after_help = run::HELP)]
    Run(run::Run),
    /// Print accelerations, motor torques, loads and the energy ledger at the initial state
    #[command(after_help = "Example:\n  precess evaluate bus.toml --format json")]
    Evaluate(evaluate::Evaluate),
    /// Print the differences of two results (CSV), of two folders of them, or of two scenario files
    #[command(after_help = compare::HELP)]
    Compare(compare::Compare),
    /// Run scenario files and write only the figures, as SVG
    #[command(after_help = "Example:\n  precess plot bus.toml --out figures")]
    Plot(plot::Plot),
    /// Print RMS, lines and exposures of columns of a result, and write their spectra (CSV, SVG)
    #[command(after_help = spectrum::HELP)]
    Spectrum(Box<spectrum::Spectrum>),
    /// Print the JSON Schema of scenario files, for editors
    #[command(after_help = "Example:\n  precess schema > precess.schema.json")]
    Schema,
    /// Print the kinds of devices with their bodies and joints
    #[command(after_help = "Example:\n  precess kinds dgvscmg")]
    Kinds(kinds::Kinds),
    /// Derive, prove and write kernels of this one spacecraft, as Rust or C
    #[command(after_help = "Example:\n  precess bake bus.toml --out bus_kernels --language c")]
    Bake(bake::Bake),
    /// Show the modes of a structure, or write them as NPZ
    #[command(subcommand, after_help = "Example:\n  precess structure show bus.npz")]
    Structure(structure::StructureCommand),
    /// Write accelerances of a structure over frequency, and the mounted force of a wheel by its blocked one
    #[command(after_help = accelerance::HELP)]
    Accelerance(Box<accelerance::AcceleranceCommand>),
    /// Sweep the speed of rotors, and compare the jitter of lines of sight with its limits
    #[command(after_help = jitter::HELP)]
    Jitter(jitter::Jitter),
    /// Compute margins, sensitivity and poles of a controller's loop, and what lines of rotors do through it
    #[command(after_help = margins::HELP)]
    Margins(Box<margins::Margins>),
    /// Fit imbalance, harmonics, modes and noise of a wheel to forces and moments on a rigid table
    #[command(after_help = fit::HELP)]
    Fit(fit::FitCommand),
    /// Run a scenario's model along telemetry, and tell what has changed: imbalance, drag, torque constants, gyro bias
    #[command(after_help = watch::HELP)]
    Watch(Box<watch::WatchCommand>),
    /// Find imbalance, friction, inertia and bias of a spacecraft in telemetry, with intervals
    #[command(after_help = identify::HELP)]
    Identify(Box<identify::IdentifyCommand>),
    /// Measure methods by records whose truth is known
    #[command(subcommand, after_help = benchmark::HELP)]
    Benchmark(Box<benchmark::Benchmark>),
    /// Run a scenario over values of one key or two, and compare every run with its requirements
    #[command(after_help = sweep::HELP)]
    Sweep(Box<sweep::Sweep>),
    /// Run a scenario whose keys are drawn from distributions: percentiles, probabilities, sensitivities
    #[command(name = "montecarlo", after_help = montecarlo::HELP)]
    MonteCarlo(Box<montecarlo::MonteCarlo>),
    /// Write a scenario for other programs: the flight library, importers of functional mock-up units
    #[command(subcommand, after_help = "Example:\n  precess export table bus.toml")]
    Export(export::Export),
    /// Print what a shell completes after `precess`
    #[command(after_help = shell::COMPLETIONS_HELP)]
    Completions(shell::Completions),
    /// Print the manual page of `precess`, or write those of all its commands
    #[command(after_help = shell::MANUAL_HELP)]
    Manual(shell::Manual),
}

impl Cli {
    /// Executes the command line of this process: prints help or what is wrong with it, or executes the command.
    #[must_use]
    pub fn execute_arguments() -> ExitCode {
        let mut command = with_exit_codes(Self::command());
        let parsed = command.try_get_matches_from_mut(std::env::args_os());
        let parsed = parsed.and_then(|matches| Self::from_arg_matches(&matches));
        match parsed.map_err(|error| error.format(&mut command)) {
            Ok(cli) => cli.execute(),
            Err(error) => {
                // Help and version go to standard output, what is wrong to standard error.
                let printed = error.print().and_then(|()| std::io::stdout().flush());
                match printed {
                    _ if error.use_stderr() => Exit::Usage.into(),
                    Err(found) if found.kind() != ErrorKind::BrokenPipe => {
                        note(&CommandError::Output(found).to_string());
                        Exit::Error.into()
                    }
                    _ => Exit::Success.into(),
                }
            }
        }
    }

    /// Executes the command.
    fn execute(self) -> ExitCode {
        crate::opened::remember();
        let done = match self.command {
            Command::New(new) => new.execute(),
            Command::Check(check) => check.execute(),
            Command::Run(run) => run.execute(),
            Command::Evaluate(evaluate) => evaluate.execute(),
            Command::Compare(compare) => compare.execute(),
            Command::Plot(plot) => plot.execute(),
            Command::Spectrum(spectrum) => spectrum.execute(),
            Command::Schema => schema::execute(),
            Command::Kinds(kinds) => kinds.execute(),
            Command::Bake(bake) => bake.execute(),
            Command::Structure(structure) => structure.execute(),
            Command::Accelerance(accelerance) => accelerance.execute(),
            Command::Jitter(jitter) => jitter.execute(),
            Command::Margins(margins) => margins.execute(),
            Command::Fit(fit) => fit.execute(),
            Command::Watch(watch) => watch.execute(),
            Command::Identify(identify) => identify.execute(),
            Command::Benchmark(benchmark) => benchmark.execute(),
            Command::Sweep(sweep) => sweep.execute(),
            Command::MonteCarlo(campaign) => campaign.execute(),
            Command::Export(export) => export.execute(),
            Command::Completions(completions) => {
                completions.execute(with_exit_codes(Self::command()))
            }
            Command::Manual(manual) => manual.execute(with_exit_codes(Self::command())),
        };
        match done {
            Ok(exit) if notes_are_written() => exit.into(),
            Ok(_) => Exit::Error.into(),
            Err(error) => {
                note(&error.to_string());
                Exit::Error.into()
            }
        }
    }
}

/// A command whose help, and that of all its commands, ends with the table of exit codes.
fn with_exit_codes(command: clap::Command) -> clap::Command {
    let help = command.get_after_help().map_or_else(String::new, |help| format!("{help}\n\n"));
    command.after_help(help + exit::TABLE).mut_subcommands(with_exit_codes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_declared_without_conflict() {
        Cli::command().debug_assert();
    }
}
