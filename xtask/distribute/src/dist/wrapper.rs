//! A wrapper of rustc: what it compiles does not depend on the folder in which a crate is, nor on chance.
//!
//! Cargo tells rustc a hash of each package, from which names of symbols and the order of code follow. For a path
//! outside the workspace, as `dynamics` is for `flight` and `python`, it has the whole path in it. The wrapper states
//! name and version instead. `--remap-path-prefix` does the same for the paths of files.
//!
//! Of functions with the same code LLVM keeps one, and which one differs from run to run of one command (rust-lang/rust
//! issue 52044). What is linked into a library is compiled without that pass, which only an unstable option turns off.

use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, ExitCode};

/// The variable by which this program is the wrapper: the folder of the crates whose hash is replaced.
pub(super) const VARIABLE: &str = "PRECESS_DIST_SOURCES";

/// Runs rustc, if cargo started this program in its place.
pub(crate) fn called() -> Option<ExitCode> {
    let sources = std::env::var_os(VARIABLE)?;
    let mut arguments = std::env::args_os().skip(1);
    let rustc = arguments.next()?;
    let package = |name| std::env::var(name).unwrap_or_default();
    let manifest = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let ours = Path::new(&manifest).starts_with(sources);
    let name = format!(
        "metadata={}-{}-{}",
        package("CARGO_PKG_NAME"),
        package("CARGO_PKG_VERSION"),
        package("CARGO_CRATE_NAME")
    );
    let arguments: Vec<_> =
        arguments.map(|argument| if ours { replaced(argument, &name) } else { argument }).collect();
    let mut command = Command::new(&rustc);
    if is_library(&arguments) {
        command.env("RUSTC_BOOTSTRAP", "1").arg("-Zmerge-functions=disabled");
    }
    Some(match command.args(arguments).status() {
        Ok(status) if status.success() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {} did not start: {error}", Path::new(&rustc).display());
            ExitCode::FAILURE
        }
    })
}

/// Whether a library for other languages is compiled: there the crates are optimised as a whole.
fn is_library(arguments: &[OsString]) -> bool {
    let types = arguments.iter().filter_map(|argument| argument.to_str());
    types.into_iter().any(|argument| argument == "cdylib" || argument == "staticlib")
}

/// The argument, or what replaces the hash.
fn replaced(argument: OsString, name: &str) -> OsString {
    let is_hash = argument.to_str().is_some_and(|text| text.starts_with("metadata="));
    if is_hash { name.into() } else { argument }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_is_known_by_its_crate_type() {
        let arguments = |text: &str| text.split(' ').map(OsString::from).collect::<Vec<_>>();
        assert!(is_library(&arguments("--crate-type staticlib --crate-type cdylib")));
        assert!(!is_library(&arguments("--crate-name cdylibs --crate-type lib")));
    }

    #[test]
    fn only_the_hash_of_the_package_is_replaced() {
        let arguments = ["-C", "metadata=0123456789abcdef", "-C", "extra-filename=-0123"];
        let found = arguments.map(|argument| replaced(argument.into(), "metadata=a-1-a"));
        assert_eq!(
            found,
            ["-C", "metadata=a-1-a", "-C", "extra-filename=-0123"].map(OsString::from)
        );
    }
}
