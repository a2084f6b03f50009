//! Error of the accelerations where they are ill conditioned, and a run beside Basilisk's:
//! `docs/accuracy.md`.
//!
//! Run by `cargo xtask accuracy`, which writes the page or compares it. The same bytes on
//! every run: spacecraft are seeded, and solver and reference give the same bits on every machine.

mod chart;
mod limit;
mod page;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use precess_tests::accuracy::kinds::{BareBalancedDgvscmg, BareDgcmg, BareDgvscmg, BareVscmg};
use precess_tests::accuracy::{AccuracyAtDistance, offset, pose};
use precess_tests::wheels::{Difference, Stored};

/// Measures both sweeps and the run, and writes the page with its figure.
#[derive(Parser)]
#[command(
    after_help = "Example: accuracy --out target/accuracy --derivatives target/derivatives.txt"
)]
struct Arguments {
    /// Where the page goes
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Errors of the derivatives, as the suite `linearize` writes them
    #[arg(long, value_name = "FILE")]
    derivatives: PathBuf,
}

/// Errors of derivatives: worst and median of the spacecraft's worst blocks.
struct Derivatives {
    worst: f64,
    median: f64,
    spacecraft: u64,
}

impl Derivatives {
    /// Those by states and inputs, and those by parameters.
    fn read(path: &Path) -> Result<[Self; 2], Box<dyn Error>> {
        let text = fs::read_to_string(path)
            .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let row = |line: &str| {
            let mut words = line.split(' ');
            let mut next = || words.next().ok_or("a line has fewer than three numbers");
            let (worst, median) = (next()?.parse()?, next()?.parse()?);
            Ok::<_, Box<dyn Error>>(Self { worst, median, spacecraft: next()?.parse()? })
        };
        let rows = text.lines().map(row).collect::<Result<Vec<_>, _>>()?;
        <[Self; 2]>::try_from(rows).map_err(|_| "there are not two lines of derivatives".into())
    }
}

/// Both sweeps, each from where the bound holds to where it is lost.
struct Sweeps {
    /// Imbalanced wheels on the massless gimbals of a DGVSCMG, by the distance from the pose.
    dgvscmg: Vec<AccuracyAtDistance>,
    /// Balanced ones.
    balanced: Vec<AccuracyAtDistance>,
    /// Kinds that no pose makes singular, at the least distance from that of a DGVSCMG.
    others: Vec<(&'static str, AccuracyAtDistance)>,
    /// By the distance of the centre of mass from B.
    offset: Vec<AccuracyAtDistance>,
}

impl Sweeps {
    fn measured() -> Self {
        let distances = pose::distances();
        let least = distances[0];
        let falling = || distances.iter().rev().copied();
        Self {
            dgvscmg: falling().map(pose::at::<BareDgvscmg>).collect(),
            balanced: falling().map(pose::at::<BareBalancedDgvscmg>).collect(),
            others: vec![
                ("dgcmg", pose::at::<BareDgcmg>(least)),
                ("vscmg", pose::at::<BareVscmg>(least)),
            ],
            offset: offset::distances().into_iter().map(offset::at).collect(),
        }
    }
}

/// Three reaction wheels, run beside Basilisk.
struct Beside {
    stored: Stored,
    differences: [Difference; 6],
}

impl Beside {
    fn measured() -> Result<Self, Box<dyn Error>> {
        let stored = Stored::read()?;
        let differences = stored.differences()?;
        Ok(Self { stored, differences })
    }
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let sweeps = Sweeps::measured();
    let out = &arguments.out;
    fs::create_dir_all(out).map_err(|error| format!("cannot make {}: {error}", out.display()))?;
    let derivatives = Derivatives::read(&arguments.derivatives)?;
    let text = page::page(&sweeps, &Beside::measured()?, &derivatives)?;
    for (name, text) in [("accuracy.md", text), ("accuracy.svg", chart::chart(&sweeps)?)] {
        let path = out.join(name);
        fs::write(&path, text)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    Ok(())
}
