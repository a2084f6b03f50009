//! [`ByLoads`]: how accelerations change with state and inputs, by the emitted derivatives of the loads.
//!
//! With `M a + bias = loads` the accelerations change by `-M⁻¹` times what the loads change by at given accelerations.
//! A device's loads depend on its own joints and on the hub's motion, so a column costs one elimination. Seen from a
//! frame that falls with a uniform field the attitude does not enter.

use alloc::vec::Vec;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::load_columns::{EachDevice, Load, LoadColumns, Moving};
use crate::derivatives::mass_system::{MassSystem, Six};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::equations::gravity::Gravity;
use crate::equations::hub::HubConstants;
use crate::equations::load_sums::HubAccelerations;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::mode::HubMode;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, components, cross, sub};
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
}

/// What accelerations change by: of B along its axes, of the angular velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct HubChange<T> {
    pub(super) r_b_n_ddot: Vec3<T>,
    pub(super) omega_dot: Vec3<T>,
}

impl<T: Scalar> ByLoads<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a flexible structure,
    /// platforms, lumped imbalance, wrenches on bodies, a central field.
    pub(super) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<Self> {
        let central = matches!(inputs.gravity, Gravity::Central { .. });
        let deforms = S::modes(craft) > 0 || S::mounts(craft) > 0;
        if central || deforms || inputs.bodies.is_some() {
            return None;
        }
        let start = evaluation_start(state, inputs);
        let (omega, gravity) = (start.environment.omega, start.at_b);
        let hub = HubAccelerations {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), gravity),
            omega_dot: components(&accelerations.omega_dot),
        };
        let mut each = EachDevice { omega, hub, found: Vec::new() };
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut each).ok()?;
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let system = MassSystem::new(&craft.hub, craft.mass(), &each.found, hub_is_free);
        Some(Self { devices: each.found, system, hub: craft.hub, omega, gravity, hub_is_free })
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
        match by {
            Variable::Attitude(axis) => {
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
            _ => {
                joints.fill(none);
                apart(still)
            }
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
