//! [`Linearization`]: the matrices of the linearised system, in a stated order.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::column::{Column, Outputs};
use crate::derivatives::error::DerivativeError;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::components;
use crate::sets::devices::Devices;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, StructureData};

/// An output of the linearised system, a row of `c` and `d`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// Of the acceleration of B, B axes, m/s².
    Acceleration(Axis),
    /// Of the angular acceleration of the hub, B axes, rad/s².
    AngularAcceleration(Axis),
    /// The acceleration of a joint, rad/s² or m/s².
    JointAcceleration(usize),
    /// The second derivative of a modal coordinate, m sqrt(kg)/s².
    ModalAcceleration(usize),
    /// Kinetic energy, J.
    Energy,
    /// Of the linear momentum, N axes, kg m/s.
    LinearMomentum(Axis),
    /// Of the angular momentum about the requested point, N axes, kg m²/s.
    AngularMomentum(Axis),
    /// Of the force on the child body of a joint, in the requested axes, N.
    JointForce(usize, Axis),
    /// Of the moment on the child body of a joint about the joint's origin, in the requested
    /// axes, N m.
    JointMoment(usize, Axis),
    /// Of the force that must act on the hub in addition to the inputs, B axes, N.
    HubForce(Axis),
    /// Of the moment that must act on the hub in addition to the inputs, about B, B axes, N m.
    HubMoment(Axis),
}

/// A spacecraft linearised about a state and inputs:
///
/// ```text
/// x' = f(x0, u0) + A (x - x0) + B (u - u0)
/// y  = g(x0, u0) + C (x - x0) + D (u - u0)
/// ```
///
/// The attitude in `x - x0` is a small rotation about the axes of B. The state `x0` need not be an
/// equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Linearization<D: Devices, S: StructureData = Rigid> {
    /// The accelerations at the state.
    pub accelerations: Accelerations<D, S>,
    /// The states: rows and columns of `a`, columns of `c`; in the order of
    /// [`Spacecraft::state_variables`].
    pub states: Vec<Variable>,
    /// The inputs: columns of `b` and `d`; in the order of [`Spacecraft::input_variables`].
    pub inputs: Vec<Variable>,
    /// The outputs: rows of `c` and `d`; first the accelerations, then as [`Outputs`] names them.
    pub outputs: Vec<Output>,
    /// Derivatives of `x'` by the states.
    pub a: DMatrix<D::Scalar>,
    /// Derivatives of `x'` by the inputs.
    pub b: DMatrix<D::Scalar>,
    /// Derivatives of the outputs by the states.
    pub c: DMatrix<D::Scalar>,
    /// Derivatives of the outputs by the inputs.
    pub d: DMatrix<D::Scalar>,
}

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// The spacecraft linearised about a state and inputs.
    ///
    /// The matrices are exact to rounding: [`Self::derivatives`] computes their columns, and can do
    /// so without a heap.
    ///
    /// # Errors
    ///
    /// As [`Self::derivatives`].
    pub fn linearize<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        outputs: &Outputs<D::Scalar>,
    ) -> Result<Linearization<D, S>, DerivativeError<D::Scalar>> {
        let states: Vec<_> = self.state_variables(inputs).collect();
        let by_inputs: Vec<_> = self.input_variables(inputs).collect();
        let rows = self.outputs(outputs);
        let count = states.len() + by_inputs.len();
        let mut slopes = DMatrix::from_element(states.len(), count, zero());
        let mut results = DMatrix::from_element(rows.len(), count, zero());
        let mut columns = slopes.column_iter_mut().zip(results.column_iter_mut());
        let variables = states.iter().chain(&by_inputs).copied();
        let accelerations =
            self.derivatives(state, inputs, outputs, variables, |variable, column| {
                let Some((mut slopes, mut results)) = columns.next() else { return };
                for (to, of) in slopes.iter_mut().zip(&states) {
                    let element = column.element(*of, variable, &state.omega);
                    *to = element.unwrap_or_else(zero);
                }
                results.iter_mut().zip(column.outputs()).for_each(|(to, from)| *to = from);
            })?;
        drop(columns);
        let (states_count, inputs_count) = (states.len(), by_inputs.len());
        Ok(Linearization {
            accelerations,
            a: slopes.columns(0, states_count).into_owned(),
            b: slopes.columns(states_count, inputs_count).into_owned(),
            c: results.columns(0, states_count).into_owned(),
            d: results.columns(states_count, inputs_count).into_owned(),
            outputs: rows,
            states,
            inputs: by_inputs,
        })
    }

    /// The outputs in the order of [`Column::outputs`].
    fn outputs(&self, outputs: &Outputs<D::Scalar>) -> Vec<Output> {
        let joints = self.joints().count();
        let mut rows = Vec::new();
        rows.extend(Axis::ALL.map(Output::Acceleration));
        rows.extend(Axis::ALL.map(Output::AngularAcceleration));
        rows.extend((0..joints).map(Output::JointAcceleration));
        rows.extend((0..S::modes(self)).map(Output::ModalAcceleration));
        if outputs.momentum.is_some() {
            rows.push(Output::Energy);
            rows.extend(Axis::ALL.map(Output::LinearMomentum));
            rows.extend(Axis::ALL.map(Output::AngularMomentum));
        }
        if outputs.loads.is_some() {
            for joint in 0..joints {
                rows.extend(Axis::ALL.map(|axis| Output::JointForce(joint, axis)));
                rows.extend(Axis::ALL.map(|axis| Output::JointMoment(joint, axis)));
            }
            rows.extend(Axis::ALL.map(Output::HubForce));
            rows.extend(Axis::ALL.map(Output::HubMoment));
        }
        rows
    }
}

impl<T: Scalar, D: Devices<Scalar = T>, S: StructureDerivatives> Column<D, S> {
    /// The column's elements in the rows of [`Linearization::outputs`], in order.
    pub fn outputs(&self) -> impl Iterator<Item = T> {
        let Self { accelerations, momentum, loads, hub_load, .. } = self;
        let hub = [&accelerations.r_b_n_ddot, &accelerations.omega_dot];
        let hub = hub.into_iter().flat_map(components);
        let momentum = momentum.iter().flat_map(|of| {
            let momenta = [&of.momentum.linear, &of.momentum.angular];
            core::iter::once(of.energy).chain(momenta.into_iter().flat_map(components))
        });
        let loads = loads.iter().flat_map(Each::values).chain(*hub_load).flat_map(|wrench| {
            components(&wrench.force).into_iter().chain(components(&wrench.moment))
        });
        let modes = S::modal_accelerations(&accelerations.modal).iter().copied();
        let joints = accelerations.devices.values();
        hub.chain(joints).chain(modes).chain(momentum).chain(loads)
    }
}
