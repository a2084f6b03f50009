//! [`Spacecraft::derivatives`]: columns by state and inputs, some at a time, without a heap.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::column::{Column, Outputs, Results};
use crate::derivatives::dual::point::{Number, Point, WIDTH};
use crate::derivatives::error::DerivativeError;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::Variable;
use crate::equations::error::SolveError;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// Derivatives of the accelerations, and of what `outputs` names, by some variables: `column` is
    /// called with each variable and its derivatives, in the order of `variables`. Returns the
    /// accelerations.
    ///
    /// The derivatives are exact to rounding: the solver computes them beside the values, by
    /// [`Dual`](crate::Dual) numbers through the same kernels, six variables an evaluation, without
    /// a heap. Spring, damper and friction are differentiated as
    /// [`Passive`](crate::Passive) states them, dry friction by its smooth law. A joint that is
    /// locked and a hub that is fixed have derivatives by their rates, too: those of a joint or hub
    /// that keeps its rate.
    ///
    /// ```
    /// # use nalgebra::{Matrix3, Vector3};
    /// use precess_dynamics::{Axis, Hub, Inputs, Outputs, ReactionWheel, Spacecraft, State, Variable};
    ///
    /// # let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// # let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, inertia)])?;
    /// let mut state: State<[ReactionWheel; 1]> = State::at_rest();
    /// state.devices[0].spin = 100.0;
    /// let inputs = Inputs::none();
    ///
    /// // The gyroscopic torque of 20 N m s about b_x on 9.1 kg m² about b_y.
    /// let by = [Variable::Omega(Axis::Z), Variable::Motor(0)];
    /// let outputs = Outputs::accelerations();
    /// craft.derivatives(&state, &inputs, &outputs, by, |variable, column| {
    ///     if variable == Variable::Omega(Axis::Z) {
    ///         assert!((column.accelerations.omega_dot.y + 20.0 / 9.1).abs() < 1e-15);
    ///     }
    /// })?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`DerivativeError::Solve`] as [`Self::accelerations`] (and [`Self::momentum`],
    /// [`Self::loads`]) rejects the state, [`DerivativeError::NoSuchJoint`],
    /// [`DerivativeError::NoSuchMode`], [`DerivativeError::NoSuchMount`] and
    /// [`DerivativeError::NotAnInput`] for a variable that does not exist,
    /// [`DerivativeError::NotFinite`] for a derivative that is not finite. Columns before the error
    /// have been given.
    pub fn derivatives<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        outputs: &Outputs<D::Scalar>,
        variables: impl IntoIterator<Item = Variable>,
        mut column: impl FnMut(Variable, &Column<D, S>),
    ) -> Result<Accelerations<D, S>, DerivativeError<D::Scalar>> {
        let accelerations = self.checked(state, inputs, outputs)?;
        let dual = self.with_numbers(Number::constant);
        let mut variables = variables.into_iter().fuse();
        let (plain, mut with_wrenches) = (Point::new(&dual, state, inputs, false), None);
        let mut first = 0_usize;
        loop {
            let some = [(); WIDTH].map(|()| variables.next());
            let by = || some.iter().flatten().copied();
            if by().next().is_none() {
                break;
            }
            let start = if by().any(is_wrench) {
                with_wrenches.get_or_insert_with(|| Point::new(&dual, state, inputs, true))
            } else {
                &plain
            };
            let mut at = start.clone();
            for (number, variable) in by().enumerate() {
                self.check_input(variable)?;
                at.seed(variable, number)?;
            }
            let results = Results::of(&dual, &at, outputs).map_err(|error| {
                let alone = |variable: &Variable| {
                    let mut at = start.clone();
                    at.seed(*variable, 0).is_ok() && Results::of(&dual, &at, outputs).is_err()
                };
                not_finite(error, first, by().position(|variable| alone(&variable)))
            })?;
            for (number, variable) in by().enumerate() {
                column(variable, &self.column(&results, number));
            }
            first = first.saturating_add(WIDTH);
        }
        Ok(accelerations)
    }

    /// The accelerations, once everything that is differentiated has a value.
    pub(crate) fn checked<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        outputs: &Outputs<D::Scalar>,
    ) -> Result<Accelerations<D, S>, SolveError<D::Scalar>> {
        let accelerations = self.accelerations(state, inputs)?;
        if let Some(about) = outputs.momentum {
            self.energy_and_momentum(state, about)?;
        }
        if let Some(axes) = outputs.loads {
            self.loads(state, inputs, &accelerations, axes)?;
        }
        Ok(accelerations)
    }

    /// Rejects the acceleration of a joint that its kind does not drive.
    fn check_input(&self, variable: Variable) -> Result<(), DerivativeError<D::Scalar>> {
        let Variable::Acceleration(joint) = variable else { return Ok(()) };
        match self.joints().nth(joint) {
            Some((_, info)) if !info.driven => Err(DerivativeError::NotAnInput { variable }),
            _ => Ok(()),
        }
    }
}

/// Whether a variable is of a wrench on a body.
fn is_wrench(variable: Variable) -> bool {
    matches!(variable, Variable::BodyForce(..) | Variable::BodyMoment(..))
}

/// What an error in dual numbers is: every value is finite, so what overflows is a derivative.
/// `first` is the place in the list of the evaluation's first variable, `number` that of the one at
/// fault after it.
pub(crate) fn not_finite<T: crate::Scalar>(
    error: SolveError<Number<T>>,
    first: usize,
    number: Option<usize>,
) -> DerivativeError<T> {
    let error = match error {
        SolveError::Overflow { .. } => {
            let variable = first.saturating_add(number.unwrap_or_default());
            return DerivativeError::NotFinite { variable };
        }
        SolveError::NotFinite { what, value } => SolveError::NotFinite { what, value: value.value },
        SolveError::Singular { device, joint, pivot, bound } => {
            SolveError::Singular { device, joint, pivot: pivot.value, bound: bound.value }
        }
        SolveError::LockedJointMoves { device, joint, rate } => {
            SolveError::LockedJointMoves { device, joint, rate: rate.value }
        }
        SolveError::FixedHubMoves { value } => SolveError::FixedHubMoves { value: value.value },
        SolveError::NotDriven { device, joint } => SolveError::NotDriven { device, joint },
        SolveError::AtCentre => SolveError::AtCentre,
        SolveError::Count { expected, found } => SolveError::Count { expected, found },
        SolveError::Unstable { device, joint, dt, longest } => {
            SolveError::Unstable { device, joint, dt: dt.value, longest: longest.value }
        }
        SolveError::ModalMass { pivot, bound } => {
            SolveError::ModalMass { pivot: pivot.value, bound: bound.value }
        }
        SolveError::UnstableModes { dt, longest } => {
            SolveError::UnstableModes { dt: dt.value, longest: longest.value }
        }
        SolveError::ModalCount { expected, found } => SolveError::ModalCount { expected, found },
    };
    DerivativeError::Solve(error)
}
