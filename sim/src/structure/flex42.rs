//! Flex text files of [42](https://github.com/ericstoneking/42): a flexible body's modes.
//!
//! Lines are read as 42 reads them: the numbers that a line starts with, then a comment. Both layouts are
//! read: with the locations of the nodes in the file (`Analysis Node Locations`, as `F06To42Flex.m` writes
//! them), and without, where 42 has them in a file of nodes, and a table has to name the nodes
//! ([`file::structure_from_toml`](crate::file::structure_from_toml)).
//!
//! | section of the file | here |
//! |---|---|
//! | modal states `x, u` | coordinates and rates at the start, of the mass-normalised modes |
//! | PSI, THETA at joints and nodes | translation and rotation of the shapes |
//! | mass, stiffness, damping | made mass-normalised: frequency, damping ratio |
//! | Pf, Hf | momentum integrals `P`, `H` |
//! | L, N | not used: change of inertia by deformation |
//!
//! Indices of the file count from 0, its mass, stiffness and damping may have elements beside the diagonal
//! ([`modes`](super::modes)). 42 keeps mass and inertia in another file.

use nalgebra::{DMatrix, Matrix3xX, Vector3};

use super::modes::{Modal, normalised};
use super::{COORDINATES, Fault, FileLocation, MOST, Node, Structure, StructureError};

/// Words of the first line.
const TITLE: &str = "Flexible Body Inputs for 42";

/// Shapes at points of one sort: translation and rotation, three rows for each point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// The number in the file of each point that has rows here.
    pub numbers: Vec<usize>,
    /// Six rows for each.
    pub shapes: Vec<[Vec<f64>; COORDINATES]>,
}

/// The content of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Flex {
    /// The description.
    pub name: String,
    /// Shapes at joints, by 42's number of the joint.
    pub joints: Points,
    /// Shapes at analysis nodes, by their number.
    pub nodes: Points,
    /// Nodes with positions, where the file has them.
    pub located: Option<Vec<Node>>,
    /// Modal mass, stiffness and damping, and momentum integrals, as in the file.
    pub modal: Modal,
    /// Coordinate and rate of each mode at the start, as in the file.
    pub states: Vec<[f64; 2]>,
}

/// Whether bytes begin as a Flex file does.
#[must_use]
pub fn is_flex(bytes: &[u8]) -> bool {
    let line = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    String::from_utf8_lossy(line).contains(TITLE)
}

/// Reads a file.
///
/// # Errors
/// The line, what is wrong there, and the bound.
pub fn read(bytes: &[u8]) -> Result<Flex, StructureError> {
    let mut lines = Lines { rest: bytes, number: 0 };
    lines.next("the title")?;
    let name = lines.next("the description")?;
    let name = name.split('!').next().unwrap_or_default().trim().to_owned();
    let modes = lines.count("modes", [1, MOST])?;
    lines.next("the heading of the modal states")?;
    let states = (0..modes).map(|_| lines.numbers::<2>("the state of a mode"));
    let states: Vec<_> = states.collect::<Result<_, _>>()?;
    // The heading of the joints' shapes, or of the nodes' locations before it.
    let located = if lines.next("the heading of the joints' shapes")?.contains("Node Locations") {
        let nodes = located(&mut lines)?;
        lines.next("the heading of the joints' shapes")?;
        Some(nodes)
    } else {
        None
    };
    let joints = points(&mut lines, "joint", MOST, modes)?;
    lines.next("the heading of the nodes' shapes")?;
    let count = located.as_ref().map_or(MOST, Vec::len);
    let nodes = points(&mut lines, "node", count, modes)?;
    let [mass, stiffness, damping] =
        ["mass", "stiffness", "damping"].map(|what| square(&mut lines, what, modes));
    let [mass, stiffness, damping] = [mass?, stiffness?, damping?];
    let linear = integrals(&mut lines, modes)?;
    let angular = integrals(&mut lines, modes)?;
    for (what, indices) in [("L", 3), ("N", 4)] {
        lines.next(&format!("the heading of the modal integral {what}"))?;
        for _ in 0..lines.count("elements", [0, lines.rest.len()])? {
            let wanted = format!("indices and value of an element of {what}");
            let line = lines.next(&wanted)?;
            lines.fields(line, indices + 1, &wanted)?;
        }
    }
    let modal = Modal { mass, stiffness, damping, linear, angular };
    Ok(Flex { name, joints, nodes, located, modal, states })
}

impl Flex {
    /// The structure of a file with the locations of its nodes; its joints, of which 42 keeps the
    /// positions elsewhere, are left out.
    ///
    /// # Errors
    /// [`Fault::NoPositions`]; those of [`normalised`] and of [`Structure::checked`].
    pub fn structure(self) -> Result<Structure, StructureError> {
        let Some(nodes) = self.located.clone() else {
            let nodes = self.nodes.numbers.len() + self.joints.numbers.len();
            return Err(Fault::NoPositions { nodes }.into());
        };
        let shapes = self.rows((0..nodes.len()).map(|number| (false, number)));
        self.at(nodes, &shapes)
    }

    /// Shapes of some points, each a joint (true) or a node and its number: six rows for each, zeros where
    /// the file has none.
    #[must_use]
    pub fn rows(&self, points: impl Iterator<Item = (bool, usize)>) -> DMatrix<f64> {
        let points: Vec<_> = points.collect();
        let mut shapes = DMatrix::zeros(COORDINATES * points.len(), self.modal.mass.nrows());
        for (index, (is_joint, number)) in points.iter().enumerate() {
            let of = if *is_joint { &self.joints } else { &self.nodes };
            let Some(found) = of.numbers.iter().position(|n| n == number) else { continue };
            for (row, values) in of.shapes.get(found).into_iter().flatten().enumerate() {
                for (mode, value) in values.iter().enumerate() {
                    if let Some(element) = shapes.get_mut((COORDINATES * index + row, mode)) {
                        *element = *value;
                    }
                }
            }
        }
        shapes
    }

    /// The structure with some nodes and their shapes.
    ///
    /// # Errors
    /// Those of [`normalised`] and of [`Structure::checked`].
    pub fn at(&self, nodes: Vec<Node>, shapes: &DMatrix<f64>) -> Result<Structure, StructureError> {
        let (modes, shapes) = normalised(&self.modal, shapes)?;
        let structure = Structure {
            name: self.name.clone(),
            nodes,
            modes,
            shapes,
            mass: None,
            mass_matrix: None,
            residual: None,
            has_devices: None,
            initial: self.initial()?,
        };
        Ok(structure.checked()?)
    }
}

impl Flex {
    /// States of the mass-normalised modes, `turn^T M x` of those of the file, `x = turn eta`; none where
    /// all are zero.
    fn initial(&self) -> Result<Vec<[f64; 2]>, StructureError> {
        if self.states.iter().flatten().all(|state| *state == 0.0) {
            return Ok(Vec::new());
        }
        let size = self.modal.mass.nrows();
        let (_, turn) = normalised(&self.modal, &DMatrix::identity(size, size))?;
        let of_file = DMatrix::from_fn(size, 2, |mode, k| {
            self.states.get(mode).map_or(0.0, |state| state[k])
        });
        let states = turn.transpose() * &self.modal.mass * of_file;
        Ok(states.row_iter().map(|row| [row[0], row[1]]).collect())
    }
}

/// Nodes with the numbers of the model as names, and their positions.
fn located(lines: &mut Lines<'_>) -> Result<Vec<Node>, StructureError> {
    let count = lines.count("nodes", [1, MOST])?;
    let mut nodes: Vec<Node> = Vec::new();
    for _ in 0..count {
        let wanted = "number and location of a node";
        let line = lines.next(wanted)?;
        let fields = lines.fields(line, 4, wanted)?;
        let name = line.split_whitespace().next().unwrap_or_default().to_owned();
        if nodes.iter().any(|node| node.name == name) {
            return Err(lines.fault(Fault::NameTwice { name }));
        }
        let position = Vector3::from_iterator(fields.into_iter().skip(1));
        nodes.push(Node { name, position });
    }
    Ok(nodes)
}

/// Translation, then rotation.
fn points(
    lines: &mut Lines<'_>,
    what: &str,
    count: usize,
    modes: usize,
) -> Result<Points, StructureError> {
    let mut points = Points::default();
    for (part, first) in [("translation", 0), ("rotation", 3)] {
        lines.next(&format!("the heading of the {what}s' {part}"))?;
        for _ in 0..lines.count("elements", [0, lines.rest.len()])? {
            let bounds = [("mode", modes), (what, count), ("axis", 3)];
            let (place, value) = lines.element(bounds, "mode, point, axis, value")?;
            let index = points.numbers.iter().position(|n| *n == place[1]).unwrap_or_else(|| {
                points.numbers.push(place[1]);
                points.shapes.push(std::array::from_fn(|_| vec![0.0; modes]));
                points.numbers.len() - 1
            });
            let rows = points.shapes.get_mut(index);
            let row = rows.and_then(|rows| rows.get_mut(first + place[2]));
            if let Some(element) = row.and_then(|row| row.get_mut(place[0])) {
                *element = value;
            }
        }
    }
    Ok(points)
}

/// The elements of a matrix between modes that are not zero.
fn square(lines: &mut Lines<'_>, what: &str, modes: usize) -> Result<DMatrix<f64>, StructureError> {
    lines.next(&format!("the heading of the modal {what}"))?;
    let mut matrix = DMatrix::zeros(modes, modes);
    for _ in 0..lines.count("elements", [0, lines.rest.len()])? {
        let bounds = [("mode", modes), ("mode", modes)];
        let ([row, column], value) = lines.element(bounds, "row, column, value")?;
        if let Some(element) = matrix.get_mut((row, column)) {
            *element = value;
        }
    }
    Ok(matrix)
}

fn integrals(lines: &mut Lines<'_>, modes: usize) -> Result<Matrix3xX<f64>, StructureError> {
    lines.next("the heading of a momentum integral")?;
    let mut integrals = Matrix3xX::zeros(modes);
    for mut column in integrals.column_iter_mut() {
        column.copy_from_slice(&lines.numbers::<3>("x, y and z of a momentum integral")?);
    }
    Ok(integrals)
}

/// The lines of a file with their numbers.
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    fn fault(&self, fault: Fault) -> StructureError {
        fault.at(FileLocation::Line(self.number))
    }

    /// The next line that is not blank.
    fn next(&mut self, wanted: &str) -> Result<&'a str, StructureError> {
        loop {
            self.number += 1;
            if self.rest.is_empty() {
                return Err(self.fault(Fault::Ended { wanted: wanted.to_owned() }));
            }
            let end = self.rest.iter().position(|byte| *byte == b'\n');
            let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
            self.rest = rest.get(1..).unwrap_or_default();
            let Ok(text) = std::str::from_utf8(line) else {
                let found = String::from_utf8_lossy(line).chars().take(40).collect();
                return Err(self.fault(Fault::NotNumber { wanted: "UTF-8 text".into(), found }));
            };
            if !text.trim().is_empty() {
                return Ok(text);
            }
        }
    }

    /// So many finite numbers at the start of a line.
    fn fields(&self, line: &str, count: usize, wanted: &str) -> Result<Vec<f64>, StructureError> {
        let fields = line.split('!').next().unwrap_or_default().split_whitespace();
        let parsed = |text: &str| text.parse::<f64>().ok().filter(|value| value.is_finite());
        let numbers: Vec<f64> = fields.map_while(parsed).take(count).collect();
        if numbers.len() == count {
            return Ok(numbers);
        }
        let found = line.trim().chars().take(40).collect();
        Err(self.fault(Fault::NotNumber { wanted: wanted.to_owned(), found }))
    }

    fn numbers<const N: usize>(&mut self, wanted: &str) -> Result<[f64; N], StructureError> {
        let line = self.next(wanted)?;
        let mut numbers = [0.0; N];
        numbers.copy_from_slice(&self.fields(line, N, wanted)?);
        Ok(numbers)
    }

    /// The whole number that a line starts with.
    fn count(&mut self, what: &str, range: [usize; 2]) -> Result<usize, StructureError> {
        let line = self.next(&format!("the number of {what}"))?;
        let text = line.split('!').next().unwrap_or_default();
        let text = text.split_whitespace().next().unwrap_or_default();
        let Ok(found) = text.parse::<usize>() else {
            let wanted = format!("the number of {what}");
            return Err(self.fault(Fault::NotNumber { wanted, found: text.to_owned() }));
        };
        if (range[0]..=range[1]).contains(&found) {
            return Ok(found);
        }
        Err(self.fault(Fault::Number { what: what.to_owned(), found, range }))
    }

    /// Indices, each below its bound, and a value.
    fn element<const N: usize>(
        &mut self,
        bounds: [(&str, usize); N],
        wanted: &str,
    ) -> Result<([usize; N], f64), StructureError> {
        let line = self.next(wanted)?;
        let fields = self.fields(line, N + 1, wanted)?;
        let mut indices = [0; N];
        let words = line.split_whitespace();
        for ((index, word), (what, bound)) in indices.iter_mut().zip(words).zip(bounds) {
            let Ok(found) = word.parse::<usize>() else {
                let wanted = format!("the index of a {what}");
                return Err(self.fault(Fault::NotNumber { wanted, found: word.to_owned() }));
            };
            if found >= bound {
                let (what, range) = (
                    format!("as index of {} {what}", if what == "axis" { "an" } else { "a" }),
                    [0, bound.saturating_sub(1)],
                );
                return Err(self.fault(Fault::Number { what, found, range }));
            }
            *index = found;
        }
        Ok((indices, fields.last().copied().unwrap_or_default()))
    }
}
