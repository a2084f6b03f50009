//! Layouts: one device made several, around an axis of the hub.
//!
//! ```text
//!            axis of the layout, through its centre
//!               |   / axis of the first joint of device k: the gimbal axis of a CMG,
//!               | b/  the spin axis of a wheel; b is the half-angle
//!               |_/
//!   device k at the distance `radius` from the axis, at the azimuth first + k * 360 deg / count
//! ```
//!
//! The azimuth counts about the layout's axis, from the hub's axis that follows it (x after z). The
//! spin axis of a CMG at zero angles is along the tangent, in the direction of growing azimuth; of
//! a device with one joint, the axis that follows the joint's is. A ring is a pyramid with a
//! half-angle of 90 degrees.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_description::{Axis, Turn};

use crate::file::keys::Keys;
use crate::file::read::values::mount::{DeviceAxes, direction, with_axes, with_axis_and_next};
use crate::file::read::values::turns::{Mount, by_quarters, coordinate, exchange, turn};
use crate::units::Measure;

/// The coordinate axes.
const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// Most devices of a layout.
const COUNT_MAX: u32 = 256;

/// Where a device of a layout is: its position in B, and its mount.
pub(in crate::file::read) type MountedPosition = (Vector3<f64>, Mount);

/// The places of a layout; none without one.
pub(in crate::file::read) fn layout(
    keys: &Keys<'_>,
    axes: DeviceAxes,
) -> Option<Vec<MountedPosition>> {
    let layout = keys.table("layout")?;
    for key in ["mount", "position"] {
        if keys.has(key) {
            let message = format!("`{key}` follows from the layout");
            keys.error(key, message, "remove it, or the layout");
        }
    }
    let shapes = ["pyramid", "ring"].map(|key| layout.table(key));
    let found = match shapes {
        [Some(pyramid), None] => {
            let half_angle = pyramid.required("half_angle", Measure::ANGLE);
            half_angle.and_then(|half_angle| places(&pyramid, half_angle, axes))
        }
        [None, Some(ring)] => places(&ring, FRAC_PI_2, axes),
        _ => {
            let message = format!("`{}` is a pyramid or a ring", layout.path());
            let help = "write `layout.pyramid = { count = 4, half_angle = \"54.74 deg\" }`";
            layout.reports().borrow_mut().error(layout.span(), message, "", help);
            None
        }
    };
    layout.finish();
    found
}

fn places(keys: &Keys<'_>, half_angle: f64, axes: DeviceAxes) -> Option<Vec<MountedPosition>> {
    let count = keys.count("count", 1, COUNT_MAX);
    if !keys.has("count") {
        keys.missing("count", "count = 4");
    }
    let first = keys.quantity("first_azimuth", Measure::ANGLE).unwrap_or(0.0);
    let radius = keys.quantity("radius", Measure::LENGTH).unwrap_or(0.0);
    let centre = keys.vector("centre", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let axis = keys.choice("axis", &[("x", 0), ("y", 1), ("z", 2)]).unwrap_or(2);
    keys.finish();
    let count = count?;
    let column = |k: usize| Matrix3::<f64>::identity().column(k % 3).into_owned();
    let (up, start, side) = (column(axis), column(axis + 1), column(axis + 2));
    let place = |k: u32| {
        let azimuth = first + TAU * f64::from(k) / f64::from(count);
        let (sin, cos) = azimuth.sin_cos();
        let radial = start * cos + side * sin;
        let tangent = side * cos - start * sin;
        let (sin, cos) = half_angle.sin_cos();
        let joint = up * cos + radial * sin;
        let mount = if axes.single || axes.first == axes.last {
            with_axis_and_next(axes.first, &joint, &tangent)
        } else {
            with_axes(axes, &joint, &tangent)
        };
        // About the axis, by a part of a turn that may be quarters; about the tangent; between them
        // and the device's axes, an exchange.
        let part = if (4 * k).is_multiple_of(count) {
            by_quarters(axis, u8::try_from(4 * k / count).unwrap_or_default())
        } else {
            Some(Turn { about: ALL[axis % 3], quarters: None })
        };
        let second =
            if axes.single || axes.first == axes.last { axes.first + 1 } else { axes.last };
        let to_device = exchange([axes.first, second], [(axis, false), (axis + 2, false)]);
        let about = [turn(axis, first), part, turn(axis + 2, half_angle)];
        let turns = Some(about.into_iter().flatten().chain(to_device).collect());
        (centre + radial * radius, Mount { matrix: mount, turns })
    };
    Some((0..count).map(place).collect())
}

/// The place of a copy: half a turn about an axis of the hub through B.
pub(in crate::file::read) fn turned(
    keys: &Keys<'_>,
    key: &str,
    place: &MountedPosition,
) -> Option<MountedPosition> {
    let axis = match keys.text_or_list(key) {
        Some(word) => {
            let number = ["x", "y", "z"].iter().position(|name| *name == word);
            let Some(number) = number else {
                keys.error(key, format!("`{key}` is \"{word}\""), "write x, y, z or [1, 0, 0]");
                return None;
            };
            Vector3::ith_axis(number)
        }
        None => direction(keys, key)?,
    };
    // 2 a a' - 1: no sine of pi, so a half turn twice is the same bits.
    let half_turn = axis.into_inner() * axis.transpose() * 2.0 - Matrix3::identity();
    debug_assert!(
        (Rotation3::from_axis_angle(&axis, TAU / 2.0).into_inner() - half_turn).amax() < 1e-14
    );
    let (position, mount) = place;
    let half = coordinate(&axis).and_then(|(axis, _)| by_quarters(axis, 2));
    let turns = half.zip(mount.turns.as_ref());
    let turns = turns.map(|(half, rest)| [&[half], rest.as_slice()].concat());
    Some((half_turn * position, Mount { matrix: half_turn * mount.matrix, turns }))
}
