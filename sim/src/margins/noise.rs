//! [`NoiseGains`]: what white noise of the measured attitude and rate does to the hub.
//!
//! Noise that is independent from sample to sample, of standard deviation sigma, moves the hub by the root of the sum of squares of
//! the impulse response times sigma. A gyro that averages its angle random walk N over a period has `sigma = N / sqrt(T)`.

use nalgebra::DMatrix;

use super::analysis::ControlLoop;

/// Samples of an impulse response, at most.
const SAMPLES_MAX: usize = 2_000_000;
/// Samples after which is looked whether it is over.
const BLOCK: usize = 256;
/// What a block adds to the sum of squares when it is over.
const OVER: f64 = 1e-14;

/// RMS of the closed loop at the samples by noise with a standard deviation of one.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseGains {
    /// Rotation of the hub, rad, about each axis (rows) by noise of the measured rotation about each (columns), rad.
    pub attitude: [[f64; 3]; 3],
    /// The same by noise of the measured angular velocity, rad/s: s.
    pub rate: [[f64; 3]; 3],
    /// The torque of the law, N m, by noise of the rotation and of the angular velocity.
    pub torque: [[[f64; 3]; 3]; 2],
}

impl ControlLoop {
    /// Of a stable loop; none of one that is not, or whose response is not over after two million samples.
    #[must_use]
    pub fn noise(&self) -> Option<NoiseGains> {
        if !self.closed.is_stable().ok()? {
            return None;
        }
        let feedback = self.closed.feedback();
        let [f, g, h] = self.closed.plant().with_waiting();
        let (n, own) = (f.nrows(), feedback.a.nrows());
        let mut states = DMatrix::zeros(n + own, 6);
        states.rows_mut(0, n).copy_from(&(g * &feedback.d));
        states.rows_mut(n, own).copy_from(&feedback.b);
        // Of the measured motion; of the torque that follows from it, noise of the present sample added.
        let mut rows = DMatrix::zeros(6, n + own);
        rows.view_mut((0, 0), (3, n)).copy_from(&h.rows(0, 3));
        rows.view_mut((3, 0), (3, n)).copy_from(&(&feedback.d * &h));
        rows.view_mut((3, n), (3, own)).copy_from(&feedback.c);
        let mut sums = DMatrix::<f64>::zeros(6, 6);
        sums.rows_mut(3, 3).copy_from(&feedback.d.map(|value| value * value));
        let mut total = sums.clone();
        for sample in 1..=SAMPLES_MAX {
            let response = &rows * &states;
            sums += response.component_mul(&response);
            states = self.closed.state_matrix() * states;
            if sample % BLOCK == 0 {
                let added = &sums - &total;
                if !added.iter().all(|value| value.is_finite()) {
                    return None;
                }
                let over = |row: usize| {
                    added.row(row).max() <= OVER * sums.row(row).max().max(f64::MIN_POSITIVE)
                };
                if (0..6).all(over) {
                    return Some(gains(&sums));
                }
                total.copy_from(&sums);
            }
        }
        None
    }
}

fn gains(squares: &DMatrix<f64>) -> NoiseGains {
    let block = |row: usize, column: usize| {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| squares[(row + i, column + j)].sqrt()))
    };
    NoiseGains { attitude: block(0, 0), rate: block(0, 3), torque: [block(3, 0), block(3, 3)] }
}
