//! How often the 95 % intervals of `precess fit` have what was put in: 1000 measurements of one wheel, each
//! with noise and phases of its own, from one seed that was fixed beforehand.
//!
//! ```text
//! cargo run --release -p precess --example fit_coverage -- 1000
//! cargo run --release -p precess --example fit_coverage -- 1000 index
//! cargo run --release -p precess --example fit_coverage -- 1000 drift
//! cargo run --release -p precess --example fit_coverage -- 1000 waterfall
//! ```
//!
//! The wheel, its noise and the forward model are those of `sim/tests/fit`. `index`: with index pulses;
//! `drift`: speeds that drift by 0.1 % within each record and are stated with errors of 0.03 %;
//! `waterfall`: spectra of twelve segments instead of time series.
#![expect(
    clippy::cast_precision_loss,
    reason = "counts of samples and trials, and integers of 53 bits"
)]

#[path = "../tests/fit/scene.rs"]
mod scene;
#[path = "../tests/fit/synthetic.rs"]
mod synthetic;
#[path = "../tests/fit/trials.rs"]
mod trials;
#[path = "../tests/fit/waterfalls.rs"]
mod waterfalls;

use scene::Variant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count = arguments.next().map_or(Ok(1000), |text| text.parse::<usize>())?;
    let found = match arguments.next().as_deref() {
        Some("index") => trials::trials(count, Variant { indexed: true, ..Variant::default() }),
        Some("drift") => {
            trials::trials(count, Variant { indexed: false, drift: 1e-3, speeds: 3e-4 })
        }
        Some("waterfall") => trials::spectra_trials(count),
        _ => trials::trials(count, Variant::default()),
    };
    println!("{:36} inside  scatter  largest error", "");
    for (k, (name, share)) in trials::coverage(&found).iter().enumerate() {
        let errors = found.iter().map(|all| all[k].2.value / all[k].1 - 1.0);
        let (mut squares, mut most) = (0.0, 0.0_f64);
        for error in errors {
            squares += error * error;
            most = most.max(error.abs());
        }
        let scatter = (squares / count as f64).sqrt();
        println!("{name:36} {:5.1} %  {scatter:.1e}  {most:.1e}", 100.0 * share);
    }
    Ok(())
}
