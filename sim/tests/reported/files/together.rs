//! Two programs that write one name: one of them does, the other says who has it and changes nothing.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;

use super::commands::{Case, cases, error_of, writing};

/// The bytes of each file by its name.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let named = entries.map(|entry| (entry.file_name().into_string().expect("text"), entry.path()));
    named.map(|(name, path)| (name, fs::read(path).expect("a file"))).collect()
}

/// Locks a name as a program does that writes it.
fn locked(folder: &Path, name: &str) -> File {
    let path = folder.join(format!("{name}.partial"));
    fs::write(&path, "in progress").expect("a file");
    let file = File::open(&path).expect("a file");
    file.try_lock().expect("no other program has it");
    file
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_command_refuses_a_name_that_another_program_writes() {
    let bake = |case: &Case| case.name == "bake";
    let cases: Vec<_> = writing("locked")
        .into_iter()
        .chain(cases("locked-kernels").into_iter().filter(bake))
        .collect();
    for case in cases {
        let out = case.empty_out().to_owned();
        let mut written = vec!["kernels".to_owned()];
        if case.name != "bake" {
            let first = case.output();
            assert!(first.status.success(), "{}: {}", case.name, error_of(&first));
            written = contents(&out).into_keys().collect();
        }
        let ends = [written.first(), written.last()];
        for name in ends.into_iter().flatten() {
            case.empty_out();
            let file = locked(&out, name);
            let before = contents(&out);
            let ended = case.output();
            let error = error_of(&ended);
            assert_eq!(ended.status.code(), Some(1), "{}: {name}: {error}", case.name);
            assert!(error.contains("in use by"), "{}: {error}", case.name);
            if cfg!(target_os = "linux") {
                let process = format!("process {}", std::process::id());
                assert!(error.contains(&process), "{}: {error}", case.name);
            }
            assert_eq!(contents(&out), before, "{}: {name}", case.name);
            // A program that is gone has no lock: what it left is overwritten.
            drop(file);
            if case.name != "bake" {
                let again = case.output();
                assert!(again.status.success(), "{}: {}", case.name, error_of(&again));
                assert!(
                    !contents(&out).keys().any(|name| name.ends_with(".partial")),
                    "{}",
                    case.name
                );
            }
        }
    }
}

/// Two scenarios of one name, started at the same instant into one folder.
fn raced(case: &Case, differ: [&str; 2]) {
    let alone: Vec<_> = differ
        .iter()
        .map(|set| {
            let out = case.empty_out();
            let ended = case.command().args(["--set", set]).output().expect("it starts");
            assert!(ended.status.success(), "{}", error_of(&ended));
            let mut files = contents(out);
            files.retain(|name, _| !name.ends_with(".journal"));
            files
        })
        .collect();
    assert!(alone[0] != alone[1], "the runs differ");
    for round in 0..5 {
        let out = case.empty_out();
        let children = differ.map(|set| {
            let mut command = case.command();
            command.args(["--set", set]).stderr(std::process::Stdio::piped());
            command.stdout(std::process::Stdio::null()).spawn().expect("it starts")
        });
        let ended = children.map(|child| child.wait_with_output().expect("it ends"));
        let codes = [0, 1].map(|which| ended[which].status.code());
        let winner = codes.iter().position(|code| *code == Some(0)).unwrap_or_else(|| {
            panic!("round {round}: neither: {}{}", error_of(&ended[0]), error_of(&ended[1]))
        });
        assert_eq!(codes[1 - winner], Some(1), "round {round}");
        let error = error_of(&ended[1 - winner]);
        let reason = ["in use by", "exists", "is no journal of this scenario"];
        assert!(reason.iter().any(|reason| error.contains(reason)), "round {round}: {error}");
        let mut files = contents(out);
        files.retain(|name, _| !name.ends_with(".journal"));
        let names: Vec<_> = files.keys().collect();
        assert!(files == alone[winner], "round {round}: {names:?} are not of the run that said so");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn of_two_runs_into_one_folder_one_has_its_results() {
    let runs = writing("raced").into_iter().filter(|case| case.name == "run");
    for mut case in runs {
        case.arguments.extend(["--set", "run.duration=1 s"].map(str::to_owned));
        raced(&case, ["hub.mass=95 kg", "hub.mass=97 kg"]);
    }
}

#[test]
fn of_two_campaigns_at_the_same_instant_one_has_its_results() {
    let campaigns = writing("raced-campaigns").into_iter();
    for case in campaigns.filter(|case| ["sweep", "montecarlo"].contains(&case.name.as_str())) {
        raced(&case, ["hub.inertia=20, 20, 20 kg m^2", "hub.inertia=21, 21, 21 kg m^2"]);
    }
}
