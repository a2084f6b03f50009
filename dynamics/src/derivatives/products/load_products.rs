//! [`AlongDirection`], [`ByWeights`]: products of the emitted derivatives of the loads, device by device, with a
//! direction of state and inputs, and with weights of hub and joints. Nothing of a device is kept.

use crate::derivatives::loads::kernel::{NotEmitted, check_coupled, load_derivatives};
use crate::equations::device::Device;
use crate::equations::load_sums::HubAccelerations;
use crate::isolation::carrier::Carrier;
use crate::model::kind::{Kind, LoadColumn, LoadDerivatives};
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{
    Vec3, add, components, dot, rotate, rotate_transposed, scale, sub, zeros,
};
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;

/// How the hub moves, seen from a frame that falls with a uniform field, B axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubMotion<T> {
    pub(crate) omega: Vec3<T>,
    pub(crate) accelerations: HubAccelerations<T>,
    /// The field.
    pub(crate) gravity: Vec3<T>,
}

impl<T: Scalar> HubMotion<T> {
    /// The kernel of a device.
    // Never inlined: one copy for both products.
    #[inline(never)]
    fn load_derivatives<K: Kind<Scalar = T>>(
        &self,
        device: &Device<K>,
        joints: &K::Joints<T>,
        accelerations: &K::Accelerations<T>,
    ) -> Result<LoadDerivatives<K, T>, NotEmitted> {
        check_coupled(device)?;
        load_derivatives(device, joints, accelerations, (self.omega, &self.accelerations))
    }
}

/// State, inputs and accelerations of the joints, the direction of their coordinates and rates, and what is driven.
pub(crate) type Directed = (
    Shared<data::Joints>,
    Given,
    Shared<data::Accelerations>,
    Shared<data::Joints>,
    Unique<data::Accelerations>,
);

/// What the loads change by along a direction, at given accelerations. Of what is driven it subtracts what driven joints
/// need more.
#[derive(Debug)]
pub(crate) struct AlongDirection<T> {
    pub(crate) motion: HubMotion<T>,
    /// The direction of the angular velocity, B axes.
    pub(crate) omega: Vec3<T>,
    /// Force and moment about B that the hub exerts more, B axes.
    pub(crate) hub: [Vec3<T>; 2],
}

impl<T: Scalar> Visit<T, Directed> for AlongDirection<T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations, direction, driven): <Directed as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        let found = self.motion.load_derivatives(device, joints, accelerations)?;
        let ([mut force, mut moment], mut loads) = ([zeros(); 2], K::all(zero::<T>()));
        let mut add_column = |by: T, column: &LoadColumn<K, T>| {
            force = add(force, scale(by, components(&column.hub.force)));
            moment = add(moment, scale(by, components(&column.hub.moment)));
            loads = K::zip_per_joint(&loads, &column.joints, |sum, load| sum + by * load);
        };
        for ([coordinate, _], column) in direction.states().zip(found.coordinates.values()) {
            add_column(coordinate, &column);
        }
        for ([_, rate], column) in direction.states().zip(found.rates.values()) {
            add_column(rate, &column);
        }
        let omega = rotate_transposed(&device.mount, self.omega);
        for (by, column) in omega.into_iter().zip(&found.omega) {
            add_column(by, column);
        }
        let [of_force, of_moment] = &mut self.hub;
        *of_force = add(*of_force, rotate(&device.mount, force));
        *of_moment = add(*of_moment, rotate(&device.mount, moment));
        let passive = joints.states().zip(device.passive.values()).zip(direction.states());
        let passive = passive.map(|(([_, rate], of), [by_coordinate, by_rate])| {
            of.stiffness * by_coordinate + of.damping(rate) * by_rate
        });
        let modes = given.modes.values().zip(loads.values().zip(passive));
        for (driven, (mode, (load, passive))) in driven.values_mut().zip(modes) {
            if mode == Mode::Driven {
                *driven = *driven - (load + passive);
            }
        }
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Directed as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}

/// State, inputs and accelerations of the joints, the weights of their loads, and the gradient by coordinates and rates.
pub(crate) type Weighed = (
    Shared<data::Joints>,
    Given,
    Shared<data::Accelerations>,
    Unique<data::Accelerations>,
    Unique<data::Joints>,
);

/// The gradient of a weighted sum of the loads, less it. The weight of a joint whose acceleration is given becomes the
/// gradient by that.
#[derive(Debug)]
pub(crate) struct ByWeights<T> {
    pub(crate) motion: HubMotion<T>,
    /// Weights of force and moment about B, B axes.
    pub(crate) hub: [Vec3<T>; 2],
    /// By the angular velocity, B axes.
    pub(crate) by_omega: Vec3<T>,
    /// By the accelerations of a hub that is not free, B axes.
    pub(crate) by_hub: [Vec3<T>; 2],
}

impl<T: Scalar> Visit<T, Weighed> for ByWeights<T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations, weights, gradient): <Weighed as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        let found = self.motion.load_derivatives(device, joints, accelerations)?;
        let [force, moment] = self.hub.map(|of| rotate_transposed(&device.mount, of));
        let weights_of = *weights;
        let less = |column: &LoadColumn<K, T>| {
            let of_hub = dot(force, components(&column.hub.force))
                + dot(moment, components(&column.hub.moment));
            let each = column.joints.values().zip(weights_of.values());
            -each.fold(of_hub, |sum, (load, weight)| sum + load * weight)
        };
        let passive = joints.states().zip(device.passive.values()).zip(weights_of.values());
        let passive = passive
            .map(|(([_, rate], of), weight)| [of.stiffness * weight, of.damping(rate) * weight]);
        let columns = found.coordinates.values().zip(found.rates.values()).zip(passive);
        for ([coordinate, rate], ((by_coordinate, by_rate), [spring, damper])) in
            gradient.states_mut().zip(columns)
        {
            (*coordinate, *rate) = (less(&by_coordinate) - spring, less(&by_rate) - damper);
        }
        let [x, y, z] = &found.omega;
        let by_omega = [less(x), less(y), less(z)];
        self.by_omega = add(self.by_omega, rotate(&device.mount, by_omega));
        let ([mut of_force, mut of_moment], modes) = ([zeros(); 2], given.modes.values());
        let columns = found.accelerations.values().zip(modes);
        for (weight, (column, mode)) in weights.values_mut().zip(columns) {
            of_force = add(of_force, scale(*weight, components(&column.hub.force)));
            of_moment = add(of_moment, scale(*weight, components(&column.hub.moment)));
            if mode != Mode::Driven {
                *weight = less(&column);
            }
        }
        let [by_force, by_moment] = &mut self.by_hub;
        *by_force = sub(*by_force, rotate(&device.mount, of_force));
        *by_moment = sub(*by_moment, rotate(&device.mount, of_moment));
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Weighed as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}
