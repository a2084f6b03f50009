//! [`Estimate`]: a number with its standard deviation and its 95 % interval, and Student's quantile.

/// A fitted number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number, SI.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Lower and upper end of its 95 % interval.
    pub interval: [f64; 2],
}

/// The quantile 0.975 of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;

impl Estimate {
    /// With the quantile of `freedom` degrees; symmetric.
    #[must_use]
    pub fn new(value: f64, deviation: f64, freedom: f64) -> Self {
        let half = student(freedom) * deviation;
        Self { value, deviation, interval: [value - half, value + half] }
    }

    /// A number above zero with the relative standard deviation: the interval is that of the logarithm, so above zero too.
    #[must_use]
    pub fn positive(value: f64, relative: f64, freedom: f64) -> Self {
        let factor = (student(freedom) * relative).exp();
        Self { value, deviation: value * relative, interval: [value / factor, value * factor] }
    }

    /// A number that is known.
    #[must_use]
    pub const fn exact(value: f64) -> Self {
        Self { value, deviation: 0.0, interval: [value, value] }
    }

    /// The exponential of an estimate: its interval is that of the logarithm.
    #[must_use]
    pub fn exponential(self) -> Self {
        let value = self.value.exp();
        let interval = self.interval.map(f64::exp);
        Self { value, deviation: value * self.deviation, interval }
    }

    /// The square root of an estimate that may be negative by noise: then, zero.
    #[must_use]
    pub fn root(self) -> Self {
        let interval = self.interval.map(|end| end.max(0.0).sqrt());
        let value = self.value.max(0.0).sqrt();
        let deviation = if value > 0.0 { 0.5 * self.deviation / value } else { interval[1] };
        Self { value, deviation, interval }
    }

    /// In another unit.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self {
            value: factor * self.value,
            deviation: factor.abs() * self.deviation,
            interval: self.interval.map(|end| factor * end),
        }
    }

    /// Whether a number is in the interval.
    #[must_use]
    pub fn contains(&self, number: f64) -> bool {
        (self.interval[0]..=self.interval[1]).contains(&number)
    }
}

/// The quantile 0.975 of Student's distribution by its expansion about the normal one (Abramowitz and
/// Stegun 26.7.5); within 0.1 % from 4 degrees of freedom, which is the least taken.
#[must_use]
pub fn student(freedom: f64) -> f64 {
    let (z, n) = (NORMAL, freedom.max(4.0));
    let (z2, z3) = (z * z, z * z * z);
    let first = (z3 + z) / 4.0;
    let second = ((5.0 * z2 + 16.0) * z3 + 3.0 * z) / 96.0;
    let third = (((3.0 * z2 + 19.0) * z2 + 17.0) * z3 - 15.0 * z) / 384.0;
    let fourth = ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z3 - 945.0 * z) / 92_160.0;
    z + (first + (second + (third + fourth / n) / n) / n) / n
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Terms of the expansion that are left out, at 4 degrees of freedom.
    const EXPANSION: f64 = 2e-3;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (freedom, table) in [
            (4.0, 2.776_445),
            (5.0, 2.570_582),
            (10.0, 2.228_139),
            (30.0, 2.042_272),
            (1e9, NORMAL),
        ] {
            assert!((student(freedom) / table - 1.0).abs() < EXPANSION, "{freedom}");
        }
        assert!(student(f64::NAN).is_finite());
    }

    #[test]
    fn the_interval_of_a_density_is_above_zero() {
        let few = Estimate::positive(1e-9, 0.5, 4.0);
        assert!(few.interval[0] > 0.0 && few.contains(2e-9), "{few:?}");
        // Of many degrees of freedom it is the symmetric one.
        let many = Estimate::positive(3.0, 1e-4, 1e8);
        let symmetric = Estimate::new(3.0, 3e-4, 1e8);
        for (found, expected) in many.interval.iter().zip(symmetric.interval) {
            assert!((found - expected).abs() < 1e-7, "{found} {expected}");
        }
    }

    #[test]
    fn an_interval_follows_its_number_through_functions() {
        let power = Estimate::new(4.0, 0.1, 1e9);
        let root = power.root();
        assert_eq!(root.value, 2.0);
        assert!((root.deviation - 0.025).abs() < 1e-15 && root.contains(2.04));
        let noise = Estimate::new(-1.0, 1.0, 1e9).root();
        assert_eq!((noise.value, noise.interval[0]), (0.0, 0.0));
        assert!(noise.interval[1] > 0.9);
    }
}
