//! The workbench: one short file per command.

fn main() {}
