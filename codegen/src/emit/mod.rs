//! Kernels to text: what is shared is named, and every line is short. Templates lay out the
//! kernels; a kind's second file is tokens, printed at once.
//!
//! Invariants: the same kernels give the same bytes; every operation of the graph is written once
//! in a function, or once in `prepare` when it depends on parameters only; no line passes 100
//! columns. `rustfmt` skips the modules of emitted files.

mod alone;
mod body;
mod by_number;
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
mod home;
mod inputs;
mod parts;
mod prepare;
mod render;
mod shared;
mod text;

pub use alone::{Alone, alone, alone_records};
pub use body::{Counts, FunctionBody};
pub use error::EmitError;
pub use file::{Emitted, EmittedFile, of_kind};
pub use functions::{Functions, functions};
pub use home::Home;
pub use shared::{every_kind, files, shared};
pub use text::{capital, pretty_items, wrapped};
