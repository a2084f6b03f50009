//! No input makes the solver panic: its linked machine code contains no call that panics.
//!
//! A small `no_std` library that calls every public function (`fixtures/every_entry_point.rs`) is
//! built with optimisation and linked. Its panic handler contains a mark, and the linker drops
//! what nothing calls: the mark is in the file exactly if a panic can be reached. Needs cargo and
//! the linker that every build needs, and no network.

use std::path::{Path, PathBuf};
use std::{env, fs};

use precess_outside::{Outside, Profile};

/// The mark in the fixture's panic handler.
const MARK: &[u8] = b"a panic can be reached";

/// Builds a fixture and says whether the mark is in it.
fn panic_can_be_reached(fixture: &str) -> bool {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(fixture);
    let path = source.with_extension("rs");
    let manifest = format!("[lib]\npath = '{}'\ncrate-type = [\"cdylib\"]\n", path.display());
    let outside = Outside {
        name: fixture,
        manifest: &manifest,
        with_nalgebra: false,
        profile: Profile::Release,
    };
    let library = library(&outside.build(env!("CARGO_TARGET_TMPDIR"), &[]), fixture);
    let code = fs::read(&library).expect("the linked library");
    code.windows(MARK.len()).any(|window| window == MARK)
}

/// The one dynamic library there, under the platform's name.
fn library(folder: &Path, fixture: &str) -> PathBuf {
    let (before, after) = (env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    folder.join(format!("{before}{fixture}{after}"))
}

#[test]
fn no_public_function_can_reach_a_panic() {
    let (control, reached) =
        (panic_can_be_reached("one_panic"), panic_can_be_reached("every_entry_point"));
    assert!(control, "the control's panic is not seen");
    assert!(!reached, "a public function of the solver can reach a panic");
}
