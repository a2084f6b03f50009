//! [`ModalInputs`]: forces on a flexible structure beside those on a rigid hub.

use core::fmt::Debug;

use nalgebra::Vector3;

use crate::flexible::modal::modes::ModalPoint;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::{components, dot};
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;

/// Modal forces, and wrenches on mounts: [`Inputs::modal`](crate::Inputs::modal) of a flexible
/// structure.
#[derive(Clone, Copy, Debug)]
pub struct ModalInputs<M: ModalStorage, T: Clone + Debug = f64> {
    /// Modal forces, `integral of phi_i . dF`, N/sqrt(kg).
    pub forces: M::Modes<T>,
    /// Wrench on the structure at each mount, about the mount, expressed in the axes of the mount,
    /// which are those of B undeformed; it turns with them.
    pub mounts: M::Mounts<Wrench<T>>,
}

impl<M: ModalStorage, T: Clone + Debug + PartialEq> PartialEq for ModalInputs<M, T> {
    fn eq(&self, other: &Self) -> bool {
        self.forces.as_ref() == other.forces.as_ref()
            && self.mounts.as_ref() == other.mounts.as_ref()
    }
}

impl<M: ModalStorage, T: Scalar> ModalInputs<M, T> {
    /// Adds the modal forces of a force, N, and a moment, N m, at a point of the structure, both
    /// expressed in B. What they are on the rigid hub is not among them:
    /// [`Inputs::add_wrench`](crate::Inputs::add_wrench) adds both.
    pub fn add_wrench(
        &mut self,
        point: &ModalPoint<M, T>,
        force: &Vector3<T>,
        moment: &Vector3<T>,
    ) {
        let shapes = point.translation.as_ref().iter().zip(point.rotation.as_ref());
        for (to, (translation, rotation)) in self.forces.as_mut().iter_mut().zip(shapes) {
            *to = *to
                + dot(components(translation), components(force))
                + dot(components(rotation), components(moment));
        }
    }
}

impl<D: Devices, M: ModalStorage> Inputs<D, Flexible<M>> {
    /// Adds a force, N, and a moment, N m, at a point of the structure, both expressed in B, to
    /// first order: the arm is that of the undeformed structure.
    pub fn add_wrench(
        &mut self,
        point: &ModalPoint<M, D::Scalar>,
        force: &Vector3<D::Scalar>,
        moment: &Vector3<D::Scalar>,
    ) {
        self.add_force(&point.position, force);
        self.torque_b =
            Wrench { force: *force, moment: self.torque_b }.plus(&Wrench::torque(moment)).moment;
        self.modal.add_wrench(point, force, moment);
    }
}
