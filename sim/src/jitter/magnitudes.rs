//! Magnitudes that do not cancel: the unit of the difference of two amplitudes of one frequency.
//!
//! An amplitude is a sum over tones, mounts, components of force and nodes. Rotors in a symmetric layout, or the parts of a
//! line of sight, may cancel to any small number, whose relative error says nothing. The sum of the magnitudes of its tones
//! does not cancel where tones do, and that of all terms never does:
//!
//! ```text
//! sum over tones, mounts, nodes of |S_k| |A_om| |F| / w^2
//! ```

use super::model::{Contributor, Line, Model};
use crate::structure::{COORDINATES, Fault};

/// The share of the magnitudes of all terms that a difference is at least counted in: a run resolves it.
const TERMS: f64 = 1e-3;

impl Model {
    /// Of each frequency, rad/s, of the output of which it is largest: the magnitudes of the lines, added up, or a thousandth of
    /// the magnitudes of all their terms where that is more, in the unit of the output. Lines are all those of a speed, rad/s.
    ///
    /// # Errors
    /// As [`Self::lines`].
    pub(super) fn magnitudes(
        &self,
        speed: f64,
        lines: &[Line],
        frequencies: &[f64],
    ) -> Result<Vec<f64>, Fault> {
        let all = self.contributors().into_iter().zip(lines);
        let terms: Result<Vec<_>, _> = all.map(|(of, line)| self.terms(speed, &of, line)).collect();
        let terms = terms?;
        let of_frequency = |frequency: &f64| {
            let same = || lines.iter().zip(&terms).filter(|(line, _)| line.frequency == *frequency);
            let of_output = |output: usize| {
                let values = same().filter_map(|(line, _)| line.values.get(output));
                let of_lines: f64 = values.map(|value| value.norm()).sum();
                let of_terms: f64 = same().filter_map(|(_, terms)| terms.get(output)).sum();
                of_lines.max(TERMS * of_terms)
            };
            (0..self.outputs.len()).map(of_output).fold(0.0, f64::max)
        };
        Ok(frequencies.iter().map(of_frequency).collect())
    }

    /// Of a line, and of each output: the sum of the magnitudes of its terms.
    fn terms(&self, speed: f64, of: &Contributor, line: &Line) -> Result<Vec<f64>, Fault> {
        let of_mounts = COORDINATES * self.mounts.len();
        let mounted = self.mounted(speed, line.frequency, &[of.place])?;
        let nodes = mounted.accelerance.nrows() - of_mounts;
        let moved = mounted.accelerance.rows(of_mounts, nodes).map(nalgebra::Complex::norm);
        let force = mounted.force.map(nalgebra::Complex::norm);
        let sums = self.rows.abs() * (moved * force) / (line.frequency * line.frequency);
        Ok(sums.column(0).iter().copied().collect())
    }
}
