//! [`SampledPlant`]: a linear plant behind a zero-order hold and a delay, exactly discretised.
//!
//! ```text
//! x' = A x + B u(t)      y_k = C x(t_k)      u(t) = u_k for t_k + delay <= t < t_k+1 + delay      t_k = k T
//! delay = m T + r, 0 <= r < T:
//! x_k+1 = Phi x_k + Gamma_0 u_k-m + Gamma_1 u_k-m-1
//! Phi = e^(A T)      Gamma_0 = int_0^(T-r) e^(A s) ds B      Gamma_1 = e^(A (T-r)) int_0^r e^(A s) ds B
//! ```
//!
//! Astrom, Wittenmark, *Computer-Controlled Systems*, 3rd edition, 2.3 and 3.2. Samples see the plant before the command that
//! acts at their time.

use nalgebra::{Complex, DMatrix};

use crate::linear::held::HeldPlant;
use crate::linear::resolvent::Resolvent;
use crate::model::error::{self, ControlError};

/// A linear plant in continuous time, `x' = A x + B u`, `y = C x`.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// `A`, 1/s.
    pub a: DMatrix<f64>,
    /// `B`, from inputs.
    pub b: DMatrix<f64>,
    /// `C`, to what is measured.
    pub c: DMatrix<f64>,
}

/// How often a controller samples, and when its command acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// `T`, time between samples, s.
    pub period: f64,
    /// From a sample to the time at which its command acts, s.
    pub delay: f64,
}

impl Sampling {
    /// A period that is positive, a delay of at most 32 periods.
    pub(super) fn checked(&self) -> Result<(), ControlError> {
        error::positive("period", self.period)?;
        error::within("delay", self.delay, (0.0, MAX_PERIODS * self.period))
    }

    /// How many whole periods the delay has, which is not negative, and the rest of it, s: less than a period.
    #[must_use]
    pub fn split(&self) -> (usize, f64) {
        let Self { period, delay } = *self;
        let mut periods = libm::floor(delay / period);
        let mut rest = delay - periods * period;
        // By rounding of the product.
        if rest < 0.0 {
            rest = 0.0;
        } else if rest >= period {
            periods += 1.0;
            rest = 0.0;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number that is not negative; the largest for one that is larger"
        )]
        let periods = periods as usize;
        (periods, rest)
    }
}

impl Plant {
    /// Checked, for steps of any length.
    pub(super) fn held(&self) -> Result<HeldPlant, ControlError> {
        let Self { a, b, c } = self;
        let n = a.nrows();
        for (what, found, wanted) in [
            ("columns of A", a.ncols(), n),
            ("rows of B", b.nrows(), n),
            ("columns of C", c.ncols(), n),
        ] {
            error::count(what, found, wanted)?;
        }
        for (what, matrix) in [("A", a), ("B", b), ("C", c)] {
            matrix.iter().try_for_each(|element| error::finite(what, *element))?;
        }
        Ok(HeldPlant::new(a, b))
    }
}

/// The plant as a sampled controller sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledPlant {
    sampling: Sampling,
    phi: DMatrix<f64>,
    /// Of the newer of the two commands that act between samples.
    gamma_0: DMatrix<f64>,
    /// Of the older.
    gamma_1: DMatrix<f64>,
    c: DMatrix<f64>,
    /// `m`, whole periods of delay.
    periods: usize,
}

/// The longest delay, in periods: commands that wait are states.
const MAX_PERIODS: f64 = 32.0;

impl SampledPlant {
    /// Discretises a plant.
    ///
    /// # Errors
    ///
    /// A period that is not positive; a delay that is negative or longer than 32 periods; matrices whose shapes do not agree,
    /// or with numbers that are not finite, before or after discretisation.
    pub fn new(plant: &Plant, sampling: Sampling) -> Result<Self, ControlError> {
        let held = plant.held()?;
        sampling.checked()?;
        let sampled = Self::from_held(&held, &plant.c, (sampling.period, sampling.split()))?;
        Ok(Self { sampling, ..sampled })
    }

    /// By the whole periods of its delay and the rest of it, s.
    pub(super) fn from_held(
        held: &HeldPlant,
        c: &DMatrix<f64>,
        (period, (periods, rest)): (f64, (usize, f64)),
    ) -> Result<Self, ControlError> {
        let [before, old] = held.step(rest);
        let [after, gamma_0] = held.step(period - rest);
        let (phi, gamma_1) = (&after * before, after * old);
        let numbers = phi.iter().chain(&gamma_0).chain(&gamma_1);
        numbers.copied().try_for_each(|element| error::finite("sampled plant", element))?;
        #[expect(clippy::cast_precision_loss, reason = "at most 33")]
        let delay = periods as f64 * period + rest;
        let sampling = Sampling { period, delay };
        Ok(Self { sampling, phi, gamma_0, gamma_1, c: c.clone(), periods })
    }

    /// A plant in discrete time, `x_k+1 = Phi x_k + Gamma u_k`, `y_k = C x_k`, whose matrices are known: one with a delay
    /// within, or with a servo at a rate of its own, has its commands that wait among its states.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn from_matrices(
        sampling: Sampling,
        [phi, gamma, c]: [DMatrix<f64>; 3],
    ) -> Result<Self, ControlError> {
        let n = phi.nrows();
        for (what, found) in [
            ("columns of Phi", phi.ncols()),
            ("rows of Gamma", gamma.nrows()),
            ("columns of C", c.ncols()),
        ] {
            error::count(what, found, n)?;
        }
        error::positive("period", sampling.period)?;
        error::not_negative("delay", sampling.delay)?;
        let numbers = phi.iter().chain(&gamma).chain(&c);
        numbers.copied().try_for_each(|element| error::finite("sampled plant", element))?;
        let gamma_1 = DMatrix::zeros(n, gamma.ncols());
        Ok(Self { sampling, phi, gamma_0: gamma, gamma_1, c, periods: 0 })
    }

    /// Period and delay.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// How many inputs.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.gamma_0.ncols()
    }

    /// How many measured outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.c.nrows()
    }

    /// `G(z) = C (z 1 - Phi)^-1 (Gamma_0 z^-m + Gamma_1 z^(-m-1))`; none at a pole.
    #[must_use]
    pub fn transfer(&self, z: Complex<f64>) -> Option<DMatrix<Complex<f64>>> {
        let complex = |m: &DMatrix<f64>| m.map(|element| Complex::new(element, 0.0));
        let mut resolvent = -complex(&self.phi);
        for k in 0..resolvent.nrows() {
            resolvent[(k, k)] += z;
        }
        let [newer, older] = self.scales(z);
        let right = complex(&self.gamma_0) * newer + complex(&self.gamma_1) * older;
        Some(complex(&self.c) * resolvent.lu().solve(&right)?)
    }

    /// `z^-m` and `z^(-m-1)`.
    pub(super) fn scales(&self, z: Complex<f64>) -> [Complex<f64>; 2] {
        let late = z.inv();
        let newer = (0..self.periods).fold(Complex::new(1.0, 0.0), |all, _| all * late);
        [newer, newer * late]
    }

    /// For [`Self::transfer`] at many z.
    pub(super) fn reduced(&self) -> Resolvent {
        Resolvent::new(&self.phi, &[&self.gamma_0, &self.gamma_1], &self.c)
    }

    /// One equation for the plant and the commands that wait: `x = [plant; u_k-1; ..; u_k-m-1]`, `x_k+1 = F x_k + G u_k`,
    /// `y_k = H x_k`.
    #[must_use]
    pub fn with_waiting(&self) -> [DMatrix<f64>; 3] {
        let (n, inputs) = (self.phi.nrows(), self.inputs());
        let waiting = self.periods.saturating_add(1);
        let size = n.saturating_add(waiting.saturating_mul(inputs));
        let block = |number: usize| n.saturating_add(number.saturating_mul(inputs));
        let mut f = DMatrix::zeros(size, size);
        let mut g = DMatrix::zeros(size, inputs);
        let mut h = DMatrix::zeros(self.outputs(), size);
        f.view_mut((0, 0), (n, n)).copy_from(&self.phi);
        f.view_mut((0, block(self.periods)), (n, inputs)).copy_from(&self.gamma_1);
        match self.periods.checked_sub(1) {
            None => g.view_mut((0, 0), (n, inputs)).copy_from(&self.gamma_0),
            Some(last) => {
                f.view_mut((0, block(last)), (n, inputs)).copy_from(&self.gamma_0);
            }
        }
        g.view_mut((n, 0), (inputs, inputs)).fill_with_identity();
        for number in 1..waiting {
            let (to, from) = (block(number), block(number.saturating_sub(1)));
            f.view_mut((to, from), (inputs, inputs)).fill_with_identity();
        }
        h.view_mut((0, 0), (self.outputs(), n)).copy_from(&self.c);
        [f, g, h]
    }

    /// `Phi`.
    pub(crate) fn phi(&self) -> &DMatrix<f64> {
        &self.phi
    }
}
