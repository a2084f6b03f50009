//! Rotations: the mount of a device, the attitude of the hub.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use super::turns::{self, Mount, are_at_right_angles, of_columns, turn};
use crate::file::keys::Keys;
use crate::units::Measure;

/// Columns and rows of a matrix may miss a rotation by this; it is then made one. Six digits do.
const SKEW_MAX: f64 = 2e-6;

/// The ways to write a rotation.
const WAYS: [&str; 5] = ["matrix", "dcm", "axis", "euler", "spin_axis"];

/// Which axes three turns turn into which, of a mount.
const DEVICE_DIRECTIONS: [&str; 2] = ["hub to device", "device to hub"];

/// The axes by which a device is mounted.
#[derive(Clone, Copy)]
pub(in crate::file::read) struct DeviceAxes {
    /// That of its first joint.
    pub(in crate::file::read) first: usize,
    /// That of its last joint.
    pub(in crate::file::read) last: usize,
    /// Whether they are the same: it is mounted by one axis.
    pub(in crate::file::read) single: bool,
}

/// `mount`, whose columns are the device's axes at zero angles, expressed in B.
pub(in crate::file::read) fn mount(keys: &Keys<'_>, axes: DeviceAxes) -> Option<Mount> {
    if !keys.has("mount") {
        return Some(Mount { matrix: Matrix3::identity(), turns: Some(Vec::new()) });
    }
    let mount = keys.table("mount")?;
    way(&mount, Some(axes), DEVICE_DIRECTIONS)
}

/// The mount of a platform, which has no axis of its own.
pub(in crate::file::read) fn rotation_of(mount: &Keys<'_>) -> Option<Mount> {
    way(mount, None, DEVICE_DIRECTIONS)
}

/// The principal axes of a body: columns, expressed in the body's axes.
pub(in crate::file::read) fn principal_axes(keys: &Keys<'_>) -> Option<Matrix3<f64>> {
    way(keys, None, ["body to axes", "axes to body"]).map(|axes| axes.matrix)
}

/// A rotation in one of the ways to write it; by axes only of what has them.
fn way(mount: &Keys<'_>, axes: Option<DeviceAxes>, directions: [&str; 2]) -> Option<Mount> {
    let ways: Vec<_> = WAYS
        .into_iter()
        .filter(|way| (axes.is_some() || *way != "spin_axis") && mount.has(way))
        .collect();
    let of_axes = axes.filter(|_| mount.has("gimbal_axis") || mount.has("hinge_axis"));
    let found = match (ways.as_slice(), of_axes) {
        (["matrix"], _) => matrix(mount, "matrix").map(|m| numbers(rotation(&m))),
        // All digits of one: it is taken unchanged.
        (["dcm"], _) => matrix(mount, "dcm").map(numbers),
        (["axis"], _) => axis_and_angle(mount),
        (["euler"], _) => euler(mount, directions),
        (["spin_axis"], _) => by_axes(mount, axes?),
        ([], Some(axes)) => by_axes(mount, axes),
        _ => {
            let mut names: Vec<_> = ways.iter().map(|way| format!("`{way}`")).collect();
            if of_axes.is_some() {
                names.push("axes of joints".to_owned());
            }
            let message = match names.as_slice() {
                [] => format!("`{}` says no direction", mount.path()),
                names => format!(
                    "`{}` is given in more than one way: {}",
                    mount.path(),
                    names.join(", ")
                ),
            };
            let help = match axes {
                Some(_) => {
                    "give one of `matrix`, `axis` with `angle`, `euler` with `sequence` and \
                     `direction`, or `spin_axis` with `gimbal_axis`"
                }
                None => {
                    "give one of `matrix`, `axis` with `angle`, or `euler` with `sequence` and \
                     `direction`"
                }
            };
            mount.reports().borrow_mut().error(mount.span(), message, "", help);
            None
        }
    };
    mount.finish();
    found
}

/// A mount of which only the numbers are known.
fn numbers(matrix: Matrix3<f64>) -> Mount {
    Mount { matrix, turns: None }
}

/// A direction; nothing where it has no length, which has been reported.
pub(in crate::file) fn direction(keys: &Keys<'_>, key: &str) -> Option<Unit<Vector3<f64>>> {
    let vector = Vector3::from(keys.numbers::<3>(key)?);
    let unit = Unit::try_new(vector, 1e-150);
    if unit.is_none() {
        keys.error(key, format!("`{key}` has no direction"), "give three numbers, not all zero");
    }
    unit
}

/// Rows as written; the columns are the new axes.
fn matrix(keys: &Keys<'_>, key: &str) -> Option<Matrix3<f64>> {
    let rows = rows(keys, key)?;
    let matrix = Matrix3::from_fn(|row, column| rows[row][column]);
    let skew = (matrix.transpose() * matrix - Matrix3::identity()).amax();
    if skew.is_nan() || skew > SKEW_MAX {
        let message = format!("columns miss length one and right angles by {skew:.1e}");
        let help =
            format!("{SKEW_MAX:e} is taken as rounding; a DCM's columns are the device's axes");
        keys.error(key, message, &help);
        return None;
    }
    if matrix.determinant() < 0.0 {
        keys.error(key, "the axes are left-handed", "reverse one column");
        return None;
    }
    Some(matrix)
}

/// The rotation whose first column, and the plane of its first two, are those of a matrix.
fn rotation(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let x = matrix.column(0).normalize();
    let y = matrix.column(1) - x * x.dot(&matrix.column(1));
    let y = y.normalize();
    Matrix3::from_columns(&[x, y, x.cross(&y)])
}

fn rows(keys: &Keys<'_>, key: &str) -> Option<[[f64; 3]; 3]> {
    use crate::file::document::Value;
    let wrong = || {
        keys.error(key, format!("`{key}` is no list of three rows of three numbers"), "");
        None
    };
    let Some(node) = keys.node(key) else { return wrong() };
    let Value::List(list) = &node.value else { return wrong() };
    let mut rows = [[0.0; 3]; 3];
    if list.len() != 3 {
        return wrong();
    }
    for (row, node) in rows.iter_mut().zip(list) {
        let Value::List(numbers) = &node.value else { return wrong() };
        if numbers.len() != 3 {
            return wrong();
        }
        for (element, number) in row.iter_mut().zip(numbers) {
            let Value::Number(value, _) = number.value else { return wrong() };
            *element = value;
        }
    }
    Some(rows)
}

/// The old axes turned about an axis.
pub(in crate::file::read) fn axis_and_angle(keys: &Keys<'_>) -> Option<Mount> {
    let axis = direction(keys, "axis");
    let angle = keys.required("angle", Measure::ANGLE);
    let (axis, angle) = (axis?, angle?);
    let matrix = Rotation3::from_axis_angle(&axis, angle).into_inner();
    Some(Mount { matrix, turns: turns::about(&axis, angle) })
}

/// Three turns about axes that turn along: `sequence = "ZYX"`, and which axes are turned into
/// which. The first direction is that of the turns as written; the second is its inverse.
pub(in crate::file::read) fn euler(keys: &Keys<'_>, directions: [&str; 2]) -> Option<Mount> {
    let angles = keys.quantities::<3>("euler", Measure::ANGLE);
    if !keys.has("sequence") {
        keys.missing("sequence", "sequence = \"ZYX\"");
    }
    if !keys.has("direction") {
        keys.missing("direction", &format!("direction = \"{}\"", directions[0]));
    }
    let words = [(directions[0], true), (directions[1], false)];
    let forward = keys.choice("direction", &words);
    let sequence = keys.text("sequence")?;
    let axes: Vec<_> = sequence
        .chars()
        .filter_map(|letter| match letter.to_ascii_uppercase() {
            'X' | '1' => Some(Vector3::x_axis()),
            'Y' | '2' => Some(Vector3::y_axis()),
            'Z' | '3' => Some(Vector3::z_axis()),
            _ => None,
        })
        .collect();
    let &[first, second, third] = axes.as_slice() else {
        keys.error(
            "sequence",
            format!("`{sequence}` is no sequence of three axes"),
            "write ZYX or 321",
        );
        return None;
    };
    if sequence.len() != 3 || first == second || second == third {
        keys.error(
            "sequence",
            format!("`{sequence}` turns twice about one axis"),
            "write ZYX or 313",
        );
        return None;
    }
    let [a, b, c] = angles?;
    let turns = Rotation3::from_axis_angle(&first, a)
        * Rotation3::from_axis_angle(&second, b)
        * Rotation3::from_axis_angle(&third, c);
    let matrix = turns.into_inner();
    let steps = [(&first, a), (&second, b), (&third, c)];
    let step = |(axis, angle): (&Unit<Vector3<f64>>, f64)| turn(axis.iamax(), angle);
    Some(if forward? {
        Mount { matrix, turns: Some(steps.into_iter().filter_map(step).collect()) }
    } else {
        let back = steps.into_iter().rev().map(|(axis, angle)| (axis, -angle));
        let turns = Some(back.filter_map(step).collect());
        Mount { matrix: matrix.transpose(), turns }
    })
}

/// By the axes of its joints at zero angles, expressed in B.
fn by_axes(keys: &Keys<'_>, axes: DeviceAxes) -> Option<Mount> {
    if axes.single {
        let key = if keys.has("hinge_axis") { "hinge_axis" } else { "spin_axis" };
        if keys.has("gimbal_axis") {
            keys.error("gimbal_axis", "the kind has no gimbal", "remove it");
        }
        let axis = direction(keys, key)?;
        return Some(with_axis(axes.first, &axis));
    }
    if !keys.has("gimbal_axis") {
        keys.missing("gimbal_axis", "gimbal_axis = [0, 0, 1]");
    }
    if !keys.has("spin_axis") {
        keys.missing("spin_axis", "spin_axis = [1, 0, 0]");
    }
    let (spin, gimbal) = (direction(keys, "spin_axis"), direction(keys, "gimbal_axis"));
    let (spin, gimbal) = (spin?, gimbal?);
    let off = spin.dot(&gimbal);
    if off.abs() > SKEW_MAX {
        let degrees = off.acos().to_degrees();
        let message = format!("spin axis and gimbal axis are at {degrees:.4} deg to each other");
        keys.error("gimbal_axis", message, "at zero angles they are at right angles");
        return None;
    }
    let corrected = (spin.into_inner() - gimbal.into_inner() * off).normalize();
    // What is taken off for a right angle may be where a zero is written.
    let zeros = if are_at_right_angles(off) { spin.into_inner() } else { corrected };
    let turns = of_columns([axes.first, axes.last], [&gimbal, &zeros]);
    Some(Mount { matrix: with_axes(axes, &gimbal, &corrected), turns })
}

/// Axes with one of them given; the next is the nearest to an axis of B that is at a right angle.
fn with_axis(number: usize, axis: &Vector3<f64>) -> Mount {
    let smallest = axis.iamin();
    let mut other = Vector3::zeros();
    other[smallest] = 1.0;
    let next = (other - axis * axis.dot(&other)).normalize();
    let last = axis.cross(&next);
    let mut columns = [Vector3::zeros(); 3];
    for (k, column) in [*axis, next, last].into_iter().enumerate() {
        columns[(number + k) % 3] = column;
    }
    // The last is across the axis of B by its definition: of its zeros rounding leaves nothing.
    let turns = of_columns([number, (number + 2) % 3], [axis, &axis.cross(&other)]);
    Mount { matrix: Matrix3::from_columns(&columns), turns }
}

/// Axes of which those of the first and of the last joint are given, at right angles.
pub(in crate::file::read) fn with_axes(
    axes: DeviceAxes,
    first: &Vector3<f64>,
    last: &Vector3<f64>,
) -> Matrix3<f64> {
    let mut columns = [Vector3::zeros(); 3];
    columns[axes.first] = *first;
    columns[axes.last] = *last;
    let rest = 3 - axes.first - axes.last;
    columns[rest] = columns[(rest + 1) % 3].cross(&columns[(rest + 2) % 3]);
    Matrix3::from_columns(&columns)
}

/// Axes of which one is given, and the one after it.
pub(in crate::file::read) fn with_axis_and_next(
    number: usize,
    axis: &Vector3<f64>,
    next: &Vector3<f64>,
) -> Matrix3<f64> {
    let mut columns = [Vector3::zeros(); 3];
    columns[number] = *axis;
    columns[(number + 1) % 3] = *next;
    columns[(number + 2) % 3] = axis.cross(next);
    Matrix3::from_columns(&columns)
}
