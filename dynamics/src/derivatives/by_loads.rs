//! [`ByLoads`]: how accelerations change with state and inputs, by the emitted derivatives of the loads.
//!
//! With `M a + bias = loads` the accelerations change by `-M⁻¹` times what the loads change by at given accelerations.
//! A device's loads depend on its own joints and on the hub's motion, so a column costs one elimination. Seen from a
//! frame that falls with a uniform field the attitude does not enter.

use alloc::vec::Vec;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::applied_columns::Applied;
use crate::derivatives::field_columns::FieldColumns;
use crate::derivatives::load_columns::{EachDevice, Load, LoadColumns, Moving};
use crate::derivatives::mass_system::{MassSystem, Six};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::equations::gravity::Central;
use crate::equations::hub::HubConstants;
use crate::equations::load_sums::HubAccelerations;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::mode::HubMode;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, columns, components, cross, rotate, sub};
use crate::sets::devices::Devices;
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// The derivatives of the loads at a state, and the mass matrix.
#[derive(Debug)]
pub(super) struct ByLoads<T> {
    devices: Vec<LoadColumns<T>>,
    system: MassSystem<T>,
    hub: HubConstants<T>,
    omega: Vec3<T>,
    /// A uniform field, B axes.
    gravity: Vec3<T>,
    hub_is_free: bool,
    central: Option<OfField<T>>,
    /// Of each joint, by the wrench on its child body.
    by_wrenches: Vec<[Load<T>; 6]>,
}

/// What a central field adds.
#[derive(Debug)]
struct OfField<T> {
    central: Central<T>,
    columns: FieldColumns<T>,
    /// What hub and motors exert more by each component of the position of B, B axes: on the hub, on each device.
    hub: [Six<T>; 3],
    devices: [Vec<[T; MAX_JOINTS]>; 3],
}

/// What accelerations change by: of B along its axes, of the angular velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct HubChange<T> {
    pub(super) r_b_n_ddot: Vec3<T>,
    pub(super) omega_dot: Vec3<T>,
}

impl<T: Scalar> ByLoads<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a flexible structure,
    /// platforms.
    pub(super) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<Self> {
        if S::modes(craft) > 0 || S::mounts(craft) > 0 {
            return None;
        }
        let start = evaluation_start(state, inputs);
        let (omega, gravity) = (start.environment.omega, start.at_b);
        let hub = HubAccelerations {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), gravity),
            omega_dot: components(&accelerations.omega_dot),
        };
        let bn = columns(&state.attitude.dcm());
        let field = start.environment.central;
        let mut each = EachDevice::new(omega, hub, field);
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut each).ok()?;
        let of_field = FieldColumns::new(&inputs.gravity, bn, &state.r_b_n).zip(field);
        let central = of_field.map(|field| OfField::new(&craft.hub, &mut each, field));
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let system = MassSystem::new(&craft.hub, craft.mass(), &each.found, hub_is_free);
        let EachDevice { found: devices, by_wrenches, .. } = each;
        let hub = craft.hub;
        Some(Self { devices, system, hub, omega, gravity, hub_is_free, central, by_wrenches })
    }

    /// The accelerations' derivatives by one variable, those of the joints into `joints`.
    pub(super) fn column(&self, by: Variable, joints: &mut [T]) -> HubChange<T> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let none = zero::<T>();
        let (still, loadless) = ([none; 6], [none; 6]);
        let apart =
            |[a, b, c, d, e, f]: Six<T>| HubChange { r_b_n_ddot: [a, b, c], omega_dot: [d, e, f] };
        let six = |[a, b, c]: Vec3<T>, [d, e, f]: Vec3<T>| [a, b, c, d, e, f];
        let zeros = [none; 3];
        let nothing = |joints: &mut [T]| {
            joints.fill(none);
            apart(still)
        };
        match by {
            Variable::BodyForce(joint, axis) => self.by_wrench(joint, axis as usize, joints),
            Variable::BodyMoment(joint, axis) => {
                self.by_wrench(joint, (axis as usize).saturating_add(3), joints)
            }
            Variable::Attitude(axis) => {
                if let Some(central) = &self.central {
                    let moved = cross(central.columns.rho, unit(axis));
                    return self.by_position(central, moved, joints);
                }
                // [BN] g changes by its product with the small rotation.
                let field = cross(self.gravity, unit(axis));
                let falling = six(sub(zeros, field), zeros);
                let given = if self.hub_is_free { still } else { falling };
                let base = apart(self.system.solve(&loadless, (0, &[]), given, joints));
                HubChange { r_b_n_ddot: add(base.r_b_n_ddot, field), ..base }
            }
            Variable::Omega(axis) => {
                let of_devices = self.devices.iter().filter_map(|of| of.omega.get(axis as usize));
                let loads: Vec<&Load<T>> = of_devices.collect();
                let mut hub = of_both(self.hub.loads_by_omega(self.omega, unit(axis)));
                for load in &loads {
                    hub.iter_mut().zip(load.hub).for_each(|(to, from)| *to = *to + from);
                }
                let own: Vec<_> = loads.iter().map(|load| load.joints).collect();
                apart(self.system.solve(&hub, (0, &own), still, joints))
            }
            Variable::Coordinate(joint) => self.by_joint(joint, |of| &of.coordinates, joints),
            Variable::Rate(joint) => self.by_joint(joint, |of| &of.rates, joints),
            Variable::Motor(joint) => {
                let (device, own) = self.device(joint);
                let mut loads = [none; MAX_JOINTS];
                if let Some(load) = loads.get_mut(own) {
                    *load = -one::<T>();
                }
                apart(self.system.solve(&loadless, (device, &[loads]), still, joints))
            }
            Variable::Acceleration(joint) => {
                let base = self.by_joint(joint, |of| &of.accelerations, joints);
                if let Some(own) = joints.get_mut(joint) {
                    *own = one();
                }
                base
            }
            Variable::Force(axis) => {
                let hub = six(sub(zeros, unit(axis)), zeros);
                apart(self.system.solve(&hub, (0, &[]), still, joints))
            }
            Variable::TorqueB(axis) => {
                let hub = six(zeros, sub(zeros, unit(axis)));
                apart(self.system.solve(&hub, (0, &[]), still, joints))
            }
            Variable::HubAcceleration(axis) => {
                apart(self.system.solve(&loadless, (0, &[]), six(unit(axis), zeros), joints))
            }
            Variable::HubAngularAcceleration(axis) => {
                apart(self.system.solve(&loadless, (0, &[]), six(zeros, unit(axis)), joints))
            }
            Variable::Position(axis) => match &self.central {
                Some(of) => self.by_position(of, rotate(&of.columns.bn, unit(axis)), joints),
                None => nothing(joints),
            },
            _ => nothing(joints),
        }
    }

    fn by_joint(
        &self,
        joint: usize,
        which: impl Fn(&LoadColumns<T>) -> &[Load<T>; MAX_JOINTS],
        joints: &mut [T],
    ) -> HubChange<T> {
        let (device, own) = self.device(joint);
        let load = self.devices.get(device).and_then(|of| which(of).get(own));
        let load = load.copied().unwrap_or_else(Load::none);
        let still = [zero(); 6];
        let base = self.system.solve(&load.hub, (device, &[load.joints]), still, joints);
        let [a, b, c, d, e, f] = base;
        HubChange { r_b_n_ddot: [a, b, c], omega_dot: [d, e, f] }
    }

    /// By a component of the wrench on the child body of a joint.
    fn by_wrench(&self, joint: usize, component: usize, joints: &mut [T]) -> HubChange<T> {
        let (device, _) = self.device(joint);
        let load = self.by_wrenches.get(joint).and_then(|of| of.get(component));
        let load = load.copied().unwrap_or_else(Load::none);
        let [a, b, c, d, e, f] =
            self.system.solve(&load.hub, (device, &[load.joints]), [zero(); 6], joints);
        HubChange { r_b_n_ddot: [a, b, c], omega_dot: [d, e, f] }
    }

    /// Where the position of B from the centre, B axes, changes by `moved`.
    fn by_position(&self, of: &OfField<T>, moved: Vec3<T>, joints: &mut [T]) -> HubChange<T> {
        let field = of.central.gradient.times(moved);
        let still = [zero(); 3];
        let [[a, b, c], [d, e, f]] =
            [if self.hub_is_free { still } else { sub(still, field) }, still];
        let mut hub = [zero(); 6];
        let mut loads = alloc::vec![[zero(); MAX_JOINTS]; self.devices.len()];
        for (component, (of_hub, of_devices)) in moved.iter().zip(of.hub.iter().zip(&of.devices)) {
            let all = core::iter::once((&mut hub[..], &of_hub[..]));
            let devices =
                loads.iter_mut().zip(of_devices).map(|(to, from)| (&mut to[..], &from[..]));
            for (to, from) in all.chain(devices) {
                to.iter_mut().zip(from).for_each(|(to, from)| *to = *to + *component * *from);
            }
        }
        let [u, v, w, p, q, r] = self.system.solve(&hub, (0, &loads), [a, b, c, d, e, f], joints);
        HubChange { r_b_n_ddot: add([u, v, w], field), omega_dot: [p, q, r] }
    }

    /// The device of a joint, and the joint's number in it.
    fn device(&self, joint: usize) -> (usize, usize) {
        let mut own = joint;
        for (device, columns) in self.devices.iter().enumerate() {
            if own < columns.count {
                return (device, own);
            }
            own = own.saturating_sub(columns.count);
        }
        (self.devices.len(), own)
    }
}

/// Force and moment about B.
fn of_both<T>([[a, b, c], [d, e, f]]: [Vec3<T>; 2]) -> Six<T> {
    [a, b, c, d, e, f]
}

impl<T: Scalar> OfField<T> {
    /// Of what has been found of the devices, to whose coordinates the third-order force is added.
    fn new(
        hub: &HubConstants<T>,
        each: &mut EachDevice<T>,
        (field, central): (FieldColumns<T>, Central<T>),
    ) -> Self {
        let mut second_moment = hub.second_moment();
        let mut by: [Load<T>; 3] = [Load::none(); 3];
        let mut devices = [const { Vec::new() }; 3];
        for (columns, applied) in each.found.iter_mut().zip(&each.applied) {
            let Some(Applied { position, second_moment: own, second_moment_by, .. }) = applied
            else {
                continue;
            };
            second_moment = second_moment.plus(*own);
            for (to, second) in columns.coordinates.iter_mut().zip(second_moment_by) {
                let force = central.third_order(second);
                to.hub.iter_mut().zip(force).for_each(|(to, force)| *to = *to - force);
            }
            for ((to, all), load) in by.iter_mut().zip(&mut devices).zip(position) {
                to.add(one(), load);
                all.push(load.joints);
            }
        }
        for (to, from) in by.iter_mut().zip(field.on_hub(hub, &second_moment)) {
            to.hub.iter_mut().zip(from).for_each(|(to, from)| *to = *to - from);
        }
        Self { central, columns: field, hub: by.map(|load| load.hub), devices }
    }
}
