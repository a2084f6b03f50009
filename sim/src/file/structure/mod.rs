//! Tables of structures: TOML that says what an op4 file or a Flex file of 42 has: which rows belong to
//! which node, where the nodes are, mass, damping. Keys and units as in scenario files; every error at once.

mod format;
mod matrices;

use std::path::Path;

use nalgebra::Vector3;

use super::diagnostic::Diagnostics;
use super::document::Value;
use super::keys::Keys;
use super::read::devices::{body, inertia::inertia};
use super::read_file::{folder_of, read_file};
use crate::structure::{
    COORDINATES, Fault, MOST, Node, RigidMass, Structure, StructureError, bytes_of, flex42, op4,
};
use crate::units::Measure;

pub use format::{StructureReadError, structure_from_file};

/// The number of the format that this program reads.
const FORMAT: u32 = 1;
/// Rows of a matrix that a table may name.
const ROWS_MAX: u32 = 100_000_000;

/// A node with its rows.
struct MappedNode {
    node: Node,
    /// Rows of the matrices of an op4 file, from 0.
    rows: [Option<usize>; COORDINATES],
    /// Whether it is a joint of a Flex file, and its number there.
    point: (bool, usize),
}

/// Reads a table and the file that it names.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn structure_from_toml(path: &Path) -> Result<Structure, Diagnostics> {
    read_file(path, "structure", ("", &[]), |keys| read(keys, folder_of(path)))
}

fn read(keys: &Keys<'_>, folder: &Path) -> Option<Structure> {
    if !keys.has("format") {
        keys.missing("format", "format = 1");
    }
    keys.count("format", FORMAT, FORMAT);
    let name = keys.text("name");
    let has_devices = keys.boolean("has_devices");
    let damping = damping(keys);
    let rigid = keys.table("rigid").and_then(|rigid| {
        let mass = body::mass(&rigid);
        let centre = rigid.vector("centre_of_mass", Measure::LENGTH);
        let inertia = inertia(&rigid);
        rigid.finish();
        Some(RigidMass::about_centre(mass?, centre.unwrap_or_else(Vector3::zeros), inertia?))
    });
    let Some(file) = keys.text("file") else {
        if !keys.has("file") {
            keys.missing("file", "file = \"modes.op4\"");
        }
        return None;
    };
    let path = folder.join(file);
    let failed = |key: &str, error: StructureError, path: &Path| {
        keys.error(key, error.in_file(path).to_string(), "");
    };
    let bytes = match bytes_of(&path) {
        Ok(bytes) => bytes,
        Err(error) => {
            failed("file", error, &path);
            return None;
        }
    };
    let is_flex = flex42::is_flex(&bytes);
    let nodes = nodes(keys, is_flex);
    let matrices = keys.table("op4");
    if is_flex && matrices.is_some() {
        keys.error("op4", format!("{file} is a Flex file and has no matrices"), "remove `[op4]`");
    }
    if !is_flex && matrices.is_none() {
        keys.missing("op4", "[op4]");
    }
    let found = if is_flex {
        flex42::read(&bytes).and_then(|flex| of_flex(&flex, &nodes))
    } else {
        let matrices = matrices?;
        let read = op4::read(&bytes);
        let read = read.and_then(|all| matrices::of_op4(&matrices, &all, &nodes, rigid.as_ref()));
        matrices.finish();
        read
    };
    keys.finish();
    let structure = found.and_then(|mut structure| {
        if let Some(name) = name {
            name.clone_into(&mut structure.name);
        }
        structure.mass = rigid.or(structure.mass);
        structure.has_devices = has_devices;
        let count = structure.modes.len();
        match &damping {
            Some(ratios) if ratios.len() > 1 && ratios.len() != count => {
                let what = String::from("damping ratios for modes");
                return Err(
                    Fault::Number { what, found: ratios.len(), range: [count, count] }.into()
                );
            }
            Some(ratios) => {
                for (mode, ratio) in structure.modes.iter_mut().zip(ratios.iter().cycle()) {
                    mode.damping = *ratio;
                }
            }
            None => {}
        }
        Ok(structure.checked()?)
    });
    match structure {
        Ok(structure) => Some(structure),
        // A key that is missing has been reported.
        Err(StructureError { fault: Fault::Format, .. })
            if keys.reports().borrow().has_errors() =>
        {
            None
        }
        Err(error) => {
            failed("file", error, &path);
            None
        }
    }
}

/// One ratio, or a list of them.
fn damping(keys: &Keys<'_>) -> Option<Vec<f64>> {
    let node = keys.node("damping")?;
    if let Value::List(list) = &node.value {
        let number = |node: &crate::file::document::Node| match node.value {
            Value::Number(value, _) => Some(value),
            _ => None,
        };
        let ratios: Option<Vec<f64>> = list.iter().map(number).collect();
        if ratios.as_ref().is_none_or(Vec::is_empty) {
            keys.error("damping", "`damping` is no list of numbers", "write for example `0.005`");
        }
        return ratios;
    }
    keys.number("damping").map(|ratio| vec![ratio])
}

fn nodes(keys: &Keys<'_>, is_flex: bool) -> Vec<MappedNode> {
    if !keys.has("node") {
        keys.missing("node", "[[node]]");
    }
    let each = keys.tables("node").into_iter().filter_map(|keys| {
        let name = keys.text("name").map(str::to_owned);
        if name.is_none() && !keys.has("name") {
            keys.missing("name", "name = \"wheel1\"");
        }
        let position = keys.vector("position", Measure::LENGTH);
        if position.is_none() && !keys.has("position") {
            keys.missing("position", "position = \"0, 0, 0 m\"");
        }
        let (mut rows, mut point) = ([None; COORDINATES], (false, 0));
        if is_flex {
            point = flex_point(&keys)?;
        } else {
            rows = op4_rows(&keys)?;
        }
        keys.finish();
        Some(MappedNode { node: Node { name: name?, position: position? }, rows, point })
    });
    each.collect()
}

fn flex_point(keys: &Keys<'_>) -> Option<(bool, usize)> {
    let highest = u32::try_from(MOST).unwrap_or(u32::MAX);
    let [node, joint] = ["node", "joint"].map(|key| keys.has(key));
    if node == joint {
        let message = "a point of a Flex file is a `node` or a `joint`";
        keys.error(if node { "joint" } else { "name" }, message, "give its number, from 0");
        return None;
    }
    let number = keys.count(if joint { "joint" } else { "node" }, 0, highest)?;
    Some((joint, usize::try_from(number).ok()?))
}

/// The first of six rows, or six rows, 0 for none.
fn op4_rows(keys: &Keys<'_>) -> Option<[Option<usize>; COORDINATES]> {
    if !keys.has("rows") {
        keys.missing("rows", "rows = 1");
        return None;
    }
    let row = |value: u32| usize::try_from(value).ok().and_then(|row| row.checked_sub(1));
    if !matches!(keys.node("rows")?.value, Value::List(_)) {
        let first = row(keys.count("rows", 1, ROWS_MAX)?)?;
        return Some(std::array::from_fn(|k| Some(first + k)));
    }
    let numbers = keys.numbers::<COORDINATES>("rows")?;
    let whole = |value: f64| (0.0..=f64::from(ROWS_MAX)).contains(&value) && value.fract() == 0.0;
    if !numbers.iter().all(|value| whole(*value)) || numbers.iter().all(|value| *value == 0.0) {
        let help = "write six row numbers from 1, with 0 for a coordinate without a row";
        keys.error("rows", "`rows` has a number that is no row", help);
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    Some(numbers.map(|value| row(value as u32)))
}

fn of_flex(flex: &flex42::Flex, nodes: &[MappedNode]) -> Result<Structure, StructureError> {
    let shapes = flex.rows(nodes.iter().map(|rows| rows.point));
    let known = |(is_joint, number): (bool, usize)| {
        let of = if is_joint { &flex.joints } else { &flex.nodes };
        of.numbers.contains(&number)
    };
    if let Some(rows) = nodes.iter().find(|rows| !known(rows.point)) {
        let (is_joint, number) = rows.point;
        let sort = |is_joint: bool| if is_joint { "joint" } else { "node" };
        let present =
            [(true, &flex.joints), (false, &flex.nodes)].into_iter().flat_map(|(j, of)| {
                of.numbers.iter().map(move |number| format!("{} {number}", sort(j)))
            });
        let what = format!("shape of {} {number}", sort(is_joint));
        return Err(Fault::Missing { what, present: present.collect() }.into());
    }
    flex.at(nodes.iter().map(|rows| rows.node.clone()).collect(), &shapes)
}
