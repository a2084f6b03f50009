//! Whether parameters are what was assumed of them.

use core::fmt;

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
        write!(
            f,
            "device {number} of {shape}: {parameter} was assumed {assumed} and is off by {off:e}, more \
             than {bound:e}; emit the kernels again for these parameters, or use the general ones"
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
    // What is infinite or NaN less itself is NaN, which passes no bound.
    let mut numbers = numbers.into_iter();
    numbers.try_for_each(|number| vanishes(parameter, "finite", number - number, 1.0))
}

/// Passes the numbers of a device that are finite.
pub(crate) fn finite_device(
    mount: &[[f64; 3]; 3],
    bodies: &[crate::body::Body],
) -> Result<(), Assumption> {
    finite("mount", mount.iter().copied().flatten())?;
    finite("mass", bodies.iter().map(|body| body.mass))?;
    finite("origin", bodies.iter().flat_map(|body| body.origin))?;
    finite("centre_of_mass", bodies.iter().flat_map(|body| body.centre_of_mass))?;
    finite("inertia", bodies.iter().flat_map(|body| body.inertia).flatten())
}

/// Passes a hub whose numbers are finite.
pub(crate) fn finite_hub(hub: &crate::body::Hub) -> Result<(), Assumption> {
    let of_hub = |mut assumption: Assumption| {
        assumption.device = ("hub", 0);
        assumption
    };
    finite("mass", [hub.mass]).map_err(of_hub)?;
    finite("centre_of_mass", hub.centre_of_mass).map_err(of_hub)?;
    finite("inertia", hub.inertia.iter().copied().flatten()).map_err(of_hub)
}

/// The largest offset of a device.
pub(crate) fn length(bodies: &[crate::body::Body]) -> f64 {
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
