//! Changes of a motion along directions of parameters: how accelerations and the state after a step change where state,
//! parameters and inputs change together, with one linearisation for all directions.
//!
//! With the changes `S` of the state, by columns, and those of parameters and inputs `P`, accelerations change by
//! `C S + D P`, and the next state by the chain rule through the stages of the step, `A S + B P`.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::attitude::quaternion::Quaternion;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::linearization::IntoColumns;
use crate::derivatives::loads::side_by_side::are_finite;
use crate::derivatives::parameters::direction::ParameterDirection;
use crate::derivatives::parameters::loads::ParameterLoads;
use crate::derivatives::step::workspace::ChainWorkspace;
use crate::derivatives::variable::Variable;
use crate::derivatives::workspace::Workspace;
use crate::model::parameters::Hub;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Numbers, and what they change by: a column for each direction.
pub type WithChanges<T> = (T, DMatrix<f64>);

/// A state and inputs.
type At<'a, D> = (&'a State<D, Quaternion>, &'a Inputs<D>);

impl<D: WithNumbers<Scalar = f64>> Spacecraft<D> {
    /// The accelerations of this spacecraft, made of this hub and these devices, and what they change by along
    /// directions of its parameters and inputs, where the state changes with them: a column for each direction, rows as
    /// of [`Linearization::c`](crate::Linearization::c).
    ///
    /// `changes` has a column for each direction, rows as [`Self::state_variables`]. Exact to rounding. None where
    /// [`Self::parameter_derivatives`] takes dual numbers: on carriers, with lumped imbalance, in a central field.
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`]; [`DerivativeError::Length`] for changes and directions of another size,
    /// [`DerivativeError::NoSuchDevice`], [`DerivativeError::NotAnInput`] for what is not held,
    /// [`DerivativeError::NotFinite`], which counts directions.
    pub fn accelerations_along(
        &self,
        (hub, devices): (&Hub, &D),
        (state, inputs): At<'_, D>,
        changes: &DMatrix<f64>,
        directions: &[ParameterDirection],
    ) -> Result<Option<WithChanges<Accelerations<D>>>, DerivativeError<f64>> {
        let found = self.accelerations(state, inputs)?;
        let along = Along::new(self, (hub, devices), inputs, changes, directions)?;
        let rows = self.joints().count().saturating_add(6);
        let mut by_states = DMatrix::zeros(rows, along.states.len());
        let mut by_directions = DMatrix::zeros(rows, directions.len());
        let into = (None, [&mut by_states, &mut by_directions]);
        if along.columns(state, &found, into)?.is_none() {
            return Ok(None);
        }
        by_directions += by_states * changes;
        match by_directions.column_iter().position(|column| !are_finite(column.as_slice())) {
            Some(variable) => Err(DerivativeError::NotFinite { variable }),
            None => Ok(Some((found, by_directions))),
        }
    }

    /// The state after a step of RK4 of this spacecraft, made of this hub and these devices, and what it changes by along
    /// directions of its parameters and inputs, where the state before the step changes with them: `A S + B P` of
    /// [`Self::linearize_step`] and [`Self::step_parameter_derivatives`], in columns as those of `changes`.
    ///
    /// Called step after step with what it returned, it carries the derivatives of a run; those of its attitude are small
    /// rotations. None where [`Self::accelerations_along`] is.
    ///
    /// # Errors
    ///
    /// As [`Self::step`] and [`Self::accelerations_along`].
    pub fn step_along(
        &self,
        (hub, devices): (&Hub, &D),
        (state, inputs): At<'_, D>,
        dt: f64,
        changes: &DMatrix<f64>,
        directions: &[ParameterDirection],
    ) -> Result<Option<WithChanges<State<D>>>, DerivativeError<f64>> {
        let along = Along::new(self, (hub, devices), inputs, changes, directions)?;
        let mut after = DMatrix::zeros(changes.nrows(), changes.ncols());
        let mut none = DMatrix::zeros(changes.nrows(), 0);
        let mut supported = true;
        let mut derivatives = |stage: &_, found: &_, into: IntoColumns<'_, f64>| {
            // Stages differ in the state only, of which this does not depend.
            let written = if supported { along.columns(stage, found, into)? } else { None };
            supported = written.is_some();
            Ok(written.unwrap_or_default())
        };
        let into = ([&mut none, &mut after], &mut ChainWorkspace::new());
        let (next, stages) = self.step_stages(state, inputs, dt)?;
        self.chained(inputs, (&stages, Some(changes)), into, &mut derivatives)?;
        Ok(supported.then_some((next, after)))
    }
}

/// What is differentiated, and along what.
struct Along<'a, D: WithNumbers<Scalar = f64>> {
    craft: &'a Spacecraft<D>,
    of: (&'a Hub, &'a D),
    inputs: &'a Inputs<D>,
    states: Vec<Variable>,
    /// What is held that changes along any direction.
    by_held: Vec<Variable>,
    /// What they change by, a column for each direction.
    multiples: DMatrix<f64>,
    directions: &'a [ParameterDirection],
    /// The number of a direction and of a device that it changes, in order.
    changed: Vec<(usize, usize)>,
}

impl<'a, D: WithNumbers<Scalar = f64>> Along<'a, D> {
    fn new(
        craft: &'a Spacecraft<D>,
        of: (&'a Hub, &'a D),
        inputs: &'a Inputs<D>,
        changes: &DMatrix<f64>,
        directions: &'a [ParameterDirection],
    ) -> Result<Self, DerivativeError<f64>> {
        let states: Vec<_> = craft.state_variables(inputs).collect();
        same_length(states.len(), changes.nrows())?;
        same_length(directions.len(), changes.ncols())?;
        let mut by_held = Vec::new();
        for (variable, _) in directions.iter().flat_map(|of| &of.held) {
            let variable = *variable;
            // A coordinate that is no state is that of a locked joint.
            let locked =
                matches!(variable, Variable::Coordinate(joint) if joint < craft.joints().count());
            let held = locked || craft.input_variables(inputs).any(|input| input == variable);
            if !held || states.contains(&variable) {
                return Err(DerivativeError::NotAnInput { variable });
            }
            if !by_held.contains(&variable) {
                by_held.push(variable);
            }
        }
        let mut multiples = DMatrix::zeros(by_held.len(), directions.len());
        for (of, mut column) in directions.iter().zip(multiples.column_iter_mut()) {
            for (variable, change) in &of.held {
                let place = by_held.iter().position(|held| held == variable);
                if let Some(to) = place.and_then(|place| column.get_mut(place)) {
                    *to += change;
                }
            }
        }
        let of_directions = directions.iter().enumerate();
        let changed = of_directions
            .flat_map(|(number, of)| of.of_devices().map(move |device| (number, device)))
            .collect();
        Ok(Self { craft, of, inputs, states, by_held, multiples, directions, changed })
    }

    /// The derivatives of accelerations by the states, or their product with changes, and along the directions at a state
    /// that stays; whether it is the product. None where there are none.
    fn columns(
        &self,
        state: &State<D>,
        found: &Accelerations<D>,
        (product, [by_states, by_directions]): IntoColumns<'_, f64>,
    ) -> Result<Option<bool>, DerivativeError<f64>> {
        let at = (state, self.inputs);
        let Some(mut loads) = ParameterLoads::new(self.craft, self.of, at, found) else {
            return Ok(None);
        };
        let mut by_held = DMatrix::zeros(by_states.nrows(), self.by_held.len());
        let lists = (self.states.as_slice(), self.by_held.as_slice());
        let into = (product, [by_states, &mut by_held]);
        let workspace = &mut Workspace::new();
        let written = self.craft.acceleration_columns(at, found, lists, into, workspace)?;
        by_directions.gemm(1.0, &by_held, &self.multiples, 0.0);
        let rows = by_directions.nrows().max(1);
        let columns = by_directions.as_mut_slice().chunks_exact_mut(rows);
        let mut changed = self.changed.iter().peekable();
        for (number, (direction, column)) in self.directions.iter().zip(columns).enumerate() {
            let own = core::iter::from_fn(|| changed.next_if(|(of, _)| *of == number));
            loads.add_along(direction, own.map(|(_, device)| *device), column)?;
        }
        Ok(Some(written))
    }
}

fn same_length(expected: usize, found: usize) -> Result<(), DerivativeError<f64>> {
    if found == expected { Ok(()) } else { Err(DerivativeError::Length { expected, found }) }
}
