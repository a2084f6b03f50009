//! Kernels to text: what is shared is named, and every line is short. Templates lay out the
//! kernels; a kind's second file is tokens, printed at once.
//!
//! Invariants: the same kernels give the same bytes; every operation of the graph is written once
//! in a function, or once in `prepare` when it depends on parameters only; no line passes 100
//! columns. `rustfmt` skips the modules of emitted files.

mod body;
pub mod c;
mod cost;
mod device;
mod device_bodies;
mod device_calls;
mod device_items;
mod device_parameters;
mod device_results;
mod error;
mod factor;
mod file;
mod functions;
mod inputs;
mod map_and_zip;
mod parts;
mod prepare;
mod render;
mod shared;
mod standalone;
mod target_crate;
mod text;

pub use body::{Counts, FunctionBody};
pub use error::EmitError;
pub use file::{Emitted, EmittedFile, of_kind};
pub use functions::{Functions, functions};
pub use shared::{files, shared};
pub use standalone::{StandaloneKernels, standalone_kernels, standalone_records};
pub use target_crate::TargetCrate;
pub use text::{capital, pretty_items, wrapped};
