//! [`Frames`]: where each body is with respect to the body inboard of it, from the coordinates of a sample.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use precess_dynamics::{Mrp, Quaternion};
use serde::Serialize;

use super::messages::{Orientation, Time, Xyz};
use crate::record::Header;
use crate::record::columns::Quantity;
use crate::scenario::Scenario;
use crate::shapes::{Joint, joints};

/// The name of the hub's frame.
pub(super) const HUB: &str = "B";

/// The frames of a spacecraft, and the columns that they are computed from.
pub(super) struct Frames {
    joints: Vec<Joint>,
    position: Vec<usize>,
    /// Euler parameters, or modified Rodrigues parameters.
    attitude: Vec<usize>,
    coordinates: Vec<usize>,
}

/// `foxglove.FrameTransforms`.
#[derive(Serialize)]
pub(super) struct FrameTransforms {
    pub(super) transforms: Vec<FrameTransform>,
}

/// `foxglove.FrameTransform`: the child's origin and axes, in those of the parent.
#[derive(Serialize)]
pub(super) struct FrameTransform {
    timestamp: Time,
    pub(super) parent_frame_id: String,
    pub(super) child_frame_id: String,
    pub(super) translation: Xyz,
    pub(super) rotation: Orientation,
}

impl Frames {
    /// The frames of a scenario; none where a column that they need is not recorded.
    pub(super) fn new(header: &Header, scenario: &Scenario) -> Option<Self> {
        let index = |quantity: Quantity| {
            header.columns.iter().position(|column| column.quantity == quantity)
        };
        let all = |count: usize, of: fn(usize) -> Quantity| {
            (0..count).map(|which| index(of(which))).collect::<Option<Vec<_>>>()
        };
        Some(Self {
            joints: joints(scenario),
            position: all(3, Quantity::Position)?,
            attitude: all(4, Quantity::Quaternion).or_else(|| all(3, Quantity::Sigma))?,
            coordinates: all(scenario.joint_count(), Quantity::Coordinate)?,
        })
    }

    /// The frames of a sample: B, then the child body of each joint.
    pub(super) fn message(&self, timestamp: Time, row: &[f64]) -> FrameTransforms {
        let of = |column: &usize| row.get(*column).copied().unwrap_or(f64::NAN);
        let position: Vec<_> = self.position.iter().map(of).collect();
        let attitude: Vec<_> = self.attitude.iter().map(of).collect();
        // The turn from N to B: its Euler parameters are the axes of B expressed in N.
        let rotation = match attitude.as_slice() {
            [q0, q1, q2, q3] => [*q0, *q1, *q2, *q3],
            all => {
                let Quaternion { q0, q1, q2, q3 } =
                    Mrp(Vector3::from_iterator(all.iter().copied().chain([0.0; 3]).take(3))).into();
                [q0, q1, q2, q3]
            }
        };
        let origin = Vector3::from_iterator(position.into_iter().chain([0.0; 3]).take(3));
        let mut transforms = vec![FrameTransform {
            timestamp,
            parent_frame_id: "N".to_owned(),
            child_frame_id: HUB.to_owned(),
            translation: origin.into(),
            rotation: Orientation::new(rotation),
        }];
        for (joint, column) in self.joints.iter().zip(&self.coordinates) {
            let (translation, rotation) = placed(joint, of(column));
            transforms.push(FrameTransform {
                timestamp,
                parent_frame_id: self.parent(joint),
                child_frame_id: joint.name.clone(),
                translation: translation.into(),
                rotation: rotation.into(),
            });
        }
        FrameTransforms { transforms }
    }

    fn parent(&self, joint: &Joint) -> String {
        let inboard = usize::try_from(joint.parent).ok().and_then(|index| self.joints.get(index));
        inboard.map_or(HUB, |inboard| &inboard.name).to_owned()
    }
}

/// Origin and axes of the child body of a joint, in those of its parent body.
fn placed(joint: &Joint, coordinate: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let mount = Matrix3::from_row_slice(&joint.mount);
    let mut axis = Vector3::zeros();
    axis[joint.axis.min(2)] = 1.0;
    let origin = Vector3::from(joint.origin);
    let axes = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(mount));
    if joint.slides {
        return (origin + mount * (axis * coordinate), axes);
    }
    // The solver's own sine: bit-identical on every host.
    let (sin, cos) = precess_dynamics::Angle::sin_cos(0.5 * coordinate);
    let turn = nalgebra::Quaternion::from_parts(cos, axis * sin);
    (origin, axes * UnitQuaternion::new_normalize(turn))
}
