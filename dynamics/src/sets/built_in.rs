//! [`BuiltIn`]: a device of any of this crate's kinds, without a heap, for parameters that come on
//! board at run time.
//!
//! `[Option<BuiltIn>; 8]` is a set of up to eight of them, `Vec<BuiltIn>` one of as many as a file
//! lists. Which kind a device is costs one branch a call; the equations are those of the kind, with
//! the same bits. Kinds of other crates are enumerated by [`device_enum`].

use crate::device_enum;
use crate::every_kind;
#[allow(clippy::wildcard_imports, reason = "every kind, also one to come")]
use crate::generated::devices::*;
use crate::model::kind::{JointInfo, Kind};
use crate::numbers::real::Scalar;
use crate::sets::device_parameters::{
    DeviceParameters, UnsupportedParameter, device_of, parameters_of,
};

/// The enumeration of all kinds, and what depends on which it is.
macro_rules! built_in {
    ($($kind:ident $module:ident $number:literal;)*) => {
        device_enum! {
            /// A device of one of this crate's kinds.
            #[derive(Copy)]
            pub enum BuiltIn { $($kind),* }
            prepared PreparedBuiltIn;
            gains BuiltInGains;
        }

        /// Which of this crate's kinds, by numbers that never change: those of the C interface.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        pub enum BuiltInKind {
            $(
                #[doc = concat!("[`", stringify!($kind), "`], number ", $number, ".")]
                $kind = $number,
            )*
        }

        impl BuiltInKind {
            /// Every kind, in the order of the numbers.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// Its number: the discriminant, and `PRECESS_KIND_` of C.
            #[must_use]
            pub const fn number(self) -> u8 {
                self as u8
            }

            /// The kind with a number, where there is one.
            #[must_use]
            pub const fn of_number(number: u8) -> Option<Self> {
                match number {
                    $($number => Some(Self::$kind),)*
                    _ => None,
                }
            }

            /// The joints of the kind, from the hub to the tip.
            #[must_use]
            pub fn joints(self) -> &'static [JointInfo] {
                match self {
                    $(Self::$kind => <$kind as Kind>::JOINTS,)*
                }
            }
        }

        impl<T: Scalar> BuiltIn<T> {
            /// A device of a kind with these parameters.
            ///
            /// # Errors
            ///
            /// [`UnsupportedParameter`] names what the kind has no parameter for.
            pub fn new(
                kind: BuiltInKind,
                parameters: &DeviceParameters<T>,
            ) -> Result<Self, UnsupportedParameter> {
                match kind {
                    $(BuiltInKind::$kind => device_of(parameters).map(Self::$kind),)*
                }
            }

            /// Its kind.
            #[must_use]
            pub fn kind(&self) -> BuiltInKind {
                match self {
                    $(Self::$kind(_) => BuiltInKind::$kind,)*
                }
            }

            /// Its parameters by body and joint; zero outboard of the last body.
            #[must_use]
            pub fn parameters(&self) -> DeviceParameters<T> {
                match self {
                    $(Self::$kind(device) => parameters_of(device),)*
                }
            }
        }
    };
}

every_kind!(built_in);
