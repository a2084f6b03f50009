//! What commands print: an error of standard output is an exit code, and no control character of a file gets out.

use std::fs::File;
use std::process::Stdio;

use super::commands::{Case, cases, error_of, names};
use crate::precess;

/// The cases that this process can execute to their end: `bake` prints the description instead of calling a program.
fn printing(folder: &str) -> Vec<Case> {
    let mut cases = cases(folder);
    for case in cases.iter_mut().filter(|case| case.name == "bake") {
        case.arguments.push("--description".to_owned());
    }
    cases
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn no_control_character_of_a_file_is_printed() {
    let is_raw = |text: &str| {
        text.chars().any(|letter| letter.is_control() && !matches!(letter, '\n' | '\t'))
    };
    for case in printing("control") {
        if case.out.is_some() {
            case.empty_out();
        }
        let output = case.output();
        let out = String::from_utf8(output.stdout.clone()).expect("text");
        assert!(output.status.success(), "{}: {}", case.name, error_of(&output));
        assert!(!is_raw(&out) && !is_raw(&error_of(&output)), "{}: {out:?}", case.name);
        assert!(!out.is_empty(), "{} prints", case.name);
    }
    // Nor one of a value that is wrong.
    let file = crate::folder("control-error").join("a.toml");
    std::fs::write(&file, "format = 1\ntitle = 3\n[hub]\nmass = \"\\u001b[2J kg\"\n")
        .expect("a file");
    for command in ["check", "run", "evaluate", "export table"] {
        let arguments: Vec<_> = command.split(' ').chain([file.to_str().expect("text")]).collect();
        let ended = precess(&arguments);
        assert_eq!(ended.code, Some(1), "{}", ended.error);
        assert!(!is_raw(&ended.error) && !is_raw(&ended.out), "{:?}", ended.error);
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
#[cfg(target_os = "linux")]
fn every_command_says_that_standard_output_is_full() {
    let full = || Stdio::from(File::options().write(true).open("/dev/full").expect("a device"));
    for case in printing("full") {
        if case.out.is_some() {
            case.empty_out();
        }
        let output = case.command().stdout(full()).output().expect("it starts");
        let error = error_of(&output);
        assert_eq!(output.status.code(), Some(1), "{}: {error}", case.name);
        assert!(error.contains("standard output"), "{}: {error}", case.name);
    }
    for name in names() {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_precess"));
        let command = command.args(name.split(' ')).arg("--help").stdout(full());
        assert_eq!(command.output().expect("it starts").status.code(), Some(1), "{name} --help");
    }
    // Where standard error is full, too, nothing can be said, and nothing panics.
    for case in printing("both-full") {
        if case.out.is_some() {
            case.empty_out();
        }
        let status = case.command().stdout(full()).stderr(full()).status().expect("it starts");
        assert_eq!(status.code(), Some(1), "{}", case.name);
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
#[cfg(unix)]
fn a_closed_pipe_ends_every_command_quietly() {
    for case in printing("pipe") {
        if case.out.is_some() {
            case.empty_out();
        }
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = case.command().stdout(writer).output().expect("it starts");
        let error = error_of(&output);
        assert_eq!(output.status.code(), Some(0), "{}: {error}", case.name);
        assert!(!error.contains("pipe") && !error.contains("panicked"), "{}: {error}", case.name);
    }
}
