//! Prints the bits of `f64` evaluations and runs of every kind.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::fmt::Write;

use precess_firmware::board::Options;
use precess_firmware::conformance::{Stop, report};

precess_firmware::program!(program);

fn program(out: &mut dyn Write, options: Options) -> Result<(), Stop<f64>> {
    report(out, options.nudge)
}
