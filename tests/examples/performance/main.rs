//! Services of Precess and peers, checked against each other and timed in one run:
//! `docs/performance.md`, of what gives `docs/performance-flexible.md`, of derivatives
//! `docs/performance-derivatives.md`.
//!
//! Run by `cargo xtask bench`, which sets the peers up and builds what is run here. Nothing is
//! timed unless all results agree. Every number on the page comes from the run that writes it.

mod agreement;
mod axis;
mod breakdown;
mod chart;
mod contender;
mod derivatives;
mod flexible;
mod goals;
mod machine;
mod page;
mod plan;
mod program;
mod race;
mod subject;
mod tables;
mod tried;
mod verdict;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};

use clap::Parser;

use machine::Machine;
use page::Page;
use plan::Plan;
use program::Program;
use race::race;
use subject::Subject;

/// Checks services and peers against each other, times them, writes the page.
#[derive(Parser)]
#[command(
    after_help = "Example: performance --measure target/release/measure --portable target/release/portable"
)]
#[expect(clippy::struct_excessive_bools, reason = "options of a command line")]
struct Arguments {
    /// The program `measure`
    #[arg(long, value_name = "FILE")]
    measure: PathBuf,
    /// The program `portable`
    #[arg(long, value_name = "FILE", required_unless_present_any = ["flexible", "derivatives"])]
    portable: Option<PathBuf>,
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
    /// Only wheels on bearings, on a platform, on a flexible structure, and their page
    #[arg(long)]
    flexible: bool,
    /// Only derivatives, and their page
    #[arg(long, conflicts_with = "flexible")]
    derivatives: bool,
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
    let mut contenders = Vec::new();
    if let Some(portable) = &arguments.portable {
        contenders.extend(contender::services(portable, &pinned)?);
    }
    contenders.extend(contender::services(&arguments.measure, &pinned)?);
    contenders.extend(contender::floors(&measure, &contenders));
    let mut missing = Vec::new();
    if !arguments.skip_peers {
        let peers = contender::peers(&arguments.peers, &pinned)?;
        contenders.extend(peers.present);
        missing = peers.missing;
    }
    reject_skips(&missing)?;
    let apart =
        [(Subject::Flexible, arguments.flexible), (Subject::Derivatives, arguments.derivatives)];
    contenders.retain(|who| match apart.into_iter().find(|(_, only)| *only) {
        Some((only, _)) => who.subject == only,
        None => apart.into_iter().all(|(subject, _)| who.subject != subject),
    });
    let machine = Machine::new(&measure, &pinned)?;
    let folder = &arguments.peers;
    // The page of a quick run is not kept.
    let out = if arguments.quick { folder } else { &arguments.out };
    if arguments.flexible {
        let worst = agreement::check(&contenders, &[Subject::Flexible], &plan, folder)?;
        let times = race(&[Plan::flexible(&contenders)], plan.rounds, folder)?;
        let page = flexible::Page { plan, machine, contenders, worst, times };
        return written(out, page.files()?);
    }
    if arguments.derivatives {
        derivatives::write_cases(folder)?;
        let worst = agreement::check(&contenders, &[Subject::Derivatives], &plan, folder)?;
        let times = race(&Plan::derivatives(&contenders), plan.rounds, folder)?;
        let page = derivatives::Page { plan, machine, contenders, missing, worst, times };
        return written(out, page.files()?);
    }
    let worst = agreement::check(&contenders, &agreement::GROUPS, &plan, folder)?;
    let times = race(&plan.heats(&contenders), plan.rounds, folder)?;
    let parts = breakdown::parts(&measure, &plan, folder)?;
    let page = Page { plan, machine, contenders, missing, worst, times, parts };
    page.show();
    written(out, page.files()?)
}

/// Writes the files of a page.
fn written(out: &Path, files: Vec<(&'static str, String)>) -> Result<(), Box<dyn Error>> {
    for (name, text) in files {
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
