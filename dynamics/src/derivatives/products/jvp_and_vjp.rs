//! [`Spacecraft::jvp`], [`Spacecraft::vjp`]: products of the derivatives of the accelerations with a direction and with
//! weights, without a matrix and without a heap.
//!
//! With `M a + bias = loads` the accelerations change along a direction by `-M⁻¹` times what the loads change by at given
//! accelerations; `M` is symmetric, so the gradient of `wᵀ a` is that of the loads weighed by `-M⁻¹ w`.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

#[cfg(feature = "alloc")]
use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::column::{Outputs, Results};
use crate::derivatives::dual::point::{Number, Point};
use crate::derivatives::error::DerivativeError;
#[cfg(feature = "alloc")]
use crate::derivatives::linearization::columns_of;
use crate::derivatives::loads::side_by_side::are_finite;
use crate::derivatives::products::joint_order::{HubDirection, HubGradient, all_driven};
use crate::derivatives::products::load_products::{
    AlongDirection, ByWeights, Directed, HubMotion, Weighed,
};
use crate::derivatives::structure::StructureDerivatives;
#[cfg(feature = "alloc")]
use crate::derivatives::variable::Variable;
#[cfg(feature = "alloc")]
use crate::derivatives::workspace::Workspace;
use crate::equations::gravity::Gravity;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::system::Solution;
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{add, components, cross, sub, vector, zeros};
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Accelerations and what they change by along a direction.
type Along<D, S> = (Accelerations<D, S>, Accelerations<D, S>);

/// A gradient: by states, by inputs.
type Gradient<'a, T> = (&'a mut [T], &'a mut [T]);

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// The accelerations, and their derivative along a direction of state and inputs (Jacobian-vector product):
    /// what `c` and `d` of [`Linearization`](crate::Linearization) give times the direction, without them.
    ///
    /// The direction has a number of each of [`Self::state_variables`], the attitude by a small rotation about the axes
    /// of B, and of each of [`Self::input_variables`]. No heap (but that of a list of devices). Costs two evaluations
    /// and the emitted derivatives of the loads; in a central field, with wrenches on bodies, carriers, a flexible
    /// structure or lumped imbalance one more evaluation, in dual numbers.
    ///
    /// ```
    /// # use nalgebra::{Matrix3, Vector3};
    /// use precess_dynamics::{Accelerations, Hub, Inputs, ReactionWheel, Spacecraft, State};
    ///
    /// # let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// # let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, inertia)])?;
    /// let mut state: State<[ReactionWheel; 1]> = State::at_rest();
    /// state.devices[0].spin = 100.0;
    /// let inputs = Inputs::none();
    ///
    /// // A body rate about b_z and a motor torque, 1 rad/s and 1 N m.
    /// let (mut of_state, mut of_inputs) = ([0.0; 14], [0.0; 7]);
    /// (of_state[11], of_inputs[6]) = (1.0, 1.0);
    /// let (_, along) = craft.jvp(&state, &inputs, (&of_state, &of_inputs))?;
    /// assert!((along.omega_dot.y + 20.0 / 9.1).abs() < 1e-15);
    /// assert!((along.omega_dot.x + 1.0 / 9.0).abs() < 1e-15);
    ///
    /// // The gradient of the angular acceleration about b_y.
    /// let mut weights: Accelerations<[ReactionWheel; 1]> = along;
    /// weights.omega_dot = Vector3::y();
    /// (weights.r_b_n_ddot, weights.devices[0].spin_dot) = (Vector3::zeros(), 0.0);
    /// craft.vjp(&state, &inputs, &weights, (&mut of_state, &mut of_inputs))?;
    /// assert!((of_state[11] + 20.0 / 9.1).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`]; [`DerivativeError::Length`] for a direction of other variables,
    /// [`DerivativeError::NotFiniteProduct`], also for a direction that is not finite.
    pub fn jvp<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        direction: (&[D::Scalar], &[D::Scalar]),
    ) -> Result<Along<D, S>, DerivativeError<D::Scalar>> {
        let accelerations = self.accelerations(state, inputs)?;
        let [states, by_inputs] = self.variable_counts(inputs);
        same_length(states, direction.0.len())?;
        same_length(by_inputs, direction.1.len())?;
        check_lists([direction.0, direction.1])?;
        let along = match self.jvp_by_loads(state, inputs, &accelerations, direction) {
            Some(along) => along,
            None => self.jvp_by_dual_numbers(state, inputs, direction)?,
        };
        check_finite(rows(&along))?;
        Ok((accelerations, along))
    }

    /// The accelerations, and the gradient of the sum of them times weights by state and inputs (vector-Jacobian
    /// product): the weights times `c` and `d` of [`Linearization`](crate::Linearization), without them.
    ///
    /// `gradient` becomes the derivatives by [`Self::state_variables`] and by [`Self::input_variables`]. Without a heap
    /// and at the cost of [`Self::jvp`] where that has emitted derivatives; elsewhere (a central field, wrenches on
    /// bodies, carriers, a flexible structure, lumped imbalance) by the matrices, on a heap, or without the feature
    /// `alloc` by the columns of [`Self::derivatives`].
    ///
    /// # Errors
    ///
    /// As [`Self::jvp`], with the weights for the direction; the gradient then has no meaning.
    pub fn vjp<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        weights: &Accelerations<D, S>,
        gradient: Gradient<'_, D::Scalar>,
    ) -> Result<Accelerations<D, S>, DerivativeError<D::Scalar>> {
        let accelerations = self.accelerations(state, inputs)?;
        let (by_states, by_inputs) = gradient;
        let [states, inputs_of] = self.variable_counts(inputs);
        same_length(states, by_states.len())?;
        same_length(inputs_of, by_inputs.len())?;
        same_length(rows(&accelerations).count(), rows(weights).count())?;
        check_finite(rows(weights))?;
        let gradient = (&mut *by_states, &mut *by_inputs);
        if self.vjp_by_loads(state, inputs, &accelerations, weights, gradient).is_none() {
            let gradient = (&mut *by_states, &mut *by_inputs);
            self.vjp_by_columns(state, inputs, &accelerations, weights, gradient)?;
        }
        check_lists([by_states, by_inputs])?;
        Ok(accelerations)
    }

    /// By the matrices of [`Self::linearize`], which has emitted derivatives where products have none.
    #[cfg(feature = "alloc")]
    fn vjp_by_columns<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        weights: &Accelerations<D, S>,
        (by_states, by_inputs): Gradient<'_, D::Scalar>,
    ) -> Result<(), DerivativeError<D::Scalar>> {
        let states: Vec<_> = self.state_variables(inputs).collect();
        let acting: Vec<_> = self.input_variables(inputs).collect();
        let height = rows(accelerations).count();
        let matrix = |columns: &[Variable]| DMatrix::from_element(height, columns.len(), zero());
        let (mut c, mut d) = (matrix(&states), matrix(&acting));
        let (at, lists) = ((state, inputs), (states.as_slice(), acting.as_slice()));
        let (into, outputs) = ([&mut c, &mut d], Outputs::accelerations());
        self.output_columns(at, accelerations, &outputs, lists, into, &mut Workspace::new())?;
        let gradients = [(by_states, c), (by_inputs, d)];
        for (gradient, mut matrix) in gradients {
            for (to, column) in gradient.iter_mut().zip(columns_of(&mut matrix)) {
                let each = column.iter().zip(rows(weights));
                *to = each.fold(zero(), |sum, (value, weight)| sum + *value * weight);
            }
        }
        Ok(())
    }

    /// By the columns of [`Self::derivatives`].
    #[cfg(not(feature = "alloc"))]
    fn vjp_by_columns<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        _: &Accelerations<D, S>,
        weights: &Accelerations<D, S>,
        (by_states, by_inputs): Gradient<'_, D::Scalar>,
    ) -> Result<(), DerivativeError<D::Scalar>> {
        let variables = self.state_variables(inputs).chain(self.input_variables(inputs));
        let mut to = by_states.iter_mut().chain(by_inputs);
        let outputs = Outputs::accelerations();
        self.derivatives(state, inputs, &outputs, variables, |_, column| {
            let each = rows(&column.accelerations).zip(rows(weights));
            let sum = each.fold(zero(), |sum, (value, weight)| sum + value * weight);
            if let Some(to) = to.next() {
                *to = sum;
            }
        })?;
        Ok(())
    }

    /// By one evaluation in dual numbers.
    fn jvp_by_dual_numbers<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        (of_states, of_inputs): (&[D::Scalar], &[D::Scalar]),
    ) -> Result<Accelerations<D, S>, DerivativeError<D::Scalar>> {
        let dual = self.with_numbers(Number::constant);
        let mut at = Point::new(&dual, state, inputs, false);
        let variables = self.state_variables(inputs).chain(self.input_variables(inputs));
        for (variable, multiple) in variables.zip(of_states.iter().chain(of_inputs)) {
            at.seed_multiple(variable, 0, *multiple)?;
        }
        let found = Results::of(&dual, &at, &Outputs::accelerations());
        // Every value is one of the accelerations, which were accepted: what is not finite is a derivative.
        let found = found.map_err(|_| DerivativeError::NotFiniteProduct)?;
        Ok(self.column(&found, 0).accelerations)
    }

    /// By emitted derivatives; none where what acts has none.
    fn jvp_by_loads<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        direction: (&[D::Scalar], &[D::Scalar]),
    ) -> Option<Accelerations<D, S>> {
        let motion = self.motion(state, inputs, accelerations)?;
        let mut joints = D::new_data(&self.devices, &data::Joints);
        let mut along = self.no_accelerations();
        let hub = self.scattered(inputs, direction, &mut joints, &mut along.devices);
        let HubDirection { attitude, omega, given } = hub;
        let loads = self.hub.loads_by_omega(motion.omega, omega);
        let mut visitor = AlongDirection { motion, omega, hub: loads };
        let data = (
            &state.devices,
            inputs.of_joints(),
            &accelerations.devices,
            &joints,
            &mut along.devices,
        );
        D::visit::<Directed, _>(&self.devices, data, &mut visitor).ok()?;
        // The hub falls with the field, which turns in B.
        let field = cross(motion.gravity, attitude);
        let [first, second] = given;
        let (loads, given) = if inputs.hub == HubMode::Free {
            let [force, moment] = visitor.hub;
            ([sub(first, force), sub(second, moment)], None)
        } else {
            let given = Solution { r_b_n_ddot: sub(first, field), omega_dot: second };
            ([zeros(); 2], Some(given))
        };
        let at = (&state.devices, inputs);
        let hub = self.mass_solution(at, loads, given, &mut along.devices).ok()?;
        along.r_b_n_ddot = vector(add(hub.r_b_n_ddot, field));
        along.omega_dot = vector(hub.omega_dot);
        Some(along)
    }

    /// By emitted derivatives; none, and nothing written, where what acts has none.
    fn vjp_by_loads<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        weights: &Accelerations<D, S>,
        gradient: Gradient<'_, D::Scalar>,
    ) -> Option<()> {
        let motion = self.motion(state, inputs, accelerations)?;
        let free = matches!(inputs.hub, HubMode::Free);
        let of_hub = [components(&weights.r_b_n_ddot), components(&weights.omega_dot)];
        let still = Solution { r_b_n_ddot: zeros(), omega_dot: zeros() };
        let mut loads = weights.devices.clone();
        let driven = all_driven(inputs);
        if !driven {
            // A joint whose acceleration is given follows no weight.
            for (load, mode) in loads.values_mut().zip(inputs.modes.values()) {
                if mode != Mode::Driven {
                    *load = zero();
                }
            }
        }
        let at = (&state.devices, inputs);
        let given = if free { None } else { Some(still) };
        let hub = self.mass_solution(at, of_hub, given, &mut loads).ok()?;
        let hub = [hub.r_b_n_ddot, hub.omega_dot];
        let mut joints = D::new_data(&self.devices, &data::Joints);
        let by_omega = self.hub.gradient_by_omega(motion.omega, hub);
        let mut visitor = ByWeights { motion, hub, by_omega, by_hub: of_hub };
        let data =
            (&state.devices, inputs.of_joints(), &accelerations.devices, &mut loads, &mut joints);
        D::visit::<Weighed, _>(&self.devices, data, &mut visitor).ok()?;
        if !driven {
            let weights = weights.devices.values().zip(inputs.modes.values());
            for (load, (weight, mode)) in loads.values_mut().zip(weights) {
                if mode != Mode::Driven {
                    *load = *load + weight;
                }
            }
        }
        let [on_b, _] = of_hub;
        let falls = if free { on_b } else { sub(on_b, visitor.by_hub[0]) };
        let of = HubGradient {
            attitude: cross(falls, motion.gravity),
            omega: visitor.by_omega,
            given: if free { hub } else { visitor.by_hub },
        };
        self.gathered(inputs, &of, &joints, &loads, gradient);
        Some(())
    }

    /// How the hub moves as the kernels need it; none where what acts has no emitted derivatives:
    /// a flexible structure, wrenches on bodies, a central field.
    fn motion<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<HubMotion<D::Scalar>> {
        let central = matches!(inputs.gravity, Gravity::Central { .. });
        let deforms = S::modes(self) > 0 || S::mounts(self) > 0;
        if central || deforms || inputs.bodies.is_some() {
            return None;
        }
        let start = evaluation_start(state, inputs);
        let (omega, gravity) = (start.environment.omega, start.at_b);
        let accelerations = HubAccelerations {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), gravity),
            omega_dot: components(&accelerations.omega_dot),
        };
        Some(HubMotion { omega, accelerations, gravity })
    }
}

/// The accelerations in order, as the rows of `c`.
fn rows<D: Devices, S: StructureDerivatives>(
    of: &Accelerations<D, S>,
) -> impl Iterator<Item = D::Scalar> {
    let hub = [&of.r_b_n_ddot, &of.omega_dot].into_iter().flat_map(components);
    hub.chain(of.devices.values()).chain(S::modal_accelerations(&of.modal).iter().copied())
}

fn same_length<T>(expected: usize, found: usize) -> Result<(), DerivativeError<T>> {
    if found == expected { Ok(()) } else { Err(DerivativeError::Length { expected, found }) }
}

/// As [`check_finite`], several numbers at a time.
fn check_lists<T: Scalar>(lists: [&[T]; 2]) -> Result<(), DerivativeError<T>> {
    if lists.into_iter().all(are_finite) { Ok(()) } else { Err(DerivativeError::NotFiniteProduct) }
}

fn check_finite<T: Scalar>(mut numbers: impl Iterator<Item = T>) -> Result<(), DerivativeError<T>> {
    let finite = numbers.all(Scalar::is_finite);
    if finite { Ok(()) } else { Err(DerivativeError::NotFiniteProduct) }
}
