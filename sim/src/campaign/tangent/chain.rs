//! A motion with the derivatives of each step by the chain rule, by any number of keys.
//!
//! With the changes `S` of the state and `P` of parameters and inputs, a column for each key, a step changes by `A S + B P` of
//! its exact derivatives, and the accelerations of a sample by `C S + D P`.

use nalgebra::{DMatrix, Vector3};
use precess_dynamics::kind::Each as _;
use precess_dynamics::{
    Attitude as _, Axis, BuiltIn, Gravity, Hub, HubMode, Inputs, JointStates as _, Mode,
    ParameterDirection, Quaternion, Spacecraft, State, Variable,
};

use precess_craft::Set;
use precess_craft::tangent::{Number, WIDTH};

use super::parameters::{Parts, parts};
use super::run::Motion;
use crate::record::Header;
use crate::record::columns::Quantity;
use crate::scenario::Scenario;

/// A spacecraft with inputs that are held, and what keys change of both.
pub(super) struct ChainCraft {
    hub: Hub,
    devices: Set,
    craft: Spacecraft<Set>,
    inputs: Inputs<Set>,
    state: State<Set>,
    /// Rows of the changes.
    states: Vec<Variable>,
    directions: Vec<ParameterDirection>,
    changes: DMatrix<f64>,
}

/// Its motion at a time.
pub(super) struct ChainMotion<'a> {
    of: &'a ChainCraft,
    state: State<Set>,
    changes: DMatrix<f64>,
}

impl ChainCraft {
    /// With the derivatives of the numbers of a scenario by keys; none of what has dual numbers only: a central field,
    /// lumped imbalance, a key that changes gravity or moves a fixed hub.
    pub(super) fn new(scenario: &Scenario, slopes: &[Vec<f64>]) -> Result<Option<Self>, String> {
        if matches!(scenario.gravity, Gravity::Central { .. }) {
            return Ok(None);
        }
        let of = parts(scenario, &mut |value| value);
        let devices = of.devices.iter().map(|(kind, parameters)| BuiltIn::new(*kind, parameters));
        let devices = devices.collect::<Result<_, _>>().map_err(|error| error.to_string())?;
        let devices: Set = (devices, Vec::new(), Vec::new());
        let craft = precess_craft::spacecraft(&of.hub, &devices);
        let craft = craft.map_err(|error| error.to_string())?;
        let (state, inputs) = of.start(scenario, &craft);
        let states: Vec<Variable> = craft.state_variables(&inputs).collect();
        let mut changes = DMatrix::zeros(states.len(), slopes.len());
        let mut directions = Vec::with_capacity(slopes.len());
        for (slopes, mut column) in slopes.iter().zip(changes.column_iter_mut()) {
            let mut next = slopes.iter().copied();
            let by_key = parts(scenario, &mut |_| next.next().unwrap_or_default());
            if changes_field_or_fixed_hub(scenario, &by_key) {
                return Ok(None);
            }
            for (to, state_variable) in column.iter_mut().zip(&states) {
                *to = change_of(*state_variable, &of, &by_key);
            }
            let locked = (0..by_key.joints.len()).map(Variable::Coordinate);
            let locked = locked.filter(|coordinate| !states.contains(coordinate));
            let held = craft.input_variables(&inputs).chain(locked);
            let held = held.map(|held| (held, change_of(held, &of, &by_key)));
            directions.push(ParameterDirection {
                hub: by_key.hub,
                held: held.filter(|(_, change)| *change != 0.0).collect(),
                devices: by_key.devices.into_iter().map(|(_, parameters)| parameters).collect(),
            });
        }
        let hub = of.hub;
        let made = Self { hub, devices, craft, inputs, state, states, directions, changes };
        let supported = made.start().accelerations()?.is_some();
        Ok(supported.then_some(made))
    }

    pub(super) fn start(&self) -> ChainMotion<'_> {
        ChainMotion { of: self, state: self.state.clone(), changes: self.changes.clone() }
    }
}

/// Whether a key changes what is neither a state nor held.
fn changes_field_or_fixed_hub(scenario: &Scenario, by_key: &Parts<f64>) -> bool {
    let Quaternion { q0, q1, q2, q3 } = by_key.attitude;
    let of_hub = [by_key.position, by_key.velocity, by_key.omega];
    let moved = || of_hub.iter().flatten().chain(&[q0, q1, q2, q3]).any(|change| *change != 0.0);
    let field = matches!(by_key.gravity, Gravity::Uniform(g) if g != Vector3::zeros());
    field || matches!(scenario.hub_mode, HubMode::Fixed) && moved()
}

/// What a state or an input changes by with a key.
fn change_of(of: Variable, parts: &Parts<f64>, by_key: &Parts<f64>) -> f64 {
    let joint = |joint: usize| by_key.joints.get(joint).copied().unwrap_or_default();
    match of {
        Variable::Position(axis) => by_key.position[axis as usize],
        Variable::Velocity(axis) => by_key.velocity[axis as usize],
        Variable::Omega(axis) => by_key.omega[axis as usize],
        Variable::Attitude(axis) => rotation(parts.attitude, by_key.attitude)[axis as usize],
        Variable::Coordinate(index) => joint(index)[0],
        Variable::Rate(index) => joint(index)[1],
        Variable::Motor(index) => by_key.motors.get(index).copied().unwrap_or_default(),
        Variable::Acceleration(index) => match by_key.modes.get(index) {
            Some(Mode::Prescribed(acceleration)) => *acceleration,
            _ => 0.0,
        },
        _ => 0.0,
    }
}

/// The small rotation about the axes of B that a change of a quaternion is: `2 q* dq / |q|²`, its vector.
fn rotation(of: Quaternion, change: Quaternion) -> Vector3<f64> {
    let vector = |q: Quaternion| Vector3::new(q.q1, q.q2, q.q3);
    let (q, dq) = (vector(of), vector(change));
    let norm = of.q0 * of.q0 + q.norm_squared();
    (dq * of.q0 - q * change.q0 - q.cross(&dq)) * (2.0 / norm)
}

impl ChainMotion<'_> {
    /// Accelerations and their changes; none where they have dual numbers only.
    #[expect(clippy::type_complexity, reason = "two things of one set")]
    fn accelerations(
        &self,
    ) -> Result<Option<(precess_dynamics::Accelerations<Set>, DMatrix<f64>)>, String> {
        let ChainCraft { hub, devices, craft, inputs, directions, .. } = self.of;
        let at = (&self.state, inputs);
        let found = precess_craft::accelerations_along(
            craft,
            (hub, devices),
            at,
            &self.changes,
            directions,
        );
        found.map_err(|error| error.to_string())
    }

    /// For six keys from one on, of this value and with the changes of this row.
    fn number(value: f64, changes: impl Iterator<Item = f64>, first: usize) -> Number {
        let mut number = Number::constant(value);
        for (key, change) in changes.skip(first).take(WIDTH).enumerate() {
            number.add_derivative(key, change);
        }
        number
    }

    /// The value of a quantity, and what it changes by with each key.
    fn quantity(
        &self,
        quantity: Quantity,
        time: f64,
        accelerations: Option<&Accelerated>,
    ) -> Option<(f64, Vec<f64>)> {
        let state = &self.state;
        let axis_of = |axis: usize| Axis::ALL.get(axis).copied();
        let of_state = |variable: Variable| -> Vec<f64> {
            let row = self.of.states.iter().position(|state| *state == variable);
            if let Some(row) = row {
                return self.changes.row(row).iter().copied().collect();
            }
            let held = |direction: &ParameterDirection| {
                let found = direction.held.iter().find(|(held, _)| *held == variable);
                found.map_or(0.0, |(_, change)| *change)
            };
            self.of.directions.iter().map(held).collect()
        };
        let joint = |index: usize| state.devices.states().nth(index);
        Some(match quantity {
            Quantity::Time => (time, vec![0.0; self.changes.ncols()]),
            Quantity::Position(axis) => {
                (*state.r_b_n.get(axis)?, of_state(Variable::Position(axis_of(axis)?)))
            }
            Quantity::Velocity(axis) => {
                (*state.r_b_n_dot.get(axis)?, of_state(Variable::Velocity(axis_of(axis)?)))
            }
            Quantity::Omega(axis) => {
                (*state.omega.get(axis)?, of_state(Variable::Omega(axis_of(axis)?)))
            }
            Quantity::Coordinate(index) => {
                (joint(index)?[0], of_state(Variable::Coordinate(index)))
            }
            Quantity::Rate(index) => (joint(index)?[1], of_state(Variable::Rate(index))),
            Quantity::HubAcceleration(axis) => accelerations?.of_row(axis)?,
            Quantity::OmegaDot(axis) => accelerations?.of_row(3 + axis)?,
            Quantity::JointAcceleration(index) => accelerations?.of_row(6 + index)?,
            _ => return None,
        })
    }

    /// Accelerations and their changes, that of the hub's origin expressed in N.
    fn accelerated(&self) -> Result<Accelerated, String> {
        let found = self.accelerations()?;
        let (found, mut changes) = found.ok_or("a step has no derivatives along parameters")?;
        let nb = self.state.attitude.dcm().transpose();
        let row = |axis: Axis| {
            let attitude = Variable::Attitude(axis);
            self.of.states.iter().position(|state| *state == attitude)
        };
        let rows = Axis::ALL.map(row);
        for (mut column, of_state) in changes.column_iter_mut().zip(self.changes.column_iter()) {
            let turned = rows.map(|row| row.map_or(0.0, |row| of_state[row]));
            let falls = Vector3::from(turned).cross(&found.r_b_n_ddot);
            let of_b = Vector3::new(column[0], column[1], column[2]);
            column.fixed_rows_mut::<3>(0).copy_from(&(nb * (of_b + falls)));
        }
        let in_n = nb * found.r_b_n_ddot;
        let values = in_n.iter().chain(&found.omega_dot).copied().chain(found.devices.values());
        Ok(Accelerated { values: values.collect(), changes })
    }
}

/// All accelerations in order, and what they change by with each key.
struct Accelerated {
    values: Vec<f64>,
    changes: DMatrix<f64>,
}

impl Accelerated {
    fn of_row(&self, row: usize) -> Option<(f64, Vec<f64>)> {
        let value = *self.values.get(row)?;
        Some((value, self.changes.row(row).iter().copied().collect()))
    }
}

impl Motion for ChainMotion<'_> {
    fn after(&self, length: f64) -> Result<Self, String> {
        let ChainCraft { hub, devices, craft, inputs, directions, .. } = self.of;
        let at = (&self.state, inputs);
        let of = (hub, devices);
        let found = precess_craft::step_along(craft, of, at, length, &self.changes, directions);
        let found = found.map_err(|error| error.to_string())?;
        let (state, changes) = found.ok_or("a step has no derivatives along parameters")?;
        Ok(Self { of: self.of, state, changes })
    }

    fn rows(&self, header: &Header, time: f64) -> Result<Vec<Vec<Number>>, String> {
        let accelerates = header.columns.iter().any(|column| column.quantity.is_acceleration());
        let found = if accelerates { Some(self.accelerated()?) } else { None };
        let keys = self.changes.ncols();
        let of = |column: &crate::record::Column| {
            self.quantity(column.quantity, time, found.as_ref())
                .unwrap_or_else(|| (f64::NAN, vec![0.0; keys]))
        };
        let columns: Vec<_> = header.columns.iter().map(of).collect();
        let row = |first: usize| {
            let numbers = columns.iter();
            numbers
                .map(|(value, changes)| Self::number(*value, changes.iter().copied(), first))
                .collect()
        };
        Ok((0..keys).step_by(WIDTH).map(row).collect())
    }
}
