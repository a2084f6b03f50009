//! One service of the solver on one spacecraft, checked or timed: what `cargo xtask bench` runs
//! against the peers, which have the same commands and output (`tests/peers/README.md`).
//!
//! ```sh
//! measure check target/peers/4.json --service one    # its accelerations
//! measure time target/peers/4.json --service one     # nanoseconds per evaluation
//! measure services                                   # the services there are
//! measure floor                                      # what this CPU can do at most
//! measure parts target/peers/4.json                  # what an evaluation is made of
//! ```

mod floor;
mod latency;
mod parts;
mod service;
mod timing;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use precess_tests::stored::Stored;
use serde_json::json;
use service::{Name, open};

/// Checks and times the services of Precess.
#[derive(Parser)]
#[command(after_help = "Example: measure time target/peers/4.json --service one")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// All accelerations of a spacecraft
    Check(Of),
    /// Nanoseconds per evaluation
    Time(Of),
    /// The services, with what they are
    Services,
    /// Operations per nanosecond that this CPU can issue
    Floor,
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

fn main() -> ExitCode {
    match answer(&Arguments::parse().command) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn answer(command: &Command) -> Result<serde_json::Value, Box<dyn Error>> {
    Ok(match command {
        Command::Check(Of { file, service }) => {
            json!({ "accelerations": open(*service, &Stored::read(file)?)?.accelerations()? })
        }
        Command::Time(Of { file, service }) => {
            timing::time(open(*service, &Stored::read(file)?)?.as_mut())?
        }
        Command::Services => Name::value_variants().iter().map(|name| name.description()).collect(),
        Command::Floor => floor::floor(),
        Command::Parts { file } => parts::parts(&Stored::read(file)?)?,
    })
}
