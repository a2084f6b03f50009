//! [`PrecessBatch`]: `struct precess_batch` of `precess_batch.h`, the argument of the kernels, field by field.

/// A batch as the kernels take it, by value. Addresses are those of the device, zero where an array is not there.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct PrecessBatch {
    /// What all states share.
    pub shared: u64,
    /// Parameters of each state.
    pub parameters: u64,
    /// Inputs of each state.
    pub inputs: u64,
    /// The states.
    pub states: u64,
    /// The first samples.
    pub start: u64,
    /// Accelerations.
    pub accelerations: u64,
    /// Minimum of the samples.
    pub minimum: u64,
    /// Maximum.
    pub maximum: u64,
    /// Sum, then mean.
    pub mean: u64,
    /// Sum of squares, then root of the mean square.
    pub rms: u64,
    /// Samples.
    pub history: u64,
    /// A status for each state.
    pub statuses: u64,
    /// Step, s.
    pub dt: f64,
    /// States.
    pub count: i32,
    /// Steps that earlier calls have taken.
    pub first: i32,
    /// Steps of this call.
    pub steps: i32,
    /// Steps between samples.
    pub every: i32,
    /// Whether this call ends the run.
    pub is_last: i32,
}

// The kernels are for machines whose addresses have 64 bits: three quarters of a line of cache, and padding to eight.
const _: () = assert!(size_of::<PrecessBatch>() == 128 && size_of::<usize>() == 8);

impl PrecessBatch {
    /// The field of an array.
    pub(crate) fn address(&mut self, array: crate::Array) -> &mut u64 {
        use crate::Array;
        match array {
            Array::Parameters => &mut self.parameters,
            Array::Inputs => &mut self.inputs,
            Array::States => &mut self.states,
            Array::Start => &mut self.start,
            Array::Accelerations => &mut self.accelerations,
            Array::Minimum => &mut self.minimum,
            Array::Maximum => &mut self.maximum,
            Array::Mean => &mut self.mean,
            Array::Rms => &mut self.rms,
            Array::History => &mut self.history,
        }
    }

    /// Whether the field of an array is set; for devices of tests.
    #[must_use]
    pub fn with(mut self, array: crate::Array, address: u64) -> Self {
        *self.address(array) = address;
        self
    }
}
