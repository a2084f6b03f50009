//! [`AtSamples`]: what acts with `exp(i w t)` through the samples of a loop, solved once for all that samples show alike.

use nalgebra::linalg::LU;
use nalgebra::{Complex, Dyn};

use super::analysis::ControlLoop;
use super::measurement::READ;
use super::response::AtFrequencyOf;
use super::sampled::{Forced, at};
use crate::structure::Fault;
use crate::structure::accelerance::{ComplexMatrix, complex};

/// The loop at `z = exp(i w T)`, factored: the same for all frequencies that are whole multiples of the rate apart.
pub(super) struct AtSamples<'a> {
    of: &'a ControlLoop,
    /// The plant by the torque of the law, and the feedback's `B`, `C`, `D`.
    by_torque: ComplexMatrix,
    feedback: [ComplexMatrix; 3],
    factors: LU<Complex<f64>, Dyn, Dyn>,
}

/// What the loop does at the samples, a column for each that acts.
pub(super) struct Sampled {
    /// States of the plant with all that is given and waits.
    pub(super) states: ComplexMatrix,
    /// The torque of the law behind its filters, N m.
    pub(super) torque: ComplexMatrix,
}

impl ControlLoop {
    /// At an angular frequency, rad/s.
    pub(super) fn at_samples(&self, w: f64) -> AtSamples<'_> {
        let z = Complex::from_polar(1.0, w * self.samples.sampling.period);
        let feedback = self.with_all.feedback();
        let feedback = [&feedback.b, &feedback.c, &feedback.d].map(complex);
        let [_, by_torque, _] = self.with_all.plant().with_waiting();
        let factors = at(z, self.with_all.state_matrix()).lu();
        AtSamples { of: self, by_torque: complex(&by_torque), feedback, factors }
    }

    /// Loads `exp(i w t)` on all coordinates; whether the servo knows them.
    pub(super) fn forced(
        &self,
        plant: &AtFrequencyOf<'_>,
        (frequency, loads): (f64, &ComplexMatrix),
        known: bool,
    ) -> Result<Forced, Fault> {
        let reduced = complex(&self.plant.reduced) * loads;
        let none = Complex::new(0.0, 0.0);
        Ok(Forced {
            frequency,
            known: if known { reduced } else { reduced * none },
            states: plant.forced(loads)?,
            noise: ComplexMatrix::zeros(READ, loads.ncols()),
        })
    }

    /// Torques of motors at an angular frequency, rad/s, that samples show as that of what acts.
    pub(super) fn torques_at(
        &self,
        of: &Forced,
        (image, sampled): (f64, &Sampled),
    ) -> ComplexMatrix {
        self.samples.torques_at(of, (image, &sampled.states, &sampled.torque))
    }
}

impl AtSamples<'_> {
    /// What the loop does; none at a pole of it on the unit circle.
    pub(super) fn through(&self, forced: &Forced) -> Option<Sampled> {
        let of = self.of;
        let read = of.samples.read_at_once(forced);
        let [b, c, d] = &self.feedback;
        let (own, states) = (self.by_torque.nrows(), b.nrows());
        let mut found = ComplexMatrix::zeros(own + states, read.ncols());
        let added = of.samples.driven_by(forced);
        found.rows_mut(0, added.nrows()).copy_from(&added);
        let mut by_read = found.rows_mut(0, own);
        by_read += &self.by_torque * (d * &read);
        found.rows_mut(own, states).copy_from(&(b * &read));
        let solved = self.factors.solve_mut(&mut found);
        if !(solved && found.iter().all(|value| value.re.is_finite() && value.im.is_finite())) {
            return None;
        }
        let of_plant = found.rows(0, added.nrows()).into_owned();
        let read = of.samples.read(forced, &of_plant);
        let torque = c * found.rows(own, states) + d * read;
        Some(Sampled { states: of_plant, torque })
    }
}
