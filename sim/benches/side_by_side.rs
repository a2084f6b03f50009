//! What a sample of a campaign takes by itself and side by side with others: RK4 at 1 kHz, sampled at 1 kHz.
//!
//! `cargo bench -p precess --features lanes --bench side_by_side`; the least of nine runs each, in turns.

use std::path::Path;
use std::time::Instant;

use precess::campaign::{Selection, run_reduced};
use precess::engine::SIDE_BY_SIDE;
use precess::file::Template;
use precess::scenario::Scenario;

const RUNS: usize = 9;
const SAMPLES: usize = 16;
const DURATION: f64 = 10.0;

/// Samples of a scenario that differ in the hub's mass.
fn samples(name: &str) -> Result<Vec<Scenario>, String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name);
    let template = Template::from_file(&file).map_err(|errors| errors.to_string())?;
    let sample = |number: usize| {
        let mut scenario = template.scenario(&[]).map_err(|errors| errors.to_string())?.0;
        scenario.requirements.clear();
        scenario.settings.integrator = precess::scenario::IntegratorChoice::Rk4 { step: 1e-3 };
        (scenario.settings.duration, scenario.output.rate) = (DURATION, 1e3);
        #[expect(clippy::cast_precision_loss, reason = "sixteen")]
        let share = number as f64 / SAMPLES as f64;
        scenario.hub.m_b *= 1.0 + 0.01 * share;
        Ok(scenario)
    };
    (0..SAMPLES).map(sample).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let selection = Selection { columns: vec!["omega".to_owned()], lines: 0, from: 0.0 };
    println!("{SIDE_BY_SIDE} side by side, ms a sample of {DURATION} s");
    for name in ["imaging-satellite.toml", "wheel-data-sheet.toml", "bus-three-wheels.toml"] {
        let samples = samples(name)?;
        let mut least = [f64::INFINITY; 2];
        for _ in 0..RUNS {
            for (size, least) in [1, SIDE_BY_SIDE].into_iter().zip(&mut least) {
                let start = Instant::now();
                for group in samples.chunks(size) {
                    for row in run_reduced(group.to_vec(), &selection, &|| false) {
                        row.ok_or("cancelled")??;
                    }
                }
                #[expect(clippy::cast_precision_loss, reason = "sixteen")]
                let each = start.elapsed().as_secs_f64() / SAMPLES as f64;
                *least = least.min(each);
            }
        }
        let [alone, together] = least.map(|time| time * 1e3);
        let ratio = alone / together;
        println!("{name}: {alone:.1} by itself, {together:.1} side by side, {ratio:.2} times less");
    }
    Ok(())
}
