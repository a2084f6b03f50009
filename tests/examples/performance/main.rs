//! Services of Precess and peers, checked against each other and timed in one run:
//! `docs/performance`.
//!
//! Run by `cargo xtask bench`, which sets the peers up and builds what is run here. Nothing is
//! timed unless all results agree. Every number on the page comes from the run that writes it.

mod agreement;
mod axis;
mod chart;
mod contender;
mod goals;
mod machine;
mod page;
mod program;
mod race;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::{env, fs};

use clap::Parser;

use contender::Contender;
use machine::Machine;
use page::Page;
use program::Program;
use race::{Plan, race};

/// Checks services and peers against each other, times them, writes the page.
#[derive(Parser)]
#[command(after_help = "Example: performance --measure target/release/examples/measure")]
struct Arguments {
    /// The program `measure`
    #[arg(long, value_name = "FILE")]
    measure: PathBuf,
    /// The folder of spacecraft and peers
    #[arg(long, value_name = "DIR", default_value = "target/peers")]
    peers: PathBuf,
    /// Where the page goes
    #[arg(long, value_name = "DIR", default_value = "docs")]
    out: PathBuf,
    /// One round over few spacecraft; the page goes to the folder of the peers
    #[arg(long)]
    quick: bool,
    /// Only Precess
    #[arg(long)]
    skip_peers: bool,
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
    let pinned = program::pinned();
    let measure = Program::new(&arguments.measure, &pinned);
    let plan = if arguments.quick { Plan::QUICK } else { Plan::FULL };
    let mut contenders = contender::services(&measure)?;
    let mut missing = Vec::new();
    if !arguments.skip_peers {
        let peers = contender::peers(&arguments.peers, &pinned)?;
        contenders.extend(peers.present);
        missing = peers.missing;
    }
    reject_skips(&missing)?;
    let worst = agreement::check(&contenders, &plan, &arguments.peers)?;
    let machine = Machine::new(&measure, &pinned)?;
    let times = race(&contenders, &plan, &arguments.peers)?;
    let parts = page::parts(&measure, &plan, &arguments.peers)?;
    let page = Page { machine, contenders, missing, worst, times, parts };
    page.show();
    // The page of a quick run is not kept.
    let out = if arguments.quick { &arguments.peers } else { &arguments.out };
    for (name, text) in page.files()? {
        let path = out.join(name);
        fs::write(&path, text)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

/// Says what is missing; fails where nothing may be.
fn reject_skips(missing: &[contender::Missing]) -> Result<(), String> {
    for contender::Missing { name, missing } in missing {
        eprintln!("skipped: {name}; {missing}");
    }
    let all = env::var_os("PRECESS_REQUIRE_ALL").is_some_and(|value| value == "1");
    if all && !missing.is_empty() {
        return Err(format!(
            "{} peers are missing; PRECESS_REQUIRE_ALL=1 allows no skip",
            missing.len()
        ));
    }
    Ok(())
}

/// A contender by what its name has in it.
fn named<'a>(contenders: &'a [Contender], part: &str) -> Option<&'a Contender> {
    contenders.iter().find(|contender| contender.name.to_lowercase().contains(part))
}
