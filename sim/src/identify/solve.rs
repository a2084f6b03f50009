//! Maximum of the likelihood by Gauss and Newton's steps, damped as by Levenberg and Marquardt, over longer and longer
//! parts of the record.
//!
//! The angle of a wheel at the end of a record depends on its rate and friction many radians, and far from the truth the
//! likelihood has other maxima. So the first part is [`SHORTEST`] long and each next one twice as long as the one before: from the
//! solution of one, the angle at the end of the next is known to a fraction of a turn. In parts, what has no prior is held
//! near its first value by its scale; in the whole record it is not.

use nalgebra::{DMatrix, DVector};

use super::component::{Component, Target};
use super::error::IdentifyError;
use super::model::Model;
use super::noise::SensorNoise;
use super::pass::Pass;
use super::timeline::Timeline;
use crate::scenario::Scenario;

/// The first part of a record, s.
const SHORTEST: f64 = 2.0;
/// Steps of a part, and of the whole record.
const STEPS: [usize; 2] = [12, 30];
/// Converged: the square of the step by its covariance, of a part and of the whole record.
const SETTLED: [f64; 2] = [0.1, 1e-5];
/// A prediction of the decrease that falls below this share of the cost is rounding.
const ROUNDING: f64 = 1e-13;
/// Damping, of variables of unit scale: first, factor, largest.
const DAMPING: f64 = 1e-6;
const FACTOR: f64 = 10.0;
const DAMPING_MAX: f64 = 1e9;

/// Information, of variables of unit scale, from which a direction is told.
pub(super) const TOLD: f64 = 1.0;

/// Where it is, for the one who waits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The part of the record, s, and the whole.
    pub part: [f64; 2],
    /// The step, from 1.
    pub step: usize,
    /// The time in it, s.
    pub time: f64,
}

/// A maximum.
pub(super) struct Solution {
    pub(super) values: Vec<f64>,
    pub(super) pass: Pass,
    /// Steps over the whole record.
    pub(super) steps: usize,
}

/// What is solved.
pub(super) struct Estimation<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) components: &'a [Component],
    pub(super) timeline: &'a Timeline,
    pub(super) noise: &'a SensorNoise,
}

impl Estimation<'_> {
    /// # Errors
    /// No maximum, a motion that diverges, an interrupt.
    pub(super) fn solve(
        &self,
        at_once: bool,
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Solution, IdentifyError> {
        let Timeline { start, end, .. } = *self.timeline;
        let span = end - start;
        let mut parts = vec![span];
        while !at_once && parts.last().is_some_and(|part| *part > 2.0 * SHORTEST) {
            parts.push(0.5 * parts.last().copied().unwrap_or(span));
        }
        let mut values: Vec<f64> = self.components.iter().map(|of| of.start).collect();
        let mut found = None;
        for part in parts.into_iter().rev() {
            let whole = part >= span;
            let solution = self.part(values, (part, whole), progress)?;
            values = solution.values.as_slice().to_vec();
            found = Some(solution);
        }
        found.ok_or(IdentifyError::Singular)
    }

    /// One pass at some values.
    pub(super) fn pass(
        &self,
        values: &[f64],
        until: f64,
        progress: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Pass, IdentifyError> {
        let model = Model::new(self.scenario, self.components, values)?;
        let place =
            |axis: usize| self.components.iter().position(|of| of.target == Target::Bias(axis));
        let bias = [place(0), place(1), place(2)];
        let count = (self.components.len(), bias);
        Pass::run(&model, self.timeline, self.noise, count, until, progress)
    }

    /// Adds what is known before; of a part what has no prior, too.
    fn add_priors(&self, pass: &mut Pass, values: &[f64], whole: bool) {
        for (index, (of, value)) in self.components.iter().zip(values).enumerate() {
            let prior = of.prior.or((!whole).then_some([of.start, of.scale]));
            let Some([mean, deviation]) = prior else { continue };
            let weight = (deviation * deviation).recip();
            pass.cost += 0.5 * weight * (value - mean) * (value - mean);
            pass.normal[(index, index)] += weight;
            pass.descent[index] -= weight * (value - mean);
        }
    }

    fn part(
        &self,
        mut values: Vec<f64>,
        (part, whole): (f64, bool),
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Solution, IdentifyError> {
        let Timeline { start, end, .. } = *self.timeline;
        let until = start + part + 1e-9;
        let of = usize::from(whole);
        let mut step = 0;
        let mut evaluate = |values: &[f64], step: usize| -> Result<Pass, IdentifyError> {
            let mut at = |time: f64| {
                let time = time - start;
                progress(&Progress { part: [part, end - start], step, time })
            };
            let mut pass = self.pass(values, until, &mut at)?;
            self.add_priors(&mut pass, values, whole);
            Ok(pass)
        };
        let mut pass = evaluate(&values, step + 1)?;
        let mut damping = DAMPING;
        let mut length = f64::INFINITY;
        while step < STEPS[of] {
            step += 1;
            let (change, squared) = self.step(&pass, damping);
            length = squared;
            if squared < SETTLED[of] || squared < ROUNDING * pass.cost {
                return Ok(Solution { values, pass, steps: step });
            }
            let moved: Vec<f64> =
                values.iter().zip(change.iter()).map(|(value, change)| value + change).collect();
            let found = match evaluate(&moved, step + 1) {
                Err(IdentifyError::Interrupted) => return Err(IdentifyError::Interrupted),
                Err(error) if damping >= DAMPING_MAX => return Err(error),
                found => found.ok(),
            };
            match found.filter(|found| found.cost <= pass.cost * (1.0 + ROUNDING)) {
                Some(found) => {
                    (values, pass) = (moved, found);
                    damping = (damping / FACTOR).max(DAMPING);
                }
                None => damping *= FACTOR,
            }
            if damping > DAMPING_MAX {
                break;
            }
        }
        if whole {
            return Err(IdentifyError::NotConverged { step: length.sqrt() });
        }
        Ok(Solution { values, pass, steps: step })
    }

    /// The step with some damping, and its square by the covariance; along what neither data nor priors tell there is none.
    fn step(&self, pass: &Pass, damping: f64) -> (DVector<f64>, f64) {
        let (scaled, scales) = scaled(&pass.normal, self.components);
        let descent = pass.descent.component_mul(&scales);
        let eigen = scaled.symmetric_eigen();
        let mut solved = DVector::zeros(scales.len());
        let mut squared = 0.0;
        let vectors = eigen.eigenvectors.column_iter();
        for (value, vector) in eigen.eigenvalues.iter().zip(vectors).filter(|(of, _)| **of >= TOLD)
        {
            let along = vector.dot(&descent);
            let length = along / (value + damping * (1.0 + value));
            squared += along * length;
            solved.axpy(length, &vector, 1.0);
        }
        (solved.component_mul(&scales), squared)
    }
}

/// The normal matrix of the numbers by their scales, and those.
pub(super) fn scaled(
    normal: &DMatrix<f64>,
    components: &[Component],
) -> (DMatrix<f64>, DVector<f64>) {
    let scales = DVector::from_iterator(components.len(), components.iter().map(|of| of.scale));
    let scaled = DMatrix::from_fn(normal.nrows(), normal.ncols(), |row, column| {
        normal[(row, column)] * scales[row] * scales[column]
    });
    (scaled, scales)
}
