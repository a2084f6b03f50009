//! [`CarriedLoads`]: loads and powers of what a carrier carries, on the carrier's motion as the
//! base, and what they add to the carrier's own.

use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::{Added, Along, HubAccelerations, LoadSums};
use crate::isolation::carrier::Carrier;
use crate::isolation::kernels::moved_second_moment;
use crate::isolation::motion::{Motion, transposed};
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::{Vec3, cross, dot, map, rotate_transposed, scale, sub};
use crate::results::momentum::first_moments;
use crate::sets::carrying::PreparedCarrying;
use crate::sets::devices::DeviceSet;
use crate::sets::per_device as data;

/// A carrier as the base of the devices that it carries, for known accelerations.
pub(crate) struct CarriedLoads<'a, C: Carrier> {
    joints: &'a C::Joints<C::Scalar>,
    moving: C::Moving,
    hub: &'a HubAccelerations<C::Scalar>,
    /// (I5), carrier axes.
    field: Vec3<C::Scalar>,
    /// For the carried devices.
    pub(crate) environment: Environment<C::Scalar>,
}

impl<'a, T: Scalar, C: Carrier<Scalar = T>> CarriedLoads<'a, C> {
    /// The carrier's motion on its base.
    pub(crate) fn start<D: DeviceSet<Scalar = T>>(
        carrying: &PreparedCarrying<C, D>,
        joints: &'a C::Joints<T>,
        base: &Environment<T>,
        hub: &'a HubAccelerations<T>,
    ) -> Self {
        let moving = carrying.carrier.moving(joints, base.omega);
        let (environment, field) = (moving.environment(base), moving.field(base));
        Self { joints, moving, hub, field, environment }
    }

    /// Accelerations of the carrier, carrier axes, seen from what falls with the field at P.
    pub(crate) fn base(&self, accelerations: &C::Accelerations<T>) -> HubAccelerations<T> {
        let base = [self.hub.r_b_n_ddot, self.hub.omega_dot];
        let [at_p, omega_dot] = C::acceleration(&self.moving, base, accelerations);
        HubAccelerations { r_b_n_ddot: sub(at_p, self.field), omega_dot }
    }

    /// The axes for the loads of the carried joints: those of the base are given by the
    /// carrier's rotation.
    pub(crate) fn along(&self, of_base: &Along<T>) -> Along<T> {
        let axes = &self.moving.axes;
        match of_base {
            Along::Body => Along::Body,
            Along::Parent => Along::Parent,
            Along::Hub(None) => Along::Hub(Some(transposed(axes))),
            Along::Hub(Some(bn)) => {
                Along::Hub(Some(map(*bn, |column| rotate_transposed(axes, column))))
            }
        }
    }

    /// Adds the powers and the second moment of the carried devices to those of the base; returns
    /// what they add to the carrier's loads.
    pub(crate) fn add<D: DeviceSet<Scalar = T>>(
        &self,
        carrying: &PreparedCarrying<C, D>,
        carried: &D::Per<data::Joints>,
        sums: &mut LoadSums<T>,
        base: &mut LoadSums<T>,
    ) -> Added<T> {
        let pose = C::pose(self.joints);
        let suspension = C::forces(&carrying.carrier.suspension, &pose, self.joints);
        if self.environment.central.is_some() {
            self.add_uniform::<D>(carrying, carried, sums, base);
        }
        base.power.add(&sums.power);
        base.power.stored = base.power.stored + suspension.potential;
        let LoadSums { inertial, applied, gradient, .. } = *sums;
        Added { inertial, applied, gradient, suspension }
    }

    /// The part `G p` of a central field: the accelerations were counted in the frame that falls
    /// with it, so its force and its power come back on both sides.
    fn add_uniform<D: DeviceSet<Scalar = T>>(
        &self,
        carrying: &PreparedCarrying<C, D>,
        carried: &D::Per<data::Joints>,
        sums: &mut LoadSums<T>,
        base: &mut LoadSums<T>,
    ) {
        let mass = carrying.carrier.carried_mass;
        let [s, s_prime] = first_moments::<D>(&carrying.carried, carried);
        let wrench = Wrench::of(scale(mass, self.field), cross(s, self.field));
        sums.inertial = sums.inertial.plus(&wrench);
        sums.gradient = sums.gradient.plus(&wrench);
        let power = dot(self.field, s_prime);
        let powers = &mut sums.power;
        powers.inertial = powers.inertial + power;
        powers.gradient = powers.gradient + power;
        powers.magnitude = powers.magnitude + power.abs() + power.abs();
        let body = HubConstants { m_b: mass, first_moment: s, i_b_b: sums.second_moment };
        let Motion { axes, p, .. } = &*self.moving;
        let second = moved_second_moment(&body, &sums.second_moment, axes, *p);
        base.second_moment = base.second_moment.plus(second);
    }
}
