//! Crates of spacecraft that are emitted by this suite and not committed: built by cargo in a workspace of their
//! own, where their own tests pass, with a program that evaluates them.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::{env, fs, thread};

use precess_bake::{Language, Options, bake};
use precess_description::{Body, Description, Hub};

use crate::description;
use crate::general::{Drawn, Found};

/// The spacecraft; values of the last are folded.
const NAMES: [&str; 3] = ["table1", "parked_spare", "imaging_satellite_constants"];

/// The folder of the workspace, which is written, tested and built once.
fn workspace() -> &'static Path {
    static WORKSPACE: OnceLock<PathBuf> = OnceLock::new();
    WORKSPACE.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emitted");
        let (mut dependencies, mut parameters) = (String::new(), String::new());
        for name in NAMES {
            let description = description(name);
            let constants = name.ends_with("_constants");
            let options = Options { language: Language::Rust, constants };
            for file in bake(&description, options).expect("kernels").files {
                write(&folder.join(name).join(file.path), &file.text);
            }
            let crate_name = name.replace('_', "-");
            writeln!(dependencies, "{crate_name} = {{ path = '{name}' }}").expect("text");
            stated(&description, &mut parameters);
        }
        let members = NAMES.map(|name| format!("'{name}'")).join(", ");
        let manifest = format!(
            "[workspace]\nmembers = [{members}]\n[package]\nname = 'program'\nversion = '0.0.0'\n\
             edition = '2024'\n[profile.dev]\ndebug = false\nincremental = false\n\
             [dependencies]\n{dependencies}"
        );
        write(&folder.join("Cargo.toml"), &manifest);
        write(&folder.join("src/main.rs"), include_str!("program.rs"));
        write(&folder.join("src/parameters.rs"), &parameters);
        cargo(&folder, &["test", "--workspace"]);
        cargo(&folder, &["build"]);
        folder
    })
}

/// Writes a file where it says something else, so that cargo compiles again only what has changed.
fn write(path: &Path, text: &str) {
    if fs::read_to_string(path).is_ok_and(|found| found == text) {
        return;
    }
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    fs::write(path, text).expect("a file");
}

/// The parameters of a spacecraft as a module of Rust.
fn stated(Description { name, hub, device, .. }: &Description, to: &mut String) {
    let mut line = |text: String| to.extend([text.as_str(), "\n"]);
    line(format!("#[allow(dead_code)]\npub mod {name} {{\nuse crate::Device;"));
    let Hub { mass, centre_of_mass, inertia, .. } = hub;
    line("pub const HUB: (f64, [f64; 3], [[f64; 3]; 3]) =".to_owned());
    line(format!("({mass:?}, {centre_of_mass:?}, {inertia:?});"));
    line(format!("pub const DEVICES: [Device; {}] = [", device.len()));
    for of in device {
        line(format!("Device {{ mount: {:?}, bodies: &[", of.mount));
        for body in &of.body {
            let Body { mass, origin, centre_of_mass, inertia, .. } = body;
            line(format!("({mass:?}, {origin:?}, {centre_of_mass:?}, {inertia:?}),"));
        }
        let locked: Vec<_> = of.body.iter().map(|b| b.locked_at.unwrap_or_default()).collect();
        line(format!("], locked_at: &{locked:?} }},"));
    }
    line("];\n}".to_owned());
}

/// Runs cargo in the workspace.
fn cargo(folder: &Path, arguments: &[&str]) {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(arguments).args(["--offline", "--quiet", "--target-dir", "target"]);
    cargo.current_dir(folder);
    // Flags of the outer build are not for crates of users.
    for flags in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET", "CARGO_TARGET_DIR"]
    {
        cargo.env_remove(flags);
    }
    let output = cargo.output().expect("cargo starts");
    let [said, errors] =
        [output.stdout, output.stderr].map(|of| String::from_utf8_lossy(&of).into_owned());
    assert!(output.status.success(), "cargo {arguments:?}:\n{said}{errors}");
}

/// What the program finds of these states.
pub(crate) fn found(name: &str, states: &[Drawn]) -> Vec<Option<Found>> {
    let mut lines = String::new();
    for Drawn { omega, force, torque_b, joints } in states {
        let joints = joints.iter().flatten();
        let joints =
            joints.flat_map(|of| [of.at[0], of.at[1], f64::from(u8::from(of.torque)), of.given]);
        lines.push_str(name);
        for number in [omega, force, torque_b].into_iter().flatten().copied().chain(joints) {
            write!(lines, " {:x}", number.to_bits()).expect("text");
        }
        lines.push('\n');
    }
    let text = answer(lines);
    assert_eq!(text.lines().count(), states.len(), "a line for each state");
    text.lines().zip(states).map(|(line, drawn)| read(line, drawn)).collect()
}

/// The folded spacecraft with all its constants, as its crate prints them.
pub(crate) fn folded() -> String {
    answer("constants\n".to_owned()).trim_end().to_owned()
}

/// What the program prints for these lines.
fn answer(lines: String) -> String {
    let program = workspace().join("target/debug/program");
    let mut child = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut input = child.stdin.take().expect("an input");
    let writer = thread::spawn(move || input.write_all(lines.as_bytes()));
    let output = child.wait_with_output().expect("the program ends");
    writer.join().expect("a thread").expect("a reader");
    assert!(output.status.success(), "{}", output.status);
    String::from_utf8(output.stdout).expect("text")
}

/// The accelerations of a line, of as many joints as the state has.
fn read(line: &str, drawn: &Drawn) -> Option<Found> {
    if line == "none" {
        return None;
    }
    let number = |word| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"));
    let mut numbers = line.split(' ').map(number);
    let mut next = || numbers.next().expect("as many accelerations as joints");
    let [r_b_n_ddot, omega_dot] = [(); 2].map(|()| [(); 3].map(|()| next()));
    let joints = drawn.joints.iter().map(|device| device.iter().map(|_| next()).collect());
    Some((r_b_n_ddot, omega_dot, joints.collect()))
}
