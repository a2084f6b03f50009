//! [`FlexibleInputs`]: forces and torques on a structure that bends, and modes of joints and hub.

use nalgebra::Vector3;

use crate::flexible::modes::ModalPoint;
use crate::flexible::spacecraft::FlexibleSpacecraft;
use crate::flexible::storage::ModalStorage;
use crate::model::wrench::Wrench;
use crate::numbers::real::zero;
use crate::numbers::vec3::{components, dot};
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;

/// Forces, torques and modes. Constant during a step, expressed in the axes that each field names.
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibleInputs<D: Devices, S: ModalStorage> {
    /// As on a rigid hub: force through B and torque about B, motors and modes of the joints, mode
    /// of the hub (fixed or prescribed: the frame B, which the structure bends in), gravity.
    pub rigid: Inputs<D>,
    /// Modal forces, `integral of phi_i . dF`, N/sqrt(kg).
    pub modal: S::Modes<D::Scalar>,
    /// Wrench on the structure at each mount, about the mount, expressed in the axes of the mount,
    /// which are those of B undeformed; it turns with them.
    pub mounts: S::Mounts<Wrench<D::Scalar>>,
}

impl<D: Devices, S: ModalStorage> Copy for FlexibleInputs<D, S>
where
    Inputs<D>: Copy,
    S::Modes<D::Scalar>: Copy,
    S::Mounts<Wrench<D::Scalar>>: Copy,
{
}

impl<D: Devices, S: ModalStorage> FlexibleInputs<D, S> {
    /// No force, torque or gravity, motors off, every joint in the mode of its kind, a free hub.
    #[must_use]
    pub fn none_for(spacecraft: &FlexibleSpacecraft<D, S>) -> Self {
        Self {
            rigid: Inputs::none_for(&spacecraft.rigid),
            modal: S::modes(spacecraft.modes(), &zero()),
            mounts: S::mounts(spacecraft.mounts(), &Wrench::none()),
        }
    }

    /// Adds a force, N, and a moment, N m, at a point of the structure, both expressed in B, to
    /// first order: the arm is that of the undeformed structure.
    pub fn add_wrench(
        &mut self,
        point: &ModalPoint<S, D::Scalar>,
        force: &Vector3<D::Scalar>,
        moment: &Vector3<D::Scalar>,
    ) {
        self.rigid.add_force(&point.position, force);
        self.rigid.torque_b = Wrench { force: *force, moment: self.rigid.torque_b }
            .plus(&Wrench::torque(moment))
            .moment;
        let shapes = point.translation.as_ref().iter().zip(point.rotation.as_ref());
        for (to, (translation, rotation)) in self.modal.as_mut().iter_mut().zip(shapes) {
            *to = *to
                + dot(components(translation), components(force))
                + dot(components(rotation), components(moment));
        }
    }
}
