//! [`BodyFit`]: one block of the gyro: what is left of its readings beside the model, as lines of the rotors and a step within the
//! last blocks.

use std::f64::consts::TAU;

use nalgebra::{Complex, Matrix3, Vector3};
use precess_control::GyroOutput;
use precess_dynamics::Angle;

use super::model::{Signature, WatchedModel};
use super::phase::PhaseTrack;
use super::regression::{Reduced, Regression};
use super::steps::{BINS, StepSearch, bin};
use super::track::Track;
use crate::scenario::Scenario;

/// Parameters of the block itself: rates at its start and accelerations by torques from outside.
const OWN: usize = 6;

/// Parameters of a line: real and imaginary parts of static and of dynamic imbalance.
pub(super) const LINE: usize = 4;

/// The first parameter of the line of a rotor.
pub(super) fn line_of(rotor: usize) -> usize {
    OWN + LINE * rotor
}

/// Above this square of their correlation static and dynamic imbalance of a rotor have one line: it is called dynamic.
const ALIKE: f64 = 0.98;

/// A rotor slower than this has no line, rad/s.
const SLOWEST: f64 = 1.0;

/// A line nearer than this to a multiple of the sampling rate, rad a sample, is a constant.
const FOLDED: f64 = 1e-6;

/// The angle of a rotor, and its line in the block.
#[derive(Clone, Debug)]
struct Line {
    /// Whether its angle is known.
    turning: bool,
    /// Integral of its tachometer, rad.
    angle: f64,
    /// Mean rate since the reading before, rad/s.
    rate: f64,
    signature: Option<Signature>,
    /// Whether static imbalance has a line of its own; known from the first block on.
    separate: Option<bool>,
    /// Rate in the first block, rad/s.
    first: Option<f64>,
    /// Those of static and of dynamic imbalance.
    phases: [PhaseTrack; 2],
}

/// A block of the gyro.
#[derive(Clone, Debug)]
pub(super) struct BodyFit {
    lines: Vec<Line>,
    /// Of an integrating gyro the sampling period, s.
    integrating: Option<f64>,
    regression: Regression,
    row: Vec<f64>,
    /// Integral of the model's acceleration since the start of the block, rad/s.
    predicted: Vector3<f64>,
    /// Time since the reading before, s.
    interval: f64,
    /// Steps about each axis.
    steps: [StepSearch; 3],
    /// Sums of the rows of each bin and axis.
    sums: Vec<f64>,
    /// Length of a block, s.
    block: f64,
}

/// Amplitudes of static and dynamic imbalance and steps of their phases, with variances.
pub(super) type RotorValues = [Option<[f64; 2]>; 4];

impl Line {
    /// What turns a line's acceleration at the start of the block into that at present: none of a rotor that is too slow.
    fn turned(&self, rate: f64) -> Option<Complex<f64>> {
        let signature = self.signature.as_ref().filter(|_| rate.abs() >= SLOWEST)?;
        let (sine, cosine) = Angle::sin_cos(self.angle);
        Some(Complex::new(cosine, sine) * (rate / signature.rate).powi(2))
    }

    fn forget(&mut self) {
        self.phases.iter_mut().for_each(PhaseTrack::forget);
    }
}

impl BodyFit {
    /// Of rotors of which each is turning where its tachometer is read; the steps of the gyro scatter as so many first blocks tell.
    pub(super) fn new(
        scenario: &Scenario,
        turning: Vec<bool>,
        block: f64,
        reference: usize,
    ) -> Self {
        let integrates = scenario.controllers.iter().find_map(|of| {
            let gyro = of.sensors.gyro.as_ref()?;
            (gyro.output == GyroOutput::Integrating).then(|| of.rate.recip())
        });
        let count = line_of(turning.len());
        let line = |turning| Line {
            turning,
            angle: 0.0,
            rate: 0.0,
            signature: None,
            separate: None,
            first: None,
            phases: Default::default(),
        };
        Self {
            lines: turning.into_iter().map(line).collect(),
            integrating: integrates,
            regression: Regression::new(count),
            row: vec![0.0; count],
            predicted: Vector3::zeros(),
            interval: 0.0,
            steps: std::array::from_fn(|_| StepSearch::new(reference)),
            sums: vec![0.0; 3 * BINS * count],
            block,
        }
    }

    /// Forgets what joins a block with the one before.
    pub(super) fn forget(&mut self) {
        self.steps.iter_mut().for_each(StepSearch::forget);
        self.lines.iter_mut().for_each(Line::forget);
    }

    /// Forgets the readings before an axis was corrected.
    pub(super) fn forget_steps(&mut self, axis: usize) {
        if let Some(steps) = self.steps.get_mut(axis) {
            steps.forget();
        }
    }

    /// Forgets the phases of a rotor, whose angle is not known any more.
    pub(super) fn forget_phases(&mut self, rotor: usize) {
        if let Some(line) = self.lines.get_mut(rotor) {
            line.forget();
        }
    }

    pub(super) fn start(&mut self, signatures: Vec<Signature>) {
        self.regression.clear();
        self.sums.fill(0.0);
        self.predicted = Vector3::zeros();
        let mut signatures = signatures.into_iter();
        for line in &mut self.lines {
            line.signature = signatures.next().filter(|of| line.turning && of.rate.abs() > SLOWEST);
        }
    }

    /// Moves on by a time with this acceleration of the hub.
    pub(super) fn advance(&mut self, elapsed: f64, hub: &Vector3<f64>, model: &WatchedModel) {
        self.predicted += hub * elapsed;
        self.interval += elapsed;
        for (line, rotor) in self.lines.iter_mut().zip(model.rotors()) {
            line.rate = model.joint_rate(rotor.joint);
            let angle = line.angle + line.rate * elapsed;
            // No angle grows until its digits are lost.
            line.angle = angle - TAU * (angle / TAU).floor();
        }
    }

    /// Takes a reading of the gyro, so long after the start, and the readings that it is one of.
    pub(super) fn read(
        &mut self,
        elapsed: f64,
        omega: &Vector3<f64>,
        model: &WatchedModel,
        track: &Track,
    ) {
        let mut numbers = vec![[Vector3::<f64>::zeros(); LINE]; self.lines.len()];
        for ((to, line), rotor) in numbers.iter_mut().zip(&self.lines).zip(model.rotors()) {
            let rate = model.joint_rate(rotor.joint);
            let (Some(signature), Some(mut factor)) = (&line.signature, line.turned(rate)) else {
                continue;
            };
            // From acceleration to rate, and to what the gyro makes of it.
            if let Some(period) = self.integrating {
                let half = 0.5 * rate * period;
                let sinc = if half == 0.0 { 1.0 } else { libm::sin(half) / half };
                factor *= Complex::new(libm::cos(half), -libm::sin(half)) * sinc;
            }
            // i Omega x = K x + A. The model is integrated at means between the readings, which have the line: of that
            // integral, W T / (exp(i Omega T) - 1) K x with the weight W of these means, nothing is left.
            let coupling = signature.coupling.map(|of| Complex::new(of, 0.0));
            let turning = Matrix3::from_diagonal_element(Complex::new(0.0, rate)) - coupling;
            let Some(inverse) = turning.try_inverse() else { continue };
            let (sine, cosine) = Angle::sin_cos(rate * self.interval);
            let step = Complex::new(cosine - 1.0, sine);
            let integrated = if step.norm() > FOLDED {
                coupling * (track.weight(step + 1.0) * self.interval / step)
            } else {
                Matrix3::zeros()
            };
            let left = (Matrix3::identity() - integrated) * inverse;
            let [first, second] = signature.by_imbalance.map(|of| left * of * factor);
            (to[0], to[1]) = (first.map(|of| of.re), first.map(|of| -of.im));
            (to[2], to[3]) = (second.map(|of| of.re), second.map(|of| -of.im));
        }
        self.interval = 0.0;
        let observed = omega - self.predicted;
        for axis in 0..3 {
            self.row.fill(0.0);
            let (own, lines) = self.row.split_at_mut(OWN);
            for (index, to) in own.iter_mut().enumerate() {
                if index % 3 == axis {
                    *to = if index < 3 { 1.0 } else { elapsed };
                }
            }
            for (to, from) in lines.iter_mut().zip(numbers.iter().flatten()) {
                *to = from[axis];
            }
            self.regression.add(&self.row, observed[axis]);
            let share = elapsed / self.block;
            if let Some(steps) = self.steps.get_mut(axis) {
                steps.read(share, observed[axis]);
            }
            let (count, place) = (self.row.len(), 3 * bin(share) + axis);
            for (sum, of) in self.sums.iter_mut().skip(place * count).zip(&self.row) {
                *sum += of;
            }
        }
    }

    /// The line of a rotor in the rate of another joint: by real and imaginary parts of its static and dynamic imbalance. It is what the
    /// imbalance adds to the acceleration at the rates and torques that were measured.
    pub(super) fn of_joint(&self, joint: usize, rotor: usize, model: &WatchedModel) -> [f64; LINE] {
        let own = self.lines.get(rotor).zip(model.rotors().get(rotor));
        let Some((line, of)) = own else { return [0.0; LINE] };
        let rate = model.joint_rate(of.joint);
        let (Some(signature), Some(factor)) = (&line.signature, line.turned(rate)) else {
            return [0.0; LINE];
        };
        let Some(accelerations) = signature.by_joint.get(joint) else { return [0.0; LINE] };
        let [first, second] =
            accelerations.map(|of| of * factor * Complex::new(0.0, -rate.recip()));
        [first.re, -first.im, second.re, -second.im]
    }

    /// Square of a rotor's rate, in the middle of the block, by that in its first one: softer bearings amplify its line as that, to first order.
    pub(super) fn speed(&mut self, rotor: usize) -> f64 {
        let Some(line) = self.lines.get_mut(rotor) else { return 0.0 };
        let Some(signature) = &line.signature else { return 0.0 };
        let rate = f64::midpoint(signature.rate, line.rate);
        (rate / *line.first.get_or_insert(rate)).powi(2)
    }

    /// What the block says, with what gimbals say of lines: of each rotor, and the step of the gyro about each axis.
    pub(super) fn end(&mut self, gimbals: &[Reduced]) -> (Vec<RotorValues>, [Option<[f64; 2]>; 3]) {
        let mut zero = Vec::new();
        for (index, line) in self.lines.iter_mut().enumerate() {
            let first = line_of(index);
            let common = || self.regression.common(first, gimbals);
            line.separate = line.separate.or_else(|| common().map(|of| of < ALIKE));
            if line.separate == Some(false) {
                zero.extend([first, first + 1]);
            }
        }
        let Some(found) = self.regression.solve_with(gimbals, &zero) else {
            self.forget();
            return (Vec::new(), [None; 3]);
        };
        let lines = self.lines.iter_mut().enumerate().map(|(index, line)| {
            let mut values = [None; 4];
            for (kind, phase) in line.phases.iter_mut().enumerate() {
                let Some(of) = found.line(line_of(index) + 2 * kind) else { continue };
                values[kind] = Some(of.amplitude());
                values[2 + kind] = phase.step(of);
            }
            values
        });
        let lines: Vec<RotorValues> = lines.collect();
        let count = self.row.len();
        let mut jumps = [None; 3];
        for (axis, (steps, to)) in self.steps.iter_mut().zip(&mut jumps).enumerate() {
            let of_lines = |bin: usize| {
                let row = self.sums.iter().skip((3 * bin + axis) * count).take(count);
                row.zip(found.values.iter()).skip(OWN).map(|(of, value)| of * value).sum()
            };
            *to = steps.end_with(found.noise, self.predicted[axis], of_lines);
        }
        (lines, jumps)
    }
}
