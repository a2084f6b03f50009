//! The mass matrix of a tree of carriers: each joint moves all outboard of it as one body, the other joints locked.

use alloc::vec::Vec;

use crate::derivatives::base_motion::{BaseMotion, spatial};
use crate::derivatives::tree_members::{Base, Members, Owner};
use crate::derivatives::tree_system::TreeSystem;
use crate::equations::hub::HubConstants;
use crate::isolation::motion::{Spatial, product};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{add, scale, zeros};

/// Rows of the hub, before those of the joints.
pub(super) const HUB: usize = 6;

/// The mass matrix, by what the hub and each carrier are with what they carry, all joints locked.
pub(super) fn mass_matrix<T: Scalar>(members: &Members<T>, hub_is_free: bool) -> TreeSystem<T> {
    let Members { bases, devices, joints, .. } = members;
    let mut system = TreeSystem::new();
    for row in 0..HUB {
        system.push(row.checked_sub(1), hub_is_free);
    }
    let last_of = |base: usize| match bases.get(base) {
        Some(Base { link: Some(link), first, .. }) => {
            first.saturating_add(link.coordinates.len()).saturating_add(HUB - 1)
        }
        _ => HUB - 1,
    };
    for (joint, (owner, free)) in joints.iter().enumerate() {
        let (base, first) = match owner {
            Owner::Device(device) => {
                devices.get(*device).map_or((0, joint), |of| (of.base, of.first))
            }
            Owner::Carrier(number) => bases
                .get(*number)
                .map_or((0, joint), |of| (of.link.as_ref().map_or(0, |link| link.base), of.first)),
        };
        let inboard = joint.saturating_add(HUB - 1);
        system.push(Some(if joint == first { last_of(base) } else { inboard }), *free);
    }
    let units = || {
        (0..6).map(|own: usize| {
            let [a, b, c, d, e, f] =
                [0, 1, 2, 3, 4, 5].map(|k| if k == own { one::<T>() } else { zero() });
            [[a, b, c], [d, e, f]]
        })
    };
    let needs = |of: &HubConstants<T>, [v, w]: Spatial<T>| {
        let needed = of.needs(zeros(), v, w);
        spatial(&needed)
    };
    // By each unit acceleration of a base, what it needs with all that it carries.
    let mut composites: Vec<[Spatial<T>; 6]> = Vec::with_capacity(bases.len());
    for base in bases {
        let mut own = [[zeros(); 2]; 6];
        own.iter_mut().zip(units()).for_each(|(to, unit)| *to = needs(&base.body, unit));
        composites.push(own);
    }
    for device in devices {
        let Some(composite) = composites.get_mut(device.base) else { continue };
        for (to, unit) in composite.iter_mut().zip(units()) {
            let [a, b, c, d, e, f] = device.by_motion(&BaseMotion::accelerating(unit)).hub;
            *to = [add(to[0], [a, b, c]), add(to[1], [d, e, f])];
        }
        let own = device.columns.accelerations.iter().take(device.columns.count).enumerate();
        for (joint, load) in own {
            let row = joint.saturating_add(device.first).saturating_add(HUB);
            let inboard = load.joints.iter().take(joint.saturating_add(1)).enumerate();
            for (other, value) in inboard {
                system.add(row, other.saturating_add(device.first).saturating_add(HUB), *value);
            }
            let [a, b, c, d, e, f] = load.hub;
            inward(bases, device.base, [[a, b, c], [d, e, f]], |column, value| {
                system.add(row, column, value);
            });
        }
    }
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
        for (joint, of) in link.coordinates.iter().enumerate() {
            let row = joint.saturating_add(base.first).saturating_add(HUB);
            inward(bases, number, times(of.direction), |column, value| {
                system.add(row, column, value);
            });
        }
        if let Some(inboard) = composites.get_mut(link.base) {
            for (to, unit) in inboard.iter_mut().zip(units()) {
                let [force, moment] = link.inward(times(link.outward(unit)));
                *to = [add(to[0], force), add(to[1], moment)];
            }
        }
    }
    system.factorise();
    system
}

/// Shows a function the rows of the joints and of the hub inboard of a load on a base, and what it is along each.
fn inward<T: Scalar>(
    bases: &[Base<T>],
    mut base: usize,
    mut load: Spatial<T>,
    mut show: impl FnMut(usize, T),
) {
    while let Some(Base { link: Some(link), first, .. }) = bases.get(base) {
        for (joint, of) in link.coordinates.iter().enumerate() {
            let row = joint.saturating_add(*first).saturating_add(HUB);
            show(row, product(&of.direction, &load));
        }
        (base, load) = (link.base, link.inward(load));
    }
    load.iter().flatten().enumerate().for_each(|(row, value)| show(row, *value));
}
