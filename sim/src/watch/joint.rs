//! [`JointFit`]: one block of a joint: its measured rate against the model's, by torque; of a gimbal beside the line of the rotor that it bears.
//!
//! The line itself is estimated beside a parabola: torques that the model lacks are slow, and the torque of a motor that holds the gimbal has the
//! line, too, so that a torque constant would be estimated by it.

use nalgebra::{Matrix2, Vector2};

use super::body::{LINE, line_of};
use super::drag::DragSample;
use super::regression::{Reduced, Regression};
use super::steps::StepSearch;

/// A rotor slower than this has no scale of its tachometer, rad/s.
const SLOWEST: f64 = 1.0;

/// Start, drag and torque constant.
const OWN: usize = 3;

/// Above this square of their correlation drag and torque constant have one effect: it is called drag.
const ALIKE: f64 = 0.9;

/// The block of a joint with tachometer and motor.
#[derive(Clone, Debug)]
pub(super) struct JointFit {
    pub(super) joint: usize,
    /// Of a gimbal: the rotor of its device, which has a line in its rate.
    rotor: Option<usize>,
    /// With the torque constant, and without it.
    regressions: [Regression; 2],
    /// Of the line.
    of_line: Regression,
    /// Integrals since the start of the block: the model's acceleration, rad/s, the motor's torque, N m s, and dry friction of
    /// 1 N m, N m s.
    predicted: f64,
    torque: f64,
    opposing: f64,
    /// What one N m accelerates the joint by, rad/s².
    by_torque: f64,
    /// The rate that was read last, rad/s.
    rate: f64,
    /// Whether no reading of the block before was forgotten or corrected.
    continues: bool,
    /// Of a wheel.
    steps: Option<StepSearch>,
    /// Length of a block, and time since the start, s.
    block: f64,
    elapsed: f64,
    /// Over the readings: their number, sums of what drag and the motor's torque make of the rate, and products of these.
    shape: [f64; 5],
}

/// What a block says of a joint, each with its variance.
#[derive(Clone, Debug, Default)]
pub(super) struct JointValues {
    /// Drag torque beyond the model's, N m.
    pub(super) drag: Option<[f64; 2]>,
    /// By how much a torque constant that is one more than the model's would change that, N m.
    pub(super) signature: f64,
    /// Of a wheel: what its tests take.
    pub(super) sample: Option<DragSample>,
    /// Torque constant by the model's less one; none where the block does not tell it from drag.
    pub(super) torque: Option<[f64; 2]>,
    /// Step of the reading by itself.
    pub(super) scale: Option<[f64; 2]>,
    /// Of a gimbal: the line of the rotor.
    pub(super) line: Option<Reduced>,
}

impl JointFit {
    /// Of a wheel, whose steps scatter as so many first blocks tell, or of a gimbal with the rotor of its device.
    pub(super) fn new(
        joint: usize,
        wheel: bool,
        rotor: Option<usize>,
        block: f64,
        reference: usize,
    ) -> Self {
        let rotor = rotor.filter(|_| !wheel);
        let line = if rotor.is_some() { LINE } else { 0 };
        Self {
            steps: wheel.then(|| StepSearch::new(reference)),
            rotor,
            block,
            elapsed: 0.0,
            shape: [0.0; 5],
            joint,
            of_line: Regression::new(OWN + line),
            continues: false,
            regressions: [Regression::new(OWN + line), Regression::new(OWN - 1 + line)],
            predicted: 0.0,
            torque: 0.0,
            opposing: 0.0,
            by_torque: 0.0,
            rate: 0.0,
        }
    }

    pub(super) fn start(&mut self, by_torque: f64, rate: f64) {
        self.regressions.iter_mut().chain([&mut self.of_line]).for_each(Regression::clear);
        (self.predicted, self.torque, self.opposing) = (0.0, 0.0, 0.0);
        (self.by_torque, self.rate) = (by_torque, rate);
        (self.elapsed, self.shape) = (0.0, [0.0; 5]);
    }

    /// Forgets what joins a block with the one before.
    pub(super) fn forget(&mut self) {
        self.continues = false;
        if let Some(steps) = &mut self.steps {
            steps.forget();
        }
    }

    /// The rotor that has a line in its rate.
    pub(super) fn rotor(&self) -> Option<usize> {
        self.rotor
    }

    /// Whether it is a wheel, whose tachometer has a scale.
    pub(super) fn is_wheel(&self) -> bool {
        self.steps.is_some()
    }

    /// Moves on by a time with this acceleration, torque, and dry friction of 1 N m.
    pub(super) fn advance(&mut self, elapsed: f64, acceleration: f64, torque: f64, friction: f64) {
        self.predicted += acceleration * elapsed;
        self.torque += torque * elapsed;
        self.elapsed += elapsed;
        self.opposing += friction * elapsed;
    }

    /// Takes a reading of the rate, with the line of the rotor at this time.
    pub(super) fn read(&mut self, rate: f64, line: &[f64; LINE]) {
        let observed = rate - self.predicted;
        let (drag, torque) = (self.by_torque * self.opposing, self.by_torque * self.torque);
        let [both, of_drag] = &mut self.regressions;
        let own = [1.0, drag, torque];
        if self.rotor.is_some() {
            let [a, b, c, d] = *line;
            both.add(&[1.0, drag, torque, a, b, c, d], observed);
            of_drag.add(&[1.0, drag, a, b, c, d], observed);
            let share = self.elapsed / self.block;
            self.of_line.add(&[1.0, share, share * share, a, b, c, d], observed);
        } else {
            both.add(&own, observed);
            of_drag.add(&own[..OWN - 1], observed);
        }
        for (sum, of) in self.shape.iter_mut().zip([1.0, drag, torque, drag * drag, drag * torque])
        {
            *sum += of;
        }
        if let Some(steps) = &mut self.steps {
            steps.read(self.elapsed / self.block, observed);
        }
        self.rate = rate;
    }

    /// What the block between these times says.
    pub(super) fn end(&mut self, times: [f64; 2]) -> JointValues {
        let [both, of_drag] = &self.regressions;
        let line = self.rotor.and_then(|rotor| self.of_line.reduced(OWN, line_of(rotor)));
        // Of few readings no line is determined.
        let drag = of_drag.solve().or_else(|| of_drag.leading(OWN - 1).solve());
        let torque = both.solve().or_else(|| both.leading(OWN).solve());
        let torque = torque.and_then(|found| {
            let (drag, torque) = (found.of(1)?, found.of(2)?);
            let common = found.covariance[(2, 1)];
            (common * common < ALIKE * drag[1] * torque[1]).then_some(torque)
        });
        let by_torque = self.by_torque_constant();
        let sample = drag.as_ref().filter(|_| self.steps.is_some()).and_then(|found| {
            let ([rate, a], [drag, b]) = (found.of(0)?, found.of(1)?);
            let c = found.covariance[(1, 0)];
            Some(DragSample {
                times,
                continues: self.continues,
                value: Vector2::new(rate, drag),
                covariance: Matrix2::new(a, c, c, b),
                predicted: self.predicted,
                added: [self.opposing, self.torque].map(|of| self.by_torque * of),
                seen: [Vector2::y(), by_torque],
            })
        });
        self.continues = sample.is_some();
        let noise = drag.as_ref().map_or(0.0, |found| found.noise);
        let step = self.steps.as_mut().and_then(|steps| steps.end(noise, self.predicted));
        let (rate, turning) = (self.rate, self.rate.abs() > SLOWEST);
        let scale = step.filter(|_| turning);
        let scale = scale.map(|[step, variance]| [step / rate, variance / (rate * rate)]);
        let drag = drag.and_then(|found| found.of(1));
        JointValues { drag, signature: by_torque.y, sample, torque, scale, line }
    }

    /// What a torque constant that is one more than the model's would make of start and drag.
    fn by_torque_constant(&self) -> Vector2<f64> {
        let [count, drags, torques, square, product] = self.shape;
        let spread = count * square - drags * drags;
        if spread <= 0.0 {
            return Vector2::zeros();
        }
        let by_drag = (count * product - drags * torques) / spread;
        Vector2::new((torques - by_drag * drags) / count, by_drag)
    }
}
