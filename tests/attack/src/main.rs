//! `cargo xtask attack`: the campaign against the promises of docs/promises.md, from the command
//! line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use std::{fs, io};

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use precess_attack::campaign::{Campaign, Failure, PropertyResult, chunk};
use precess_attack::progress::Progress;
use precess_attack::properties::{PROPERTIES, Property, named};

/// Try to break a promise of docs/promises.md with random spacecraft
#[derive(Parser)]
#[command(
    name = "cargo xtask attack",
    bin_name = "cargo xtask attack",
    after_help = "Examples: cargo xtask attack --minutes 10\n          \
                  cargo xtask attack --property singular-is-refused --seed 7"
)]
struct Options {
    /// For how long new cases are drawn
    #[arg(long, default_value_t = 1.0)]
    minutes: f64,
    /// The campaign: the same seed continues where it ended; a new one without this option
    #[arg(long)]
    seed: Option<u64>,
    /// One property
    #[arg(long)]
    property: Option<String>,
    /// One chunk of that property and seed, once more
    #[arg(long, requires = "seed", requires = "property")]
    chunk: Option<u64>,
    /// Say each property in a sentence, and end
    #[arg(long)]
    list: bool,
    /// Where progress and failures are kept
    #[arg(long, default_value = "target/attack")]
    folder: PathBuf,
}

fn main() -> ExitCode {
    match attack(&Options::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Whether every promise held.
fn attack(options: &Options) -> Result<bool, String> {
    if options.list {
        for property in PROPERTIES {
            println!("{}: {}", property.name, property.statement);
        }
        return Ok(true);
    }
    let properties: Vec<&'static Property> = match &options.property {
        None => PROPERTIES.iter().collect(),
        Some(name) => vec![named(name).ok_or_else(|| unknown(name))?],
    };
    // A panic is a failure that is reported with its case.
    std::panic::set_hook(Box::new(|_| {}));
    if let (Some(number), Some(seed), [property]) = (options.chunk, options.seed, &properties[..]) {
        let (tally, failure) = chunk(property, seed, number, property.cases);
        let row = PropertyResult { tally, failures: failure.into_iter().collect() };
        return report(&BTreeMap::from([(property.name, row)]), &properties, &options.folder);
    }
    let path = options.folder.join("progress");
    let progress = Progress::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let seed = options.seed.unwrap_or_else(|| progress.unused());
    if !(options.minutes.is_finite() && options.minutes >= 0.0) {
        return Err(format!("{} minutes; give a number from 0", options.minutes));
    }
    let time = Duration::from_secs_f64(60.0 * options.minutes);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    println!("seed {seed}, {threads} threads, {:.1} min", options.minutes);
    let bar = ProgressBar::new(time.as_secs());
    let style = ProgressStyle::with_template("{elapsed_precise} {wide_bar} {msg}");
    bar.set_style(style.map_err(|error| error.to_string())?);
    let start = Instant::now();
    let campaign = Campaign { seed, properties, deadline: start + time, threads };
    let counted = Mutex::new((0_u64, 0_u64));
    let rows = campaign.run(&Mutex::new(progress), |property, tally, failure| {
        let Ok(mut counted) = counted.lock() else { return };
        counted.0 += tally.cases;
        counted.1 += u64::from(failure.is_some());
        bar.set_position(start.elapsed().as_secs());
        bar.set_message(format!("{} cases, {} failures, {}", counted.0, counted.1, property.name));
    });
    bar.finish_and_clear();
    report(&rows, &campaign.properties, &options.folder)
}

fn unknown(name: &str) -> String {
    let known: Vec<_> = PROPERTIES.iter().map(|property| property.name).collect();
    format!("no property {name}; there are {}", known.join(", "))
}

/// One row for each property, and every failure as code; whether there is none.
fn report(
    rows: &BTreeMap<&'static str, PropertyResult>,
    properties: &[&'static Property],
    folder: &Path,
) -> Result<bool, String> {
    let failures: Vec<&Failure> = rows.values().flat_map(|row| &row.failures).collect();
    for failure in &failures {
        let path =
            written(failure, folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        println!("{}\n// also in {}\n", failure.code(), path.display());
    }
    println!("{:<28} {:>10} {:>10} {:>9}", "property", "cases", "rejected", "failures");
    for property in properties {
        let row = rows.get(property.name).cloned().unwrap_or_default();
        let failed = row.failures.iter().filter(|failure| !failure.panicked).count();
        let tally = row.tally;
        println!("{:<28} {:>10} {:>10} {failed:>9}", property.name, tally.cases, tally.rejected);
    }
    let cases: u64 = rows.values().map(|row| row.tally.cases).sum();
    let panics = failures.iter().filter(|failure| failure.panicked).count();
    println!("{:<28} {cases:>10} {:>10} {panics:>9}", "never-panics", 0);
    Ok(failures.is_empty())
}

/// Writes the code of a failure.
fn written(failure: &Failure, folder: &Path) -> io::Result<PathBuf> {
    let folder = folder.join("failures");
    fs::create_dir_all(&folder)?;
    let path = folder.join(format!("{}-{}-{}.rs", failure.name(), failure.seed, failure.chunk));
    fs::write(&path, failure.code())?;
    Ok(path)
}
