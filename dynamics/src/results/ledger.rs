//! [`Ledger`]: energy, its rate, and where it comes from; the paper's named future work.
//!
//! ```text
//! dT/dt = P_external + P_hub + P_gravity + P_motors + P_springs + P_friction
//! ```
//!
//! The left side is what Newton and Euler of every body say of the accelerations, times the
//! velocities; the right side is each source's own force times the same. The two are computed
//! apart, and what is left between them is the ledger's residual: rounding, or a fault.

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::gravity::Field;
use crate::equations::load_sums::{Along, LoadSums};
use crate::model::mode::HubMode;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Real, Scalar, zero};
use crate::numbers::vec3::{Columns, components, dot, rotate, scale};
use crate::results::momentum::{About, Momentum, MotionSums};
use crate::results::structure::StructureResults;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, StructureData};

/// The energy ledger of a spacecraft at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger<T: Scalar = f64, S: StructureData = Rigid> {
    /// Kinetic energy T of hub and devices, J.
    pub kinetic: T,
    /// Potential energy in the field of gravity, J.
    pub gravity: T,
    /// Energy of the springs, J; the strain of a flexible structure among them.
    pub springs: T,
    /// `dT/dt`, W.
    pub kinetic_rate: T,
    /// Power of each source, W.
    pub power: Power<T>,
    /// `dT/dt` less all powers, W: rounding.
    pub residual: T,
    /// Sum of the magnitudes of the terms that the residual is a difference of, W. Where a term is
    /// itself small because forces cancel in it, the residual is rounding of those forces, and can
    /// exceed this.
    pub magnitude: T,
    /// Linear momentum, and angular momentum about the inertial origin, N axes.
    pub momentum: Momentum<T>,
    /// Energy and powers of the modes of a flexible structure, which are part of those above; `()` of
    /// a rigid hub.
    pub modal: S::Ledger<T>,
}

/// Power of each source on the spacecraft's motion, W; in [`Stepped::work`] the work of each source
/// during a step, J.
///
/// [`Stepped::work`]: crate::Stepped::work
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power<T = f64> {
    /// Force and torque on the hub and wrenches on bodies, with the simplified model's disturbance
    /// among them; modal forces and wrenches on mounts.
    pub external: T,
    /// What holds a prescribed hub to its motion; nothing for a free or fixed one.
    pub hub: T,
    /// Gravity, uniform part and gradient: `-dV/dt`.
    pub gravity: T,
    /// All motors, those of prescribed joints among them.
    pub motors: T,
    /// Springs; the stiffness of a flexible structure among them.
    pub springs: T,
    /// Viscous and Coulomb friction, damping of modes; not above zero: what becomes heat.
    pub friction: T,
}

impl<T: Scalar> Power<T> {
    /// No source does anything.
    pub(crate) fn none() -> Self {
        Self {
            external: zero(),
            hub: zero(),
            gravity: zero(),
            motors: zero(),
            springs: zero(),
            friction: zero(),
        }
    }

    /// `self + weight * power`, source by source.
    pub(crate) fn plus_scaled(&self, weight: T, power: &Self) -> Self {
        Self {
            external: self.external + weight * power.external,
            hub: self.hub + weight * power.hub,
            gravity: self.gravity + weight * power.gravity,
            motors: self.motors + weight * power.motors,
            springs: self.springs + weight * power.springs,
            friction: self.friction + weight * power.friction,
        }
    }

    /// Whether the power of every source is finite, and their sum.
    pub(crate) fn is_finite(&self) -> bool {
        let sources = [self.external, self.hub, self.gravity, self.motors, self.springs];
        sources.into_iter().chain([self.friction, self.total()]).all(Scalar::is_finite)
    }

    /// The sum of all sources.
    #[must_use]
    pub fn total(&self) -> T {
        self.external + self.hub + self.gravity + self.motors + self.springs + self.friction
    }
}

impl<T: Scalar, S: StructureData> Ledger<T, S> {
    /// Kinetic and potential energy, J: constant but for motors, external forces and friction.
    #[must_use]
    pub fn energy(&self) -> T {
        self.kinetic + self.gravity + self.springs
    }

    /// Rejects one that is not finite.
    pub(crate) fn finite(self) -> Result<Self, SolveError<T>> {
        let rates = [self.residual, self.magnitude, self.kinetic_rate];
        let energies = [self.kinetic, self.gravity, self.springs, self.energy()];
        let power = self.power.is_finite() && rates.into_iter().all(Scalar::is_finite);
        if power && energies.into_iter().all(Scalar::is_finite) {
            return Ok(self);
        }
        Err(SolveError::Overflow { what: if power { Quantity::Energy } else { Quantity::Power } })
    }

    /// The same ledger with the modal part of another structure.
    #[must_use]
    pub fn with_modal<R: StructureData>(self, modal: R::Ledger<T>) -> Ledger<T, R> {
        let Self { kinetic, gravity, springs, kinetic_rate, power, residual, magnitude, .. } = self;
        let momentum = self.momentum;
        Ledger {
            kinetic,
            gravity,
            springs,
            kinetic_rate,
            power,
            residual,
            magnitude,
            momentum,
            modal,
        }
    }
}

impl<D: Devices, S: StructureResults> Spacecraft<D, S> {
    /// The energy ledger for a state, its inputs and the accelerations that they give.
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`] naming an input or acceleration, [`SolveError::Overflow`],
    /// [`SolveError::Count`] and [`SolveError::ModalCount`] for a list of another length.
    pub fn ledger<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Result<Ledger<D::Scalar, S>, SolveError<D::Scalar>> {
        self.reject(state, inputs)?;
        self.reject_accelerations(state, accelerations)?;
        let ledger = S::ledger(self, state, inputs, accelerations);
        ledger.map_err(|failure| self.diagnosis(state, inputs, failure))
    }

    /// [`Self::ledger`] of a hub that does not deform, without the search for an input that is not
    /// finite: of a stage of a step, which nobody gave.
    pub(crate) fn ledger_rigid<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        modal: S::Ledger<D::Scalar>,
    ) -> Result<Ledger<D::Scalar, S>, SolveError<D::Scalar>> {
        let sums = self.sums_rigid(state);
        let MotionSums { bn, bodies, .. } = &sums;
        let field = inputs.gravity.field(bn, &state.r_b_n);
        let (_, hub, totals) =
            self.loads_and_sums(state, inputs, accelerations, field.as_ref(), &Along::Body);
        let velocity = rotate(bn, components(&state.r_b_n_dot));
        let omega = components(&state.omega);
        let of_hub = |wrench: &Wrench<D::Scalar>| wrench.power(velocity, omega);
        let joints = &totals.power;

        let uniform = field.as_ref().map_or_else(zero, |field| dot(field.at_b, bodies.linear));
        let given = Wrench { force: inputs.force, moment: inputs.torque_b };
        let held = match inputs.hub {
            HubMode::Free | HubMode::Fixed => zero(),
            HubMode::Prescribed { .. } => of_hub(&hub),
        };
        let power = Power {
            external: of_hub(&given) + of_hub(&totals.applied) + joints.applied,
            hub: held,
            gravity: uniform + of_hub(&totals.gradient) + joints.gradient,
            motors: joints.motors,
            springs: joints.springs,
            friction: joints.friction,
        };
        // Accelerations were counted in the frame that falls with the field: its power comes back.
        let kinetic_rate = of_hub(&totals.inertial) + joints.inertial + uniform;
        let hubs = [given, totals.applied, totals.gradient, totals.inertial, hub];
        let terms = hubs.iter().fold(uniform.abs(), |sum, wrench| {
            sum + dot(components(&wrench.force), velocity).abs()
                + dot(components(&wrench.moment), omega).abs()
        });
        let ledger = Ledger {
            // A sum of squares, but for the rounding of what cancels in it.
            kinetic: bodies.energy.max(zero()),
            gravity: self.potential(state, bn, field.as_ref(), &totals),
            springs: joints.stored,
            kinetic_rate,
            power,
            residual: kinetic_rate - power.total(),
            magnitude: terms + joints.magnitude,
            momentum: self.momentum_of(state, &sums, About::InertialOrigin)?,
            modal,
        };
        self.check_joints(&totals)?;
        ledger.finite()
    }

    /// Potential energy of gravity, J.
    fn potential<A>(
        &self,
        state: &State<D, A, S>,
        bn: &Columns<D::Scalar>,
        field: Option<&Field<D::Scalar>>,
        totals: &LoadSums<D::Scalar>,
    ) -> D::Scalar {
        let Some(field) = field else { return zero() };
        let per_mass = self.mass().recip();
        let [moment, _] = self.first_moment_rigid(state);
        let moment = scale(self.mass(), scale(per_mass, moment));
        let r_b = rotate(bn, components(&state.r_b_n));
        field.potential(self.mass(), moment, &totals.second_moment, r_b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn total_counts_every_source() {
        let power = Power {
            external: 1.0,
            hub: 2.0,
            gravity: 4.0,
            motors: 8.0,
            springs: 16.0,
            friction: 32.0,
        };
        assert_eq!(power.total(), 63.0);
    }
}
