//! Bounds that more than one module uses, and the number of spacecraft.

/// Largest residual, in epsilons of the sum of magnitudes: a dozen roundings in a row.
pub(crate) const EPSILONS: f64 = 50.0;

/// Largest drift of energy less work and of momentum with a tolerance of 1e-13, of the unit named
/// there.
pub(crate) const DRIFT: f64 = 1e-12;

/// Largest difference of the same physics with other rounding, of the block.
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
