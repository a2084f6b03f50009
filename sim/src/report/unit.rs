//! [`Unit`]: the unit in which a quantity is read. Columns are SI; a chart is in the largest unit of
//! its family that its peak reaches.

/// A unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    /// As it is written; empty for a pure number.
    pub(super) name: &'static str,
    /// How many of it are one SI unit.
    pub(super) per_si: f64,
    /// The peak, SI, from which it is used.
    from: f64,
}

/// Units of one dimension, the largest first; the last one is for peaks below all others.
pub(super) type Family = [Unit];

const fn unit(name: &'static str, per_si: f64, from: f64) -> Unit {
    Unit { name, per_si, from }
}

/// Degrees in a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
/// Revolutions in a radian.
const TURNS: f64 = 0.5 / std::f64::consts::PI;

pub(super) const NUMBER: &Family = &[unit("", 1.0, 0.0)];
pub(super) const ANGLE: &Family = &[unit("deg", DEGREES, 0.0)];
pub(super) const DISPLACEMENT: &Family =
    &[unit("m", 1.0, 1.0), unit("mm", 1e3, 1e-3), unit("µm", 1e6, 1e-6), unit("nm", 1e9, 0.0)];
pub(super) const SMALL_ANGLE: &Family = &[
    unit("deg", DEGREES, 1e-2),
    unit("mrad", 1e3, 1e-3),
    unit("µrad", 1e6, 1e-6),
    unit("nrad", 1e9, 0.0),
];
pub(super) const MODAL: &Family = &[
    unit("m kg^½", 1.0, 1.0),
    unit("mm kg^½", 1e3, 1e-3),
    unit("µm kg^½", 1e6, 1e-6),
    unit("nm kg^½", 1e9, 0.0),
];
pub(super) const MODAL_RATE: &Family =
    &[unit("m kg^½/s", 1.0, 1.0), unit("mm kg^½/s", 1e3, 1e-3), unit("µm kg^½/s", 1e6, 0.0)];
pub(super) const REVOLUTIONS: &Family = &[unit("rev", TURNS, 0.0)];
pub(super) const ANGULAR_RATE: &Family = &[unit("deg/s", DEGREES, 0.0)];
pub(super) const WHEEL_RATE: &Family = &[unit("rpm", 60.0 * TURNS, 0.0)];
pub(super) const ANGULAR_ACCELERATION: &Family = &[unit("deg/s²", DEGREES, 0.0)];
pub(super) const WHEEL_ACCELERATION: &Family = &[unit("rpm/s", 60.0 * TURNS, 0.0)];
pub(super) const LENGTH: &Family =
    &[unit("km", 1e-3, 1e4), unit("m", 1.0, 1.0), unit("mm", 1e3, 1e-3), unit("µm", 1e6, 0.0)];
pub(super) const VELOCITY: &Family = &[
    unit("km/s", 1e-3, 1e3),
    unit("m/s", 1.0, 1.0),
    unit("mm/s", 1e3, 1e-3),
    unit("µm/s", 1e6, 0.0),
];
pub(super) const ACCELERATION: &Family =
    &[unit("m/s²", 1.0, 1.0), unit("mm/s²", 1e3, 1e-3), unit("µm/s²", 1e6, 0.0)];
pub(super) const MOTOR_TORQUE: &Family = &[unit("N m", 1.0, 10.0), unit("mN m", 1e3, 0.0)];
pub(super) const MOMENT: &Family = &[unit("N m", 1.0, 0.1), unit("mN m", 1e3, 0.0)];
pub(super) const FORCE: &Family =
    &[unit("kN", 1e-3, 1e4), unit("N", 1.0, 0.1), unit("mN", 1e3, 0.0)];
pub(super) const ENERGY: &Family = &[unit("kJ", 1e-3, 1e5), unit("J", 1.0, 0.0)];
pub(super) const LINEAR_MOMENTUM: &Family = &[unit("N s", 1.0, 0.0)];
pub(super) const ANGULAR_MOMENTUM: &Family = &[unit("N m s", 1.0, 0.0)];

/// The unit of a family for values up to a peak, SI. Zero everywhere is read in the unit next to SI.
pub(super) fn for_peak(family: &Family, peak: f64) -> Unit {
    let fits = |unit: &&Unit| {
        if peak == 0.0 || !peak.is_finite() { unit.per_si >= 1.0 } else { peak >= unit.from }
    };
    family.iter().find(fits).or(family.last()).copied().unwrap_or(unit("", 1.0, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_follows_the_peak() {
        let names: Vec<_> = [7e6, 2.0, 0.04, 3e-9, 0.0].map(|p| for_peak(LENGTH, p).name).into();
        assert_eq!(names, ["km", "m", "mm", "µm", "m"]);
        assert!((for_peak(WHEEL_RATE, 1.0).per_si * std::f64::consts::TAU - 60.0).abs() < 1e-12);
    }
}
