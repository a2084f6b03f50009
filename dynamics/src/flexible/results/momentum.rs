//! Energy, momentum and centre of mass of a flexible structure, with its devices.
//!
//! Linear momentum is the mass times the velocity of the centre of mass, exactly; both momenta are
//! conserved, and kinetic energy changes by the powers of the [ledger](crate::Ledger).

use core::convert::Infallible;

use crate::attitude::parameterisation::Attitude;
use crate::equations::device::Device;
use crate::equations::hub::{BodySums, HubConstants};
use crate::flexible::equations::block::{combined, parted};
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::numbers::real::{Scalar, half, zero};
use crate::numbers::vec3::{Vec3, add, columns, components, cross, dot, neg, rotate, scale, zeros};
use crate::results::momentum::{Addition as OnBase, FirstMoments, MotionSums};
use crate::sets::bundle::{Bundle, Shared};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device::Joints;
use crate::sets::per_device::OnMount;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// A mount and the sums over its devices, expressed in K.
#[derive(Clone, Debug)]
pub(crate) struct MountSums<T> {
    motion: MountMotion<T>,
    velocity: Vec3<T>,
    pub(crate) sums: BodySums<T>,
    first_moment: [Vec3<T>; 2],
}

/// The joints, and the mount.
type JointsOnMount = (Shared<Joints>, Shared<OnMount>);

/// Adds energy, momenta and first moments of each device to the sums of its mount.
struct Addition<'a, T>(&'a mut [MountSums<T>]);

impl<T: Scalar> Visit<T, JointsOnMount> for Addition<'_, T> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, mount): <JointsOnMount as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        self.on(*mount, |sums, moments| {
            let Ok(()) = sums.visit(device, joints);
            moments.visit(device, joints)
        })
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, mount): <JointsOnMount as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Infallible> {
        self.on(mount.carrier, |sums, moments| {
            let Ok(()) = sums.visit_carrying(carrying, joints);
            moments.visit_carrying(carrying, joints)
        })
    }
}

impl<T: Scalar> Addition<'_, T> {
    /// The sums of devices, as on a rigid hub, with their mount for it.
    fn on(
        &mut self,
        mount: usize,
        add: impl FnOnce(&mut OnBase<'_, T>, &mut FirstMoments<'_, T>) -> Result<(), Infallible>,
    ) -> Result<(), Infallible> {
        let Some(mount) = self.0.get_mut(mount) else { return Ok(()) };
        let MountSums { motion, velocity, sums, first_moment } = mount;
        let (r_b_n_dot, omega) = (*velocity, motion.omega);
        add(&mut OnBase { r_b_n_dot, omega, sums }, &mut FirstMoments(first_moment))
    }
}

/// Sums over the whole spacecraft, expressed in B.
pub(crate) struct WholeSums<M: ModalStorage, T: Scalar> {
    pub(crate) motion: MotionSums<T>,
    /// First moment about B, and its derivative seen from B.
    pub(crate) first_moment: [Vec3<T>; 2],
    /// Mount by mount, expressed in K.
    pub(crate) mounts: M::Mounts<MountSums<T>>,
}

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// Energy, momenta and first moments, expressed in B.
    pub(crate) fn sums_flexible<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
    ) -> WholeSums<M, D::Scalar> {
        let bn = columns(&state.attitude.dcm());
        let r_b_n_dot = rotate(&bn, components(&state.r_b_n_dot));
        let omega = components(&state.omega);
        let mut mounts = M::per_mount(&self.structure.mounts, |mount| {
            let motion = mount.motion(state, omega);
            let velocity = motion.velocity(r_b_n_dot, omega);
            let none = BodySums { energy: zero(), linear: zeros(), angular_b: zeros() };
            let contained = mount.contained.as_ref();
            let sums = contained.map_or(none, |body| without(body, velocity, motion.omega));
            let moment = contained.map_or_else(zeros, |body| neg(body.first_moment));
            MountSums { motion, velocity, sums, first_moment: [moment, zeros()] }
        });
        let data = (&state.devices, &self.structure.on_mount);
        let mut addition = Addition(mounts.as_mut());
        let Ok(()) = D::visit::<JointsOnMount, _>(&self.devices, data, &mut addition);

        let (mut sums, mut first_moment) = self.structure_sums(state, r_b_n_dot, omega);
        for (mount, constants) in mounts.as_ref().iter().zip(self.structure.mounts.as_ref()) {
            let MountSums { motion, sums: of_mount, first_moment: [s, s_prime], .. } = mount;
            let linear = rotate(&motion.axes, of_mount.linear);
            let angular = rotate(&motion.axes, of_mount.angular_b);
            sums.energy = sums.energy + of_mount.energy;
            sums.linear = add(sums.linear, linear);
            sums.angular_b = add(sums.angular_b, add(angular, cross(motion.origin, linear)));
            let mass = constants.body.m_b;
            let turning = add(*s_prime, cross(motion.relative, *s));
            let own = [add(scale(mass, motion.origin), rotate(&motion.axes, *s)), {
                add(scale(mass, motion.origin_prime), rotate(&motion.axes, turning))
            }];
            for (sum, own) in first_moment.iter_mut().zip(own) {
                *sum = add(*sum, own);
            }
        }
        let [moment, _] = first_moment;
        let motion = MotionSums { bn, bodies: sums, first_moment: Some(moment) };
        WholeSums { motion, first_moment, mounts }
    }

    /// Energy, momenta and first moments of the structure, (F3).
    fn structure_sums<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        r_b_n_dot: Vec3<D::Scalar>,
        omega: Vec3<D::Scalar>,
    ) -> (BodySums<D::Scalar>, [Vec3<D::Scalar>; 2]) {
        let rates = state.modal.eta_dot.as_ref();
        let (linear, angular) = parted(&combined(self.structure.momenta.as_ref(), rates));
        let body = self.deformed(state);
        let rigid = body.sums(r_b_n_dot, omega);
        let own = rates
            .iter()
            .take(self.massive())
            .fold(zero(), |sum, rate| sum + half::<D::Scalar>() * (*rate * *rate));
        let sums = BodySums {
            energy: rigid.energy + dot(r_b_n_dot, linear) + dot(omega, angular) + own,
            linear: add(rigid.linear, linear),
            angular_b: add(rigid.angular_b, angular),
        };
        (sums, [body.first_moment, linear])
    }
}

/// The sums of a body that is subtracted.
fn without<T: Scalar>(body: &HubConstants<T>, velocity: Vec3<T>, omega: Vec3<T>) -> BodySums<T> {
    let BodySums { energy, linear, angular_b } = body.sums(velocity, omega);
    BodySums { energy: -energy, linear: neg(linear), angular_b: neg(angular_b) }
}
