//! Imbalance as data sheets state it, [`Imbalance`], and as the model holds it, [`WheelImbalance`]:
//! (122) to (125) of the paper, with the phase that (124) and (125) fix at zero.
//!
//! The wheel turns at the rate `Omega` about `w_x`, with its centre of mass at `d w_y` from W on
//! the axis. `J_12` and `J_13` are elements of its inertia tensor about that centre of mass. On a
//! mount at rest, the bearings exert, by Newton and Euler and at constant rate,
//!
//! ```text
//! force    m_W (Omega w_x) x ((Omega w_x) x d w_y)                = -Omega² m_W d w_y
//! torque   (Omega w_x) x Omega (J_11 w_x + J_12 w_y + J_13 w_z)   =  Omega² (J_12 w_z - J_13 w_y)
//! ```
//!
//! and the load on the mount is the opposite, which a test bench measures:
//!
//! ```text
//! F = Omega² U_s w_y                                   U_s = m_W d
//! L = Omega² U_d (cos(phase) w_y + sin(phase) w_z)     J_13 = U_d cos(phase)
//!                                                      J_12 = -U_d sin(phase)
//! ```
//!
//! The phase is thus the angle by which the torque leads the force, both on the mount,
//! counted about `+w_x` for either sense of the spin. `F` acts along a line through W, so `L` is
//! the same about W and about the centre of mass; so are `J_12` and `J_13`, for an offset along
//! `w_y` adds to `J_11` and `J_33` only. Where the couple is thought of as two equal masses on
//! opposite sides, a quarter turn leads from the one at the `+w_x` end to the torque.
//!
//! Not touched: `J_23`, which does nothing at constant rate on a mount at rest, and the moments.

use crate::numbers::real::{Scalar, one, reciprocal_in_two, zero};
use crate::numbers::symmetric::Symmetric;
use crate::validation::imbalance_error::{ImbalanceError, ImbalanceQuantity};
use crate::{Dgcmg, Dgvscmg, ReactionWheel, Sgcmg, Vscmg};

/// A wheel's static and dynamic imbalance as a data sheet states them, in SI units.
///
/// ```
/// use precess_dynamics::Imbalance;
/// use precess_dynamics::units::{from_g_cm, from_g_cm2};
///
/// // The catalogue wheel of the paper's Table 1: 32 g cm and 15.4 g cm², 4 kg.
/// let sheet: Imbalance = Imbalance { u_s: from_g_cm(32.0), u_d: from_g_cm2(15.4), phase: 0.0 };
/// let wheel = sheet.in_wheel(4.0)?;
/// assert!((wheel.d - 0.08e-3).abs() < 1e-18); // 0.08 mm
/// assert!(wheel.j_12 == 0.0 && (wheel.j_13 - 1.54e-6).abs() < 1e-20);
/// # Ok::<(), precess_dynamics::ImbalanceError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imbalance<T = f64> {
    /// `U_s`, static imbalance, kg m; not negative. The force on a mount at rest is `U_s Omega²`.
    pub u_s: T,
    /// `U_d`, dynamic imbalance, kg m²; not negative. The torque on a mount at rest is
    /// `U_d Omega²`.
    pub u_d: T,
    /// Angle from that force to that torque about `+w_x`, rad; any finite number.
    pub phase: T,
}

/// A wheel's imbalance as parameters of a device: `d`, `J_12` and `J_13`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelImbalance<T = f64> {
    /// `d`: the wheel's centre of mass is at `d w_y` from W, m.
    pub d: T,
    /// `J_12`, element of the inertia about the wheel's centre of mass, W axes, kg m².
    pub j_12: T,
    /// `J_13`, likewise, kg m².
    pub j_13: T,
}

impl<T: Scalar> Imbalance<T> {
    /// The parameters of a wheel of the mass `m_w`, kg, that has this imbalance:
    /// `d = U_s / m_W`, (122); `J_12 = -U_d sin(phase)`, `J_13 = U_d cos(phase)`, (123).
    ///
    /// # Errors
    ///
    /// [`ImbalanceError`] names a quantity that is not finite, an imbalance below zero, a mass that
    /// is not above zero, or an offset `d` beyond the largest number.
    pub fn in_wheel(&self, m_w: T) -> Result<WheelImbalance<T>, ImbalanceError<T>> {
        let Self { u_s, u_d, phase } = *self;
        check_imbalance(ImbalanceQuantity::Static, u_s)?;
        check_imbalance(ImbalanceQuantity::Dynamic, u_d)?;
        check_finite(ImbalanceQuantity::Phase, phase)?;
        check_mass(m_w)?;

        let (first, second) = reciprocal_in_two(m_w);
        let d = check_result(ImbalanceQuantity::Offset, u_s * first * second)?;
        let (sine, cosine) = phase.sin_cos();
        // Subtracted from zero, the sine of a zero phase leaves no negative zero in the tensor.
        Ok(WheelImbalance { d, j_12: zero::<T>() - u_d * sine, j_13: u_d * cosine })
    }
}

impl<T: Scalar> WheelImbalance<T> {
    /// The lumped imbalance of a wheel of the mass `m_w`, kg, with the phase within half a turn.
    ///
    /// With a negative `d` the force is along `-w_y`, and the phase counts from there. Without
    /// static imbalance (`d = 0`) the phase counts from `w_y`, so that [`Imbalance::in_wheel`]
    /// gives the same products again. Without dynamic imbalance it is zero.
    ///
    /// # Errors
    ///
    /// [`ImbalanceError`] names a quantity that is not finite, a mass that is not above zero, or an
    /// imbalance beyond the largest number.
    pub fn lumped(&self, m_w: T) -> Result<Imbalance<T>, ImbalanceError<T>> {
        let (u_s, u_d, [cosine, sine]) = self.polar(m_w)?;
        let phase = if u_d == zero() { zero() } else { angle(cosine, sine) };
        Ok(Imbalance { u_s, u_d, phase })
    }

    /// `U_s`, `U_d`, and cosine and sine of the phase as [`Self::lumped`] counts it.
    ///
    /// # Errors
    ///
    /// As [`Self::lumped`].
    pub(crate) fn polar(&self, m_w: T) -> Result<(T, T, [T; 2]), ImbalanceError<T>> {
        let Self { d, j_12, j_13 } = *self;
        check_finite(ImbalanceQuantity::Offset, d)?;
        check_finite(ImbalanceQuantity::J12, j_12)?;
        check_finite(ImbalanceQuantity::J13, j_13)?;
        check_mass(m_w)?;

        let u_s = check_result(ImbalanceQuantity::Static, m_w * d.abs())?;
        let largest = j_12.abs().max(j_13.abs());
        if largest == zero() {
            return Ok((u_s, zero(), [one(), zero()]));
        }
        // The torque along the force and a quarter turn ahead of it, the larger of size one.
        let (first, second) = reciprocal_in_two(largest);
        let sense = if d < zero() { -one::<T>() } else { one() };
        let along = sense * j_13 * first * second;
        let ahead = zero::<T>() - sense * j_12 * first * second;
        let size = (along * along + ahead * ahead).sqrt();
        let u_d = check_result(ImbalanceQuantity::Dynamic, largest * size)?;
        Ok((u_s, u_d, [along, ahead].map(|of| of * size.recip())))
    }
}

/// The kinds whose wheel can be off balance.
macro_rules! off_balance {
    ($($kind:ident)*) => {$(
        impl<T: Scalar> $kind<T> {
            /// The same device with this imbalance in its wheel: `d`, `J_12` and `J_13` are
            /// replaced, everything else stays, `J_23` and the wheel's moments among it.
            ///
            /// # Errors
            ///
            /// As [`Imbalance::in_wheel`] for the device's `m_w`.
            pub fn with_imbalance(
                &self,
                imbalance: &Imbalance<T>,
            ) -> Result<Self, ImbalanceError<T>> {
                let WheelImbalance { d, j_12, j_13 } = imbalance.in_wheel(self.m_w)?;
                let mut i_w_wc = self.i_w_wc;
                (i_w_wc.m12, i_w_wc.m21) = (j_12, j_12);
                (i_w_wc.m13, i_w_wc.m31) = (j_13, j_13);
                Ok(Self { d, i_w_wc, ..*self })
            }

            /// The lumped imbalance of the device's wheel, from `m_w`, `d` and the symmetric part
            /// of `i_w_wc`, with the phase as [`WheelImbalance::lumped`] counts it.
            ///
            /// # Errors
            ///
            /// As [`WheelImbalance::lumped`].
            pub fn imbalance(&self) -> Result<Imbalance<T>, ImbalanceError<T>> {
                let j = Symmetric::part_of(&self.i_w_wc);
                WheelImbalance { d: self.d, j_12: j.xy, j_13: j.xz }.lumped(self.m_w)
            }
        }
    )*};
}

off_balance!(ReactionWheel Sgcmg Vscmg Dgcmg Dgvscmg);

fn check_imbalance<T: Scalar>(
    quantity: ImbalanceQuantity,
    value: T,
) -> Result<(), ImbalanceError<T>> {
    check_finite(quantity, value)?;
    if value < zero() { Err(ImbalanceError::Negative { quantity, value }) } else { Ok(()) }
}

fn check_mass<T: Scalar>(value: T) -> Result<(), ImbalanceError<T>> {
    check_finite(ImbalanceQuantity::Mass, value)?;
    if value > zero() { Ok(()) } else { Err(ImbalanceError::Mass { value }) }
}

fn check_finite<T: Scalar>(quantity: ImbalanceQuantity, value: T) -> Result<(), ImbalanceError<T>> {
    if value.is_finite() { Ok(()) } else { Err(ImbalanceError::NotFinite { quantity, value }) }
}

/// The result, unless it is beyond the largest number.
fn check_result<T: Scalar>(quantity: ImbalanceQuantity, value: T) -> Result<T, ImbalanceError<T>> {
    if value.is_finite() { Ok(value) } else { Err(ImbalanceError::Overflow { quantity, value }) }
}

/// The angle of a direction, its components of size one, from `along` towards `ahead`, rad.
///
/// The `f64` angle is a first guess. The direction is turned back by it, and what then is left is
/// so small that it equals its tangent in any precision.
fn angle<T: Scalar>(along: T, ahead: T) -> T {
    let guess = T::from_f64(libm::atan2(ahead.to_f64(), along.to_f64()));
    let (sine, cosine) = guess.sin_cos();
    let left = (ahead * cosine - along * sine) * (along * cosine + ahead * sine).recip();
    guess + left
}
