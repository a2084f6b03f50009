//! The spacecraft that the tests know: what is committed is what is derived, and what is claimed of
//! it holds.

use std::fs;
use std::path::{Path, PathBuf};

use precess_bake::{Baked, Description, Language, Options, bake};
use precess_description::{Axis, Turn};

/// Name, and the most that its operations may be of the general kernels', in percent.
const MISSIONS: [(&str, usize); 5] = [
    // Goal S2: at most half, by locked gimbals, axes that meet in a point and mounts of two turns.
    ("imaging_satellite", 50),
    ("imaging_satellite_constants", 50),
    ("four_wheels", 64),
    // One device with full inertias: only its offsets are zero.
    ("table1", 79),
    // Two devices of four are locked.
    ("parked_spare", 40),
];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/baked").join(name)
}

fn description(name: &str) -> Description {
    let text = fs::read_to_string(folder(name).join("description.toml")).unwrap();
    Description::read(&text).unwrap()
}

/// As Rust; values are folded where the name says so.
fn options(description: &Description) -> Options {
    let constants = description.name.ends_with("_constants");
    Options { language: Language::Rust, constants }
}

fn baked(description: &Description) -> Baked {
    bake(description, options(description)).unwrap()
}

fn refusal(description: &Description) -> String {
    bake(description, options(description)).err().unwrap().to_string()
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_committed_files_are_what_is_derived() {
    let committed = MISSIONS.map(|(name, _)| name).into_iter();
    let committed: Vec<_> =
        committed.filter(|name| folder(name).join("Cargo.toml").is_file()).collect();
    assert_eq!(committed, ["imaging_satellite", "four_wheels"]);
    for name in committed {
        for file in baked(&description(name)).files {
            let found = fs::read_to_string(folder(name).join(&file.path)).unwrap_or_default();
            assert!(found == file.text, "{name}/{} is stale; run `cargo xtask bake`", file.path);
        }
    }
}

#[test]
fn every_claim_is_proven_and_operations_are_few() {
    for (name, percent) in MISSIONS {
        let baked = baked(&description(name));
        assert!(
            baked.proof.len() > 25
                && baked.proof.iter().all(precess_codegen::proof::Comparison::holds)
        );
        let of_general = baked.proof.iter().filter(|row| row.claim.contains("substituted"));
        assert!(of_general.count() >= 8, "{name} is not held against the general kind");
        let operations = baked.operations;
        let most = operations.general * percent / 100;
        assert!(operations.baked <= most, "{name}: {operations:?}, more than {percent} %");
    }
}

#[test]
fn what_is_kept_stays_a_parameter() {
    let mut description = description("four_wheels");
    for device in &mut description.device {
        device.keep = vec!["j_23".to_owned(), "mount".to_owned(), "j_33".to_owned()];
    }
    let kept = baked(&description);
    assert!(kept.assumptions.iter().all(|line| !line.contains("j_23") && !line.contains("mount")));
    // Nothing tells the wheels apart any more but where their origins are zero.
    let parameters = kept.files.iter().filter(|file| file.text.contains("pub j_23: T"));
    assert!(parameters.count() >= 1);
    description.device[0].keep = vec!["j_99".to_owned()];
    let error = refusal(&description);
    assert!(error.contains("j_99"), "{error}");
}

#[test]
fn a_device_that_breaks_its_kind_is_refused() {
    let refused = |change: fn(&mut Description), named: &str| {
        let mut description = description("four_wheels");
        change(&mut description);
        let error = refusal(&description);
        assert!(error.contains("wheel_x") && error.contains(named), "{error}");
    };
    refused(|d| d.device[0].kind = "gyro".to_owned(), "dgvscmg");
    refused(|d| d.device[0].body[0].centre_of_mass[0] = 1e-3, "component 1");
    refused(|d| d.device[0].body = vec![d.device[0].body[0].clone(); 2], "2 bodies");
}

#[test]
fn a_mount_of_stated_turns_is_not_found_in_numbers() {
    let turns = |list: &[(Axis, Option<u8>)]| {
        let turn =
            |(about, quarters): &(Axis, Option<u8>)| Turn { about: *about, quarters: *quarters };
        Some(list.iter().map(turn).collect::<Vec<_>>())
    };
    let line = |description: &Description| {
        let lines = baked(description).assumptions;
        lines.into_iter().find(|line| line.starts_with("spare: the mount")).unwrap()
    };
    let mut mission = description("parked_spare");
    assert!(line(&mission).ends_with(
        "one turn about a coordinate axis, between quarter turns, found in its numbers"
    ));
    // Two turns, of which one happens to be none: what is stated counts.
    mission.device[1].turns = turns(&[(Axis::Y, None), (Axis::Z, None)]);
    let stated = line(&mission);
    assert!(
        stated.contains("two turns") && stated.ends_with("as its turns are stated"),
        "{stated}"
    );
    // Numbers that do not have the turns stated of them.
    mission.device[1].turns = turns(&[(Axis::Z, None), (Axis::X, Some(1))]);
    let error = refusal(&mission);
    assert!(error.contains("spare: mount") && error.contains("`turns`"), "{error}");
}

#[test]
fn a_device_that_stands_is_part_of_the_hub() {
    let baked = baked(&description("parked_spare"));
    for name in ["spare", "panel"] {
        let of_hub = format!("{name}: no joint moves, so it is part of the hub");
        assert!(baked.assumptions.contains(&of_hub), "{:?}", baked.assumptions);
        let path = format!("src/kernels/{name}.rs");
        let kernels = baked.files.iter().find(|file| file.path == path).unwrap();
        assert!(kernels.text.contains("pub fn constant_share"));
        assert!(!kernels.text.contains("pub fn eliminate") && !kernels.text.contains("Joint"));
    }
    // What is locked costs nothing: the wheels by themselves take as much.
    let mut wheels = description("parked_spare");
    wheels.device.retain(|device| device.kind == "reaction_wheel");
    assert_eq!(self::baked(&wheels).operations.baked, baked.operations.baked);
    wheels.device.iter_mut().for_each(|device| device.body[0].locked_at = Some(0.3));
    let error = refusal(&wheels);
    assert!(error.contains("--unlock"), "{error}");
}

#[test]
fn folded_values_leave_no_constructor_and_the_same_kernels() {
    let (values, folded) = (description("imaging_satellite"), "imaging_satellite_constants");
    let [values, folded] = [values, description(folded)].map(|description| baked(&description));
    assert_eq!(values.operations, folded.operations);
    let text = |of: &Baked, path: &str| {
        of.files.iter().find(|file| file.path == path).map(|file| file.text.clone()).unwrap()
    };
    let kernels = "src/kernels/cmg.rs";
    let function = |text: &str| text[text.find("pub fn eliminate").unwrap()..].to_owned();
    assert_eq!(function(&text(&values, kernels)), function(&text(&folded, kernels)));
    // Every public item that makes constants is for the tests.
    for (path, item) in [
        ("src/lib.rs", "pub struct Parameters"),
        ("src/lib.rs", "pub fn new"),
        ("src/cmg.rs", "pub struct Device"),
        (kernels, "pub struct Parameters"),
        (kernels, "pub fn prepare"),
        (kernels, "pub fn constant_share"),
    ] {
        let text = text(&folded, path);
        let own = text[..text.find(item).unwrap()].rsplit("\n\n").next().unwrap();
        assert!(own.contains("#[cfg(test)]"), "{path}: {item} is there without the tests");
    }
}

#[test]
fn a_value_that_overflows_is_refused_where_it_is_folded() {
    let mut description = description("imaging_satellite_constants");
    description.device[1].body[0].origin[2] = 1e200;
    let error = refusal(&description);
    assert!(error.contains("cmg2") && error.contains("inf"), "{error}");
}

#[test]
fn names_of_devices_are_names_of_modules() {
    let mut description = description("four_wheels");
    for (device, name) in description.device.iter_mut().zip(["solve", "fn1", "omega", "x_1"]) {
        name.clone_into(&mut device.name);
    }
    let baked = baked(&description);
    // A second field of the state would be called as the first.
    let modules = ["src/solve.rs", "src/fn1.rs", "src/omega_1.rs", "src/x.rs"];
    for module in modules {
        assert!(baked.files.iter().any(|file| file.path == module), "{module} is missing");
    }
    for file in &baked.files {
        let path = Path::new(&file.path);
        if path.extension().is_some_and(|end| end == "rs") {
            syn::parse_file(&file.text).unwrap_or_else(|error| panic!("{}: {error}", file.path));
        }
    }
    let mut paths: Vec<_> = baked.files.iter().map(|file| file.path.clone()).collect();
    let count = paths.len();
    paths.sort();
    paths.dedup();
    assert_eq!(paths.len(), count, "two files of one path: {paths:?}");
}
