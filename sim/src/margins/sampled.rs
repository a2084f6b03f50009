//! [`ControlledSamples`]: a [`ControlledPlant`] from one sample of its controller to the next, exactly.
//!
//! What a sample gives, `a_k`, acts from its delay on: torques of motors, or with a servo at a rate of its own commands, from
//! which torques are computed when they come to act and at its own times.
//!
//! ```text
//! delay = m T + r, 0 <= r < T:      x_k+1 = Phi x_k + Gamma_0 a_k-m + Gamma_1 a_k-m-1 + D w_k
//! a_k = E x_k + F tau_k + N r_k + V w_k     w_k = exp(i w k T)
//! s_k+1 = A s_k + B y_k      r_k = C s_k + D y_k      y_k: what sensors have of x_k, r_k: what the law reads
//! ```
//!
//! With `x = x_w + xi`, where `x_w` is the motion under a load `exp(i w t)` with motors held, `xi` has the equation without load,
//! but that what computes torques reads `x`.

use nalgebra::{Complex, DMatrix};
use precess_control::{ControlError, Feedback, HeldPlant, SampledPlant, Sampling};

use super::MarginsError;
use super::measurement::{Measurement, whole};
use super::plant::ControlledPlant;
use crate::scenario::SampledController;
use crate::structure::accelerance::{ComplexMatrix, complex};

/// A number of periods or of servo times that is whole to within rounding.
const WHOLE: f64 = 1e-9;
/// A singular value that is a smaller share of the largest is rounding.
const RANK: f64 = 1e-12;

/// From sample to sample.
#[derive(Clone, Debug)]
pub struct ControlledSamples {
    /// Period and delay.
    pub sampling: Sampling,
    /// Whole periods of the delay.
    periods: usize,
    /// Times within a period at which the servo computes torques, but for the samples, s.
    computed: Vec<f64>,
    phi: DMatrix<f64>,
    /// By what acts from within this period on, and by what acted before.
    gamma: [DMatrix<f64>; 2],
    /// The states with what was given and waits, by what is given newly.
    newly: DMatrix<f64>,
    /// What a sample gives, by the state, by the torque of the law, and by what it reads.
    given: [DMatrix<f64>; 3],
    /// The directions that what is given has, orthonormal; none where it has all.
    directions: Option<DMatrix<f64>>,
    /// From what sensors have of the motion to what the law reads.
    measurement: Measurement,
    /// What sensors have of the motion, by the state.
    sensed: DMatrix<f64>,
    /// What a sample gives, by loads on the coordinates.
    by_load: DMatrix<f64>,
    /// Times within a period, s, from which on torques of motors are held, and whether what is given at this period has come to
    /// act.
    times: Vec<(f64, bool)>,
    /// From each of these times to the next: the state by the state and by held torques.
    steps: Vec<[DMatrix<f64>; 2]>,
    /// At these times: torques by the state, by what acts, and by loads.
    torques: [DMatrix<f64>; 3],
}

/// What acts on the loop with `exp(i w t)`, a column for each.
#[derive(Clone, Debug)]
pub struct Forced {
    /// rad/s.
    pub frequency: f64,
    /// The load on the coordinates that the servo knows.
    pub known: ComplexMatrix,
    /// The motion with motors held, as states at the time zero.
    pub states: ComplexMatrix,
    /// What is added to the readings at the samples: attitude, rad, and rate, rad/s.
    pub noise: ComplexMatrix,
}

impl ControlledSamples {
    /// Of a plant and its controller.
    ///
    /// # Errors
    /// [`MarginsError::ServoRate`]; numbers that are not finite.
    pub fn new(plant: &ControlledPlant, of: &SampledController) -> Result<Self, MarginsError> {
        let period = of.rate.recip();
        let [by_state, by_command, by_load] = plant.servo.clone();
        let commands =
            [plant.by_state.clone(), plant.allocation.by_torque.clone(), plant.by_read.clone()];
        let count = by_command.nrows();
        let mut computed = Vec::new();
        let (given, given_by_load, torques) = match of.servo.rate {
            None => {
                let [first, second, third] = commands.map(|of| &by_command * of);
                let given = [&by_state + first, second, third];
                let none = |columns| DMatrix::zeros(count, columns);
                let kept = [none(by_state.ncols()), DMatrix::identity(count, count)];
                let [states, acts] = kept;
                let no_load = none(by_load.ncols());
                (given, by_load, [states, acts, no_load])
            }
            Some(servo) => {
                let ratio = servo / of.rate;
                if (ratio - ratio.round()).abs() > WHOLE * ratio {
                    return Err(MarginsError::ServoRate { rate: of.rate, servo });
                }
                let share = |k: usize| crate::spectra::float(k) / ratio.round();
                computed.extend((1..whole(ratio)).map(|k| period * share(k)));
                let none = DMatrix::zeros(count, by_load.ncols());
                (commands, none, [by_state, by_command, by_load])
            }
        };
        let sampling = Sampling { period, delay: of.delay };
        let none = || DMatrix::zeros(0, 0);
        let samples = Self {
            sampling,
            periods: 0,
            computed,
            phi: none(),
            gamma: [none(), none()],
            newly: none(),
            directions: directions(&given),
            given,
            measurement: Measurement::new(of)?,
            sensed: plant.sensed.clone(),
            by_load: given_by_load,
            times: Vec::new(),
            steps: Vec::new(),
            torques,
        };
        Ok(Self { sampling, ..samples.with_delay(&plant.held, sampling.split()) })
    }

    /// The same with a delay of so many whole periods and the rest of it, s.
    pub(super) fn with_delay(&self, held: &HeldPlant, delay: (usize, f64)) -> Self {
        let period = self.sampling.period;
        let (_, rest) = rounded(period, delay);
        let mut times = vec![(0.0, rest == 0.0), (rest, true)];
        times.extend(self.computed.iter().map(|time| (*time, *time >= rest)));
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        times.dedup_by(|a, b| {
            (a.0 - b.0).abs() < WHOLE * period && {
                b.1 |= a.1;
                true
            }
        });
        let mut samples = Self { times, ..self.clone() };
        samples.steps = samples.held_steps(held);
        let [phi, newer, older] = samples.over_period();
        (samples.phi, samples.gamma) = (phi, [newer, older]);
        samples.with_periods(delay)
    }

    /// The same with another number of whole periods, beside the rest that the delay has.
    pub(super) fn with_periods(mut self, delay: (usize, f64)) -> Self {
        let (periods, rest) = rounded(self.sampling.period, delay);
        self.sampling.delay = crate::spectra::float(periods) * self.sampling.period + rest;
        self.periods = periods;
        let [_, newly] = self.with_waiting(&self.gamma);
        self.newly = newly;
        self
    }

    /// The state at the next sample: by the state, by what acts newly, by what acted before.
    fn over_period(&self) -> [DMatrix<f64>; 3] {
        let (n, count) = (self.torques[0].ncols(), self.torques[1].ncols());
        let mut maps =
            [DMatrix::identity(n, n), DMatrix::zeros(n, count), DMatrix::zeros(n, count)];
        let [by_state, by_given, _] = &self.torques;
        for ((_, newly), [phi, gamma]) in self.times.iter().zip(&self.steps) {
            let mut by = maps.each_ref().map(|map| by_state * map);
            by[if *newly { 1 } else { 2 }] += by_given;
            for (map, torque) in maps.iter_mut().zip(&by) {
                *map = phi * &*map + gamma * torque;
            }
        }
        maps
    }

    fn held_steps(&self, held: &HeldPlant) -> Vec<[DMatrix<f64>; 2]> {
        let step = |((from, _), to): (&(f64, bool), f64)| held.step(to - from);
        self.times.iter().zip(self.ends()).map(step).collect()
    }

    /// Whether torques are computed at the samples only, and held in between.
    fn is_held(&self) -> bool {
        let [by_state, _, by_load] = &self.torques;
        by_state.iter().chain(by_load).all(|element| *element == 0.0)
    }

    /// The ends of the times within a period.
    fn ends(&self) -> impl Iterator<Item = f64> {
        let next = self.times.iter().skip(1).map(|(at, _)| *at);
        next.chain(std::iter::once(self.sampling.period))
    }

    /// From the torque of the law to what it reads at the samples. Behind the states of the spacecraft there is what was
    /// given and waits, newest first, then the states of the measurement. Beside it: what noise of the readings adds to these.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn plant(&self) -> Result<(SampledPlant, DMatrix<f64>), ControlError> {
        self.plant_of(&self.gamma, &self.given)
    }

    /// The same with no more waiting than the rank of what is given: three numbers where commands follow from a torque.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn least_plant(&self) -> Result<(SampledPlant, DMatrix<f64>), ControlError> {
        let Some(directions) = &self.directions else { return self.plant() };
        let gamma = self.gamma.each_ref().map(|of| of * directions);
        let given = self.given.each_ref().map(|of| directions.transpose() * of);
        self.plant_of(&gamma, &given)
    }

    fn plant_of(
        &self,
        gamma: &[DMatrix<f64>; 2],
        [by_state, by_torque, by_read]: &[DMatrix<f64>; 3],
    ) -> Result<(SampledPlant, DMatrix<f64>), ControlError> {
        let [f, g] = self.with_waiting(gamma);
        let Feedback { a, b, c, d } = &self.measurement.chain;
        let (n, own, more) = (self.phi.nrows(), f.nrows(), a.nrows());
        let mut closed = DMatrix::zeros(own + more, own + more);
        closed.view_mut((0, 0), (own, own)).copy_from(&f);
        let mut states = closed.view_mut((0, 0), (own, n));
        states += &g * (by_state + by_read * d * &self.sensed);
        closed.view_mut((0, own), (own, more)).copy_from(&(&g * by_read * c));
        closed.view_mut((own, 0), (more, n)).copy_from(&(b * &self.sensed));
        closed.view_mut((own, own), (more, more)).copy_from(a);
        let mut by_command = DMatrix::zeros(own + more, by_torque.ncols());
        by_command.rows_mut(0, own).copy_from(&(&g * by_torque));
        let mut read = DMatrix::zeros(d.nrows(), own + more);
        read.columns_mut(0, n).copy_from(&(d * &self.sensed));
        read.columns_mut(own, more).copy_from(c);
        let [to_states, directly] = &self.measurement.noise;
        let mut noise = DMatrix::zeros(own + more, directly.ncols());
        noise.rows_mut(0, own).copy_from(&(&g * by_read * directly));
        noise.rows_mut(own, more).copy_from(to_states);
        let plant = SampledPlant::from_matrices(self.sampling, [closed, by_command, read])?;
        Ok((plant, noise))
    }

    /// What the law reads at once of motion and readings, without the states of the measurement.
    #[must_use]
    pub fn read_at_once(&self, of: &Forced) -> ComplexMatrix {
        self.of_motion(&of.states) + complex(self.noise_at_once()) * &of.noise
    }

    fn of_motion(&self, states: &ComplexMatrix) -> ComplexMatrix {
        complex(&self.measurement.chain.d) * (complex(&self.sensed) * states)
    }

    /// What noise of the readings is of what the law reads, at once.
    #[must_use]
    pub fn noise_at_once(&self) -> &DMatrix<f64> {
        let [_, directly] = &self.measurement.noise;
        directly
    }

    /// What the law reads of what acts and the states of [`Self::plant`] beside it.
    #[must_use]
    pub fn read(&self, of: &Forced, states: &ComplexMatrix) -> ComplexMatrix {
        let c = complex(&self.measurement.chain.c);
        let own = states.rows(0, self.phi.nrows()).into_owned();
        let measured = states.rows(states.nrows() - c.ncols(), c.ncols()).into_owned();
        self.of_motion(&own) + self.read_at_once(of) + c * measured
    }

    /// `X = [x; a_k-1; ..; a_k-m-1]`: `X_k+1 = F X_k + G a_k`.
    fn with_waiting(&self, [newer, older]: &[DMatrix<f64>; 2]) -> [DMatrix<f64>; 2] {
        let (n, count) = newer.shape();
        let size = n + (self.periods + 1) * count;
        let block = |number: usize| n + number * count;
        let (mut f, mut g) = (DMatrix::zeros(size, size), DMatrix::zeros(size, count));
        f.view_mut((0, 0), (n, n)).copy_from(&self.phi);
        f.view_mut((0, block(self.periods)), (n, count)).copy_from(older);
        match self.periods.checked_sub(1) {
            None => g.rows_mut(0, n).copy_from(newer),
            Some(last) => f.view_mut((0, block(last)), (n, count)).copy_from(newer),
        }
        g.rows_mut(n, count).fill_with_identity();
        for number in 1..=self.periods {
            f.view_mut((block(number), block(number - 1)), (count, count)).fill_with_identity();
        }
        [f, g]
    }

    /// What acts adds to the states of [`Self::plant`] in a period, `w_k` being one: `D + G (E x_w + N r_w + V w)`, and of
    /// the measurement `B y_w`.
    #[must_use]
    pub fn driven_by(&self, of: &Forced) -> ComplexMatrix {
        let (g, n, columns) = (&self.newly, self.phi.nrows(), of.states.ncols());
        let Feedback { a, b, .. } = &self.measurement.chain;
        let mut added = ComplexMatrix::zeros(g.nrows() + a.nrows(), columns);
        let [by_state, _, by_load] = &self.torques;
        if !self.is_held() {
            let torque = complex(by_state) * &of.states + complex(by_load) * &of.known;
            // Torques that are computed within the period read the forced motion, too.
            let mut within = ComplexMatrix::zeros(n, columns);
            for ((from, _), [phi, gamma]) in self.times.iter().zip(&self.steps) {
                let turned = &torque * Complex::from_polar(1.0, of.frequency * from);
                let read = complex(by_state) * &within + turned;
                within = complex(phi) * within + complex(gamma) * read;
            }
            added.rows_mut(0, n).copy_from(&within);
        }
        let given = complex(&self.given[0]) * &of.states
            + complex(&self.given[2]) * self.read_at_once(of)
            + complex(&self.by_load) * &of.known;
        let mut by_given = added.rows_mut(0, g.nrows());
        by_given += complex(g) * given;
        let [to_states, _] = &self.measurement.noise;
        let measured =
            complex(b) * (complex(&self.sensed) * &of.states) + complex(to_states) * &of.noise;
        added.rows_mut(g.nrows(), a.nrows()).copy_from(&measured);
        added
    }

    /// The component at an angular frequency, rad/s, which is that of the samples or one of its images, of the torques of motors,
    /// from the states of [`Self::plant`] for `w_k = exp(i w k T)`, the newest of what is given included.
    #[must_use]
    pub fn torques_at(
        &self,
        of: &Forced,
        (image, states, torque): (f64, &ComplexMatrix, &ComplexMatrix),
    ) -> ComplexMatrix {
        let (n, count) = (self.phi.nrows(), self.torques[1].ncols());
        let own = states.rows(0, n).into_owned();
        let newest = complex(&self.given[0]) * (&own + &of.states)
            + complex(&self.given[1]) * torque
            + complex(&self.given[2]) * self.read(of, states)
            + complex(&self.by_load) * &of.known;
        // What is given so many samples ago.
        let ago = |samples: usize| match samples.checked_sub(1) {
            None => newest.clone(),
            Some(index) => states.rows(n + index * count, count).into_owned(),
        };
        let (newer, older) = (ago(self.periods), ago(self.periods + 1));
        let [by_state, by_given, by_load] = self.torques.each_ref().map(complex);
        let read = &by_state * &of.states + by_load * &of.known;
        let (period, is_held) = (self.sampling.period, self.is_held());
        let mut sum = ComplexMatrix::zeros(count, states.ncols());
        let mut state = own;
        let parts = self.times.iter().zip(self.ends()).zip(&self.steps);
        for (((from, newly), to), [phi, gamma]) in parts {
            let mut held = &by_given * if *newly { &newer } else { &older };
            if !is_held {
                held += &by_state * &state + &read * Complex::from_polar(1.0, of.frequency * from);
                state = complex(phi) * state + complex(gamma) * &held;
            }
            sum += held * (integral(image, [*from, to]) / period);
        }
        sum
    }
}

/// An orthonormal basis of the columns of what is given; none where these are as many as it has rows.
fn directions(given: &[DMatrix<f64>; 3]) -> Option<DMatrix<f64>> {
    let all: Vec<_> =
        given.iter().flat_map(|of| of.column_iter().map(nalgebra::Matrix::into_owned)).collect();
    let parts = DMatrix::from_columns(&all).svd(true, false);
    let least = RANK * parts.singular_values.max();
    let kept: Vec<usize> =
        (0..parts.singular_values.len()).filter(|k| parts.singular_values[*k] > least).collect();
    let directions = parts.u.filter(|of| kept.len() < of.nrows())?;
    Some(directions.select_columns(&kept))
}

/// A rest that is none, or a period, to within rounding.
fn rounded(period: f64, (periods, rest): (usize, f64)) -> (usize, f64) {
    if rest > period * (1.0 - WHOLE) {
        (periods.saturating_add(1), 0.0)
    } else if rest < period * WHOLE {
        (periods, 0.0)
    } else {
        (periods, rest)
    }
}

/// `int exp(-i w t) dt`.
fn integral(w: f64, [from, to]: [f64; 2]) -> Complex<f64> {
    let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
    let u = w * half;
    let sinc = if u.abs() < 1e-6 { 1.0 - u * u / 6.0 } else { u.sin() / u };
    Complex::from_polar(2.0 * half * sinc, -w * middle)
}

/// A complex matrix of a real one, for solutions at a z.
pub(super) fn at(z: Complex<f64>, of: &DMatrix<f64>) -> ComplexMatrix {
    let mut system = -complex(of);
    for k in 0..system.nrows() {
        system[(k, k)] += z;
    }
    system
}
