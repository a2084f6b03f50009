//! [`Passive`]: spring, damper and dry friction of a joint.

use crate::numbers::real::{Scalar, half, reciprocal_in_two, zero};

/// Spring, damper and dry friction of one joint, which act beside its motor; all zero in a free
/// one.
///
/// ```text
/// u = -k (q - q_0) - c q' - u_c q' / sqrt(q'^2 + q_c'^2)
/// ```
///
/// acts in addition to the motor, on the child body and reversed on the parent body. The last term
/// is smoothed Coulomb friction: `u_c` well above the rate `q_c'`, a stiff damper `u_c / q_c'`
/// below. It never sticks: a joint that must not move is [locked](crate::Mode::Locked). In runs of the desktop
/// tool a joint sticks by the key `static_friction` of a scenario.
///
/// A step of Runge-Kutta's method must resolve what is stiff. With `J` the inertia that the joint
/// moves, on the whole spacecraft and with the springs of other joints, `dt` is at most
/// `2.785 J / c` for a damper, `2.828 sqrt(J / k)` for a spring, and `2.785 J q_c' / u_c` for dry
/// friction where the joint comes to rest or reverses: at a rate of 1e-4 rad/s, a torque of
/// 1e-3 N m and 1e-3 kg m², 0.28 ms.
/// [`Spacecraft::step`](crate::Spacecraft::step) rejects a longer one with
/// [`SolveError::Unstable`](crate::SolveError::Unstable), which has the longest stable one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passive<T = f64> {
    /// `k`, N m/rad; of a sliding joint N/m. Not negative.
    pub stiffness: T,
    /// `q_0`, the coordinate at which the spring is at rest, rad or m.
    pub rest: T,
    /// `c`, viscous friction, N m s/rad or N s/m. Not negative.
    pub viscous: T,
    /// `u_c`, Coulomb friction, N m or N. Not negative.
    pub coulomb: T,
    /// `q_c'`, the rate below which Coulomb friction fades, rad/s or m/s; above zero unless
    /// `coulomb` is zero.
    pub coulomb_rate: T,
}

impl<T: Copy> Passive<T> {
    /// Spring, damper and friction with each number changed.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "lanes reach wide instructions only where inlined")]
    #[must_use]
    pub fn map<U>(&self, mut change: impl FnMut(T) -> U) -> Passive<U> {
        Passive {
            stiffness: change(self.stiffness),
            rest: change(self.rest),
            viscous: change(self.viscous),
            coulomb: change(self.coulomb),
            coulomb_rate: change(self.coulomb_rate),
        }
    }
}

impl<T: Scalar> Passive<T> {
    /// A free joint.
    #[must_use]
    pub fn none() -> Self {
        Self {
            stiffness: zero(),
            rest: zero(),
            viscous: zero(),
            coulomb: zero(),
            coulomb_rate: zero(),
        }
    }

    /// Whether the joint is free, also of what a parameter's derivative adds.
    pub(crate) fn is_none(&self) -> bool {
        self.named().into_iter().all(|(_, value)| value.vanishes())
    }

    /// Only a spring and a damper, at rest at zero.
    #[must_use]
    pub fn spring(stiffness: T, viscous: T) -> Self {
        Self { stiffness, viscous, ..Self::none() }
    }

    /// Only viscous and Coulomb friction.
    #[must_use]
    pub fn friction(viscous: T, coulomb: T, coulomb_rate: T) -> Self {
        Self { viscous, coulomb, coulomb_rate, ..Self::none() }
    }

    /// Torque or force of the spring.
    pub(crate) fn of_spring(&self, coordinate: T) -> T {
        -(self.stiffness * (coordinate - self.rest))
    }

    /// Torque or force of friction.
    pub(crate) fn of_friction(&self, rate: T) -> T {
        let viscous = -(self.viscous * rate);
        if self.coulomb.vanishes() {
            return viscous;
        }
        // By the larger of the two rates, so that neither square vanishes or overflows.
        let (first, second) = reciprocal_in_two(rate.abs().max(self.coulomb_rate));
        let (q, q_c) = (rate * first * second, self.coulomb_rate * first * second);
        viscous - self.coulomb * q * (q * q + q_c * q_c).sqrt().recip()
    }

    /// By how much friction grows with the rate: `c + u_c q_c'² / (q'² + q_c'²)^(3/2)`, N m s/rad.
    pub(crate) fn damping(&self, rate: T) -> T {
        if self.coulomb.vanishes() {
            return self.viscous;
        }
        let (first, second) = reciprocal_in_two(rate.abs().max(self.coulomb_rate));
        let (q, q_c) = (rate * first * second, self.coulomb_rate * first * second);
        let share = (q * q + q_c * q_c).recip();
        self.viscous + self.coulomb * first * second * (q_c * q_c * share * share.sqrt())
    }

    /// How torque or force of spring and friction change where these parameters do, at a coordinate and a rate.
    #[cfg(feature = "alloc")]
    pub(crate) fn torque_by(&self, [coordinate, rate]: [T; 2], change: &Self) -> T {
        let mut sum = zero();
        // Product by product: what does not change may meet an infinite one.
        let mut add = |change: T, factor: T| {
            if !change.vanishes() {
                sum = sum + change * factor;
            }
        };
        add(change.stiffness, self.rest - coordinate);
        add(change.rest, self.stiffness);
        add(change.viscous, -rate);
        let is_dry = !self.coulomb.vanishes();
        if !change.coulomb.vanishes() || (is_dry && !change.coulomb_rate.vanishes()) {
            let (first, second) = reciprocal_in_two(rate.abs().max(self.coulomb_rate));
            let (q, q_c) = (rate * first * second, self.coulomb_rate * first * second);
            let slope = q * (q * q + q_c * q_c).sqrt().recip();
            add(change.coulomb, -slope);
            let share = q_c * (q * q + q_c * q_c).recip();
            add(change.coulomb_rate, self.coulomb * first * second * slope * share);
        }
        sum
    }

    /// Energy of the spring, J.
    pub(crate) fn potential(&self, coordinate: T) -> T {
        let stretch = coordinate - self.rest;
        half::<T>() * self.stiffness * stretch * stretch
    }

    /// The parameters by name: what must be finite.
    pub(crate) fn named(&self) -> [(&'static str, T); 5] {
        [
            ("stiffness", self.stiffness),
            ("rest", self.rest),
            ("viscous", self.viscous),
            ("coulomb", self.coulomb),
            ("coulomb_rate", self.coulomb_rate),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spring_pulls_back_and_stores() {
        let spring = Passive { rest: 1.0, ..Passive::spring(4.0, 0.0) };
        assert_eq!(spring.of_spring(3.0), -8.0);
        assert_eq!(spring.potential(3.0), 8.0);
    }

    #[test]
    fn coulomb_friction_is_smooth_and_saturates() {
        let dry = Passive::friction(0.0, 2.0, 1e-3);
        assert_eq!(dry.of_friction(0.0), 0.0);
        assert!((dry.of_friction(1.0) + 2.0).abs() < 2e-6);
        assert!((dry.of_friction(-1.0) - 2.0).abs() < 2e-6);
        let sharp = Passive::friction(0.0, 2.0, f64::MIN_POSITIVE);
        assert_eq!((sharp.of_friction(0.0), sharp.of_friction(1e-3)), (0.0, -2.0));
        assert_eq!(sharp.of_friction(1e160), -2.0);
        // The slope of friction, by differences and at rest.
        let slope = (dry.of_friction(2e-3 - 1e-9) - dry.of_friction(2e-3 + 1e-9)) / 2e-9;
        assert!((dry.damping(2e-3) / slope - 1.0).abs() < 1e-6);
        assert_eq!(Passive { viscous: 3.0, ..dry }.damping(0.0), 2003.0);
        let viscous = Passive::friction(0.5, 0.0, 0.0);
        assert_eq!(viscous.of_friction(3.0), -1.5);
    }

    #[cfg(feature = "alloc")]
    #[test]
    fn torque_changes_with_parameters_as_differences_do() {
        let all = Passive { rest: 0.3, stiffness: 4.0, ..Passive::friction(0.7, 2.0, 0.5) };
        let state = [1.1, -0.8];
        let torque = |of: &Passive| of.of_spring(state[0]) + of.of_friction(state[1]);
        for name in Passive::<f64>::PARAMETERS.iter().map(|(name, _)| name) {
            let [mut up, mut down, mut change] = [all, all, Passive::none()];
            *up.parameter_mut(name).unwrap() += 1e-5;
            *down.parameter_mut(name).unwrap() -= 1e-5;
            *change.parameter_mut(name).unwrap() = 1.0;
            let expected = (torque(&up) - torque(&down)) / 2e-5;
            let found = all.torque_by(state, &change);
            assert!((found - expected).abs() < 1e-9, "{name}: {found} is not {expected}");
        }
        // Where friction is not dry, the rate below which it fades does nothing.
        let by_rate = Passive { coulomb_rate: 1.0, ..Passive::none() };
        assert_eq!(Passive::friction(0.7, 0.0, 0.0).torque_by([0.0; 2], &by_rate), 0.0);
    }
}
