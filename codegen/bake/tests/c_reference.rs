//! The emitted C, compiled at the warnings of the page as errors: its own tests pass, and
//! a value that is changed is seen.

use std::fs;
use std::path::Path;
use std::process::Command;

use precess_bake::{Description, Language, Options, bake};
use precess_codegen::emit::EmittedFile;

#[allow(dead_code, reason = "shared with the suite of the kernels")]
#[path = "../../tests/c_kernels/build.rs"]
mod build;

fn description(name: &str) -> Description {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/baked");
    let text = fs::read_to_string(root.join(name).join("description.toml")).unwrap();
    Description::read(&text).unwrap()
}

/// The emitted files, without the page.
fn files(name: &str, constants: bool) -> Vec<EmittedFile> {
    let options = Options { language: Language::C, constants };
    let baked = bake(&description(name), options).unwrap();
    baked.files.into_iter().filter(|file| file.path != "README.md").collect()
}

/// Whether the test program passes, and what it prints.
fn run(name: &str, compiler: &str, files: &[EmittedFile]) -> (bool, String) {
    let folder = build::folder(&format!("baked_{name}_{compiler}"));
    let program = build::c(&folder, compiler, files, &[], &[]);
    let output = Command::new(program).output().expect("the program runs");
    (output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned())
}

/// With the digit before the last one of the first number after `place` in a file changed.
fn spoiled(files: &[EmittedFile], path: &str, place: &str) -> Vec<EmittedFile> {
    let mut files = files.to_vec();
    let file = files.iter_mut().find(|file| file.path == path).unwrap();
    let start = file.text.find(place).unwrap() + place.len();
    let end = start + file.text[start..].find(',').unwrap() - 2;
    let other = if file.text.as_bytes()[end] == b'5' { "6" } else { "5" };
    file.text.replace_range(end..=end, other);
    files
}

const MISSIONS: [&str; 4] = ["four_wheels", "imaging_satellite", "table1", "parked_spare"];

#[test]
fn the_test_program_of_each_spacecraft_passes() {
    let compilers = build::compilers();
    for name in MISSIONS {
        let files = files(name, false);
        for compiler in &compilers {
            let passed = (true, "all as expected\n".to_owned());
            assert_eq!(run(name, compiler, &files), passed, "{name}, {compiler}");
        }
        // A program that cannot fail shows nothing: a digit of one value is changed.
        let Some(compiler) = compilers.first() else { continue };
        let mut spoiled = files.clone();
        let test = spoiled.iter_mut().find(|file| file.path == "test_reference.c").unwrap();
        let place = test.text.find("static const double LINEAR[] = {").unwrap();
        let digit = place + test.text[place..].find('.').unwrap() + 3;
        let other = if test.text.as_bytes()[digit] == b'5' { "6" } else { "5" };
        test.text.replace_range(digit..=digit, other);
        assert!(!run(&format!("{name}_spoiled"), compiler, &spoiled).0, "{name}: nothing seen");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn folded_values_are_those_of_the_constructor_to_the_bit() {
    let compilers = build::compilers();
    for name in MISSIONS {
        let files = files(name, true);
        let header = files.iter().find(|file| file.path == format!("{name}.h")).unwrap();
        assert!(!header.text.contains("_init") && !header.text.contains("_parameters"), "{name}");
        for compiler in &compilers {
            let passed = (true, "all as expected\n".to_owned());
            let folded = format!("{name}_folded");
            assert_eq!(run(&folded, compiler, &files), passed, "{name}, {compiler}");
        }
        // A digit of one constant is changed, by less than what accelerations show.
        let Some(compiler) = compilers.first() else { continue };
        let source = format!("{name}.c");
        let spoiled = spoiled(&files, &source, ".mass_ww = ");
        let (passed, printed) = run(&format!("{name}_folded_spoiled"), compiler, &spoiled);
        assert!(!passed && printed.contains("not those of the values"), "{name}: {printed}");
    }
}
