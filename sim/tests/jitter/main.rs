//! Jitter in the frequency domain against closed forms and against runs of the coupled equations.

mod command;
mod cubesat;
mod errors;
#[cfg(target_os = "linux")]
mod interrupted;
mod keep_out;
mod known;
mod map;
mod phases;
mod run;
mod settled;
mod sources;
mod speeds;

#[path = "../../examples/imbalance_map/page.rs"]
mod page;
#[path = "../../examples/imbalance_map/picture.rs"]
mod picture;
