//! [`Code`]: why a call was rejected, as a number with a name and a sentence; [`Fault`]: where.

use core::ffi::{CStr, c_char};

use precess_dynamics::{ParameterError, Part, Quantity, SolveError, SteeringError};

use crate::memory::{self, Plain};

macro_rules! codes {
    ($($(#[$doc:meta])* $variant:ident = $number:literal, $name:literal, $text:literal;)*) => {
        /// The code that every function returns.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(i32)]
        pub enum Code {
            $($(#[$doc])* $variant = $number,)*
        }

        impl Code {
            /// Every code.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name in the header.
            #[must_use]
            pub fn name(self) -> &'static CStr {
                match self { $(Self::$variant => $name,)* }
            }

            /// What is wrong, and what to do.
            #[must_use]
            pub fn text(self) -> &'static CStr {
                match self { $(Self::$variant => $text,)* }
            }
        }
    };
}

codes! {
    /// Done.
    Ok = 0, c"PRECESS_OK", c"done";
    /// A pointer is null.
    Null = 1, c"PRECESS_ERROR_NULL", c"a pointer is null; only those documented so may be";
    /// A pointer is misaligned.
    Misaligned = 2, c"PRECESS_ERROR_MISALIGNED",
        c"a pointer is not aligned for its type; the spacecraft needs PRECESS_SPACECRAFT_ALIGN";
    /// Memory is too small.
    TooSmall = 3, c"PRECESS_ERROR_TOO_SMALL",
        c"the memory is too small; see PRECESS_SPACECRAFT_SIZE, _TABLE_SIZE, state_length";
    /// Memory holds no spacecraft.
    NotInitialised = 4, c"PRECESS_ERROR_NOT_INITIALISED",
        c"the memory holds no spacecraft; call precess_init or precess_init_from_table first";
    /// More devices than there is room for.
    TooMany = 5, c"PRECESS_ERROR_TOO_MANY",
        c"more devices or sub-steps than allowed, or none; see PRECESS_MAX_DEVICES, _SUBSTEPS";
    /// No such kind.
    UnknownKind = 6, c"PRECESS_ERROR_UNKNOWN_KIND",
        c"no such kind of device; use a PRECESS_KIND_ constant";
    /// No such mode, model, axes or point.
    UnknownChoice = 7, c"PRECESS_ERROR_UNKNOWN_CHOICE",
        c"no such mode, model, axes or point; use the constants of the header";
    /// The kind has no such parameter.
    UnsupportedParameter = 8, c"PRECESS_ERROR_UNSUPPORTED_PARAMETER",
        c"a body has what its kind has no parameter for; set it to 0, or use an imbalanced kind";
    /// A parameter, state or input is no finite number.
    NotFinite = 9, c"PRECESS_ERROR_NOT_FINITE",
        c"a number is NaN or infinite, or an attitude has no length; give finite SI units";
    /// A mass is out of range.
    Mass = 10, c"PRECESS_ERROR_MASS",
        c"a mass is not above 0 (0 is allowed inboard), or the sum of all is not finite";
    /// An inertia is none.
    Inertia = 11, c"PRECESS_ERROR_INERTIA",
        c"an inertia is not symmetric, or has a negative or infinite principal moment";
    /// A mount is no rotation.
    Mount = 12, c"PRECESS_ERROR_MOUNT", c"a mount is not a right-handed rotation to rounding";
    /// A spring or friction is out of range.
    Passive = 13, c"PRECESS_ERROR_PASSIVE",
        c"a stiffness or friction is below 0, or Coulomb friction has no rate above 0";
    /// The mass matrix is singular.
    Singular = 14, c"PRECESS_ERROR_SINGULAR",
        c"a driven joint or the hub is left without inertia here; check masses and inertias";
    /// A locked joint moves.
    LockedJointMoves = 15, c"PRECESS_ERROR_LOCKED_JOINT_MOVES",
        c"a locked joint moves; call precess_stop first, or unlock it";
    /// A fixed hub moves.
    FixedHubMoves = 16, c"PRECESS_ERROR_FIXED_HUB_MOVES",
        c"a fixed hub moves; set its velocities to 0, or call precess_stop first";
    /// A joint has only one mode.
    NotDriven = 17, c"PRECESS_ERROR_NOT_DRIVEN",
        c"a joint is held at its rate by its kind and takes no other mode; use another kind";
    /// No field at the centre of gravity.
    AtCentre = 18, c"PRECESS_ERROR_AT_CENTRE",
        c"B is at the centre of gravity, where there is no field; set the position";
    /// The result is not finite.
    Overflow = 19, c"PRECESS_ERROR_OVERFLOW",
        c"the result is not finite although every input is; check units of large or tiny inputs";
    /// A table is none.
    TableMagic = 20, c"PRECESS_ERROR_TABLE_MAGIC",
        c"the table does not begin as a table of Precess";
    /// A table of another version.
    TableVersion = 21, c"PRECESS_ERROR_TABLE_VERSION",
        c"the table has a version that this library does not read; write it anew";
    /// A table that is too short, or of another length than it says.
    TableLength = 22, c"PRECESS_ERROR_TABLE_LENGTH",
        c"the table has another length than its header and number of devices say";
    /// A table that was changed.
    TableChecksum = 23, c"PRECESS_ERROR_TABLE_CHECKSUM",
        c"the checksum of the table does not match; load it again";
    /// Of a kind that this version of the library does not name.
    Other = 24, c"PRECESS_ERROR_OTHER", c"an error without a code of its own";
    /// A step is too long for a spring, damper or friction.
    Unstable = 25, c"PRECESS_ERROR_UNSTABLE",
        c"dt is too long for a spring or friction; fault.bound is the longest, or raise coulomb_rate";
    /// A kind of more joints than the structures of the caller hold.
    ManyJoints = 26, c"PRECESS_ERROR_MANY_JOINTS",
        c"the kind has more joints than PRECESS_MAX_JOINTS; define PRECESS_TABLE_VERSION as 2";
    /// An entry stands on something that is no platform or panel.
    NoPlatform = 27, c"PRECESS_ERROR_NO_PLATFORM",
        c"`on` is not 0 or 1 + index of a platform or panel: a platform is on the hub or one there, a panel on a panel, up to 4 in a row";
    /// A matrix or strut of a suspension is out of range.
    Suspension = 28, c"PRECESS_ERROR_SUSPENSION",
        c"a matrix is not symmetric or not positive semidefinite, or a strut has no length, direction";
    /// A number of a law or servo is out of range.
    Command = 29, c"PRECESS_ERROR_COMMAND",
        c"a weight, limit, lambda is below 0, reference not above 0, bounds out of order, dither 1/2 or more";
    /// The commanded joints are singular.
    NoTorque = 30, c"PRECESS_ERROR_NO_TORQUE",
        c"the commanded joints give no torque along some direction; use PRECESS_INVERSE_ROBUST, or more joints";
    /// A device that cannot be steered.
    NoSteering = 31, c"PRECESS_ERROR_NO_STEERING",
        c"a platform, or a panel that carries one, has no steering terms; steer devices on the hub";
    /// A number of a tracker is out of range.
    Range = 32, c"PRECESS_ERROR_RANGE",
        c"a memory is not from 8 to 1e9 samples, an inertia not above 0, or a time below 0";
    /// Samples do not determine what is estimated.
    Undetermined = 33, c"PRECESS_ERROR_UNDETERMINED",
        c"the samples determine no estimate: too few, a rotor that stands, no expected drag; go on";
}

/// Where a rejection comes from: `precess_fault`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Fault {
    /// The code.
    pub code: i32,
    /// Index of the device; -1 for the hub, or where no device is at fault.
    pub device: i32,
    /// Index of the joint in its device, from the hub outwards; -1 where none is at fault.
    pub joint: i32,
    /// Not used; 0.
    pub reserved: i32,
    /// The value at fault; 0 where there is none.
    pub value: f64,
    /// The bound it breaks; 0 where there is none.
    pub bound: f64,
}

// SAFETY: integers and floating-point numbers.
unsafe impl Plain for Fault {}

/// A rejection with the name of its joint; [`Fault`] has the number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejection {
    pub(crate) code: Code,
    /// Number of the device in the set.
    pub(crate) device: Option<usize>,
    /// Index of the entry, where it is known.
    pub(crate) entry: Option<usize>,
    pub(crate) joint: Option<&'static str>,
    /// Index of the joint in its entry, where it is known.
    pub(crate) joint_index: Option<usize>,
    pub(crate) value: f64,
    pub(crate) bound: f64,
}

impl From<Code> for Rejection {
    fn from(code: Code) -> Self {
        let (value, bound) = (0.0, 0.0);
        Self { code, device: None, entry: None, joint: None, joint_index: None, value, bound }
    }
}

impl Rejection {
    fn valued(code: Code, value: f64, bound: f64) -> Self {
        Self { value, bound, ..code.into() }
    }

    fn at(self, device: impl Into<Option<usize>>, joint: impl Into<Option<&'static str>>) -> Self {
        Self { device: device.into(), joint: joint.into(), ..self }
    }

    fn about(self, what: Quantity) -> Self {
        match what {
            Quantity::Motor { device, joint }
            | Quantity::JointAcceleration { device, joint }
            | Quantity::Load { device, joint }
            | Quantity::Wrench { device, body: joint } => self.at(device, joint),
            Quantity::Joint { device, field } => self.at(device, field),
            _ => self,
        }
    }

    fn at_part(self, part: Part) -> Self {
        match part {
            Part::Hub => self,
            Part::Body { device, body } => self.at(device, body),
        }
    }
}

impl From<ParameterError> for Rejection {
    fn from(error: ParameterError) -> Self {
        match error {
            ParameterError::NotFinite { part, value, .. } => {
                Self::valued(Code::NotFinite, value, 0.0).at_part(part)
            }
            ParameterError::Mass { part, value, .. } => {
                Self::valued(Code::Mass, value, 0.0).at_part(part)
            }
            ParameterError::TotalMass { value } => Self::valued(Code::Mass, value, 0.0),
            ParameterError::Passive { part, value, .. } => {
                Self::valued(Code::Passive, value, 0.0).at_part(part)
            }
            ParameterError::Asymmetric { part, difference, bound, .. } => {
                Self::valued(Code::Inertia, difference, bound).at_part(part)
            }
            ParameterError::NegativeInertia { part, value, bound } => {
                Self::valued(Code::Inertia, value, bound).at_part(part)
            }
            ParameterError::LargeInertia { part, value } => {
                Self::valued(Code::Inertia, value, 0.0).at_part(part)
            }
            ParameterError::SkewedMount { device, residual, bound } => {
                Self::valued(Code::Mount, residual, bound).at(device, None)
            }
            ParameterError::LeftHandedMount { device, determinant } => {
                Self::valued(Code::Mount, determinant, 1.0).at(device, None)
            }
            ParameterError::Suspension { device, value, bound, .. } => {
                Self::valued(Code::Suspension, value, bound).at(device, None)
            }
            ParameterError::AsymmetricSuspension { device, difference, .. } => {
                Self::valued(Code::Suspension, difference, 0.0).at(device, None)
            }
            ParameterError::Strut { device, value, .. } => {
                Self::valued(Code::Suspension, value, 0.0).at(device, None)
            }
            _ => Code::Other.into(),
        }
    }
}

impl From<SolveError> for Rejection {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::Singular { device, joint, pivot, bound } => {
                Self::valued(Code::Singular, pivot, bound).at(device, joint)
            }
            SolveError::NotFinite { what, value } => {
                Self::valued(Code::NotFinite, value, 0.0).about(what)
            }
            SolveError::LockedJointMoves { device, joint, rate } => {
                Self::valued(Code::LockedJointMoves, rate, 0.0).at(device, joint)
            }
            SolveError::FixedHubMoves { value } => Self::valued(Code::FixedHubMoves, value, 0.0),
            SolveError::NotDriven { device, joint } => {
                Rejection::from(Code::NotDriven).at(device, joint)
            }
            SolveError::AtCentre => Code::AtCentre.into(),
            SolveError::Unstable { device, joint, dt, longest } => {
                Self::valued(Code::Unstable, dt, longest).at(device, joint)
            }
            SolveError::Overflow { what } => Self::from(Code::Overflow).about(what),
            _ => Code::Other.into(),
        }
    }
}

impl From<SteeringError> for Rejection {
    fn from(error: SteeringError) -> Self {
        match error {
            SteeringError::Platform { device } => Self::from(Code::NoSteering).at(device, None),
            SteeringError::Singular { pivot, bound } => Self::valued(Code::NoTorque, pivot, bound),
            SteeringError::Argument { value, .. } if value.is_finite() => {
                Self::valued(Code::Command, value, 0.0)
            }
            SteeringError::Argument { value, .. } => Self::valued(Code::NotFinite, value, 0.0),
            SteeringError::Overflow => Code::Overflow.into(),
            SteeringError::Solve(error) => error.into(),
            _ => Code::Other.into(),
        }
    }
}

fn code_of(number: i32) -> Option<Code> {
    Code::ALL.iter().copied().find(|code| *code as i32 == number)
}

/// The name of a code as in the header, `PRECESS_ERROR_NULL`; static, never null.
#[unsafe(no_mangle)]
pub extern "C" fn precess_error_name(code: i32) -> *const c_char {
    code_of(code).map_or(c"PRECESS_UNKNOWN_CODE", Code::name).as_ptr()
}

/// Writes what a code means and its remedy into `buffer`, cut to `length` bytes with the zero that
/// ends it.
///
/// # Safety
///
/// `buffer` points to `length` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_error_text(code: i32, buffer: *mut c_char, length: usize) -> i32 {
    let text = code_of(code).map_or(c"no such code", Code::text).to_bytes();
    if buffer.is_null() {
        return Code::Null as i32;
    }
    // SAFETY: not null, and `length` bytes are writable by contract; bytes are always aligned.
    let Ok(buffer) = (unsafe { memory::slice_mut(buffer.cast::<u8>(), length) }) else {
        return Code::TooMany as i32;
    };
    let Some((end, room)) = buffer.split_last_mut() else { return Code::TooSmall as i32 };
    *end = 0;
    for (to, from) in room.iter_mut().zip(text.iter().chain(&[0])) {
        *to = *from;
    }
    let whole = length > text.len();
    (if whole { Code::Ok } else { Code::TooSmall }) as i32
}
