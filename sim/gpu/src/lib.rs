//! Batches of spacecraft on a GPU: accelerations, and runs of RK4 with inputs held, of many states at a time.
//!
//! The kernels are the solver in C of a set of devices (`precess-bake --general --batch`), compiled at run time without
//! contraction: every state has the bits of [`Spacecraft`](precess_dynamics::Spacecraft), for any launch size. A state that
//! the kernels refuse is computed again by the solver in Rust, which takes angles that they do not, and says what is wrong
//! where it does not. Without a GPU everything is computed so, and the result says why.
//!
//! What is not here: steps of adaptive length, events, flexible structures, platforms, sources, controllers.
//!
//! | file | what |
//! |---|---|
//! | `batch` | [`Batch`]: the states of spacecraft with the same kinds of devices |
//! | `sources` | [`Sources`]: the kernels as text, derived by `precess-bake` |
//! | `inputs` | [`BatchInputs`]: what acts, on all states or on each |
//! | `samples` | [`Samples`]: what a run keeps on the way |
//! | `layout` | where numbers are in columns |
//! | `device` | [`Device`] and [`Kernels`]: what a GPU does, as traits: tests implement them by the host's compiler |
//! | `interface` | [`PrecessBatch`], the argument of the kernels |
//! | `cuda` | a GPU of NVIDIA; the only `unsafe` |
//! | `launch` | launch sizes |
//! | `parts` | a batch on its device, in parts that fit |
//! | `processor` | states that the processor computes, on every core |
//! | `solver` | one state after another by the solver in Rust |
//! | `error` | [`GpuError`], [`SetError`], [`StateError`] |

mod batch;
mod cuda;
mod device;
mod error;
mod inputs;
mod interface;
mod launch;
mod layout;
mod parts;
mod processor;
mod samples;
mod solver;
mod sources;

pub use batch::{Batch, BatchResult, Progress, Steps};
pub use cuda::{compile, open, open_compiled};
pub use device::{Array, Device, Kernels, Segment};
pub use error::{GpuError, SetError, StateError};
pub use inputs::{ActingInputs, BatchInputs};
pub use interface::PrecessBatch;
pub use launch::{LaunchSize, launch_size};
pub use samples::{Reduction, SampleSettings, Samples};
pub use sources::{SourceFile, Sources, generator};
