//! Files that commands write, what they print, and how they end: over every command that the command line has.

mod commands;
mod endings;
mod inputs;
mod prints;
mod results;
mod together;
