//! Batches on a device: the kernels compiled by the host's compiler, driven as a GPU is, have the bits of the solver in Rust.
#![allow(unsafe_code, reason = "libraries are loaded and called by address")]

mod bits;
#[allow(dead_code, reason = "shared with the suite of the emitted solver")]
#[path = "../../../../codegen/bake/tests/c_solver/case.rs"]
mod case;
mod compiler;
mod failing;
mod host;
#[allow(dead_code, reason = "shared with the suite of the emitted kernels")]
#[path = "../../../../codegen/tests/c_kernels/random.rs"]
mod random;
#[allow(dead_code, reason = "shared with the suite of the emitted solver")]
#[path = "../../../../codegen/bake/tests/c_solver/reference.rs"]
mod reference;
mod refused;
mod spacecraft;
