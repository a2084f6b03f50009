//! A motion over dual numbers: with its derivatives by up to six keys.

use precess_dynamics::kind::Each as _;
use precess_dynamics::{Attitude as _, BuiltIn, Inputs, JointStates as _, Spacecraft, State};

use precess_craft::tangent::{self, Number, Set, WIDTH};

use super::parameters::parts;
use super::run::Motion;
use crate::record::Header;
use crate::record::columns::Quantity;
use crate::scenario::Scenario;

/// A spacecraft with inputs that are held.
pub(super) struct DualCraft {
    craft: Spacecraft<Set>,
    inputs: Inputs<Set>,
    state: State<Set>,
}

/// Its motion at a time.
pub(super) struct DualMotion<'a> {
    of: &'a DualCraft,
    state: State<Set>,
}

impl DualCraft {
    /// With the derivatives of the numbers of a scenario by up to six keys.
    pub(super) fn new(scenario: &Scenario, slopes: &[Vec<f64>]) -> Result<Self, String> {
        let mut next = 0;
        let of = parts(scenario, &mut |value| {
            let mut number = Number::constant(value);
            for (key, slopes) in slopes.iter().enumerate().take(WIDTH) {
                number.add_derivative(key, slopes.get(next).copied().unwrap_or(0.0));
            }
            next += 1;
            number
        });
        let devices = of.devices.iter().map(|(kind, parameters)| BuiltIn::new(*kind, parameters));
        let set: Set = devices.collect::<Result<_, _>>().map_err(|error| error.to_string())?;
        let craft = tangent::spacecraft(&of.hub, &set).map_err(|error| error.to_string())?;
        let (state, inputs) = of.start(scenario, &craft);
        Ok(Self { craft, inputs, state })
    }

    pub(super) fn start(&self) -> DualMotion<'_> {
        DualMotion { of: self, state: self.state.clone() }
    }
}

impl Motion for DualMotion<'_> {
    fn after(&self, length: f64) -> Result<Self, String> {
        let DualCraft { craft, inputs, .. } = self.of;
        let state = tangent::step(craft, &self.state, inputs, Number::constant(length));
        Ok(Self { of: self.of, state: state.map_err(|error| error.to_string())? })
    }

    fn rows(&self, header: &Header, time: f64) -> Result<Vec<Vec<Number>>, String> {
        let (DualCraft { craft, inputs, .. }, state) = (self.of, &self.state);
        let accelerates = header.columns.iter().any(|column| column.quantity.is_acceleration());
        let found = if accelerates {
            let found = tangent::accelerations(craft, state, inputs);
            Some(found.map_err(|error| error.to_string())?)
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
        Ok(vec![header.columns.iter().map(number).collect()])
    }
}
