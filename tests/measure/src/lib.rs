//! One service of the solver on one spacecraft, checked or timed: what `cargo xtask bench` runs
//! against the peers, which have the same commands and output (`tests/peers/README.md`).
//!
//! ```sh
//! measure check target/peers/4.json --service dispatched   # its results
//! measure time target/peers/4.json --service dispatched    # nanoseconds per evaluation
//! measure turns target/peers/4.json --service dispatched   # the same, a turn for each line read
//! measure services                                         # the services there are
//! measure floor                                            # what this CPU can issue at most
//! measure floor-turns "f64"                                # ns per operation, a turn a line
//! measure parts target/peers/4.json                        # what an evaluation is made of
//! ```
//!
//! Built without the feature `lanes` it is the program `portable`, with one service.

mod floor;
mod latency;
mod parts;
mod service;
mod timing;

use std::error::Error;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use precess_tests::stored::Stored;
use service::{Name, open};

/// Checks and times the services of Precess.
#[derive(Parser)]
#[command(after_help = "Example: measure time target/peers/4.json --service dispatched")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// All accelerations of a spacecraft, or its motion over some steps
    Check(Of),
    /// Nanoseconds per evaluation or step
    Time(Of),
    /// The same, a turn for each line of input
    Turns(Of),
    /// The services, with what they are
    Services,
    /// Operations per nanosecond that this CPU can issue
    Floor,
    /// Nanoseconds per operation of one row of the floor, a turn for each line of input
    FloorTurns {
        /// The row
        row: String,
    },
    /// Operations, sines, hub, the longest chain: what an evaluation is made of
    Parts {
        /// The spacecraft
        file: PathBuf,
    },
}

#[derive(clap::Args)]
struct Of {
    /// The spacecraft
    file: PathBuf,
    /// The service
    #[arg(long)]
    service: Name,
}

/// Reads the command line and does what it says.
#[must_use]
pub fn run() -> ExitCode {
    match answer(&Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn answer(command: &Command) -> Result<(), Box<dyn Error>> {
    let line = match command {
        Command::Check(Of { file, service }) => open(*service, file)?.check()?,
        Command::Time(Of { file, service }) => timing::time(open(*service, file)?.as_mut())?,
        Command::Turns(Of { file, service }) => {
            return timing::turns(open(*service, file)?.as_mut());
        }
        Command::Services => {
            Name::value_variants().iter().filter_map(|name| name.description()).collect()
        }
        Command::Floor => floor::floor(),
        Command::FloorTurns { row } => return floor::turns(row),
        Command::Parts { file } => parts::parts(&Stored::read(file)?)?,
    };
    writeln!(std::io::stdout(), "{line}")?;
    Ok(())
}
