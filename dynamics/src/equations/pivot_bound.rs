//! What the pivot of each joint must exceed: 64 epsilons of its scale, which is the largest mass or
//! inertia outboard of it in any pose.
//!
//! In a pose where that inertia vanishes, because the bodies come to lie on the joint's axis, what
//! the kernels compute of it is the rounding of numbers of this size.
//!
//! No kind has a sliding joint outboard of another one, so the scale is never below the pivot's
//! diagonal.

use crate::equations::system::bound;
use crate::model::kind::{BodyParameters, Kind};
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, dot};

/// The bodies of a device.
type Bodies<K> =
    <K as crate::model::kernels::Kernels>::PerJoint<BodyParameters<<K as Kind>::Scalar>>;

/// Bound of the pivot of each joint, kg m²; of a sliding joint kg.
pub(crate) fn pivot_bounds<K: Kind>(bodies: &Bodies<K>) -> K::PerJoint<K::Scalar> {
    let mut bounds = K::all(zero());
    for (joint, value) in bounds.values_mut().enumerate() {
        *value = bound(outboard::<K>(bodies, joint));
    }
    bounds
}

/// Mass or inertia outboard of a joint, in the pose that makes the most of it.
fn outboard<K: Kind>(bodies: &Bodies<K>, joint: usize) -> K::Scalar {
    let outboard = || bodies.values().zip(K::JOINTS).skip(joint);
    let Some(own) = K::JOINTS.get(joint) else { return zero() };
    if own.slides {
        return outboard().fold(zero(), |sum, (body, _)| sum + body.mass);
    }
    let (mut sum, mut arm) = (zero::<K::Scalar>(), zero::<K::Scalar>());
    // Whether a body turns only about the joint's axis, in any pose.
    let mut parallel = true;
    for (index, (body, info)) in outboard().enumerate() {
        if index > 0 {
            arm = arm + lever(body.origin, own.axis, parallel);
            parallel = parallel && (info.slides || info.axis == own.axis);
        }
        let moments = [body.inertia.m11, body.inertia.m22, body.inertia.m33].map(Scalar::abs);
        let [x, y, z] = moments;
        let moment = match own.axis {
            _ if !parallel => x + y + z,
            0 => x,
            1 => y,
            _ => z,
        };
        let reach = arm + lever(body.centre, own.axis, parallel);
        sum = sum + moment + body.mass * reach * reach;
    }
    sum
}

/// Length of an offset; where it keeps its angle with the axis, of what it has across it.
fn lever<T: Scalar>(offset: Vec3<T>, axis: usize, parallel: bool) -> T {
    let [x, y, z] = offset;
    let across = match axis {
        _ if !parallel => offset,
        0 => [zero(), y, z],
        1 => [x, zero(), z],
        _ => [x, y, zero()],
    };
    dot(across, across).sqrt()
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::{Dgvscmg, ReactionWheel, SloshMass};

    fn scales<K: Kind>(device: &K) -> Vec<K::Scalar> {
        let bodies = device.bodies();
        (0..K::JOINTS.len()).map(|joint| outboard::<K>(&bodies, joint)).collect()
    }

    #[test]
    fn a_single_joint_has_its_own_diagonal() {
        let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
        let wheel = ReactionWheel { d: 0.5, ..ReactionWheel::bare_wheel(4.0, disc) };
        assert_eq!(scales(&wheel), [0.2 + 4.0 * 0.25]);
        assert_eq!(scales(&SloshMass::bare_slosh_mass(3.0)), [3.0]);
    }

    #[test]
    fn an_offset_along_the_axis_of_a_joint_does_not_count() {
        let device = Dgvscmg {
            l_o: Vector3::new(0.0, 0.0, 7.0),
            ..Dgvscmg::bare_wheel(2.0, Matrix3::zeros())
        };
        assert_eq!(scales(&device), [0.0; 3]);
        let device = Dgvscmg { l_o: Vector3::new(3.0, 4.0, 7.0), ..device };
        assert_eq!(scales(&device), [50.0, 0.0, 0.0]);
        let device = Dgvscmg { l_i: Vector3::new(1.0, 9.0, 0.0), ..device };
        let arm = 5.0 + 82.0_f64.sqrt();
        assert_eq!(scales(&device), [2.0 * arm * arm, 2.0, 0.0]);
    }
}
