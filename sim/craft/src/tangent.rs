//! The devices of a scenario over dual numbers: what depends on parameters, with its derivatives by some at a time.

use precess_dynamics::{
    Accelerations, BuiltIn, Dual, Hub, Inputs, ParameterError, SolveError, Spacecraft, State,
};

/// Derivatives at a time.
pub const WIDTH: usize = 6;

/// A number with its derivatives.
pub type Number = Dual<f64, WIDTH>;

/// The devices of a scenario without platforms, over dual numbers.
pub type Set = Vec<BuiltIn<Number>>;

/// The spacecraft, prepared for evaluation.
///
/// # Errors
///
/// As [`Spacecraft::new`].
pub fn spacecraft(
    hub: &Hub<Number>,
    devices: &Set,
) -> Result<Spacecraft<Set>, Box<ParameterError<Number>>> {
    Spacecraft::new(hub, devices).map_err(Box::new)
}

/// Second derivatives of the state.
///
/// # Errors
///
/// As [`Spacecraft::accelerations`].
pub fn accelerations(
    craft: &Spacecraft<Set>,
    state: &State<Set>,
    inputs: &Inputs<Set>,
) -> Result<Accelerations<Set>, Box<SolveError<Number>>> {
    craft.accelerations(state, inputs).map_err(Box::new)
}

/// A step of RK4.
///
/// # Errors
///
/// As [`Spacecraft::step`].
pub fn step(
    craft: &Spacecraft<Set>,
    state: &State<Set>,
    inputs: &Inputs<Set>,
    length: Number,
) -> Result<State<Set>, Box<SolveError<Number>>> {
    craft.step(state, inputs, length).map_err(Box::new)
}
