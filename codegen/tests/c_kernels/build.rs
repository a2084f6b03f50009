//! Compilers, and programs built and run in folders of their own.

use std::collections::BTreeMap;
use std::env;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex, OnceLock};

use precess_codegen::emit::EmittedFile;

/// As flight software compiles: every warning that the page asks for is an error.
pub(crate) const FLAGS: [&str; 8] = [
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-pedantic",
    "-Werror",
    "-ffp-contract=off",
];
/// Set to 1, it makes a skip a failure: for machines on which everything is to be run.
const REQUIRE_ALL: &str = "PRECESS_REQUIRE_ALL";

/// The compilers that this machine has; one that is missing is named, or refused.
pub(crate) fn compilers() -> Vec<&'static str> {
    let there = |name: &&str| {
        let asked = Command::new(name).arg("--version").output();
        let there = asked.is_ok_and(|output| output.status.success());
        if !there {
            let skipped =
                format!("skipped: {name} (install with: apt-get install {name} libc6-dev)");
            assert!(env::var_os(REQUIRE_ALL).is_none_or(|value| value != "1"), "{skipped}");
            eprintln!("{skipped}");
        }
        there
    };
    ["gcc", "clang"].into_iter().filter(there).collect()
}

/// A folder of this suite, made anew.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c_kernels").join(name);
    fs::create_dir_all(&folder).expect("a folder for the build");
    folder
}

/// The program that the emitted files and others make, compiled with `FLAGS` and what comes after them.
pub(crate) fn c(
    folder: &Path,
    compiler: &str,
    files: &[EmittedFile],
    others: &[(&str, &str)],
    more: &[&str],
) -> PathBuf {
    let emitted = files.iter().map(|file| (file.path.as_str(), file.text.as_str()));
    let all: Vec<_> = emitted.chain(others.iter().copied()).collect();
    for (name, text) in &all {
        fs::write(folder.join(name), text).expect("a file to compile");
    }
    let is_source = |name: &str| Path::new(name).extension() == Some("c".as_ref());
    let (sources, headers): (Vec<_>, Vec<_>) = all.iter().partition(|(name, _)| is_source(name));
    let headers: String = headers.into_iter().flat_map(|(name, text)| [name, text]).collect();
    let objects = sources.into_iter().map(|(name, text)| {
        let unit = [compiler, &more.join(" "), &headers, name, text].map(str::to_owned);
        object(folder, unit, more)
    });
    let program = folder.join("program");
    let mut command = Command::new(compiler);
    command.args(more).args(objects).arg("-o").arg(&program);
    finish(compiler, &mut command);
    program
}

/// Compiler, flags, headers, and the name and text of a source.
type Unit = [String; 5];
/// Each unit is compiled once: what most programs share are the emitted sources.
static OBJECTS: Mutex<BTreeMap<Unit, Arc<OnceLock<PathBuf>>>> = Mutex::new(BTreeMap::new());

/// The object file of a unit, compiled in a folder that has it.
fn object(at: &Path, unit: Unit, more: &[&str]) -> PathBuf {
    let [compiler, _, _, name, _] = unit.clone();
    let (cell, number) = {
        let mut objects = OBJECTS.lock().expect("no test fails here");
        // A unit that is there keeps its file.
        let number = objects.len();
        (Arc::clone(objects.entry(unit).or_default()), number)
    };
    let compiled = || {
        let object = at.join(format!("{number}.o"));
        let mut command = Command::new(&compiler);
        command.args(FLAGS).args(more).args(["-c", &name, "-o"]).arg(&object).current_dir(at);
        finish(&compiler, &mut command);
        object
    };
    cell.get_or_init(compiled).clone()
}

fn finish(compiler: &str, command: &mut Command) {
    let output = command.output().expect("the compiler starts");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{compiler} refuses what was emitted: {errors}");
}

/// What a program makes of these numbers, as it writes them.
pub(crate) fn run(program: &Path, numbers: &[f64]) -> Vec<f64> {
    let given = program.with_extension("numbers");
    let bytes: Vec<_> = numbers.iter().flat_map(|number| number.to_ne_bytes()).collect();
    fs::write(&given, bytes).expect("the numbers");
    let mut command = Command::new(program);
    command.stdin(File::open(&given).expect("the numbers")).stderr(Stdio::inherit());
    let output = command.output().expect("the program starts");
    assert!(output.status.success(), "{} fails: {}", program.display(), output.status);
    let (numbers, rest) = output.stdout.as_chunks();
    assert!(rest.is_empty(), "{} wrote part of a number", program.display());
    numbers.iter().map(|bytes| f64::from_ne_bytes(*bytes)).collect()
}
