//! Reads the kernels of every kind out of this program's own machine code: what
//! `cargo xtask instructions` prints beside the counts of calls.
//!
//! One line a kernel: name, arithmetic operations, loads, stores, copies between registers, and the
//! latency of the longest chain in cycles.

mod code;
mod counts;

use std::error::Error;
use std::process::ExitCode;

use precess_dynamics::kind::Kind;
use precess_tests::measured::{EachKind, each_kind};

use code::Program;
use counts::Counts;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    if !cfg!(target_arch = "x86_64") {
        return Err("the machine code of x86_64 only is read".into());
    }
    let mut kernels = Addresses(Vec::new());
    each_kind(&mut kernels);
    let file = std::fs::read(std::env::current_exe()?)?;
    let program = Program::new(&file, (run as fn() -> Result<(), Box<dyn Error>>) as usize)?;
    for (name, address) in kernels.0 {
        let code = program.function(address).ok_or_else(|| format!("no code of {name}"))?;
        let counts = Counts::of_function(code).map_err(|why| format!("{name}: {why}"))?;
        let Counts { arithmetic, loads, stores, copies, chain } = counts;
        println!("{name} {arithmetic} {loads} {stores} {copies} {chain}");
    }
    Ok(())
}

/// Where the kernels of each kind are.
struct Addresses(Vec<(String, usize)>);

impl EachKind<f64> for Addresses {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, _: K) {
        let eliminate: fn(&_, &_, &_, &_, &_) -> _ = K::eliminate::<f64>;
        let back_substitute: fn(&_, &_) -> _ = K::back_substitute::<f64>;
        self.0.push((format!("{name}/eliminate"), eliminate as usize));
        self.0.push((format!("{name}/back_substitute"), back_substitute as usize));
    }
}
