//! What the numbers of a device say beforehand: zeros, equal moments of inertia, a mount of a few
//! turns.
//!
//! A number counts as zero, and two as equal, within four epsilons of the scale of what they belong
//! to; the form of a mount is known exactly where the description states its turns. A mass or a distance that happens to equal another one is a coincidence, and stays.

use std::collections::{BTreeMap, BTreeSet};

use precess_codegen::derivation::chain::assumed::{Assumed, Mount};
use precess_codegen::kinds::Kind;
use precess_description::Device;

use crate::error::BakeError;
use crate::mount::{found, stated};
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
    let mount = match &device.turns {
        _ if kept("mount") => Mount::Any,
        Some(turns) => stated(turns),
        None => found(&device.mount),
    };
    Ok(Assumed { zero, equal, mount })
}
