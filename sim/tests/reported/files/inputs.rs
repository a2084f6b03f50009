//! No output replaces an input of the same command, and what a command that failed leaves is removed or named.

use std::fs;
use std::path::Path;

use super::commands::{cases, error_of, writing};
use crate::precess;

/// The names in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("text"))
        .collect();
    names.sort();
    names
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
#[cfg(unix)]
fn no_command_replaces_a_file_that_it_reads() {
    for mut case in writing("inputs") {
        case.empty_out();
        let first = case.output();
        assert!(first.status.success(), "{}: {}", case.name, error_of(&first));
        let out = case.out.clone().expect("a folder");
        let written = names(&out);
        let written: Vec<_> = written.iter().filter(|name| !name.ends_with(".journal")).collect();
        let name = *written.first().expect("a file");
        case.arguments.push("--force".to_owned());
        for (number, input) in case.inputs.clone().into_iter().enumerate() {
            let before = fs::read(&input).expect("a file");
            // A link of either kind is where the output would be, and where it is written until it is complete; one of
            // them for the other inputs.
            let places =
                [(name.clone(), true), (name.clone(), false), (format!("{name}.partial"), true)];
            for (target, is_hard) in places.into_iter().take(if number == 0 { 3 } else { 1 }) {
                let link = case.empty_out().join(target);
                let linked = if is_hard {
                    fs::hard_link(&input, &link)
                } else {
                    std::os::unix::fs::symlink(&input, &link)
                };
                linked.expect("a link");
                let ended = case.output();
                let error = error_of(&ended);
                assert_eq!(
                    ended.status.code(),
                    Some(1),
                    "{}: {}: {error}",
                    case.name,
                    input.display()
                );
                assert!(error.contains("is read by this command"), "{}: {error}", case.name);
                assert_eq!(fs::read(&input).expect("a file"), before, "{}", case.name);
                assert_eq!(names(&out).len(), 1, "{}: {:?}", case.name, names(&out));
            }
        }
    }
}

#[test]
fn a_scenario_is_not_replaced_under_any_spelling_of_its_name() {
    let folder = cases("spelling").remove(0).folder;
    let text = fs::read_to_string(folder.join("wheel.toml")).expect("a file");
    let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    // A scenario whose name is that of a result, and a folder that is spelt in another way.
    fs::write(path("wheel.csv"), &text).expect("a file");
    fs::create_dir_all(path("sub")).expect("a folder");
    let other = path("sub/../.");
    for arguments in [
        vec!["run", &path("wheel.csv"), "--out", &other, "--force"],
        vec!["export", "table", &path("wheel.csv"), "--to", &path("sub/../wheel.csv"), "--force"],
        vec!["export", "table", &path("wheel.toml"), "--to", &path("hub.toml"), "--force"],
        vec!["bake", &path("wheel.toml"), "--set", "title=a", "--out", &other, "--force"],
    ] {
        let ended = precess(&arguments);
        assert_eq!(ended.code, Some(1), "{arguments:?}: {}", ended.error);
        assert!(ended.error.contains("is read by this command"), "{}", ended.error);
        assert_eq!(fs::read_to_string(path("wheel.csv")).expect("a file"), text);
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
#[cfg(unix)]
fn what_a_command_that_failed_leaves_is_removed_or_named() {
    for case in writing("limit") {
        let out = case.empty_out().to_owned();
        fs::remove_dir(&out).expect("an empty folder");
        if case.arguments.iter().any(|argument| argument.starts_with("out/")) {
            fs::create_dir(&out).expect("a folder");
        }
        // No file may be longer than one block of 512 or 1024 bytes: as on a disk that is full.
        let mut command = std::process::Command::new("sh");
        let limited = "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"";
        command.current_dir(&case.folder).args(["-c", limited, env!("CARGO_BIN_EXE_precess")]);
        let ended =
            command.args(case.name.split(' ')).args(&case.arguments).output().expect("it starts");
        let error = error_of(&ended);
        assert_eq!(ended.status.code(), Some(1), "{}: {error}", case.name);
        let left = if out.exists() { names(&out) } else { Vec::new() };
        for name in &left {
            assert!(error.contains(name.as_str()), "{}: {name} is left: {error}", case.name);
            assert!(fs::metadata(out.join(name)).expect("a file").len() > 0, "{name}");
        }
    }
}
