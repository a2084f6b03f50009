//! The inertia of a body, by one of three ways to write it:
//!
//! ```toml
//! inertia = "900, 800, 600 kg m^2"                    # moments about the body's axes
//! products_of_inertia = "4.15, 2.93, -2.75 kg m^2"    # elements 12, 13, 23 of the tensor: minus the integral of x y, ...
//! inertia_integrals = "-4.15, -2.93, 2.75 kg m^2"     # or the integrals of x y, x z, y z over the mass
//! inertia_axes = { axis = [0, 0, 1], angle = "30 deg" }   # or the moments are about these axes
//! ```

use nalgebra::Matrix3;

use crate::file::keys::Keys;
use crate::file::read::values::mount::principal_axes;
use crate::units::{Measure, Plain};

/// The keys, the first of which is the others' condition.
pub(in crate::file) const INERTIA_KEYS: [&str; 4] =
    ["inertia", "products_of_inertia", "inertia_integrals", "inertia_axes"];

/// The tensor about the centre of mass in the body's axes; none where it is missing or wrong, which has been reported.
pub(in crate::file) fn inertia(keys: &Keys<'_>) -> Option<Matrix3<f64>> {
    let [moments, elements, integrals] = ["inertia", "products_of_inertia", "inertia_integrals"]
        .map(|key| keys.quantities::<3>(key, Measure::INERTIA));
    let axes = keys.table("inertia_axes").and_then(|axes| principal_axes(&axes));
    let [_, ways @ ..] = INERTIA_KEYS;
    let given: Vec<_> = ways.into_iter().filter(|key| keys.has(key)).collect();
    if let [first, second, ..] = given.as_slice() {
        let message = format!(
            "`{first}` and `{second}` are given, and each of them says what the other does"
        );
        keys.error(second, message, "keep one of them");
        return None;
    }
    if !keys.has("inertia") {
        keys.missing("inertia", "inertia = \"1, 1, 1 kg m^2\"");
        return None;
    }
    let moments = moments?;
    if moments.iter().any(|moment| *moment < 0.0) {
        let [x, y, z] = moments.map(Plain);
        let message = format!("`{}.inertia` is {x}, {y}, {z} kg m^2", keys.path());
        keys.error("inertia", message, "a moment of inertia is not negative");
        return None;
    }
    if keys.has("inertia_axes") {
        let axes = axes?;
        let tensor = axes * Matrix3::from_diagonal(&moments.into()) * axes.transpose();
        return Some(0.5 * (tensor + tensor.transpose()));
    }
    let [xx, yy, zz] = moments;
    let integrals = integrals.map(|integrals| integrals.map(|integral| -integral));
    let [xy, xz, yz] = elements.or(integrals).unwrap_or_default();
    Some(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz))
}
