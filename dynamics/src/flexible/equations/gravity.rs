//! The field of a central body on a flexible structure and on the devices on its mounts, (F13) to
//! (F15).
//!
//! In the frame K of a mount the field is that at K, `g + G r_K`, and its gradient: devices get them
//! as on a rigid hub. The structure has its deformed first moment and its undeformed second one.

use crate::equations::gravity::{Central, gradient_moment};
use crate::equations::hub::HubConstants;
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, add, rotate, rotate_transposed};
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

impl<T: Scalar> MountMotion<T> {
    /// What the field at the origin of K has beside that at B, `Rᵀ G r_K`, expressed in K, m/s².
    pub(crate) fn field_beside_b(&self, central: &Central<T>) -> Vec3<T> {
        rotate_transposed(&self.axes, central.gradient.times(self.origin))
    }

    /// Counts the acceleration of K in the frame that falls with the field at K instead of the one
    /// that falls with the field at B.
    pub(crate) fn falling(mut self, central: &Central<T>) -> Self {
        let [x, y, z] = self.field_beside_b(central);
        let [a, b, c, d, e, f] = self.bias;
        self.bias = [a - x, b - y, c - z, d, e, f];
        self
    }

    /// Second moment about B of masses on the mount, expressed in B, from their mass, first and
    /// second moment about K, expressed in K: `S = R S_K Rᵀ + r_K sᵀ + s r_Kᵀ + m r_K r_Kᵀ`.
    pub(crate) fn second_moment(
        &self,
        mass: T,
        first: Vec3<T>,
        second: &Symmetric<T>,
    ) -> Symmetric<T> {
        let ([rx, ry, rz], [sx, sy, sz]) = (self.origin, rotate(&self.axes, first));
        let mixed = Symmetric {
            xx: rx * sx + sx * rx,
            xy: rx * sy + sx * ry,
            xz: rx * sz + sx * rz,
            yy: ry * sy + sy * ry,
            yz: ry * sz + sy * rz,
            zz: rz * sz + sz * rz,
        };
        let of_mass = Symmetric::dyad(self.origin).scaled(mass);
        second.rotated(&self.axes).plus(mixed).plus(of_mass)
    }
}

/// What the gradient exerts on a rigid body about the origin of its frame, expressed in it.
pub(crate) fn on_body<T: Scalar>(central: &Central<T>, body: &HubConstants<T>) -> Wrench<T> {
    let (force, moment) = central.wrench(body.first_moment, &body.second_moment());
    Wrench::of(force, moment)
}

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// What the gradient exerts on the structure about B, and the third-order force on the whole,
    /// for the second moment of all devices about B; expressed in B.
    pub(crate) fn gradient<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        central: &Central<D::Scalar>,
        devices: &Symmetric<D::Scalar>,
    ) -> Wrench<D::Scalar> {
        let own = self.hub.second_moment();
        let force = central.gradient.times(self.deformed(state).first_moment);
        let whole = central.third_order(&devices.plus(own));
        Wrench::of(add(force, whole), gradient_moment(&central.gradient, &own))
    }
}
