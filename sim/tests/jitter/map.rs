//! docs/imbalance-map.md and its picture are fresh, and three of its cells are those of formulas by hand.

use std::path::Path;

use nalgebra::Complex;

use super::page as map;
use super::picture;

/// What a rigid hub of 1e6 kg and the imbalance in the mass matrix leave of the formulas.
const NEAR: f64 = 1e-5;

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_page_and_its_picture_are_fresh() {
    let page = map::page().expect("every cell");
    let picture = picture::picture().expect("every cell");
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    for (name, made) in [("imbalance-map.md", page), ("imbalance-map.svg", picture)] {
        let text = std::fs::read_to_string(docs.join(name)).unwrap_or_default();
        assert!(
            text == made,
            "{name} is stale; write it by `cargo run --release -p precess --example imbalance_map`"
        );
    }
}

#[test]
fn a_moment_that_turns_with_the_rotor_feels_its_momentum_as_inertia() {
    for ratio in [0.01, 0.3] {
        let expected = map::SPIN / (map::SPIN / ratio + map::ACROSS);
        let found = map::by_inertia(ratio).expect("a cell");
        assert!((found / expected - 1.0).abs() < NEAR, "{ratio}: {found} for {expected}");
        assert!(map::by_mass(ratio).expect("a cell") < 1e-9);
    }
}

#[test]
fn a_bracket_has_its_peak_at_the_forward_whirl() {
    let (ratio, share) = (0.9, 0.1);
    let inertia = share / (1.0 - share);
    let (natural, speed) = (300.0 * (1.0_f64 + inertia).sqrt(), 300.0 * ratio);
    let stiffness = |modal: f64| {
        let c = 2.0 * map::DAMPING * natural;
        Complex::new(natural * natural - modal * speed * speed, c * speed)
    };
    let coupled = stiffness(1.0 + inertia * (1.0 - map::SPIN / map::ACROSS)).inv();
    let usual = stiffness(1.0 + inertia).inv();
    let expected = (coupled - usual).norm() / coupled.norm();
    let found = map::by_speed(ratio, share).expect("a cell");
    // The hub moves with the wheel by 1e-8.
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} for {expected}");
}

#[test]
fn a_gimbal_that_turns_adds_the_force_of_coriolis() {
    let ratio: f64 = 0.05;
    // In units of d Omega^2, over a turn: the acceleration is (2 g sin, -(1 + g^2) cos, -sin), the usual one
    // (0, -cos, -sin); mean squares of sines are one half.
    let apart = 0.5 * (4.0 * ratio * ratio + ratio.powi(4));
    let whole = 0.5 * (4.0 * ratio * ratio + (1.0 + ratio * ratio).powi(2) + 1.0);
    let expected = (apart / whole).sqrt();
    let found = map::by_gimbal(ratio).expect("a cell");
    assert!((found / expected - 1.0).abs() < NEAR, "{found} for {expected}");
}
