//! [`LoadColumns`]: derivatives of the loads of each device, expressed in B, by its emitted kernel.

use alloc::vec::Vec;

use crate::derivatives::applied_columns::{Applied, by_wrenches};
use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::gravity::Central;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::system::Solution;
use crate::isolation::carrier::Carrier;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{Kind, LoadColumn};
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, Vec3, components, rotate, rotate_transposed};
use crate::sets::bundle::{Bundle, Given, Shared};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;

/// Derivatives by one variable: of force and moment about B that the hub exerts on a device, B axes, and of what each
/// motor exerts less spring and friction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load<T> {
    pub(super) hub: [T; 6],
    pub(super) joints: [T; MAX_JOINTS],
}

/// Those of one device.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoadColumns<T> {
    /// The number of its joints.
    pub(super) count: usize,
    /// Which joints have an acceleration that is not given.
    pub(super) free: [bool; MAX_JOINTS],
    pub(super) coordinates: [Load<T>; MAX_JOINTS],
    pub(super) rates: [Load<T>; MAX_JOINTS],
    /// By the joints' accelerations: columns of the mass matrix.
    pub(super) accelerations: [Load<T>; MAX_JOINTS],
    /// By the angular velocity of the hub, B axes.
    pub(super) omega: [Load<T>; 3],
    /// By its angular acceleration.
    pub(super) omega_dot: [Load<T>; 3],
}

impl<T: Scalar> Load<T> {
    pub(super) fn none() -> Self {
        Self { hub: [zero(); 6], joints: [zero(); MAX_JOINTS] }
    }

    /// Of a column in the device's axes.
    fn turned<K: Kind<Scalar = T>>(column: &LoadColumn<K>, mount: &Columns<T>) -> Self {
        let [a, b, c] = rotate(mount, components(&column.hub.force));
        let [d, e, f] = rotate(mount, components(&column.hub.moment));
        let mut load = Self { hub: [a, b, c, d, e, f], ..Self::none() };
        load.joints.iter_mut().zip(column.joints.values()).for_each(|(to, from)| *to = from);
        load
    }

    /// Adds a multiple.
    pub(super) fn add(&mut self, factor: T, other: &Self) {
        for (to, from) in self.hub.iter_mut().zip(&other.hub) {
            *to = *to + factor * *from;
        }
        for (to, from) in self.joints.iter_mut().zip(&other.joints) {
            *to = *to + factor * *from;
        }
    }

    /// By components along B, of those by components along the device's axes.
    fn by_b(columns: [Self; 3], mount: &Columns<T>) -> [Self; 3] {
        let by = |axis: usize| {
            let mut sum = Self::none();
            for (column, own) in columns.iter().zip(mount) {
                sum.add(own[axis], column);
            }
            sum
        };
        [by(0), by(1), by(2)]
    }
}

impl<T: Scalar> LoadColumns<T> {
    /// Adds what acts from outside, which hub and motors exert less.
    fn add_applied(&mut self, applied: &Applied<T>) {
        let columns = self.coordinates.iter_mut().chain(&mut self.rates);
        let more = applied.coordinates.iter().chain(&applied.rates);
        columns.zip(more).for_each(|(to, from)| to.add(one(), from));
    }
}

/// A device has no emitted derivatives: a platform.
#[derive(Debug)]
pub(super) struct NotEmitted;

/// Evaluates the kernel of each device.
pub(super) struct EachDevice<T> {
    pub(super) omega: Vec3<T>,
    /// As seen from a frame that falls with the field.
    pub(super) hub: HubAccelerations<T>,
    /// The gradient of a central field.
    pub(super) field: Option<Central<T>>,
    pub(super) found: Vec<LoadColumns<T>>,
    /// What acts on each device from outside.
    pub(super) applied: Vec<Option<Applied<T>>>,
    /// Of each joint, by the wrench on its child body; none where there are no wrenches on bodies.
    pub(super) by_wrenches: Vec<[Load<T>; 6]>,
}

impl<T> EachDevice<T> {
    pub(super) fn new(omega: Vec3<T>, hub: HubAccelerations<T>, field: Option<Central<T>>) -> Self {
        Self { omega, hub, field, found: Vec::new(), applied: Vec::new(), by_wrenches: Vec::new() }
    }
}

/// State, inputs and accelerations of the joints.
pub(super) type Moving = (Shared<data::Joints>, Given, Shared<data::Accelerations>);

impl<T: Scalar> Visit<T, Moving> for EachDevice<T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations): <Moving as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        let within = |v| rotate_transposed(&device.mount, v);
        let HubAccelerations { r_b_n_ddot, omega_dot } = self.hub;
        let hub = Solution { r_b_n_ddot: within(r_b_n_ddot), omega_dot: within(omega_dot) };
        let found = K::load_derivatives(
            &device.constants,
            &K::pose(joints),
            joints,
            &expressed_in_b(within(self.omega)),
            &hub.expressed_in_b(),
            accelerations,
        );
        let found = found.ok_or(NotEmitted)?;
        let each = |columns: &K::PerJoint<LoadColumn<K>>| {
            let mut loads = [Load::none(); MAX_JOINTS];
            for (to, from) in loads.iter_mut().zip(columns.values()) {
                *to = Load::turned::<K>(&from, &device.mount);
            }
            loads
        };
        let by_hub = |[x, y, z]: &[LoadColumn<K>; 3]| {
            let turned = |column| Load::turned::<K>(column, &device.mount);
            Load::by_b([turned(x), turned(y), turned(z)], &device.mount)
        };
        let mut free = [false; MAX_JOINTS];
        let modes = given.modes.values().zip(K::JOINTS);
        for (free, (mode, info)) in free.iter_mut().zip(modes) {
            *free = mode == Mode::Driven && info.driven;
        }
        let mut columns = LoadColumns {
            count: K::JOINTS.len(),
            free,
            coordinates: each(&found.coordinates),
            rates: each(&found.rates),
            accelerations: each(&found.accelerations),
            omega: by_hub(&found.omega),
            omega_dot: by_hub(&found.omega_dot),
        };
        let passive = joints.states().zip(device.passive.values()).enumerate();
        for (joint, ([_, rate], passive)) in passive {
            let own = [&mut columns.coordinates, &mut columns.rates];
            for (columns, slope) in own.into_iter().zip([passive.stiffness, passive.damping(rate)])
            {
                if let Some(to) = columns.get_mut(joint).and_then(|of| of.joints.get_mut(joint)) {
                    *to = *to + slope;
                }
            }
        }
        let applied = Applied::new(device, joints, given.bodies, self.field.as_ref());
        if let Some(applied) = &applied {
            columns.add_applied(applied);
        }
        if given.bodies.is_some() {
            self.by_wrenches.extend(by_wrenches(device, joints));
        }
        self.applied.push(applied);
        self.found.push(columns);
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}
