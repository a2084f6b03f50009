//! What a sample costs: the imaging satellite with its four DGVSCMGs for ten seconds, at 1 kHz to
//! CSV, to NPZ and to nothing, less the same run with two samples.
//!
//! `cargo bench -p precess --bench sample_cost`; the least of nine runs each, in turns.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use precess::engine::run;
use precess::file::from_file;
use precess::record::{Csv, Npz, Recorder, RecorderGroup};
use precess::scenario::Scenario;

const RUNS: usize = 9;
const DURATION: f64 = 10.0;

/// Where samples go.
#[derive(Clone, Copy)]
enum Format {
    Nowhere,
    Csv,
    Npz,
}

/// A row of the table.
struct Case {
    name: &'static str,
    format: Format,
    scenario: Scenario,
    /// s.
    least: f64,
}

fn case(name: &'static str, format: Format, rate: f64, columns: &str) -> Result<Case, String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/imaging-satellite.toml");
    // Few steps, so that the samples are most of the time.
    let mut overrides = vec![
        format!("run.duration = \"{DURATION} s\""),
        format!("output.rate = \"{rate} Hz\""),
        "run.tolerance = 1e-4".to_owned(),
    ];
    if !columns.is_empty() {
        overrides.push(format!("output.columns = {columns}"));
    }
    let (mut scenario, _) = from_file(&file, &overrides).map_err(|errors| errors.to_string())?;
    scenario.requirements.clear();
    Ok(Case { name, format, scenario, least: f64::INFINITY })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hub = "[\"position\", \"velocity\", \"attitude\", \"omega\"]";
    let joints = "[\"omega\", \"cmg1.spin\", \"cmg2.spin\", \"cmg3.spin\", \"cmg4.spin\"]";
    let loads = "[\"omega\", \"cmg1\", \"loads\"]";
    let mut cases = [
        case("two samples", Format::Nowhere, 1.0 / DURATION, "")?,
        case("hub's state, CSV", Format::Csv, 1e3, hub)?,
        case("angular velocity and wheel speeds, CSV", Format::Csv, 1e3, joints)?,
        case("default columns, to nothing", Format::Nowhere, 1e3, "")?,
        case("default columns, CSV", Format::Csv, 1e3, "")?,
        case("default columns, NPZ", Format::Npz, 1e3, "")?,
        case("all loads, CSV", Format::Csv, 1e3, loads)?,
    ];
    let folder = tempfile::tempdir()?;
    let mut samples = [0; 7];
    for _ in 0..RUNS {
        for (case, samples) in cases.iter_mut().zip(&mut samples) {
            let mut recorder: Box<dyn Recorder> = match case.format {
                Format::Nowhere => Box::new(RecorderGroup::default()),
                Format::Csv => Box::new(Csv::new(&folder.path().join("cost.csv"))),
                Format::Npz => Box::new(Npz::new(&folder.path().join("cost.npz"))),
            };
            let start = Instant::now();
            let outcome = run(&case.scenario, &mut *recorder, &mut |_| ControlFlow::Continue(()))?;
            case.least = case.least.min(start.elapsed().as_secs_f64());
            *samples = outcome.samples;
        }
    }
    let [base, cases @ ..] = &cases;
    println!("{}: {:.1} ms", base.name, base.least * 1e3);
    for (case, samples) in cases.iter().zip(&samples[1..]) {
        #[expect(clippy::cast_precision_loss, reason = "ten thousand")]
        let each = (case.least - base.least) / *samples as f64 * 1e6;
        println!("{}: {:.1} ms, {each:.2} us a sample", case.name, case.least * 1e3);
    }
    Ok(())
}
