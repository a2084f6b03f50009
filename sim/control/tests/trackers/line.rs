//! The line of a rotor: convergence, forgetting, variance, speeds that change, folded lines, a rotor that stands.

use precess_control::{LineEstimate, LineTracker};

use crate::draws::{Draws, agrees, variance};

/// Angle of the rotor from sample to sample, rad: no simple part of a turn.
const STEP: f64 = 2.1;

const MEAN: f64 = -0.4;
const AMPLITUDE: f64 = 3e-3;
const PHASE: f64 = 0.7;

fn signal(angle: f64, gain: f64) -> f64 {
    MEAN + gain * AMPLITUDE * (angle + PHASE).cos()
}

fn near(found: &LineEstimate, tolerance: f64) -> bool {
    (found.mean - MEAN).abs() < tolerance
        && (found.amplitude - AMPLITUDE).abs() < tolerance
        && (found.phase - PHASE).abs() < tolerance / AMPLITUDE
}

/// Without noise a fourth sample gives the truth to rounding, and later ones keep it.
#[test]
fn a_line_without_noise_is_found_from_four_samples() {
    let mut tracker = LineTracker::new(100.0).unwrap();
    for k in 0..2000 {
        let angle = STEP * f64::from(k);
        tracker.update(angle, 1.0, signal(angle, 1.0)).unwrap();
        let found = tracker.estimate();
        match found {
            None => assert!(k < 3, "sample {k}"),
            Some(found) => assert!(k >= 3 && near(&found, 1e-13), "sample {k}: {found:?}"),
        }
    }
}

/// With the gain that the line has, it is the same while the speed changes.
#[test]
fn a_line_by_its_gain_does_not_depend_on_the_speed() {
    let mut tracker = LineTracker::new(50.0).unwrap();
    let (mut angle, period) = (0.0, 0.01);
    for k in 0..3000 {
        let rate = 20.0 + 0.05 * f64::from(k);
        angle += rate * period;
        tracker.update(angle, rate * rate, signal(angle, rate * rate)).unwrap();
    }
    let found = tracker.estimate().unwrap();
    assert!(near(&found, 1e-12), "{found:?}");
}

/// A line above half the sampling rate is followed by the angle as others are.
#[test]
fn a_folded_line_is_followed_by_the_angle() {
    let mut tracker = LineTracker::new(100.0).unwrap();
    for k in 0..500 {
        let angle = (STEP + 3.0 * std::f64::consts::TAU) * f64::from(k);
        tracker.update(angle, 1.0, signal(angle, 1.0)).unwrap();
    }
    assert!(near(&tracker.estimate().unwrap(), 1e-11));
}

/// Of an imbalance that changes at once, the old one has the weight of its samples: exactly, since the estimate is linear.
#[test]
fn a_change_is_followed_with_the_memory() {
    const MEMORY: f64 = 400.0;
    let mut tracker = LineTracker::new(MEMORY).unwrap();
    let before = 40_000;
    let after = 800;
    for k in 0..before + after {
        let angle = STEP * f64::from(k);
        let amplitude = if k < before { 1.0 } else { 3.0 };
        tracker.update(angle, 1.0, amplitude * angle.cos()).unwrap();
    }
    let weight = (1.0 - 1.0 / MEMORY).powi(after);
    let expected = 3.0 - 2.0 * weight;
    let found = tracker.estimate().unwrap();
    // Sums of cosines over the samples are zero to about a sample in the memory.
    assert!((found.parts[0] - expected).abs() < 2.0 / MEMORY, "{found:?}, expected {expected}");
}

/// Of white noise the variance of the parts is `2 s² (1 - w) / (1 + w)`, and what the tracker states.
#[test]
fn the_variance_of_a_line_is_that_of_theory() {
    const MEMORY: f64 = 60.0;
    const NOISE: f64 = 2e-3;
    const RUNS: usize = 2000;
    let mut draws = Draws::new(1);
    let (mut parts, mut stated, mut noise) = (Vec::new(), Vec::new(), Vec::new());
    let mut tracker = LineTracker::new(MEMORY).unwrap();
    for k in 0..=u32::try_from(RUNS).unwrap() * 600 {
        let angle = STEP * f64::from(k);
        let y = signal(angle, 1.0) + NOISE * draws.draw();
        tracker.update(angle, 1.0, y).unwrap();
        // Ten memories apart estimates are independent.
        if k > 0 && k % 600 == 0 {
            let found = tracker.estimate().unwrap();
            parts.push(found.parts);
            stated.push(found.covariance);
            noise.push(found.noise * found.noise);
        }
    }
    let w = 1.0 - 1.0 / MEMORY;
    let expected = 2.0 * NOISE * NOISE * (1.0 - w) / (1.0 + w);
    let truth = [AMPLITUDE * PHASE.cos(), -AMPLITUDE * PHASE.sin()];
    #[expect(clippy::cast_precision_loss, reason = "two thousand")]
    let runs = RUNS as f64;
    for (index, truth) in truth.into_iter().enumerate() {
        let values: Vec<f64> = parts.iter().map(|parts| parts[index]).collect();
        let found = variance(&values, truth);
        println!("part {index}: variance {found:.4e}, theory {expected:.4e}");
        assert!(agrees(found, expected, RUNS), "{found:e}, {expected:e}");
        let mean = values.iter().sum::<f64>() / runs;
        assert!((mean - truth).abs() < 4.0 * (expected / runs).sqrt(), "{mean}");
        let mean = stated.iter().map(|of| of[index]).sum::<f64>() / runs;
        // The factor depends on the angles of the last samples by a few parts in a memory.
        assert!((mean / expected - 1.0).abs() < 0.05, "{mean:e}, {expected:e}");
    }
    // Unbiased, its own scatter 2 / (1 + w) by 60 samples: 0.4 % over the runs.
    let mean = noise.iter().sum::<f64>() / runs;
    assert!((mean / (NOISE * NOISE) - 1.0).abs() < 0.02, "{mean:e}");
}

/// A rotor that stands determines nothing and leaves nothing behind: once it turns, the line is there after as many samples
/// as at the start, to rounding.
#[test]
fn a_rotor_that_stands_gives_no_line_and_spoils_none() {
    let mut tracker = LineTracker::new(20.0).unwrap();
    for _ in 0..100_000 {
        tracker.update(1.0, 1.0, signal(1.0, 1.0)).unwrap();
        assert_eq!(tracker.estimate(), None);
    }
    for k in 1..40 {
        let angle = 1.0 + STEP * f64::from(k);
        tracker.update(angle, 1.0, signal(angle, 1.0)).unwrap();
    }
    assert!(near(&tracker.estimate().unwrap(), 1e-12));
}

/// And one that stops keeps its line no longer than the samples that showed it count.
#[test]
fn a_rotor_that_stops_has_no_line_in_the_end() {
    let mut tracker = LineTracker::new(20.0).unwrap();
    for k in 0..200 {
        let angle = STEP * f64::from(k);
        tracker.update(angle, 1.0, signal(angle, 1.0)).unwrap();
    }
    assert!(tracker.estimate().is_some());
    for _ in 0..2000 {
        tracker.update(0.3, 1.0, signal(0.3, 1.0)).unwrap();
    }
    assert_eq!(tracker.estimate(), None);
}

/// A line at half the sampling rate is its mean and one part: it is not told apart.
#[test]
fn a_line_at_half_the_sampling_rate_is_not_determined() {
    let mut tracker = LineTracker::new(20.0).unwrap();
    for k in 0..200 {
        let angle = std::f64::consts::PI * f64::from(k);
        tracker.update(angle, 1.0, signal(angle, 1.0)).unwrap();
    }
    assert_eq!(tracker.estimate(), None);
}
