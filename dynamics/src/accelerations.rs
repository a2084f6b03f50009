//! All accelerations from state and inputs.
//!
//! Devices meet only in the hub's six equations: each is eliminated into them, they are solved, and
//! each device's own accelerations follow. The number of devices is a loop bound and nothing else.

use crate::assembly::Assembly;
use crate::attitude::Attitude;
use crate::devices::{Around, Devices, Given};
use crate::each::Each;
use crate::error::SolveError;
use crate::gravity::{Gravity, at_b};
use crate::inputs::Inputs;
use crate::mode::HubMode;
use crate::real::{Scalar, zero};
use crate::solve::Solution;
use crate::spacecraft::Spacecraft;
use crate::state::{Accelerations, State};
use crate::vec3::{Vec3, add, columns, components, extreme, finite, sub, vector, zeros};

impl<D: Devices> Spacecraft<D> {
    /// All second derivatives of the state: six numbers and one per joint, from (16), (75), (80),
    /// (101), (119).
    ///
    /// A joint that is [prescribed or locked](crate::Mode), and a hub that is
    /// [fixed or prescribed](crate::HubMode), come out as they are given; what that takes is found
    /// by [`Self::loads`].
    ///
    /// # Errors
    ///
    /// [`SolveError::Singular`] where a driven joint or the hub is left without inertia,
    /// [`SolveError::NotFinite`] naming the first input that is infinite or NaN (also one that the
    /// accelerations do not depend on, such as the position), [`SolveError::Overflow`] where the
    /// result is not finite though every input is, [`SolveError::LockedJointMoves`] and
    /// [`SolveError::FixedHubMoves`] where what is locked moves, [`SolveError::NotDriven`] where a
    /// mode asks of a joint what its kind has not.
    pub fn accelerations<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
    ) -> Result<Accelerations<D>, SolveError<D::Scalar>> {
        if !sound(state, inputs) {
            return Err(self.diagnosis(state, inputs, SolveError::Overflow));
        }
        self.solve(state, inputs).map_err(|failure| self.diagnosis(state, inputs, failure))
    }

    /// [`Self::accelerations`] without the search for a culprit.
    pub(crate) fn solve<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
    ) -> Result<Accelerations<D>, SolveError<D::Scalar>> {
        check_fixed(state, inputs)?;
        let (around, at_b) = surroundings(state, inputs);
        let mut assembly = self.assembly(inputs);
        let (given, mut scratch) = (Given::of(inputs), D::scratch(&self.devices));
        self.eliminate(state, given, &around, &mut assembly, &mut scratch)?;
        let hub = self.hub_moves(inputs, &around, &mut assembly, at_b)?;
        let devices = self.back_substitute(&scratch, &hub)?;
        with_devices(inputs, &hub, at_b, devices)
    }

    /// The hub's own system, before any device is asked.
    #[inline]
    pub(crate) fn assembly(&self, inputs: &Inputs<D>) -> Assembly<D::Scalar> {
        let (force, moment) = (components(&inputs.force), components(&inputs.torque_b));
        Assembly::new(&self.body, force, moment)
    }

    /// The hub's accelerations once every device is eliminated, in the frame that falls with the
    /// field at B, where there is no uniform one.
    pub(crate) fn hub_moves(
        &self,
        inputs: &Inputs<D>,
        around: &Around<D::Scalar>,
        assembly: &mut Assembly<D::Scalar>,
        at_b: Vec3<D::Scalar>,
    ) -> Result<Solution<D::Scalar>, SolveError<D::Scalar>> {
        if let Some(central) = around.central {
            let second = self.hub.second_moment();
            let (force, moment) = central.wrench(self.hub.first_moment, &second);
            let whole = central.third_order(&assembly.second_moment.plus(second));
            assembly.push(add(force, whole), moment);
        }
        let hub = match &inputs.hub {
            HubMode::Free => {
                assembly.system(around.omega).solve().map_err(|small| small.of(None, None))?
            }
            HubMode::Fixed => Solution { r_b_n_ddot: sub(zeros(), at_b), omega_dot: zeros() },
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => Solution {
                r_b_n_ddot: sub(components(r_b_n_ddot), at_b),
                omega_dot: components(omega_dot),
            },
        };
        if hub.is_finite() { Ok(hub) } else { Err(SolveError::Overflow) }
    }

    /// Eliminates every device, keeps what back substitution needs, adds to the hub.
    pub(crate) fn eliminate<A>(
        &self,
        state: &State<D, A>,
        given: Given<'_, D>,
        around: &Around<D::Scalar>,
        assembly: &mut Assembly<D::Scalar>,
        scratch: &mut D::Scratch,
    ) -> Result<(), SolveError<D::Scalar>> {
        D::fits(&self.devices, &state.devices, Some(given), None)?;
        D::eliminate(&self.devices, &state.devices, given, around, assembly, scratch, &mut 0)
    }

    /// The accelerations of every device's joints, checked finite.
    pub(crate) fn back_substitute(
        &self,
        scratch: &D::Scratch,
        hub: &Solution<D::Scalar>,
    ) -> Result<D::Accelerations, SolveError<D::Scalar>> {
        let mut found = D::no_accelerations_for(&self.devices);
        D::back_substitute(&self.devices, scratch, hub, &mut found);
        if found.values().all(Scalar::is_finite) { Ok(found) } else { Err(SolveError::Overflow) }
    }

    /// What to report for a failed evaluation: an input that is not finite explains everything else,
    /// and a pivot that is not finite is an overflow, not a singularity.
    #[cold]
    pub(crate) fn diagnosis<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        failure: SolveError<D::Scalar>,
    ) -> SolveError<D::Scalar> {
        if matches!(failure, SolveError::Count { .. }) {
            return failure;
        }
        if let Err(culprit) = self.refuse(state, inputs) {
            return culprit;
        }
        match failure {
            _ if matches!(inputs.gravity, Gravity::Central { .. })
                && extreme(components(&state.r_b_n)) == zero() =>
            {
                SolveError::AtCentre
            }
            SolveError::Singular { pivot, bound, .. }
                if !(pivot.is_finite() && bound.is_finite()) =>
            {
                SolveError::Overflow
            }
            failure => failure,
        }
    }
}

/// What the devices feel, and the field at B. Apart from the hub's system: a pair of both is large,
/// and was copied where a processor has no wide registers.
#[inline]
pub(crate) fn surroundings<D: Devices, A: Attitude<D::Scalar>>(
    state: &State<D, A>,
    inputs: &Inputs<D>,
) -> (Around<D::Scalar>, Vec3<D::Scalar>) {
    let field = match &inputs.gravity {
        Gravity::None => None,
        gravity => gravity.field(&columns(&state.attitude.dcm()), &state.r_b_n),
    };
    let at_b = at_b(field.as_ref());
    let central = field.and_then(|field| field.central);
    (Around { omega: components(&state.omega), central, impulse: false }, at_b)
}

/// All accelerations, the hub's no longer relative to the frame that falls with it.
pub(crate) fn with_devices<D: Devices>(
    inputs: &Inputs<D>,
    hub: &Solution<D::Scalar>,
    at_b: Vec3<D::Scalar>,
    devices: D::Accelerations,
) -> Result<Accelerations<D>, SolveError<D::Scalar>> {
    let r_b_n_ddot = match &inputs.hub {
        HubMode::Free => vector(add(hub.r_b_n_ddot, at_b)),
        HubMode::Fixed => vector(zeros()),
        HubMode::Prescribed { r_b_n_ddot, .. } => *r_b_n_ddot,
    };
    if !finite(components(&r_b_n_ddot)) {
        return Err(SolveError::Overflow);
    }
    Ok(Accelerations { r_b_n_ddot, omega_dot: vector(hub.omega_dot), devices })
}

/// Refuses a fixed hub that moves.
pub(crate) fn check_fixed<D: Devices, A>(
    state: &State<D, A>,
    inputs: &Inputs<D>,
) -> Result<(), SolveError<D::Scalar>> {
    if inputs.hub != HubMode::Fixed {
        return Ok(());
    }
    let [x, y, z] = components(&state.r_b_n_dot);
    let [p, q, r] = components(&state.omega);
    let value = extreme([x, y, z, p, q, r]);
    if value == zero() { Ok(()) } else { Err(SolveError::FixedHubMoves { value }) }
}

/// Whether what the accelerations may not depend on is finite: the position, forces on a hub that
/// is held, motors of joints that are. All else shows in the result.
pub(crate) fn sound<D: Devices, A: Attitude<D::Scalar>>(
    state: &State<D, A>,
    inputs: &Inputs<D>,
) -> bool {
    let vectors = [&state.r_b_n, &state.r_b_n_dot, &inputs.force, &inputs.torque_b];
    vectors.into_iter().all(|v| finite(components(v)))
        && state.attitude.is_valid()
        && inputs.motors.values().all(Scalar::is_finite)
        && inputs.bodies.iter().flat_map(Each::values).all(|wrench| wrench.is_finite())
}
