//! [`BuiltIn`]: a device of any of this crate's kinds, without a heap, for parameters that come on
//! board at run time.
//!
//! `[Option<BuiltIn>; 8]` is a set of up to eight of them, `Vec<BuiltIn>` one of as many as a file
//! lists. Which kind a device is costs one branch a call; the equations are those of the kind, with
//! the same bits. Kinds of other crates are enumerated by [`device_enum`].

use crate::device_enum;
#[allow(clippy::wildcard_imports, reason = "every kind, also one to come")]
use crate::generated::devices::*;
use crate::generated::every_kind;
use crate::model::kind::{JointInfo, Kind};
use crate::numbers::real::Scalar;
use crate::sets::built_in_parameters::{BuiltInParameters, Misfit, made, stated};

/// The enumeration of all kinds, and what depends on which it is.
macro_rules! built_in {
    ($($kind:ident)*) => {
        device_enum! {
            /// A device of one of this crate's kinds.
            #[derive(Copy)]
            pub enum BuiltIn { $($kind),* }
            prepared PreparedBuiltIn;
            gains BuiltInGains;
        }

        /// Which of this crate's kinds.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum BuiltInKind {
            $(
                #[doc = concat!("[`", stringify!($kind), "`].")]
                $kind,
            )*
        }

        impl BuiltInKind {
            /// Every kind.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// The joints of the kind, from the hub to the tip.
            #[must_use]
            pub fn joints(self) -> &'static [JointInfo] {
                match self {
                    $(Self::$kind => <$kind as Kind>::JOINTS,)*
                }
            }
        }

        impl<T: Scalar> BuiltIn<T> {
            /// A device of a kind, of its bodies.
            ///
            /// # Errors
            ///
            /// [`Misfit`] names what the kind has no parameter for.
            pub fn new(kind: BuiltInKind, stated: &BuiltInParameters<T>) -> Result<Self, Misfit> {
                match kind {
                    $(BuiltInKind::$kind => made(stated).map(Self::$kind),)*
                }
            }

            /// Its kind.
            #[must_use]
            pub fn kind(&self) -> BuiltInKind {
                match self {
                    $(Self::$kind(_) => BuiltInKind::$kind,)*
                }
            }

            /// The device as bodies and joints; zero behind the last.
            #[must_use]
            pub fn stated(&self) -> BuiltInParameters<T> {
                match self {
                    $(Self::$kind(device) => stated(device),)*
                }
            }
        }
    };
}

every_kind!(built_in);
