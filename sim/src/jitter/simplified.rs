//! The usual, simplified model beside the coupled one: blocked forces `U_s Omega^2` and `U_d Omega^2` on a spacecraft whose
//! devices are rigid bodies at rest. It has their mass and inertia, but neither their momentum nor their free joints.

use nalgebra::{Complex, DMatrix};

use super::device::SweptDevice;
use super::model::{Line, Model};
use crate::scenario::Scenario;
use crate::structure::{COORDINATES, Fault};

impl SweptDevice {
    /// The device as a rigid body with the same blocked forces: `mass` is 6 × 6 about its mount.
    pub(super) fn simplified(&self, mass: &DMatrix<f64>) -> Self {
        let none = DMatrix::zeros(COORDINATES, COORDINATES);
        let still = [mass.clone(), none.clone(), none.clone()];
        let nothing = || [none.clone(), none.clone(), none.clone()];
        let mut simple = self.clone();
        simple.free.clear();
        simple.set_powers([still, nothing(), nothing()]);
        simple
    }
}

impl Model {
    /// The same spacecraft in the simplified model.
    ///
    /// # Errors
    /// Parameters that the solver rejects.
    pub fn simplified(&self, scenario: &Scenario) -> Result<Self, Fault> {
        let masses = self.rigid_masses(scenario)?;
        let mut simple = self.clone();
        for ((_, device), mass) in simple.devices.iter_mut().zip(&masses) {
            *device = device.simplified(mass);
        }
        Ok(simple)
    }
}

/// The error of simplified lines: the root of the sum of squares of the differences of complex amplitudes of some outputs,
/// over that of the coupled ones. Zero where nothing moves.
#[must_use]
pub fn error(coupled: &[Line], simplified: &[Line], outputs: &[usize]) -> f64 {
    let value = |line: &Line, output: usize| line.values.get(output).copied().unwrap_or_default();
    let (mut apart, mut whole) = (0.0, 0.0);
    for (a, b) in coupled.iter().zip(simplified) {
        for output in outputs {
            let (exact, usual): (Complex<f64>, Complex<f64>) =
                (value(a, *output), value(b, *output));
            apart += (exact - usual).norm_sqr();
            whole += exact.norm_sqr();
        }
    }
    if whole > 0.0 { (apart / whole).sqrt() } else { 0.0 }
}
