//! Jitter in the frequency domain against closed forms and against runs of the coupled equations.

mod command;
mod known;
mod map;
mod map_page;
mod run;
mod sources;
