//! The longest step at which Runge-Kutta's method of fourth order is stable with the springs,
//! dampers and dry friction of the joints.
//!
//! A joint with the responses `a = c m`, 1/s, and `b = k m`, 1/s², of its damping c and stiffness k
//! (m its acceleration for a unit torque) moves as `q'' + a q' + b q = 0`. A step multiplies its
//! modes by `R(z) = 1 + z + z²/2 + z³/6 + z⁴/24` with `z = λ dt`, `λ² + a λ + b = 0`, and is stable
//! while `|R(z)| <= 1`: up to 2.785 on the real axis (friction), to 2.828 on the imaginary one
//! (springs).
//!
//! Two estimates of the responses. [`Stiffness`] costs some operations per joint and comes from
//! the pivots of an evaluation; a step that is far below the limit by it is accepted. Otherwise the
//! responses are computed, by one impulsive evaluation per joint.

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::SolveError;
use crate::equations::stiffness::Stiffness;
use crate::equations::system::Solution;
use crate::model::mode::HubMode;
use crate::model::passive::Passive;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, half, one, zero};
use crate::numbers::vec3::zeros;
use crate::sets::devices::{Devices, Passives};
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// Largest magnitude of `λ dt` tried; RK4 is unstable there in every direction.
const BEYOND: f64 = 3.5;

/// How a joint's rate has gone during a step: where it began, and its smallest magnitude, zero once
/// it has changed its sign.
type Slowest<T> = [T; 2];

/// The same after another stage.
fn pass<T: Scalar>([first, smallest]: Slowest<T>, rate: T) -> Slowest<T> {
    let size = if rate * first < zero() { zero() } else { rate.abs() };
    [first, if size < smallest { size } else { smallest }]
}

/// Whether friction has to be resolved near rest: the joint has come to rest, or reversed.
fn rests<T: Scalar>([first, smallest]: Slowest<T>, passive: &Passive<T>) -> bool {
    first != zero() && smallest == zero() && passive.coulomb > zero()
}

/// Stiffness of springs and friction during a step.
pub(crate) struct PassiveStep<D: Devices> {
    /// Of the present stage.
    stiffness: Stiffness<D::Scalar>,
    /// Of those before it.
    largest: Stiffness<D::Scalar>,
    slowest: D::Per<data::PerJoint<Slowest<D::Scalar>>>,
}

impl<D: Devices> PassiveStep<D> {
    /// At the start.
    pub(crate) fn new<A>(craft: &Spacecraft<D>, start: &State<D, A>) -> Self {
        let mut slowest = D::new_data(&craft.devices, &data::PerJoint([zero(); 2]));
        for (slowest, [_, rate]) in slowest.values_mut().zip(start.devices.states()) {
            *slowest = [rate, rate.abs()];
        }
        let none = Stiffness::none(zero());
        Self { stiffness: none, largest: none, slowest }
    }

    /// Before an evaluation: where it leaves its stiffness.
    pub(crate) fn stage<A>(&mut self, stage: &State<D, A>) -> &mut Stiffness<D::Scalar> {
        self.largest = self.largest.max(self.stiffness);
        self.pass(stage);
        &mut self.stiffness
    }

    fn pass<A>(&mut self, stage: &State<D, A>) {
        for (slowest, [_, rate]) in self.slowest.values_mut().zip(stage.devices.states()) {
            *slowest = pass(*slowest, rate);
        }
    }

    /// Rejects a step that was unstable.
    pub(crate) fn check<A: Attitude<D::Scalar>>(
        mut self,
        craft: &Spacecraft<D>,
        start: &State<D, A>,
        next: &State<D, A>,
        inputs: &Inputs<D>,
        dt: D::Scalar,
    ) -> Result<(), SolveError<D::Scalar>> {
        self.stage(next);
        let mut joints = self.slowest.values().zip(D::list::<Passives>(&craft.devices));
        let rests = joints.any(|(slowest, passive)| rests(slowest, &passive));
        if self.largest.accepts(dt) && !rests {
            return Ok(());
        }
        craft.check_stability(start, inputs, dt, &self.slowest)
    }
}

impl<D: Devices> Spacecraft<D> {
    /// Rejects a step that spring, damper or friction of a joint makes unstable.
    #[cold]
    fn check_stability<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        dt: D::Scalar,
        slowest: &D::Per<data::PerJoint<Slowest<D::Scalar>>>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let mut coefficients =
            D::new_data(&self.devices, &data::PerJoint([zero::<D::Scalar>(); 2]));
        let joints = D::list::<Passives>(&self.devices).zip(slowest.values());
        for (entry, (passive, [_, slowest])) in coefficients.values_mut().zip(joints) {
            *entry = [passive.damping(slowest), passive.stiffness];
        }
        for (joint, ([c, k], (device, info))) in
            coefficients.values().zip(self.joints()).enumerate()
        {
            if c == zero() && k == zero() {
                continue;
            }
            let column = self.response_to(state, inputs, joint)?;
            let each = || coefficients.values().zip(column.values());
            let a = each().fold(zero(), |sum, ([c, _], m)| sum + c * m.abs());
            let b = each().fold(zero(), |sum, ([_, k], m)| sum + k * m.abs());
            let longest = longest(a, b);
            if dt.abs() > longest {
                return Err(SolveError::Unstable { device, joint: info.body, dt, longest });
            }
        }
        Ok(())
    }

    /// Accelerations of all joints for a unit torque at one of them, nothing else acting.
    fn response_to<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        joint: usize,
    ) -> Result<D::Per<data::Accelerations>, SolveError<D::Scalar>> {
        let still = zeros();
        let mut at_rest = state.clone();
        at_rest.devices.states_mut().for_each(|[_, rate]| *rate = zero());
        let mut motors = D::new_data(&self.devices, &data::Motors);
        if let Some(torque) = motors.values_mut().nth(joint) {
            *torque = one();
        }
        let mut scratch = D::new_data(&self.devices, &data::Gains);
        let assembly = self.eliminate_for_impulses(&at_rest, &motors, inputs, &mut scratch)?;
        let hub = match inputs.hub {
            HubMode::Free => assembly.solve(still, &self.body)?,
            HubMode::Fixed | HubMode::Prescribed { .. } => {
                Solution { r_b_n_ddot: still, omega_dot: still }
            }
        };
        self.back_substitute(&scratch, &hub)
    }
}

/// The longest stable step of `q'' + a q' + b q = 0`, s; infinite where both are zero, zero for
/// NaN.
fn longest<T: Scalar>(a: T, b: T) -> T {
    // λ = -a/2 ± sqrt(a²/4 - b), over a size that keeps the squares in range.
    let size = a.max(b.sqrt());
    if !(size.is_finite() && b.is_finite()) {
        return zero();
    }
    if size == zero() {
        return size.recip();
    }
    let (a, b) = (a * size.recip(), b * size.recip() * size.recip());
    let middle = half::<T>() * a;
    let square = middle * middle - b;
    let [x, y] = if square < zero() {
        [-middle, (-square).sqrt()]
    } else {
        [-(middle + square.sqrt()), zero()]
    };
    let (mut stable, mut unstable) =
        (zero::<T>(), T::from_f64(BEYOND) * (x * x + y * y).sqrt().recip());
    // The region is star-shaped about the origin: one crossing, halved to the last bit of an f64.
    for _ in 0..54 {
        let dt = half::<T>() * (stable + unstable);
        if amplification(x * dt, y * dt) <= one() {
            stable = dt;
        } else {
            unstable = dt;
        }
    }
    stable * size.recip()
}

/// `|R(x + i y)|²`.
fn amplification<T: Scalar>(x: T, y: T) -> T {
    let (mut re, mut im) = (one::<T>(), zero::<T>());
    for divisor in [4.0, 3.0, 2.0, 1.0] {
        let by = T::from_f64(divisor).recip();
        (re, im) = (one::<T>() + (re * x - im * y) * by, (re * y + im * x) * by);
    }
    re * re + im * im
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_of_the_method() {
        // Friction only: the real root of R(z) = 1. A spring only: sqrt 8.
        assert!((longest(10.0, 0.0) - 0.278_529_356_340_528).abs() < 1e-12);
        assert!((longest(0.0, 100.0) - 0.282_842_712_474_619).abs() < 1e-6);
        // Critical damping has both roots at half the damping.
        assert!((longest(2.0, 1.0) - 2.785_293_563_405_28).abs() < 1e-6);
        assert_eq!(longest(0.0, 0.0), f64::INFINITY);
        assert_eq!(longest(f64::NAN, 1.0), 0.0);
        assert!(longest(1e200, 1e300) > 0.0 && longest(1e-200, 1e-300) < f64::INFINITY);
    }

    #[test]
    fn every_damping_of_a_spring_has_a_limit_between_two_and_a_half_and_three() {
        for damping in 0..200 {
            let limit = longest(f64::from(damping) * 0.01, 1.0);
            assert!((2.5..3.0).contains(&limit), "{damping}: {limit}");
        }
    }

    #[test]
    fn smallest_rate_is_zero_where_the_joint_reversed() {
        let slower = pass([2.0, 2.0], 1.0);
        assert_eq!(slower, [2.0, 1.0]);
        assert!(!rests(slower, &Passive::friction(0.0, 1.0, 1.0)));
        let reversed = pass(slower, -3.0);
        assert_eq!(reversed, [2.0, 0.0]);
        assert!(rests(reversed, &Passive::friction(0.0, 1.0, 1.0)));
        assert!(!rests(reversed, &Passive::friction(1.0, 0.0, 0.0)));
    }
}
