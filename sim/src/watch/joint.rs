//! [`JointFit`]: one block of a joint: its measured rate against the model's, by torque.

use super::regression::Regression;

/// The block of a joint with tachometer and motor.
#[derive(Clone, Debug)]
pub(super) struct JointFit {
    pub(super) joint: usize,
    /// Whether it is a wheel: its drag is watched, of another joint the torque constant.
    pub(super) wheel: bool,
    regression: Regression,
    /// Integrals since the start of the block: the model's acceleration, rad/s, and the motor's torque, N m s.
    predicted: f64,
    torque: f64,
    /// What one N m accelerates the joint by, rad/s².
    by_torque: f64,
    /// The sign of the rate at the start of the block.
    sign: f64,
}

impl JointFit {
    pub(super) fn new(joint: usize, wheel: bool) -> Self {
        let regression = Regression::new(if wheel { 2 } else { 3 });
        Self { joint, wheel, regression, predicted: 0.0, torque: 0.0, by_torque: 0.0, sign: 1.0 }
    }

    pub(super) fn start(&mut self, by_torque: f64, rate: f64) {
        self.regression.clear();
        (self.predicted, self.torque) = (0.0, 0.0);
        (self.by_torque, self.sign) = (by_torque, rate.signum());
    }

    /// Moves on by a time with this acceleration and torque.
    pub(super) fn advance(&mut self, elapsed: f64, acceleration: f64, torque: f64) {
        self.predicted += acceleration * elapsed;
        self.torque += torque * elapsed;
    }

    /// Takes a reading of the rate, so long after the start.
    pub(super) fn read(&mut self, elapsed: f64, rate: f64) {
        let observed = rate - self.predicted;
        let (drag, torque) = (-self.sign * self.by_torque * elapsed, self.by_torque * self.torque);
        if self.wheel {
            self.regression.add(&[1.0, drag], observed);
        } else {
            self.regression.add(&[1.0, drag, torque], observed);
        }
    }

    /// Drag torque beyond the model's, N m, or torque constant by the model's less one, with its variance.
    pub(super) fn estimate(&self) -> Option<[f64; 2]> {
        self.regression.solve()?.of(if self.wheel { 1 } else { 2 })
    }
}
