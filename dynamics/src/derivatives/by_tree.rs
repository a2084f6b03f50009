//! [`ByTree`]: how accelerations change with state and inputs of a tree of carriers under whatever acts, by
//! the emitted derivatives of the loads: where platforms or panels carry devices, in a central field, with wrenches on bodies
//! and with lumped imbalance.
//!
//! A change of how a carrier moves changes the loads of all that it carries; they add up on the carrier, along whose
//! joints they are what its motors exert, and on its base, (I6). So a column is a pass outwards of changed motions, one
//! inwards of changed loads, and `-M⁻¹` of these.

use alloc::vec::Vec;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::base_motion::{BaseMotion, Moments};
use crate::derivatives::field_columns::FieldColumns;
use crate::derivatives::load_columns::{Load, Moving};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::tree_mass::{HUB, mass_matrix};
use crate::derivatives::tree_members::{Base, Members, Owner};
use crate::derivatives::tree_system::TreeSystem;
use crate::derivatives::variable::{Axis, Variable};
use crate::isolation::motion::{Spatial, product};
use crate::model::joint_array::MAX_JOINTS;
use crate::model::mode::HubMode;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, columns, components, cross, rotate, scale, sub, zeros};
use crate::sets::devices::Devices;
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// The derivatives of the loads at a state, and the mass matrix.
#[derive(Debug)]
pub(super) struct ByTree<T> {
    members: Members<T>,
    system: TreeSystem<T>,
    field: Option<FieldColumns<T>>,
    /// What the hub's force and moment change by with the position of B, B axes, less those of what it carries.
    hub_by_position: [Spatial<T>; 3],
    /// The field at B, B axes.
    at_b: Vec3<T>,
    hub_is_free: bool,
}

/// What accelerations change by: of B along its axes, of the angular velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct HubChange<T> {
    pub(super) r_b_n_ddot: Vec3<T>,
    pub(super) omega_dot: Vec3<T>,
}

/// What a column changes: how bases move, loads on bases, loads along joints.
#[derive(Debug)]
struct Changes<T> {
    motions: Vec<Option<BaseMotion<T>>>,
    loads: Vec<Spatial<T>>,
    joints: Vec<T>,
    /// The acceleration of a hub that is not free.
    given: Spatial<T>,
}

impl<T: Scalar> ByTree<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a flexible structure, a platform
    /// that is no carrier.
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
        let field =
            FieldColumns::new(&inputs.gravity, columns(&state.attitude.dcm()), &state.r_b_n);
        let motion = BaseMotion {
            omega: start.environment.omega,
            acceleration: sub(components(&accelerations.r_b_n_ddot), start.at_b),
            omega_dot: components(&accelerations.omega_dot),
            rho: field.as_ref().map_or_else(zeros, |field| field.rho),
        };
        let mut members = Members::on(Base {
            link: None,
            first: 0,
            own: [[Load::none(); MAX_JOINTS]; 2],
            body: craft.hub,
            field: start.environment.central,
            motion,
            load: [zeros(); 2],
            moments: Moments::of_body(&craft.hub),
        });
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut members).ok()?;
        members.add_up();
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let system = mass_matrix(&members, hub_is_free);
        let second = members.bases.first().map(|hub| hub.moments.second);
        let hub_by_position = field.as_ref().zip(second).map(|(field, second)| {
            field.on_hub(&craft.hub, &second).map(|[a, b, c, d, e, f]| [[a, b, c], [d, e, f]])
        });
        let hub_by_position = hub_by_position.unwrap_or([[zeros(); 2]; 3]);
        Some(Self { members, system, field, hub_by_position, at_b: start.at_b, hub_is_free })
    }

    /// The accelerations' derivatives by one variable, those of the joints into `joints`.
    pub(super) fn column(&self, by: Variable, joints: &mut [T]) -> HubChange<T> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let mut changes = Changes::none(&self.members);
        let mut field = zeros();
        match by {
            Variable::Attitude(axis) => match &self.field {
                Some(of) => field = self.moved(&mut changes, cross(of.rho, unit(axis))),
                // [BN] g changes by its product with the small rotation.
                None => field = self.falls(&mut changes, cross(self.at_b, unit(axis))),
            },
            Variable::Position(axis) => {
                if let Some(of) = &self.field {
                    field = self.moved(&mut changes, rotate(&of.bn, unit(axis)));
                }
            }
            Variable::Omega(axis) => {
                changes.moves(0, &BaseMotion { omega: unit(axis), ..BaseMotion::none() });
            }
            Variable::Coordinate(joint) => self.by_coordinate(joint, &mut changes),
            Variable::Rate(joint) => self.by_rate(joint, &mut changes),
            Variable::Acceleration(joint) => self.by_acceleration(joint, &mut changes),
            Variable::Motor(joint) => {
                changes.joints.get_mut(joint).into_iter().for_each(|to| *to = -one::<T>());
            }
            Variable::Force(axis) => changes.load(0, [sub(zeros(), unit(axis)), zeros()]),
            Variable::TorqueB(axis) => changes.load(0, [zeros(), sub(zeros(), unit(axis))]),
            Variable::HubAcceleration(axis) => changes.accelerates([unit(axis), zeros()]),
            Variable::HubAngularAcceleration(axis) => changes.accelerates([zeros(), unit(axis)]),
            Variable::BodyForce(joint, axis) => self.by_wrench(joint, axis as usize, &mut changes),
            Variable::BodyMoment(joint, axis) => {
                self.by_wrench(joint, (axis as usize).saturating_add(3), &mut changes);
            }
            _ => {}
        }
        let HubChange { r_b_n_ddot, omega_dot } = self.solved(changes, joints);
        if let Variable::Acceleration(joint) = by {
            joints.get_mut(joint).into_iter().for_each(|own| *own = one());
        }
        HubChange { r_b_n_ddot: add(r_b_n_ddot, field), omega_dot }
    }

    /// The accelerations where motions and loads change.
    fn solved(&self, mut changes: Changes<T>, joints: &mut [T]) -> HubChange<T> {
        let Members { bases, devices, .. } = &self.members;
        for (number, base) in bases.iter().enumerate() {
            if let Some(link) = &base.link
                && let Some(Some(of_base)) = changes.motions.get(link.base)
            {
                let field = bases.get(link.base).and_then(|base| base.field.as_ref());
                let carried = link.carried(of_base, field);
                changes.moves(number, &carried);
            }
            if let Some(Some(change)) = changes.motions.get(number) {
                // Of the hub with the third-order force: `hub_by_position`.
                let field = base.field.as_ref().filter(|_| number > 0);
                let load = base.motion.load_by(&base.body, field, change);
                changes.load(number, load);
            }
        }
        for device in devices {
            if let Some(Some(change)) = changes.motions.get(device.base) {
                let load = device.by_motion(change);
                changes.add(device.base, device.first, &load);
            }
        }
        for base in bases.iter().skip(1).rev() {
            let (Some(link), Some(load)) = (&base.link, changes.loads.pop()) else { continue };
            let to = changes.joints.iter_mut().skip(base.first);
            for (to, of) in to.zip(&link.coordinates) {
                *to = *to + product(&of.direction, &load);
            }
            changes.load(link.base, link.inward(load));
        }
        let mut rows = Vec::with_capacity(self.system.len());
        rows.extend(changes.loads.first().into_iter().flatten().flatten().copied());
        rows.extend(changes.joints);
        self.system.solve(&mut rows);
        let (hub, found) = rows.split_at(rows.len().min(HUB));
        joints.iter_mut().zip(found).for_each(|(to, from)| *to = -*from);
        match (hub, self.hub_is_free) {
            ([a, b, c, d, e, f], true) => {
                HubChange { r_b_n_ddot: [-*a, -*b, -*c], omega_dot: [-*d, -*e, -*f] }
            }
            _ => HubChange { r_b_n_ddot: changes.given[0], omega_dot: changes.given[1] },
        }
    }

    /// The field at B changes by this, which is returned: what is given of a hub changes as seen from what falls.
    fn falls(&self, changes: &mut Changes<T>, field: Vec3<T>) -> Vec3<T> {
        if !self.hub_is_free {
            changes.accelerates([sub(zeros(), field), zeros()]);
        }
        field
    }

    /// The position of B from the centre of the field changes by this, B axes. Returns what the field at B changes by.
    fn moved(&self, changes: &mut Changes<T>, rho: Vec3<T>) -> Vec3<T> {
        changes.moves(0, &BaseMotion { rho, ..BaseMotion::none() });
        for (component, [force, moment]) in rho.into_iter().zip(self.hub_by_position) {
            changes.load(0, [scale(-component, force), scale(-component, moment)]);
        }
        let central = self.members.bases.first().and_then(|hub| hub.field.as_ref());
        let field = central.map_or_else(zeros, |central| central.gradient.times(rho));
        self.falls(changes, field)
    }

    fn by_coordinate(&self, joint: usize, changes: &mut Changes<T>) {
        let Members { bases, devices, joints, .. } = &self.members;
        let Some((owner, _)) = joints.get(joint) else { return };
        let (mut base, mut moments) = match *owner {
            Owner::Device(device) => {
                let Some(device) = devices.get(device) else { return };
                let own = joint.saturating_sub(device.first);
                let Some(load) = device.columns.coordinates.get(own) else { return };
                changes.add(device.base, device.first, load);
                let moments = device.moments_by.get(own).copied();
                (device.base, moments.unwrap_or_else(Moments::none))
            }
            Owner::Carrier(number) => {
                let Some(base) = bases.get(number) else { return };
                let Some(link) = &base.link else { return };
                let own = joint.saturating_sub(base.first);
                let Some(of) = link.coordinates.get(own) else { return };
                let [by_coordinate, _] = &of.by;
                changes.moves(number, by_coordinate);
                let to = changes.joints.iter_mut().skip(base.first);
                for (to, direction) in to.zip(&of.directions_by) {
                    *to = *to + product(direction, &base.load);
                }
                changes.load(link.base, link.inward_by(base.load, of.direction));
                let [own_loads, _] = &base.own;
                own_loads.get(own).into_iter().for_each(|load| {
                    changes.add(link.base, base.first, load);
                });
                (link.base, link.moments_by(&base.moments, &Moments::none(), of.direction))
            }
        };
        // The third-order force on the whole.
        let central = bases.first().and_then(|hub| hub.field.as_ref());
        let Some(central) = central else { return };
        while let Some(Base { link: Some(link), moments: of_base, .. }) = bases.get(base) {
            let still = [zeros(); 2];
            moments = link.moments_by(of_base, &moments, still);
            base = link.base;
        }
        changes.load(0, [sub(zeros(), central.third_order(&moments.second)), zeros()]);
    }

    fn by_rate(&self, joint: usize, changes: &mut Changes<T>) {
        let Members { bases, devices, joints, .. } = &self.members;
        match joints.get(joint) {
            Some((Owner::Device(device), _)) => {
                let Some(device) = devices.get(*device) else { return };
                let load = device.columns.rates.get(joint.saturating_sub(device.first));
                load.into_iter().for_each(|load| changes.add(device.base, device.first, load));
            }
            Some((Owner::Carrier(number), _)) => {
                let Some(base @ Base { link: Some(link), .. }) = bases.get(*number) else { return };
                let own = joint.saturating_sub(base.first);
                let of = link.coordinates.get(own);
                of.into_iter().for_each(|of| changes.moves(*number, &of.by[1]));
                let [_, own_loads] = &base.own;
                own_loads.get(own).into_iter().for_each(|load| {
                    changes.add(link.base, base.first, load);
                });
            }
            None => {}
        }
    }

    fn by_acceleration(&self, joint: usize, changes: &mut Changes<T>) {
        let Members { bases, devices, joints, .. } = &self.members;
        match joints.get(joint) {
            Some((Owner::Device(device), _)) => {
                let Some(device) = devices.get(*device) else { return };
                let load = device.columns.accelerations.get(joint.saturating_sub(device.first));
                load.into_iter().for_each(|load| changes.add(device.base, device.first, load));
            }
            Some((Owner::Carrier(number), _)) => {
                let Some(base @ Base { link: Some(link), .. }) = bases.get(*number) else { return };
                let of = link.coordinates.get(joint.saturating_sub(base.first));
                let of = of.map(|of| BaseMotion::accelerating(of.direction));
                of.into_iter().for_each(|of| changes.moves(*number, &of));
            }
            None => {}
        }
    }

    /// By a component of the wrench on the child body of a joint.
    fn by_wrench(&self, joint: usize, component: usize, changes: &mut Changes<T>) {
        let Members { bases, devices, joints, by_wrenches, .. } = &self.members;
        let place = match joints.get(joint) {
            Some((Owner::Device(device), _)) => devices.get(*device).map(|of| (of.base, of.first)),
            Some((Owner::Carrier(number), _)) => {
                bases.get(*number).and_then(|base| Some((base.link.as_ref()?.base, base.first)))
            }
            None => None,
        };
        let load = by_wrenches.get(joint).and_then(|of| of.get(component));
        if let Some(((base, first), load)) = place.zip(load) {
            changes.add(base, first, load);
        }
    }
}

impl<T: Scalar> Changes<T> {
    fn none(members: &Members<T>) -> Self {
        Self {
            motions: alloc::vec![None; members.bases.len()],
            loads: alloc::vec![[zeros(); 2]; members.bases.len()],
            joints: alloc::vec![zero(); members.joints.len()],
            given: [zeros(); 2],
        }
    }

    /// The motion of a base changes by this, too.
    fn moves(&mut self, base: usize, by: &BaseMotion<T>) {
        if let Some(to) = self.motions.get_mut(base) {
            *to = Some(to.map_or(*by, |to| to.plus(by)));
        }
    }

    /// The acceleration of a hub that is not free.
    fn accelerates(&mut self, by: Spatial<T>) {
        self.given = by;
        self.moves(0, &BaseMotion::accelerating(by));
    }

    /// A load on a base.
    fn load(&mut self, base: usize, [force, moment]: Spatial<T>) {
        if let Some([f, m]) = self.loads.get_mut(base) {
            (*f, *m) = (add(*f, force), add(*m, moment));
        }
    }

    /// The loads of a device on its base, and along its joints from that of the number `first` on.
    fn add(&mut self, base: usize, first: usize, load: &Load<T>) {
        let [a, b, c, d, e, f] = load.hub;
        self.load(base, [[a, b, c], [d, e, f]]);
        let joints = self.joints.iter_mut().skip(first).zip(load.joints);
        joints.for_each(|(to, from)| *to = *to + from);
    }
}
