//! The commands about structures, and tables with errors.

use std::fs;
use std::path::Path;

use precess::file::structure_from_file;
use precess::structure::npz;

use super::{beam, path};

fn precess(arguments: &[&str]) -> (bool, String, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_precess"));
    command.current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    let output = command.args(arguments).output().expect("the command starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (output.status.success(), text(output.stdout), text(output.stderr))
}

/// Responses that a transmission differs from one by at least, where the mount gives way.
const GIVES_WAY: f64 = 0.1;

#[test]
fn commands_show_convert_and_write_tables_and_figures() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("structure-commands");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let at = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let beam = beam("craig-bampton.op4", "mass = \"MXX\"\nstiffness = \"KXX\"");
    fs::write(at("beam.npz"), npz::write(&beam).expect("it is written")).expect("a file");
    let (good, shown, _) = precess(&["structure", "show", &at("beam.npz")]);
    assert!(good && shown.contains("mass 3 kg") && shown.contains("45.9896"), "{shown}");
    let draw = ["structure", "show", &at("beam.npz"), "--shapes", &at("modes.svg")];
    let (good, shown, error) = precess(&draw);
    assert!(good && shown.ends_with("modes.svg\n"), "{error}");
    let drawn = fs::read_to_string(at("modes.svg")).expect("a picture");
    assert!(drawn.contains("45.99 Hz, 1 %") && !drawn.contains("NaN"), "{drawn}");
    assert!(!precess(&draw).0, "it replaces nothing");
    assert!(precess(&[&draw[..], &["--force"]].concat()).0);
    assert_eq!(fs::read_to_string(at("modes.svg")).expect("a picture"), drawn, "the same bytes");
    let flex = path("Flex_Panel.txt");
    let flex = flex.to_str().expect("text");
    let (good, text, _) = precess(&["structure", "convert", flex, "--to", &at("panel.npz")]);
    assert!(good && text.ends_with("2 nodes, 2 modes\n"), "{text}");
    assert!(structure_from_file(Path::new(&at("panel.npz"))).is_ok());
    let (good, _, error) = precess(&["structure", "convert", flex, "--to", &at("panel.npz")]);
    assert!(!good && error.contains("--force"), "{error}");
    let (good, text, error) =
        precess(&["structure", "convert", &at("panel.npz"), "--to", &at("panel.op4")]);
    assert!(good && text.ends_with("2 nodes, 2 modes\n"), "{error}");
    let [from, to] =
        ["panel.npz", "panel.toml"].map(|name| structure_from_file(Path::new(&at(name))));
    assert_eq!(from.expect("NPZ").shapes, to.expect("op4").shapes);
    let wheel = ["--scenario", "scenarios/bus-three-wheels.toml", "--device", "wheel_z"];
    let out = at("out");
    let command = ["accelerance", &at("beam.npz"), "--at", "tip", "--to", "500 Hz", "--out", &out];
    let (good, files, error) = precess(&[&command[..], &wheel].concat());
    assert!(good, "{error}");
    assert!(error.contains("rigid arm") && error.contains("leaves out at most"), "{error}");
    for file in files.lines() {
        assert!(Path::new(file).exists(), "{file}");
    }
    assert_eq!(files.matches(".svg").count(), 12, "{files}");
    let table = fs::read_to_string(at("out/beam-transmission-tip.csv")).expect("a table");
    let mut lines = table.lines();
    let heads: Vec<_> = lines.next().expect("a heading").split(',').collect();
    let column = heads.iter().position(|head| *head == "fz_fz_re").expect("a column");
    let first: Vec<f64> = lines
        .map(|line| line.split(',').nth(column).expect("a cell").parse().expect("a number"))
        .collect();
    assert!(first.iter().all(|value| value.is_finite()) && (first[0] - 1.0).abs() > GIVES_WAY);
    let wrong = ["accelerance", &at("beam.npz"), "--at", "top", "--out", &out];
    let (good, _, error) = precess(&wrong);
    assert!(!good && error.contains("no node is named `top`; there are root, tip"), "{error}");
}

#[test]
fn every_error_of_a_table_comes_at_once_with_its_line() {
    let table = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wrong.toml");
    let file = path("modes.op4");
    let text = format!(
        "format = 1\nfile = '{}'\ncolour = 3\n[op4]\nshapes = \"PHG\"\neigenvalues = \"LAMA\"\n\
         rigid_modes = 6\n[[node]]\nname = \"root\"\nposition = \"0, 0, 0 kg\"\nrows = 1\n\
         [[node]]\nname = \"tip\"\nposition = \"2, 0, 0 m\"\nrows = [7, 8]\n",
        file.display()
    );
    fs::write(&table, &text).expect("a table");
    let errors = structure_from_file(&table).expect_err("it is wrong").to_string();
    for part in [
        "wrong.toml:3:1",
        "unknown key `colour`",
        "is a mass, where a length is wanted",
        "wrong.toml:15:8",
        "no list of 6 finite numbers",
    ] {
        assert!(errors.contains(part), "{part}: {errors}");
    }
    // A wrong position: rigid-body modes tell.
    let text = text
        .replace("colour = 3\n", "")
        .replace("0, 0, 0 kg", "0, 0, 0 m")
        .replace("2, 0, 0 m", "2.1, 0, 0 m")
        .replace("rows = [7, 8]", "rows = 7");
    fs::write(&table, text).expect("a table");
    let errors = structure_from_file(&table).expect_err("it is wrong").to_string();
    assert!(errors.contains("check positions, units and rows of the nodes"), "{errors}");
}
