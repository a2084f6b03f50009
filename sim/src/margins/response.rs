//! What loads and torques of motors do to a [`ControlledPlant`] at a frequency, and what its outputs are.
//!
//! With `x' = v` the states are `[x_kept; v]`, and at `exp(i w t)`
//!
//! ```text
//! (i w 1 - A_vv - A_vx / (i w)) v = a      x = v / (i w)
//! ```
//!
//! for accelerations a: half as many equations as there are states.

use nalgebra::linalg::LU;
use nalgebra::{Complex, DMatrix, Dyn};

use super::plant::{ControlledPlant, TRANSLATION};
use crate::structure::Fault;
use crate::structure::accelerance::{ComplexMatrix, complex};

/// The equations of a plant at one frequency, factored.
pub(super) struct AtFrequencyOf<'a> {
    plant: &'a ControlledPlant,
    /// rad/s.
    frequency: f64,
    factors: LU<Complex<f64>, Dyn, Dyn>,
}

impl ControlledPlant {
    /// The equations at an angular frequency, rad/s, other than zero.
    pub(super) fn at_frequency(&self, frequency: f64) -> AtFrequencyOf<'_> {
        let (first, size) = (self.kept.len(), self.size);
        let by_place = Complex::new(0.0, frequency).inv();
        let mut system = -complex(&self.a.view((first, first), (size, size)).into_owned());
        for (index, at) in self.kept.iter().enumerate() {
            let own = self.a.view((first, index), (size, 1));
            let mut column = system.column_mut(*at);
            column.zip_apply(&own, |to, element| *to -= by_place * element);
        }
        for k in 0..size {
            system[(k, k)] += Complex::new(0.0, frequency);
        }
        AtFrequencyOf { plant: self, frequency, factors: system.lu() }
    }
}

impl AtFrequencyOf<'_> {
    /// The motion with held motors under loads on all coordinates, columns of states.
    ///
    /// # Errors
    /// [`Fault::Unbounded`] at a resonance without damping.
    pub(super) fn forced(&self, loads: &ComplexMatrix) -> Result<ComplexMatrix, Fault> {
        self.solved(complex(&self.plant.inverse) * (complex(&self.plant.reduced) * loads))
    }

    /// The motion under torques of the motors, columns of states.
    ///
    /// # Errors
    /// [`Fault::Unbounded`] at a resonance without damping.
    pub(super) fn driven(&self, torques: &ComplexMatrix) -> Result<ComplexMatrix, Fault> {
        let (first, size) = (self.plant.kept.len(), self.plant.size);
        let by_torque: DMatrix<f64> = self.plant.b.rows(first, size).into_owned();
        self.solved(complex(&by_torque) * torques)
    }

    fn solved(&self, mut rates: ComplexMatrix) -> Result<ComplexMatrix, Fault> {
        let fault = Fault::Unbounded { frequency: self.frequency };
        let solved = self.factors.solve_mut(&mut rates);
        if !(solved && rates.iter().all(|value| value.re.is_finite() && value.im.is_finite())) {
            return Err(fault);
        }
        let kept = &self.plant.kept;
        let mut states = ComplexMatrix::zeros(kept.len() + rates.nrows(), rates.ncols());
        let by_place = Complex::new(0.0, self.frequency).inv();
        for (row, at) in kept.iter().enumerate() {
            states.row_mut(row).copy_from(&(rates.row(*at) * by_place));
        }
        states.rows_mut(kept.len(), rates.nrows()).copy_from(&rates);
        Ok(states)
    }

    /// Outputs of motions, columns of states, under loads on all coordinates.
    pub(super) fn outputs(&self, states: &ComplexMatrix, loads: &ComplexMatrix) -> ComplexMatrix {
        let plant = self.plant;
        let rates = states.rows(plant.kept.len(), plant.size).into_owned();
        let (by_rate, t) = (Complex::new(0.0, self.frequency).inv(), TRANSLATION);
        let places = &rates * by_rate;
        let [by_acceleration, of_rates, of_places, of_load] =
            plant.translation.each_ref().map(complex);
        let accelerations = &rates * Complex::new(0.0, self.frequency);
        let moved = by_acceleration * accelerations
            + of_rates * &rates
            + of_places * &places
            + of_load * loads.rows(0, t);
        let mut all = ComplexMatrix::zeros(t + plant.size, states.ncols());
        all.rows_mut(0, t).copy_from(&(moved * (by_rate * by_rate)));
        all.rows_mut(t, plant.size).copy_from(&places);
        complex(&plant.outputs) * all
    }
}
