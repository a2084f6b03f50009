//! [`Spacecraft::linearize_step`]: derivatives of a step of RK4, by the chain rule through its stages.
//!
//! Each stage has the exact derivatives of its accelerations, through which [`StageChain`] carries the changes.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::attitude::quaternion::{Quaternion, rate};
use crate::derivatives::dual::column::Outputs;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::linearization::{IntoColumns, columns_of, set_size};
use crate::derivatives::loads::side_by_side::are_finite;
use crate::derivatives::parameters::columns::ParameterVariable;
use crate::derivatives::slopes::Slopes;
use crate::derivatives::step::stage_chain::{Numbers, StageDerivatives, numbers};
use crate::derivatives::step::workspace::{ChainWorkspace, StepWorkspace};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::Variable;
use crate::derivatives::workspace::Workspace;
use crate::model::mode::HubMode;
use crate::model::parameters::Hub;
use crate::numbers::vec3::components;
use crate::sets::devices::Devices;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
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
    workspace: StepWorkspace,
}

/// Of what is held, at a stage with its accelerations: the derivatives of accelerations by it, and by states, or their
/// product with the changes of the states. Whether it is that.
type ByHeld<'a, D, S> = &'a mut dyn FnMut(
    &State<D, Quaternion, S>,
    &Accelerations<D, S>,
    IntoColumns<'_, f64>,
) -> Result<bool, DerivativeError<f64>>;

/// A stage: what its slopes count, and the offset from the start to the next stage, both in s; the state, and the
/// accelerations.
pub(crate) type StepStage<D, S> = ([f64; 2], State<D, Quaternion, S>, Accelerations<D, S>);

/// The state after a step, and its stages.
type WithStages<D, S> = (State<D, Quaternion, S>, Vec<StepStage<D, S>>);

impl<D: WithNumbers<Scalar = f64>, S: StructureDerivatives> Spacecraft<D, S> {
    /// The step of [`Self::step`] linearised about a state and inputs.
    ///
    /// The matrices are exact to rounding: the derivatives of the step, not those of the motion that
    /// it approximates. Costs about five times [`Self::linearize`].
    ///
    /// # Errors
    ///
    /// As [`Self::step`] and [`Self::derivatives`]; [`DerivativeError::NotFinite`] counts the states, then the inputs.
    pub fn linearize_step(
        &self,
        state: &State<D, Quaternion, S>,
        inputs: &Inputs<D, S>,
        dt: f64,
    ) -> Result<StepLinearization<D, S>, DerivativeError<f64>> {
        let [states, by_inputs] = [(); 2].map(|()| Vec::new());
        let [a, b] = [(); 2].map(|()| DMatrix::zeros(0, 0));
        let workspace = StepWorkspace::new();
        let next = state.clone();
        let mut found =
            StepLinearization { state: next, states, inputs: by_inputs, a, b, workspace };
        self.linearize_step_into(state, inputs, dt, &mut found)?;
        Ok(found)
    }

    /// As [`Self::linearize_step`], into what an earlier call returned: its matrices and lists are written, and allocated
    /// again only where they have another size.
    ///
    /// ```
    /// # use nalgebra::{Matrix3, Vector3};
    /// # use precess_dynamics::{Hub, Inputs, ReactionWheel, Spacecraft, State};
    /// # let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// # let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, inertia)])?;
    /// let (mut state, inputs): (State<[ReactionWheel; 1]>, _) = (State::at_rest(), Inputs::none());
    /// let mut kept = craft.linearize_step(&state, &inputs, 0.01)?;
    /// for spin in [10.0, 20.0] {
    ///     state.devices[0].spin = spin;
    ///     craft.linearize_step_into(&state, &inputs, 0.01, &mut kept)?;
    ///     assert_eq!(kept, craft.linearize_step(&state, &inputs, 0.01)?);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::linearize_step`]; state and matrices then have no meaning.
    pub fn linearize_step_into(
        &self,
        state: &State<D, Quaternion, S>,
        inputs: &Inputs<D, S>,
        dt: f64,
        into: &mut StepLinearization<D, S>,
    ) -> Result<(), DerivativeError<f64>> {
        let StepLinearization { state: next, states, inputs: by_inputs, a, b, workspace } = into;
        let StepWorkspace { of_stage, chain, devices } = workspace;
        self.list_variables(inputs, &mut of_stage.moving, [states, by_inputs]);
        set_size(a, states.len(), states.len());
        set_size(b, states.len(), by_inputs.len());
        let lists = (states.as_slice(), by_inputs.as_slice());
        let stages;
        (*next, stages) = self.step_stages(state, inputs, dt)?;
        let into = [&mut *a, &mut *b];
        if self.step_by_devices(inputs, &stages, into, (devices, of_stage)).is_some() {
            return Ok(());
        }
        let mut derivatives = |stage: &_, found: &_, into: IntoColumns<'_, f64>| {
            self.acceleration_columns((stage, inputs), found, lists, into, of_stage)
        };
        self.chained(inputs, (&stages, None), ([a, b], chain), &mut derivatives)
    }

    /// The state after a step, and its stages.
    pub(crate) fn step_stages(
        &self,
        state: &State<D, Quaternion, S>,
        inputs: &Inputs<D, S>,
        dt: f64,
    ) -> Result<WithStages<D, S>, DerivativeError<f64>> {
        let mut stages = Vec::with_capacity(4);
        // The last stage leads to no other.
        let mut offsets = [0.5 * dt, 0.5 * dt, dt, 0.0].into_iter();
        let next = self.stepped(state, inputs, dt, |weight, stage, found, stiffness| {
            self.solve(stage, inputs, found, stiffness)?;
            let times = [weight, offsets.next().unwrap_or_default()];
            stages.push((times, stage.clone(), found.clone()));
            Ok(())
        })?;
        Ok((next, stages))
    }

    /// Writes the derivatives of the state after a step of these stages by the state before it, where those have columns, and
    /// by what is held. Where the state before the step changes with what is held, so: of its changes, by columns.
    pub(crate) fn chained(
        &self,
        inputs: &Inputs<D, S>,
        (stages, changes): (&[StepStage<D, S>], Option<&DMatrix<f64>>),
        ([a, b], workspace): ([&mut DMatrix<f64>; 2], &mut ChainWorkspace),
        derivatives: ByHeld<'_, D, S>,
    ) -> Result<(), DerivativeError<f64>> {
        let accelerations = self.joints().count().saturating_add(S::modes(self)).saturating_add(6);
        let ChainWorkspace { chain, by_states, by_held, moving } = workspace;
        moving.clear();
        Slopes::moving_joints(inputs).for_each(|joint| moving.push(joint));
        set_size(by_states, accelerations, b.nrows());
        set_size(by_held, accelerations, b.ncols());
        let hub = !matches!(inputs.hub, HubMode::Fixed);
        let first =
            stages.first().map_or_else(Quaternion::identity, |(_, stage, _)| stage.attitude);
        let mut last = numbers(first);
        match changes {
            Some(changes) => chain.begin_changes(changes, first, hub),
            None => chain.begin_step([b.nrows(), a.ncols(), b.ncols()], first, hub),
        }
        for (times, stage, found) in stages {
            let slopes = Slopes::new(self, stage, inputs, found, moving);
            chain.begin_stage(stage.attitude, &slopes, accelerations);
            let into = (chain.rows(), [&mut *by_states, &mut *by_held]);
            let written = derivatives(stage, found, into)?;
            let at = StageDerivatives {
                attitude: stage.attitude,
                slopes,
                by_states: (!written).then_some(&*by_states),
                by_held: &*by_held,
            };
            chain.stage(&at, *times);
            turn(&mut last, times, stage);
        }
        chain.finish(last, hub, [&mut *a, &mut *b]);
        let mut columns = columns_of(a).chain(columns_of(b));
        match columns.position(|column| !are_finite(column)) {
            Some(variable) => Err(DerivativeError::NotFinite { variable }),
            None => Ok(()),
        }
    }
}

/// Adds how the attitude turns in a stage.
pub(crate) fn turn<D: Devices<Scalar = f64>, S: StructureData>(
    last: &mut Numbers,
    [weight, _]: &[f64; 2],
    stage: &State<D, Quaternion, S>,
) {
    let turns = rate(numbers(stage.attitude), components(&stage.omega));
    last.iter_mut().zip(turns).for_each(|(to, from)| *to += weight * from);
}

impl<D: WithNumbers<Scalar = f64>> Spacecraft<D> {
    /// Derivatives of the state after a step by parameters of the spacecraft of this hub and these
    /// devices: rows as [`StepLinearization::states`], a column for each variable.
    ///
    /// # Errors
    ///
    /// As [`Self::step`] and [`Self::parameter_derivatives`]; [`DerivativeError::NotFinite`] of the first variable where
    /// a derivative by the state is not finite.
    pub fn step_parameter_derivatives(
        hub: &Hub,
        devices: &D,
        (state, inputs): (&State<D, Quaternion>, &Inputs<D>),
        dt: f64,
        variables: &[ParameterVariable<'_>],
    ) -> Result<DMatrix<f64>, DerivativeError<f64>> {
        let craft = Self::new(hub, devices)?;
        let states: Vec<_> = craft.state_variables(inputs).collect();
        let (mut a, mut b) =
            (DMatrix::zeros(states.len(), 0), DMatrix::zeros(states.len(), variables.len()));
        let (none, mut workspace) = (Outputs::accelerations(), Workspace::new());
        let mut derivatives =
            |stage: &_, found: &_, (product, [by_states, by_held]): IntoColumns<'_, f64>| {
                let at = (stage, inputs);
                let mut no_inputs = DMatrix::zeros(by_states.nrows(), 0);
                let into = (product, [by_states, &mut no_inputs]);
                let lists = (states.as_slice(), [].as_slice());
                let written = craft.acceleration_columns(at, found, lists, into, &mut workspace);
                let written = written.map_err(of_first_variable)?;
                let by = variables.iter().copied();
                let mut columns = by_held.column_iter_mut();
                craft.parameter_columns((hub, devices), at, found, &none, by, |_, column| {
                    let Some(mut to) = columns.next() else { return };
                    to.iter_mut().zip(column.outputs()).for_each(|(to, from)| *to = from);
                })?;
                Ok(written)
            };
        let to = ([&mut a, &mut b], &mut ChainWorkspace::new());
        let (_, stages) = craft.step_stages(state, inputs, dt)?;
        craft.chained(inputs, (&stages, None), to, &mut derivatives)?;
        Ok(b)
    }
}

/// An error of derivatives by the state, through which all columns pass, as that of the first variable.
fn of_first_variable<T>(error: DerivativeError<T>) -> DerivativeError<T> {
    match error {
        DerivativeError::NotFinite { .. } => DerivativeError::NotFinite { variable: 0 },
        error => error,
    }
}
