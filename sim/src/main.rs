//! The `precess` command: everything it does is in the library.

use std::process::ExitCode;

use clap::Parser;
use precess::command::Cli;

fn main() -> ExitCode {
    Cli::parse().execute()
}
