//! The machine code of an evaluation does not grow with the number of devices.
//!
//! A library with `accelerations` for four devices and one for 64 are built with optimisation and
//! linked; the linker drops what they do not call. Needs cargo and the linker that every build
//! needs, and no network.

use std::path::{Path, PathBuf};
use std::{env, fs};

use object::{Object, ObjectSection, SectionKind};
use precess_outside::{Outside, Profile};

/// By how much the code for 64 devices may be larger than that for four. Copies of small arrays are
/// written out and those of large ones are calls, so the two are not equal to the byte; a loop
/// unrolled over the devices would be several times this size.
const MORE: f64 = 1.05;

/// Bytes of machine code in the fixture.
fn code(feature: Option<&str>) -> u64 {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/accelerations_only.rs");
    let manifest = format!(
        "[lib]\npath = '{}'\ncrate-type = [\"cdylib\"]\n[features]\nfew = []\n",
        source.display()
    );
    let outside = Outside {
        name: "accelerations_only",
        manifest: &manifest,
        with_nalgebra: false,
        profile: Profile::Release,
    };
    let features: Vec<_> = feature.iter().flat_map(|feature| ["--features", feature]).collect();
    let built = outside.build(env!("CARGO_TARGET_TMPDIR"), &features);
    let library = fs::read(library(&built)).expect("the linked library");
    let library = object::File::parse(&*library).expect("a linked library");
    let code = library.sections().filter(|section| section.kind() == SectionKind::Text);
    code.map(|section| section.size()).sum()
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
