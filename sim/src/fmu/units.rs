//! The units of a unit's variables, by exponents of SI base units, and those in which importers show them.

/// A unit: its name, its exponents, and what it is shown in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) name: &'static str,
    /// Exponents of base units.
    pub(super) base: &'static [(&'static str, i8)],
    /// Names, and how many of them one is.
    pub(super) shown: &'static [(&'static str, f64)],
}

const fn unit(name: &'static str, base: &'static [(&'static str, i8)]) -> Unit {
    Unit { name, base, shown: &[] }
}

/// Degrees in a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
/// Turns per minute in a radian per second.
const TURNS: f64 = 30.0 / std::f64::consts::PI;

/// All of them, sorted by use.
pub(super) const UNITS: [Unit; 21] = [
    unit("s", &[("s", 1)]),
    unit("m", &[("m", 1)]),
    unit("m/s", &[("m", 1), ("s", -1)]),
    unit("m/s2", &[("m", 1), ("s", -2)]),
    unit("1", &[]),
    unit("1/s", &[("s", -1)]),
    Unit { name: "rad", base: &[("rad", 1)], shown: &[("deg", DEGREES)] },
    Unit {
        name: "rad/s",
        base: &[("rad", 1), ("s", -1)],
        shown: &[("deg/s", DEGREES), ("rpm", TURNS)],
    },
    unit("rad/s2", &[("rad", 1), ("s", -2)]),
    unit("kg", &[("kg", 1)]),
    unit("kg.m2", &[("kg", 1), ("m", 2)]),
    unit("N", &[("kg", 1), ("m", 1), ("s", -2)]),
    unit("N.m", &[("kg", 1), ("m", 2), ("s", -2)]),
    unit("J", &[("kg", 1), ("m", 2), ("s", -2)]),
    unit("kg.m/s", &[("kg", 1), ("m", 1), ("s", -1)]),
    unit("kg.m2/s", &[("kg", 1), ("m", 2), ("s", -1)]),
    unit("N/m", &[("kg", 1), ("s", -2)]),
    unit("N.s/m", &[("kg", 1), ("s", -1)]),
    unit("N.m/rad", &[("kg", 1), ("m", 2), ("s", -2), ("rad", -1)]),
    unit("N.m.s/rad", &[("kg", 1), ("m", 2), ("s", -1), ("rad", -1)]),
    unit("m3/s2", &[("m", 3), ("s", -2)]),
];
