//! False alarms and delays of the tests over seeded estimates of blocks, as docs/health.md states them.

use precess_control::Noise;

use super::ONSETS;
use super::detector::{Detector, Kind, Sample, Shift};
use super::thresholds::Thresholds;

/// As by default: blocks of 10 s, 600 s of reference, one false alarm an hour; of twenty quantities.
const BLOCKS_AN_HOUR: u32 = 360;
const REFERENCE: usize = 60;
const QUANTITIES: u32 = 20;

struct Draws {
    noise: Noise,
    next: u64,
}

impl Draws {
    fn new(seed: u64) -> Self {
        Self { noise: Noise::new(seed, "blocks"), next: 0 }
    }

    fn draw(&mut self) -> f64 {
        let [value, ..] = self.noise.at(self.next);
        self.next += 1;
        value
    }
}

fn detector() -> Detector {
    let alpha = 1.0 / f64::from(BLOCKS_AN_HOUR) / f64::from(QUANTITIES);
    let thresholds = Thresholds::new(alpha, ONSETS, REFERENCE).unwrap();
    Detector::new(Kind::Level, thresholds, [REFERENCE, ONSETS])
}

fn take(detector: &mut Detector, k: u32, value: f64, signature: f64) -> Option<Shift> {
    let sample = Sample { time: f64::from(k), value, variance: 1.0, signature };
    detector.take(sample).map(|(shift, _)| shift)
}

/// Records of two hours after the reference, each quantity by itself: as many alarms as stated at most, and not so few that the bounds
/// would be of no use.
#[test]
fn false_alarms_are_no_more_than_stated() {
    const HOURS: u32 = 200;
    let mut draws = Draws::new(1);
    let mut alarms = 0;
    for _ in 0..HOURS / 2 * QUANTITIES {
        let mut detector = detector();
        for k in 0..60 + 2 * BLOCKS_AN_HOUR {
            alarms += u32::from(take(&mut detector, k, draws.draw(), 0.0).is_some());
        }
    }
    let rate = f64::from(alarms) / f64::from(HOURS);
    println!("{HOURS} hours: {rate} false alarms an hour, 1 stated");
    assert!((0.2..1.0).contains(&rate), "{rate}");
}

/// Steps of some deviations of a block: the mean delay in blocks, and how often the interval of the alarm has the step.
#[test]
fn steps_are_found_with_their_size() {
    const RUNS: u32 = 200;
    let mut draws = Draws::new(2);
    for (step, latest, least) in
        [(1.0, 40.0, 0.75), (2.0, 8.0, 0.88), (4.0, 2.5, 0.88), (8.0, 1.2, 0.88)]
    {
        let (mut delay, mut covered, mut runs) = (0, 0, 0);
        while runs < RUNS {
            let mut detector = detector();
            let mut k = 0;
            let found = loop {
                let change = if k < 80 { 0.0 } else { step };
                if let Some(found) = take(&mut detector, k, draws.draw() + change, 0.0) {
                    break found;
                }
                k += 1;
            };
            // A false alarm before the step is none of these.
            if k >= 80 {
                runs += 1;
                delay += k - 79;
                covered += u32::from((found.change - step).abs() < found.half_width);
            }
        }
        let (delay, share) =
            (f64::from(delay) / f64::from(RUNS), f64::from(covered) / f64::from(RUNS));
        println!(
            "step of {step} deviations: after {delay:.2} blocks, in its interval in {share:.2} of the cases"
        );
        assert!(delay < latest && share > least, "{step}: {delay}, {share}");
    }
}
