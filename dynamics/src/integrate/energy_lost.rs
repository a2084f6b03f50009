//! The jump of velocities in an impulsive stop, and the energy that it takes.
//!
//! With T(v) = v·M v / 2 and a jump Δ to v', the loss is T(v' - Δ) - T(v') = T(Δ) - Δ·M v'. The
//! difference of two energies keeps no digit of a loss that is smaller than their rounding; this
//! form does. The impulses M Δ act at locked joints and a fixed hub, where v' is zero, and where
//! velocities are prescribed. So Δ·M v' is Δ·M w with w the prescribed velocities and zero for all
//! others, and vanishes if none is prescribed: then the loss is T(Δ), and no motion that goes on,
//! such as that of a fast wheel or along the orbit, costs a digit.

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::system::Solution;
use crate::integrate::structure::StructureSteps;
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{
    Columns, Vec3, add, components, neg, rotate_transposed, scale, vector, zeros,
};
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::state::State;

/// A state whose velocities have jumped.
pub(crate) struct Jumped<V> {
    /// The state after the jump.
    pub(crate) after: V,
    /// The same pose with the jumps of the velocities for velocities.
    pub(crate) jump: V,
}

/// What a jump finds.
pub(crate) type Jump<V, T> = Result<Jumped<V>, SolveError<T>>;

/// The jump of the hub's and of the joints' velocities; `bn` are the columns of the attitude's matrix.
pub(crate) fn jumped<D: Devices, A: Attitude<D::Scalar>, S: StructureSteps>(
    state: &State<D, A, S>,
    inputs: &Inputs<D, S>,
    bn: &Columns<D::Scalar>,
    hub: &Solution<D::Scalar>,
    joints: &D::Per<data::Accelerations>,
) -> Jumped<State<D, A, S>> {
    let (mut after, mut jump) = (state.clone(), state.clone());
    let of_joints = joints.values().zip(inputs.modes.values());
    let rates = after.devices.states_mut().zip(jump.devices.states_mut());
    for (([_, rate], [_, jump]), (found, mode)) in rates.zip(of_joints) {
        // At rest exactly, without rounding.
        let locked = mode == Mode::Locked;
        (*rate, *jump) = if locked { (zero(), -*rate) } else { (*rate + found, found) };
    }
    let (velocity, omega) = (components(&state.r_b_n_dot), components(&state.omega));
    let (of_velocity, of_omega) = match inputs.hub {
        HubMode::Fixed => (neg(velocity), neg(omega)),
        _ => (rotate_transposed(bn, hub.r_b_n_ddot), hub.omega_dot),
    };
    (jump.r_b_n_dot, jump.omega) = (vector(of_velocity), vector(of_omega));
    after.r_b_n_dot = vector(add(velocity, of_velocity));
    after.omega = vector(add(omega, of_omega));
    Jumped { after, jump }
}

/// T(Δ) - Δ·M w of a jump Δ and prescribed velocities w, J. `energy` is T, and `sum` the velocities
/// `a x + b y` of `(a, x)` and `(b, y)`.
///
/// Δ·M w is (T(δ + ω) - T(δ - ω)) / 2, in units of its factors, with δ and ω the velocities Δ and w
/// in units of √T: of equal energies the sum and the difference lose no digit to either.
pub(crate) fn energy_lost<T: Scalar, V>(
    (jump, prescribed): (&V, &V),
    energy: impl Fn(&V) -> Result<T, SolveError<T>>,
    sum: impl Fn((T, &V), (T, &V)) -> V,
) -> Result<T, SolveError<T>> {
    let (of_jump, of_prescribed) = (energy(jump)?, energy(prescribed)?);
    if !(of_jump > zero() && of_prescribed > zero()) {
        return Ok(of_jump);
    }
    let units = (of_jump.sqrt(), of_prescribed.sqrt());
    let (a, b) = (units.0.recip(), units.1.recip());
    let with = energy(&sum((a, jump), (b, prescribed)))?;
    let without = energy(&sum((a, jump), (-b, prescribed)))?;
    let half = T::from_f64(0.5);
    let lost = of_jump - half * (with - without) * units.0 * units.1;
    if lost.is_finite() { Ok(lost) } else { Err(SolveError::Overflow { what: Quantity::Energy }) }
}

/// The state with no velocities but those that `inputs` has prescribed.
pub(crate) fn prescribed<D: Devices, A: Clone, S: StructureSteps>(
    state: &State<D, A, S>,
    inputs: &Inputs<D, S>,
) -> State<D, A, S> {
    let mut given = state.clone();
    if !matches!(inputs.hub, HubMode::Prescribed { .. }) {
        (given.r_b_n_dot, given.omega) = (vector(zeros()), vector(zeros()));
    }
    for ([_, rate], mode) in given.devices.states_mut().zip(inputs.modes.values()) {
        if !matches!(mode, Mode::Prescribed(_)) {
            *rate = zero();
        }
    }
    S::set_rates(&mut given.modal, zero());
    given
}

/// The first state with the velocities `a x + b y`.
pub(crate) fn sum<D: Devices, A: Attitude<D::Scalar>, S: StructureSteps>(
    (a, x): (D::Scalar, &State<D, A, S>),
    (b, y): (D::Scalar, &State<D, A, S>),
) -> State<D, A, S> {
    let of = |x: Vec3<D::Scalar>, y: Vec3<D::Scalar>| vector(add(scale(a, x), scale(b, y)));
    let mut found = x.clone();
    found.r_b_n_dot = of(components(&x.r_b_n_dot), components(&y.r_b_n_dot));
    found.omega = of(components(&x.omega), components(&y.omega));
    for ([_, rate], [_, other]) in found.devices.states_mut().zip(y.devices.states()) {
        *rate = a * *rate + b * other;
    }
    S::add_rates((a, &mut found.modal), (b, &y.modal));
    found
}
