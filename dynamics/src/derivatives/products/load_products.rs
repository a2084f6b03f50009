//! [`AlongDirection`], [`ByWeights`]: products of the emitted derivatives of the loads, device by device, with a
//! direction of state and inputs, and with weights of hub and joints. Nothing of a device is kept.

use crate::derivatives::loads::kernel::{NotEmitted, check_coupled, load_derivatives};
#[cfg(feature = "lanes")]
use crate::derivatives::loads::kernel_in_lanes::LanedKernel;
use crate::derivatives::products::device_products::{LoadChange, LoadGradient};
#[cfg(feature = "lanes")]
use crate::derivatives::products::products_in_lanes::{AlongInLanes, WeightsInLanes};
use crate::equations::device::Device;
use crate::equations::joint_inputs::DeviceInputs;
use crate::equations::load_sums::HubAccelerations;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::fallbacks;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::group::DeviceGroup;
use crate::isolation::carrier::Carrier;
#[cfg(feature = "lanes")]
use crate::model::kernels::Kernels;
use crate::model::kind::{Kind, LoadDerivatives};
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates, filled};
#[cfg(feature = "lanes")]
use crate::numbers::laned::{Block, WIDEST};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, add, rotate, rotate_transposed, sub};
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
#[cfg(feature = "lanes")]
use crate::sets::bundle::{MemberIndex, Part};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;
#[cfg(feature = "lanes")]
use crate::solve::rows::members;

/// How the hub moves, seen from a frame that falls with a uniform field, B axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubMotion<T> {
    pub(crate) omega: Vec3<T>,
    pub(crate) accelerations: HubAccelerations<T>,
    /// The field.
    pub(crate) gravity: Vec3<T>,
}

/// State and accelerations of the joints of a device.
#[cfg(feature = "lanes")]
type Member<'a, K> = (
    &'a <K as Kernels>::Joints<<K as Kind>::Scalar>,
    &'a <K as Kernels>::Accelerations<<K as Kind>::Scalar>,
);

impl<T: Scalar> HubMotion<T> {
    /// The kernels of devices side by side.
    #[cfg(feature = "lanes")]
    fn in_lanes<'a, K: Kind<Scalar = T>>(
        &self,
        group: &'a DeviceGroup<K>,
        members: [Member<'a, K>; WIDEST],
    ) -> LanedKernel<'a, K> {
        LanedKernel {
            group,
            joints: members.map(|(joints, _)| joints),
            accelerations: members.map(|(_, accelerations)| accelerations),
            omega: self.omega,
            hub: self.accelerations,
        }
    }

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
        let omega = rotate_transposed(&device.mount, self.omega);
        let LoadChange { hub: [force, moment], joints: loads } =
            LoadChange::along(zero(), &found, direction, omega);
        let [of_force, of_moment] = &mut self.hub;
        *of_force = add(*of_force, rotate(&device.mount, force));
        *of_moment = add(*of_moment, rotate(&device.mount, moment));
        subtract_loads(device, (joints, given), direction, loads.values(), driven);
        Ok(())
    }

    #[cfg(feature = "lanes")]
    const ROWS: bool = T::IS_F64;

    #[cfg(feature = "lanes")]
    fn visit_row<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[Device<K>],
        data: &mut <Directed as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, NotEmitted>
    where
        MemberIndex: Part<W, Of = K>,
    {
        let mut count = 1;
        if let Some(group) = devices.first().and_then(|device| device.group.as_deref()) {
            count = group.devices;
            let (joints, _, accelerations, direction, _) = &*data;
            let members = members(first, count, |at| {
                Some((
                    at.of::<data::Joints>(joints)?,
                    at.of::<data::Accelerations>(accelerations)?,
                    at.of::<data::Joints>(direction)?,
                ))
            });
            let loads = members.and_then(|members| {
                let kernel = self.motion.in_lanes(group, members.map(|(q, a, _)| (q, a)));
                let direction = members.map(|(.., direction)| direction);
                let (omega, hub) = (self.omega, &mut self.hub);
                AlongInLanes { kernel, direction, omega, hub }.run()
            });
            if let Some(loads) = &loads {
                for (lane, device) in devices.iter().enumerate().take(count) {
                    let at = MemberIndex(first.saturating_add(lane));
                    let Some((joints, given, _, direction, driven)) =
                        Directed::part::<W, MemberIndex>(data, at)
                    else {
                        break;
                    };
                    let loads = loads.values().map(|load| T::from_f64(load.at(lane)));
                    subtract_loads(device, (joints, given), direction, loads, driven);
                }
                return Ok(count);
            }
            fallbacks::count();
        }
        for (lane, device) in devices.iter().enumerate().take(count) {
            let at = MemberIndex(first.saturating_add(lane));
            let Some(data) = Directed::part::<W, MemberIndex>(data, at) else { break };
            self.visit(device, data)?;
        }
        Ok(count)
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Directed as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}

/// Subtracts what driven joints need more along a direction: these loads, and what springs and friction take.
fn subtract_loads<K: Kind>(
    device: &Device<K>,
    (joints, given): (&K::Joints<K::Scalar>, DeviceInputs<'_, K>),
    direction: &K::Joints<K::Scalar>,
    loads: impl Iterator<Item = K::Scalar>,
    driven: &mut K::Accelerations<K::Scalar>,
) {
    let passive = joints.states().zip(device.passive.values()).zip(direction.states());
    let passive = passive.map(|(([_, rate], of), [by_coordinate, by_rate])| {
        of.stiffness * by_coordinate + of.damping(rate) * by_rate
    });
    let modes = given.modes.values().zip(loads.zip(passive));
    for (driven, (mode, (load, passive))) in driven.values_mut().zip(modes) {
        if mode == Mode::Driven {
            *driven = *driven - (load + passive);
        }
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
        let [force, moment] = self.hub;
        let hub =
            [rotate_transposed(&device.mount, force), rotate_transposed(&device.mount, moment)];
        let none = <K as Kind>::all(zero());
        let of_joints = filled::<T, _>(none, weights.values());
        let found = LoadGradient::new(zero(), &found, hub, &of_joints);
        let LoadGradient { coordinates, rates, accelerations, omega, hub: exerted } = found;
        self.by_omega = add(self.by_omega, rotate(&device.mount, omega));
        for (to, exerted) in self.by_hub.iter_mut().zip(exerted) {
            *to = sub(*to, rotate(&device.mount, exerted));
        }
        let of_joints = coordinates.values().zip(rates.values()).zip(accelerations.values());
        write_gradient(device, (joints, given), of_joints, weights, gradient);
        Ok(())
    }

    #[cfg(feature = "lanes")]
    const ROWS: bool = T::IS_F64;

    #[cfg(feature = "lanes")]
    fn visit_row<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[Device<K>],
        data: &mut <Weighed as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, NotEmitted>
    where
        MemberIndex: Part<W, Of = K>,
    {
        let mut count = 1;
        if let Some(group) = devices.first().and_then(|device| device.group.as_deref()) {
            count = group.devices;
            let (joints, _, accelerations, weights, _) = &*data;
            let mut of_lanes = [<K as Kind>::all(0.0); WIDEST];
            for (lane, to) in of_lanes.iter_mut().enumerate().take(count) {
                let at = MemberIndex(first.saturating_add(lane));
                let Some(of) = at.of::<data::Accelerations>(weights) else { break };
                to.values_mut().zip(of.values()).for_each(|(to, of)| *to = of.to_f64());
            }
            let members = members(first, count, |at| {
                let joints = at.of::<data::Joints>(joints)?;
                Some((joints, at.of::<data::Accelerations>(accelerations)?))
            });
            let found = members.and_then(|members| {
                let kernel = self.motion.in_lanes(group, members);
                let Self { hub, by_omega, by_hub, .. } = self;
                let weights = &of_lanes;
                WeightsInLanes { kernel, hub: *hub, weights, by_omega, by_hub }.run()
            });
            if let Some([coordinates, rates, accelerations]) = &found {
                for (lane, device) in devices.iter().enumerate().take(count) {
                    let at = MemberIndex(first.saturating_add(lane));
                    let Some((joints, given, _, weights, gradient)) =
                        Weighed::part::<W, MemberIndex>(data, at)
                    else {
                        break;
                    };
                    let of = |block: Block| T::from_f64(block.at(lane));
                    let states = coordinates.values().map(of).zip(rates.values().map(of));
                    let of_joints = states.zip(accelerations.values().map(of));
                    write_gradient(device, (joints, given), of_joints, weights, gradient);
                }
                return Ok(count);
            }
            fallbacks::count();
        }
        for (lane, device) in devices.iter().enumerate().take(count) {
            let at = MemberIndex(first.saturating_add(lane));
            let Some(data) = Weighed::part::<W, MemberIndex>(data, at) else { break };
            self.visit(device, data)?;
        }
        Ok(count)
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Weighed as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}

/// Writes the gradient by the joints of a device, with springs and friction; the weights of joints whose accelerations are
/// given become that by these.
fn write_gradient<K: Kind>(
    device: &Device<K>,
    (joints, given): (&K::Joints<K::Scalar>, DeviceInputs<'_, K>),
    of_joints: impl Iterator<Item = ((K::Scalar, K::Scalar), K::Scalar)>,
    weights: &mut K::Accelerations<K::Scalar>,
    gradient: &mut K::Joints<K::Scalar>,
) {
    let passive = joints.states().zip(device.passive.values());
    let each = weights.values_mut().zip(gradient.states_mut()).zip(given.modes.values());
    for (((weight, [coordinate, rate]), mode), (of, passive)) in each.zip(of_joints.zip(passive)) {
        let (((by_coordinate, by_rate), by_acceleration), ([_, own], passive)) = (of, passive);
        *coordinate = by_coordinate - passive.stiffness * *weight;
        *rate = by_rate - passive.damping(own) * *weight;
        if mode != Mode::Driven {
            *weight = by_acceleration;
        }
    }
}
