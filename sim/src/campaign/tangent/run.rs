//! A run over dual numbers: samples of the state and its accelerations with their derivatives.

use precess_dynamics::kind::Each;
use precess_dynamics::{Attitude as _, HubMode, Inputs, JointStates, Spacecraft, State};

use precess_craft::tangent::{self, Number, Set, WIDTH};

use super::parameters::{Parts, parts};
use crate::record::Header;
use crate::record::columns::Quantity;
use crate::scenario::{IntegratorChoice, Scenario};

/// Steps of a turn of the fastest joint, where the scenario has no fixed step.
const PER_TURN: f64 = 100.0;
/// Numbers that are kept, with their derivatives: 560 MB.
const NUMBERS_MAX: usize = 10_000_000;
/// Steps of a run, at most.
const STEPS_MAX: f64 = 1e8;
/// Times nearer than this share of a step are one.
const NEAR: f64 = 1e-9;

/// Samples: of each its time and a number for each column; NaN of a quantity that is not of the state.
pub(super) type Samples = Vec<(f64, Vec<Number>)>;

/// Runs a scenario with the derivatives of its numbers by up to six keys.
pub(super) fn samples(
    scenario: &Scenario,
    header: &Header,
    slopes: &[Vec<f64>],
) -> Result<Samples, String> {
    let mut next = 0;
    let of = parts(scenario, &mut |value| {
        let mut number = Number::constant(value);
        for (key, slopes) in slopes.iter().enumerate().take(WIDTH) {
            number.add_derivative(key, slopes.get(next).copied().unwrap_or(0.0));
        }
        next += 1;
        number
    })?;
    let (craft, mut state, inputs) = start(scenario, of)?;
    let (duration, rate) = (scenario.settings.duration, scenario.output.rate);
    let step = match scenario.settings.integrator {
        IntegratorChoice::Rk4 { step } => step,
        IntegratorChoice::Dop853 { .. } => {
            let rates = scenario.initial.devices.states().map(|[_, rate]| rate.abs());
            let fastest = rates.fold(scenario.initial.omega.norm(), f64::max);
            let longest = std::f64::consts::TAU / fastest / PER_TURN;
            let parts = (1.0 / (rate * longest)).ceil().max(1.0);
            1.0 / (rate * parts)
        }
    };
    let count = duration * rate;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
    if duration / step > STEPS_MAX || count as usize * header.columns.len() > NUMBERS_MAX {
        return Err("the run is too long to be kept with its derivatives; shorten it".to_owned());
    }
    let of = (&craft, &inputs);
    let mut kept = Samples::new();
    let mut sample = 0_u32;
    let mut steps = 0_u32;
    loop {
        let time = f64::from(steps) * step;
        let after = (f64::from(steps + 1) * step).min(duration);
        loop {
            let at = f64::from(sample) / rate;
            if at > duration - NEAR * step || at >= after - NEAR * step {
                break;
            }
            if (at - time).abs() <= NEAR * step {
                kept.push((at, row(header, of, &state, at)?));
            } else {
                let within = tangent::step(&craft, &state, &inputs, Number::constant(at - time));
                let within = within.map_err(|error| error.to_string())?;
                kept.push((at, row(header, of, &within, at)?));
            }
            sample += 1;
        }
        let length = Number::constant(after - time);
        state =
            tangent::step(&craft, &state, &inputs, length).map_err(|error| error.to_string())?;
        steps += 1;
        if after >= duration - NEAR * step {
            kept.push((duration, row(header, of, &state, duration)?));
            return Ok(kept);
        }
    }
}

/// Spacecraft, initial state and inputs.
#[expect(clippy::type_complexity, reason = "three things of one set")]
fn start(
    scenario: &Scenario,
    of: Parts<Number>,
) -> Result<(Spacecraft<Set>, State<Set>, Inputs<Set>), String> {
    let set: Set = of.devices;
    let craft = tangent::spacecraft(&of.hub, &set).map_err(|error| error.to_string())?;
    let mut state: State<Set> = State::at_rest_for(&craft);
    (state.r_b_n, state.r_b_n_dot) = (of.position, of.velocity);
    (state.attitude, state.omega) = (of.attitude, of.omega);
    for (to, from) in state.devices.states_mut().zip(&of.joints) {
        (*to[0], *to[1]) = (from[0], from[1]);
    }
    let mut inputs = Inputs::none_for(&craft);
    let driven: Vec<bool> = craft.joints().map(|(_, info)| info.driven).collect();
    let motors = inputs.motors.values_mut().zip(&of.motors).zip(&driven);
    motors.filter(|(_, driven)| **driven).for_each(|((to, from), _)| *to = *from);
    let modes = inputs.modes.values_mut().zip(&of.modes).zip(&driven);
    modes.filter(|(_, driven)| **driven).for_each(|((to, from), _)| *to = *from);
    inputs.gravity = of.gravity;
    if matches!(scenario.hub_mode, HubMode::Fixed) {
        inputs.hub = HubMode::Fixed;
    }
    Ok((craft, state, inputs))
}

/// A number for each column.
fn row(
    header: &Header,
    (craft, inputs): (&Spacecraft<Set>, &Inputs<Set>),
    state: &State<Set>,
    time: f64,
) -> Result<Vec<Number>, String> {
    let accelerates = header.columns.iter().any(|column| column.quantity.is_acceleration());
    let found = if accelerates {
        Some(tangent::accelerations(craft, state, inputs).map_err(|error| error.to_string())?)
    } else {
        None
    };
    // The solver's is expressed in B, the column in N.
    let of_hub = found.as_ref().map(|of| {
        let bn = state.attitude.dcm();
        let along =
            |axis: usize| (0..3).map(|k| bn[(k, axis)] * of.r_b_n_ddot[k]).reduce(|a, b| a + b);
        [along(0), along(1), along(2)]
    });
    let joint = |joint: usize| state.devices.states().nth(joint);
    let of = |quantity: Quantity| match quantity {
        Quantity::Time => Some(Number::constant(time)),
        Quantity::Position(axis) => state.r_b_n.get(axis).copied(),
        Quantity::Velocity(axis) => state.r_b_n_dot.get(axis).copied(),
        Quantity::Omega(axis) => state.omega.get(axis).copied(),
        Quantity::Coordinate(index) => joint(index).map(|[coordinate, _]| coordinate),
        Quantity::Rate(index) => joint(index).map(|[_, rate]| rate),
        Quantity::HubAcceleration(axis) => of_hub.as_ref()?.get(axis).copied()?,
        Quantity::OmegaDot(axis) => found.as_ref()?.omega_dot.get(axis).copied(),
        Quantity::JointAcceleration(index) => found.as_ref()?.devices.values().nth(index),
        _ => None,
    };
    let number = |column: &crate::record::Column| {
        of(column.quantity).unwrap_or_else(|| Number::constant(f64::NAN))
    };
    Ok(header.columns.iter().map(number).collect())
}
