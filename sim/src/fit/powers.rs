//! [`Group`]'s fit: powers of its lines over speed, by harmonics and modes together.
//!
//! Without an index the phase of a line is new in each record, and its magnitude is biased by noise; its
//! power less that of the noise is not. With `n = E|dA|²` of the noise and `m = P Omega⁴ |H|²`, the model,
//!
//! ```text
//! y = |A|² - n        E y = m        var y = 2 n m + n² (1 + 1 / bins)
//! ```
//!
//! (A is complex normal; the last term is the noise's own uncertainty.) `P = C²` and the modes solve the
//! estimating equations `sum (y - m) dm / var(m) = 0`: least squares whose weights are those of the model
//! itself (quasi-likelihood, Wedderburn 1974), unbiased at any ratio of signal to noise. Powers are linear,
//! so a line that the noise hides is zero within its interval and moves nothing else. The covariance is
//! that of the equations times the mean square of the weighted residuals where that is above 1: residuals may
//! show what the noise does not, and by chance be small (the scale factor of the Particle Data Group).
//!
//! A radial pair is taken as `z = y + i z`, with what turns about +x (forward, `A_+ = (A_y + i A_z) / 2`) and
//! against it (backward): gyroscopic modes amplify the two differently, so each harmonic has two coefficients.

use nalgebra::{Complex, DMatrix, DVector};

use super::error::FitError;
use super::estimate::Estimate;
use super::lines::Lines;
use super::measurement::Group;
use super::modes::{Mode, ModeGuess, amplification};
use super::problem::{
    DAMPING_RATIO, DIFFERENCE, Problem, SETTLED, equilibrated, free, modes, values,
};
use super::rotation::Rotation;

/// Iterations of the weights.
const REWEIGHTED: usize = 80;
/// Iterations of the weights before they are averaged.
const SWINGS: usize = 6;
/// A mode is determined where the 95 % intervals are within these factors of its frequency and damping ratio, and within
/// this half-width of its inertia ratio, which is from 0 to 2.
const FREQUENCY_KNOWN: f64 = 1.5;
const DAMPING_KNOWN: f64 = 10.0;
const RATIO_KNOWN: f64 = 0.5;
/// A damping ratio this near to an end of what is possible, as a share, is at it.
const AT_END: f64 = 1e-3;

/// About +x, or against it. Axial lines are forward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// With the angle of the wheel.
    Forward,
    /// Against it.
    Backward,
}

/// The power of a line at a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// Index of the record.
    pub record: usize,
    /// Index of the harmonic.
    pub line: usize,
    /// Which way it turns.
    pub sense: Sense,
    /// Speed of the wheel, rad/s.
    pub spin: f64,
    /// Angular frequency with the sign of its sense, rad/s.
    pub frequency: f64,
    /// `|A|²` less that of the noise, N² or N² m².
    pub power: f64,
    /// `E|dA|²`.
    pub noise: f64,
    /// Independent bins that the noise is the mean of.
    pub bins: f64,
    /// Independent segments that the power is the mean of.
    pub segments: f64,
    /// `A` itself, of the wheel's angle; zero of a waterfall.
    pub amplitude: Complex<f64>,
}

impl Power {
    /// The variance of `power`, where the line has the power `model`.
    #[must_use]
    pub fn variance(&self, model: f64) -> f64 {
        let n = self.noise;
        (2.0 * n * model.max(0.0) + n * n) / self.segments + n * n / self.bins
    }
}

/// A fitted mode.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedMode {
    /// Which forces or moments it amplifies.
    pub group: Group,
    /// Its best values.
    pub mode: Mode,
    /// rad/s.
    pub frequency: Estimate,
    /// Damping ratio.
    pub damping: Estimate,
    /// `I_s / I_r`.
    pub inertia_ratio: Estimate,
    /// Share of what acts that it carries.
    pub share: Estimate,
}

impl FittedMode {
    /// Refuses a mode whose numbers the lines do not determine.
    fn determined(&self) -> Result<(), FitError> {
        let ratio = |of: &Estimate| (of.interval[1] / of.interval[0]).sqrt();
        let half = |of: &Estimate| 0.5 * (of.interval[1] - of.interval[0]);
        let at_end = DAMPING_RATIO.map(|end| (self.mode.damping / end).ln().abs() < AT_END);
        let good = [
            ("frequency", self.frequency, ratio(&self.frequency) <= FREQUENCY_KNOWN),
            ("damping ratio", self.damping, ratio(&self.damping) <= DAMPING_KNOWN),
            ("damping ratio", self.damping, !at_end.contains(&true)),
            ("I_s / I_r", self.inertia_ratio, half(&self.inertia_ratio) <= RATIO_KNOWN),
            ("share", self.share, half(&self.share) <= self.share.value.abs()),
        ];
        // A comparison with what is no number is false.
        let Some((what, of, _)) = good.into_iter().find(|(_, _, good)| !good) else {
            return Ok(());
        };
        let hertz = self.mode.frequency / std::f64::consts::TAU;
        let interval = if what == "frequency" {
            of.interval.map(|w| w / std::f64::consts::TAU)
        } else {
            of.interval
        };
        Err(FitError::Mode { group: self.group, hertz, what, interval })
    }
}

/// The fit of one group.
#[derive(Clone, Debug)]
pub struct GroupFit {
    /// Which.
    pub group: Group,
    /// Of each harmonic forward and backward: `C² `, in units of `C` squared; none where no record has it.
    pub powers: Vec<[Option<Estimate>; 2]>,
    /// In the order of the guesses.
    pub modes: Vec<FittedMode>,
    /// What was fitted to.
    pub points: Vec<Power>,
    /// Sum of squared residuals by variance.
    pub squares: f64,
    /// Degrees of freedom.
    pub freedom: f64,
    /// Of powers, in the order of their columns, and of the free parameters of the modes.
    covariance: DMatrix<f64>,
    /// Column of each line forward and backward.
    column_of: Vec<Option<usize>>,
    /// Powers.
    count: usize,
    guesses: Vec<ModeGuess>,
    mode_values: Vec<f64>,
}

impl GroupFit {
    /// The modes' best values.
    #[must_use]
    pub fn shapes(&self) -> Vec<Mode> {
        self.modes.iter().map(|mode| mode.mode).collect()
    }

    /// The variance of a function of the modes by their uncertainty, to first order.
    #[must_use]
    pub fn variance_of(&self, of: &dyn Fn(&[Mode]) -> f64) -> f64 {
        let gradient = DVector::from_fn(self.mode_values.len(), |k, _| {
            let at = |step: f64| {
                let mut values = self.mode_values.clone();
                values[k] += step;
                of(&modes(&self.guesses, &values))
            };
            (at(DIFFERENCE) - at(-DIFFERENCE)) / (2.0 * DIFFERENCE)
        });
        let free = self.mode_values.len();
        let covariance = self.covariance.view((self.count, self.count), (free, free));
        (gradient.transpose() * covariance * &gradient)[(0, 0)].max(0.0)
    }

    /// The amplitude of a line by the model at a spin rate, rad/s, with its interval: `C Omega² |H|`, N or
    /// N m; none where no record has the line.
    #[must_use]
    pub fn predicted(&self, line: usize, order: f64, sense: Sense, spin: f64) -> Option<Estimate> {
        let column = (*self.column_of.get(place(line, sense))?)?;
        let power = self.powers.get(line)?[usize::from(sense == Sense::Backward)]?.value;
        let frequency = if sense == Sense::Backward { -order * spin } else { order * spin };
        let square = spin * spin;
        let gain = |values: &[f64]| {
            let modes = modes(&self.guesses, values);
            square * square * amplification(&modes, frequency, spin).norm_sqr()
        };
        let mut gradient = DVector::zeros(self.covariance.nrows());
        gradient[column] = gain(&self.mode_values);
        for k in 0..self.mode_values.len() {
            let at = |step: f64| {
                let mut values = self.mode_values.clone();
                values[k] += step;
                gain(&values)
            };
            gradient[self.count + k] =
                power * (at(DIFFERENCE) - at(-DIFFERENCE)) / (2.0 * DIFFERENCE);
        }
        let variance = (gradient.transpose() * &self.covariance * &gradient)[(0, 0)].max(0.0);
        Some(Estimate::new(power * gain(&self.mode_values), variance.sqrt(), self.freedom).root())
    }

    /// Power of a point by the model, N² or N² m².
    #[must_use]
    pub fn model(&self, point: &Power) -> f64 {
        let c = self.coefficient(point.line, point.sense);
        let square = point.spin * point.spin;
        let gain = amplification(&self.shapes(), point.frequency, point.spin).norm_sqr();
        c * c * square * square * gain
    }

    /// Residual of a point by its standard deviation.
    #[must_use]
    pub fn residual(&self, point: &Power) -> f64 {
        let model = self.model(point);
        (point.power - model) / point.variance(model).sqrt()
    }

    /// The best `C` of a harmonic and sense; 0 where it is unknown.
    #[must_use]
    pub fn coefficient(&self, line: usize, sense: Sense) -> f64 {
        let of =
            self.powers.get(line).and_then(|powers| powers[usize::from(sense == Sense::Backward)]);
        of.map_or(0.0, |power| power.value.max(0.0).sqrt())
    }
}

/// The powers of the lines of a group.
#[must_use]
pub(super) fn powers(
    group: Group,
    orders: &[f64],
    rotations: &[Rotation],
    all: &[Lines],
) -> Vec<Power> {
    let mut points = Vec::new();
    let [first, second] = group.channels();
    let i = Complex::<f64>::i();
    for (record, (found, rotation)) in all.iter().zip(rotations).enumerate() {
        for (line, order) in orders.iter().enumerate() {
            let Some(of) = found.sets.get(line).and_then(Option::as_ref) else { continue };
            let w = order * rotation.speed;
            let (a, b) = (of.channels[first], of.channels[second]);
            let bins = found.noise_bins[line];
            let mut add = |sense, amplitude: Complex<f64>, noise: f64, frequency| {
                points.push(Power {
                    record,
                    line,
                    sense,
                    spin: rotation.speed,
                    frequency,
                    power: amplitude.norm_sqr() - noise,
                    noise,
                    bins,
                    segments: 1.0,
                    amplitude,
                });
            };
            if group.is_radial() {
                let mean = 0.25 * (a.noise + b.noise);
                // What modes make turn has noise that differs forward and backward.
                let turning = 0.5 * of.noise[first][second].im;
                add(Sense::Forward, (a.amplitude + i * b.amplitude) * 0.5, mean + turning, w);
                // The conjugate of what turns against the wheel.
                add(Sense::Backward, (a.amplitude - i * b.amplitude) * 0.5, mean - turning, -w);
            } else {
                add(Sense::Forward, a.amplitude, a.noise, w);
            }
        }
    }
    points
}

/// The place of a line's power, forward or backward.
fn place(line: usize, sense: Sense) -> usize {
    2 * line + usize::from(sense == Sense::Backward)
}

/// Fits powers and modes to the points of a group.
///
/// # Errors
/// [`FitError::Few`], [`FitError::Diverged`] or [`FitError::Undetermined`].
pub(super) fn fit(
    group: Group,
    lines: usize,
    points: Vec<Power>,
    guesses: &[ModeGuess],
) -> Result<GroupFit, FitError> {
    let guesses: Vec<_> = guesses.iter().filter(|guess| guess.group == group).copied().collect();
    // Powers without a point have no column.
    let mut column_of = vec![None; 2 * lines];
    let mut count = 0;
    for point in &points {
        let column = &mut column_of[place(point.line, point.sense)];
        if column.is_none() {
            *column = Some(count);
            count += 1;
        }
    }
    let column = |point: &Power| column_of[place(point.line, point.sense)].unwrap_or_default();
    let columns = points.iter().map(column).collect();
    let problem = Problem { points: &points, guesses: &guesses, columns, count };
    let mode_values = values(&guesses);
    let size = count + mode_values.len();
    if points.len() <= size {
        return Err(FitError::Few { group, found: points.len(), parameters: size });
    }
    let mut parameters = DVector::zeros(size);
    for (k, value) in mode_values.iter().enumerate() {
        parameters[count + k] = *value;
    }
    // First by what was measured: a line far above its noise has the variance 2 n |A|².
    let measured: Vec<f64> = points.iter().map(|point| point.power).collect();
    let mut weights = problem.weights(&measured);
    problem.powers(&mut parameters, &weights);
    let mut settled = false;
    for iteration in 0..REWEIGHTED {
        let next = problem.minimise(parameters.clone(), &weights);
        let (normal, _) = problem.normal(&next, &weights);
        let moves = (0..size).map(|k| (next[k] - parameters[k]).abs() * normal[(k, k)].sqrt());
        // The first weights are those of the measured powers, not of the model.
        settled = iteration > 0 && moves.fold(0.0, f64::max) < 10.0 * SETTLED;
        let last = std::mem::replace(&mut parameters, next);
        // Weights of a line in the noise may swing: from half way between two fits they settle.
        let half =
            if iteration < SWINGS { parameters.clone() } else { 0.5 * (&parameters + &last) };
        let gains = problem.gains(&problem.modes(&half));
        weights = problem.weights(&problem.model(&half, &gains));
        if settled {
            break;
        }
    }
    if !settled || parameters.iter().any(|p| !p.is_finite()) {
        return Err(FitError::Diverged { group, iterations: REWEIGHTED });
    }
    let (normal, _) = problem.normal(&parameters, &weights);
    let covariance = equilibrated(&normal).ok_or(FitError::Undetermined { group })?;
    #[expect(clippy::cast_precision_loss, reason = "a count of lines")]
    let freedom = (points.len() - size) as f64;
    let squares = problem.squares(&parameters, &weights);
    let covariance = covariance * (squares / freedom).max(1.0);
    let estimate =
        |k: usize| Estimate::new(parameters[k], covariance[(k, k)].max(0.0).sqrt(), freedom);
    let powers = (0..lines)
        .map(|line| {
            [Sense::Forward, Sense::Backward].map(|s| column_of[place(line, s)].map(estimate))
        })
        .collect();
    let fitted = fitted(&guesses, &problem.modes(&parameters), count, &estimate);
    fitted.iter().try_for_each(FittedMode::determined)?;
    Ok(GroupFit {
        group,
        powers,
        modes: fitted,
        squares,
        freedom,
        covariance,
        column_of,
        count,
        mode_values: parameters.iter().skip(count).copied().collect(),
        guesses,
        points,
    })
}

/// The modes with their estimates.
fn fitted(
    guesses: &[ModeGuess],
    modes: &[Mode],
    count: usize,
    estimate: &dyn Fn(usize) -> Estimate,
) -> Vec<FittedMode> {
    let mut k = count;
    let mut next = |free: bool, or: f64| {
        if !free {
            return Estimate::exact(or);
        }
        k += 1;
        estimate(k - 1)
    };
    let each = guesses.iter().zip(modes);
    each.map(|(guess, mode)| {
        let [a, b, c, d] = free(guess);
        FittedMode {
            group: guess.group,
            mode: *mode,
            frequency: next(a, mode.frequency).exponential(),
            damping: next(b, mode.damping).exponential(),
            inertia_ratio: next(c, mode.inertia_ratio),
            share: next(d, mode.share),
        }
    })
    .collect()
}
