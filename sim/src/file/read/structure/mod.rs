//! `[structure]`: modes from a file, or written out as `[[structure.node]]` and `[[structure.mode]]`.
//!
//! Nodes that carry no device, are not recorded and take no wrench are left out of the scenario.

mod residual;

use std::cell::RefCell;
use std::f64::consts::TAU;
use std::path::Path;

use nalgebra::{DMatrix, Vector3};

use crate::file::diagnostic::Diagnostic;
use crate::file::document::Value;
use crate::file::{StructureReadError, keys::Keys, structure_from_file};
use crate::nearest::nearest;
use crate::scenario::{ModalStructure, RecordedPoint, StructureNode};
use crate::structure::{COORDINATES, MOST, Mode, Node, RigidMass, Structure as Modes};
use crate::units::{Measure, Plain};
use residual::OmittedModes;

/// A structure as a file gives it, and which of its nodes are used.
pub(super) struct Structure {
    modes: Modes,
    /// How many of the modes, at the end, are residual coordinates.
    written_residual: usize,
    /// What is wanted as residual coordinates.
    left_out: Option<OmittedModes>,
    used: RefCell<Vec<usize>>,
    contains_devices: bool,
    points: Vec<RecordedPoint>,
    coordinates: Vec<f64>,
    rates: Vec<f64>,
}

/// `[structure]`; nothing where it is missing or wrong, which has been reported.
pub(super) fn structure(root: &Keys<'_>, folder: &Path) -> Option<Structure> {
    let keys = root.table("structure")?;
    let (file, inline) = (keys.has("file"), keys.has("node") || keys.has("mode"));
    let read = match (file, inline) {
        (true, false) => of_file(&keys, folder),
        (false, true) => written_out(&keys),
        (true, true) => {
            let help = "remove `file`, or the nodes and modes";
            keys.error("file", "the modes are given twice: in a file and written out", help);
            None
        }
        (false, false) => {
            keys.missing("file", "file = \"modes.npz\"");
            None
        }
    };
    let written_residual = if inline { residual::written(&keys) } else { 0 };
    let selected = read.and_then(|modes| selected(&keys, modes, written_residual));
    let (selected, left_out) = selected.unzip();
    let contains = keys.boolean("contains_devices");
    let mut structure = Structure {
        modes: selected.unwrap_or_else(nothing),
        written_residual,
        left_out: left_out.flatten(),
        used: RefCell::default(),
        contains_devices: false,
        points: Vec::new(),
        coordinates: Vec::new(),
        rates: Vec::new(),
    };
    let known = !structure.modes.modes.is_empty();
    let contains = contains.or(structure.modes.has_devices);
    if contains.is_none() && root.has("device") && known {
        keys.missing("contains_devices", "contains_devices = false");
    }
    structure.contains_devices = contains.unwrap_or(false);
    let [coordinates, rates] = structure.modes.states();
    structure.coordinates = list(&keys, "coordinates").unwrap_or(coordinates);
    structure.rates = list(&keys, "rates").unwrap_or(rates);
    let points = points(&keys, &structure, known);
    structure.points = points;
    keys.finish();
    // Without modes an error has been reported, and what names a node is not looked at.
    known.then_some(structure)
}

fn nothing() -> Modes {
    Modes {
        name: String::new(),
        nodes: Vec::new(),
        modes: Vec::new(),
        shapes: DMatrix::zeros(0, 0),
        mass: None,
        mass_matrix: None,
        residual: None,
        has_devices: None,
        initial: Vec::new(),
    }
}

/// The name of the file, from the scenario's folder.
pub(super) fn file(root: &Keys<'_>, folder: &Path) -> Option<String> {
    let keys = root.table("structure")?;
    if keys.has("file") { Some(keys.file("file", folder)?.1) } else { None }
}

/// The file, with every error of a table that it is.
fn of_file(keys: &Keys<'_>, folder: &Path) -> Option<Modes> {
    let (path, _) = keys.file("file", folder)?;
    match structure_from_file(&path) {
        Ok(structure) => Some(structure),
        Err(StructureReadError::File(error)) => {
            keys.error("file", error.to_string(), "");
            None
        }
        Err(StructureReadError::Table(found)) => {
            let mut reports = keys.reports().borrow_mut();
            let first = reports.sources.len();
            reports.sources.extend(found.sources);
            reports.all.extend(found.all.into_iter().map(|mut diagnostic: Diagnostic| {
                if let Some(span) = &mut diagnostic.span {
                    span.source += first;
                }
                diagnostic
            }));
            None
        }
    }
}

/// `[[structure.node]]` and `[[structure.mode]]`.
fn written_out(keys: &Keys<'_>) -> Option<Modes> {
    for key in ["node", "mode"] {
        if !keys.has(key) {
            keys.missing(key, &format!("[[structure.{key}]]"));
        }
    }
    let before = keys.errors();
    let tables = keys.tables("node").into_iter().map(|keys| {
        if !keys.has("name") {
            keys.missing("name", "name = \"tip\"");
        }
        let name = keys.text("name").map(str::to_owned);
        if !keys.has("position") {
            keys.missing("position", "position = \"0, 0, 1 m\"");
        }
        let position = keys.vector("position", Measure::LENGTH);
        keys.finish();
        Some(Node { name: name?, position: position? })
    });
    let nodes: Option<Vec<Node>> = tables.collect();
    let tables = keys.tables("mode");
    let (nodes, count) = (nodes.filter(|_| keys.errors() == before)?, tables.len());
    let mut shapes = DMatrix::zeros(COORDINATES * nodes.len(), count);
    let mut modes = Vec::new();
    for (column, keys) in tables.iter().enumerate() {
        modes.push(mode(keys));
        for keys in keys.tables("shape") {
            if let Some((row, shape)) = shape(&keys, &nodes) {
                let mut column = shapes.column_mut(column);
                column.rows_mut(COORDINATES * row, COORDINATES).copy_from_slice(&shape);
            }
        }
        keys.finish();
    }
    let modes = modes.into_iter().collect::<Option<Vec<_>>>()?;
    let checked = Modes { nodes, modes, shapes, ..nothing() }.checked();
    checked.map_err(|fault| keys.error("mode", fault.to_string(), "")).ok()
}

/// A node's number, and translation and rotation of a mode there.
fn shape(keys: &Keys<'_>, nodes: &[Node]) -> Option<(usize, [f64; COORDINATES])> {
    if !keys.has("node") {
        keys.missing("node", "node = \"tip\"");
    }
    let name = keys.text("node");
    let [translation, rotation] = ["translation", "rotation"].map(|key| three(keys, key));
    keys.finish();
    let found = nodes.iter().position(|node| Some(node.name.as_str()) == name);
    if let (Some(name), None) = (name, found) {
        keys.error("node", no_node(name), &known_nodes(nodes, name));
    }
    let [[a, b, c], [d, e, f]] = [translation, rotation];
    Some((found?, [a, b, c, d, e, f]))
}

/// Three numbers; zeros where the key is missing or wrong.
fn three(keys: &Keys<'_>, key: &str) -> [f64; 3] {
    keys.node(key).and_then(|_| keys.numbers::<3>(key)).unwrap_or_default()
}

fn no_node(name: &str) -> String {
    format!("no node of the structure is named `{name}`")
}

/// The nearest name, or some.
fn known_nodes(nodes: &[Node], name: &str) -> String {
    let names = nodes.iter().map(|node| node.name.as_str());
    if let Some(near) = nearest(name, names.clone()).first() {
        return format!("did you mean `{near}`?");
    }
    let some: Vec<_> = names.take(12).collect();
    let dots = if nodes.len() > some.len() { ", .." } else { "" };
    format!("there are {}{dots}", some.join(", "))
}

fn mode(keys: &Keys<'_>) -> Option<Mode> {
    if !keys.has("frequency") {
        keys.missing("frequency", "frequency = \"12 Hz\"");
    }
    let damping = keys.number("damping").unwrap_or(0.0);
    let [linear, angular] = ["linear_momentum", "angular_momentum"].map(|key| three(keys, key));
    let _ = keys.boolean("residual");
    let frequency = angular_frequency(keys, "frequency");
    Some(Mode { frequency: frequency?, damping, linear: linear.into(), angular: angular.into() })
}

/// A frequency in Hz, or an angular one in rad/s; in rad/s.
fn angular_frequency(keys: &Keys<'_>, key: &str) -> Option<f64> {
    let quantity = keys.node(key).and_then(|_| keys.any_quantity(key))?;
    let per_radian = if quantity.is(Measure::FREQUENCY) { TAU } else { 1.0 };
    if let ([value], true) = (
        quantity.values.as_slice(),
        quantity.is(Measure::FREQUENCY) || quantity.is(Measure::ANGULAR_RATE),
    ) {
        return Some(per_radian * value);
    }
    let message = format!("`{}.{key}` is no frequency", keys.path());
    keys.error(key, message, "write one number in Hz, or an angular frequency in rad/s");
    None
}

/// The modes that are kept, with the damping of the scenario and the residual coordinates that are
/// written after them; and what the others leave.
fn selected(
    keys: &Keys<'_>,
    mut structure: Modes,
    residual: usize,
) -> Option<(Modes, Option<OmittedModes>)> {
    let massive = structure.modes.len().saturating_sub(residual);
    let most = u32::try_from(massive).unwrap_or(u32::MAX);
    let count = if keys.has("modes") { Some(keys.count("modes", 1, most)?) } else { None };
    let limit = if keys.has("frequency_limit") {
        Some(angular_frequency(keys, "frequency_limit")?)
    } else {
        None
    };
    // By rising frequency, of equal ones the first.
    let mut order: Vec<usize> = (0..massive).collect();
    let frequency = |mode: &usize| structure.modes.get(*mode).map_or(0.0, |mode| mode.frequency);
    order.sort_by(|a, b| frequency(a).total_cmp(&frequency(b)));
    if let Some(limit) = limit {
        let lowest = order.first().map_or(0.0, frequency);
        order.retain(|mode| frequency(mode) <= limit);
        if order.is_empty() {
            let hertz = lowest / TAU;
            let message = format!("the lowest mode is at {} Hz, above this limit", Plain(hertz));
            keys.error("frequency_limit", message, "raise it, or remove `[structure]`");
            return None;
        }
    }
    order.truncate(count.map_or(MOST, |count| usize::try_from(count).unwrap_or(MOST)));
    order.extend(massive..structure.modes.len());
    order.sort_unstable();
    let left_out = residual::wanted(keys, &structure, &order);
    structure.keep(&order);
    damped(keys, &mut structure, residual)?;
    Some((structure, left_out))
}

/// `damping`: one ratio for all modes, or one for each.
fn damped(keys: &Keys<'_>, structure: &mut Modes, residual: usize) -> Option<()> {
    if !keys.has("damping") {
        return Some(());
    }
    let ratios = list(keys, "damping")?;
    let modes = structure.modes.len().saturating_sub(residual);
    if ratios.len() != 1 && ratios.len() != modes {
        let message = format!("{} damping ratios for {modes} modes", ratios.len());
        keys.error("damping", message, "write one for all modes, or one for each");
        return None;
    }
    if let Some(bad) = ratios.iter().find(|ratio| !(0.0..1.0).contains(*ratio)) {
        let message = format!("a damping ratio of {} is outside 0 to below 1", Plain(*bad));
        keys.error("damping", message, "write the share of critical damping: 0.005");
        return None;
    }
    for (mode, ratio) in structure.modes.iter_mut().take(modes).zip(ratios.iter().cycle()) {
        mode.damping = *ratio;
    }
    Some(())
}

/// A number or a list of numbers; nothing where the key is missing or wrong.
fn list(keys: &Keys<'_>, key: &str) -> Option<Vec<f64>> {
    let node = keys.node(key)?;
    let number = |value: &Value| match value {
        Value::Number(value, _) if value.is_finite() => Some(*value),
        _ => None,
    };
    let numbers = match &node.value {
        Value::List(list) => list.iter().map(|node| number(&node.value)).collect(),
        value => number(value).map(|number| vec![number]),
    };
    if numbers.is_none() {
        let message = format!("`{}.{key}` is no number and no list of finite numbers", keys.path());
        keys.error(key, message, "write numbers without a unit, in SI: `[0.01, 0]`");
    }
    numbers
}

/// `[[structure.point]]`: nodes whose motion is recorded, under a name for their columns.
fn points(keys: &Keys<'_>, structure: &Structure, known: bool) -> Vec<RecordedPoint> {
    let tables = keys.tables("point").into_iter().filter_map(|keys| {
        if !keys.has("name") {
            keys.missing("name", "name = \"camera\"");
        }
        let name = keys.text("name");
        let (key, node) = match keys.text("node") {
            Some(node) => ("node", Some(node)),
            None => ("name", name),
        };
        keys.finish();
        let node = node.filter(|_| known).and_then(|node| structure.node(&keys, key, node));
        Some(RecordedPoint { name: name?.to_owned(), node: node? })
    });
    tables.collect()
}

impl Structure {
    /// A node by its name, in the numbers of the scenario; reports where there is none.
    pub(super) fn node(&self, keys: &Keys<'_>, key: &str, name: &str) -> Option<usize> {
        let used = self.used(name);
        if used.is_none() {
            keys.error(key, no_node(name), &known_nodes(&self.modes.nodes, name));
        }
        used
    }

    /// A node by its name, in the numbers of the scenario, which from then on has it.
    pub(super) fn used(&self, name: &str) -> Option<usize> {
        let node = self.modes.node(name).ok()?;
        let mut used = self.used.borrow_mut();
        let known = used.iter().position(|of| *of == node);
        Some(known.unwrap_or_else(|| {
            used.push(node);
            used.len() - 1
        }))
    }

    pub(super) fn has_node(&self, name: &str) -> bool {
        self.modes.node(name).is_ok()
    }

    /// The name of a node, for messages.
    pub(super) fn an_example(&self) -> &str {
        self.modes.nodes.first().map_or("", |node| node.name.as_str())
    }

    /// The position of a node of the scenario, m.
    pub(super) fn position(&self, node: usize) -> Option<Vector3<f64>> {
        let index = *self.used.borrow().get(node)?;
        self.modes.nodes.get(index).map(|node| node.position)
    }

    /// Mass of the file.
    pub(super) fn mass(&self) -> Option<&RigidMass> {
        self.modes.mass.as_ref()
    }

    /// The structure of the scenario, with the node of each device and platform.
    pub(super) fn modal(self, keys: &Keys<'_>, on_node: Vec<usize>) -> ModalStructure {
        let mut used = self.used.into_inner();
        if used.is_empty() {
            // A structure has a node: the first one, which nothing is on.
            used.push(0);
        }
        let nodes = used.iter().filter_map(|index| {
            let Node { name, position } = self.modes.nodes.get(*index)?.clone();
            let rows = self.modes.shapes.rows(COORDINATES * index, COORDINATES);
            let column = |mode: usize| std::array::from_fn(|row| rows[(row, mode)]);
            let shapes = (0..rows.ncols()).map(column).collect();
            Some(StructureNode { name, position, shapes })
        });
        let mut structure = ModalStructure {
            nodes: nodes.collect(),
            modes: self.modes.modes,
            residual: self.written_residual,
            on_node,
            contains_devices: self.contains_devices,
            points: self.points,
            coordinates: self.coordinates,
            rates: self.rates,
        };
        if let Some(left_out) = &self.left_out
            && let Err(error) = left_out.add(&mut structure, &used)
        {
            let help = "remove `residual_flexibility`, or the devices from the model";
            keys.error("structure", format!("residual flexibility: {error}"), help);
        }
        structure
    }
}
