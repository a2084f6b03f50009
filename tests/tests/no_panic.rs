//! No input makes the solver panic: its linked machine code contains no call that panics.
//!
//! A small `no_std` library that calls every public function (`fixtures/every_entry_point.rs`) is
//! built with optimisation and linked. Its panic handler contains a mark, and the linker drops
//! what nothing calls: the mark is in the file exactly if a panic can be reached. Needs cargo and
//! the linker that every build needs, and no network.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, thread};

/// The mark in the fixture's panic handler.
const MARK: &[u8] = b"a panic can be reached";

/// Builds a fixture and says whether the mark is in it.
fn panic_can_be_reached(fixture: &str) -> bool {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = tests.join("..");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_panic").join(fixture);
    fs::create_dir_all(&folder).expect("a folder for the build");
    fs::write(folder.join("Cargo.toml"), manifest(tests, fixture)).expect("a manifest");
    // The versions that the workspace has: cargo drops what the fixture does not need.
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's versions");

    let target = folder.join("target");
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut cargo = Command::new(program);
    cargo.args(["build", "--release", "--offline", "--quiet", "--message-format", "short"]);
    cargo.arg("--manifest-path").arg(folder.join("Cargo.toml"));
    cargo.arg("--target-dir").arg(&target).current_dir(&root);
    // Flags of the outer build (coverage, sanitizers) bring panics of their own.
    for flags in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET"] {
        cargo.env_remove(flags);
    }
    let output = cargo.output().expect("cargo starts");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "the fixture does not build: {errors}");

    let library = library(&target.join("release"), fixture);
    let code = fs::read(&library).expect("the linked library");
    code.windows(MARK.len()).any(|window| window == MARK)
}

/// The fixture's manifest. What the dynamics crate is made of matters, the rest of its dependencies
/// is generic and compiled with it: left without optimisation, they build in half the time.
fn manifest(tests: &Path, fixture: &str) -> String {
    let source = tests.join("fixtures").join(fixture).with_extension("rs");
    let dynamics = tests.join("../dynamics");
    format!(
        "[package]\nname = \"{fixture}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\
         [workspace]\n\
         [lib]\npath = '{}'\ncrate-type = [\"cdylib\"]\n\
         [dependencies]\nprecess-dynamics = {{ path = '{}' }}\n\
         [profile.release]\npanic = \"abort\"\ncodegen-units = 4\n\
         [profile.release.package.\"*\"]\nopt-level = 0\n\
         [profile.release.package]\nlibm.opt-level = 3\nprecess-dynamics.opt-level = 3\n",
        source.display(),
        dynamics.display()
    )
}

/// The one dynamic library there, under the platform's name.
fn library(folder: &Path, fixture: &str) -> PathBuf {
    let (before, after) = (env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    folder.join(format!("{before}{fixture}{after}"))
}

#[test]
fn no_public_function_can_reach_a_panic() {
    // Side by side, each in a folder of its own: a build is one thread for most of its time.
    let (control, reached) = thread::scope(|scope| {
        let control = scope.spawn(|| panic_can_be_reached("one_panic"));
        let reached = panic_can_be_reached("every_entry_point");
        (control.join(), reached)
    });
    assert!(control.expect("the control builds"), "the control's panic is not seen");
    assert!(!reached, "a public function of the solver can reach a panic");
}
