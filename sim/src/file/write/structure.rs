//! `[structure]` as text: every node that the scenario uses and every mode, in SI units.

use std::fmt::Write as _;

use super::{Written, quoted, vector};
use crate::scenario::{ModalStructure, Scenario};

/// The table with its nodes and modes.
pub(super) fn write(out: &mut String, structure: &ModalStructure) -> Written {
    let ModalStructure { modes, nodes, points, coordinates, rates, .. } = structure;
    let name = |node: usize| nodes.get(node).map_or("", |node| node.name.as_str());
    writeln!(out, "\n[structure]\ncontains_devices = {}", structure.contains_devices)?;
    writeln!(out, "coordinates = {coordinates:?}\nrates = {rates:?}")?;
    for point in points {
        writeln!(out, "\n[[structure.point]]\nname = {}", quoted(&point.name))?;
        writeln!(out, "node = {}", quoted(name(point.node)))?;
    }
    for node in nodes {
        writeln!(out, "\n[[structure.node]]\nname = {}", quoted(&node.name))?;
        writeln!(out, "position = {}", vector(&node.position, "m"))?;
    }
    for (index, mode) in modes.iter().enumerate() {
        writeln!(out, "\n[[structure.mode]]\nfrequency = \"{:?} rad/s\"", mode.frequency)?;
        writeln!(out, "damping = {:?}", mode.damping)?;
        if index >= structure.massive().len() {
            writeln!(out, "residual = true")?;
        }
        writeln!(out, "linear_momentum = {:?}", mode.linear.as_slice())?;
        writeln!(out, "angular_momentum = {:?}", mode.angular.as_slice())?;
        for node in nodes {
            if let Some([x, y, z, rx, ry, rz]) = node.shapes.get(index) {
                writeln!(out, "\n[[structure.mode.shape]]\nnode = {}", quoted(&node.name))?;
                writeln!(out, "translation = [{x:?}, {y:?}, {z:?}]")?;
                writeln!(out, "rotation = [{rx:?}, {ry:?}, {rz:?}]")?;
            }
        }
    }
    Ok(())
}

/// The node of a device or platform; nothing on a rigid hub.
pub(in crate::file) fn node(out: &mut String, s: &Scenario, member: usize) -> Written {
    match s.structure.as_ref().and_then(|of| of.on_node.get(member)) {
        Some(node) => writeln!(out, "node = {}", quoted(node_name(s, *node))),
        None => Ok(()),
    }
}

/// The name of a node.
pub(super) fn node_name(s: &Scenario, node: usize) -> &str {
    let nodes = s.structure.as_ref().map(|structure| &structure.nodes);
    nodes.and_then(|nodes| nodes.get(node)).map_or("", |node| node.name.as_str())
}
