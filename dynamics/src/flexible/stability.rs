//! The longest step at which Runge-Kutta's method of fourth order is stable with the modes.
//!
//! The fastest vibration of structure and devices is faster than the fastest mode where a free hub
//! moves with clamped modes, and slower where devices stand on it. It is found once, undeformed and
//! at rest with the joints at zero, by power iteration: `x <- M⁻¹ K x`, whose Rayleigh quotients
//! in the stiffness K rise to the square of the highest frequency.

use crate::attitude::quaternion::Quaternion;
use crate::equations::error::SolveError;
use crate::flexible::inputs::FlexibleInputs;
use crate::flexible::spacecraft::FlexibleSpacecraft;
use crate::flexible::state::FlexibleState;
use crate::flexible::storage::ModalStorage;
use crate::model::mode::HubMode;
use crate::numbers::real::{Real, Scalar, one, two, zero};
use crate::sets::devices::Devices;

/// Iterations: two frequencies that differ by a tenth are told apart to a per mille, closer ones
/// need not be.
const ITERATIONS: usize = 40;

/// The method is stable with an undamped vibration up to `w dt` of `sqrt(8)`, with a critically
/// damped one up to 2.785; the smaller.
const STABLE: f64 = 2.785;

/// Fastest rates on a free hub and on one that is held, 1/s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fastest<T> {
    pub(crate) free: T,
    pub(crate) held: T,
}

impl<D: Devices, S: ModalStorage> FlexibleSpacecraft<D, S> {
    /// The fastest rates: of vibration, and of damping above the critical one, for damping ratios.
    pub(crate) fn fastest(&self, ratios: &[D::Scalar]) -> Fastest<D::Scalar> {
        let mut over = one::<D::Scalar>();
        let mut alone = zero::<D::Scalar>();
        for ([stiffness, _], ratio) in self.passive.as_ref().iter().zip(ratios) {
            let frequency = stiffness.sqrt();
            alone = alone.max(frequency);
            if frequency > zero() {
                over = over.max(two::<D::Scalar>() * *ratio);
            }
        }
        let rate = |hub| over * self.vibration(hub).unwrap_or(alone);
        Fastest { free: rate(HubMode::Free), held: rate(HubMode::Fixed) }
    }

    /// The highest frequency, rad/s; none where the equations at rest have no solution.
    fn vibration(&self, hub: HubMode<D::Scalar>) -> Option<D::Scalar> {
        let state = FlexibleState::<D, S, Quaternion<D::Scalar>>::at_rest_for(self);
        let mut inputs = FlexibleInputs::none_for(self);
        inputs.rigid.hub = hub;
        // What joints with a spring that is not at rest do.
        let still = self.accelerations(&state, &inputs).ok()?.eta_ddot;
        let mut shape = S::modes(self.modes(), &one());
        let mut square = zero();
        for _ in 0..ITERATIONS {
            let size = self.strain_of(shape.as_ref());
            if size <= zero() {
                return Some(zero());
            }
            let over = size.sqrt().recip();
            let scaled = shape.as_ref().iter().zip(self.passive.as_ref());
            for (force, (x, [stiffness, _])) in inputs.modal.as_mut().iter_mut().zip(scaled) {
                *force = *stiffness * (*x * over);
            }
            shape = self.accelerations(&state, &inputs).ok()?.eta_ddot;
            for (x, still) in shape.as_mut().iter_mut().zip(still.as_ref()) {
                *x = *x - *still;
            }
            square = self.strain_of(shape.as_ref()).sqrt();
        }
        Some(square.sqrt()).filter(|frequency| frequency.is_finite())
    }

    /// Twice the strain energy of a shape.
    fn strain_of(&self, shape: &[D::Scalar]) -> D::Scalar {
        let terms = shape.iter().zip(self.passive.as_ref());
        terms.fold(zero(), |sum, (x, [stiffness, _])| sum + *stiffness * *x * *x)
    }

    /// Rejects a step that is too long for the fastest vibration.
    pub(crate) fn check_modes_of_step(
        &self,
        inputs: &FlexibleInputs<D, S>,
        dt: D::Scalar,
    ) -> Result<(), SolveError<D::Scalar>> {
        let rate = match inputs.rigid.hub {
            HubMode::Free => self.fastest.free,
            HubMode::Fixed | HubMode::Prescribed { .. } => self.fastest.held,
        };
        let stable = D::Scalar::from_f64(STABLE);
        if rate * dt.abs() <= stable {
            return Ok(());
        }
        Err(SolveError::UnstableModes { dt, longest: stable * rate.recip() })
    }
}
