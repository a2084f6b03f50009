//! The command, folders, and a scenario of one wheel on a free hub.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[path = "../shared/contents.rs"]
mod contents;

pub(crate) use contents::contents;

/// A wheel with a static imbalance of 10 g cm at the centre of a hub of 96 kg; its accelerations and forces are known.
const SCENARIO: &str = r#"format = 1
name = "wheel"
[hub]
mass = "96 kg"
inertia = "20, 20, 20 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "10 g cm", dynamic = "0 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
[run]
duration = "0.5 s"
[output]
rate = "2 kHz"
[[requirement]]
name = "micro-g"
quantity = "acceleration"
statistic = "peak"
limit = "200 mm/s^2"
"#;

pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.args(arguments);
    command
}

pub(crate) fn precess(arguments: &[&str]) -> Output {
    command(arguments).output().expect("it starts")
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

pub(crate) fn path(path: &Path) -> &str {
    path.to_str().expect("text")
}

/// An empty folder, and the scenario in it.
pub(crate) fn folder(name: &str) -> (PathBuf, PathBuf) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("campaign").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("wheel.toml");
    fs::write(&file, SCENARIO).expect("a file");
    (folder, file)
}

/// The result files, without the journal, whose records are in the order in which samples were finished.
pub(crate) fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = contents(folder);
    files.retain(|name, _| !name.ends_with(".journal"));
    files
}

/// The rows of a table, each cell by the name of its column.
pub(crate) fn rows(table: &[u8]) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(table);
    let names = reader.headers().expect("names").clone();
    let row = |record: csv::Result<csv::StringRecord>| {
        let record = record.expect("a row");
        names.iter().zip(&record).map(|(a, b)| (a.to_owned(), b.to_owned())).collect()
    };
    reader.records().map(row).collect()
}

/// A number of a row.
pub(crate) fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row.get(name).unwrap_or_else(|| panic!("{name} of {row:?}")).parse().expect("a number")
}
