//! [`condensed`]: devices on a mount at a frequency, with their free joints eliminated.

use nalgebra::{Complex, DMatrix};

use super::accelerance::ComplexMatrix;
use super::{COORDINATES, Fault, within};

/// Derivatives by accelerations, rates and coordinates, of mount and free joints.
pub type Derivatives = [DMatrix<f64>; 3];

/// Devices at a frequency, with their free joints eliminated.
#[derive(Clone, Debug)]
pub struct Condensed {
    /// Dynamic mass `M_w = Z_hh - Z_hq Z_qq^-1 Z_qh`.
    pub mass: ComplexMatrix,
    /// `Z_hq Z_qq^-1`: the load on the mount by what the free joints need.
    pub gain: ComplexMatrix,
    /// `-Z_qq^-1 [Z_qh, 1]`: accelerations of the free joints by those of the mount, and by what they need.
    pub joints: ComplexMatrix,
}

/// Eliminates the free joints of derivatives by accelerations, rates and coordinates.
///
/// # Errors
/// As [`AveragedDevices::dynamic_mass`](super::averaged::AveragedDevices::dynamic_mass).
pub fn condensed(parts: &Derivatives, frequency: f64) -> Result<Condensed, Fault> {
    let parts = parts.each_ref().map(|m| m.map(|value| Complex::new(value, 0.0)));
    condensed_complex(&parts, frequency)
}

/// [`condensed`] of derivatives as complex matrices.
pub(crate) fn condensed_complex(
    parts: &[ComplexMatrix; 3],
    frequency: f64,
) -> Result<Condensed, Fault> {
    let unbounded = || Fault::Unbounded { frequency };
    let whole = at(parts, frequency)?;
    let joints = whole.nrows().saturating_sub(COORDINATES);
    let [h, q] = [(0, COORDINATES), (COORDINATES, joints)];
    let block =
        |rows: (usize, usize), of: (usize, usize)| whole.view((rows.0, of.0), (rows.1, of.1));
    let mut mass = block(h, h).into_owned();
    let mut gain = ComplexMatrix::zeros(COORDINATES, joints);
    let mut back = ComplexMatrix::zeros(joints, COORDINATES + joints);
    if joints > 0 {
        let inverse = block(q, q).into_owned().try_inverse().ok_or_else(unbounded)?;
        gain = block(h, q) * &inverse;
        mass -= &gain * block(q, h);
        back.columns_mut(0, COORDINATES).copy_from(&-(&inverse * block(q, h)));
        back.columns_mut(COORDINATES, joints).copy_from(&-inverse);
    }
    if mass.iter().chain(gain.iter()).all(|value| value.re.is_finite() && value.im.is_finite()) {
        Ok(Condensed { mass, gain, joints: back })
    } else {
        Err(unbounded())
    }
}

/// `M + C / (i w) - K / w^2`.
pub(super) fn at(
    [mass, rates, stiffness]: &[ComplexMatrix; 3],
    w: f64,
) -> Result<ComplexMatrix, Fault> {
    within("angular frequency, rad/s,".into(), w, [f64::MIN_POSITIVE, 1e12])?;
    let (by_rate, by_angle) = (Complex::new(0.0, -1.0 / w), Complex::new(-1.0 / (w * w), 0.0));
    Ok(mass + rates * by_rate + stiffness * by_angle)
}
