//! [`DeviceLoads`]: derivatives of the loads of a device of a tree, by its emitted kernel, with what acts on it.

use crate::derivatives::loads::kernel::{NotEmitted, load_derivatives};
use crate::derivatives::loads::side_by_side::Load;
use crate::derivatives::tree::applied_columns::Applied;
use crate::equations::device::Device;
use crate::equations::gravity::Central;
use crate::equations::joint_inputs::DeviceInputs;
use crate::equations::load_sums::HubAccelerations;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{Kind, LoadColumn};
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one};
use crate::numbers::vec3::{Columns, Vec3, components, rotate};

/// Those of one device, for whose hub its base stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DeviceLoads<T> {
    /// The number of its joints.
    pub(crate) count: usize,
    /// Which joints have an acceleration that is not given.
    pub(crate) free: [bool; MAX_JOINTS],
    pub(crate) coordinates: [Load<T>; MAX_JOINTS],
    pub(crate) rates: [Load<T>; MAX_JOINTS],
    /// By the joints' accelerations: columns of the mass matrix.
    pub(crate) accelerations: [Load<T>; MAX_JOINTS],
    /// By the angular velocity of the hub, B axes.
    pub(crate) omega: [Load<T>; 3],
    /// By its angular acceleration.
    pub(crate) omega_dot: [Load<T>; 3],
}

impl<T: Scalar> Load<T> {
    /// Of a column in the device's axes.
    fn turned<K: Kind<Scalar = T>>(column: &LoadColumn<K, T>, mount: &Columns<T>) -> Self {
        let [a, b, c] = rotate(mount, components(&column.hub.force));
        let [d, e, f] = rotate(mount, components(&column.hub.moment));
        let mut load = Self { hub: [a, b, c, d, e, f], ..Self::none() };
        load.joints.iter_mut().zip(column.joints.values()).for_each(|(to, from)| *to = from);
        load
    }

    /// Adds a multiple.
    pub(crate) fn add(&mut self, factor: T, other: &Self) {
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

impl<T: Scalar> DeviceLoads<T> {
    /// Adds what acts from outside, which hub and motors exert less.
    fn add_applied(&mut self, applied: &Applied<T>) {
        let columns = self.coordinates.iter_mut().chain(&mut self.rates);
        let more = applied.coordinates.iter().chain(&applied.rates);
        columns.zip(more).for_each(|(to, from)| to.add(one(), from));
    }

    /// Of a device on a base that moves so, in a field; with what acts on it from outside.
    pub(crate) fn new<K: Kind<Scalar = T>>(
        device: &Device<K>,
        (joints, given, accelerations): (&K::Joints<T>, &DeviceInputs<'_, K>, &K::Accelerations<T>),
        (omega, base): (Vec3<T>, &HubAccelerations<T>),
        field: Option<&Central<T>>,
    ) -> Result<(Self, Option<Applied<T>>), NotEmitted> {
        let found = load_derivatives(device, joints, accelerations, (omega, base))?;
        let each = |columns: &K::PerJoint<LoadColumn<K, T>>| {
            let mut loads = [Load::none(); MAX_JOINTS];
            for (to, from) in loads.iter_mut().zip(columns.values()) {
                *to = Load::turned::<K>(&from, &device.mount);
            }
            loads
        };
        let by_hub = |[x, y, z]: &[LoadColumn<K, T>; 3]| {
            let turned = |column| Load::turned::<K>(column, &device.mount);
            Load::by_b([turned(x), turned(y), turned(z)], &device.mount)
        };
        let mut free = [false; MAX_JOINTS];
        let modes = given.modes.values().zip(K::JOINTS);
        for (free, (mode, info)) in free.iter_mut().zip(modes) {
            *free = mode == Mode::Driven && info.driven;
        }
        let mut columns = DeviceLoads {
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
        let applied = Applied::new(device, joints, given.bodies, field);
        if let Some(applied) = &applied {
            columns.add_applied(applied);
        }
        Ok((columns, applied))
    }
}
