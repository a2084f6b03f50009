//! Why an evaluation failed: the first input that is not finite, or what overflowed though every input is.

use crate::attitude::parameterisation::Attitude;
use crate::equations::arithmetic::Arithmetic;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::gravity::Gravity;
use crate::equations::system::Solution;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{components, extreme, finite, zeros};
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::accelerations::{check_fixed, evaluation_start};
use crate::solve::elimination::back_substitute;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::solve::structure::StructureEquations;

impl<D: Devices, S: StructureEquations> Spacecraft<D, S> {
    /// What to report for a failed evaluation: an input that is not finite explains everything
    /// else, and a pivot that is not finite is an overflow, not a singularity.
    #[cold]
    pub(crate) fn diagnosis<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        failure: SolveError<D::Scalar>,
    ) -> SolveError<D::Scalar> {
        if matches!(failure, SolveError::Count { .. }) {
            return failure;
        }
        if let Err(not_finite) = self.reject(state, inputs) {
            return not_finite;
        }
        self.cause(state, inputs, failure)
    }

    /// What to report for a failed evaluation of finite inputs.
    #[cold]
    pub(crate) fn cause<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        failure: SolveError<D::Scalar>,
    ) -> SolveError<D::Scalar> {
        match failure {
            SolveError::UnstableModes { .. } => failure,
            SolveError::ModalMass { pivot, bound } if pivot.is_finite() && bound.is_finite() => {
                failure
            }
            SolveError::ModalMass { .. } => {
                SolveError::Overflow { what: Quantity::ModalAcceleration }
            }
            _ if matches!(inputs.gravity, Gravity::Central { .. })
                && extreme(components(&state.r_b_n)) == zero() =>
            {
                SolveError::AtCentre
            }
            SolveError::Singular { device: Some(device), joint: Some(joint), pivot, bound }
                if !(pivot.is_finite() && bound.is_finite()) =>
            {
                SolveError::Overflow { what: Quantity::JointAcceleration { device, joint } }
            }
            SolveError::Singular { pivot, bound, .. }
                if !(pivot.is_finite() && bound.is_finite()) =>
            {
                SolveError::Overflow { what: self.overflowing(state, inputs) }
            }
            SolveError::Overflow { what: Quantity::HubAcceleration } => {
                SolveError::Overflow { what: self.overflowing(state, inputs) }
            }
            failure => failure,
        }
    }

    /// The acceleration whose terms overflow: the hub's where those of the hub itself do, else that
    /// of the first device with one that is not finite on a hub that does not accelerate, of the
    /// joint nearest the tip, which was eliminated first.
    fn overflowing<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Quantity {
        let joint = || -> Result<Option<Quantity>, SolveError<D::Scalar>> {
            check_fixed(state, inputs)?;
            let environment = evaluation_start(state, inputs).environment;
            let (mut assembly, mut scratch) =
                (self.assembly(inputs), D::new_data(&self.devices, &data::Gains));
            let of_hub = assembly.system(environment.omega);
            if !(finite(of_hub.h_v) && finite(of_hub.h_w)) {
                return Ok(None);
            }
            let given = inputs.of_joints();
            self.eliminate_devices(
                Arithmetic::detected(),
                state,
                given,
                &environment,
                &mut assembly,
                &mut scratch,
            )?;
            let still = Solution { r_b_n_ddot: zeros(), omega_dot: zeros() };
            let mut found = D::new_data(&self.devices, &data::Accelerations);
            back_substitute::<D>(&self.devices, &scratch, &still, &mut found);
            let joints = found.values().zip(self.joints());
            let mut joints = joints.filter(|(value, _)| !value.is_finite()).map(|(_, joint)| joint);
            let first = joints.next();
            let last = first.map(|(device, _)| joints.take_while(move |(of, _)| *of == device));
            let joint = last.and_then(Iterator::last).or(first);
            Ok(joint.map(|(device, info)| Quantity::JointAcceleration { device, joint: info.body }))
        };
        joint().ok().flatten().unwrap_or(Quantity::HubAcceleration)
    }
}

/// An acceleration is not finite; [`Spacecraft::diagnosis`] finds which.
pub(crate) fn overflow<T>() -> SolveError<T> {
    SolveError::Overflow { what: Quantity::HubAcceleration }
}
