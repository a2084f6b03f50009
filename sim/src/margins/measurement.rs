//! [`Measurement`]: from the motion of the hub at the samples to what the law reads: sensors, estimator, filters of the rate.
//!
//! ```text
//! y = [attitude; attitude and rate of the gyro] -> readings (noise is added) -> estimator or latency -> filters of the rate -> law
//! integrating gyro    (theta_k - theta_k-1) / T
//! star tracker        theta_k-m, m the samples of its latency
//! estimator           x_k+1 = x_k + T (w_k+1 - b_k) before, + K innovation after a measurement; b + L innovation; K, L steady
//! ```
//!
//! A star tracker that measures less often than the controller samples is periodic. Held in between, it has at the frequency
//! of a motion the transfer `sum h_j z^-j`, `h_j` the share of samples at which the measurement is so old (what it shows at images
//! is left out); with an estimator it is one that measures at each sample with as much information, the variance times the
//! ratio of the rates.

use nalgebra::{DMatrix, Matrix3};
use precess_control::{Feedback, GyroOutput};

use super::MarginsError;
use crate::jitter::campbell::node_rows;
use crate::jitter::model::Model;
use crate::scenario::SampledController;

/// Numbers of a motion that sensors have: attitude of the star tracker, attitude and angular velocity of the gyro.
pub const SENSED: usize = 9;
/// Numbers that the law reads: attitude and angular velocity.
pub const READ: usize = 6;
/// The first coordinate of the rotation; those before are of the translation, which is eliminated.
const ROTATION: usize = 3;
/// Of a period, by which times that are equal but for rounding may differ: as in a run.
const ROUNDING: f64 = 1e-9;

/// What a controller makes of the motion.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// From the motion, [`SENSED`] numbers, to what the law reads, [`READ`] numbers.
    pub chain: Feedback,
    /// What is added to the readings of attitude and rate: to the states of `chain`, and to what the law reads.
    pub noise: [DMatrix<f64>; 2],
}

/// White noise of the readings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadingNoise {
    /// Covariance of the attitude about the axes of B at a sample, rad².
    pub attitude: Matrix3<f64>,
    /// Standard deviation of the angular velocity about each axis, rad/s.
    pub rate: f64,
}

impl ReadingNoise {
    /// The same of each axis: standard deviations, rad and rad/s.
    #[must_use]
    pub fn new(attitude: f64, rate: f64) -> Self {
        Self { attitude: Matrix3::from_diagonal_element(attitude * attitude), rate }
    }

    /// That of the sensors of a controller: of the star tracker its deviations (for one that measures less often the variance times
    /// the ratio of the rates), of the gyro `N / sqrt(T)`, of an integrating one with the white part of its rate random walk. What has
    /// no sensor has none.
    ///
    /// # Errors
    /// [`MarginsError::Control`].
    pub fn of_sensors(of: &SampledController) -> Result<Self, MarginsError> {
        let built = of.built_sensors().map_err(|(_, error)| error)?;
        let attitude = built.star_tracker.map_or_else(Matrix3::zeros, |star| star.covariance());
        let rate = of.sensors.gyro.map_or(0.0, |gyro| {
            let white = gyro.angle_random_walk.powi(2) * of.rate;
            let walk = gyro.rate_random_walk.powi(2) / (12.0 * of.rate);
            let walk = if gyro.output == GyroOutput::Integrating { walk } else { 0.0 };
            (white + walk).sqrt()
        });
        Ok(Self { attitude: attitude * star_ratio(of), rate })
    }

    /// Standard deviations of the attitude about the axes of B, rad.
    #[must_use]
    pub fn attitude_deviations(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.attitude[(axis, axis)].max(0.0).sqrt())
    }
}

/// Samples of the controller for each measurement of the star tracker.
pub(super) fn star_ratio(of: &SampledController) -> f64 {
    let star = of.sensors.star_tracker.and_then(|star| star.rate);
    star.map_or(1.0, |rate| (of.rate / rate).max(1.0))
}

impl Measurement {
    /// Of the sensors, the estimator and the filters of a controller.
    ///
    /// # Errors
    /// [`MarginsError::Control`]: what [`Scenario::check`](crate::scenario::Scenario::check) rejects.
    pub fn new(of: &SampledController) -> Result<Self, MarginsError> {
        let built = of.built_sensors().map_err(|(_, error)| error)?;
        let period = of.rate.recip();
        let output = of.sensors.gyro.map(|gyro| gyro.output).unwrap_or_default();
        let latency = of.sensors.star_tracker.map_or(0.0, |star| star.latency);
        let late = whole((latency / period - ROUNDING).ceil().max(0.0));
        let ratio = star_ratio(of);
        let mut read = match built.estimator {
            Some(mut parameters) => {
                parameters.measured *= ratio;
                estimator(&parameters.steady_gains()?, period, late)?
            }
            None => late_attitude(late, ratio),
        };
        let [rate, _] = &built.filters;
        for section in rate.first().map(precess_control::Filter::sections).unwrap_or_default() {
            read = read.then(&beside(&identity(), &Feedback::section(section, 3)))?;
        }
        let noise = [DMatrix::zeros(0, 0), read.d.clone()];
        let sensors = sensors(output, period);
        let chain = sensors.then(&read)?;
        let mut by_noise = DMatrix::zeros(chain.a.nrows(), READ);
        by_noise.rows_mut(sensors.a.nrows(), read.a.nrows()).copy_from(&read.b);
        let [_, directly] = noise;
        Ok(Self { chain, noise: [by_noise, directly] })
    }
}

/// Rows of what sensors have, on nodes or on the hub: rotations by coordinates, of which those of rotation and modes are the first
/// states, and their rates.
pub(super) fn sensed(
    model: &Model,
    of: &SampledController,
    (all, moved, kept): (usize, usize, usize),
) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(SENSED, kept + all - ROTATION);
    let [star, gyro] = [
        of.sensors.star_tracker.and_then(|star| star.node),
        of.sensors.gyro.and_then(|gyro| gyro.node),
    ];
    for (first, node, column) in [(0, star, 0), (3, gyro, 0), (6, gyro, kept)] {
        match node {
            None => rows.view_mut((first, column), (3, 3)).fill_with_identity(),
            Some(node) => {
                let of_node = node_rows(model, node, all);
                let turned = of_node.view((ROTATION, ROTATION), (3, moved));
                rows.view_mut((first, column), (3, moved)).copy_from(&turned);
            }
        }
    }
    rows
}

/// The filters of the torque, one after another.
///
/// # Errors
/// [`MarginsError::Control`].
pub(super) fn torque_filters(of: &SampledController) -> Result<Feedback, MarginsError> {
    let built = of.built_sensors().map_err(|(_, error)| error)?;
    let [_, torque] = &built.filters;
    let mut all = identity();
    for section in torque.first().map(precess_control::Filter::sections).unwrap_or_default() {
        all = all.then(&Feedback::section(section, 3))?;
    }
    Ok(all)
}

fn identity() -> Feedback {
    Feedback::gain(DMatrix::identity(3, 3))
}

/// Readings: six numbers.
fn sensors(output: GyroOutput, period: f64) -> Feedback {
    let mut d = DMatrix::zeros(READ, SENSED);
    d.view_mut((0, 0), (3, 3)).fill_with_identity();
    if output == GyroOutput::Sampled {
        d.view_mut((3, 6), (3, 3)).fill_with_identity();
        return Feedback::gain(d);
    }
    d.view_mut((3, 3), (3, 3)).fill_diagonal(period.recip());
    let mut b = DMatrix::zeros(3, SENSED);
    b.view_mut((0, 3), (3, 3)).fill_with_identity();
    let mut c = DMatrix::zeros(READ, 3);
    c.view_mut((3, 0), (3, 3)).fill_diagonal(-period.recip());
    Feedback { a: DMatrix::zeros(3, 3), b, c, d }
}

/// `y_k = sum taps_j u_k-j`, at least one of them.
fn delayed(taps: &[DMatrix<f64>]) -> Feedback {
    let Some((now, earlier)) = taps.split_first() else {
        return Feedback::gain(DMatrix::zeros(0, 0));
    };
    let (outputs, inputs) = now.shape();
    let size = earlier.len() * inputs;
    let (mut a, mut b) = (DMatrix::zeros(size, size), DMatrix::zeros(size, inputs));
    let mut c = DMatrix::zeros(outputs, size);
    for (index, tap) in earlier.iter().enumerate() {
        let at = index * inputs;
        c.columns_mut(at, inputs).copy_from(tap);
        match index.checked_sub(1) {
            None => b.rows_mut(0, inputs).fill_with_identity(),
            Some(before) => {
                a.view_mut((at, before * inputs), (inputs, inputs)).fill_with_identity();
            }
        }
    }
    Feedback { a, b, c, d: now.clone() }
}

/// The last measurement of the attitude that has arrived, the rate as it is.
fn late_attitude(late: usize, ratio: f64) -> Feedback {
    let mut taps = vec![DMatrix::zeros(3, 3); late];
    let full = whole(ratio.floor());
    taps.extend((0..full).map(|_| DMatrix::from_diagonal_element(3, 3, ratio.recip())));
    let rest = (ratio - ratio.floor()) / ratio;
    if rest > ROUNDING {
        taps.push(DMatrix::from_diagonal_element(3, 3, rest));
    }
    beside(&delayed(&taps), &identity())
}

/// The estimator with measurements that arrive some samples later: it is brought up to the sample of the measurement, and from
/// there on by the readings of the gyro.
fn estimator(
    [k, l]: &[Matrix3<f64>; 2],
    period: f64,
    late: usize,
) -> Result<Feedback, MarginsError> {
    // Both readings at the sample of the measurement; the reading now; the sum of the readings in between.
    let taps: Vec<DMatrix<f64>> = (0..=late)
        .map(|age| {
            let mut tap = DMatrix::zeros(12, READ);
            if age == late {
                tap.view_mut((0, 0), (6, 6)).fill_with_identity();
            }
            if age == 0 {
                tap.view_mut((6, 3), (3, 3)).fill_with_identity();
            }
            if age < late {
                tap.view_mut((9, 3), (3, 3)).fill_with_identity();
            }
            tap
        })
        .collect();
    let (one, mut a) = (Matrix3::identity(), DMatrix::zeros(6, 6));
    let rest = one - k;
    a.view_mut((0, 0), (3, 3)).copy_from(&rest);
    a.view_mut((0, 3), (3, 3)).copy_from(&(rest * -period));
    a.view_mut((3, 0), (3, 3)).copy_from(&-l);
    a.view_mut((3, 3), (3, 3)).copy_from(&(one + l * period));
    let mut b = DMatrix::zeros(6, 12);
    b.view_mut((0, 0), (3, 3)).copy_from(k);
    b.view_mut((0, 3), (3, 3)).copy_from(&(rest * period));
    b.view_mut((3, 0), (3, 3)).copy_from(l);
    b.view_mut((3, 3), (3, 3)).copy_from(&(l * -period));
    let mut to_now = DMatrix::identity(6, 6);
    to_now.view_mut((0, 3), (3, 3)).fill_diagonal(-period * crate::spectra::float(late));
    to_now.view_mut((3, 3), (3, 3)).fill_diagonal(-1.0);
    let mut d = &to_now * &b;
    d.view_mut((0, 9), (3, 3)).fill_diagonal(period);
    d.view_mut((3, 6), (3, 3)).fill_diagonal(1.0);
    let c = to_now * &a;
    Ok(delayed(&taps).then(&Feedback { a, b, c, d })?)
}

/// Two, each on signals of its own.
fn beside(first: &Feedback, second: &Feedback) -> Feedback {
    let diagonal = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        let mut both = DMatrix::zeros(a.nrows() + b.nrows(), a.ncols() + b.ncols());
        both.view_mut((0, 0), a.shape()).copy_from(a);
        both.view_mut(a.shape(), b.shape()).copy_from(b);
        both
    };
    Feedback {
        a: diagonal(&first.a, &second.a),
        b: diagonal(&first.b, &second.b),
        c: diagonal(&first.c, &second.c),
        d: diagonal(&first.d, &second.d),
    }
}

/// A number that is whole and not negative.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number, of at most a million samples or servo times"
)]
pub(super) fn whole(number: f64) -> usize {
    number.round() as usize
}
