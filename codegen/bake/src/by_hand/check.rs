//! Whether parameters are what was assumed of them.

use core::fmt;

use super::body::{Body, Hub};

/// A parameter that is not what these kernels were derived for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumption {
    /// The device's shape, and its number among those of the shape.
    pub device: (&'static str, usize),
    /// The parameter.
    pub parameter: &'static str,
    /// What it was assumed to be.
    pub assumed: &'static str,
    /// By how much it is off.
    pub off: f64,
    /// What it may be off by: four epsilons of the scale of what it belongs to.
    pub bound: f64,
}

impl Assumption {
    /// Where nothing is off: never returned.
    pub(crate) const NONE: Self =
        Self { device: ("", 0), parameter: "", assumed: "", off: 0.0, bound: 0.0 };
}

impl fmt::Display for Assumption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device: (shape, number), parameter, assumed, off, bound } = self;
        if ["finite", "not negative", "symmetric", "a rotation"].contains(assumed) {
            return write!(
                f,
                "device {number} of {shape}: {parameter} is to be {assumed}; correct it"
            );
        }
        write!(
            f,
            "device {number} of {shape}: {parameter} was assumed {assumed} and is off by {off:e}, \
             more than {bound:e}; emit the kernels again for these parameters, or use the general ones"
        )
    }
}

impl core::error::Error for Assumption {}

/// Passes a number that is rounding beside a scale.
pub(crate) fn vanishes(
    parameter: &'static str,
    assumed: &'static str,
    off: f64,
    scale: f64,
) -> Result<(), Assumption> {
    let bound = 4.0 * f64::EPSILON * scale;
    if off.abs() <= bound {
        return Ok(());
    }
    Err(Assumption { device: ("", 0), parameter, assumed, off, bound })
}

/// Passes finite numbers.
pub(crate) fn finite(
    parameter: &'static str,
    numbers: impl IntoIterator<Item = f64>,
) -> Result<(), Assumption> {
    // NaN passes no bound.
    let off = |number: f64| if number.is_finite() { 0.0 } else { f64::NAN };
    let mut numbers = numbers.into_iter();
    numbers.try_for_each(|number| vanishes(parameter, "finite", off(number), 1.0))
}

/// Passes a device with finite numbers, a rotation for its mount, and masses and inertias that a
/// body can have.
pub(crate) fn possible_device(mount: &[[f64; 3]; 3], bodies: &[Body]) -> Result<(), Assumption> {
    finite("mount", mount.iter().copied().flatten())?;
    finite("mass", bodies.iter().map(|body| body.mass))?;
    finite("origin", bodies.iter().flat_map(|body| body.origin))?;
    finite("centre_of_mass", bodies.iter().flat_map(|body| body.centre_of_mass))?;
    finite("inertia", bodies.iter().flat_map(|body| body.inertia).flatten())?;
    rotation(mount)?;
    bodies.iter().try_for_each(|body| {
        not_negative("mass", body.mass)?;
        possible(&body.inertia)
    })
}

/// Passes columns that are orthonormal within 4096 epsilons and right-handed.
fn rotation(m: &[[f64; 3]; 3]) -> Result<(), Assumption> {
    for a in 0..3 {
        for b in a..3 {
            let [x, y, z] = m.map(|row| row[a] * row[b]);
            let unit = if a == b { 1.0 } else { 0.0 };
            vanishes("mount", "a rotation", x + y + z - unit, 1024.0)?;
        }
    }
    let [[a, b, c], [d, e, f], [g, h, i]] = *m;
    not_negative("mount", a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))
}

/// Passes a symmetric inertia without a negative moment.
fn possible(i: &[[f64; 3]; 3]) -> Result<(), Assumption> {
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        vanishes("inertia", "symmetric", i[row][column] - i[column][row], trace(i))?;
    }
    (0..3).try_for_each(|axis| not_negative("inertia", i[axis][axis]))
}

/// Passes what is not below zero.
fn not_negative(parameter: &'static str, number: f64) -> Result<(), Assumption> {
    let below = if number < 0.0 { number } else { 0.0 };
    vanishes(parameter, "not negative", below, 0.0)
}

/// Passes a hub with finite numbers and with a mass and an inertia that a body can have.
pub(crate) fn possible_hub(hub: &Hub) -> Result<(), Assumption> {
    let of_hub = |mut assumption: Assumption| {
        assumption.device = ("hub", 0);
        assumption
    };
    finite("mass", [hub.mass]).map_err(of_hub)?;
    finite("centre_of_mass", hub.centre_of_mass).map_err(of_hub)?;
    finite("inertia", hub.inertia.iter().copied().flatten()).map_err(of_hub)?;
    not_negative("mass", hub.mass).map_err(of_hub)?;
    possible(&hub.inertia).map_err(of_hub)
}

/// The largest offset of a device.
pub(crate) fn length(bodies: &[Body]) -> f64 {
    let offsets = bodies.iter().flat_map(|body| [body.origin, body.centre_of_mass]);
    offsets.flatten().fold(0.0, |largest, x| if x.abs() > largest { x.abs() } else { largest })
}

/// The trace of an inertia.
pub(crate) fn trace(inertia: &[[f64; 3]; 3]) -> f64 {
    inertia[0][0].abs() + inertia[1][1].abs() + inertia[2][2].abs()
}

/// Components along a device's axes of a place given along those of B.
pub(crate) fn along_device(mount: &[[f64; 3]; 3], r: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|c| mount[0][c] * r[0] + mount[1][c] * r[1] + mount[2][c] * r[2])
}
