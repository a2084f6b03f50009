//! The library of a unit for this platform, by a C compiler.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::failure;
use crate::command::error::CommandError;
use crate::fmu::{FmiVersion, compiler_arguments, platform};

/// The engine as a static library: beside this program, or in the folder `lib` beside that of this program.
const ENGINE: &str = "libprecess_fmu.a";
/// How it is linked, so that none of its symbols is visible and nothing is in the library that is not called; and what of the
/// system it needs.
const WITH_ENGINE: [&str; 8] = [
    "-Wl,--gc-sections",
    "-Wl,--exclude-libs,ALL",
    "-Wl,-s",
    "-lgcc_s",
    "-lpthread",
    "-ldl",
    "-lm",
    "-lc",
];

/// Where the engine is.
pub(super) fn of_engine(named: Option<&Path>) -> Result<PathBuf, CommandError> {
    if env::consts::OS != "linux" {
        let message = "units that run the simulator's engine are made on Linux alone";
        return Err(CommandError::Other(message.to_owned()));
    }
    let own = env::current_exe().ok();
    let places = own.iter().flat_map(|own| {
        let prefix = own.parent().and_then(Path::parent);
        let installed = prefix.map(|prefix| prefix.join("lib").join(ENGINE));
        std::iter::once(own.with_file_name(ENGINE)).chain(installed)
    });
    let mut places =
        named.map_or_else(|| places.collect(), |path| vec![path.to_owned()]).into_iter();
    let found = places.find_map(|path| fs::canonicalize(path).ok().filter(|path| path.is_file()));
    found.ok_or_else(|| {
        CommandError::Other(format!(
            "the simulator's engine for units, `{ENGINE}`, is not there; build it with `cargo build --profile unit \
             -p precess-fmu` in the sources of Precess and name it by `--engine`, or put it beside this program or into `../lib`"
        ))
    })
}

/// Compiles the files of a unit and links them, with the engine where it is given: the library's path in the unit, and its
/// bytes.
pub(super) fn linked(
    files: &[(String, Vec<u8>)],
    name: &str,
    version: FmiVersion,
    folder: &Path,
    engine: Option<&Path>,
) -> Result<(String, Vec<u8>), CommandError> {
    let Some((platform, ending)) = platform(version) else {
        let message = format!(
            "{version} has no name of this platform; leave out `--binary`: the importer compiles the sources"
        );
        return Err(CommandError::Other(message));
    };
    fs::create_dir_all(folder).map_err(failure(folder))?;
    let mut sources = Vec::new();
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(failure(&path))?;
        if path.extension().is_some_and(|ending| ending == "c") {
            sources.push(name);
        }
    }
    let compiler = env::var_os("CC").filter(|text| !text.is_empty());
    let compiler = compiler.unwrap_or_else(|| OsString::from("cc"));
    let library = format!("{name}.{ending}");
    let done = Command::new(&compiler)
        .current_dir(folder)
        .args(compiler_arguments())
        .args(["-o", &library])
        .args(&sources)
        .args(engine)
        .args(if engine.is_some() { &WITH_ENGINE[..] } else { &[] })
        .output();
    let shown = compiler.to_string_lossy();
    let done = done.map_err(|error| {
        CommandError::Other(format!(
            "`{shown}` cannot be started: {error}; name a C compiler in `CC`, or leave out `--binary`: the importer \
             compiles the sources"
        ))
    })?;
    if !done.status.success() {
        let said = String::from_utf8_lossy(&done.stderr);
        let first = said.lines().next().unwrap_or("no message");
        return Err(CommandError::Other(format!(
            "`{shown}` does not compile the unit: {first}; name another C compiler in `CC`, or leave out `--binary`"
        )));
    }
    let path = folder.join(&library);
    let bytes = fs::read(&path).map_err(failure(&path))?;
    Ok((format!("binaries/{platform}/{library}"), bytes))
}
