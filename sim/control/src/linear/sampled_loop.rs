//! [`SampledLoop`]: a sampled plant with its feedback, at a frequency and by its poles.
//!
//! ```text
//! L(z) = -K(z) G(z)      S = (1 + L)^-1      T = S L      z = e^(j omega T)
//! ```
//!
//! The loop is open where the command enters the hold. What breaks only the i-th command and leaves the others closed sees
//! `L_i = 1 / S_ii - 1`.

use alloc::vec::Vec;

use nalgebra::{Complex, DMatrix};

use crate::linear::eigenvalues::eigenvalues;
use crate::linear::feedback::Feedback;
use crate::linear::frequencies;
use crate::linear::plant::SampledPlant;
use crate::linear::resolvent::Resolvent;
use crate::model::error::ControlError;

/// A closed loop in discrete time.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledLoop {
    plant: SampledPlant,
    feedback: Feedback,
    closed: DMatrix<f64>,
}

/// The loop at a frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopResponse {
    /// Angular frequency, rad/s.
    pub omega: f64,
    /// `L`, from commands to commands.
    pub open: DMatrix<Complex<f64>>,
    /// `S`, sensitivity: from what is added to a command to the command that acts.
    pub sensitivity: DMatrix<Complex<f64>>,
    /// `T = 1 - S`, complementary sensitivity.
    pub complementary: DMatrix<Complex<f64>>,
}

/// A pole within this of 1 counts as neutral: what the loop does not act on, as the angle of a wheel or the momentum of the
/// whole.
const NEUTRAL: f64 = 1e-6;

impl SampledLoop {
    /// Closes the loop.
    ///
    /// # Errors
    ///
    /// Where shapes do not agree or numbers are not finite.
    pub fn new(plant: SampledPlant, feedback: Feedback) -> Result<Self, ControlError> {
        feedback.checked(plant.outputs(), plant.inputs())?;
        let [f, g, h] = plant.with_waiting();
        let (n, m) = (f.nrows(), feedback.a.nrows());
        let size = n.saturating_add(m);
        let mut closed = DMatrix::zeros(size, size);
        closed.view_mut((0, 0), (n, n)).copy_from(&(f + &g * &feedback.d * &h));
        closed.view_mut((0, n), (n, m)).copy_from(&(&g * &feedback.c));
        closed.view_mut((n, 0), (m, n)).copy_from(&(&feedback.b * &h));
        closed.view_mut((n, n), (m, m)).copy_from(&feedback.a);
        Ok(Self { plant, feedback, closed })
    }

    /// The plant.
    #[must_use]
    pub fn plant(&self) -> &SampledPlant {
        &self.plant
    }

    /// The feedback.
    #[must_use]
    pub fn feedback(&self) -> &Feedback {
        &self.feedback
    }

    /// From one sample to the next: of the states of [`SampledPlant::with_waiting`], then those of the feedback.
    #[must_use]
    pub fn state_matrix(&self) -> &DMatrix<f64> {
        &self.closed
    }

    /// `pi / T`, rad/s: higher frequencies repeat the lower ones.
    #[must_use]
    pub fn nyquist(&self) -> f64 {
        core::f64::consts::PI / self.plant.sampling().period
    }

    /// At an angular frequency, rad/s; none at a pole of plant, feedback or closed loop.
    #[must_use]
    pub fn response(&self, omega: f64) -> Option<LoopResponse> {
        let z = self.z(omega);
        self.response_of(omega, z, &self.plant.transfer(z)?)
    }

    /// The same with the plant reduced once.
    pub(super) fn response_reduced(&self, plant: &Resolvent, omega: f64) -> Option<LoopResponse> {
        let z = self.z(omega);
        self.response_of(omega, z, &plant.at(z, &self.plant.scales(z))?)
    }

    /// `e^(i w T)`.
    fn z(&self, omega: f64) -> Complex<f64> {
        let angle = omega * self.plant.sampling().period;
        Complex::new(libm::cos(angle), libm::sin(angle))
    }

    fn response_of(
        &self,
        omega: f64,
        z: Complex<f64>,
        plant: &DMatrix<Complex<f64>>,
    ) -> Option<LoopResponse> {
        let open = -(self.feedback.transfer(z)? * plant);
        let unit = DMatrix::identity(open.nrows(), open.nrows());
        let sensitivity = (&unit + &open).try_inverse()?;
        let complementary = unit - &sensitivity;
        Some(LoopResponse { omega, open, sensitivity, complementary })
    }

    /// Poles of the closed loop in the plane of z, largest magnitude first.
    ///
    /// # Errors
    ///
    /// Where the eigenvalues do not converge.
    pub fn poles(&self) -> Result<Vec<Complex<f64>>, ControlError> {
        let mut poles = eigenvalues(&self.closed)?;
        poles.sort_by(|a, b| {
            let (larger, smaller) = (b.norm_sqr(), a.norm_sqr());
            larger.total_cmp(&smaller).then(b.im.total_cmp(&a.im))
        });
        Ok(poles)
    }

    /// Whether all poles are inside the unit circle, but for those within 1e-6 of 1.
    ///
    /// # Errors
    ///
    /// As [`Self::poles`].
    pub fn is_stable(&self) -> Result<bool, ControlError> {
        Ok(self.growth()? < 0.0)
    }

    /// `|z|² - 1` of the largest pole, but for those within 1e-6 of 1.
    pub(super) fn growth(&self) -> Result<f64, ControlError> {
        let one = Complex::new(1.0, 0.0);
        let counts = |z: &Complex<f64>| {
            let apart = (z - one).norm_sqr();
            apart >= NEUTRAL * NEUTRAL || apart.is_nan()
        };
        let growth = |z: Complex<f64>| {
            let growth = z.norm_sqr() - 1.0;
            if growth.is_nan() { f64::INFINITY } else { growth }
        };
        Ok(eigenvalues(&self.closed)?.into_iter().filter(counts).map(growth).fold(-1.0, f64::max))
    }

    /// Frequencies at which to look, rising to that of Nyquist, rad/s: logarithmic, and close by the poles of plant and loop.
    ///
    /// # Errors
    ///
    /// As [`Self::poles`].
    pub fn frequencies(&self) -> Result<Vec<f64>, ControlError> {
        let poles = self.poles()?.into_iter().chain(eigenvalues(self.plant.phi())?);
        Ok(frequencies::all(self.plant.sampling().period, poles))
    }
}

impl LoopResponse {
    /// `L_i`: what one command sees with the others closed.
    #[must_use]
    pub fn axis(&self, number: usize) -> Option<Complex<f64>> {
        let own = self.sensitivity.get((number, number))?;
        Some(own.inv() - 1.0)
    }

    /// The largest singular value of the sensitivity.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.sensitivity.singular_values().max()
    }
}
