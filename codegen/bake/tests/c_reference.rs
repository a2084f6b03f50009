//! The emitted C, compiled at the warnings of the page as errors: its own tests pass, and
//! a value that is changed is seen.

use std::fs;
use std::path::Path;
use std::process::Command;

use precess_bake::{Description, Language, bake};

#[allow(dead_code, reason = "shared with the suite of the kernels")]
#[path = "../../tests/c_kernels/build.rs"]
mod build;

#[test]
fn the_test_program_of_each_spacecraft_passes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/baked");
    let compilers = build::compilers();
    for name in ["four_wheels", "imaging_satellite", "table1"] {
        let text = fs::read_to_string(root.join(name).join("description.toml")).unwrap();
        let description = Description::read(&text).unwrap();
        let baked = bake(&description, Language::C).unwrap();
        let files: Vec<_> = baked.files.into_iter().filter(|f| f.path != "README.md").collect();
        for compiler in &compilers {
            let folder = build::folder(&format!("baked_{name}_{compiler}"));
            let program = build::c(&folder, compiler, &files, &[], &[]);
            let output = Command::new(program).output().expect("the program runs");
            let printed = String::from_utf8_lossy(&output.stdout);
            assert!(output.status.success(), "{name}, {compiler}: {printed}");
            assert_eq!(printed, "all as expected\n", "{name}, {compiler}");
        }
        // A program that cannot fail shows nothing: one digit of one value is changed.
        let Some(compiler) = compilers.first() else { continue };
        let mut spoiled = files.clone();
        let test = spoiled.iter_mut().find(|file| file.path == "test_reference.c").unwrap();
        let place = test.text.find("static const double LINEAR[] = {").unwrap();
        let digit = place + test.text[place..].find('.').unwrap() + 3;
        let other = if test.text.as_bytes()[digit] == b'5' { "6" } else { "5" };
        test.text.replace_range(digit..=digit, other);
        let folder = build::folder(&format!("baked_{name}_spoiled"));
        let program = build::c(&folder, compiler, &spoiled, &[], &[]);
        assert!(!Command::new(program).output().unwrap().status.success(), "{name}: nothing seen");
    }
}
