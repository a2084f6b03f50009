//! The solver over the emitted kernels.
