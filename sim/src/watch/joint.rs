//! [`JointFit`]: one block of a joint: its measured rate against the model's, by torque.

use super::regression::Regression;

/// Above this square of their correlation drag and torque constant have one effect: it is called drag.
const ALIKE: f64 = 0.9;

/// The block of a joint with tachometer and motor.
#[derive(Clone, Debug)]
pub(super) struct JointFit {
    pub(super) joint: usize,
    /// With the torque constant, and without it.
    regressions: [Regression; 2],
    /// Integrals since the start of the block: the model's acceleration, rad/s, the motor's torque, N m s, and a torque of 1 N m
    /// against the motion, N m s.
    predicted: f64,
    torque: f64,
    opposing: f64,
    /// What one N m accelerates the joint by, rad/s².
    by_torque: f64,
    /// The rate that was read last, rad/s.
    rate: f64,
}

/// Drag torque beyond the model's, N m, and torque constant by the model's less one, each with its variance.
pub(super) type JointValues = [Option<[f64; 2]>; 2];

impl JointFit {
    pub(super) fn new(joint: usize) -> Self {
        Self {
            joint,
            regressions: [Regression::new(3), Regression::new(2)],
            predicted: 0.0,
            torque: 0.0,
            opposing: 0.0,
            by_torque: 0.0,
            rate: 0.0,
        }
    }

    pub(super) fn start(&mut self, by_torque: f64, rate: f64) {
        self.regressions.iter_mut().for_each(Regression::clear);
        (self.predicted, self.torque, self.opposing) = (0.0, 0.0, 0.0);
        (self.by_torque, self.rate) = (by_torque, rate);
    }

    /// Moves on by a time with this acceleration and torque.
    pub(super) fn advance(&mut self, elapsed: f64, acceleration: f64, torque: f64) {
        self.predicted += acceleration * elapsed;
        self.torque += torque * elapsed;
        self.opposing -= self.rate.signum() * elapsed;
    }

    /// Takes a reading of the rate.
    pub(super) fn read(&mut self, rate: f64) {
        let observed = rate - self.predicted;
        let (drag, torque) = (self.by_torque * self.opposing, self.by_torque * self.torque);
        let [both, of_drag] = &mut self.regressions;
        both.add(&[1.0, drag, torque], observed);
        of_drag.add(&[1.0, drag], observed);
        self.rate = rate;
    }

    pub(super) fn estimate(&self) -> JointValues {
        let [both, of_drag] = &self.regressions;
        if let Some(found) = both.solve()
            && let (Some(drag), Some(torque)) = (found.of(1), found.of(2))
        {
            let common = found.covariance[(2, 1)];
            if common * common < ALIKE * drag[1] * torque[1] {
                return [Some(drag), Some(torque)];
            }
        }
        [of_drag.solve().and_then(|found| found.of(1)), None]
    }
}
