//! The `precess` command: everything it does is in the library.

use std::process::ExitCode;

use precess::command::Cli;

fn main() -> ExitCode {
    Cli::execute_arguments()
}
