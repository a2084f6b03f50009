//! [`Members`]: the emitted derivatives of the loads of each device of a tree of carriers, and how each carrier moves.
//!
//! A device on a carrier has the load columns that it has on the hub, with the carrier for the hub.

use alloc::vec::Vec;

use crate::derivatives::loads::kernel::{Moving, NotEmitted, check_count};
use crate::derivatives::loads::side_by_side::Load;
use crate::derivatives::tree::applied_columns::{Applied, by_wrenches};
use crate::derivatives::tree::base_motion::{BaseMotion, Link, Moments, spatial};
use crate::derivatives::tree::device_loads::DeviceLoads;
use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::gravity::Central;
use crate::equations::hub::HubConstants;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::system::Solution;
use crate::isolation::carrier::Carrier;
use crate::isolation::motion::Spatial;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, rotate, rotate_transposed, scale, sub, zeros};
use crate::sets::bundle::Bundle;
use crate::sets::carrying::{Carrying, PreparedCarrying, parts};
use crate::sets::devices::{DeviceSet, Visit};

/// The hub, or a carrier.
#[derive(Clone, Debug)]
pub(crate) struct Base<T> {
    /// Where it stands; none of the hub.
    pub(crate) link: Option<Link<T>>,
    /// The number of its first joint.
    pub(crate) first: usize,
    /// Of its joints, by their coordinates and rates: springs and friction, wrenches on the bodies between them. On the
    /// base that it stands on.
    pub(crate) own: [[Load<T>; MAX_JOINTS]; 2],
    pub(crate) body: HubConstants<T>,
    pub(crate) field: Option<Central<T>>,
    pub(crate) motion: BaseMotion<T>,
    /// What it needs with all that it carries, less what acts on them, about its origin; not of the hub.
    pub(crate) load: Spatial<T>,
    /// Mass, first and second moment of it with all that it carries.
    pub(crate) moments: Moments<T>,
    /// Of a mount of a flexible structure, the shapes: displacement and rotation by each modal coordinate. Its six
    /// coordinates are those.
    pub(crate) shapes: Option<Vec<[T; 6]>>,
}

/// A device.
#[derive(Clone, Debug)]
pub(crate) struct Member<T> {
    /// The number of what it stands on.
    pub(crate) base: usize,
    /// The number of its first joint.
    pub(crate) first: usize,
    pub(crate) columns: DeviceLoads<T>,
    pub(crate) mass: T,
    /// By the position of B from the centre of a field, base axes.
    pub(crate) position: Option<[Load<T>; 3]>,
    /// First and second moment by the coordinates; only in a central field.
    pub(crate) moments_by: [Moments<T>; MAX_JOINTS],
}

/// What a joint belongs to: a device by its number, or a carrier as a base by its number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Owner {
    Device(usize),
    Carrier(usize),
}

/// What is found, device by device.
#[derive(Debug)]
pub(crate) struct Members<T> {
    pub(crate) bases: Vec<Base<T>>,
    pub(crate) devices: Vec<Member<T>>,
    /// Of each joint: its owner, whether its acceleration is free.
    pub(crate) joints: Vec<(Owner, bool)>,
    /// Of each joint, by the wrench on its child body; none where there are no wrenches on bodies.
    pub(crate) by_wrenches: Vec<[Load<T>; 6]>,
    /// The number of what the next device stands on.
    pub(crate) base: usize,
}

impl<T: Scalar> Members<T> {
    /// On a hub, and on the mounts of a flexible structure.
    pub(crate) fn on(hub: Base<T>, mounts: Vec<Base<T>>) -> Self {
        let (devices, joints, by_wrenches) = (Vec::new(), Vec::new(), Vec::new());
        let mut bases = alloc::vec![hub];
        bases.extend(mounts);
        Self { bases, devices, joints, by_wrenches, base: 0 }
    }

    /// Adds up the loads and moments of each carrier, from the outermost inwards.
    pub(crate) fn add_up(&mut self) {
        for number in (1..self.bases.len()).rev() {
            let (inboard, outboard) = self.bases.split_at_mut(number);
            let Some(Base { link: Some(link), load, moments, .. }) = outboard.first() else {
                continue;
            };
            if let Some(base) = inboard.get_mut(link.base) {
                let [force, moment] = link.inward(*load);
                base.load = [add(base.load[0], force), add(base.load[1], moment)];
                base.moments = base.moments.plus(&link.moments_inward(moments));
            }
        }
    }
}

impl<T: Scalar> Visit<T, Moving> for Members<T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations): <Moving as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        check_count::<K>()?;
        let Some(base) = self.bases.get_mut(self.base) else { return Ok(()) };
        let BaseMotion { omega, acceleration: r_b_n_ddot, omega_dot, .. } = base.motion;
        let hub = HubAccelerations { r_b_n_ddot, omega_dot };
        let (columns, applied) = DeviceLoads::new(
            device,
            (joints, &given, accelerations),
            (omega, &hub),
            base.field.as_ref(),
        )?;
        if given.bodies.is_some() {
            self.by_wrenches.extend(by_wrenches(device, joints));
        }
        if self.base > 0 {
            let [force, moment] = needed::<K>(device, joints, omega, &hub, accelerations);
            let [less, turned_less] = applied.as_ref().map_or([zeros(); 2], |of| of.hub);
            base.load =
                [add(base.load[0], sub(force, less)), add(base.load[1], sub(moment, turned_less))];
        }
        let mass = K::constant_share(&device.constants).constant_m;
        let mut moments_by = [Moments::none(); MAX_JOINTS];
        if let Some(applied) = applied.as_ref().filter(|_| base.field.is_some()) {
            let second = applied.second_moment;
            base.moments =
                base.moments.plus(&Moments { mass, first: columns.first_moment(), second });
            for (joint, (to, second)) in
                moments_by.iter_mut().zip(applied.second_moment_by).enumerate().take(columns.count)
            {
                *to =
                    Moments { mass: zero(), first: first_moment_by(device, joints, joint), second };
            }
        }
        let owner = Owner::Device(self.devices.len());
        let first = self.joints.len();
        self.joints.extend(columns.free.iter().take(columns.count).map(|free| (owner, *free)));
        let position = applied.filter(|_| base.field.is_some()).map(|of| of.position);
        self.devices.push(Member { base: self.base, first, columns, mass, position, moments_by });
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, given, accelerations): <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        let (of_carrier, of_carried) = parts::<T, C, D>(given);
        let (number, base, first) = (self.bases.len(), self.base, self.joints.len());
        let Some(Base { motion, field, .. }) = self.bases.get(base) else { return Ok(()) };
        let carrier = &carrying.carrier;
        let device = &carrier.device;
        let of_base = (motion, field.as_ref());
        let (link, motion) =
            Link::of_carrier(carrier, &joints.carrier, &accelerations.carrier, base, of_base);
        let field = field.map(|field| field.turned(&link.axes));
        let mut own = [[Load::none(); MAX_JOINTS]; 2];
        let slopes = C::force_slopes(&carrier.suspension, &joints.carrier);
        for (own, slopes) in own.iter_mut().zip(slopes) {
            for (to, column) in own.iter_mut().zip(slopes) {
                to.joints.iter_mut().zip(column).for_each(|(to, slope)| *to = -slope);
            }
        }
        let states = joints.carrier.states().zip(device.passive.values()).enumerate();
        for (joint, ([_, rate], passive)) in states {
            for (own, slope) in own.iter_mut().zip([passive.stiffness, passive.damping(rate)]) {
                if let Some(to) = own.get_mut(joint).and_then(|of| of.joints.get_mut(joint)) {
                    *to = *to + slope;
                }
            }
        }
        if let Some(applied) = Applied::new(device, &joints.carrier, of_carrier.bodies, None) {
            let [coordinates, _] = &mut own;
            let both = coordinates.iter_mut().zip(&applied.coordinates);
            both.for_each(|(to, from)| to.add(one(), from));
            let [force, moment] = applied.hub;
            if let Some(Base { load: [f, m], .. }) = self.bases.get_mut(base) {
                (*f, *m) = (sub(*f, force), sub(*m, moment));
            }
            self.by_wrenches.extend(by_wrenches(device, &joints.carrier));
        }
        let modes = of_carrier.modes.values();
        self.joints.extend(modes.map(|mode| (Owner::Carrier(number), mode == Mode::Driven)));
        let body = C::base(&device.constants).body;
        let (load, moments) = (motion.load(&body, field.as_ref()), Moments::of_body(&body));
        let link = Some(link);
        let shapes = None;
        self.bases.push(Base { link, first, own, body, field, motion, load, moments, shapes });
        self.base = number;
        let data = (&joints.carried, of_carried, &accelerations.carried);
        D::visit::<Moving, _>(&carrying.carried, data, self)?;
        self.base = base;
        Ok(())
    }
}

impl<T: Scalar> Member<T> {
    /// What its base and its motors exert more where the base's motion changes.
    pub(crate) fn by_motion(&self, change: &BaseMotion<T>) -> Load<T> {
        let columns = &self.columns;
        let mut sum = Load::none();
        let turning = columns.omega.iter().zip(change.omega);
        let by_omega_dot = columns.omega_dot.iter().zip(change.omega_dot);
        let by_position = self.position.iter().flatten().zip(change.rho);
        for (load, by) in turning.chain(by_omega_dot).chain(by_position) {
            sum.add(by, load);
        }
        sum.add(one(), &self.by_acceleration(change.acceleration));
        sum
    }

    /// The same for an acceleration of its origin. The mass matrix is symmetric, and so is known from its other columns.
    fn by_acceleration(&self, by: Vec3<T>) -> Load<T> {
        let along =
            |of: &Load<T>| of.hub.iter().zip(by).fold(zero(), |sum: T, (a, b)| sum + *a * b);
        let [x, y, z] = scale(self.mass, by);
        let [p, q, r] = self.columns.omega_dot.each_ref().map(along);
        let joints = self.columns.accelerations.each_ref().map(along);
        Load { hub: [x, y, z, p, q, r], joints }
    }
}

impl<T: Scalar> DeviceLoads<T> {
    /// The first moment s about the origin of the base, base axes: the force by an angular acceleration e is `e x s`.
    fn first_moment(&self) -> Vec3<T> {
        let [x, y, _] = &self.omega_dot;
        let ([_, minus_z, s_y, ..], [_, _, minus_x, ..]) = (x.hub, y.hub);
        [-minus_x, s_y, -minus_z]
    }
}

/// Force and moment about the origin of its base that a device needs, base axes.
fn needed<K: Kind>(
    device: &Device<K>,
    joints: &K::Joints<K::Scalar>,
    omega: Vec3<K::Scalar>,
    base: &HubAccelerations<K::Scalar>,
    accelerations: &K::Accelerations<K::Scalar>,
) -> Spatial<K::Scalar> {
    let within = |v| rotate_transposed(&device.mount, v);
    let hub = Solution { r_b_n_ddot: within(base.r_b_n_ddot), omega_dot: within(base.omega_dot) };
    let (pose, omega) = (K::pose(joints), expressed_in_b(within(omega)));
    let of = (&device.constants, &hub.expressed_in_b());
    let loads = K::loads(of.0, &pose, joints, &omega, of.1, accelerations);
    spatial(&loads.hub.turned(&device.mount))
}

/// The derivative of the first moment by a coordinate, base axes: its rate where only that coordinate has one.
fn first_moment_by<K: Kind>(
    device: &Device<K>,
    joints: &K::Joints<K::Scalar>,
    joint: usize,
) -> Vec3<K::Scalar> {
    let mut moving = *joints;
    for (number, [_, rate]) in moving.states_mut().enumerate() {
        *rate = if number == joint { one() } else { zero() };
    }
    let [_, prime] = K::first_moment(&device.constants, &moving);
    rotate(&device.mount, prime)
}
