//! The op4 writer: what pyYeti writes, byte for byte; what is written is read back with its bits.

use std::fs;
use std::path::Path;

use nalgebra::DMatrix;
use precess::file::structure_from_file;
use precess::structure::op4::{self, Matrix};
use precess::structure::{Fault, Structure};

use super::{FORMS, LAYOUTS, ROUNDING, bytes, example};

#[test]
fn what_is_written_is_what_pyyeti_writes() {
    // Every column of these is one run: dense, real, complex and without columns.
    let dense = bytes("dense-little.op4");
    let matrices = op4::read(&dense).expect("it is read");
    assert_eq!(op4::write(&matrices).expect("it is written"), dense);
    // The first matrix of this one has columns of several runs.
    let sparse = bytes("bigmat-little.op4");
    let matrices = op4::read(&sparse).expect("it is read");
    let first = op4::write(&matrices[..1]).expect("it is written");
    assert!(first.len() > 200 && sparse.starts_with(&first));
}

#[test]
fn matrices_of_every_form_are_read_back_with_their_bits() {
    for layout in LAYOUTS {
        for form in FORMS {
            let name = format!("{layout}-{form}.op4");
            let matrices = op4::read(&bytes(&name)).expect("it is read");
            let written = op4::write(&matrices).expect("it is written");
            assert_eq!(op4::read(&written).expect("it is read back"), matrices, "{name}");
        }
    }
    let odd = DMatrix::from_row_slice(2, 3, &[0.0, -0.0, 5e-324, 1.0 / 3.0, 0.0, f64::MAX]);
    let written = op4::write(&[Matrix::of_dense("odd", &odd)]).expect("it is written");
    let found = op4::read(&written).expect("it is read back")[0].dense().expect("real");
    assert!(found.iter().zip(odd.iter()).all(|(a, b)| a.to_bits() == b.to_bits()), "{found}");
}

#[test]
fn what_does_not_fit_is_rejected() {
    let matrix = Matrix::of_dense("M", &DMatrix::identity(3, 3));
    let rejected = |change: fn(&mut Matrix)| {
        let mut wrong = matrix.clone();
        change(&mut wrong);
        op4::write(&[wrong]).expect_err("it is wrong").fault
    };
    assert!(matches!(rejected(|m| m.name = "TOO LONG NAME".into()), Fault::Type { .. }));
    assert!(matches!(rejected(|m| m.name.clear()), Fault::Type { .. }));
    assert!(matches!(rejected(|m| m.runs[2].column = 3), Fault::Number { .. }));
    assert!(matches!(rejected(|m| m.runs[2].row = 3), Fault::Number { .. }));
    assert!(matches!(rejected(|m| m.runs[0].values[0] = f64::NAN), Fault::NotFinite { .. }));
}

/// Writes a structure as op4 with its table, and reads it back.
fn read_back(structure: &Structure, name: &str) -> Structure {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (matrices, table) =
        op4::of_structure(structure, &format!("{name}.op4")).expect("it is written");
    fs::write(folder.join(format!("{name}.op4")), matrices).expect("a file");
    fs::write(folder.join(format!("{name}.toml")), table).expect("a table");
    structure_from_file(&folder.join(format!("{name}.toml")))
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_structure_as_op4_is_read_back() {
    let mut structure = example();
    structure.nodes[0].name = "wheel \"1\" \\ ü".into();
    for carries in [true, false] {
        if !carries {
            for mode in &mut structure.modes {
                (mode.linear, mode.angular) =
                    (nalgebra::Vector3::zeros(), nalgebra::Vector3::zeros());
            }
            structure.has_devices = None;
            structure.residual = None;
        }
        let mut found = read_back(&structure, &format!("structure-{carries}"));
        let [a, b] = [&found, &structure].map(|of| of.mass.expect("a mass"));
        assert!((a.matrix() - b.matrix()).amax() < ROUNDING * b.matrix().amax());
        found.mass = structure.mass;
        assert_eq!(found, structure);
    }
    structure.mass = None;
    assert_eq!(read_back(&structure, "structure-free"), structure);
}
