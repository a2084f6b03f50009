//! [`Spacecraft::linearize_fixed`]: the matrices A and B in memory of the caller, without a heap.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::loads::by_loads::ByLoads;
use crate::derivatives::loads::fixed_columns::FixedColumns;
use crate::derivatives::loads::side_by_side::{Finiteness, are_finite};
use crate::derivatives::slopes::Slopes;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::Variable;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// What [`Spacecraft::linearize_fixed`] writes besides its results, of a spacecraft of so many joints, or fewer: some 500
/// bytes a joint and 4 KiB, in `f64`. It has no meaning between calls.
#[derive(Clone, Debug)]
pub struct LinearizationWorkspace<T, const JOINTS: usize> {
    columns: FixedColumns<T, JOINTS>,
    /// The joints that are not locked, first.
    moving: [usize; JOINTS],
    /// The accelerations of the joints by one variable.
    accelerations: [T; JOINTS],
}

impl<T: Scalar, const JOINTS: usize> LinearizationWorkspace<T, JOINTS> {
    /// A new one: a constant, which a `static` can be.
    #[must_use]
    pub const fn new() -> Self {
        let (moving, accelerations) = ([0; JOINTS], [T::ZERO; JOINTS]);
        Self { columns: FixedColumns::none(), moving, accelerations }
    }
}

impl<T: Scalar, const JOINTS: usize> Default for LinearizationWorkspace<T, JOINTS> {
    fn default() -> Self {
        Self::new()
    }
}

impl<D: Devices, S: StructureDerivatives> Spacecraft<D, S> {
    /// The matrices A and B of the spacecraft linearised about a state and inputs, `x' = f(x0, u0) + A (x - x0) +
    /// B (u - u0)`, without a heap, for estimators and controllers on board: what `linearize_into` (feature `alloc`) computes,
    /// number by number. Returns the accelerations.
    ///
    /// `a` has as many rows and columns as there are [states](Self::state_variables), `b` as many rows and a column of each
    /// [input](Self::input_variables); both column by column, as nalgebra's matrices are. Of a free hub with `n` driven
    /// joints they have `12 + 2 n` rows, and `12 + 2 n` and `6 + n` columns.
    ///
    /// Of a rigid hub with devices, in a uniform field or none, by the emitted derivatives of the loads (feature
    /// `derivatives`). Elsewhere there are the columns of [`Self::derivatives`], by dual numbers and several times slower: which
    /// of the two a program links is stated by which it calls.
    ///
    /// ```
    /// # use nalgebra::{Matrix3, SMatrix, Vector3};
    /// # use precess_dynamics::{Hub, Inputs, LinearizationWorkspace, ReactionWheel, Spacecraft, State};
    /// # let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// # let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, inertia)])?;
    /// let (mut state, inputs): (State<[ReactionWheel; 1]>, _) = (State::at_rest(), Inputs::none());
    /// state.devices[0].spin = 100.0;
    ///
    /// let mut workspace = LinearizationWorkspace::<f64, 1>::new();
    /// let (mut a, mut b) = (SMatrix::<f64, 14, 14>::zeros(), SMatrix::<f64, 14, 7>::zeros());
    /// let into = [a.as_mut_slice(), b.as_mut_slice()];
    /// craft.linearize_fixed(&state, &inputs, into, &mut workspace)?;
    /// // The gyroscopic torque of 20 N m s about b_x on 9.1 kg m² about b_y; 1 / 9.1 kg m² about b_y.
    /// assert!((a[(10, 11)] + 20.0 / 9.1).abs() < 1e-15 && (b[(10, 4)] - 1.0 / 9.1).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`DerivativeError::Solve`] as [`Self::accelerations`] rejects the state, [`DerivativeError::Size`] for a matrix of
    /// another size and a workspace of fewer joints, [`DerivativeError::NotEmitted`] where there are no emitted derivatives,
    /// [`DerivativeError::NotFinite`] for an element that is not finite; the matrices then have no meaning.
    pub fn linearize_fixed<A: Attitude<D::Scalar>, const JOINTS: usize>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        [a, b]: [&mut [D::Scalar]; 2],
        workspace: &mut LinearizationWorkspace<D::Scalar, JOINTS>,
    ) -> Result<Accelerations<D, S>, DerivativeError<D::Scalar>> {
        let accelerations = self.accelerations(state, inputs)?;
        let joints = inputs.modes.values().count();
        let LinearizationWorkspace { columns, moving, accelerations: of_joints } = workspace;
        let of_joints = of_joints.get_mut(..joints);
        let of_joints =
            of_joints.ok_or(DerivativeError::Size { expected: joints, found: JOINTS })?;
        let mut count = 0_usize;
        for (to, joint) in moving.iter_mut().zip(Slopes::moving_joints(inputs)) {
            *to = joint;
            count = count.saturating_add(1);
        }
        let moving = moving.get(..count).unwrap_or_default();
        let slopes = &Slopes::new(self, state, inputs, &accelerations, moving);
        let rows = slopes.states();
        let by_inputs = self.input_variables(inputs).count();
        for (matrix, columns) in [(&*a, rows), (&*b, by_inputs)] {
            let (expected, found) = (rows.saturating_mul(columns), matrix.len());
            if expected != found {
                return Err(DerivativeError::Size { expected, found });
            }
        }
        let loads = ByLoads::in_arrays(self, state, inputs, &accelerations, columns);
        let loads = &loads.ok_or(DerivativeError::NotEmitted)?;
        let mut columns = Columns { loads, slopes, of_joints, finite: Finiteness::of_none() };
        let mut to = a.chunks_exact_mut(rows.max(1)).chain(b.chunks_exact_mut(rows.max(1)));
        let variables = self.state_variables(inputs).chain(self.input_variables(inputs));
        variables.for_each(|variable| {
            if let Some(to) = to.next() {
                columns.fill(variable, to);
            }
        });
        if !columns.finite.holds() {
            let mut found = a.chunks_exact(rows.max(1)).chain(b.chunks_exact(rows.max(1)));
            if let Some(variable) = found.position(|column| !are_finite(column)) {
                return Err(DerivativeError::NotFinite { variable });
            }
        }
        Ok(accelerations)
    }
}

/// Columns of both matrices, one after another.
struct Columns<'a, T> {
    loads: &'a ByLoads<'a, T, 1>,
    slopes: &'a Slopes<'a, T>,
    /// The accelerations of the joints by one variable.
    of_joints: &'a mut [T],
    finite: Finiteness<T>,
}

impl<T: Scalar> Columns<'_, T> {
    /// The column of a variable.
    // Never inlined: one copy for states and inputs of all sets.
    #[inline(never)]
    fn fill(&mut self, variable: Variable, to: &mut [T]) {
        let Self { loads, slopes, of_joints, finite } = self;
        let mut hub = [zero(); 6];
        if loads.fill_column(variable, (&mut hub, of_joints), finite) {
            slopes.of_hub_and_others(&hub, of_joints, to);
        } else {
            to.fill(zero());
        }
        slopes.of_variable(variable, to);
        // Turned into the axes of N, numbers may overflow that did not before.
        if slopes.hub
            && let Some([.., x, y, z]) = to.first_chunk::<9>()
        {
            finite.see(&[*x, *y, *z]);
        }
    }
}
