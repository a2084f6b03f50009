//! False alarms and delays of the tests over seeded estimates of blocks, as docs/health.md states them.

use precess_control::Noise;

use super::ONSETS;
use super::detector::{Cause, Detector, Kind, Sample, Shift};
use super::steps::StepSearch;
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

/// A torque constant shows by the torque, drag always: each gets its name, the torque constant after a few blocks at the latest. Where the torque
/// does not change they are one.
#[test]
fn a_torque_constant_is_told_from_drag() {
    let mut draws = Draws::new(3);
    for (period, by_torque, expected) in
        [(20.0, true, Cause::Other), (20.0, false, Cause::Own), (f64::INFINITY, true, Cause::Own)]
    {
        let mut detector = detector();
        let mut names = Vec::new();
        for k in 0..120_u32 {
            let signature = 1.0 + libm::sin(std::f64::consts::TAU * f64::from(k) / period);
            let change = if by_torque { 5.0 * signature } else { 5.0 };
            let value = draws.draw() + if k < 80 { 0.0 } else { change };
            let sample = Sample { time: f64::from(k), value, variance: 1.0, signature };
            names.extend(detector.take(sample).map(|(shift, cause)| (k, shift, cause)));
        }
        let (k, shift, cause) = *names.last().expect("an alarm");
        println!("{expected:?}: {names:?}");
        assert!(names.iter().all(|(k, ..)| *k >= 80) && names.len() <= 2, "{names:?}");
        assert_eq!(cause, expected);
        assert!(k < 95, "{k}");
        assert!((shift.change - 5.0).abs() < 2.0 * shift.half_width, "{shift:?}");
    }
}

/// Estimates of neighbouring blocks that are alike do not make false alarms more frequent.
#[test]
fn correlated_blocks_have_no_more_false_alarms_than_stated() {
    const HOURS: u32 = 200;
    const CORRELATION: f64 = 0.4;
    let mut draws = Draws::new(4);
    let mut alarms = 0;
    for _ in 0..HOURS / 2 * QUANTITIES {
        let (mut detector, mut value) = (detector(), 0.0);
        for k in 0..60 + 2 * BLOCKS_AN_HOUR {
            value = CORRELATION * value + (1.0 - CORRELATION * CORRELATION).sqrt() * draws.draw();
            alarms += u32::from(take(&mut detector, k, value, 0.0).is_some());
        }
    }
    let rate = f64::from(alarms) / f64::from(HOURS);
    println!("{HOURS} hours: {rate} false alarms an hour, 1 stated, correlation {CORRELATION}");
    assert!(rate < 1.0, "{rate}");
}

/// Over blocks of noise, ratios of steps are rarer than those of normal numbers; a step is found with its size at any time in a block; a
/// change of slope is none.
#[test]
fn steps_within_blocks_are_found_and_slopes_are_not() {
    const READINGS: u32 = 96;
    let mut draws = Draws::new(5);
    let mut search = StepSearch::default();
    let mut block = |search: &mut StepSearch, of: &dyn Fn(f64) -> f64| {
        for k in 0..READINGS {
            let share = (f64::from(k) + 0.5) / f64::from(READINGS);
            search.read(share, draws.draw() + of(share));
        }
        search.end(1.0, 0.0)
    };
    let mut above = [0, 0];
    for _ in 0..20_000 {
        let Some([value, variance]) = block(&mut search, &|_| 0.0) else { continue };
        let ratio = value.abs() / variance.sqrt();
        for (count, bound) in above.iter_mut().zip([1.96, 2.807]) {
            *count += u32::from(ratio > bound);
        }
    }
    println!("of 20,000 blocks {above:?} above 1.96 and 2.807 deviations: normal 1000, 100");
    assert!(above[0] < 1000 && above[1] < 100 && above[1] > 10, "{above:?}");
    for at in [0.1, 0.5, 0.8] {
        let _ = block(&mut search, &|_| 0.0);
        let step = |share: f64| if share < at { 0.0 } else { 20.0 };
        let [value, variance] = block(&mut search, &step).expect("a step");
        println!("step of 20 at {at}: {value} in {} deviations", value.abs() / variance.sqrt());
        assert!((value - 20.0).abs() < 3.0 && value * value > 25.0 * variance, "{at}: {value}");
        search.forget();
        let _ = block(&mut search, &|_| 0.0);
        let slope = |share: f64| if share < at { 0.0 } else { 20.0 * (share - at) };
        let [value, variance] = block(&mut search, &slope).expect("an estimate");
        assert!(value * value < 16.0 * variance, "{at}: {value}");
        search.forget();
    }
}
