//! The force of a mounted device from that of a blocked one.
//!
//! A device on a rigid table exerts `F_b`. On a mount that accelerates it exerts `F = F_b - M_w a`, and the
//! mount follows by `a = A_s F`; hence
//!
//! ```text
//! F = (1 + M_w A_s)^-1 F_b
//! ```
//!
//! with the accelerance `A_s` of the structure without the device and the dynamic mass `M_w` of the device,
//! both at the mount and at one frequency. Several devices: `A_s` of all mounts, `M_w` with a block for each.
//! No inverse of `M_w` is taken: that of a freely spinning wheel has none.

use nalgebra::{Complex, DVector};

use super::Fault;
use super::accelerance::ComplexMatrix;

/// `(1 + M_w A_s)^-1`: mounted force by blocked force.
///
/// # Errors
/// [`Fault::Shape`] where sizes differ; [`Fault::Unbounded`] at a resonance without damping.
pub fn transmission(
    dynamic_mass: &ComplexMatrix,
    accelerance: &ComplexMatrix,
    frequency: f64,
) -> Result<ComplexMatrix, Fault> {
    inverse(dynamic_mass, accelerance, 1.0, frequency)
}

/// The mounted force of a blocked one, N and N m.
///
/// # Errors
/// As [`transmission`].
pub fn mounted_force(
    dynamic_mass: &ComplexMatrix,
    accelerance: &ComplexMatrix,
    blocked: &DVector<Complex<f64>>,
    frequency: f64,
) -> Result<DVector<Complex<f64>>, Fault> {
    let transmission = transmission(dynamic_mass, accelerance, frequency)?;
    if transmission.ncols() == blocked.len() {
        return Ok(transmission * blocked);
    }
    let (what, found) = (String::from("the blocked force"), vec![blocked.len()]);
    Err(Fault::Shape { what, found, wanted: vec![transmission.ncols()] })
}

/// The accelerance of a structure from that of one whose model has some mass at the same mounts, which is
/// taken off: `A (1 - M A)^-1`.
///
/// # Errors
/// As [`transmission`]; among them where the mass is more than the model has.
pub fn without_mass(
    accelerance: &ComplexMatrix,
    mass: &ComplexMatrix,
    frequency: f64,
) -> Result<ComplexMatrix, Fault> {
    Ok(accelerance * inverse(mass, accelerance, -1.0, frequency)?)
}

/// `(1 + sign M A)^-1`.
fn inverse(
    mass: &ComplexMatrix,
    accelerance: &ComplexMatrix,
    sign: f64,
    frequency: f64,
) -> Result<ComplexMatrix, Fault> {
    let size = mass.nrows();
    for (what, matrix) in [("the dynamic mass", mass), ("the accelerance", accelerance)] {
        if matrix.shape() != (size, size) {
            let found = vec![matrix.nrows(), matrix.ncols()];
            return Err(Fault::Shape { what: what.into(), found, wanted: vec![size, size] });
        }
    }
    let loop_gain = mass * accelerance * Complex::new(sign, 0.0);
    let sum = ComplexMatrix::identity(size, size) + loop_gain;
    let inverse = sum.try_inverse().ok_or(Fault::Unbounded { frequency })?;
    if inverse.iter().all(|value| value.re.is_finite() && value.im.is_finite()) {
        Ok(inverse)
    } else {
        Err(Fault::Unbounded { frequency })
    }
}
