//! The longest step at which Runge-Kutta's method of fourth order lets no vibration of
//! `M q'' + C q' + K q = 0` grow, from the mass matrix less shares of damping and stiffness.
//!
//! A step multiplies a vibration of eigenvalue λ by `R(z) = 1 + z + z²/2 + z³/6 + z⁴/24`, `z = λ dt`,
//! and is stable while `|R(z)| <= 1`: up to `s` = 2.785 on the real axis (friction), to `sqrt 8` on
//! the imaginary one (springs). With x the shape of the vibration, λ is a root of
//! `λ² + a λ + b = 0` for `a = x*Cx / x*Mx` and `b = x*Kx / x*Mx`, neither below zero. So each
//! eigenvalue is stable where its pair `(a dt, b dt²)` lies in
//!
//! ```text
//! (S2)  a dt - b dt² / s <= s,   and   b dt² <= 6.841
//!                                or    b dt² <= 8,  b dt² + 1.56 a dt <= 10.65
//! ```
//!
//! The first line is the real root of magnitude s. Between the axes the method is stable up to
//! 2.6156 in the worst direction, the square of which is 6.841; near the imaginary axis up to
//! sqrt 8. All pairs (a, b) of a system form a convex set, and each line of (S2) holds for all of
//! them where one matrix `M - x C - y K` is positive definite, (S1). So nothing that is accepted can
//! grow, however springs and dampers are distributed; of a single spring and damper, what is
//! rejected is at most 9 % below its limit.

use crate::equations::mass_reduction::MassReduction;
use crate::numbers::real::{Scalar, half, one, two, zero};

/// `s`: the root of `R(-s) = 1`.
const FRICTION: f64 = 2.785_293_563_405_282;

/// A line of (S2): shares of `a dt` and of `b dt²` whose sum is at most one.
#[derive(Clone, Copy, Debug)]
struct Line {
    damping: f64,
    stiffness: f64,
}

/// The real root of magnitude s.
const REAL_ROOT: Line = Line { damping: 1.0 / FRICTION, stiffness: -1.0 / (FRICTION * FRICTION) };

/// Vibrations of any damping.
const ANY_DAMPING: Line = Line { damping: 0.0, stiffness: 1.0 / 6.841 };

/// The real root and any damping at once: where it holds, so does each.
const BOTH: Line = Line { damping: REAL_ROOT.damping, stiffness: ANY_DAMPING.stiffness };

/// Vibrations of little damping.
const UNDAMPED: Line = Line { damping: 0.0, stiffness: 1.0 / 8.0 };

/// How little that is.
const LITTLE_DAMPING: Line = Line { damping: 1.56 / 10.65, stiffness: 1.0 / 10.65 };

/// Powers of two by which a step is shortened until it is stable, over the whole range of `f64`.
const SHORTER: [f64; 12] = [
    power_of_two(512),
    power_of_two(512),
    power_of_two(512),
    power_of_two(256),
    power_of_two(128),
    power_of_two(64),
    power_of_two(32),
    power_of_two(16),
    power_of_two(8),
    power_of_two(4),
    power_of_two(2),
    power_of_two(1),
];

/// `2⁻ⁿ`.
const fn power_of_two(n: u64) -> f64 {
    f64::from_bits((1023 - n) << 52)
}

/// Halvings of the bracket of the longest step: to 1e-12 of it.
const HALVINGS: usize = 40;

/// The limit of the steps, and what limits them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepLimit<T> {
    /// The longest stable step, s; zero where none is found.
    pub(crate) longest: T,
    /// What leaves the mass matrix positive definite, nearly singular: the direction in which it
    /// nearly vanishes is the vibration that limits the step.
    pub(crate) reduction: MassReduction<T>,
}

impl Line {
    /// What is subtracted from the mass matrix for a step.
    fn reduction<T: Scalar>(self, dt: T) -> MassReduction<T> {
        MassReduction {
            damping: T::from_f64(self.damping) * dt,
            stiffness: T::from_f64(self.stiffness) * (dt * dt),
        }
    }
}

/// The line of (S2) that a step of `dt > 0` violates; none where it is stable. `definite` decides
/// whether a reduced mass matrix is positive definite.
fn violated<T: Scalar>(
    dt: T,
    definite: &mut impl FnMut(&MassReduction<T>) -> bool,
) -> Option<Line> {
    let mut holds = |line: Line| definite(&line.reduction(dt));
    // Where this one does not hold, neither does that of any damping.
    if let Some(line) = [UNDAMPED, REAL_ROOT].into_iter().find(|line| !holds(*line)) {
        return Some(line);
    }
    let stable = holds(LITTLE_DAMPING) || holds(ANY_DAMPING);
    (!stable).then_some(LITTLE_DAMPING)
}

/// Whether a step of `dt > 0` is stable.
pub(crate) fn is_stable<T: Scalar>(
    dt: T,
    mut definite: impl FnMut(&MassReduction<T>) -> bool,
) -> bool {
    definite(&BOTH.reduction(dt)) || violated(dt, &mut definite).is_none()
}

/// The limit of the steps where that of magnitude `dt` is beyond it.
pub(crate) fn step_limit<T: Scalar>(
    dt: T,
    mut definite: impl FnMut(&MassReduction<T>) -> bool,
) -> Option<StepLimit<T>> {
    let mut unstable = dt.abs();
    if unstable == zero() || definite(&BOTH.reduction(unstable)) {
        return None;
    }
    let mut line = violated(unstable, &mut definite)?;
    for factor in SHORTER {
        let shorter = T::from_f64(factor) * unstable;
        if shorter > zero()
            && let Some(other) = violated(shorter, &mut definite)
        {
            (unstable, line) = (shorter, other);
        }
    }
    let mut stable = half::<T>() * unstable;
    if violated(stable, &mut definite).is_some() {
        return Some(StepLimit { longest: zero(), reduction: line.reduction(zero()) });
    }
    for _ in 0..HALVINGS {
        let middle = half::<T>() * (stable + unstable);
        match violated(middle, &mut definite) {
            Some(other) => (unstable, line) = (middle, other),
            None => stable = middle,
        }
    }
    let near = one::<T>() - two::<T>() * two::<T>() * T::EPSILON.sqrt();
    Some(StepLimit { longest: stable, reduction: line.reduction(near * stable) })
}

/// Numbers between a half and one and a half, each another one: a direction that is orthogonal to
/// no shape of a symmetric spacecraft.
pub(crate) fn irregular<T: Scalar>() -> impl Iterator<Item = T> {
    // The fraction of the golden ratio.
    const STEP: f64 = 0.618_033_988_749_894_9;
    core::iter::successors(Some(STEP), |last| {
        let next = last + STEP;
        Some(if next >= 1.5 { next - 1.0 } else { next })
    })
    .map(T::from_f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The longest step of `q'' + a q' + b q = 0`.
    fn longest(a: f64, b: f64) -> f64 {
        let definite = |of: &MassReduction<f64>| 1.0 - of.subtracted(a, b) > 0.0;
        step_limit(1e300, definite).map_or(f64::INFINITY, |limit| limit.longest)
    }

    /// `|R|` of the roots of `z² + a z + b = 0`, the larger one.
    fn amplification(a: f64, b: f64) -> f64 {
        let (middle, square) = (0.5 * a, 0.25 * a * a - b);
        let root = square.abs().sqrt();
        let roots = if square < 0.0 {
            [(-middle, root); 2]
        } else {
            [(root - middle, 0.0), (-root - middle, 0.0)]
        };
        let sizes = roots.map(|(x, y)| {
            let (mut re, mut im) = (1.0, 0.0);
            for divisor in [4.0, 3.0, 2.0, 1.0] {
                (re, im) = (1.0 + (re * x - im * y) / divisor, (re * y + im * x) / divisor);
            }
            re * re + im * im
        });
        sizes[0].max(sizes[1]).sqrt()
    }

    #[test]
    fn limits_are_those_of_the_method() {
        // Friction only: the real root of R(z) = 1. A spring only: sqrt 8.
        assert!((longest(10.0, 0.0) - 0.278_529_356_340_528).abs() < 1e-12);
        assert!((longest(0.0, 100.0) - 0.282_842_712_474_619).abs() < 1e-12);
        assert_eq!(longest(0.0, 0.0), f64::INFINITY);
        assert_eq!(longest(f64::NAN, 1.0), 0.0);
        assert!(longest(1e200, 1e300) > 0.0 && longest(1e-200, 1e-300) < f64::INFINITY);
    }

    #[test]
    fn every_damping_of_a_spring_is_within_nine_percent_of_its_limit() {
        for damping in 0..=400 {
            let a = f64::from(damping) * 0.01;
            let limit = longest(a, 1.0);
            let size = |dt: f64| amplification(a * dt, dt * dt);
            assert!(size(0.9999 * limit) <= 1.0, "{a}: {limit}");
            assert!(size(1.1 * limit) > 1.0, "{a}: {limit}");
        }
    }

    /// All pairs between those that fit, too: they form the convex set of a system of several joints.
    #[test]
    fn no_pair_within_the_lines_grows() {
        for i in 0..=600 {
            for k in 0..=800 {
                let (a, b) = (f64::from(i) * 0.01, f64::from(k) * 0.01);
                let definite = |of: &MassReduction<f64>| 1.0 - of.subtracted(a, b) > 0.0;
                if is_stable(1.0, definite) {
                    assert!(amplification(a, b) <= 1.0 + 1e-12, "{a} {b}");
                }
            }
        }
    }

    /// A step shorter than a stable one is stable.
    #[test]
    fn stable_steps_have_one_end() {
        for i in 0..50 {
            for k in 0..50 {
                let (a, b) = (f64::from(i) * 0.25, f64::from(k) * 0.5);
                let definite = |of: &MassReduction<f64>| 1.0 - of.subtracted(a, b) > 0.0;
                let ends = (1..200).filter(|n| {
                    let dt = f64::from(*n) * 0.01;
                    is_stable(dt, definite) && !is_stable(dt - 0.01 + 1e-300, definite)
                });
                assert_eq!(ends.count(), 0, "{a} {b}");
            }
        }
    }
}
