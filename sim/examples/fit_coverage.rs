//! How often the 95 % intervals of `precess fit` have what was put in: 1000 measurements of one wheel, each
//! with noise and phases of its own, from one seed that was fixed beforehand.
//!
//! ```text
//! cargo run --release -p precess --example fit_coverage -- 1000
//! cargo run --release -p precess --example fit_coverage -- 1000 index
//! cargo run --release -p precess --example fit_coverage -- 1000 drift
//! cargo run --release -p precess --example fit_coverage -- 1000 waterfall
//! cargo run --release -p precess --example fit_coverage -- 1000 overlap
//! cargo run --release -p precess --example fit_coverage -- 1000 quiet
//! ```
//!
//! The wheel, its noise and the forward model are those of `sim/tests/fit`. `index`: with index pulses;
//! `drift`: speeds that drift by 0.1 % within each record and are stated with errors of 0.03 %;
//! `waterfall`: spectra of twelve segments instead of time series; `overlap`: of 23 that overlap by half;
//! `quiet`: of twelve, with half the noise, so that the weakest line is 20 dB above the noise of a segment's bin.
//!
//! Columns: share of the intervals that have the number put in; root mean square and largest of the relative
//! errors; mean error by the mean stated deviation; standard deviation of the estimates by the mean stated
//! one. An interval that misses because of a bias shows in the fourth, one of a wrong width in the fifth.
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
use waterfalls::Averaging;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count = arguments.next().map_or(Ok(1000), |text| text.parse::<usize>())?;
    let found = match arguments.next().as_deref() {
        Some("index") => trials::trials(count, Variant { indexed: true, ..Variant::default() }),
        Some("drift") => {
            trials::trials(count, Variant { indexed: false, drift: 1e-3, speeds: 3e-4 })
        }
        Some("waterfall") => trials::spectra_trials(count, waterfalls::APART),
        Some("overlap") => trials::spectra_trials(count, waterfalls::HALF),
        Some("quiet") => {
            let quiet = Averaging { noise: 0.5, ..waterfalls::APART };
            trials::spectra_trials(count, quiet)
        }
        Some(other) => return Err(format!("no variant `{other}`; see the head of the file").into()),
        None => trials::trials(count, Variant::default()),
    };
    println!("{:36} inside  scatter  largest error   bias  width", "");
    for (k, (name, share)) in trials::coverage(&found).iter().enumerate() {
        let (mut squares, mut most) = (0.0, 0.0_f64);
        let (mut sum, mut sum_of_squares, mut stated) = (0.0, 0.0, 0.0);
        for (_, put_in, estimate) in found.iter().map(|all| &all[k]) {
            let error = estimate.value - put_in;
            squares += (error / put_in).powi(2);
            most = most.max((error / put_in).abs());
            sum += error;
            sum_of_squares += error * error;
            stated += estimate.deviation;
        }
        let count = count as f64;
        let scatter = (squares / count).sqrt();
        let (mean, stated) = (sum / count, stated / count);
        let spread = (sum_of_squares / count - mean * mean).sqrt();
        println!(
            "{name:36} {:5.1} %  {scatter:.1e}  {most:.1e}        {:6.2}  {:5.3}",
            100.0 * share,
            mean / stated,
            spread / stated
        );
    }
    Ok(())
}
