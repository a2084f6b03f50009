//! Names at run time: a built-in kind by its name, and the parameters of a built-in device by
//! theirs, for parameters that come as text.

use crate::every_kind;
#[allow(clippy::wildcard_imports, reason = "every kind, also one to come")]
use crate::generated::devices::*;
use crate::model::kind::Kind;
use crate::model::parameter_info::{NameError, ParameterInfo, ParameterValue};
use crate::numbers::real::Scalar;
use crate::sets::built_in::{BuiltIn, BuiltInKind};

macro_rules! named {
    ($($kind:ident $module:ident $number:literal;)*) => {
        impl BuiltInKind {
            /// Its name: `reaction_wheel`.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => <$kind as Kind>::NAME,)*
                }
            }

            /// The kind of a name, where there is one.
            #[must_use]
            pub fn of_name(name: &str) -> Option<Self> {
                match name {
                    $(<$kind as Kind>::NAME => Some(Self::$kind),)*
                    _ => None,
                }
            }

            /// Its parameters, those of its joints' passive elements left out.
            #[must_use]
            pub const fn parameters(self) -> &'static [ParameterInfo] {
                match self {
                    $(Self::$kind => <$kind as Kind>::PARAMETERS,)*
                }
            }
        }

        impl<T: Scalar> BuiltIn<T> {
            /// As [`Kind::parameter`].
            ///
            /// # Errors
            ///
            /// [`NameError::Unknown`].
            pub fn parameter(&self, name: &str) -> Result<ParameterValue<T>, NameError> {
                match self {
                    $(Self::$kind(device) => device.parameter(name),)*
                }
            }

            /// As [`Kind::set_parameter`].
            ///
            /// # Errors
            ///
            /// [`NameError`].
            pub fn set_parameter(
                &mut self,
                name: &str,
                value: ParameterValue<T>,
            ) -> Result<(), NameError> {
                match self {
                    $(Self::$kind(device) => device.set_parameter(name, value),)*
                }
            }
        }
    };
}

every_kind!(named);
