//! The mass matrix of a tree of carriers: each joint moves all outboard of it as one body, the other joints locked.

use alloc::vec::Vec;

use crate::derivatives::tree::base_motion::{BaseMotion, spatial};
use crate::derivatives::tree::members::{Base, Members, Owner};
use crate::derivatives::tree::modal_columns::ModalColumns;
use crate::derivatives::tree::system::TreeSystem;
use crate::equations::hub::HubConstants;
use crate::isolation::motion::{Spatial, product};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{add, scale, zeros};

/// Rows of the hub, before those of the joints.
pub(crate) const HUB: usize = 6;

/// The mass matrix, by what the hub and each carrier are with what they carry, all joints locked.
pub(crate) fn mass_matrix<T: Scalar>(
    members: &Members<T>,
    modal: &ModalColumns<T>,
    hub_is_free: bool,
) -> TreeSystem<T> {
    let mut system = rows(members, modal, hub_is_free);
    let offset = HUB.saturating_add(modal.count());
    let mut composites = Vec::with_capacity(members.bases.len());
    composites.extend(members.bases.iter().map(|base| of_body(&base.body)));
    add_devices(members, offset, &mut composites, &mut system);
    add_bases((&members.bases, offset), composites, &mut system);
    system.factorise();
    system
}

/// By each unit acceleration of a base, the load that it needs with all that it carries.
type Composite<T> = [Spatial<T>; 6];

/// The unit accelerations.
fn units<T: Scalar>() -> Composite<T> {
    [0, 1, 2, 3, 4, 5].map(|own: usize| {
        let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k| if k == own { one() } else { zero() });
        [[a, b, c], [d, e, f]]
    })
}

fn of_body<T: Scalar>(body: &HubConstants<T>) -> Composite<T> {
    units().map(|[v, w]| spatial(&body.needs(zeros(), v, w)))
}

/// The rows of hub, modes and joints, with what modes have by themselves.
fn rows<T: Scalar>(
    Members { bases, devices, joints, .. }: &Members<T>,
    modal: &ModalColumns<T>,
    hub_is_free: bool,
) -> TreeSystem<T> {
    let mut system = TreeSystem::new();
    for row in 0..HUB {
        system.push(row.checked_sub(1), hub_is_free);
    }
    let offset = HUB.saturating_add(modal.count());
    for row in HUB..offset {
        system.push(row.checked_sub(1), true);
        let mode = row.saturating_sub(HUB);
        system.add(row, row, modal.mass(mode));
        let momenta = modal.momenta.get(mode).into_iter().flatten().flatten().enumerate();
        momenta.for_each(|(column, value)| system.add(row, column, *value));
    }
    let first_row = |base: &Base<T>| base.first.saturating_add(offset);
    // The row inboard of what stands on a base.
    let inboard_of = |base: usize| match bases.get(base) {
        Some(base @ Base { link: Some(link), shapes: None, .. }) => {
            first_row(base).saturating_add(link.coordinates.len()).saturating_sub(1)
        }
        _ => offset.saturating_sub(1),
    };
    for (joint, (owner, free)) in joints.iter().enumerate() {
        let place = match owner {
            Owner::Device(device) => devices.get(*device).map(|of| (of.base, of.first)),
            Owner::Carrier(number) => {
                bases.get(*number).and_then(|of| Some((of.link.as_ref()?.base, of.first)))
            }
        };
        let parent = match place {
            Some((base, first)) if first == joint => inboard_of(base),
            _ => joint.saturating_add(offset).saturating_sub(1),
        };
        system.push(Some(parent), *free);
    }
    system
}

/// Adds the rows of the joints of devices, and the devices to what their bases carry.
fn add_devices<T: Scalar>(
    Members { bases, devices, .. }: &Members<T>,
    offset: usize,
    composites: &mut [Composite<T>],
    system: &mut TreeSystem<T>,
) {
    for device in devices {
        let Some(composite) = composites.get_mut(device.base) else { continue };
        for (to, unit) in composite.iter_mut().zip(units()) {
            let [a, b, c, d, e, f] = device.by_motion(&BaseMotion::accelerating(unit)).hub;
            *to = [add(to[0], [a, b, c]), add(to[1], [d, e, f])];
        }
        let first = device.first.saturating_add(offset);
        let own = device.columns.accelerations.iter().take(device.columns.count).enumerate();
        for (joint, load) in own {
            let row = joint.saturating_add(first);
            let inboard = load.joints.iter().take(joint.saturating_add(1)).enumerate();
            inboard.for_each(|(other, value)| system.add(row, other.saturating_add(first), *value));
            let [a, b, c, d, e, f] = load.hub;
            let load = [[a, b, c], [d, e, f]];
            inward((bases, offset), device.base, load, |column, value| {
                system.add(row, column, value);
            });
        }
    }
}

/// Adds the rows of the coordinates of carriers and mounts, and of the hub.
fn add_bases<T: Scalar>(
    (bases, offset): (&[Base<T>], usize),
    mut composites: Vec<Composite<T>>,
    system: &mut TreeSystem<T>,
) {
    for (number, base) in bases.iter().enumerate().rev() {
        let Some(composite) = composites.pop() else { continue };
        let times = |by: Spatial<T>| {
            let numbers = by.into_iter().flatten();
            composite.iter().zip(numbers).fold([zeros(); 2], |sum, (column, by)| {
                [add(sum[0], scale(by, column[0])), add(sum[1], scale(by, column[1]))]
            })
        };
        let Some(link) = &base.link else {
            for (row, column) in composite.iter().enumerate() {
                let entries = column.iter().flatten().enumerate().take(row.saturating_add(1));
                entries.for_each(|(column, value)| system.add(row, column, *value));
            }
            continue;
        };
        let mut add_row = |row: usize, direction: Spatial<T>| {
            inward((bases, offset), number, times(direction), |column, value| {
                system.add(row, column, value);
            });
        };
        if let Some(shapes) = &base.shapes {
            for (mode, shape) in shapes.iter().enumerate() {
                add_row(mode.saturating_add(HUB), link.direction(shape));
            }
        } else {
            for (joint, of) in link.coordinates.iter().enumerate() {
                add_row(joint.saturating_add(base.first).saturating_add(offset), of.direction);
            }
        }
        if let Some(inboard) = composites.get_mut(link.base) {
            for (to, unit) in inboard.iter_mut().zip(units()) {
                let [force, moment] = link.inward(times(link.outward(unit)));
                *to = [add(to[0], force), add(to[1], moment)];
            }
        }
    }
}

/// Shows a function the rows of the joints and of the hub inboard of a load on a base, and what it is along each.
fn inward<T: Scalar>(
    (bases, offset): (&[Base<T>], usize),
    mut base: usize,
    mut load: Spatial<T>,
    mut show: impl FnMut(usize, T),
) {
    while let Some(Base { link: Some(link), first, shapes, .. }) = bases.get(base) {
        if let Some(shapes) = shapes {
            for (mode, shape) in shapes.iter().enumerate() {
                show(mode.saturating_add(HUB), product(&link.direction(shape), &load));
            }
            (base, load) = (link.base, link.inward(load));
            continue;
        }
        for (joint, of) in link.coordinates.iter().enumerate() {
            let row = joint.saturating_add(*first).saturating_add(offset);
            show(row, product(&of.direction, &load));
        }
        (base, load) = (link.base, link.inward(load));
    }
    load.iter().flatten().enumerate().for_each(|(row, value)| show(row, *value));
}
