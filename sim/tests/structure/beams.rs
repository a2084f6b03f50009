//! A cantilever, with a wheel at its tip, against its closed receptance and against its modes solved at once.

use std::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector, Unit, Vector3};
use precess::structure::accelerance::{Accelerance, Base, ComplexMatrix, complex};
use precess::structure::dynamic_mass::{Motor, Wheel};
use precess::structure::mounted::{mounted_force, transmission, without_mass};
use precess::structure::{Mode, Node, Structure};

use super::{ROUNDING, structure};

const I: Complex<f64> = Complex::new(0.0, 1.0);

/// A beam of length L, m, along x, of mass rho A, kg/m, and bending stiffness E I, N m², in both planes.
pub(crate) const LENGTH: f64 = 1.6;

pub(crate) const RHO_A: f64 = 2.5;

pub(crate) const EI: f64 = 900.0;

/// Solutions `beta L` of `cos(x) = sign / cosh(x)`: clamped and free -1, free and free +1, the k-th from 1.
pub(crate) fn root(k: usize, sign: f64) -> f64 {
    let start = if sign < 0.0 { k as f64 - 0.5 } else { k as f64 + 0.5 };
    let mut x = start * PI;
    for _ in 0..50 {
        let value = x.cos() - sign / x.cosh();
        let slope = -x.sin() + sign * x.sinh() / (x.cosh() * x.cosh());
        x -= value / slope;
    }
    x
}

/// The cantilever's tip, with the first modes of both planes: in z turning about y, in y turning about z.
fn cantilever(count: usize, damping: f64) -> Structure {
    let mut shapes = DMatrix::zeros(6, 2 * count);
    let mut modes = Vec::new();
    for k in 1..=count {
        let x = root(k, -1.0);
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        let norm = (RHO_A * LENGTH).sqrt();
        // phi(L) = 2 (-1)^(k+1); phi'(L) L = 2 x (tanh cos + sin) / (1 + cos / cosh).
        let shape = 2.0 * sign / norm;
        let slope = 2.0 * x * (x.tanh() * x.cos() + x.sin()) / (1.0 + x.cos() / x.cosh());
        let slope = slope / (norm * LENGTH);
        let column = 2 * (k - 1);
        shapes[(2, column)] = shape;
        shapes[(4, column)] = -slope;
        shapes[(1, column + 1)] = shape;
        shapes[(5, column + 1)] = slope;
        let frequency = (x / LENGTH).powi(2) * (EI / RHO_A).sqrt();
        let (linear, angular) = (Vector3::zeros(), Vector3::zeros());
        modes.extend([Mode { frequency, damping, linear, angular }; 2]);
    }
    let tip = Node { name: "tip".into(), position: Vector3::new(LENGTH, 0.0, 0.0) };
    structure(vec![tip], modes, shapes)
}

/// Deflection and slope of the tip by force and moment, closed (Bishop and Johnson); static at zero.
fn receptance(frequency: f64) -> [f64; 3] {
    if frequency == 0.0 {
        return [LENGTH.powi(3) / (3.0 * EI), LENGTH.powi(2) / (2.0 * EI), LENGTH / EI];
    }
    let beta = (RHO_A * frequency * frequency / EI).powf(0.25);
    let x = beta * LENGTH;
    let [s, c, sh, ch] = [x.sin(), x.cos(), x.sinh(), x.cosh()];
    let determinant = EI * (1.0 + c * ch);
    [
        (s * ch - c * sh) / (beta.powi(3) * determinant),
        s * sh / (beta.powi(2) * determinant),
        (c * sh + s * ch) / (beta * determinant),
    ]
}

/// The 6 × 6 flexibility of the tip by those of one plane.
fn of_planes([force, mixed, moment]: [f64; 3]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(6, 6);
    matrix[(2, 2)] = force;
    matrix[(1, 1)] = force;
    matrix[(4, 4)] = moment;
    matrix[(5, 5)] = moment;
    for (place, sign) in [((2, 4), -1.0), ((1, 5), 1.0)] {
        matrix[place] = sign * mixed;
        matrix[(place.1, place.0)] = sign * mixed;
    }
    matrix
}

fn at_tip(structure: &Structure, frequency: f64) -> ComplexMatrix {
    let accelerance = Accelerance::new(structure, Base::Fixed, &[0], &[0]).expect("a node");
    accelerance.at(frequency).expect("off resonance")
}

/// A wheel at the tip, its axis tilted, its centre off the node.
fn tip_wheel() -> Wheel {
    Wheel {
        mass: 0.8,
        place: Vector3::new(0.05, 0.02, -0.01),
        axis: Unit::new_normalize(Vector3::new(1.0, 0.3, -0.2)),
        spin_inertia: 0.004,
        transverse_inertia: 0.0025,
        rate: 300.0,
        motor: Motor::ConstantTorque,
        housing: None,
        periodic: [0.0; 2],
    }
}

/// Rates of the errors of a truncated sum when the number of modes doubles: exponents for deflection by force,
/// slope by force, slope by moment. Terms fall as n^-4, n^-3, n^-2; with residual flexibility by n^-4 more.
const ORDERS: [f64; 3] = [3.0, 2.0, 1.0];

const ORDERS_WITH_RESIDUAL: [f64; 3] = [7.0, 6.0, 5.0];

/// The exponent between two finite sums is not yet that of the limit: 2 % off between 4 and 8 modes.
const ORDER_MISS: f64 = 0.025;

#[test]
fn the_modal_sum_converges_to_the_closed_receptance_at_the_theoretical_rate() {
    let frequency = 60.0;
    let exact = receptance(frequency).map(|value| -frequency * frequency * value);
    let places = [(2, 2), (1, 5), (4, 4)];
    for (with_residual, orders) in [(false, ORDERS), (true, ORDERS_WITH_RESIDUAL)] {
        let errors = |count: usize| {
            let mut beam = cantilever(count, 0.0);
            if with_residual {
                let mut own = beam.shapes.clone();
                for (mut column, mode) in own.column_iter_mut().zip(&beam.modes) {
                    column /= mode.frequency * mode.frequency;
                }
                let rest = of_planes(receptance(0.0)) - own * beam.shapes.transpose();
                beam.residual = Some(rest);
            }
            let found = at_tip(&beam, frequency);
            let difference = |k: usize| (found[places[k]].re - exact[k]).abs();
            [difference(0), difference(1), difference(2)]
        };
        // With residual flexibility sixteen modes reach rounding: fewer are compared.
        let counts = if with_residual { [4, 8] } else { [16, 32] };
        let [few, many] = counts.map(errors);
        for k in 0..3 {
            let ratio = (counts[1] as f64) / (counts[0] as f64);
            let order = (few[k] / many[k]).ln() / ratio.ln();
            let miss = (order - orders[k]).abs() / orders[k];
            assert!(miss < ORDER_MISS, "{with_residual} {k}: order {order}, {few:?} {many:?}");
        }
    }
}

#[test]
fn a_spinning_wheel_at_the_tip_is_that_of_the_same_modes_solved_at_once() {
    let (beam, wheel) = (cantilever(12, 0.004), tip_wheel());
    let blocked = DVector::from_fn(6, |row, _| Complex::new(row as f64 - 2.0, 0.5 * row as f64));
    for frequency in [11.0, 60.0, 300.0, 1500.0] {
        let mass = wheel.dynamic_mass(frequency).expect("above zero");
        let own = at_tip(&beam, frequency);
        // (K + i w C - w^2 (1 + Phi^T M Phi)) eta = Phi^T F_b;  F = F_b + w^2 M Phi eta
        let shapes = complex(&beam.shapes);
        let mut left = -(shapes.transpose() * &mass * &shapes);
        for k in 0..beam.modes.len() {
            left[(k, k)] -= 1.0;
        }
        left *= Complex::new(frequency * frequency, 0.0);
        for (k, mode) in beam.modes.iter().enumerate() {
            left[(k, k)] += mode.frequency * (mode.frequency + 2.0 * I * mode.damping * frequency);
        }
        let eta = left.lu().solve(&(shapes.transpose() * &blocked)).expect("damped");
        let moved = &shapes * eta * Complex::new(-frequency * frequency, 0.0);
        let wanted = &blocked - &mass * &moved;
        let found = mounted_force(&mass, &own, &blocked, frequency).expect("damped");
        let error = (&found - &wanted).norm() / wanted.norm();
        assert!(error < ROUNDING, "{frequency}: {error:e}");
        let error = (&own * found - &moved).norm() / moved.norm();
        assert!(error < ROUNDING, "{frequency}: {error:e}");
    }
}

#[test]
fn with_the_wheel_the_sum_converges_to_the_closed_receptance_too() {
    let (wheel, frequency) = (tip_wheel(), 60.0);
    let mass = wheel.dynamic_mass(frequency).expect("above zero");
    let exact = complex(&(of_planes(receptance(frequency)) * (-frequency * frequency)));
    let combined = |own: &ComplexMatrix| own * transmission(&mass, own, frequency).expect("finite");
    let exact = combined(&exact);
    let error = |count| (combined(&at_tip(&cantilever(count, 0.0), frequency)) - &exact).norm();
    // The slowest of the three rates: slope by moment, 1/n.
    let order = (error(16) / error(32)).log2();
    assert!((order - 1.0).abs() < ORDER_MISS, "{order}");
}

#[test]
fn a_wheel_that_the_model_contains_is_taken_off() {
    let (beam, wheel, frequency) = (cantilever(6, 0.01), tip_wheel(), 60.0);
    let rigid = Wheel { rate: 0.0, motor: Motor::ConstantRate, ..wheel };
    let mass = rigid.dynamic_mass(frequency).expect("above zero");
    let bare = at_tip(&beam, frequency);
    let with = &bare * transmission(&mass, &bare, frequency).expect("finite");
    let again = without_mass(&with, &mass, frequency).expect("finite");
    assert!((again - &bare).norm() < ROUNDING * bare.norm());
}
