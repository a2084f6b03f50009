//! How the forces of a suspension change with the coordinates of its platform and with their rates: (I9) in dual numbers.

use crate::equations::suspension_forces::Six;
use crate::isolation::parameters::Platform;
use crate::isolation::records::Joints;
use crate::isolation::suspension::Suspension;
use crate::model::kernels::Kernels;
use crate::numbers::dual::Dual;
use crate::numbers::each::JointStates;
use crate::numbers::real::{Scalar, one, zero};

/// A number with its derivatives by six coordinates, or by six rates.
type Number<T> = Dual<T, 6>;

impl<T: Scalar> Suspension<T> {
    /// Derivatives of the forces by coordinates and by rates, each by columns.
    pub(crate) fn slopes(&self, joints: &Joints<T>) -> [[Six<T>; 6]; 2] {
        if self.coupled.is_none() && self.struts.iter().all(Option::is_none) {
            return [[[zero(); 6]; 6]; 2];
        }
        let over = self.map(Number::constant);
        let constant =
            Platform::<T>::zip_joints(joints, joints, |number, _| Number::constant(number));
        [0, 1].map(|which: usize| {
            let mut seeded = constant;
            for (number, state) in seeded.states_mut().enumerate() {
                if let Some(of) = state.into_iter().nth(which) {
                    of.add_derivative(number, one());
                }
            }
            let forces = over.forces(&Platform::<T>::pose(&seeded), &seeded);
            let sums = forces.springs.iter().zip(&forces.dampers).map(|(a, b)| *a + *b);
            let mut columns = [[zero(); 6]; 6];
            for (row, sum) in sums.enumerate() {
                for (number, column) in columns.iter_mut().enumerate() {
                    if let Some(to) = column.get_mut(row) {
                        *to = sum.derivative(number);
                    }
                }
            }
            columns
        })
    }
}
