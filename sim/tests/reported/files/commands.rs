//! Every command of the command line, with arguments by which it does its work in a moment.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use clap::CommandFactory as _;
use precess::command::Cli;

const HUB: &str = "[hub]\nmass = \"96 kg\"\ninertia = \"20, 20, 20 kg m^2\"\n";
/// Its title would rename the window of a terminal, and clear it.
const WHEEL: &str = r#"format = 1
base = "hub.toml"
name = "wheel"
title = "A wheel \u001b]0;title\u0007 \u009b2J"
[[device]]
name = "rw"
kind = "reaction_wheel"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "10 g cm", dynamic = "0 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
[[wrench]]
on = "hub"
force.x = { table = "push.csv", column = "f", unit = "N", interpolation = "hold" }
[run]
duration = "0.2 s"
[output]
rate = "2 kHz"
[[requirement]]
name = "micro-g"
quantity = "acceleration"
statistic = "peak"
limit = "200 mm/s^2"
"#;
const BUDGET: &str = r#"format = 1
title = "A budget \u001b[2J"
scenario = "wheel.toml"
[speed]
from = "600 rpm"
to = "6000 rpm"
count = 5
[[line_of_sight]]
name = "los"
node = "hub"
boresight = [0, 0, 1]
[[requirement]]
name = "rms"
metric = "rms"
limit = "1 mrad"
"#;
const HELD: &str = r#"format = 1
title = "Held \u001b[2J"
[hub]
mass = "96 kg"
inertia = "20, 20, 20 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
layout.pyramid = { count = 3, half_angle = "50 deg", radius = "20 cm" }
imbalance = { static = "1 g cm", dynamic = "1 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
[[controller]]
name = "aocs"
rate = "4 Hz"
[controller.law]
kind = "mrp_feedback"
attitude_gain = "4 N m"
rate_gain = "6 N m s"
[run]
duration = "1 s"
[output]
rate = "10 Hz"
"#;
const PLAN: &str = "format = 1\n[[vary]]\nkey = \"hub.mass\"\ndistribution = \"uniform\"\nfrom = \"90 kg\"\n\
                    to = \"100 kg\"\n";

/// Two seconds of one case of the benchmark.
const BENCHMARK: [&str; 14] = [
    "--case",
    "bus-open-nominal",
    "--block",
    "300 ms",
    "--learn",
    "1 s",
    "--healthy",
    "1 s",
    "--duration",
    "2 s",
    "--false-alarms",
    "1",
    "--out",
    "out",
];

/// Two seconds of the wheels of [`HELD`], which keep their rates.
fn telemetry() -> String {
    let joints: Vec<_> = (1..=3).map(|wheel| format!(",rw{wheel}.spin,rw{wheel}.u_w")).collect();
    let rows = (0..200).map(|k| format!("{}{}\n", 0.01 * f64::from(k), ",314.15,0".repeat(3)));
    format!("time{}\n", joints.concat()) + &rows.collect::<String>()
}

/// A command with its arguments.
pub(super) struct Case {
    /// As it is called: `structure show`.
    pub(super) name: String,
    /// The arguments after it. Files that it writes are in [`Case::out`].
    pub(super) arguments: Vec<String>,
    /// The files that it reads.
    pub(super) inputs: Vec<PathBuf>,
    /// The folder into which it writes; none of a command that writes none.
    pub(super) out: Option<PathBuf>,
    /// Where it is executed.
    pub(super) folder: PathBuf,
}

impl Case {
    /// The command with its arguments, in its folder.
    pub(super) fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
        command.current_dir(&self.folder).args(self.name.split(' ')).args(&self.arguments);
        command
    }

    pub(super) fn output(&self) -> Output {
        self.command().output().expect("the command starts")
    }

    /// The folder of its files, empty.
    pub(super) fn empty_out(&self) -> &Path {
        let out = self.out.as_ref().expect("a command that writes");
        let _ = fs::remove_dir_all(out);
        fs::create_dir_all(out).expect("a folder");
        out
    }
}

/// The text of standard error.
pub(super) fn error_of(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The names of all commands that do something, `structure show`, from the declaration of the command line.
pub(super) fn names() -> BTreeSet<String> {
    fn walk(command: &clap::Command, before: &str, names: &mut BTreeSet<String>) {
        for command in command.get_subcommands() {
            let name = format!("{before}{}", command.get_name());
            if command.has_subcommands() {
                walk(command, &format!("{name} "), names);
            } else {
                names.insert(name);
            }
        }
    }
    let mut names = BTreeSet::new();
    walk(&Cli::command(), "", &mut names);
    names
}

/// The files that cases read.
fn set_up(folder: &Path) {
    let put = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    for (name, text) in [
        ("hub.toml", HUB),
        ("wheel.toml", WHEEL),
        ("budget.toml", BUDGET),
        ("plan.toml", PLAN),
        ("held.toml", HELD),
    ] {
        put(name, text);
    }
    put("push.csv", "time_s,f\n0,0\n1,0\n");
    put("telemetry.csv", &telemetry());
    let structure =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/imaging-satellite-modes.npz");
    fs::copy(structure, folder.join("bus.npz")).expect("a file");
}

/// Examples of `fit` and `identify`, with titles for terminals.
fn examples(folder: &Path, of: impl Fn(&str, &[&str], &[&str]) -> Case) {
    let example = of("fit", &[], &["--example", "table"]).output();
    assert!(example.status.success(), "{}", error_of(&example));
    short_sweep(&folder.join("table"));
    let example = of("identify", &[], &["--example", "craft"]).output();
    assert!(example.status.success(), "{}", error_of(&example));
    short_record(&folder.join("craft"));
}

/// A case of every command. A new command has to be added here, and its options say whether it writes.
pub(super) fn cases(folder_name: &str) -> Vec<Case> {
    let folder = super::super::folder(folder_name);
    set_up(&folder);
    let of = |name: &str, inputs: &[&str], arguments: &[&str]| {
        let own = |text: &&str| (*text).to_owned();
        let writes =
            arguments.iter().any(|argument| *argument == "out" || argument.starts_with("out/"));
        Case {
            name: name.to_owned(),
            arguments: arguments.iter().map(own).collect(),
            inputs: inputs.iter().map(|name| folder.join(name)).collect(),
            out: writes.then(|| folder.join("out")),
            folder: folder.clone(),
        }
    };
    let scenario: &[&str] = &["wheel.toml", "hub.toml", "push.csv"];
    let budget: &[&str] = &["budget.toml", "wheel.toml", "hub.toml", "push.csv"];
    let watched: &[&str] = &["held.toml", "telemetry.csv"];
    let plan: &[&str] = &["plan.toml", "wheel.toml", "hub.toml", "push.csv"];
    let before = of("run", scenario, &["wheel.toml", "--out", "results"]).output();
    assert!(before.status.success(), "{}", error_of(&before));
    examples(&folder, of);
    let (samples, result) = ("table/wheel-sweep.csv", "results/wheel.csv");
    let measurement = "table/wheel-measurement.toml";
    let (bus, unknown, telemetry) =
        ("craft/bus.toml", "craft/bus-unknown.toml", "craft/bus-telemetry.csv");
    let formats = if cfg!(feature = "mcap") {
        "output.formats=[\"csv\", \"npz\", \"mcap\"]"
    } else {
        "output.formats=[\"csv\", \"npz\"]"
    };
    let watch =
        [watched[0], "--data", watched[1], "--block", "100 ms", "--learn", "1 s", "--out", "out"];
    let cases = vec![
        of("new", &[], &["vscmg"]),
        of("check", scenario, &["wheel.toml"]),
        of("run", scenario, &["wheel.toml", "--out", "out", "--set", formats]),
        of("evaluate", scenario, &["wheel.toml"]),
        of("compare", &[result], &[result, result]),
        of("plot", scenario, &["wheel.toml", "--out", "out"]),
        of("spectrum", &[result], &[result, "--out", "out"]),
        of("schema", &[], &[]),
        of("kinds", &[], &["dgvscmg"]),
        of("bake", scenario, &["wheel.toml", "--set", "title=A wheel", "--out", "out/kernels"]),
        of("structure show", &["bus.npz"], &["bus.npz", "--shapes", "out/bus.svg"]),
        of("structure convert", &["bus.npz"], &["bus.npz", "--to", "out/bus.op4"]),
        of(
            "accelerance",
            &["bus.npz"],
            &["bus.npz", "--at", "camera", "--points", "20", "--out", "out"],
        ),
        of("jitter", budget, &["budget.toml", "--out", "out"]),
        of("margins", &["held.toml"], &["held.toml", "--out", "out"]),
        of("watch", watched, &watch),
        of("benchmark health", &[], &BENCHMARK),
        of("fit", &[measurement, samples], &[measurement, "--out", "out"]),
        of(
            "identify",
            &[bus, unknown, telemetry],
            &[bus, "--unknown", unknown, "--data", telemetry, "--out", "out"],
        ),
        of("sweep", scenario, &["wheel.toml", "--over", "hub.mass=90..110 kg:3", "--out", "out"]),
        of(
            "montecarlo",
            plan,
            &["wheel.toml", "--plan", "plan.toml", "--samples", "4", "--out", "out"],
        ),
        of("completions", &[], &["bash"]),
        of("manual", &[], &["--out", "out"]),
        of("export table", scenario, &["wheel.toml", "--to", "out/wheel.table"]),
        of(
            "export fmu",
            scenario,
            &["wheel.toml", "--step", "1 ms", "--set", "title=A wheel", "--to", "out/wheel.fmu"],
        ),
    ];
    let listed: BTreeSet<_> = cases.iter().map(|case| case.name.clone()).collect();
    assert_eq!(listed, names(), "each command has a case");
    let listed: BTreeSet<_> =
        cases.iter().filter(|case| case.out.is_some()).map(|case| case.name.clone()).collect();
    assert_eq!(listed, declared_writing(), "each command that writes has a case that writes");
    cases
}

/// Six seconds of the example of `fit`, with the harmonic and the mode that it would search for, and a title for terminals.
fn short_sweep(folder: &Path) {
    let (measurement, samples) =
        (folder.join("wheel-measurement.toml"), folder.join("wheel-sweep.csv"));
    let mut text = fs::read_to_string(&measurement).expect("a file");
    text = text.replace("title = \"", "title = \"\\u001b[2J");
    for stated in ["[[harmonic]]", "number = ", "[[mode]]", "of = ", "frequency = "] {
        assert!(text.contains(&format!("\n# {stated}")), "{stated}");
        text = text.replace(&format!("\n# {stated}"), &format!("\n{stated}"));
    }
    fs::write(&measurement, text).expect("a file");
    let text = fs::read_to_string(&samples).expect("a file");
    let rows: Vec<_> = text.lines().take(6001).collect();
    fs::write(&samples, rows.join("\n") + "\n").expect("a file");
}

/// A second of the example of `identify`, with priors that tell what that does not, and a title for terminals.
fn short_record(folder: &Path) {
    let (unknown, telemetry) = (folder.join("bus-unknown.toml"), folder.join("bus-telemetry.csv"));
    let text = fs::read_to_string(&unknown).expect("a file");
    let text = text.replace("name = \"bus\"", "name = \"bus\"\ntitle = \"A bus \\u001b[2J\"");
    let text = text.replace("hub_moments = true", "hub_moments = \"3 kg m^2\"");
    let text = text.replace("viscous = true", "viscous = \"1e-5 N m s/rad\"");
    fs::write(&unknown, text).expect("a file");
    let text = fs::read_to_string(&telemetry).expect("a file");
    let rows: Vec<_> = text.lines().take(102).collect();
    fs::write(&telemetry, rows.join("\n") + "\n").expect("a file");
}

/// The names of the commands whose options say that they write.
fn declared_writing() -> BTreeSet<String> {
    let mut writing = BTreeSet::new();
    for name in names() {
        let declared = Cli::command();
        let command = name
            .split(' ')
            .fold(&declared, |command, part| command.find_subcommand(part).expect("a command"));
        let writes = |argument: &clap::Arg| {
            matches!(argument.get_id().as_str(), "out" | "to" | "shapes")
                && argument.get_value_names().is_some_and(|names| {
                    names.iter().any(|name| matches!(name.as_str(), "FOLDER" | "DIR" | "FILE"))
                })
        };
        if command.get_arguments().any(writes) {
            writing.insert(name);
        }
    }
    writing
}

/// The cases that write, but `bake` and `export fmu`: another program derives their files.
pub(super) fn writing(folder_name: &str) -> Vec<Case> {
    let cases = cases(folder_name).into_iter();
    cases
        .filter(|case| case.out.is_some() && !["bake", "export fmu"].contains(&case.name.as_str()))
        .collect()
}
