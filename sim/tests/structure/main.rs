//! Structures: their files, the commands about them, accelerances, dynamic mass and mounted force.
//!
//! `tests/engines/structures.py` wrote the files and values of `files` by pyYeti.

#![expect(clippy::cast_precision_loss, reason = "small numbers of modes, rows and columns")]

use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess::file::structure_from_file;
use precess::structure::{Mode, Node, RigidMass, Structure};

mod averaged;
mod beams;
mod checks;
mod commands;
mod damaged;
mod files;
mod flexible;
mod left_out;
mod momentum;
mod op4;
mod pyyeti;
mod run;
mod wheel;

#[path = "../shared/numbers.rs"]
mod numbers;

/// A Flex file of 42, written by hand.
const FLEX: &str = include_str!("files/Flex_Panel.txt");
const FORMS: [&str; 3] = ["ascii", "little", "big"];

const LAYOUTS: [&str; 3] = ["dense", "nonbigmat", "bigmat"];
/// Rounding of a few equations whose terms differ by 1e4.
const ROUNDING: f64 = 1e-12;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/structure/files").join(name)
}

fn bytes(name: &str) -> Vec<u8> {
    fs::read(path(name)).expect("a fixture")
}

/// A valid structure without mass and residual flexibility.
fn structure(nodes: Vec<Node>, modes: Vec<Mode>, shapes: DMatrix<f64>) -> Structure {
    let structure = Structure {
        name: String::new(),
        nodes,
        modes,
        shapes,
        mass: None,
        mass_matrix: None,
        residual: None,
        has_devices: Some(false),
        initial: Vec::new(),
    };
    structure.checked().expect("it is valid")
}

/// The free beam, from Craig and Bampton's matrices, or from its modes.
fn beam(file: &str, matrices: &str) -> Structure {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    // Of each test its own: they run at the same time.
    let test = std::thread::current().name().unwrap_or("test").replace("::", "-");
    let table = folder.join(format!("{test}-{file}.toml"));
    let file = path(file);
    let text = format!(
        "format = 1\nname = \"free beam\"\nfile = '{}'\ndamping = 0.01\n\
         [op4]\n{matrices}\nrigid_modes = 6\n\
         [[node]]\nname = \"root\"\nposition = \"0, 0, 0 m\"\nrows = 1\n\
         [[node]]\nname = \"tip\"\nposition = \"2, 0, 0 m\"\nrows = [7, 8, 9, 10, 11, 12]\n",
        file.display()
    );
    fs::write(&table, text).expect("a table");
    structure_from_file(&table).unwrap_or_else(|error| panic!("{error}"))
}

fn example() -> Structure {
    let mode = |frequency, z| Mode {
        frequency,
        damping: 0.005,
        linear: Vector3::new(0.0, 0.0, z),
        angular: Vector3::new(0.1, -z, 0.0),
    };
    let node = |name: &str, x| Node { name: name.into(), position: Vector3::new(x, 0.1, -0.2) };
    Structure {
        name: "example, µ".into(),
        nodes: vec![node("wheel1", 0.5), node("star tracker", 1.0 / 3.0)],
        modes: vec![mode(31.4, 0.2), mode(62.8, 0.1), mode(99.0, 0.0)],
        shapes: DMatrix::from_fn(12, 3, |row, column| (row as f64).sin() / (1.0 + column as f64)),
        mass: Some(RigidMass::about_centre(
            350.0,
            Vector3::new(0.1, 0.0, 0.3),
            Matrix3::new(80.0, 1.0, 2.0, 1.0, 70.0, 3.0, 2.0, 3.0, 60.0),
        )),
        mass_matrix: Some(DMatrix::from_diagonal_element(12, 12, 3.0)),
        residual: Some(DMatrix::from_fn(12, 12, |row, column| 1e-9 * (row + column) as f64)),
        has_devices: Some(true),
        initial: Vec::new(),
    }
}
