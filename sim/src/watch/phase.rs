//! [`PhaseTrack`]: steps of the phase of a line, from block to block.
//!
//! The line of a block is a complex number. The mean of the last n blocks is compared with that of up to ten before them. Of a line that a
//! block determines well n is one; of one that noise nearly hides, whose phase a single block does not have, it is up to four.

use std::collections::VecDeque;

use super::regression::LineEstimate;
use crate::spectra::float;

/// Blocks that are compared with.
const BEFORE: usize = 10;

/// The most blocks of the mean that is compared.
const MOST: usize = 4;

/// So many blocks are averaged that their mean is this many deviations from zero.
const CLEAR: f64 = 10.0;

/// The line before is at least this many deviations from zero.
const KNOWN: f64 = 5.0;

/// After a step of so many deviations what is before it is forgotten.
const STEP: f64 = 6.0;

/// The line of the last blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct PhaseTrack {
    lines: VecDeque<LineEstimate>,
}

impl PhaseTrack {
    pub(super) fn forget(&mut self) {
        self.lines.clear();
    }

    /// Takes the line of a block; the step of its phase with the variance, rad and rad². Of a step beyond a right angle the deviation is
    /// that by which the whole line is from zero.
    pub(super) fn step(&mut self, line: LineEstimate) -> Option<[f64; 2]> {
        if self.lines.len() == BEFORE + MOST {
            self.lines.pop_front();
        }
        self.lines.push_back(line);
        let all = mean(self.lines.iter())?;
        let single = all.largest() * float(self.lines.len());
        let is_clear =
            |blocks: &usize| all.value.norm_sqr() * float(*blocks) > CLEAR * CLEAR * single;
        let blocks = (1..MOST).find(is_clear).unwrap_or(MOST);
        let now = mean(self.lines.iter().rev().take(blocks))?;
        let before = mean(self.lines.iter().rev().skip(blocks))?;
        let size = before.value.norm();
        if size * size < KNOWN * KNOWN * before.largest() {
            return None;
        }
        let turned = now.value * before.value.conj() / size;
        // An error of the line before turns it by an angle, and the present one by the same.
        let lever = now.value.norm() / size;
        let variance = now.across(before.value) + lever * lever * before.across(before.value);
        let distance = if turned.re < 0.0 { turned.norm() } else { turned.im };
        let (step, square) = (turned.arg(), distance * distance / variance);
        if square > STEP * STEP {
            self.lines.drain(..self.lines.len() - blocks);
        }
        (square > 0.0).then(|| [step, step * step / square])
    }
}

/// The mean of lines, with its covariance.
fn mean<'a>(lines: impl Iterator<Item = &'a LineEstimate>) -> Option<LineEstimate> {
    let (mut sum, mut count) = (LineEstimate::default(), 0.0);
    for line in lines {
        sum.value += line.value;
        for (to, of) in sum.covariance.iter_mut().zip(line.covariance) {
            *to += of;
        }
        count += 1.0;
    }
    (count > 0.0).then(|| LineEstimate {
        value: sum.value / count,
        covariance: sum.covariance.map(|of| of / (count * count)),
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;
    use precess_control::Noise;

    use super::*;

    /// Lines of so many deviations of a block, whose phase steps after some blocks: the largest ratio before, and the first block after it with five
    /// deviations, with the step found there.
    fn found(size: f64, step: f64) -> (f64, Option<(u64, f64)>) {
        const ONSET: u64 = 2000;
        let noise = Noise::new(3, "lines");
        let (mut track, mut largest) = (PhaseTrack::default(), 0.0_f64);
        for k in 0..ONSET + 20 {
            let [re, im, ..] = noise.at(k);
            let phase = if k < ONSET { 0.3 } else { 0.3 + step };
            let value = Complex::from_polar(size, phase) + Complex::new(re, im);
            let line = LineEstimate { value, covariance: [1.0, 1.0, 0.0] };
            let Some([step, variance]) = track.step(line) else { continue };
            let ratio = step.abs() / variance.sqrt();
            if k < ONSET {
                largest = largest.max(ratio);
            } else if ratio > 5.0 {
                return (largest, Some((k - ONSET, step)));
            }
        }
        (largest, None)
    }

    /// A line of fifty deviations is compared block by block, one of four and a half by means of four blocks; what is no step is as rare as of a normal
    /// number, of which one in two thousand is beyond 3.5.
    #[test]
    fn phases_of_weak_lines_are_those_of_means() {
        for (size, latest) in [(50.0, 0), (4.5, 4)] {
            let (largest, first) = found(size, 0.9);
            let (block, step) = first.expect("a step");
            println!("{size} deviations: largest {largest:.2}; after {block} blocks {step:.2} rad");
            assert!(largest < 4.4, "{size}: {largest}");
            assert!(block <= latest, "{size}: {block}");
            assert!((step - 0.9).abs() < 3.0 / size, "{size}: {step}");
        }
        assert_eq!(found(50.0, 0.0).1, None);
        assert!(found(50.0, 3.0).1.is_some_and(|(block, step)| block == 0 && step.abs() > 2.8));
    }
}
