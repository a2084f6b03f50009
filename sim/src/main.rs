//! The `precess` command: everything it does is in the library.

use std::process::ExitCode;

use clap::Parser;
use precess::cli::{Cli, print};

fn main() -> ExitCode {
    match Cli::parse().execute(&mut |text| print(text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("precess: {error}");
            ExitCode::FAILURE
        }
    }
}
