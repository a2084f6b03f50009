//! [`Columns`]: the quantities of a run by name, with unit, frame and meaning, and the selection of
//! those that are recorded.
//!
//! A name in a selection is that of a column (`omega_x`), of a vector (`omega`), of a device
//! (`cmg1`: all but its loads) or of a group (`position`, `loads`, `cmg1.loads`). Loads, and the rotation
//! since the start, are recorded only where they are selected. `time` always comes first; the others keep their order here,
//! whatever the order of the selection.

mod control;
mod disturbances;
mod friction;
mod orbit;
mod points;
mod quantity;
mod structure;

use precess_dynamics::kind::JointInfo;

pub(crate) use control::ControlQuantity;
pub(crate) use quantity::{Quantity, Source};

use super::error::RecordError;
use super::load_columns::{of_carried, of_load, of_mount};
use crate::nearest::nearest;
use crate::scenario::{Format, Scenario};

/// Angles of three turns, about z, y and x in this order, from axes to those of B; and the axis of each.
const ROLL_PITCH_YAW: [(&str, &str); 3] =
    [("roll", "x, the last"), ("pitch", "y, the second"), ("yaw", "z, the first")];

/// A recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name: `cmg1.gamma_o`.
    pub name: String,
    /// Its unit; `1` of a pure number.
    pub unit: &'static str,
    /// The axes that it is a component in: `N`, `B`, `cmg1.wheel`; none of a scalar.
    pub frame: Option<String>,
    /// What it is.
    pub meaning: String,
    /// The group that it belongs to: `omega`, `cmg1`, `cmg1.loads`.
    pub group: String,
    /// The vector that it is a component of: `omega`, `cmg1.mount.force`.
    pub vector: Option<String>,
    /// What is computed.
    pub(crate) quantity: Quantity,
}

/// Columns in order, `time` first.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns(Vec<Column>);

impl Columns {
    /// Every column that a scenario has.
    #[must_use]
    pub fn all(scenario: &Scenario) -> Self {
        let mut columns = Vec::new();
        hub(&mut columns);
        orbit::columns(&mut columns, scenario);
        for (joint, (_, name, info)) in scenario.joints().enumerate() {
            of_joint(&mut columns, name, joint, info);
            friction::column(&mut columns, scenario, name, (joint, info));
        }
        structure::columns(&mut columns, scenario);
        points::columns(&mut columns, scenario);
        disturbances::columns(&mut columns, scenario);
        control::columns(&mut columns, scenario);
        totals(&mut columns);
        for (index, (name, member)) in scenario.members().enumerate() {
            of_mount(&mut columns, (index, name), member.on().and_then(|on| scenario.body_of(on)));
            let joints = scenario.joints().enumerate();
            for (joint, (.., info)) in joints.filter(|(_, (device, ..))| *device == index) {
                // Of a platform, not the five bodies without mass.
                if member.device().is_some() || info.tip {
                    of_load(&mut columns, name, &format!("{name}.loads"), joint, info);
                }
            }
            if member.platform().is_some() {
                of_carried(&mut columns, (index, name));
            }
        }
        Self(columns)
    }

    /// The groups that a scenario records if it selects no columns.
    pub(crate) fn default_groups(scenario: &Scenario) -> Vec<String> {
        let Self(all) = Self::all(scenario);
        let own =
            all.into_iter().filter(|c| c.quantity != Quantity::Time && c.quantity.is_default());
        let mut groups: Vec<_> = own.map(|column| column.group).collect();
        groups.dedup();
        groups
    }

    /// The columns that a scenario records: those it selects, or all that are recorded by default, and the
    /// quantities of its requirements. With an MCAP file position, attitude, coordinates and rates, too: its frames are
    /// computed from them.
    ///
    /// # Errors
    ///
    /// [`RecordError::UnknownColumn`] with the nearest names.
    pub fn from_scenario(scenario: &Scenario) -> Result<Self, RecordError> {
        let Self(all) = Self::all(scenario);
        let selected = &scenario.output.columns;
        let frames = scenario.output.formats.contains(&Format::Mcap);
        let is_own = |quantity: &Quantity| {
            (selected.is_empty() && quantity.is_default()) || (frames && quantity.is_of_frames())
        };
        let mut taken: Vec<bool> = all.iter().map(|column| is_own(&column.quantity)).collect();
        let required = scenario.requirements.iter().map(|requirement| &requirement.quantity);
        for name in selected.iter().chain(required) {
            let mut known = false;
            for (column, taken) in all.iter().zip(&mut taken) {
                if column.is_named(name) {
                    (known, *taken) = (true, true);
                }
            }
            if !known {
                return Err(unknown(name, &all));
            }
        }
        if let Some(time) = taken.first_mut() {
            *time = true;
        }
        Ok(Self(all.into_iter().zip(taken).filter_map(|(c, taken)| taken.then_some(c)).collect()))
    }

    /// The columns in order.
    #[must_use]
    pub fn as_slice(&self) -> &[Column] {
        &self.0
    }
}

impl IntoIterator for Columns {
    type Item = Column;
    type IntoIter = std::vec::IntoIter<Column>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl Column {
    /// Whether a name of a selection includes it.
    fn is_named(&self, name: &str) -> bool {
        self.name == name
            || self.group == name
            || self.vector.as_deref() == Some(name)
            || (name == "loads" && self.quantity.is_load())
    }
}

/// The quantities that are integrated, with name and unit: of a hub, joints, each with the name of its device, and modes.
pub(crate) fn state_quantities<'a>(
    joints: impl Iterator<Item = (&'a str, &'static JointInfo)>,
    modes: usize,
) -> Vec<(String, Quantity, &'static str)> {
    let mut columns = Vec::new();
    hub(&mut columns);
    for (joint, (device, info)) in joints.enumerate() {
        of_joint(&mut columns, device, joint, info);
    }
    structure::modal(&mut columns, modes);
    let state = columns.into_iter().filter(|column| column.quantity.is_state());
    state.map(|column| (column.name, column.quantity, column.unit)).collect()
}

/// The indices of a quantity's columns: one by its name, or those of a vector.
pub(crate) fn quantity(columns: &[Column], name: &str) -> Result<Vec<usize>, RecordError> {
    let indices = |is: &dyn Fn(&Column) -> bool| -> Vec<usize> {
        columns.iter().enumerate().filter(|(_, column)| is(column)).map(|(i, _)| i).collect()
    };
    let one = indices(&|column| column.name == name);
    if !one.is_empty() {
        return Ok(one);
    }
    let three = indices(&|column| column.vector.as_deref() == Some(name));
    if !three.is_empty() {
        return Ok(three);
    }
    if columns.iter().any(|column| column.group == name) {
        return Err(RecordError::NoQuantity { name: name.to_owned() });
    }
    Err(unknown(name, columns))
}

fn unknown(name: &str, columns: &[Column]) -> RecordError {
    let names = columns.iter().flat_map(|column| {
        [Some(column.name.as_str()), Some(column.group.as_str()), column.vector.as_deref()]
    });
    let names = names.flatten().chain(["loads"]);
    RecordError::UnknownColumn { name: name.to_owned(), nearest: nearest(name, names) }
}

fn hub(columns: &mut Vec<Column>) {
    scalar(columns, "time", "time", "s", "time since the start of the run", Quantity::Time);
    let n = [
        (Quantity::Position as fn(usize) -> Quantity, "position", "m", "position of B"),
        (Quantity::Velocity, "velocity", "m/s", "inertial velocity of B"),
        (Quantity::HubAcceleration, "acceleration", "m/s²", "inertial acceleration of B"),
    ];
    for (quantity, name, unit, meaning) in n {
        vector(columns, name, name, unit, "N", meaning, quantity);
    }
    for index in 0..4 {
        let meaning = format!("attitude of B with respect to N: Euler parameter {index}");
        scalar(
            columns,
            &format!("q{index}"),
            "attitude",
            "1",
            &meaning,
            Quantity::Quaternion(index),
        );
    }
    for axis in 0..3 {
        columns.push(Column {
            name: format!("sigma_{}", axis + 1),
            unit: "1",
            frame: None,
            meaning: format!("the same: modified Rodrigues parameter {}", axis + 1),
            group: "attitude".to_owned(),
            vector: Some("sigma".to_owned()),
            quantity: Quantity::Sigma(axis),
        });
    }
    for (index, (name, turn)) in ROLL_PITCH_YAW.into_iter().enumerate() {
        let meaning = format!("{name} of B from N: the turn about {turn} of three");
        scalar(columns, name, "euler", "rad", &meaning, Quantity::EulerAngle(index));
    }
    let rotation = "rotation vector of B from its reference attitude";
    vector(columns, "rotation", "rotation", "rad", "B", rotation, Quantity::HubRotation);
    let b = [
        (Quantity::Omega as fn(usize) -> Quantity, "omega", "rad/s", "angular velocity of the hub"),
        (Quantity::OmegaDot, "omega_dot", "rad/s²", "angular acceleration of the hub"),
    ];
    for (quantity, name, unit, meaning) in b {
        vector(columns, name, name, unit, "B", meaning, quantity);
    }
}

fn of_joint(columns: &mut Vec<Column>, device: &str, joint: usize, info: &JointInfo) {
    let [coordinate, rate, acceleration, motor] = info.units();
    let body = info.body;
    let torque = if info.slides { "force" } else { "torque" };
    let four = [
        (
            info.coordinate,
            coordinate,
            format!("coordinate of the {body}"),
            Quantity::Coordinate(joint),
        ),
        (info.rate, rate, format!("rate of the {body}"), Quantity::Rate(joint)),
        (
            info.acceleration,
            acceleration,
            format!("acceleration of the {body}"),
            Quantity::JointAcceleration(joint),
        ),
        (
            info.motor,
            motor,
            format!(
                "motor {torque} on the {body}; where its motion is prescribed, the one this needs"
            ),
            Quantity::Torque(joint),
        ),
    ];
    for (name, unit, meaning, quantity) in four {
        scalar(columns, &format!("{device}.{name}"), device, unit, &meaning, quantity);
    }
}

fn totals(columns: &mut Vec<Column>) {
    let three = [
        ("energy", "kinetic energy, and potential energy of gravity and springs", Quantity::Energy),
        ("work", "work of all other sources since the start", Quantity::Work),
        ("energy_lost", "energy lost in brakes since the start", Quantity::Lost),
    ];
    for (name, meaning, quantity) in three {
        scalar(columns, name, "energy", "J", meaning, quantity);
    }
    let two = [
        (Quantity::Linear as fn(usize) -> Quantity, "linear_momentum", "kg m/s", "linear momentum"),
        (
            Quantity::Angular,
            "angular_momentum",
            "kg m²/s",
            "angular momentum about the inertial origin",
        ),
    ];
    for (quantity, name, unit, meaning) in two {
        vector(columns, name, "momentum", unit, "N", meaning, quantity);
    }
}

fn scalar(
    columns: &mut Vec<Column>,
    name: &str,
    group: &str,
    unit: &'static str,
    meaning: &str,
    quantity: Quantity,
) {
    columns.push(Column {
        name: name.to_owned(),
        unit,
        frame: None,
        meaning: meaning.to_owned(),
        group: group.to_owned(),
        vector: None,
        quantity,
    });
}

pub(super) fn vector(
    columns: &mut Vec<Column>,
    base: &str,
    group: &str,
    unit: &'static str,
    frame: &str,
    meaning: &str,
    quantity: impl Fn(usize) -> Quantity,
) {
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        columns.push(Column {
            name: format!("{base}_{letter}"),
            unit,
            frame: Some(frame.to_owned()),
            meaning: format!("{meaning}, {letter}"),
            group: group.to_owned(),
            vector: Some(base.to_owned()),
            quantity: quantity(axis),
        });
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::scenario::RESERVED_NAMES;

    #[test]
    fn names_of_columns_that_every_result_has_are_reserved() {
        let mut columns = Vec::new();
        hub(&mut columns);
        structure::modal(&mut columns, 1);
        totals(&mut columns);
        let names = columns.into_iter().flat_map(|of| [Some(of.name), Some(of.group), of.vector]);
        // Of a scenario with a central body.
        let others = ["loads".to_owned(), "orbit".to_owned()];
        let names: BTreeSet<_> = names.flatten().chain(others).collect();
        assert_eq!(names, RESERVED_NAMES.map(str::to_owned).into());
    }
}
