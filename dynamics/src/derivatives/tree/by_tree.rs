//! [`ByTree`]: how accelerations change with state and inputs by the emitted derivatives of the loads, whatever acts: where
//! platforms, panels and the mounts of a flexible structure carry devices, in a central field, with wrenches on bodies and
//! with lumped imbalance.
//!
//! A change of how a carrier moves changes the loads of all that it carries; they add up on the carrier, along whose
//! joints they are what its motors exert, and on its base, (I6). So a column is a pass outwards of changed motions, one
//! inwards of changed loads, and `-M⁻¹` of these.

use alloc::vec::Vec;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::loads::side_by_side::Load;
use crate::derivatives::loads::side_by_side::Six;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::tree::base_motion::{BaseMotion, Moments};
use crate::derivatives::tree::changes::Changes;
use crate::derivatives::tree::field_columns::FieldColumns;
use crate::derivatives::tree::mass_matrix::{HUB, mass_matrix};
use crate::derivatives::tree::members::{Base, Members, Owner};
use crate::derivatives::tree::modal_columns::ModalColumns;
use crate::derivatives::tree::system::TreeSystem;
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
pub(crate) struct ByTree<T> {
    members: Members<T>,
    modal: ModalColumns<T>,
    system: TreeSystem<T>,
    field: Option<FieldColumns<T>>,
    /// What the hub's force and moment change by with the position of B, B axes, less those of what it carries.
    hub_by_position: [Spatial<T>; 3],
    /// The field at B, B axes.
    at_b: Vec3<T>,
    hub_is_free: bool,
}

impl<T: Scalar> ByTree<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a platform that is no
    /// carrier.
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<Self> {
        let start = evaluation_start(state, inputs);
        let field =
            FieldColumns::new(&inputs.gravity, columns(&state.attitude.dcm()), &state.r_b_n);
        let motion = BaseMotion {
            omega: start.environment.omega,
            acceleration: sub(components(&accelerations.r_b_n_ddot), start.at_b),
            omega_dot: components(&accelerations.omega_dot),
            rho: field.as_ref().map_or_else(zeros, |field| field.rho),
        };
        let body = S::body(craft, state);
        let (mounts, modal) =
            S::bases(craft, state, inputs, accelerations, &motion, &start.environment);
        let hub = Base {
            link: None,
            first: 0,
            own: [[Load::none(); MAX_JOINTS]; 2],
            body,
            field: start.environment.central,
            motion,
            load: [zeros(); 2],
            moments: Moments::of_body(&body),
            shapes: None,
        };
        let mut members = Members::on(hub, mounts);
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        S::visit_members(craft, data, &mut members).ok()?;
        members.add_up();
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let system = mass_matrix(&members, &modal, hub_is_free);
        let second = members.bases.first().map(|hub| hub.moments.second);
        let hub_by_position = field.as_ref().zip(second).map(|(field, second)| {
            field.on_hub(&body, &second).map(|[a, b, c, d, e, f]| [[a, b, c], [d, e, f]])
        });
        let hub_by_position = hub_by_position.unwrap_or([[zeros(); 2]; 3]);
        let at_b = start.at_b;
        Some(Self { members, modal, system, field, hub_by_position, at_b, hub_is_free })
    }

    /// The accelerations' derivatives by one variable, those of the joints and then of the modes into `joints`.
    pub(crate) fn column(&self, by: Variable, joints: &mut [T]) -> Six<T> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let mut changes = Changes::none(&self.members, self.modal.count());
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
                if let Some(to) = changes.joints.get_mut(joint) {
                    *to = -one::<T>();
                }
            }
            Variable::Force(axis) => changes.load(0, [sub(zeros(), unit(axis)), zeros()]),
            Variable::TorqueB(axis) => changes.load(0, [zeros(), sub(zeros(), unit(axis))]),
            Variable::HubAcceleration(axis) => changes.accelerates([unit(axis), zeros()]),
            Variable::HubAngularAcceleration(axis) => changes.accelerates([zeros(), unit(axis)]),
            Variable::BodyForce(joint, axis) => self.by_wrench(joint, axis as usize, &mut changes),
            Variable::BodyMoment(joint, axis) => {
                self.by_wrench(joint, (axis as usize).saturating_add(3), &mut changes);
            }
            Variable::ModalCoordinate(mode) => self.by_modal_coordinate(mode, &mut changes),
            Variable::ModalRate(mode) => self.by_modal_rate(mode, &mut changes),
            Variable::ModalForce(mode) => changes.mode(mode, -one::<T>()),
            Variable::MountForce(mount, axis) => {
                self.by_mount(mount, [unit(axis), zeros()], &mut changes);
            }
            Variable::MountMoment(mount, axis) => {
                self.by_mount(mount, [zeros(), unit(axis)], &mut changes);
            }
            _ => {}
        }
        let [a, b, c, d, e, f] = self.solved(changes, joints);
        if let Variable::Acceleration(joint) = by
            && let Some(own) = joints.get_mut(joint)
        {
            *own = one();
        }
        let [a, b, c] = add([a, b, c], field);
        [a, b, c, d, e, f]
    }

    /// The accelerations where motions and loads change.
    fn solved(&self, mut changes: Changes<T>, joints: &mut [T]) -> Six<T> {
        let Members { bases, devices, .. } = &self.members;
        for (number, base) in bases.iter().enumerate() {
            if let Some(link) = &base.link
                && let Some(Some(of_base)) = changes.motions.get(link.base)
            {
                let field = bases.get(link.base).and_then(|base| base.field.as_ref());
                let carried = link.carried(of_base, field);
                changes.moves(number, &carried);
            }
            let Some(Some(change)) = changes.motions.get(number).copied() else { continue };
            // Of the hub with the third-order force: `hub_by_position`.
            let field = base.field.as_ref().filter(|_| number > 0);
            changes.load(number, base.motion.load_by(&base.body, field, &change));
            if number == 0 {
                let mut modes = changes.modes.iter_mut();
                let load = self.modal.by_motion(&change, |value| {
                    if let Some(to) = modes.next() {
                        *to = *to + value;
                    }
                });
                changes.load(0, load);
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
            changes.along(base, link.coordinates.iter().map(|of| product(&of.direction, &load)));
            changes.load(link.base, link.inward(load));
        }
        let mut rows = Vec::with_capacity(self.system.len());
        rows.extend(changes.loads.first().into_iter().flatten().flatten().copied());
        rows.extend(changes.modes);
        rows.extend(changes.joints);
        self.system.solve(&mut rows);
        let (hub, found) = rows.split_at(rows.len().min(HUB));
        let (modes, found) = found.split_at(self.modal.count().min(found.len()));
        let found = found.iter().chain(modes);
        joints.iter_mut().zip(found).for_each(|(to, from)| *to = -*from);
        if let ([a, b, c, d, e, f], true) = (hub, self.hub_is_free) {
            return [-*a, -*b, -*c, -*d, -*e, -*f];
        }
        let [[a, b, c], [d, e, f]] = changes.given;
        [a, b, c, d, e, f]
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
                let along = of.directions_by.iter();
                changes.along(base, along.map(|direction| product(direction, &base.load)));
                changes.load(link.base, link.inward_by(base.load, of.direction));
                let [own_loads, _] = &base.own;
                if let Some(load) = own_loads.get(own) {
                    changes.add(link.base, base.first, load);
                }
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

    fn by_modal_coordinate(&self, mode: usize, changes: &mut Changes<T>) {
        let bases = &self.members.bases;
        let Some(hub) = bases.first() else { return };
        let (load, own) = self.modal.by_coordinate(mode, &hub.motion, hub.field.as_ref());
        changes.load(0, load);
        changes.mode(mode, own);
        for (number, base) in bases.iter().enumerate() {
            let Base { link: Some(link), shapes: Some(shapes), load, moments, .. } = base else {
                continue;
            };
            let Some(shape) = shapes.get(mode) else { continue };
            let (direction, mut along) = (link.direction(shape), [zero::<T>(); 6]);
            for (by, of) in shape.iter().zip(&link.coordinates) {
                let [by_coordinate, _] = &of.by;
                changes.moves(number, &by_coordinate.scaled(*by));
                for (to, direction) in along.iter_mut().zip(&of.directions_by) {
                    *to = *to + *by * product(direction, load);
                }
            }
            changes.along(base, along.into_iter());
            changes.load(0, link.inward_by(*load, direction));
            if let Some(central) = &hub.field {
                let change = link.moments_by(moments, &Moments::none(), direction);
                changes.load(0, [sub(zeros(), central.third_order(&change.second)), zeros()]);
            }
        }
    }

    fn by_modal_rate(&self, mode: usize, changes: &mut Changes<T>) {
        let bases = &self.members.bases;
        let Some(hub) = bases.first() else { return };
        let (load, own) = self.modal.by_rate(mode, &hub.motion);
        changes.load(0, load);
        changes.mode(mode, own);
        for (number, base) in bases.iter().enumerate() {
            let Base { link: Some(link), shapes: Some(shapes), .. } = base else { continue };
            let Some(shape) = shapes.get(mode) else { continue };
            for (by, of) in shape.iter().zip(&link.coordinates) {
                let [_, by_rate] = &of.by;
                changes.moves(number, &by_rate.scaled(*by));
            }
        }
    }

    /// By a component of the wrench on the structure at a mount.
    fn by_mount(&self, mount: usize, component: Spatial<T>, changes: &mut Changes<T>) {
        let [force, moment] = self.modal.at_origin(mount, component);
        changes.load(mount.saturating_add(1), [sub(zeros(), force), sub(zeros(), moment)]);
    }

    fn by_rate(&self, joint: usize, changes: &mut Changes<T>) {
        let Members { bases, devices, joints, .. } = &self.members;
        match joints.get(joint) {
            Some((Owner::Device(device), _)) => {
                let Some(device) = devices.get(*device) else { return };
                if let Some(load) = device.columns.rates.get(joint.saturating_sub(device.first)) {
                    changes.add(device.base, device.first, load);
                }
            }
            Some((Owner::Carrier(number), _)) => {
                let Some(base @ Base { link: Some(link), .. }) = bases.get(*number) else { return };
                let own = joint.saturating_sub(base.first);
                if let Some(of) = link.coordinates.get(own) {
                    changes.moves(*number, &of.by[1]);
                }
                let [_, own_loads] = &base.own;
                if let Some(load) = own_loads.get(own) {
                    changes.add(link.base, base.first, load);
                }
            }
            None => {}
        }
    }

    fn by_acceleration(&self, joint: usize, changes: &mut Changes<T>) {
        let Members { bases, devices, joints, .. } = &self.members;
        match joints.get(joint) {
            Some((Owner::Device(device), _)) => {
                let Some(device) = devices.get(*device) else { return };
                let own = joint.saturating_sub(device.first);
                if let Some(load) = device.columns.accelerations.get(own) {
                    changes.add(device.base, device.first, load);
                }
            }
            Some((Owner::Carrier(number), _)) => {
                let Some(base @ Base { link: Some(link), .. }) = bases.get(*number) else { return };
                if let Some(of) = link.coordinates.get(joint.saturating_sub(base.first)) {
                    changes.moves(*number, &BaseMotion::accelerating(of.direction));
                }
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
