//! Springs and dampers that couple the joints of a platform: `[platform.coupled]`, 6 by 6 matrices
//! by blocks, each with its unit, and `[[platform.strut]]`.
//!
//! ```text
//! K = [ slides    coupling ]      slides: N/m,  coupling: N/rad,  turns: N m/rad
//!     [ coupling' turns    ]
//! ```

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use precess_dynamics::{Coupled, Strut, Suspension};

use crate::file::keys::Keys;
use crate::file::read::values::mount::direction;
use crate::units::{Measure, Plain};

/// Most struts of a platform.
const STRUTS_MAX: usize = 6;
/// A direction whose norm is off by less has all its digits: it is taken unchanged, to the bit.
const NORM_EXACT: f64 = 1e-14;

/// The suspension; nothing where it is wrong, which has been reported.
pub(in crate::file::read) fn suspension(keys: &Keys<'_>) -> Option<Suspension> {
    let mut suspension = Suspension::none();
    if keys.has("coupled") {
        suspension.coupled = Some(coupled(&keys.table("coupled")?)?);
    }
    let struts = keys.tables("strut");
    if struts.len() > STRUTS_MAX {
        let message = format!("`{}` has {} struts", keys.path(), struts.len());
        let help = format!("there are at most {STRUTS_MAX}; add the others to `coupled`");
        keys.error("strut", message, &help);
        return None;
    }
    let struts: Vec<_> = struts.iter().map(strut).collect();
    for (to, from) in suspension.struts.iter_mut().zip(struts) {
        *to = Some(from?);
    }
    Some(suspension)
}

fn coupled(keys: &Keys<'_>) -> Option<Coupled> {
    let stiffness = matrix(
        keys,
        "stiffness",
        [Measure::STIFFNESS, Measure::COUPLING_STIFFNESS, Measure::ANGULAR_STIFFNESS],
    );
    let damping = matrix(
        keys,
        "damping",
        [Measure::DAMPING, Measure::COUPLING_DAMPING, Measure::ANGULAR_DAMPING],
    );
    let slides = keys.vector("rest_slides", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let turns = keys.vector("rest_turns", Measure::ANGLE).unwrap_or_else(Vector3::zeros);
    keys.finish();
    let rest = Vector6::new(slides.x, slides.y, slides.z, turns.x, turns.y, turns.z);
    Some(Coupled { stiffness: stiffness?, damping: damping?, rest })
}

/// A symmetric matrix by its blocks; what is left out is zero.
fn matrix(keys: &Keys<'_>, key: &str, measures: [Measure; 3]) -> Option<Matrix6<f64>> {
    if !keys.has(key) {
        return Some(Matrix6::zeros());
    }
    let table = keys.table(key)?;
    let blocks = ["slides", "coupling", "turns"];
    let found = [0, 1, 2].map(|k| {
        let (name, measure): (&str, Measure) = (blocks[k], measures[k]);
        if !table.has(name) {
            return Some(Matrix3::zeros());
        }
        let rows = table.quantities::<9>(name, measure)?;
        let block = Matrix3::from_row_slice(&rows);
        if k != 1 && block != block.transpose() {
            let message = format!("`{}.{name}` is not symmetric", table.path());
            table.error(name, message, "elements 12, 13 and 23 equal 21, 31 and 32");
            return None;
        }
        Some(block)
    });
    table.finish();
    let [slides, coupling, turns] = found;
    let (slides, coupling, turns) = (slides?, coupling?, turns?);
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&slides);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&coupling);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&coupling.transpose());
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&turns);
    Some(matrix)
}

fn strut(keys: &Keys<'_>) -> Option<Strut> {
    // A name is only for messages and for overrides.
    let _ = keys.text("name");
    let position = keys.vector("position", Measure::LENGTH);
    if !keys.has("position") {
        keys.missing("position", "position = \"20, 0, 0 cm\"");
    }
    if !keys.has("direction") {
        keys.missing("direction", "direction = [0, 0, 1]");
    }
    let unit = direction(keys, "direction");
    let given = if unit.is_some() { keys.numbers::<3>("direction") } else { None };
    let length = keys.required("length", Measure::LENGTH);
    let stiffness = keys.quantity("stiffness", Measure::STIFFNESS).unwrap_or(0.0);
    let damping = keys.quantity("damping", Measure::DAMPING).unwrap_or(0.0);
    keys.finish();
    let given = given.map(Vector3::from).filter(|v| (v.norm() - 1.0).abs() < NORM_EXACT);
    let (unit, length) = (unit?, length?);
    let bounds = [
        ("length", length, length > 0.0, "m", "a length is above zero"),
        ("stiffness", stiffness, stiffness >= 0.0, "N/m", "a stiffness is not negative"),
        ("damping", damping, damping >= 0.0, "N s/m", "a damping is not negative"),
    ];
    for (key, value, fits, unit, help) in bounds {
        if !fits {
            keys.error(key, format!("`{}.{key}` is {} {unit}", keys.path(), Plain(value)), help);
            return None;
        }
    }
    let direction = given.unwrap_or_else(|| unit.into_inner());
    Some(Strut { position: position?, direction, length, stiffness, damping })
}
