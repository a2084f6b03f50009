//! [`GpuError`]: why a GPU computes nothing; [`SetError`]: why spacecraft are no batch; [`StateError`]: why a state has no
//! result.

use std::fmt;

use precess_dynamics::{ParameterError, SolveError};

/// Why a GPU does not compute a batch. The processor does, with the same bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GpuError {
    /// There is no driver, libcuda.
    NoDriver,
    /// There is no NVRTC, libnvrtc, which compiles the kernels.
    NoCompiler,
    /// The program that derives the kernels cannot be started, or fails: what it says.
    Generator(String),
    /// NVRTC rejects the sources: what it says.
    Compile(String),
    /// The driver fails: at what, and its code.
    Driver {
        /// What was done.
        at: &'static str,
        /// What the driver returned.
        code: String,
    },
    /// One state takes more memory than the GPU has, bytes.
    Memory {
        /// Of one state.
        state: usize,
        /// What is free.
        free: usize,
    },
    /// An array of another length than the batch has: a fault of this crate.
    Length {
        /// Which.
        array: &'static str,
        /// Numbers that it needs.
        expected: usize,
        /// Numbers that it has.
        found: usize,
    },
}

impl fmt::Display for GpuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDriver => {
                write!(f, "there is no driver of a GPU (libcuda); install the driver of NVIDIA")
            }
            Self::NoCompiler => write!(
                f,
                "there is no NVRTC (libnvrtc), which compiles the kernels; install CUDA, or `pip install \
                 nvidia-cuda-nvrtc-cu12`"
            ),
            Self::Generator(what) => write!(
                f,
                "`precess-bake`, which derives the kernels: {what}; install it with `cargo install --path \
                 codegen/bake`"
            ),
            Self::Compile(log) => write!(f, "NVRTC rejects the kernels: {log}"),
            Self::Driver { at, code } => write!(f, "{at} fails on the GPU: {code}"),
            Self::Memory { state, free } => write!(
                f,
                "a state takes {state} bytes and {free} are free on the GPU; keep fewer samples"
            ),
            Self::Length { array, expected, found } => {
                write!(f, "{array} has {found} numbers; it needs {expected}")
            }
        }
    }
}

impl std::error::Error for GpuError {}

/// Why spacecraft are no batch of a GPU.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SetError {
    /// There is no spacecraft.
    Empty,
    /// The spacecraft have no device.
    NoDevice,
    /// A spacecraft has other kinds of devices than the first: its number.
    Kinds(usize),
    /// The imbalance of a device is lumped: numbers of spacecraft and device.
    Lumped(usize, usize),
    /// An array of another length than spacecraft and states have.
    Length {
        /// Which.
        array: &'static str,
        /// Numbers that it needs.
        expected: usize,
        /// Numbers that it has.
        found: usize,
    },
}

impl fmt::Display for SetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "a batch needs a spacecraft"),
            Self::NoDevice => {
                write!(f, "batches on a GPU are of spacecraft with devices; it has none")
            }
            Self::Kinds(craft) => write!(
                f,
                "spacecraft {craft} has other kinds of devices than the first; a batch on a GPU has the same"
            ),
            Self::Lumped(craft, device) => write!(
                f,
                "the imbalance of device {device} of spacecraft {craft} is lumped, and kernels of a GPU couple it; \
                 state `imbalance_model = \"coupled\"`"
            ),
            Self::Length { array, expected, found } => {
                write!(f, "{array} has {found} numbers; it needs {expected}")
            }
        }
    }
}

impl std::error::Error for SetError {}

/// Why a state has no result: what the solver in Rust says of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StateError {
    /// Its parameters are not those of a spacecraft.
    Parameters(ParameterError),
    /// It has no accelerations, or no next state.
    Solve(SolveError),
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parameters(error) => error.fmt(f),
            Self::Solve(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for StateError {}
