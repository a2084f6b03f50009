//! Running cargo and other programs: what a command other than `regen` is made of.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Prints a line; a reader that has gone away is no error.
#[macro_export]
macro_rules! say {
    ($($line:tt)*) => {
        // The reader of the output has gone.
        let _ = std::io::Write::write_fmt(
            &mut std::io::stdout(),
            format_args!("{}\n", format_args!($($line)*)),
        );
    };
}

/// The repository's root.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_path_buf)
}

/// Where cargo puts what it builds: this program is in the folder of its profile there.
///
/// # Errors
/// A line, where the program is in no such folder.
pub fn target() -> Result<PathBuf, String> {
    let here = std::env::current_exe().map_err(|error| format!("where am I: {error}"))?;
    let folder = here.parent().and_then(Path::parent).map(Path::to_path_buf);
    folder.ok_or_else(|| format!("{} is in no build folder", here.display()))
}

/// Cargo itself.
#[must_use]
pub fn program() -> String {
    std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned())
}

/// Runs cargo in the root and waits for it.
///
/// # Errors
/// A line that names the command that failed.
pub fn cargo(arguments: &[&str]) -> Result<(), String> {
    run(Command::new(program()).args(arguments))
}

/// The variable that names the desktop tool, where it has been built.
pub const TOOL: &str = "PRECESS_COMMAND";

/// The desktop tool: the one that [`TOOL`] names, or the one that cargo builds for the tests.
///
/// # Errors
/// A line, where it is not built.
pub fn tool() -> Result<PathBuf, String> {
    if let Some(named) = std::env::var_os(TOOL) {
        return Ok(named.into());
    }
    cargo(&["build", "--quiet", "--package", "precess", "--bin", "precess"])?;
    built("precess")
}

/// Where cargo puts a program of the profile that the tests have.
///
/// # Errors
/// As [`target`].
pub fn built(name: &str) -> Result<PathBuf, String> {
    Ok(target()?.join("debug").join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// Runs a program in the root and waits for it.
///
/// # Errors
/// A line that names the command that failed.
pub fn run(command: &mut Command) -> Result<(), String> {
    run_there(command.current_dir(root()))
}

/// Runs a program in the folder that the command states, and waits for it.
///
/// # Errors
/// A line that names the command that failed.
pub fn run_there(command: &mut Command) -> Result<(), String> {
    let line = shown(command);
    eprintln!("$ {line}");
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{line}` failed ({status})")),
        Err(error) => Err(format!("`{line}` did not start: {error}")),
    }
}

/// What a program prints in the folder that the command states, if it succeeds.
///
/// # Errors
/// The command that failed and all that it printed, which begins in the first line: that one is in the table of `test`.
pub fn output(command: &mut Command) -> Result<String, String> {
    let line = shown(command);
    let output = command.output().map_err(|error| format!("`{line}` did not start: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(text);
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    let printed = format!("{text}{errors}");
    Err(format!("`{line}` failed ({}): {}", output.status, printed.trim_start()))
}

/// Whether a program is on this machine: it states its version.
#[must_use]
pub fn is_there(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
}

/// A command as one would type it: its program without its folder.
fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let program = program.file_name().unwrap_or(command.get_program());
    let words = std::iter::once(program).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_without_the_folder_of_its_program() {
        let mut command = Command::new("/somewhere/bin/cargo");
        assert_eq!(shown(command.args(["test", "--workspace"])), "cargo test --workspace");
        assert_eq!(shown(&Command::new("valgrind")), "valgrind");
    }
}
