//! The spacecraft that the tests know: what is committed is what is derived, and what is claimed of
//! it holds.

use std::fs;
use std::path::{Path, PathBuf};

use precess_bake::{Baked, Description, Language, bake};

/// Name, and the most that its operations may be of the general kernels', in percent.
const MISSIONS: [(&str, usize); 3] = [
    // Goal S2: at most half, by locked gimbals, axes that meet in a point and mounts of two turns.
    ("imaging_satellite", 50),
    ("four_wheels", 60),
    // One device with full inertias: only its offsets are zero.
    ("table1", 76),
];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/baked").join(name)
}

fn description(name: &str) -> Description {
    let text = fs::read_to_string(folder(name).join("description.toml")).unwrap();
    Description::read(&text).unwrap()
}

fn baked(description: &Description, language: Language) -> Baked {
    bake(description, language).unwrap()
}

#[test]
fn the_committed_files_are_what_is_derived() {
    for (name, _) in MISSIONS {
        for file in baked(&description(name), Language::Rust).files {
            let found = fs::read_to_string(folder(name).join(&file.path)).unwrap_or_default();
            assert!(found == file.text, "{name}/{} is stale; run `cargo xtask bake`", file.path);
        }
    }
}

#[test]
fn every_claim_is_proven_and_operations_are_few() {
    for (name, percent) in MISSIONS {
        let baked = baked(&description(name), Language::Rust);
        assert!(
            baked.proof.len() > 25 && baked.proof.iter().all(precess_codegen::proof::Row::holds)
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
    let kept = baked(&description, Language::Rust);
    assert!(kept.assumptions.iter().all(|line| !line.contains("j_23") && !line.contains("mount")));
    // Nothing tells the wheels apart any more but where their origins are zero.
    let parameters = kept.files.iter().filter(|file| file.text.contains("pub j_23: T"));
    assert!(parameters.count() >= 1);
    description.device[0].keep = vec!["j_99".to_owned()];
    let error = bake(&description, Language::Rust).err().unwrap().to_string();
    assert!(error.contains("j_99"), "{error}");
}

#[test]
fn a_device_that_breaks_its_kind_is_refused() {
    let refused = |change: fn(&mut Description), named: &str| {
        let mut description = description("four_wheels");
        change(&mut description);
        let error = bake(&description, Language::Rust).err().unwrap().to_string();
        assert!(error.contains("wheel_x") && error.contains(named), "{error}");
    };
    refused(|d| d.device[0].kind = "gyro".to_owned(), "dgvscmg");
    refused(|d| d.device[0].body[0].centre_of_mass[0] = 1e-3, "component 1");
    refused(|d| d.device[0].body = vec![d.device[0].body[0].clone(); 2], "2 bodies");
}

#[test]
fn names_of_devices_are_names_of_modules() {
    let mut description = description("four_wheels");
    for (device, name) in description.device.iter_mut().zip(["solve", "fn1", "omega", "x_1"]) {
        name.clone_into(&mut device.name);
    }
    let baked = baked(&description, Language::Rust);
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
