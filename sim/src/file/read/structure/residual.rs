//! [`OmittedModes`]: the static response of modes that a scenario leaves out and of those that its file
//! never had, as residual coordinates.

use nalgebra::{DMatrix, DVector};
use precess_dynamics::{ListedModes, ModalMount, ModalPoint, Modes as ListModes, ModesError};

use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::scenario::{ModalStructure, StructureNode};
use crate::structure::{COORDINATES, Mode, Structure};

/// The damping ratio of residual coordinates that no key gives: their vibration is about as fast as
/// the first modes left out, and takes part in none that is looked at.
const DAMPING: f64 = 0.05;

/// What residual coordinates stand for.
pub(super) struct OmittedModes {
    /// Residual flexibility of the file, for all its nodes.
    flexibility: Option<DMatrix<f64>>,
    /// Angular frequency, rad/s, and shapes of each mode left out, for all nodes.
    modes: Vec<(f64, DVector<f64>)>,
    /// Their damping ratio.
    damping: f64,
}

/// How many of the modes written out, at the end, are residual coordinates.
pub(super) fn written(keys: &Keys<'_>) -> usize {
    let Some(node) = keys.node("mode") else { return 0 };
    let Value::List(list) = &node.value else { return 0 };
    let marked = |value: &Value| match value {
        Value::Table(table) => table
            .get("residual")
            .is_some_and(|entry| matches!(entry.node.value, Value::Boolean(true))),
        _ => false,
    };
    let count = list.iter().rev().take_while(|node| marked(&node.value)).count();
    if list.iter().filter(|node| marked(&node.value)).count() != count {
        let message = "a residual coordinate is before a mode";
        keys.error("mode", message, "write the modes with `residual = true` last");
    }
    count
}

/// `residual_flexibility` and `residual_damping`: what the modes that are not kept leave.
pub(super) fn wanted(
    keys: &Keys<'_>,
    structure: &Structure,
    kept: &[usize],
) -> Option<OmittedModes> {
    let wanted = keys.boolean("residual_flexibility").unwrap_or(false);
    let damping = keys.number("residual_damping");
    if !wanted {
        if damping.is_some() {
            let help = "write `residual_flexibility = true`, or remove it";
            keys.error("residual_damping", "there are no residual coordinates", help);
        }
        return None;
    }
    let damping = damping.unwrap_or(DAMPING);
    if !(0.0..1.0).contains(&damping) {
        let message = format!("a damping ratio of {damping} is outside 0 to below 1");
        keys.error("residual_damping", message, "write the share of critical damping: 0.05");
        return None;
    }
    let left = structure.modes.iter().enumerate().filter(|(index, _)| !kept.contains(index));
    let shapes = |index: usize| structure.shapes.column(index).into_owned();
    let modes: Vec<_> = left.map(|(index, mode)| (mode.frequency, shapes(index))).collect();
    let flexibility = structure.residual.clone();
    if modes.is_empty() && flexibility.is_none() {
        let message = "the file has no residual flexibility, and no mode is left out";
        let help = "leave modes out by `modes` or `frequency_limit`, or remove it";
        keys.error("residual_flexibility", message, help);
        return None;
    }
    Some(OmittedModes { flexibility, modes, damping })
}

impl OmittedModes {
    /// Adds the residual coordinates to a structure whose nodes have these numbers in the file: the
    /// static response at all nodes to forces on those that carry devices.
    pub(super) fn add(
        &self,
        structure: &mut ModalStructure,
        in_file: &[usize],
    ) -> Result<(), ModesError> {
        let mounts = structure.mounts();
        let others = (0..structure.nodes.len()).filter(|node| !mounts.contains(node));
        let order: Vec<usize> = mounts.iter().copied().chain(others).collect();
        let rows: Vec<usize> = order
            .iter()
            .filter_map(|node| in_file.get(*node))
            .flat_map(|node| COORDINATES * node..COORDINATES * (node + 1))
            .collect();
        let columns = rows.get(..COORDINATES * mounts.len()).unwrap_or_default();
        let compliance = self.compliance(&rows, columns);

        let empty = |node: &usize| {
            structure.nodes.get(*node).map(|node| ModalPoint::<ListedModes> {
                position: node.position,
                translation: Vec::new(),
                rotation: Vec::new(),
            })
        };
        let mut points: Vec<_> = order.iter().skip(mounts.len()).filter_map(empty).collect();
        let on_mounts = order.iter().take(mounts.len()).filter_map(empty);
        let mut modes = ListModes {
            frequencies: Vec::new(),
            damping: Vec::new(),
            linear: Vec::new(),
            angular: Vec::new(),
            mounts: on_mounts.map(|point| ModalMount { point, contained: None }).collect(),
        };
        let count = modes.add_residual(&mut points, &compliance)?;

        let found = modes.mounts.iter().map(|mount| &mount.point).chain(&points);
        for (node, point) in order.iter().zip(found) {
            let Some(StructureNode { shapes, .. }) = structure.nodes.get_mut(*node) else {
                continue;
            };
            let pairs = point.translation.iter().zip(&point.rotation);
            shapes.extend(pairs.map(|(u, v)| [u.x, u.y, u.z, v.x, v.y, v.z]));
        }
        let damping = self.damping;
        let coordinates = modes.frequencies.iter().zip(modes.linear.iter().zip(&modes.angular));
        structure.modes.extend(coordinates.map(|(frequency, (linear, angular))| Mode {
            frequency: *frequency,
            damping,
            linear: *linear,
            angular: *angular,
        }));
        structure.residual += count;
        for values in [&mut structure.coordinates, &mut structure.rates] {
            values.extend(std::iter::repeat_n(0.0, count));
        }
        Ok(())
    }

    /// The static response, row by row.
    fn compliance(&self, rows: &[usize], columns: &[usize]) -> Vec<f64> {
        let entry = |row: usize, column: usize| {
            let given = self.flexibility.as_ref().map_or(0.0, |all| all[(row, column)]);
            let of_modes = self
                .modes
                .iter()
                .map(|(frequency, shape)| shape[row] / frequency * (shape[column] / frequency));
            of_modes.fold(given, |sum, share| sum + share)
        };
        rows.iter().flat_map(|row| columns.iter().map(move |column| entry(*row, *column))).collect()
    }
}
