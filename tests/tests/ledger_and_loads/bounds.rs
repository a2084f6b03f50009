//! The numbers that more than one suite is held to, and how many spacecraft.

/// E1 and A1: rounding of a dozen roundings in a row, in epsilons of the sum of magnitudes.
pub(crate) const EPSILONS: f64 = 50.0;

/// E2 and E3: what an integrator at a tolerance of 1e-13 keeps, of the unit named at the place.
pub(crate) const DRIFT: f64 = 1e-12;

/// A4: the same physics with other rounding, of the block.
pub(crate) const LIMIT: f64 = 1e-12;

/// Spacecraft drawn of each set; the two sets hold every kind.
pub(crate) const SPACECRAFT: u64 = 100;

/// The largest number shown to a check, for what a suite prints and asserts in the end.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Worst(pub(crate) f64);

impl Worst {
    /// Counts a number; NaN counts as infinite.
    pub(crate) fn add(&mut self, found: f64) {
        self.0 = if found.is_nan() { f64::INFINITY } else { self.0.max(found) };
    }
}
