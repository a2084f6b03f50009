//! The machine code of an evaluation does not grow with the number of devices.
//!
//! A library with `accelerations` for four devices and one for 64 are built with optimisation and
//! linked; the linker drops what they do not call. Needs cargo and the linker that every build
//! needs, and no network.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use object::{Object, ObjectSection, SectionKind};

/// By how much the code for 64 devices may be larger than that for four. Copies of small arrays are
/// written out and those of large ones are calls, so the two are not equal to the byte; a loop
/// unrolled over the devices would be several times this size.
const MORE: f64 = 1.05;

/// Bytes of machine code in the fixture.
fn code(feature: Option<&str>) -> u64 {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = tests.join("..");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("code_size");
    fs::create_dir_all(&folder).expect("a folder for the build");
    fs::write(folder.join("Cargo.toml"), manifest(tests)).expect("a manifest");
    // The versions that the workspace has: cargo drops what the fixture does not need.
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's versions");

    let target = folder.join("target");
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut cargo = Command::new(program);
    cargo.args(["build", "--release", "--offline", "--quiet", "--message-format", "short"]);
    cargo.arg("--manifest-path").arg(folder.join("Cargo.toml"));
    cargo.arg("--target-dir").arg(&target).current_dir(&root);
    cargo.args(feature.iter().flat_map(|feature| ["--features", feature]));
    // Flags of the outer build (coverage, sanitizers) bring code of their own.
    for flags in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET"] {
        cargo.env_remove(flags);
    }
    let output = cargo.output().expect("cargo starts");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "the fixture does not build: {errors}");

    let library = fs::read(library(&target.join("release"))).expect("the linked library");
    let library = object::File::parse(&*library).expect("a linked library");
    let code = library.sections().filter(|section| section.kind() == SectionKind::Text);
    code.map(|section| section.size()).sum()
}

/// The fixture's manifest: what is general is compiled with the dynamics crate.
fn manifest(tests: &Path) -> String {
    let source = tests.join("fixtures/accelerations_only.rs");
    let dynamics = tests.join("../dynamics");
    format!(
        "[package]\nname = \"accelerations-only\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\
         [workspace]\n\
         [lib]\npath = '{}'\ncrate-type = [\"cdylib\"]\n\
         [features]\nfew = []\n\
         [dependencies]\nprecess-dynamics = {{ path = '{}' }}\n\
         [profile.release]\npanic = \"abort\"\ncodegen-units = 1\n",
        source.display(),
        dynamics.display()
    )
}

/// The one dynamic library there, under the platform's name.
fn library(folder: &Path) -> PathBuf {
    folder.join(format!("{}accelerations_only{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX))
}

#[test]
#[expect(clippy::cast_precision_loss, reason = "some ten thousand bytes")]
fn code_for_64_devices_is_no_larger_than_for_four() {
    let (few, many) = (code(Some("few")), code(None));
    println!("{few} bytes of code for 4 devices, {many} for 64");
    assert!(few > 1000, "{few} bytes: the linker has dropped what was to be measured");
    assert!(many as f64 <= MORE * few as f64, "{many} bytes for 64 devices, {few} for 4");
}
