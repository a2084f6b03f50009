//! [`Spacecraft::linearize_step`]: derivatives of a step of RK4, by the chain rule through its stages.
//!
//! Each stage has the exact derivatives of its accelerations. A change of the attitude is carried as
//! a change of the quaternion, in which the step adds its slopes, and returned as a small rotation.

use alloc::vec::Vec;

use nalgebra::{DMatrix, Matrix4xX};

use crate::attitude::quaternion::{Quaternion, norm_squared, rate};
use crate::derivatives::column::Outputs;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::parameters::ParameterVariable;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::model::parameters::Hub;
use crate::numbers::vec3::{Vec3, components};
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::solve::structure::{Rigid, StructureData};

/// A step of RK4 linearised about a state and inputs:
///
/// ```text
/// x1 = F(x0, u0) + A (x - x0) + B (u - u0)
/// ```
///
/// The attitude in `x - x0` and in the change of `x1` is a small rotation about the axes of B, of the
/// state before the step and of that after it.
///
/// Zero by structure in `a`: of a column by the position, all rows but its own, except in a central
/// field; of a column by the velocity, all rows but its own and that of the position, except in a
/// central field; of a column by the attitude, without gravity, the rows of `omega` and of the joints;
/// of a column by the angle of a balanced wheel, all rows but its own. The rest is filled: through its
/// stages a step has elements where [`Linearization::a`](crate::Linearization::a) has zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct StepLinearization<D: WithNumbers<Scalar = f64>, S: StructureData = Rigid> {
    /// The state after the step, that of [`Spacecraft::step`] to the bit.
    pub state: State<D, Quaternion, S>,
    /// The states: rows and columns of `a`, in the order of [`Spacecraft::state_variables`].
    pub states: Vec<Variable>,
    /// The inputs: columns of `b`, in the order of [`Spacecraft::input_variables`].
    pub inputs: Vec<Variable>,
    /// Derivatives of the state after the step by the state before it.
    pub a: DMatrix<f64>,
    /// Derivatives of the state after the step by the inputs, which are held.
    pub b: DMatrix<f64>,
}

/// A stage: derivatives of the slopes of its states by its states, and by what is held.
struct Slopes {
    by_states: DMatrix<f64>,
    by_held: DMatrix<f64>,
}

/// The state after a step, and a change of it for each column.
type Stepped<D, S> = (State<D, Quaternion, S>, DMatrix<f64>);

impl<D: WithNumbers<Scalar = f64>, S: StructureDerivatives> Spacecraft<D, S> {
    /// The step of [`Self::step`] linearised about a state and inputs.
    ///
    /// The matrices are exact to rounding: the derivatives of the step, not those of the motion that
    /// it approximates. Costs four times [`Self::linearize`].
    ///
    /// # Errors
    ///
    /// As [`Self::step`] and [`Self::derivatives`].
    pub fn linearize_step(
        &self,
        state: &State<D, Quaternion, S>,
        inputs: &Inputs<D, S>,
        dt: f64,
    ) -> Result<StepLinearization<D, S>, DerivativeError<f64>> {
        let states: Vec<_> = self.state_variables(inputs).collect();
        let by_inputs: Vec<_> = self.input_variables(inputs).collect();
        let (rows, held) = (states.len(), by_inputs.len());
        let start = DMatrix::identity(rows, rows.saturating_add(held));
        let none = Outputs::accelerations();
        let slopes = |stage: &State<D, Quaternion, S>| {
            let found = self.linearize(stage, inputs, &none)?;
            let mut by_held = DMatrix::zeros(rows, rows.saturating_add(held));
            by_held.columns_mut(rows, held).copy_from(&found.b);
            Ok(Slopes { by_states: found.a, by_held })
        };
        let (state, found) = self.chained(state, inputs, dt, &states, start, slopes)?;
        let (a, b) = (found.columns(0, rows).into_owned(), found.columns(rows, held).into_owned());
        Ok(StepLinearization { state, states, inputs: by_inputs, a, b })
    }

    /// The state after a step, and how a change of the state before it and of what is held is carried
    /// through: `start` has the change of each column, `slopes` its slope at a stage.
    fn chained(
        &self,
        state: &State<D, Quaternion, S>,
        inputs: &Inputs<D, S>,
        dt: f64,
        states: &[Variable],
        start: DMatrix<f64>,
        slopes: impl Fn(&State<D, Quaternion, S>) -> Result<Slopes, DerivativeError<f64>>,
    ) -> Result<Stepped<D, S>, DerivativeError<f64>> {
        let mut stages = Vec::with_capacity(4);
        let next = self.stepped(state, inputs, dt, |weight, stage, found, stiffness| {
            stages.push((weight, stage.clone()));
            self.solve(stage, inputs, found, stiffness)
        })?;
        let attitude = Place::of(states, Variable::Attitude(Axis::X));
        let omega = Place::of(states, Variable::Omega(Axis::X));
        let first =
            stages.first().map_or([1.0, 0.0, 0.0, 0.0], |(_, stage)| numbers(stage.attitude));
        let mut turn = Matrix4xX::zeros(start.ncols());
        for (mut to, from) in turn.column_iter_mut().zip(start.column_iter()) {
            to.copy_from_slice(&rate(first, attitude.take(from.as_slice())));
        }
        let (begin, turn_begin) = (start.clone(), turn.clone());
        let (mut sum, mut turn_sum, mut last) = (start.clone(), turn.clone(), first);
        let mut now = start;
        // The last stage leads to no other.
        let offsets = [0.5 * dt, 0.5 * dt, dt, 0.0];
        for ((weight, stage), offset) in stages.iter().zip(offsets) {
            let Slopes { by_states, by_held } = slopes(stage)?;
            let q = numbers(stage.attitude);
            let mut turn_slope = Matrix4xX::zeros(now.ncols());
            let columns = now.column_iter_mut().zip(turn.column_iter());
            for ((mut now, turn), mut slope) in columns.zip(turn_slope.column_iter_mut()) {
                let [turn] = turn.into_owned().data.0;
                attitude.put(now.as_mut_slice(), rotation(q, turn));
                // Of q' = rate(q, omega), which is linear in both.
                let [by_turn, by_omega] =
                    [rate(turn, components(&stage.omega)), rate(q, omega.take(now.as_slice()))];
                slope.copy_from_slice(&plus(by_turn, 1.0, by_omega));
            }
            let slope = by_states * &now + by_held;
            sum += &slope * *weight;
            turn_sum += &turn_slope * *weight;
            now = &begin + slope * offset;
            turn = &turn_begin + turn_slope * offset;
            last = plus(last, *weight, rate(q, components(&stage.omega)));
        }
        for (mut sum, turn) in sum.column_iter_mut().zip(turn_sum.column_iter()) {
            let [turn] = turn.into_owned().data.0;
            attitude.put(sum.as_mut_slice(), rotation(last, turn));
        }
        Ok((next, sum))
    }
}

impl<D: WithNumbers<Scalar = f64>> Spacecraft<D> {
    /// Derivatives of the state after a step by parameters of the spacecraft of this hub and these
    /// devices: rows as [`StepLinearization::states`], a column for each variable.
    ///
    /// # Errors
    ///
    /// As [`Self::step`] and [`Self::parameter_derivatives`].
    pub fn step_parameter_derivatives(
        hub: &Hub,
        devices: &D,
        (state, inputs): (&State<D, Quaternion>, &Inputs<D>),
        dt: f64,
        variables: &[ParameterVariable<'_>],
    ) -> Result<DMatrix<f64>, DerivativeError<f64>> {
        let craft = Self::new(hub, devices)?;
        let states: Vec<_> = craft.state_variables(inputs).collect();
        let start = DMatrix::zeros(states.len(), variables.len());
        let none = Outputs::accelerations();
        let slopes = |stage: &State<D, Quaternion>| {
            let by_states = craft.linearize(stage, inputs, &none)?.a;
            let mut by_held = DMatrix::zeros(states.len(), variables.len());
            let by = variables.iter().copied();
            let at = (stage, inputs);
            let mut columns = by_held.column_iter_mut();
            Self::parameter_derivatives(hub, devices, at, &none, by, |_, column| {
                let Some(mut slopes) = columns.next() else { return };
                for (to, of) in slopes.iter_mut().zip(&states) {
                    // By what is no state.
                    *to = column.element(*of, Variable::Mu, &stage.omega).unwrap_or_default();
                }
            })?;
            Ok(Slopes { by_states, by_held })
        };
        craft.chained(state, inputs, dt, &states, start, slopes).map(|(_, found)| found)
    }
}

/// Where three rows of a column are; nowhere where the hub is fixed.
struct Place(Option<usize>);

impl Place {
    /// Those of a variable along X, Y and Z.
    fn of(states: &[Variable], first: Variable) -> Self {
        Self(states.iter().position(|variable| *variable == first))
    }

    /// The three numbers, zero where they are nowhere.
    fn take(&self, column: &[f64]) -> Vec3<f64> {
        let place = self.0.and_then(|first| column.get(first..)?.first_chunk());
        place.copied().unwrap_or_default()
    }

    /// Replaces the three numbers.
    fn put(&self, column: &mut [f64], rows: Vec3<f64>) {
        let place = self.0.and_then(|first| column.get_mut(first..)?.first_chunk_mut());
        if let Some(to) = place {
            *to = rows;
        }
    }
}

/// The small rotation about the axes of B that a change of a quaternion of any length is:
/// `2 q* dq / |q|²`, its vector.
fn rotation(q: [f64; 4], by: [f64; 4]) -> Vec3<f64> {
    let ([q0, q1, q2, q3], [b0, b1, b2, b3]) = (q, by);
    let scale = 2.0 / norm_squared(q);
    [
        scale * (q0 * b1 - b0 * q1 - (q2 * b3 - q3 * b2)),
        scale * (q0 * b2 - b0 * q2 - (q3 * b1 - q1 * b3)),
        scale * (q0 * b3 - b0 * q3 - (q1 * b2 - q2 * b1)),
    ]
}

/// The numbers of a quaternion, scalar first.
fn numbers(Quaternion { q0, q1, q2, q3 }: Quaternion) -> [f64; 4] {
    [q0, q1, q2, q3]
}

/// `a + weight b`.
fn plus(a: [f64; 4], weight: f64, b: [f64; 4]) -> [f64; 4] {
    let mut sum = a;
    for (to, from) in sum.iter_mut().zip(b) {
        *to += weight * from;
    }
    sum
}
