//! Why nothing is emitted.

use std::fmt;

use precess_codegen::emit::EmitError;
use precess_codegen::proof::EmittedError;

/// Why a spacecraft has no kernels of its own.
#[derive(Debug)]
pub enum BakeError {
    /// Device, and its kind, which is none.
    Kind(String, String),
    /// Device, number of bodies that its kind has, and that are described.
    Bodies(String, usize, usize),
    /// Device, and a value that its kind has no parameter for: it must be zero, or equal another.
    Pattern(String, String),
    /// Device, and a name to keep that is no parameter of its kind.
    Keep(String, String),
    /// The spacecraft's name, which is one of the emitted files' or of a language.
    Name(String),
    /// A device with a body, another one likewise, and the name that both joints have in C.
    SameName([String; 2], [String; 2], String),
    /// Device, and the body of a joint with a motor that nothing moves with.
    Massless(String, String),
    /// A claim that does not hold, with the terms that differ.
    NotProven(String),
    /// A file that cannot be laid out.
    Emit(EmitError),
    /// A file that cannot be read back.
    Read(EmittedError),
    /// A spacecraft whose accelerations the reference cannot solve for.
    Singular,
    /// A spacecraft of which no joint moves.
    Rigid,
    /// Device, by how much its mount is off the turns that are stated of it, and the bound.
    Mount(String, f64, f64),
    /// Function, and what of it cannot be evaluated.
    Statement(String, String),
    /// Device or hub, constant, and its value, which is infinite or NaN.
    NotFinite(String, String, f64),
}

impl fmt::Display for BakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kind(device, kind) => {
                let kinds = precess_codegen::kinds::KINDS.iter().map(|kind| kind.name);
                let kinds: Vec<_> = kinds.collect();
                write!(f, "{device}: `{kind}` is no kind; kinds are {}", kinds.join(", "))
            }
            Self::Bodies(device, expected, found) => {
                write!(f, "{device}: {found} bodies are described, its kind has {expected}")
            }
            Self::Pattern(device, what) => write!(f, "{device}: its kind has {what}"),
            Self::Keep(device, name) => {
                write!(f, "{device}: `{name}` in `keep` is no parameter of its kind")
            }
            Self::Name(name) => {
                write!(
                    f,
                    "a spacecraft cannot be called `{name}` in Rust and C; choose another name"
                )
            }
            Self::SameName([device, body], [other, other_body], name) => write!(
                f,
                "the joint of the {body} of {device} and that of the {other_body} of {other} are \
                 both `{name}` in C; choose another name for {device} or {other}"
            ),
            Self::Massless(device, body) => write!(
                f,
                "{device}: the joint of the {body} moves no mass and no inertia; state some, or \
                 lock it"
            ),
            Self::NotProven(row) => write!(f, "not proven, so not written: {row}"),
            Self::Emit(error) => write!(f, "{error}"),
            Self::Read(error) => write!(f, "{error}"),
            Self::Singular => write!(
                f,
                "the spacecraft has no inertia in some direction at its reference state; check \
                 masses and inertias"
            ),
            Self::Rigid => write!(
                f,
                "every joint of every device is locked for good, and a rigid spacecraft needs no \
                 kernel; remove `locked_at` of a joint, or unlock all with `--unlock`"
            ),
            Self::Mount(device, off, bound) => write!(
                f,
                "{device}: mount is off by {off:e}, more than {bound:e}, from the turns that are \
                 stated of it; correct `turns`, state more digits, or remove `turns`"
            ),
            Self::Statement(function, what) => {
                write!(f, "{function} cannot be evaluated at `{what}`: a fault of the generator")
            }
            Self::NotFinite(of, name, value) => write!(
                f,
                "{of}: constant {name} is {value}; a product of values overflows, check masses, \
                 places and inertias"
            ),
        }
    }
}

impl std::error::Error for BakeError {}

impl From<EmitError> for BakeError {
    fn from(error: EmitError) -> Self {
        Self::Emit(error)
    }
}

impl From<EmittedError> for BakeError {
    fn from(error: EmittedError) -> Self {
        Self::Read(error)
    }
}
