//! What each variable changes of a tree of carriers at given accelerations: how bases move, and loads.

use crate::derivatives::tree::base_motion::{BaseMotion, Moments};
use crate::derivatives::tree::by_tree::ByTree;
use crate::derivatives::tree::changes::Changes;
use crate::derivatives::tree::members::{Base, Members, Owner};
use crate::derivatives::variable::{Axis, Variable};
use crate::isolation::motion::{Spatial, product};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, cross, rotate, scale, sub, zeros};

impl<T: Scalar> ByTree<T> {
    /// What a variable changes of motions and loads; returns what the field at B changes by.
    pub(crate) fn change(&self, by: Variable, changes: &mut Changes<T>) -> Vec3<T> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let mut field = zeros();
        match by {
            Variable::Attitude(axis) => match &self.field {
                Some(of) => field = self.moved(changes, cross(of.rho, unit(axis))),
                // [BN] g changes by its product with the small rotation.
                None => field = self.falls(changes, cross(self.at_b, unit(axis))),
            },
            Variable::Position(axis) => {
                if let Some(of) = &self.field {
                    field = self.moved(changes, rotate(&of.bn, unit(axis)));
                }
            }
            Variable::Omega(axis) => {
                changes.moves(0, &BaseMotion { omega: unit(axis), ..BaseMotion::none() });
            }
            Variable::Coordinate(joint) => self.by_coordinate(joint, changes),
            Variable::Rate(joint) => self.by_rate(joint, changes),
            Variable::Acceleration(joint) => self.by_acceleration(joint, changes),
            Variable::Motor(joint) => {
                if let Some(to) = changes.joints.get_mut(joint) {
                    *to = -one::<T>();
                }
            }
            Variable::Force(axis) => changes.load(0, [sub(zeros(), unit(axis)), zeros()]),
            Variable::TorqueB(axis) => changes.load(0, [zeros(), sub(zeros(), unit(axis))]),
            Variable::HubAcceleration(axis) => changes.accelerates([unit(axis), zeros()]),
            Variable::HubAngularAcceleration(axis) => changes.accelerates([zeros(), unit(axis)]),
            Variable::BodyForce(joint, axis) => self.by_wrench(joint, axis as usize, changes),
            Variable::BodyMoment(joint, axis) => {
                self.by_wrench(joint, (axis as usize).saturating_add(3), changes);
            }
            Variable::ModalCoordinate(mode) => self.by_modal_coordinate(mode, changes),
            Variable::ModalRate(mode) => self.by_modal_rate(mode, changes),
            Variable::ModalForce(mode) => changes.mode(mode, -one::<T>()),
            Variable::MountForce(mount, axis) => {
                self.by_mount(mount, [unit(axis), zeros()], changes);
            }
            Variable::MountMoment(mount, axis) => {
                self.by_mount(mount, [zeros(), unit(axis)], changes);
            }
            _ => {}
        }
        field
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
