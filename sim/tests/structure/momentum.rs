//! Momentum of modes: a free beam, which is a rigid body at low frequency; a mode that carries momentum.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess::structure::accelerance::{Accelerance, Base, complex};
use precess::structure::{Mode, Node, RigidMass, Structure};

use super::beams::{EI, LENGTH, RHO_A, root};
use super::{ROUNDING, structure};

/// The free beam in z, from its middle B, with its analytic modes at its ends.
fn free_beam(count: usize) -> Structure {
    let norm = (RHO_A * LENGTH).sqrt();
    let mut shapes = DMatrix::zeros(12, count);
    let mut modes = Vec::new();
    for k in 1..=count {
        let x = root(k, 1.0);
        // Odd modes are symmetric about the middle.
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        let sigma = (1.0 - x.cos() / x.cosh()) / (x.tanh() - x.sin() / x.cosh());
        // phi = cosh + cos - sigma (sinh + sin): phi(0) = 2, phi'(0) = -2 sigma beta.
        shapes[(2, k - 1)] = 2.0 / norm;
        shapes[(4, k - 1)] = 2.0 * sigma * x / (LENGTH * norm);
        shapes[(8, k - 1)] = 2.0 * sign / norm;
        shapes[(10, k - 1)] = -2.0 * sign * sigma * x / (LENGTH * norm);
        let frequency = (x / LENGTH).powi(2) * (EI / RHO_A).sqrt();
        let (linear, angular) = (Vector3::zeros(), Vector3::zeros());
        modes.push(Mode { frequency, damping: 0.0, linear, angular });
    }
    let node = |name: &str, x: f64| Node { name: name.into(), position: Vector3::new(x, 0.0, 0.0) };
    let mut beam =
        structure(vec![node("left", -0.5 * LENGTH), node("right", 0.5 * LENGTH)], modes, shapes);
    let mass = RHO_A * LENGTH;
    let across = mass * LENGTH * LENGTH / 12.0;
    let inertia = Matrix3::from_diagonal(&Vector3::new(1e-3, across, across));
    beam.mass = Some(RigidMass::about_centre(mass, Vector3::zeros(), inertia));
    beam
}

/// Integrals of a mode and of x times it over the free beam, of 2 sqrt(mass) and half the length: Simpson's rule.
fn momenta(k: usize) -> [f64; 2] {
    const PARTS: usize = 20_000;
    let x = root(k, 1.0);
    let sigma = (1.0 - x.cos() / x.cosh()) / (x.tanh() - x.sin() / x.cosh());
    let phi = |s: f64| (x * s).cosh() + (x * s).cos() - sigma * ((x * s).sinh() + (x * s).sin());
    let mut sums = [0.0; 2];
    for part in 0..=PARTS {
        let s = part as f64 / PARTS as f64;
        let weight = match part {
            0 | PARTS => 1.0,
            part if part % 2 == 1 => 4.0,
            _ => 2.0,
        };
        sums[0] += weight * phi(s);
        sums[1] += weight * phi(s) * (2.0 * s - 1.0);
    }
    sums.map(|sum| sum / (3.0 * PARTS as f64) / 2.0)
}

#[test]
fn modes_of_a_free_beam_carry_no_momentum_and_it_is_rigid_at_low_frequency() {
    for k in 1..=4 {
        // Simpson's rule has an error of (x/20000)^4; cosh(14) costs six digits.
        assert!(momenta(k).iter().all(|value| value.abs() < 1e-10), "{k}: {:?}", momenta(k));
    }
    let beam = free_beam(4);
    assert!(beam.is_free());
    let first = beam.modes[0].frequency;
    let mass = beam.mass.expect("given").matrix();
    let rigid = beam.rigid_shapes();
    let inverse = mass.try_inverse().expect("positive definite");
    let inverse = DMatrix::from_column_slice(6, 6, inverse.as_slice());
    let wanted = complex(&(&rigid * inverse * rigid.transpose()));
    let accelerance = Accelerance::new(&beam, Base::Free, &[0, 1], &[0, 1]).expect("two nodes");
    assert!((accelerance.at(0.0).expect("finite") - &wanted).norm() < 1e-14 * wanted.norm());
    let error = |share: f64| (accelerance.at(share * first).expect("finite") - &wanted).norm();
    // The modal sum rises with the square of the frequency, up to (w/w_1)^2 of itself.
    let order = (error(2e-3) / error(1e-3)).log2();
    assert!((order - 2.0).abs() < 1e-4, "{order}");
    assert!(error(1e-3) < 1e-4 * wanted.norm());
}

#[test]
fn modes_with_momentum_are_those_of_the_free_modes_of_the_same_structure() {
    // A point mass on a spring, in z, beside B: held at B it is one mode with P = sqrt(m); free it is
    // one of reduced mass, with no momentum.
    let [hub, mass, stiffness] = [7.0, 3.0, 1000.0_f64];
    let node = |name: &str| Node { name: name.into(), position: Vector3::zeros() };
    let held = Mode {
        frequency: (stiffness / mass).sqrt(),
        damping: 0.0,
        linear: Vector3::new(0.0, 0.0, mass.sqrt()),
        angular: Vector3::zeros(),
    };
    let mut shapes = DMatrix::zeros(12, 1);
    shapes[(8, 0)] = mass.sqrt().recip();
    let mut first = structure(vec![node("hub"), node("mass")], vec![held], shapes);
    let inertia = Matrix3::identity();
    first.mass = Some(RigidMass::about_centre(hub + mass, Vector3::zeros(), inertia));
    let accelerance = Accelerance::new(&first, Base::Free, &[0, 1], &[0, 1]).expect("two nodes");
    for frequency in [3.0, 17.0, 40.0_f64] {
        let found = accelerance.at(frequency).expect("off resonance");
        let w2 = frequency * frequency;
        // [k - hub w^2, -k; -k, k - mass w^2] x = f
        let dynamic = nalgebra::Matrix2::new(
            stiffness - hub * w2,
            -stiffness,
            -stiffness,
            stiffness - mass * w2,
        );
        let wanted = dynamic.try_inverse().expect("off resonance") * -w2;
        for (row, i) in [2, 8].into_iter().enumerate() {
            for (column, j) in [2, 8].into_iter().enumerate() {
                let error = (found[(i, j)].re - wanted[(row, column)]).abs();
                assert!(error < ROUNDING * wanted.norm(), "{frequency} {i} {j}: {error:e}");
            }
        }
    }
}
