//! `[hub]`: mass and inertia, those of the structure's file where the hub has none; size and mode.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::{Hub, HubMode};

use super::super::keys::Keys;
use super::devices::body;
use super::devices::inertia::{INERTIA_KEYS, inertia};
use super::structure::Structure;
use crate::structure::RigidMass;
use crate::units::Measure;

/// Mass and inertia of `[hub]` and of the file may differ by this share: three digits.
const MASS_DIFFERENCE_MAX: f64 = 1e-3;

/// The hub, the size of its box, its mode. Mass and inertia may be those of the structure's file.
pub(super) fn hub(
    keys: &Keys<'_>,
    structure: Option<&Structure>,
) -> Option<(Hub, Vector3<f64>, HubMode)> {
    // With the mass of the structure's file every key has a default.
    let empty = keys.empty();
    let table = match structure.and_then(Structure::mass) {
        Some(_) => keys.table_or("hub", &empty),
        None => keys.table("hub"),
    };
    let Some(hub) = table else {
        if !keys.has("hub") {
            keys.missing("hub", "[hub]");
        }
        return None;
    };
    let has_mass = ["mass", "centre_of_mass"].iter().chain(&INERTIA_KEYS).any(|key| hub.has(key));
    let (m_b, r_bc_b, i_b_bc) = match structure.and_then(Structure::mass) {
        Some(of_file) if !has_mass => {
            let (mass, centre, inertia) = about_centre(of_file);
            (Some(mass), centre, Some(inertia))
        }
        of_file => {
            let m_b = body::mass(&hub);
            let centre = hub.vector("centre_of_mass", Measure::LENGTH);
            let i_b_bc = inertia(&hub);
            let centre = centre.unwrap_or_else(Vector3::zeros);
            if let (Some(of_file), Some(mass), Some(inertia)) = (of_file, m_b, i_b_bc) {
                compare(&hub, of_file, mass, &centre, &inertia);
            }
            (m_b, centre, i_b_bc)
        }
    };
    let size = hub.vector("size", Measure::LENGTH);
    let mode = hub.choice("mode", &[("free", true), ("fixed", false)]).unwrap_or(true);
    let mode = if mode { HubMode::Free } else { HubMode::Fixed };
    hub.finish();
    let (m_b, i_b_bc) = (m_b?, i_b_bc?);
    Some((Hub { m_b, r_bc_b, i_b_bc }, size.unwrap_or_else(|| drawn(m_b, &i_b_bc)), mode))
}

/// The edges of a homogeneous box of a mass and moments of inertia, m.
fn drawn(mass: f64, inertia: &Matrix3<f64>) -> Vector3<f64> {
    let moments = inertia.diagonal();
    let half = moments.sum() / 2.0;
    let edge = |moment: f64| (12.0 * (half - moment).max(0.0) / mass).sqrt();
    let edges = moments.map(edge);
    if edges.iter().all(|edge| edge.is_finite() && *edge > 0.0) {
        edges
    } else {
        Vector3::repeat(1.0)
    }
}

/// Mass, centre of mass and inertia about it.
fn about_centre(mass: &RigidMass) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let centre = mass.centre();
    let cross = centre.cross_matrix();
    let inertia = mass.inertia + mass.mass * cross * cross;
    (mass.mass, centre, 0.5 * (inertia + inertia.transpose()))
}

/// Reports mass or inertia of `[hub]` that differ from those of the structure's file.
fn compare(
    hub: &Keys<'_>,
    of_file: &RigidMass,
    mass: f64,
    centre: &Vector3<f64>,
    inertia: &Matrix3<f64>,
) {
    let given = RigidMass::about_centre(mass, *centre, *inertia).matrix();
    let found = of_file.matrix();
    for (key, [from, size]) in [("mass", [0, 3]), ("inertia", [3, 3])] {
        let part = |of: &nalgebra::Matrix6<f64>| of.view((from, from), (size, size)).into_owned();
        let (given, found) = (part(&given), part(&found));
        if (&given - &found).amax() > MASS_DIFFERENCE_MAX * found.amax() {
            let values = |of: &DMatrix<f64>| {
                if key == "mass" {
                    format!("{} kg", of[(0, 0)])
                } else {
                    format!("{}, {}, {} kg m^2 about B", of[(0, 0)], of[(1, 1)], of[(2, 2)])
                }
            };
            let message = format!(
                "`hub.{key}` makes {}, and the structure's file has {}: the hub is the whole \
                 structure",
                values(&given),
                values(&found)
            );
            hub.error(key, message, "make them agree, or leave the hub's to the file");
        }
    }
}
