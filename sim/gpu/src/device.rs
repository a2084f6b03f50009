//! [`Device`] and [`Kernels`]: what a batch needs of a GPU. Implemented by CUDA here, and in the tests by a library that the
//! host's compiler makes of the same sources.

use crate::{GpuError, Sources};

/// An array of columns on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Array {
    /// Parameters of each state.
    Parameters,
    /// Inputs of each state.
    Inputs,
    /// The states.
    States,
    /// The first samples, where they differ from the states.
    Start,
    /// Accelerations.
    Accelerations,
    /// Minimum of the samples.
    Minimum,
    /// Maximum of the samples.
    Maximum,
    /// Mean of the samples.
    Mean,
    /// Root of the mean square of the samples.
    Rms,
    /// Samples, one after another.
    History,
}

impl Array {
    /// Every array.
    pub const ALL: [Self; 10] = [
        Self::Parameters,
        Self::Inputs,
        Self::States,
        Self::Start,
        Self::Accelerations,
        Self::Minimum,
        Self::Maximum,
        Self::Mean,
        Self::Rms,
        Self::History,
    ];
}

/// A part of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Step, s.
    pub dt: f64,
    /// Steps that were taken before.
    pub first: i32,
    /// Steps to take.
    pub steps: i32,
    /// Steps between samples, at least one.
    pub every: i32,
    /// Whether the run ends with them.
    pub is_last: bool,
}

/// A device that compiles and runs kernels.
pub trait Device: Send + Sync {
    /// Its name, for tables.
    fn name(&self) -> String;

    /// Kernels of a set of devices.
    ///
    /// # Errors
    /// The compiler rejects the sources, or the driver fails.
    fn compile(&self, sources: &Sources) -> Result<Box<dyn Kernels>, GpuError>;
}

/// The compiled kernels of a set of devices, with the arrays of one batch.
pub trait Kernels: Send {
    /// Bytes that arrays may take.
    ///
    /// # Errors
    /// The driver fails.
    fn free_bytes(&self) -> Result<usize, GpuError>;

    /// Writes what all states share; returns the status of the parameters.
    ///
    /// # Errors
    /// The driver fails.
    fn prepare(&mut self, parameters: &[f64], inputs: &[f64]) -> Result<i32, GpuError>;

    /// Begins a batch of so many states, all of status zero: no array is there.
    ///
    /// # Errors
    /// The driver fails.
    fn begin(&mut self, count: i32) -> Result<(), GpuError>;

    /// Makes an array of these numbers.
    ///
    /// # Errors
    /// The driver fails.
    fn write(&mut self, array: Array, numbers: &[f64]) -> Result<(), GpuError>;

    /// Makes an array of so many zeros.
    ///
    /// # Errors
    /// The driver fails.
    fn zeros(&mut self, array: Array, length: usize) -> Result<(), GpuError>;

    /// Computes accelerations and statuses.
    ///
    /// # Errors
    /// The driver fails.
    fn accelerations(&mut self) -> Result<(), GpuError>;

    /// Computes steps, and waits for them.
    ///
    /// # Errors
    /// The driver fails.
    fn run(&mut self, segment: Segment) -> Result<(), GpuError>;

    /// Reads an array that is there.
    ///
    /// # Errors
    /// The driver fails; [`GpuError::Length`].
    fn read(&self, array: Array, out: &mut [f64]) -> Result<(), GpuError>;

    /// Reads the statuses.
    ///
    /// # Errors
    /// The driver fails; [`GpuError::Length`].
    fn statuses(&self, out: &mut [i32]) -> Result<(), GpuError>;
}
