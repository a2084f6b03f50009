//! The drag of a rotor: convergence while the motor works, variance, a speed that changes, no drag.

use precess_control::{DragSample, DragTracker};

use crate::draws::{Draws, agrees, variance};

const INERTIA: f64 = 0.0191;
const PERIOD: f64 = 0.01;

/// A rotor with Coulomb and viscous drag, of which so many times as much acts as is expected, under a motor that reverses
/// slowly: exact steps, since torques are held.
struct Rotor {
    rate: f64,
    time: f64,
}

impl Rotor {
    fn drag(&self) -> f64 {
        2e-3 * self.rate.signum() + 1e-5 * self.rate
    }

    fn step(&mut self, coefficient: f64) -> DragSample {
        let torque = 5e-3 + 0.02 * (0.3 * self.time).sin();
        let drag = self.drag();
        self.rate += (torque - coefficient * drag) * PERIOD / INERTIA;
        self.time += PERIOD;
        DragSample { elapsed: PERIOD, torque, drag, rate: self.rate }
    }
}

#[test]
fn a_drag_without_noise_is_found_while_the_motor_works() {
    let mut rotor = Rotor { rate: 300.0, time: 0.0 };
    let mut tracker = DragTracker::new(INERTIA, 100.0).unwrap();
    for k in 0..20_000 {
        tracker.update(&rotor.step(1.3)).unwrap();
        if k > 2 {
            let found = tracker.estimate().unwrap();
            let error = (found.coefficient - 1.3).abs();
            // Momentum to 1e-16, by a drag that changes it by 1e-5 of itself a sample.
            assert!(error < if k < 10 { 1e-8 } else { 1e-10 }, "sample {k}: {found:?}");
            assert!((found.rate - rotor.rate).abs() < 1e-10);
        }
    }
}

/// After a change the old coefficient is forgotten: by its weight in a line that is fitted with exponential weights.
#[test]
fn a_change_of_drag_is_followed_with_the_memory() {
    const MEMORY: f64 = 400.0;
    let mut rotor = Rotor { rate: 300.0, time: 0.0 };
    let mut tracker = DragTracker::new(INERTIA, MEMORY).unwrap();
    for _ in 0..20_000 {
        tracker.update(&rotor.step(1.0)).unwrap();
    }
    for _ in 0..20 * 400 {
        tracker.update(&rotor.step(1.5)).unwrap();
    }
    let found = tracker.estimate().unwrap();
    // exp(-20) of the change, by up to 20 times as many samples as the memory has.
    assert!((found.coefficient - 1.5).abs() < 0.5 * 400.0 * (-20.0_f64).exp(), "{found:?}");
}

/// Of white noise of the tachometer the variance is that of the slope of exponential smoothing of a trend (Brown 1962):
/// `2 s² (1 - w)^3 / (1 + w)^3` by the square of what the drag changes a sample.
#[test]
fn the_variance_of_a_drag_is_that_of_theory() {
    const MEMORY: f64 = 60.0;
    const NOISE: f64 = 0.05;
    const DRAG: f64 = 4e-3;
    const RUNS: usize = 2000;
    let mut draws = Draws::new(2);
    let mut tracker = DragTracker::new(INERTIA, MEMORY).unwrap();
    let [mut coefficients, mut stated] = [const { Vec::new() }; 2];
    for k in 0..=u32::try_from(RUNS).unwrap() * 900 {
        // The motor holds the speed.
        let rate = 300.0 + NOISE * draws.draw();
        tracker.update(&DragSample { elapsed: PERIOD, torque: DRAG, drag: DRAG, rate }).unwrap();
        if k > 0 && k % 900 == 0 {
            let found = tracker.estimate().unwrap();
            coefficients.push(found.coefficient);
            stated.push(found.variance);
        }
    }
    let w = 1.0 - 1.0 / MEMORY;
    let slope = DRAG * PERIOD / INERTIA;
    let expected =
        2.0 * (NOISE * (1.0 - w)).powi(2) * (1.0 - w) / (1.0 + w).powi(3) / slope.powi(2);
    let found = variance(&coefficients, 1.0);
    println!("variance {found:.4e}, theory {expected:.4e}");
    assert!(agrees(found, expected, RUNS), "{found:e}, {expected:e}");
    #[expect(clippy::cast_precision_loss, reason = "two thousand")]
    let mean = stated.iter().sum::<f64>() / RUNS as f64;
    assert!((mean / expected - 1.0).abs() < 0.02, "{mean:e}, {expected:e}");
}

#[test]
fn no_expected_drag_gives_no_coefficient() {
    let mut tracker = DragTracker::new(INERTIA, 20.0).unwrap();
    for _ in 0..100 {
        tracker.update(&DragSample { elapsed: PERIOD, torque: 0.0, drag: 0.0, rate: 1.0 }).unwrap();
    }
    assert_eq!(tracker.estimate(), None);
}
