//! [`Transfer`]: what blocked forces on the mounts do to the outputs, at one speed and any frequency.
//!
//! What does not depend on the frequency is computed once.

use nalgebra::Complex;

use super::model::Model;
use crate::structure::accelerance::ComplexMatrix;
use crate::structure::condensed::condensed_complex;
use crate::structure::{COORDINATES, Fault};

/// A model at one speed.
pub(super) struct Transfer<'a> {
    model: &'a Model,
    /// Of each device the means of its derivatives.
    devices: Vec<[ComplexMatrix; 3]>,
}

impl<'a> Transfer<'a> {
    /// At a speed, rad/s.
    pub(super) fn new(model: &'a Model, speed: f64) -> Self {
        let complex = |(_, device): &(usize, super::device::SweptDevice)| {
            device.mean(speed).map(|part| part.map(|value| Complex::new(value, 0.0)))
        };
        Self { model, devices: model.devices.iter().map(complex).collect() }
    }

    /// The outputs by blocked forces on the mounts, six columns for each mount: `-R A_om (1 + M A_mm)^-1 / w^2`. There are
    /// fewer outputs than forces, so the transposed system is solved.
    ///
    /// # Errors
    /// As [`Model::lines`].
    pub(super) fn at(&self, frequency: f64) -> Result<ComplexMatrix, Fault> {
        let unbounded = || Fault::Unbounded { frequency };
        let of_mounts = COORDINATES * self.model.mounts.len();
        let accelerance = self.model.to_outputs().at(frequency)?;
        let by_square = Complex::new(-1.0 / (frequency * frequency), 0.0);
        let outputs = accelerance.rows(of_mounts, accelerance.nrows() - of_mounts);
        let mut found = outputs.transpose() * by_square;
        let devices: Result<Vec<_>, _> =
            self.devices.iter().map(|parts| condensed_complex(parts, frequency)).collect();
        let system = self.model.system(&accelerance, &devices?).transpose();
        if !system.lu().solve_mut(&mut found) {
            return Err(unbounded());
        }
        if found.iter().all(|value| value.re.is_finite() && value.im.is_finite()) {
            Ok(found.transpose())
        } else {
            Err(unbounded())
        }
    }
}
