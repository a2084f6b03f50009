//! [`ParameterLoads`]: how accelerations change with parameters, by what the loads change by at given accelerations.
//!
//! With `M a + bias = loads` the accelerations change by `-M⁻¹` times that. A parameter changes the loads of its device
//! only, by the equations of its bodies ([`DeviceMotion`]); one elimination serves all.

use alloc::vec;
use alloc::vec::Vec;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::column::Column;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::loads::each_device::EachDevice;
use crate::derivatives::loads::kernel::Moving;
use crate::derivatives::loads::load_columns::{LoadColumns, LoadsWorkspace};
use crate::derivatives::loads::mass_system::MassSystem;
use crate::derivatives::loads::side_by_side::{Finiteness, Load, Six};
use crate::derivatives::parameters::change::{add_change, add_hub_change, unit};
use crate::derivatives::parameters::columns::ParameterVariable;
use crate::derivatives::parameters::device_motion::{DeviceMotion, GivenJoint, LoadChange};
use crate::derivatives::parameters::direction::{ParameterDirection, rotation};
use crate::derivatives::parameters::rigid_body::{Motion, RigidBody};
use crate::equations::gravity::Gravity;
use crate::equations::load_sums::HubAccelerations;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{BodyParameters, ImbalanceModel, Kind, no_body, no_inertia};
use crate::model::mode::HubMode;
use crate::model::parameters::Hub;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, columns, components, rotate_transposed, sub, vector, zeros};
use crate::sets::device_parameters::DeviceParameters;
use crate::sets::devices::{DeviceSet, Devices};
use crate::sets::per_device as data;
use crate::sets::with_numbers::{Change, WithNumbers};
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Hub and devices in motion, and the mass matrix.
pub(crate) struct ParameterLoads<'a, D: WithNumbers> {
    hub: RigidBody<D::Scalar>,
    /// Seen from a frame that falls with a uniform field.
    motion: Motion<D::Scalar>,
    devices: D,
    joints: Joints<'a, D>,
    /// The last device of which a parameter was requested, and its number.
    device: (DeviceMotion<D::Scalar>, Option<usize>),
    system: MassSystem<D::Scalar>,
    columns: LoadColumns<D::Scalar>,
    bn: Columns<D::Scalar>,
    /// Of all joints.
    accelerations: Vec<D::Scalar>,
    column: Column<D>,
}

/// State, accelerations and wrenches of the joints of a set.
struct Joints<'a, D: Devices> {
    states: &'a <D as DeviceSet>::Per<data::Joints>,
    accelerations: &'a <D as DeviceSet>::Per<data::Accelerations>,
    bodies: Option<&'a <D as DeviceSet>::Per<data::PerJoint<Wrench<D::Scalar>>>>,
}

impl<'a, D: WithNumbers> ParameterLoads<'a, D> {
    /// At a state with its accelerations; none where a set has a platform or a lumped imbalance, and in a central field.
    pub(crate) fn new<A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        (hub, devices): (&Hub<D::Scalar>, &D),
        (state, inputs): (&'a State<D, A>, &'a Inputs<D>),
        accelerations: &'a Accelerations<D>,
    ) -> Option<Self> {
        if matches!(inputs.gravity, Gravity::Central { .. }) {
            return None;
        }
        let start = evaluation_start(state, inputs);
        let motion = Motion {
            omega: start.environment.omega,
            spin: zeros(),
            omega_dot: components(&accelerations.omega_dot),
            acceleration: sub(components(&accelerations.r_b_n_ddot), start.at_b),
        };
        let Motion { omega, omega_dot, acceleration: r_b_n_ddot, .. } = motion;
        let falling = HubAccelerations { r_b_n_ddot, omega_dot };
        let (by, joints) = (craft.arithmetic, accelerations.devices.values().count());
        let mut workspace = LoadsWorkspace::new();
        let each = EachDevice::new(by, (omega, falling), joints, &mut workspace);
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut each.keeping_eliminations()).ok()?;
        let LoadsWorkspace { columns: loads, .. } = workspace;
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        Some(Self {
            hub: RigidBody::of_hub(hub),
            motion,
            devices: devices.clone(),
            joints: Joints {
                states: &state.devices,
                accelerations: &accelerations.devices,
                bodies: inputs.bodies.as_ref(),
            },
            device: (DeviceMotion::none(), None),
            system: MassSystem::new(&craft.hub, craft.mass(), &loads.sums.matrix, hub_is_free),
            columns: loads,
            bn: columns(&state.attitude.dcm()),
            accelerations: vec![zero(); joints],
            column: Column {
                accelerations: craft.no_accelerations(),
                r_b_n_ddot_n: vector(zeros()),
                momentum: None,
                loads: None,
                hub_load: None,
            },
        })
    }

    /// The derivatives of the accelerations by a parameter.
    pub(crate) fn column(
        &mut self,
        variable: ParameterVariable<'_>,
    ) -> Result<&Column<D>, DerivativeError<D::Scalar>> {
        let load = self.load(variable)?;
        let found = self.accelerated(variable.device(), &load.into());
        if !found.iter().chain(&self.accelerations).all(|number| number.is_finite()) {
            return Err(DerivativeError::NotFinite { variable: 0 });
        }
        let [a, b, c, d, e, f] = found;
        let to = &mut self.column.accelerations;
        (to.r_b_n_ddot, to.omega_dot) = (vector([a, b, c]), vector([d, e, f]));
        self.column.r_b_n_ddot_n = vector(rotate_transposed(&self.bn, [a, b, c]));
        for (to, from) in to.devices.values_mut().zip(&self.accelerations) {
            *to = *from;
        }
        Ok(&self.column)
    }

    /// Adds what the accelerations change by with the parameters along a direction, that changes these devices, in the order of
    /// the rows of `c`.
    pub(crate) fn add_along(
        &mut self,
        direction: &ParameterDirection<D::Scalar>,
        devices: impl Iterator<Item = usize>,
        to: &mut [D::Scalar],
    ) -> Result<(), DerivativeError<D::Scalar>> {
        if let Some(change) = direction.of_hub() {
            let load = LoadChange::of_hub(self.hub.wrench_by_body(&self.motion, &change));
            self.add_accelerated(None, load, to);
        }
        for device in devices {
            let Some(change) = direction.devices.get(device) else { continue };
            let load = self.load_of_device(device, By::Direction(change))?;
            self.add_accelerated(Some(device), load, to);
        }
        Ok(())
    }

    /// Adds the accelerations where the loads of a device, or of the hub alone, change.
    fn add_accelerated(
        &mut self,
        device: Option<usize>,
        load: LoadChange<D::Scalar>,
        to: &mut [D::Scalar],
    ) {
        let hub = self.accelerated(device, &load.into());
        let found = hub.iter().chain(&self.accelerations);
        to.iter_mut().zip(found).for_each(|(to, from)| *to = *to + *from);
    }

    /// The accelerations where the loads of a device, or of the hub alone, change: of the hub, those of the joints into
    /// `accelerations`.
    fn accelerated(&mut self, device: Option<usize>, load: &Load<D::Scalar>) -> Six<D::Scalar> {
        let eliminated = self.columns.eliminated.as_deref().unwrap_or_default();
        let others = eliminated.iter().take(device.unwrap_or_default());
        let first = others.map(|(count, _)| *count).sum();
        let eliminated = device.and_then(|device| eliminated.get(device));
        let (hub, joints) = eliminated.map_or_else(
            || (load.hub.map(|load| -load), [zero(); MAX_JOINTS]),
            |(_, of)| of.reduced(&load.hub, &load.joints),
        );
        let base = self.system.hub(&hub, [zero(); 6]);
        let finite = &mut Finiteness::of_none();
        self.columns.gains().follow(&base, &mut self.accelerations, finite);
        let own = self.accelerations.iter_mut().skip(first);
        let count = eliminated.map_or(0, |(count, _)| *count);
        own.zip(joints).take(count).for_each(|(to, less)| *to = *to - less);
        base
    }

    /// What the loads change by.
    fn load(&mut self, variable: ParameterVariable<'_>) -> Changed<D::Scalar> {
        let Some(device) = variable.device() else {
            let none = Hub { m_b: zero(), r_bc_b: vector(zeros()), i_b_bc: no_inertia() };
            let mut change = none;
            add_hub_change(&mut change, variable, |of| *of = *of + one());
            let change = RigidBody::of_hub(&change);
            return Ok(LoadChange::of_hub(self.hub.wrench_by_body(&self.motion, &change)));
        };
        self.load_of_device(device, By::Variable(variable))
    }

    /// What the loads of a device change by.
    fn load_of_device(&mut self, device: usize, by: By<'_, D::Scalar>) -> Changed<D::Scalar> {
        let Self { motion: hub, devices, joints, device: motion, .. } = self;
        let mut visit =
            OfDevice { next: 0, first_joint: 0, device, by, hub, joints, motion, found: None };
        devices.change(&mut visit);
        let OfDevice { next: devices, found, .. } = visit;
        found.unwrap_or(Err(DerivativeError::NoSuchDevice { device, devices }))
    }
}

/// A change of loads, or why there is none.
type Changed<T> = Result<LoadChange<T>, DerivativeError<T>>;

/// What changes of a device.
#[derive(Clone, Copy)]
enum By<'a, T> {
    Variable(ParameterVariable<'a>),
    /// All parameters, so.
    Direction(&'a DeviceParameters<T>),
}

impl<T: Scalar> From<LoadChange<T>> for Load<T> {
    fn from(LoadChange { force, moment, joints }: LoadChange<T>) -> Self {
        let ([a, b, c], [d, e, f]) = (force, moment);
        Self { hub: [a, b, c, d, e, f], joints }
    }
}

/// What the loads of one device change by with parameters of it.
struct OfDevice<'a, 'b, D: Devices> {
    /// The number of the device that comes next, and of its first joint.
    next: usize,
    first_joint: usize,
    device: usize,
    by: By<'a, D::Scalar>,
    hub: &'a Motion<D::Scalar>,
    joints: &'a Joints<'b, D>,
    motion: &'a mut (DeviceMotion<D::Scalar>, Option<usize>),
    found: Option<Changed<D::Scalar>>,
}

impl<D: Devices> Change<D::Scalar> for OfDevice<'_, '_, D> {
    fn change<K: Kind<Scalar = D::Scalar>>(&mut self, device: &mut K) {
        if self.next == self.device {
            self.found = Some(self.load(device));
        }
        self.next = self.next.saturating_add(1);
        self.first_joint = self.first_joint.saturating_add(K::JOINTS.len());
    }
}

impl<D: Devices> OfDevice<'_, '_, D> {
    fn load<K: Kind<Scalar = D::Scalar>>(&mut self, device: &K) -> Changed<D::Scalar> {
        if self.motion.1 != Some(self.device) {
            self.set_motion(device);
        }
        let motion = &self.motion.0;
        let variable = match self.by {
            By::Variable(ParameterVariable::MountRotation { about, .. }) => {
                return Ok(motion.by_mount(unit(about)));
            }
            By::Variable(variable) => variable,
            By::Direction(DeviceParameters { mount, bodies, passive, .. }) => {
                let turned = rotation(device.mount(), mount);
                let mut load = if turned.iter().all(|angle| angle.vanishes()) {
                    LoadChange::none()
                } else {
                    motion.by_mount(turned)
                };
                let count = K::JOINTS.len();
                add_by_bodies(motion, bodies.iter().take(count).copied(), &mut load);
                self.add_by_passive(device, passive.iter().copied(), &mut load);
                return Ok(load);
            }
        };
        let mut load = LoadChange::none();
        let none = K::all(no_body());
        let free = K::all(Passive::none());
        let mut change = K::of_bodies(&no_inertia(), &none, &free, ImbalanceModel::Coupled);
        let which = (self.device, variable);
        add_change(&mut change, (device, |of| of), which, |to, by| *to = *to + by)?;
        add_by_bodies(motion, change.bodies().values(), &mut load);
        self.add_by_passive(device, change.passive().values(), &mut load);
        Ok(load)
    }

    /// Adds what springs and friction change by.
    fn add_by_passive<K: Kind<Scalar = D::Scalar>>(
        &self,
        device: &K,
        changes: impl Iterator<Item = Passive<D::Scalar>>,
        load: &mut LoadChange<D::Scalar>,
    ) {
        let states = self.joints.states.states().skip(self.first_joint);
        let own = device.passive();
        let passive = own.values().zip(changes).zip(states);
        for (to, ((own, change), state)) in load.joints.iter_mut().zip(passive) {
            *to = *to - own.torque_by(state, &change);
        }
    }

    fn set_motion<K: Kind<Scalar = D::Scalar>>(&mut self, device: &K) {
        let Joints { states, accelerations, bodies } = *self.joints;
        let wrenches = bodies.into_iter().flat_map(Each::values).skip(self.first_joint);
        let none = core::iter::repeat(Wrench::none());
        let moving = states.states().zip(accelerations.values()).skip(self.first_joint);
        let parameters = device.bodies();
        let joints = K::JOINTS.iter().zip(parameters.values()).zip(moving);
        let joints = joints.zip(wrenches.chain(none)).map(
            |(((info, body), (state, acceleration)), applied)| GivenJoint {
                info,
                body,
                state,
                acceleration,
                applied,
            },
        );
        self.motion.0.set(self.hub, &columns(device.mount()), joints);
        self.motion.1 = Some(self.device);
    }
}

/// Adds what bodies, and the origins of their joints, change by.
fn add_by_bodies<T: Scalar>(
    motion: &DeviceMotion<T>,
    changes: impl Iterator<Item = BodyParameters<T>>,
    load: &mut LoadChange<T>,
) {
    for (joint, body) in changes.enumerate() {
        let rigid = RigidBody::of(&body);
        if !rigid.vanishes() {
            motion.add_by_body(joint, &rigid, load);
        }
        if body.origin.iter().any(|number| !number.vanishes()) {
            motion.add_by_origin(joint, body.origin, load);
        }
    }
}
