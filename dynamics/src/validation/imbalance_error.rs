//! Why an imbalance is rejected: [`ImbalanceError`], and the names it uses for what is at fault.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::numbers::real::Scalar;

/// A quantity of an [`Imbalance`](crate::Imbalance), a [`WheelImbalance`](crate::WheelImbalance) or
/// the wheel that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImbalanceQuantity {
    /// `U_s`, kg m.
    Static,
    /// `U_d`, kg m².
    Dynamic,
    /// The phase, rad.
    Phase,
    /// `m_W`, kg.
    Mass,
    /// `d`, m.
    Offset,
    /// `J_12`, kg m².
    J12,
    /// `J_13`, kg m².
    J13,
}

/// Why an imbalance has no wheel parameters, or wheel parameters no lumped imbalance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ImbalanceError<T = f64> {
    /// An input is infinite or NaN.
    NotFinite {
        /// Which one.
        quantity: ImbalanceQuantity,
        /// Its value.
        value: T,
    },
    /// A static or dynamic imbalance is below zero: both are magnitudes.
    Negative {
        /// Which one.
        quantity: ImbalanceQuantity,
        /// Its value, kg m or kg m².
        value: T,
    },
    /// The wheel's mass is not above zero.
    Mass {
        /// The mass, kg.
        value: T,
    },
    /// Every input is finite, but a result is not.
    Overflow {
        /// Which one.
        quantity: ImbalanceQuantity,
        /// Its value.
        value: T,
    },
}

impl ImbalanceQuantity {
    fn unit(self) -> &'static str {
        match self {
            Self::Static => "kg m",
            Self::Dynamic | Self::J12 | Self::J13 => "kg m^2",
            Self::Phase => "rad",
            Self::Mass => "kg",
            Self::Offset => "m",
        }
    }
}

impl Display for ImbalanceQuantity {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Static => "static imbalance u_s",
            Self::Dynamic => "dynamic imbalance u_d",
            Self::Phase => "phase",
            Self::Mass => "mass m_w",
            Self::Offset => "offset d",
            Self::J12 => "product j_12",
            Self::J13 => "product j_13",
        })
    }
}

impl<T: Scalar> Display for ImbalanceError<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite { quantity, value } => write!(
                f,
                "{quantity} of {:?} {} is not finite; give a finite number in SI units",
                value.to_f64(),
                quantity.unit(),
            ),
            Self::Negative { quantity, value } => write!(
                f,
                "{quantity} of {:?} {} is below 0; give its magnitude and add pi to the phase",
                value.to_f64(),
                quantity.unit(),
            ),
            Self::Mass { value } => write!(
                f,
                "mass m_w of {:?} kg is not above 0; give the mass of the wheel",
                value.to_f64(),
            ),
            Self::Overflow { quantity, value } => write!(
                f,
                "{quantity} of {:?} {} is not finite although it follows from finite numbers; \
                 check their units",
                value.to_f64(),
                quantity.unit(),
            ),
        }
    }
}

impl<T: Scalar> Error for ImbalanceError<T> {}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;
    use crate::validation::imbalance::{Imbalance, WheelImbalance};

    /// What a data sheet would have to say to be rejected.
    fn rejected(u_s: f64, u_d: f64, phase: f64, m_w: f64) -> std::string::String {
        Imbalance { u_s, u_d, phase }.in_wheel(m_w).unwrap_err().to_string()
    }

    #[test]
    fn number_that_is_not_finite_is_named_with_its_value() {
        for (text, beginning) in [
            (rejected(f64::NAN, 1.0, 0.0, 1.0), "static imbalance u_s of NaN kg m"),
            (rejected(1.0, f64::INFINITY, 0.0, 1.0), "dynamic imbalance u_d of inf kg m^2"),
            (rejected(1.0, 1.0, f64::NEG_INFINITY, 1.0), "phase of -inf rad"),
            (rejected(1.0, 1.0, 0.0, f64::INFINITY), "mass m_w of inf kg"),
        ] {
            let end = " is not finite; give a finite number in SI units";
            assert_eq!(text, [beginning, end].concat());
        }
    }

    #[test]
    fn negative_magnitude_is_told_what_to_do_instead() {
        assert_eq!(
            rejected(-3.2e-4, 1.0, 0.0, 4.0),
            "static imbalance u_s of -0.00032 kg m is below 0; give its magnitude and add pi to \
             the phase"
        );
        assert!(rejected(0.0, -1e-300, 0.0, 4.0).starts_with("dynamic imbalance u_d of -1e-300"));
    }

    #[test]
    fn wheel_must_have_mass() {
        for (m_w, value) in [(0.0, "0.0"), (-4.0, "-4.0")] {
            let expected =
                ["mass m_w of ", value, " kg is not above 0; give the mass of the wheel"];
            assert_eq!(rejected(1.0, 1.0, 0.0, m_w), expected.concat());
        }
    }

    #[test]
    fn result_beyond_the_largest_number_is_no_fault_of_one_input() {
        assert_eq!(
            rejected(1e300, 0.0, 0.0, 1e-300),
            "offset d of inf m is not finite although it follows from finite numbers; check their \
             units"
        );
        let quantity = |d, j_12, j_13| match (WheelImbalance { d, j_12, j_13 }).lumped(1e10) {
            Err(ImbalanceError::Overflow { quantity, value: f64::INFINITY }) => Some(quantity),
            _ => None,
        };
        assert_eq!(quantity(-1e300, 0.0, 0.0), Some(ImbalanceQuantity::Static));
        assert_eq!(quantity(0.0, f64::MAX, -f64::MAX), Some(ImbalanceQuantity::Dynamic));
        assert_eq!(quantity(1e290, f64::MAX, 0.0), None);
    }

    #[test]
    fn wheel_parameter_that_is_not_finite_is_named() {
        let quantity =
            |d, j_12, j_13, m_w: f64| match (WheelImbalance { d, j_12, j_13 }).lumped(m_w) {
                Err(ImbalanceError::NotFinite { quantity, value }) if value.is_nan() => quantity,
                other => panic!("{other:?}"),
            };
        assert_eq!(quantity(f64::NAN, 0.0, 0.0, 1.0), ImbalanceQuantity::Offset);
        assert_eq!(quantity(0.0, f64::NAN, 0.0, 1.0), ImbalanceQuantity::J12);
        assert_eq!(quantity(0.0, 0.0, f64::NAN, 1.0), ImbalanceQuantity::J13);
        assert_eq!(quantity(0.0, 0.0, 0.0, f64::NAN), ImbalanceQuantity::Mass);
        let massless = WheelImbalance { d: 0.0, j_12: 0.0, j_13: 0.0 }.lumped(0.0);
        assert_eq!(massless, Err(ImbalanceError::Mass { value: 0.0 }));
    }
}
