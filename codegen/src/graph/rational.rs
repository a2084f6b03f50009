//! Exact coefficients that never overflow: a result too large to be one is no result.

/// An exact coefficient.
pub type Rational = num_rational::Ratio<i64>;

/// Numerators and denominators stay below this, so that no step between two of them leaves `i64`.
const BOUND: i64 = 1 << 31;

/// `k`, where it is small enough to calculate with.
pub(crate) fn bounded(k: Rational) -> Option<Rational> {
    let small = k.numer().unsigned_abs() < BOUND.unsigned_abs() && *k.denom() < BOUND;
    small.then_some(k)
}

/// `a + b`.
pub(crate) fn sum(a: Rational, b: Rational) -> Option<Rational> {
    bounded(bounded(a)? + bounded(b)?)
}

/// `a b`.
pub(crate) fn product(a: Rational, b: Rational) -> Option<Rational> {
    bounded(bounded(a)? * bounded(b)?)
}

/// The nearest double.
#[expect(clippy::cast_precision_loss, reason = "both parts are below 2^31")]
#[must_use]
pub fn float(k: Rational) -> f64 {
    *k.numer() as f64 / *k.denom() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_too_large_is_none() {
        let large = Rational::from(1 << 30);
        assert_eq!(product(large, Rational::from(4)), None);
        assert_eq!(sum(large, large), None);
        assert_eq!(product(large.recip(), Rational::new(1, 4)), None);
        assert_eq!(sum(Rational::new(1, 3), Rational::new(1, 6)), Some(Rational::new(1, 2)));
    }
}
