//! Commands within bounds, by a bounded active set.

use nalgebra::Vector3;

use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{components, scale, sub};
use crate::steering::error::SteeringError;
use crate::steering::law::{Allocation, SteeringLaw, allocation};
use crate::steering::matrix::SteeringMatrix;

impl<T: Scalar, const N: usize> SteeringLaw<T, N> {
    /// [`Self::allocate`] with each command within its bounds, lower and upper.
    ///
    /// Of the commands outside, the one that is furthest out, in units of the width of its bounds, is set to its bound
    /// and the others are inverted again, at most `N` times; where those left are singular, they are clipped as they
    /// were. A command that is at a bound stays there: [`Allocation::torque_error`] is what these commands lack, which
    /// others within the bounds may give.
    ///
    /// # Errors
    ///
    /// As [`Self::allocate`], and [`SteeringError::Argument`] for bounds out of order.
    pub fn allocate_within(
        &self,
        matrix: &SteeringMatrix<T, N>,
        torque: &Vector3<T>,
        bounds: &[[T; 2]; N],
    ) -> Result<Allocation<T, N>, SteeringError<T>> {
        for (index, [lower, upper]) in bounds.iter().enumerate() {
            if !(lower.is_finite() && upper.is_finite() && lower <= upper) {
                let value = if lower.is_finite() { *upper } else { *lower };
                return Err(SteeringError::Argument { what: "bound", index, value });
            }
        }
        let demand = self.demand(matrix, torque)?;
        let mut commands = self.inverted(matrix, &self.weights, demand)?;
        let mut at_bound = [false; N];
        let mut bounded = 0;
        for _ in 0..N {
            let Some((index, bound)) = furthest(&commands, bounds, &at_bound) else { break };
            if let Some((at, command)) = at_bound.get_mut(index).zip(commands.get_mut(index)) {
                (*at, *command) = (true, bound);
            }
            bounded += 1;
            let (mut left, mut weights) = (demand, self.weights);
            let joints = weights.iter_mut().zip(&commands).zip(&matrix.columns).zip(at_bound);
            for (((weight, command), column), _) in joints.filter(|(_, at)| *at) {
                *weight = zero();
                left = sub(left, scale(*command, components(column)));
            }
            let Ok(others) = self.inverted(matrix, &weights, left) else { break };
            for ((command, other), _) in
                commands.iter_mut().zip(others).zip(at_bound).filter(|(_, at)| !*at)
            {
                *command = other;
            }
        }
        for ((command, [lower, upper]), at) in commands.iter_mut().zip(bounds).zip(at_bound) {
            let within = if *command < *lower { *lower } else { *command };
            let within = if within > *upper { *upper } else { within };
            bounded += usize::from(!at && within != *command);
            *command = within;
        }
        allocation(matrix, commands, demand, bounded)
    }
}

/// The command that is furthest outside its bounds, and the bound that it is outside of.
fn furthest<T: Scalar, const N: usize>(
    commands: &[T; N],
    bounds: &[[T; 2]; N],
    at_bound: &[bool; N],
) -> Option<(usize, T)> {
    let mut found: Option<(usize, T, T)> = None;
    let free = commands.iter().zip(bounds).zip(at_bound).enumerate();
    for (index, ((command, [lower, upper]), _)) in free.filter(|(_, (_, at))| !**at) {
        let (out, bound) = if *command < *lower {
            (*lower - *command, *lower)
        } else if *command > *upper {
            (*command - *upper, *upper)
        } else {
            continue;
        };
        let width = *upper - *lower;
        let share = if width > zero() { out * width.recip() } else { out };
        if found.is_none_or(|(_, most, _)| share > most) {
            found = Some((index, share, bound));
        }
    }
    found.map(|(index, _, bound)| (index, bound))
}
