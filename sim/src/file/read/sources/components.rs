//! Components of a source's force and moment: one by one (`force_x` to `moment_z`), or across the spin axis
//! and along it (`radial_force`, `axial_force`, `radial_moment`, `axial_moment`).

use std::f64::consts::FRAC_PI_2;

use crate::disturbance::{COMPONENTS, Six, by_spin_axis};
use crate::file::keys::Keys;
use crate::units::Measure;

/// The keys across the spin axis and along it; in each, of force and of moment.
const BY_AXIS: [[&str; 2]; 2] =
    [["radial_force", "axial_force"], ["radial_moment", "axial_moment"]];

/// What one key gives.
pub(super) struct ComponentEntry {
    pub(super) key: &'static str,
    /// The components that it is of, and by how much the phase of each differs, rad. Radial ones: the
    /// second is a quarter of a cycle after the first, so that the vector turns with the wheel.
    pub(super) components: Vec<(usize, f64)>,
    pub(super) values: Vec<f64>,
}

/// All keys with their components.
fn all(spin_axis: usize) -> Vec<(&'static str, Vec<(usize, f64)>)> {
    let own = COMPONENTS.iter().enumerate().map(|(index, key)| (*key, vec![(index, 0.0)]));
    let mut all: Vec<_> = own.collect();
    for ([radial, axial], from) in BY_AXIS.into_iter().zip([0, 3]) {
        let [first, second, along] = by_spin_axis(spin_axis, from);
        all.push((radial, vec![(first, 0.0), (second, -FRAC_PI_2)]));
        all.push((axial, vec![(along, 0.0)]));
    }
    all
}

/// The keys of all components.
pub(super) fn names(spin_axis: usize) -> impl Iterator<Item = &'static str> {
    all(spin_axis).into_iter().map(|(key, _)| key)
}

/// The keys of components in a table, by the measures of forces and of moments; none where one is
/// wrong or gives a component again.
pub(super) fn given(
    keys: &Keys<'_>,
    spin_axis: usize,
    measures: [Measure; 2],
) -> Option<Vec<ComponentEntry>> {
    let mut taken: Six<Option<&str>> = [None; 6];
    let mut found = Some(Vec::new());
    for (key, components) in all(spin_axis) {
        let Some(node) = keys.node(key) else { continue };
        let measure = if key.contains("force") { measures[0] } else { measures[1] };
        let values = keys.values_of(node, key, measure);
        let again = components.iter().find_map(|(component, _)| taken.get(*component).copied()?);
        if let Some(other) = again {
            let message = format!("`{key}` gives a component that `{other}` has given");
            keys.error(key, message, "remove one of them");
        }
        for (component, _) in &components {
            if let Some(taken) = taken.get_mut(*component) {
                *taken = Some(key);
            }
        }
        match (values.filter(|_| again.is_none()), &mut found) {
            (Some(values), Some(found)) => found.push(ComponentEntry { key, components, values }),
            _ => found = None,
        }
    }
    found
}

/// The number of each key in a table that only has keys of others, such as phases; reports one
/// whose other is not there. Where the others could not be read, none is.
pub(super) fn beside(
    keys: &Keys<'_>,
    spin_axis: usize,
    others: Option<&[ComponentEntry]>,
    measure: Measure,
) -> Vec<(&'static str, f64)> {
    let mut found = Vec::new();
    for (key, _) in all(spin_axis) {
        if !keys.has(key) {
            continue;
        }
        if others.is_none_or(|others| others.iter().any(|other| other.key == key)) {
            found.extend(keys.quantity(key, measure).map(|value| (key, value)));
        } else {
            let message = format!("`{}.{key}` is of no amplitude", keys.path());
            keys.error(key, message, &format!("give `{key}`, or remove this"));
        }
    }
    found
}
