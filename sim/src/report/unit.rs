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

/// The peak of a unit that is only used where a limit is stated in it.
const STATED: f64 = f64::INFINITY;
/// Peaks that are readable in a unit.
const READABLE: std::ops::Range<f64> = 1e-3..1e6;
/// Units are one where their sizes differ by no more than this share: both are products of a few rounded numbers.
const SAME: f64 = 1e-9;
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
    unit("arcsec", 3600.0 * DEGREES, STATED),
    unit("mas", 3.6e6 * DEGREES, STATED),
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
pub(super) const ANGULAR_RATE: &Family = &[
    unit("deg/s", DEGREES, 0.0),
    unit("arcsec/s", 3600.0 * DEGREES, STATED),
    unit("µrad/s", 1e6, STATED),
];
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

/// The unit of a family that has a size, SI, where values up to a peak, SI, are readable in it.
pub(super) fn of_size(family: &Family, size: f64, peak: f64) -> Option<Unit> {
    let is_it = |unit: &&Unit| {
        (unit.per_si * size - 1.0).abs() < SAME && READABLE.contains(&(peak * unit.per_si))
    };
    family.iter().find(is_it).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stated_unit_is_used_where_values_are_readable_in_it() {
        let arcsec = std::f64::consts::PI / 648_000.0;
        let of = |size: f64, peak: f64| of_size(SMALL_ANGLE, size, peak).map(|unit| unit.name);
        assert_eq!(of(arcsec, 2.0 * arcsec), Some("arcsec"));
        assert_eq!([of(arcsec, 1e-10 * arcsec), of(1.0, 1.0), of(arcsec, 0.0)], [None; 3]);
        for peak in [1.0, 5e-3, 2e-5, 1e-9, 0.0] {
            let name = for_peak(SMALL_ANGLE, peak).name;
            assert!(!["arcsec", "mas"].contains(&name), "{peak}: {name}");
        }
    }

    #[test]
    fn a_unit_follows_the_peak() {
        let names: Vec<_> = [7e6, 2.0, 0.04, 3e-9, 0.0].map(|p| for_peak(LENGTH, p).name).into();
        assert_eq!(names, ["km", "m", "mm", "µm", "m"]);
        assert!((for_peak(WHEEL_RATE, 1.0).per_si * std::f64::consts::TAU - 60.0).abs() < 1e-12);
    }
}
