//! [`SourcePlace`]: the body that a source acts on, and its point and axes there, from what the source names.

use nalgebra::{Matrix3, Vector3};

use super::{Scenario, members};
use crate::disturbance::{Disturbance, JointAxes, SourceTarget, sheet_axes};

/// Where a source acts: force `R f` at the point, moment `R m` about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourcePlace {
    /// The body.
    pub body: SourceBody,
    /// R. Columns: the data sheet's axes, expressed in those of the body, or of its parent body.
    pub axes: Matrix3<f64>,
    /// From B, the mount, the node or the body's origin, in the body's axes, m.
    pub point: Vector3<f64>,
    /// Whether the axes are those of the parent body of a joint, which does not turn with the body.
    pub of_parent: bool,
}

/// A body that a source acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceBody {
    /// The hub, in B.
    Hub,
    /// A mount of a flexible structure, by its number in the library; its axes turn with it.
    Mount(usize),
    /// A node of the structure, in B.
    Node(usize),
    /// The child body of a joint.
    Joint(usize),
}

impl Scenario {
    /// Where a source acts; none of one that names what is not there.
    #[must_use]
    pub fn source_place(&self, of: &Disturbance) -> Option<SourcePlace> {
        let sheet = sheet_axes(of.spin_axis);
        let place = |body: SourceBody, axes: Matrix3<f64>, point: Vector3<f64>| {
            Some(SourcePlace { body, axes, point, of_parent: false })
        };
        match of.on {
            SourceTarget::Hub { axes } => place(SourceBody::Hub, axes, of.point),
            SourceTarget::Node { node, axes } => {
                self.structure.as_ref()?.nodes.get(node)?;
                place(SourceBody::Node(node), axes, of.point)
            }
            SourceTarget::Joint { joint, axes } => {
                let (.., info) = self.joints().nth(joint)?;
                // A rotor that is the same from every angle has the axes of its parent body.
                let of_parent = axes == JointAxes::Parent && !info.slides && !info.ignorable;
                let place = place(SourceBody::Joint(joint), sheet, of.point)?;
                Some(SourcePlace { of_parent, ..place })
            }
            SourceTarget::Mount(member) => {
                let own = *members(&self.devices).get(member)?;
                let axes = own.mount() * sheet;
                let origin = Vector3::from(own.bodies().first()?.origin);
                let point = origin + own.mount() * of.point;
                if let Some(carrier) = own.on() {
                    let mut joints = self.joints();
                    let tip = joints.position(|(on, _, info)| on == carrier && info.tip)?;
                    return place(SourceBody::Joint(tip), axes, point);
                }
                let Some(structure) = &self.structure else {
                    return place(SourceBody::Hub, axes, point);
                };
                let node = *structure.on_node.get(member)?;
                let mount = structure.mounts().iter().position(|known| *known == node)?;
                let position = structure.nodes.get(node)?.position;
                place(SourceBody::Mount(mount), axes, point - position)
            }
        }
    }
}
