//! A structure as an op4 file and the table that maps its rows to nodes: what
//! [`structure_from_file`](crate::file::structure_from_file) reads back.
//!
//! Matrices keep their bits. Mass properties are in the table, about the centre of mass, to rounding.

use std::fmt::Write as _;

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::super::{COORDINATES, Structure, StructureError};
use super::{Matrix, write};

/// Bytes of the op4 file, and the text of the table that names it as `file`.
///
/// # Errors
/// As [`write()`].
pub fn of_structure(
    structure: &Structure,
    file: &str,
) -> Result<(Vec<u8>, String), StructureError> {
    let squares = structure.modes.iter().map(|mode| mode.frequency * mode.frequency);
    let squares = DMatrix::from_iterator(structure.modes.len(), 1, squares);
    let momenta = structure.momenta();
    let momenta = DMatrix::from_column_slice(COORDINATES, momenta.ncols(), momenta.as_slice());
    let carries = momenta.iter().any(|value| *value != 0.0);
    let mut matrices =
        vec![Matrix::of_dense("PHI", &structure.shapes), Matrix::of_dense("LAMA", &squares)];
    let mut keys = String::from("[op4]\nshapes = \"PHI\"\neigenvalues = \"LAMA\"\n");
    let optional = [
        ("momentum", "LMOM", carries.then_some(&momenta)),
        ("mass", "MASS", structure.mass_matrix.as_ref()),
        ("residual_flexibility", "RESFLEX", structure.residual.as_ref()),
    ];
    for (key, name, matrix) in optional {
        if let Some(matrix) = matrix {
            matrices.push(Matrix::of_dense(name, matrix));
            let _ = writeln!(keys, "{key} = \"{name}\"");
        }
    }
    if !carries {
        keys.push_str("free = true\n");
    }
    Ok((write(&matrices)?, table(structure, file) + &keys + &nodes(structure)))
}

/// What comes before `[op4]`.
fn table(structure: &Structure, file: &str) -> String {
    let mut text = String::from("format = 1\n");
    if !structure.name.is_empty() {
        let _ = writeln!(text, "name = {}", quoted(&structure.name));
    }
    let _ = writeln!(text, "file = {}", quoted(file));
    let damping = structure.modes.iter().map(|mode| mode.damping);
    let _ = writeln!(text, "damping = [{}]", listed(damping));
    if let Some(has_devices) = structure.has_devices {
        let _ = writeln!(text, "has_devices = {has_devices}");
    }
    text.push('\n');
    if let Some(mass) = &structure.mass {
        let centre = mass.centre();
        let cross = centre.cross_matrix();
        let inertia: Matrix3<f64> = mass.inertia + mass.mass * cross * cross;
        let products = Vector3::new(inertia.m12, inertia.m13, inertia.m23);
        let _ = write!(
            text,
            "[rigid]\nmass = \"{} kg\"\ncentre_of_mass = \"{} m\"\ninertia = \"{} kg m^2\"\n\
             products_of_inertia = \"{} kg m^2\"\n\n",
            listed([mass.mass]),
            listed(centre.iter().copied()),
            listed(inertia.diagonal().iter().copied()),
            listed(products.iter().copied())
        );
    }
    text
}

fn nodes(structure: &Structure) -> String {
    let mut text = String::new();
    for (index, node) in structure.nodes.iter().enumerate() {
        let _ = write!(
            text,
            "\n[[node]]\nname = {}\nposition = \"{} m\"\nrows = {}\n",
            quoted(&node.name),
            listed(node.position.iter().copied()),
            COORDINATES * index + 1
        );
    }
    text
}

/// A string of TOML: those of JSON are.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Numbers in the fewest digits that read back the same.
fn listed(values: impl IntoIterator<Item = f64>) -> String {
    let mut digits = zmij::Buffer::new();
    let each = values.into_iter().map(|value| digits.format(value).to_owned());
    each.collect::<Vec<_>>().join(", ")
}
