//! [`Linearization`]: the matrices of the linearised system, in a stated order.

use alloc::vec;
use alloc::vec::Vec;

use nalgebra::{DMatrix, Dyn, VecStorage};

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::column::{Column, Outputs};
use crate::derivatives::emitted::Emitted;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::loads::load_columns::LoadsWorkspace;
use crate::derivatives::loads::row_product::ChangeRows;
use crate::derivatives::slopes::Slopes;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable, hub_states};
use crate::derivatives::workspace::Workspace;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::components;
use crate::sets::devices::Devices;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, StructureData};

/// Where derivatives are written: the product of those by states with their changes, if it is wanted, and columns by states
/// and by inputs.
pub(crate) type IntoColumns<'a, T> = (Option<ChangeRows<'a, T>>, [&'a mut DMatrix<T>; 2]);

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
    workspace: Workspace<D::Scalar>,
}

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// The spacecraft linearised about a state and inputs.
    ///
    /// The matrices are exact to rounding: [`Self::derivatives`] computes the same columns, and can do so without a
    /// heap. Of accelerations only they are `-M⁻¹` times the emitted derivatives of the loads, several times faster and
    /// rounded elsewhere; but for a platform that carries nothing, and external kinds of more joints than
    /// [`MAX_JOINTS`](crate::MAX_JOINTS).
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
        let joints = inputs.modes.values().count();
        let variables = joints.saturating_add(S::modes(self)).saturating_mul(2).saturating_add(12);
        let list = || Vec::with_capacity(variables);
        let [a, b, c, d] = [(); 4].map(|()| zeros(0, 0));
        let (states, by_inputs, outputs_of) = (list(), list(), Vec::with_capacity(variables));
        let accelerations = self.no_accelerations();
        let mut found = Linearization {
            accelerations,
            states,
            inputs: by_inputs,
            outputs: outputs_of,
            a,
            b,
            c,
            d,
            workspace: Workspace::new(),
        };
        self.linearize_into(state, inputs, outputs, &mut found)?;
        Ok(found)
    }

    /// As [`Self::linearize`], into what an earlier call returned: its matrices and lists are written, and allocated
    /// again only where they have another size. Otherwise a fixed set of devices on a rigid hub takes no heap, with
    /// emitted derivatives (as [`Self::jvp`] has them); a list that of [`Self::accelerations`].
    ///
    /// ```
    /// # use nalgebra::{Matrix3, Vector3};
    /// # use precess_dynamics::{Hub, Inputs, Outputs, ReactionWheel, Spacecraft, State};
    /// # let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// # let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, inertia)])?;
    /// let (mut state, inputs): (State<[ReactionWheel; 1]>, _) = (State::at_rest(), Inputs::none());
    /// let mut kept = craft.linearize(&state, &inputs, &Outputs::accelerations())?;
    /// for spin in [10.0, 20.0] {
    ///     state.devices[0].spin = spin;
    ///     craft.linearize_into(&state, &inputs, &Outputs::accelerations(), &mut kept)?;
    ///     assert_eq!(kept, craft.linearize(&state, &inputs, &Outputs::accelerations())?);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::derivatives`]; the matrices then have no meaning.
    pub fn linearize_into<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        outputs: &Outputs<D::Scalar>,
        into: &mut Linearization<D, S>,
    ) -> Result<(), DerivativeError<D::Scalar>> {
        into.accelerations = self.checked(state, inputs, outputs)?;
        into.shape(self, inputs, outputs);
        let Linearization {
            accelerations, states, inputs: by_inputs, a, b, c, d, workspace, ..
        } = into;
        let lists = (states.as_slice(), by_inputs.as_slice());
        let (at, Workspace { loads, moving, .. }) = ((state, inputs), workspace);
        let rows = Slopes::new(self, state, inputs, accelerations, moving);
        let emitted = self.emitted(at, accelerations, outputs, loads);
        if let Some(emitted) = &emitted
            && emitted.fill_matrices(&rows, [[&mut *c, &mut *a], [&mut *d, &mut *b]])
        {
            return Ok(());
        }
        self.columns_by(emitted, at, outputs, lists, [&mut *c, &mut *d])?;
        let not_finite = |variable| DerivativeError::NotFinite { variable };
        rows.fill(states, c, a).map_err(not_finite)?;
        let others = rows.fill(by_inputs, d, b);
        others.map_err(|variable| not_finite(variable.saturating_add(states.len())))
    }

    /// The derivatives of the outputs by states and inputs into their columns.
    pub(crate) fn output_columns<A: Attitude<D::Scalar>>(
        &self,
        at: (&State<D, A, S>, &Inputs<D, S>),
        accelerations: &Accelerations<D, S>,
        outputs: &Outputs<D::Scalar>,
        lists: (&[Variable], &[Variable]),
        into: [&mut DMatrix<D::Scalar>; 2],
        workspace: &mut Workspace<D::Scalar>,
    ) -> Result<(), DerivativeError<D::Scalar>> {
        let emitted = self.emitted(at, accelerations, outputs, &mut workspace.loads);
        self.columns_by(emitted, at, outputs, lists, into)
    }

    /// The derivatives of the accelerations by states and inputs into their columns; where the emitted derivatives have it,
    /// the product of those by states with changes of them is written in place of their columns. Whether it is.
    pub(crate) fn acceleration_columns<A: Attitude<D::Scalar>>(
        &self,
        at: (&State<D, A, S>, &Inputs<D, S>),
        accelerations: &Accelerations<D, S>,
        lists: (&[Variable], &[Variable]),
        (product, into): IntoColumns<'_, D::Scalar>,
        Workspace { loads, product: of, .. }: &mut Workspace<D::Scalar>,
    ) -> Result<bool, DerivativeError<D::Scalar>> {
        let outputs = Outputs::accelerations();
        let emitted = self.emitted(at, accelerations, &outputs, loads);
        let (states, by_inputs) = lists;
        if let (Some(Emitted::OnHub(loads)), Some(rows)) = (&emitted, product) {
            of.write(loads, states, rows);
            let [_, into] = into;
            let not_finite = |variable: usize| variable.saturating_add(states.len());
            let found = loads.columns(by_inputs, into).map_err(not_finite);
            return found
                .map(|()| true)
                .map_err(|variable| DerivativeError::NotFinite { variable });
        }
        self.columns_by(emitted, at, &outputs, lists, into).map(|()| false)
    }

    /// Lists the joints that are not locked, the states and the inputs.
    pub(crate) fn list_variables(
        &self,
        inputs: &Inputs<D, S>,
        moving: &mut Vec<usize>,
        [states, by_inputs]: [&mut Vec<Variable>; 2],
    ) {
        moving.clear();
        Slopes::moving_joints(inputs).for_each(|joint| moving.push(joint));
        let moving = || moving.iter().copied();
        let modes = || 0..S::modes(self);
        // Those of `state_variables`, of which each list has a known length.
        states.clear();
        states.extend_from_slice(hub_states(&inputs.hub));
        states.extend(moving().map(Variable::Coordinate));
        states.extend(moving().map(Variable::Rate));
        states.extend(modes().map(Variable::ModalCoordinate));
        states.extend(modes().map(Variable::ModalRate));
        // Inner iteration: what the iterators chain is then a loop each.
        by_inputs.clear();
        self.input_variables(inputs).for_each(|variable| by_inputs.push(variable));
    }

    /// Emitted derivatives, where there are any of these outputs.
    pub(crate) fn emitted<'a, A: Attitude<D::Scalar>>(
        &self,
        (state, inputs): (&State<D, A, S>, &Inputs<D, S>),
        accelerations: &Accelerations<D, S>,
        outputs: &Outputs<D::Scalar>,
        workspace: &'a mut LoadsWorkspace<D::Scalar>,
    ) -> Option<Emitted<'a, D::Scalar>> {
        if *outputs == Outputs::accelerations() {
            Emitted::new(self, state, inputs, accelerations, workspace)
        } else {
            None
        }
    }

    /// Columns by emitted derivatives; without, by dual numbers.
    pub(crate) fn columns_by<A: Attitude<D::Scalar>>(
        &self,
        emitted: Option<Emitted<'_, D::Scalar>>,
        (state, inputs): (&State<D, A, S>, &Inputs<D, S>),
        outputs: &Outputs<D::Scalar>,
        (states, by_inputs): (&[Variable], &[Variable]),
        into: [&mut DMatrix<D::Scalar>; 2],
    ) -> Result<(), DerivativeError<D::Scalar>> {
        let Some(emitted) = emitted else {
            let variables = states.iter().chain(by_inputs).copied();
            let mut columns = into.into_iter().flat_map(columns_of);
            self.derivatives(state, inputs, outputs, variables, |_, column| {
                let column = columns.next().into_iter().flatten().zip(column.outputs());
                column.for_each(|(to, from)| *to = from);
            })?;
            return Ok(());
        };
        let [by_states, by_inputs_of] = into;
        let not_finite = |variable| DerivativeError::NotFinite { variable };
        emitted.columns(states, by_states).map_err(not_finite)?;
        let others = emitted.columns(by_inputs, by_inputs_of);
        others.map_err(|variable| not_finite(variable.saturating_add(states.len())))
    }

    /// The outputs in the order of [`Column::outputs`].
    fn outputs(&self, outputs: &Outputs<D::Scalar>, rows: &mut Vec<Output>) {
        let joints = self.joints().count();
        rows.clear();
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
    }
}

impl<D: Devices, S: StructureData> Linearization<D, S> {
    /// The same with accelerations of another set or structure.
    #[must_use]
    pub fn with_accelerations<E: Devices<Scalar = D::Scalar>, Q: StructureData>(
        self,
        accelerations: Accelerations<E, Q>,
    ) -> Linearization<E, Q> {
        let Self { states, inputs, outputs, a, b, c, d, workspace, .. } = self;
        Linearization { accelerations, states, inputs, outputs, a, b, c, d, workspace }
    }
}

impl<D: WithNumbers, S: StructureDerivatives> Linearization<D, S> {
    /// Lists and matrices of the size that they have for these inputs; the elements stay as they are.
    fn shape(
        &mut self,
        craft: &Spacecraft<D, S>,
        inputs: &Inputs<D, S>,
        outputs: &Outputs<D::Scalar>,
    ) {
        let Self { states, inputs: by_inputs, workspace: Workspace { moving, .. }, .. } = self;
        craft.list_variables(inputs, moving, [states, by_inputs]);
        craft.outputs(outputs, &mut self.outputs);
        let (states, by_inputs, rows) = (self.states.len(), self.inputs.len(), self.outputs.len());
        let sizes = [(states, states), (states, by_inputs), (rows, states), (rows, by_inputs)];
        let Self { a, b, c, d, .. } = self;
        for (matrix, (rows, columns)) in [a, b, c, d].into_iter().zip(sizes) {
            set_size(matrix, rows, columns);
        }
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

/// A matrix of zeros. What the allocator clears is not cleared again.
pub(crate) fn zeros<T: Scalar>(rows: usize, columns: usize) -> DMatrix<T> {
    let elements = vec![zero(); rows.saturating_mul(columns)];
    DMatrix::from_data(VecStorage::new(Dyn(rows), Dyn(columns), elements))
}

/// Allocates a matrix again where it has another size; otherwise its elements stay as they are.
pub(crate) fn set_size<T: Scalar>(matrix: &mut DMatrix<T>, rows: usize, columns: usize) {
    if matrix.shape() != (rows, columns) {
        *matrix = zeros(rows, columns);
    }
}

/// The columns of a matrix, empty where it has no rows.
pub(crate) fn columns_of<T: Scalar>(matrix: &mut DMatrix<T>) -> impl Iterator<Item = &mut [T]> {
    let (rows, columns) = matrix.shape();
    let mut rest = matrix.as_mut_slice();
    (0..columns).map_while(move |_| {
        let (column, others) = core::mem::take(&mut rest).split_at_mut_checked(rows)?;
        rest = others;
        Some(column)
    })
}
