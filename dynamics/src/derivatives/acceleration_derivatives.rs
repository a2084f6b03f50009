//! [`AccelerationDerivatives`]: the derivatives of the accelerations by states and inputs, and nothing else.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::column::Outputs;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::linearization::{set_size, zeros};
use crate::derivatives::slopes::Slopes;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::Variable;
use crate::derivatives::workspace::Workspace;
use crate::numbers::each::Each;
use crate::sets::devices::Devices;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, StructureData};

/// Accelerations with their derivatives by all states and inputs: `c` and `d` of a
/// [`Linearization`](crate::Linearization) of [`Outputs::accelerations`].
///
/// Rows are the acceleration of B and the angular acceleration of the hub, B axes, m/s² and rad/s², the accelerations of the
/// joints, and those of the modes of a flexible structure.
#[derive(Clone, Debug, PartialEq)]
pub struct AccelerationDerivatives<D: Devices, S: StructureData = Rigid> {
    /// The accelerations at the state.
    pub accelerations: Accelerations<D, S>,
    /// The columns of `by_states`; in the order of [`Spacecraft::state_variables`].
    pub states: Vec<Variable>,
    /// The columns of `by_inputs`; in the order of [`Spacecraft::input_variables`].
    pub inputs: Vec<Variable>,
    /// Derivatives by the states.
    pub by_states: DMatrix<D::Scalar>,
    /// Derivatives by the inputs.
    pub by_inputs: DMatrix<D::Scalar>,
    workspace: Workspace<D::Scalar>,
}

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// The derivatives of the accelerations by states and inputs: what [`Self::linearize`] has in `c` and `d`, without
    /// the matrices of the states.
    ///
    /// # Errors
    ///
    /// As [`Self::derivatives`].
    pub fn acceleration_derivatives<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Result<AccelerationDerivatives<D, S>, DerivativeError<D::Scalar>> {
        let [by_states, by_inputs] = [(); 2].map(|()| zeros(0, 0));
        let mut found = AccelerationDerivatives {
            accelerations: self.no_accelerations(),
            states: Vec::new(),
            inputs: Vec::new(),
            by_states,
            by_inputs,
            workspace: Workspace::new(),
        };
        self.acceleration_derivatives_into(state, inputs, &mut found)?;
        Ok(found)
    }

    /// As [`Self::acceleration_derivatives`], into what an earlier call returned: allocated again only where it has another
    /// size.
    ///
    /// ```
    /// # use nalgebra::{Matrix3, Vector3};
    /// # use precess_dynamics::{Hub, Inputs, Outputs, ReactionWheel, Spacecraft, State};
    /// # let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// # let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, inertia)])?;
    /// let (mut state, inputs): (State<[ReactionWheel; 1]>, _) = (State::at_rest(), Inputs::none());
    /// let mut kept = craft.acceleration_derivatives(&state, &inputs)?;
    /// state.devices[0].spin = 10.0;
    /// craft.acceleration_derivatives_into(&state, &inputs, &mut kept)?;
    /// let whole = craft.linearize(&state, &inputs, &Outputs::accelerations())?;
    /// assert_eq!((kept.by_states, kept.by_inputs), (whole.c, whole.d));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::derivatives`]; the matrices then have no meaning.
    pub fn acceleration_derivatives_into<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        into: &mut AccelerationDerivatives<D, S>,
    ) -> Result<(), DerivativeError<D::Scalar>> {
        let AccelerationDerivatives { accelerations, states, by_states, by_inputs, .. } = into;
        let (lists, Workspace { loads, moving, .. }) = (&mut into.inputs, &mut into.workspace);
        *accelerations = self.accelerations(state, inputs)?;
        self.list_variables(inputs, moving, [states, lists]);
        let joints = accelerations.devices.values().count();
        let rows = joints.saturating_add(S::modes(self)).saturating_add(6);
        set_size(by_states, rows, states.len());
        set_size(by_inputs, rows, lists.len());
        let (at, outputs) = ((state, inputs), Outputs::accelerations());
        let slopes = Slopes::new(self, state, inputs, accelerations, moving);
        let emitted = self.emitted(at, accelerations, &outputs, loads);
        let matrices = [&mut *by_states, &mut *by_inputs];
        if let Some(emitted) = &emitted
            && emitted.fill_accelerations(&slopes, matrices)
        {
            return Ok(());
        }
        let lists = (states.as_slice(), lists.as_slice());
        self.columns_by(emitted, at, &outputs, lists, [by_states, by_inputs])
    }
}
