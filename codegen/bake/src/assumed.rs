//! What the numbers of a device say beforehand: zeros, equal moments of inertia, a mount of a few
//! turns.
//!
//! A number counts as zero, and two as equal, within four epsilons of the scale of what they belong
//! to. A mass or a distance that happens to equal another one is a coincidence, and stays.

use std::collections::{BTreeMap, BTreeSet};

use precess_codegen::derivation::assumed::{Assumed, Exchange, Mount, Turns};
use precess_codegen::kinds::Kind;
use precess_description::Device;

use crate::error::BakeError;
use crate::parameters::{is_rounding, parameters};

/// What is assumed of a device's parameters.
pub(crate) fn assumed(kind: &Kind, device: &Device) -> Result<Assumed, BakeError> {
    let list = parameters(kind);
    for name in &device.keep {
        if name != "mount" && !list.iter().any(|parameter| parameter.name == *name) {
            return Err(BakeError::Keep(device.name.clone(), name.clone()));
        }
    }
    let kept = |name: &str| device.keep.iter().any(|keep| keep == name);
    let mut zero = BTreeSet::new();
    let mut equal = BTreeMap::new();
    for (k, own) in list.iter().enumerate().filter(|(_, own)| !kept(&own.name)) {
        let (value, scale) = (own.place.value(device), own.place.scale(device));
        // A massless body is legal; that its moments vanish with it is what it is.
        if is_rounding(value, scale) {
            zero.insert(own.name.clone());
            continue;
        }
        let alike = |other: &&crate::parameters::Parameter| {
            let same = other.place.is_moment() && other.place.body() == own.place.body();
            let known = zero.contains(&other.name) || equal.contains_key(&other.name);
            same && !known
                && !kept(&other.name)
                && is_rounding(value - other.place.value(device), scale)
        };
        if let Some(other) = list[..k].iter().filter(|_| own.place.is_moment()).find(alike) {
            equal.insert(own.name.clone(), other.name.clone());
        }
    }
    let mount = if kept("mount") { Mount::Any } else { mount(&device.mount) };
    Ok(Assumed { zero, equal, mount })
}

/// The fewest turns that make this mount.
fn mount(mount: &[[f64; 3]; 3]) -> Mount {
    let exchanges = Exchange::every();
    for turns in [Turns::None, Turns::One, Turns::Two] {
        for &outer in &exchanges {
            for &inner in &exchanges {
                if has_form(turned(mount, outer, inner), turns) {
                    return Mount::Turned { outer, turns, inner };
                }
            }
        }
    }
    Mount::Any
}

/// R of `P R Q`.
fn turned(mount: &[[f64; 3]; 3], outer: Exchange, inner: Exchange) -> [[f64; 3]; 3] {
    let entry = |row: usize, column: usize| {
        // Each column of P and each row of Q has one entry that is not zero.
        let mut sum = 0.0;
        for (i, own) in mount.iter().enumerate() {
            for (j, value) in own.iter().enumerate() {
                sum += f64::from(outer.entry(i, row) * inner.entry(column, j)) * value;
            }
        }
        sum
    };
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| entry(row, column)))
}

/// Whether R has this form.
fn has_form(r: [[f64; 3]; 3], turns: Turns) -> bool {
    let [[xx, xy, _], [yx, yy, _], [zx, _, zz]] = r;
    let (ca, sa, cb, sb) = match turns {
        Turns::None => (1.0, 0.0, 1.0, 0.0),
        Turns::One => (xx, yx, 1.0, 0.0),
        Turns::Two => (yy, -xy, zz, -zx),
    };
    let whole = [[ca * cb, -sa, ca * sb], [sa * cb, ca, sa * sb], [-sb, 0.0, cb]];
    let pairs = r.as_flattened().iter().zip(whole.as_flattened());
    pairs.into_iter().all(|(entry, made)| is_rounding(entry - made, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
    }

    fn about_z(angle: f64) -> [[f64; 3]; 3] {
        let (s, c) = angle.sin_cos();
        [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
    }

    fn about_y(angle: f64) -> [[f64; 3]; 3] {
        let (s, c) = angle.sin_cos();
        [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]
    }

    fn turns(of: &[[f64; 3]; 3]) -> Option<Turns> {
        match mount(of) {
            Mount::Any => None,
            Mount::Turned { turns, .. } => Some(turns),
        }
    }

    #[test]
    fn a_mount_is_found_to_be_the_fewest_turns() {
        let quarter = about_z(std::f64::consts::FRAC_PI_2);
        assert_eq!(turns(&quarter), Some(Turns::None));
        assert_eq!(turns(&product(quarter, about_y(0.3))), Some(Turns::One));
        let two = product(about_z(0.7), about_y(0.3));
        assert_eq!(turns(&two), Some(Turns::Two));
        assert_eq!(turns(&product(two, about_z(0.2))), None);
        // Axes exchanged before and after: each form is found in any place.
        let cyclic = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        assert_eq!(turns(&product(product(cyclic, two), cyclic)), Some(Turns::Two));
    }

    #[test]
    fn a_mount_off_by_more_than_rounding_is_any() {
        let mut nearly = about_z(0.7);
        nearly[0][2] = 1e-14;
        assert_eq!(turns(&nearly), None);
    }
}
