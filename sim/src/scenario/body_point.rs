//! [`BodyPoint`]: a point of the hub or of a device's body, whose motion is recorded; and what is wrong with one.

use nalgebra::Vector3;

use super::check::{ScenarioError, range};
use super::reserved::is_reserved;
use super::{Scenario, Target};
use crate::names::{NameFault, column_name_fault};

/// A point that moves with a body and whose motion is recorded: an accelerometer, an instrument.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPoint {
    /// The name of its columns: lower case, digits, underscores.
    pub name: String,
    /// The hub, or the child body of a joint.
    pub body: Target,
    /// From B, or from the body's origin, expressed in the body's axes, m.
    pub position: Vector3<f64>,
}

impl Scenario {
    /// What is wrong with the points of bodies.
    pub(super) fn check_points(&self) -> Vec<ScenarioError> {
        let mut errors = Vec::new();
        if let (Some(_), Some(point)) = (&self.structure, self.points.first()) {
            let message = "points of a flexible structure are its nodes; write it as \
                           `[[structure.point]]`, with a `node`";
            return vec![range(&format!("point.{}", point.name), message.to_owned())];
        }
        let joints = self.joints().count();
        for (index, BodyPoint { name, body, position }) in self.points.iter().enumerate() {
            let earlier = self.points.iter().take(index).any(|other| other.name == *name);
            let message = "choose another `name`";
            errors.extend(self.point_name_error(("point", name), earlier, message));
            let key = format!("point.{name}.on");
            match body {
                Target::Hub => {}
                Target::Joint(joint) if *joint < joints => {}
                Target::Joint(joint) => {
                    errors.push(range(&key, format!("joint {joint} of {joints}")));
                }
                Target::Node(_) => {
                    errors.push(range(&key, "a node is a `[[structure.point]]`".to_owned()));
                }
            }
            if !position.iter().all(|component| component.is_finite()) {
                let message = "the position is not finite".to_owned();
                errors.push(range(&format!("point.{name}.position"), message));
            }
        }
        errors
    }

    /// What is wrong with the name of a recorded point in a list of a scenario file.
    pub(super) fn point_name_error(
        &self,
        (list, name): (&str, &str),
        earlier: bool,
        remedy: &str,
    ) -> Option<ScenarioError> {
        let key = format!("{list}.{name}.name");
        match column_name_fault(name) {
            Some(fault @ NameFault::Column) => {
                return Some(range(&key, format!("{fault}; {remedy}")));
            }
            Some(fault) => return Some(range(&key, fault.to_string())),
            None => {}
        }
        let known = earlier || is_reserved(name) || self.names.iter().any(|device| device == name);
        known.then(|| {
            let message =
                format!("`{name}` names other columns, of a device, a point or a group; {remedy}");
            range(&key, message)
        })
    }
}
