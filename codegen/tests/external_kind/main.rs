//! Kinds defined by another crate are emitted, proven, compiled against the dynamics crate and run:
//! the one of docs/adding-a-kind.md, and one whose joints all keep their rates. Needs cargo and the
//! linker that every build needs, and no network.

#[expect(unreachable_pub, reason = "the page's lines, which a crate of its own exports")]
mod robot_arm;

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use precess_codegen::kinds::{Kind, KindError, Link};
use precess_codegen::space::Axis;
use precess_codegen::{emit_kind, prove_kind};
use precess_outside::{Outside, Profile};

/// The programs that use the kinds, and their places in a crate.
const PROGRAMS: [(&str, &str); 2] = [
    (include_str!("planar_arm.rs"), "main.rs"),
    (include_str!("kept_rotor.rs"), "bin/kept_rotor/main.rs"),
];

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

#[test]
fn the_page_shows_these_lines() {
    let page = Path::new(ROOT).join("docs/adding-a-kind.md");
    let page = fs::read_to_string(page).expect("the page on adding a kind");
    let block = format!("```rust\n{}```\n", include_str!("robot_arm.rs"));
    assert!(page.contains(&block), "the page and codegen/tests/external_kind/robot_arm.rs differ");
}

#[test]
fn every_claim_about_it_is_proven() {
    let kind: Result<&Kind, KindError> = robot_arm::robot_arm();
    let kind = kind.expect("a kind");
    let mut files = emit_kind(kind, "precess_dynamics").expect("files");
    let rows = prove_kind(kind, &files).expect("rows");
    let failed: Vec<_> = rows.iter().filter(|row| !row.holds()).map(ToString::to_string).collect();
    assert!(rows.len() > 60 && failed.is_empty(), "{} rows, failed: {failed:#?}", rows.len());
    assert!(rows.iter().any(|row| row.tag == "(80)") && rows.iter().any(|row| row.tag == "(101)"));

    // The same text with one sign changed is no proof.
    let wrong = files[0].text.replace("u.u_a - u_rest_a", "u.u_a + u_rest_a");
    assert_ne!(wrong, files[0].text);
    files[0].text = wrong;
    assert!(
        !prove_kind(kind, &files)
            .is_ok_and(|rows| rows.iter().all(precess_codegen::proof::Comparison::holds))
    );
}

/// A rotor on a joint that keeps its rate, and no other joint.
fn kept_rotor() -> &'static Kind {
    let rotor = Link::turning("r", "rotor", Axis::X, "phi").centre_on(Axis::Y, "e").prescribed();
    Kind::builder("kept_rotor", "kept rotor").link(rotor).build().expect("a kind")
}

#[test]
fn every_claim_about_a_kind_without_motors_is_proven() {
    let kind = kept_rotor();
    let files = emit_kind(kind, "precess_dynamics").expect("files");
    let rows = prove_kind(kind, &files).expect("rows");
    let failed: Vec<_> = rows.iter().filter(|row| !row.holds()).map(ToString::to_string).collect();
    assert!(rows.len() > 40 && failed.is_empty(), "{} rows, failed: {failed:#?}", rows.len());
}

/// The programs assert that both hinges of the arm obey the textbook's equations of a planar arm,
/// and the hub of the rotor those of a rigid body with a constant momentum in it.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn they_compile_in_another_crate_and_move_as_the_textbook_says() {
    let outside = Outside {
        name: "planar_arm",
        manifest: "",
        with_nalgebra: true,
        profile: Profile::Development { opt_level: 0 },
    };
    let temporary = env!("CARGO_TARGET_TMPDIR");
    let source = outside.folder(temporary).join("src");
    fs::create_dir_all(&source).expect("a folder for the sources");
    robot_arm::write(&source).expect("the emitted kind");
    for file in emit_kind(kept_rotor(), "precess_dynamics").expect("files") {
        let path = source.join("bin/kept_rotor").join(file.path);
        fs::create_dir_all(path.parent().unwrap_or(&source)).expect("a folder for the kind");
        fs::write(path, file.text).expect("the emitted kind");
    }
    for (program, path) in PROGRAMS {
        fs::write(source.join(path), program).expect("a program");
    }
    let built = outside.build(temporary, &[]);
    for program in ["planar_arm", "kept_rotor"] {
        let path = built.join(program).with_extension(env::consts::EXE_EXTENSION);
        let output = Command::new(path).output().expect("the program starts");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{program} fails: {errors}");
    }
}
