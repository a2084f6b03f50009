//! False alarms and delays of the tests over seeded estimates of blocks, as docs/health.md states them.

use nalgebra::{Matrix2, Vector2};
use precess_control::Noise;

use super::ONSETS;
use super::detector::{Cause, Detector, Kind, LIKELIER, Sample, Shift};
use super::drag::{DragDetector, DragSample};
use super::steps::StepSearch;
use super::thresholds::{DRIFT, Thresholds};

/// As by default: blocks of 2 s, 600 s of reference, one false alarm an hour; of twenty quantities.
const BLOCKS_AN_HOUR: u32 = 1800;
const REFERENCE: u32 = 300;
const QUANTITIES: u32 = 20;

/// When a change begins, blocks.
const ONSET: u32 = REFERENCE + 20;

/// Beyond so many deviations a normal number is once in a thousand.
const RARE: f64 = 3.29;

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

fn thresholds() -> Thresholds {
    let alpha = 1.0 / f64::from(BLOCKS_AN_HOUR) / f64::from(QUANTITIES);
    Thresholds::new(alpha, ONSETS, REFERENCE as usize).unwrap()
}

fn detector() -> Detector {
    Detector::new(Kind::Level, thresholds(), [REFERENCE as usize, ONSETS])
}

fn take(detector: &mut Detector, k: u32, value: f64, signature: f64) -> Option<Shift> {
    let sample = Sample { time: f64::from(k), value, variance: 1.0, signature };
    detector.take(sample).map(|(shift, _)| shift)
}

/// False alarms an hour, of records of ten hours after the reference, each quantity by itself: blocks with this scatter by their stated
/// variance and this correlation.
fn false_alarms(seed: u64, hours: u32, scatter: f64, correlation: f64) -> f64 {
    const LENGTH: u32 = 10;
    let mut draws = Draws::new(seed);
    let mut alarms = 0;
    for _ in 0..hours / LENGTH * QUANTITIES {
        let (mut detector, mut value) = (detector(), 0.0);
        for k in 0..REFERENCE + LENGTH * BLOCKS_AN_HOUR {
            value = correlation * value + (1.0 - correlation * correlation).sqrt() * draws.draw();
            alarms += u32::from(take(&mut detector, k, scatter.sqrt() * value, 0.0).is_some());
        }
    }
    let rate = f64::from(alarms) / f64::from(hours);
    println!(
        "{hours} hours: {rate} false alarms an hour, 1 stated; scatter {scatter}, correlation {correlation}"
    );
    rate
}

/// Of estimates that are more variable than stated, by a scatter that the reference has to tell: as many alarms as stated at most, and not so
/// few that the bounds would be of no use.
#[test]
fn false_alarms_are_no_more_than_stated() {
    let rate = false_alarms(1, 200, 4.0, 0.0);
    assert!((0.2..1.0).contains(&rate), "{rate}");
}

/// Of estimates that are as variable as stated there are fewer: a scatter below one is taken as one.
#[test]
fn estimates_with_the_stated_variance_have_fewer_false_alarms() {
    let rate = false_alarms(6, 40, 1.0, 0.0);
    assert!(rate < 1.0, "{rate}");
}

/// Estimates of neighbouring blocks that are alike do not make false alarms more frequent.
#[test]
fn correlated_blocks_have_no_more_false_alarms_than_stated() {
    let rate = false_alarms(4, 100, 1.0, 0.4);
    assert!(rate < 1.0, "{rate}");
}

/// Blocks from a step of so many deviations to its alarm, to first order: a mean of n is above the bound b of the likelihood ratio when
/// `n d² / (1 + n / N) = b²` against a reference of N, a cumulative sum above h after `h / (d - k)`; what it exceeds h by, 0.583 and half an
/// increment, is Wald's.
fn blocks_to_alarm(step: f64) -> f64 {
    let Thresholds { ratio, sum } = thresholds();
    let (square, reference) = (ratio * ratio, f64::from(REFERENCE));
    let by_ratio = square / (step * step - square / reference);
    let drift = step / (1.0 + 1.0 / reference).sqrt() - DRIFT;
    let by_sum = sum.map_or(f64::INFINITY, |of| (of + 0.583) / drift + 0.5);
    // The first block that is whole.
    by_ratio.min(by_sum).max(1.0)
}

/// Steps of some deviations of a block: the mean delay in blocks is that of the bounds, and how often the interval of the alarm has the step.
#[test]
fn steps_are_found_with_their_size() {
    const RUNS: u32 = 200;
    let mut draws = Draws::new(2);
    for (step, least) in [(1.0, 0.75), (2.0, 0.88), (4.0, 0.88), (8.0, 0.88)] {
        let (mut delay, mut squares, mut covered, mut runs) = (0.0, 0.0, 0, 0);
        while runs < RUNS {
            let mut detector = detector();
            let mut k = 0;
            let found = loop {
                let change = if k < ONSET { 0.0 } else { step };
                if let Some(found) = take(&mut detector, k, draws.draw() + change, 0.0) {
                    break found;
                }
                k += 1;
            };
            // A false alarm before the step is none of these.
            if k >= ONSET {
                let own = f64::from(k + 1 - ONSET);
                runs += 1;
                (delay, squares) = (delay + own, squares + own * own);
                covered += u32::from((found.change - step).abs() < found.half_width);
            }
        }
        let runs = f64::from(runs);
        let (delay, share) = (delay / runs, f64::from(covered) / runs);
        let deviation = ((squares / runs - delay * delay) / runs).sqrt();
        let expected = blocks_to_alarm(step);
        println!(
            "step of {step} deviations: after {delay:.2} blocks, {expected:.2} by the bounds, in its interval in {share:.2} of the cases"
        );
        // Noise makes an alarm earlier or later by up to a block, which is whole.
        assert!((delay - expected).abs() < 1.0 + RARE * deviation, "{step}: {delay}, {expected}");
        assert!(share > least, "{step}: {share}");
    }
}

/// Blocks until a change by one cause has its name but once in a thousand cases: until it is found, and until the other cause, which fits these
/// signatures by its own shape from its likeliest onset on, is less likely by the bound of naming. Squares of ratios without noise; their
/// difference D has a deviation of `2 sqrt(D)`.
fn blocks_to_name(change: f64, by_torque: bool, signature: impl Fn(u32) -> f64) -> u32 {
    let variance = f64::from(REFERENCE).recip();
    let bound = thresholds().ratio;
    let named = |blocks: &u32| {
        let (mut right, mut wrong) = (0.0_f64, 0.0_f64);
        let (mut count, mut first, mut second) = (0.0, 0.0, 0.0);
        for k in (ONSET..ONSET + blocks).rev() {
            let s = signature(k);
            (count, first, second) = (count + 1.0, first + s, second + s * s);
            // The shape of the change is s of a torque constant and 1 of drag: its products with both shapes.
            let [by_one, by_s] = if by_torque { [first, second] } else { [count, first] };
            let drag = by_one * by_one / (count + count * count * variance);
            let torque = by_s * by_s / (second + first * first * variance);
            let [own, other] = if by_torque { [torque, drag] } else { [drag, torque] };
            (right, wrong) = (right.max(own), wrong.max(other));
        }
        let [right, lead] = [right, right - wrong].map(|of| change * change * of);
        // Where the signature is constant both are one.
        let told = lead < 1e-9 || lead - 2.0 * RARE * lead.sqrt() > LIKELIER;
        right.sqrt() - RARE > bound && told
    };
    (1..=200).find(named).expect("a change that is named")
}

/// A torque constant shows by the torque, drag always: each gets its name, after as many blocks as the signature takes. Where the torque
/// does not change they are one.
#[test]
fn a_torque_constant_is_told_from_drag() {
    const CHANGE: f64 = 5.0;
    let mut draws = Draws::new(3);
    for (period, by_torque, expected) in
        [(20.0, true, Cause::Other), (20.0, false, Cause::Own), (f64::INFINITY, true, Cause::Own)]
    {
        let signature = |k: u32| 1.0 + libm::sin(std::f64::consts::TAU * f64::from(k) / period);
        let mut detector = detector();
        let mut names = Vec::new();
        for k in 0..ONSET + 40 {
            let change = CHANGE * if by_torque { signature(k) } else { 1.0 };
            let value = draws.draw() + if k < ONSET { 0.0 } else { change };
            let sample =
                Sample { time: f64::from(k), value, variance: 1.0, signature: signature(k) };
            names.extend(detector.take(sample).map(|(shift, cause)| (k, shift, cause)));
        }
        let (k, shift, cause) = *names.last().expect("an alarm");
        let latest = blocks_to_name(CHANGE, by_torque, signature);
        println!("{expected:?}, within {latest} blocks: {names:?}");
        assert!(names.iter().all(|(k, ..)| *k >= ONSET) && names.len() <= 2, "{names:?}");
        assert_eq!(cause, expected);
        assert!(k < ONSET + latest, "{k}");
        assert!((shift.change - CHANGE).abs() < 2.0 * shift.half_width, "{shift:?}");
    }
}

/// Over blocks of noise, ratios of steps are rarer than those of normal numbers; a step is found with its size at any time in a block; a
/// change of slope is none.
#[test]
fn steps_within_blocks_are_found_and_slopes_are_not() {
    const READINGS: u32 = 96;
    let mut draws = Draws::new(5);
    let mut search = StepSearch::new(0);
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

/// Readings with a mode that is little damped: twelve steps are tried beside a parabola, and ratios are by the scatter that the first blocks have. By
/// that of white noise more of them are large than of normal numbers.
#[test]
fn the_scatter_of_steps_is_learnt() {
    const READINGS: u32 = 96;
    const REFERENCE: u32 = 300;
    const BLOCKS: u32 = 10_000;
    // 3.2 Hz in blocks of 2 s, 0.5 % of critical damping; twice as large as the noise beside it. The variance of an autoregression of order two.
    let turn = std::f64::consts::TAU * 3.2 * 2.0 / f64::from(READINGS);
    let decay = libm::exp(-0.005 * turn);
    let [first, second] = [2.0 * decay * libm::cos(turn), -decay * decay];
    let variance =
        (1.0 - second) / ((1.0 + second) * ((1.0 - second) * (1.0 - second) - first * first));
    let drive = 2.0 / variance.sqrt();
    let mut counts = Vec::new();
    for reference in [0, REFERENCE] {
        let mut draws = Draws::new(8);
        let mut search = StepSearch::new(reference as usize);
        let (mut mode, mut before, mut above) = (0.0, 0.0, 0);
        for block in 0..REFERENCE + BLOCKS {
            for k in 0..READINGS {
                (mode, before) = (first * mode + second * before + drive * draws.draw(), mode);
                search.read((f64::from(k) + 0.5) / f64::from(READINGS), mode + draws.draw());
            }
            let Some([value, variance]) = search.end(1.0, 0.0) else { continue };
            above += u32::from(block >= REFERENCE && value * value > 2.807 * 2.807 * variance);
        }
        counts.push(above);
    }
    println!("of {BLOCKS} blocks {counts:?} above 2.807 deviations: normal 50");
    // One scatter for all twelve times, of a mode whose amplitude hardly changes in some blocks: more than of normal numbers, but few.
    assert!(counts[0] > 1000 && 20 * counts[1] < counts[0], "{counts:?}");
}

/// Blocks of a wheel with white noise of its tachometer; units are chosen so that the drag of a block has a deviation of one, and a second
/// of drag of one changes the rate by one.
struct Wheel {
    draws: Draws,
    rate: f64,
    block: u32,
}

impl Wheel {
    const READINGS: u32 = 100;
    const LENGTH: f64 = 2.0;

    fn new(seed: u64) -> Self {
        Self { draws: Draws::new(seed), rate: 0.0, block: 0 }
    }

    /// The next block, with drag and relative change of the torque constant by the time.
    fn next(&mut self, true_values: impl Fn(f64) -> [f64; 2]) -> DragSample {
        let count = f64::from(Self::READINGS);
        // The slope of a straight line has 12 s^2 / (N T^2).
        let noise = (count * Self::LENGTH * Self::LENGTH / 12.0).sqrt();
        let start = f64::from(self.block) * Self::LENGTH;
        let torque = 20.0 * (1.0 + libm::sin(std::f64::consts::TAU * f64::from(self.block) / 20.0));
        let step = Self::LENGTH / count;
        let (mut sums, mut moments) = (Matrix2::zeros(), Vector2::zeros());
        for k in 0..Self::READINGS {
            let elapsed = (f64::from(k) + 0.5) * step;
            let [drag, constant] = true_values(start + elapsed);
            // The motor's torque in the model is in the prediction.
            let slope = constant * torque - drag;
            let read = self.rate + 0.5 * step * slope + noise * self.draws.draw();
            self.rate += step * slope;
            let row = Vector2::new(1.0, -elapsed);
            sums += row * row.transpose();
            moments += row * read;
        }
        let inverse = sums.try_inverse().expect("a line");
        self.block += 1;
        DragSample {
            times: [start, start + Self::LENGTH],
            continues: true,
            value: inverse * moments,
            covariance: inverse * noise * noise,
            predicted: 0.0,
            added: [-Self::LENGTH, torque * Self::LENGTH],
            seen: [Vector2::y(), Vector2::new(0.0, -torque)],
        }
    }
}

fn drag_detector() -> DragDetector {
    DragDetector::new(thresholds().ratio, [100, ONSETS])
}

/// A drag of one deviation of a block, which estimates of blocks by themselves show after 26 blocks, and a torque constant, each from within a
/// block on: found within five blocks, rightly named, with its size.
#[test]
fn the_rate_of_a_wheel_goes_on_from_block_to_block() {
    for (seed, change, expected) in [
        (11, [1.0, 0.0], Cause::Own),
        (12, [-2.0, 0.0], Cause::Own),
        (13, [0.0, 0.1], Cause::Other),
    ] {
        let (mut wheel, mut detector) = (Wheel::new(seed), drag_detector());
        let onset = 241.1;
        let mut alarms = Vec::new();
        for _ in 0..160 {
            let sample = wheel.next(|time| {
                let [drag, constant] = if time > onset { change } else { [0.0; 2] };
                [3.0 + drag, constant]
            });
            let end = sample.times[1];
            alarms.extend(detector.take(&sample).map(|(shift, cause)| (end, shift, cause)));
        }
        println!("{change:?}: {alarms:?}");
        let Some((first, ..)) = alarms.first() else { panic!("{change:?} is not found") };
        assert!((onset..onset + 10.0).contains(first), "{change:?}: {alarms:?}");
        let (_, shift, cause) = alarms.last().expect("an alarm");
        assert_eq!(*cause, expected);
        let size = change[expected.index()];
        assert!((shift.change - size).abs() < 1.5 * shift.half_width, "{change:?}: {shift:?}");
        assert!(alarms.len() <= 2);
    }
}

/// Over blocks without a change there are no more alarms than the bound is for, and a hundred blocks know the drag to a tenth of the deviation of one.
#[test]
fn the_drag_of_a_wheel_has_no_more_false_alarms_than_stated() {
    const BLOCKS: u32 = 1000;
    const STATED: u32 = 3;
    let alpha = f64::from(STATED) / f64::from(BLOCKS);
    let bound = Thresholds::new(alpha, ONSETS, 100).unwrap().ratio;
    let (mut wheel, mut detector) = (Wheel::new(14), DragDetector::new(bound, [100, ONSETS]));
    let mut alarms = 0;
    for block in 0..BLOCKS {
        alarms += u32::from(detector.take(&wheel.next(|_| [3.0, 0.0])).is_some());
        if block == 100 {
            let [drag, scale] = detector.reference().expect("a reference");
            println!("drag {drag} of 3, scale {scale}");
            assert!((drag - 3.0).abs() < 0.1 && (scale - 1.0).abs() < 0.3, "{drag} {scale}");
        }
    }
    println!("{alarms} alarms in {BLOCKS} blocks, {STATED} stated");
    assert!(alarms <= STATED, "{alarms}");
}
