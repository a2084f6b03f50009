//! Products of derivatives with a direction and with weights against the matrices, and against each other.

use nalgebra::{DMatrix, DVector, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, Accelerations, DerivativeError, Gravity, HubMode, Inputs, Mode, Outputs, Spacecraft,
};
use precess_tests::random::Random;

use crate::draw::{Case, Drawn, List, SEED};

/// How many spacecraft.
const SPACECRAFT: u64 = 200;
/// Of the sum of the magnitudes of the products' terms: matrices and products round elsewhere, each as the derivatives
/// do, which differ from dual numbers by up to 1e-11 of a block.
const ROUNDING: f64 = 1e-11;
/// The same of the matrices by dual numbers, in which other terms cancel: 2e-10 at worst, by weights.
const DUAL: f64 = 1e-9;

/// Without what has no emitted derivatives, but for every fourth.
fn drawn(seed: u64) -> Case<f64> {
    let mut case = Drawn::new(seed).case::<f64>();
    if !seed.is_multiple_of(4) {
        case.inputs.bodies = None;
        if matches!(case.inputs.gravity, Gravity::Central { .. }) {
            case.inputs.gravity = Gravity::Uniform(Vector3::new(3.0, -8.0, 2.0));
            case.state.r_b_n = Vector3::new(20.0, -30.0, 10.0);
        }
    }
    case
}

fn numbers(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.within(-1.0, 1.0)).collect()
}

fn rows(of: &Accelerations<List>) -> Vec<f64> {
    let hub = of.r_b_n_ddot.iter().chain(&of.omega_dot).copied();
    hub.chain(of.devices.values()).collect()
}

fn weights(craft: &Spacecraft<List>, case: &Case<f64>, random: &mut Random) -> Accelerations<List> {
    let mut weights = craft.accelerations(&case.state, &case.inputs).unwrap();
    weights.r_b_n_ddot = random.vector(1.0);
    weights.omega_dot = random.vector(1.0);
    weights.devices.values_mut().for_each(|weight| *weight = random.within(-1.0, 1.0));
    weights
}

/// Largest error of a product, each number in units of the magnitudes that are summed.
fn error(found: &[f64], matrix: &DMatrix<f64>, by: &[f64]) -> f64 {
    let expected = matrix * DVector::from_column_slice(by);
    let unit = matrix.abs() * DVector::from_column_slice(by).abs();
    let largest = unit.amax();
    let errors = found.iter().zip(expected.iter()).zip(unit.iter());
    errors.fold(0.0, |worst: f64, ((found, expected), unit)| {
        // A sum of nothing but zeros has rounding in units of the others.
        let unit = if *unit > 1e-6 * largest { *unit } else { 1e-6 * largest + f64::MIN_POSITIVE };
        worst.max((found - expected).abs() / unit)
    })
}

#[test]
fn products_are_those_of_the_matrices() {
    let (mut along_worst, mut gradient_worst) = (0.0_f64, 0.0_f64);
    let (mut products, mut emitted, mut dual_worst) = (0, [0; 2], [0.0_f64; 2]);
    for seed in SEED..SEED + SPACECRAFT {
        let (case, random) = (drawn(seed), &mut Random::new(seed));
        let craft = case.craft();
        let Case { state, inputs, .. } = &case;
        let matrices = craft.linearize(state, inputs, &Outputs::accelerations()).unwrap();
        // With the momentum the columns come from dual numbers.
        let outputs = Outputs { momentum: Some(About::InertialOrigin), loads: None };
        let dual = craft.linearize(state, inputs, &outputs).unwrap();
        let (x, u) = (matrices.states.len(), matrices.inputs.len());
        let (dx, du) = (numbers(random, x), numbers(random, u));
        let (value, along) = craft.jvp(state, inputs, (&dx, &du)).unwrap();
        assert_eq!(value, matrices.accelerations, "{seed:#x}");
        let [both, dual] = [&matrices, &dual].map(|of| {
            DMatrix::from_fn(rows(&along).len(), x + u, |row, column| {
                if column < x { of.c[(row, column)] } else { of.d[(row, column - x)] }
            })
        });
        let by: Vec<f64> = dx.into_iter().chain(du).collect();
        along_worst = along_worst.max(error(&rows(&along), &both, &by));
        let (mut by_states, mut by_inputs) = (vec![f64::NAN; x], vec![f64::NAN; u]);
        let weights = weights(&craft, &case, random);
        let gradient = (by_states.as_mut_slice(), by_inputs.as_mut_slice());
        let value = craft.vjp(state, inputs, &weights, gradient).unwrap();
        assert_eq!(value, matrices.accelerations, "{seed:#x}");
        let found: Vec<f64> = by_states.into_iter().chain(by_inputs).collect();
        let other = fallen_back(&craft, &case, (&by, x), &weights);
        if case.inputs.bodies.is_none() {
            products += 1;
            emitted[0] += u64::from(rows(&along) != other.0);
            emitted[1] += u64::from(found != other.1);
        }
        gradient_worst = gradient_worst.max(error(&found, &both.transpose(), &rows(&weights)));
        let along = error(&rows(&along), &dual, &by);
        let gradient = error(&found, &dual.transpose(), &rows(&weights));
        dual_worst = [dual_worst[0].max(along), dual_worst[1].max(gradient)];
        assert!(dual_worst.iter().all(|worst| *worst <= DUAL), "{seed:#x}: {dual_worst:?}");
        assert!(
            along_worst.max(gradient_worst) <= ROUNDING,
            "{seed:#x}: {along_worst:e} {gradient_worst:e}"
        );
    }
    println!("along directions {along_worst:.1e}, by weights {gradient_worst:.1e}");
    let [along, gradient] = dual_worst;
    println!("from dual numbers {along:.1e}, {gradient:.1e}");
    println!("of {products} {emitted:?} have other bits than what they fall back to");
    // The others are in a central field or have lumped imbalance, or nothing that is free.
    assert!(emitted.iter().all(|emitted| 10 * emitted > 6 * products), "{emitted:?} of {products}");
}

/// Both products with wrenches of zero on the bodies, under which they fall back; without those by the wrenches.
fn fallen_back(
    craft: &Spacecraft<List>,
    case: &Case<f64>,
    (by, x): (&[f64], usize),
    weights: &Accelerations<List>,
) -> (Vec<f64>, Vec<f64>) {
    let mut inputs = case.inputs.clone();
    inputs.bodies.get_or_insert_with(|| Inputs::no_wrenches_for(craft));
    let u = craft.input_variables(&inputs).count();
    let mut all = by.to_vec();
    all.resize(x + u, 0.0);
    let (_, along) = craft.jvp(&case.state, &inputs, all.split_at(x)).unwrap();
    craft.vjp(&case.state, &inputs, weights, all.split_at_mut(x)).unwrap();
    all.truncate(by.len());
    (rows(&along), all)
}

#[test]
fn lists_of_another_length_are_rejected() {
    let case = drawn(SEED + 1);
    let craft = case.craft();
    let Case { state, inputs, .. } = &case;
    let (x, u) = (craft.state_variables(inputs).count(), craft.input_variables(inputs).count());
    let (dx, du) = (vec![1.0; x], vec![1.0; u]);
    let length = |expected, found| Err(DerivativeError::Length { expected, found });
    assert_eq!(craft.jvp(state, inputs, (&dx[1..], &du)).map(|_| ()), length(x, x - 1));
    assert_eq!(craft.jvp(state, inputs, (&dx, &[])).map(|_| ()), length(u, 0));
    let mut weights = weights(&craft, &case, &mut Random::new(1));
    let mut of = (dx.clone(), vec![0.0; u + 1]);
    let found = craft.vjp(state, inputs, &weights, (&mut of.0, &mut of.1));
    assert_eq!(found.map(|_| ()), length(u, u + 1));
    of.1.pop();
    let joints = weights.devices.values().count();
    weights.devices.pop();
    let left = weights.devices.values().count();
    let found = craft.vjp(state, inputs, &weights, (&mut of.0, &mut of.1));
    assert_eq!(found.map(|_| ()), length(6 + joints, 6 + left));
    let text = DerivativeError::<f64>::Length { expected: 14, found: 13 }.to_string();
    assert_eq!(
        text,
        "13 numbers where there are 14 variables or accelerations; list `state_variables` and \
         `input_variables` for the inputs at hand"
    );
}

#[test]
fn products_that_are_not_finite_are_rejected() {
    for seed in [SEED + 1, SEED + 4] {
        let case = drawn(seed);
        let craft = case.craft();
        let Case { state, inputs, .. } = &case;
        let (x, u) = (craft.state_variables(inputs).count(), craft.input_variables(inputs).count());
        for number in [f64::NAN, f64::INFINITY, f64::MAX] {
            let (mut dx, mut du) = (vec![number; x], vec![0.0; u]);
            let found = craft.jvp(state, inputs, (&dx, &du)).map(|_| ());
            assert_eq!(found, Err(DerivativeError::NotFiniteProduct), "{number}");
            let mut weights = weights(&craft, &case, &mut Random::new(1));
            weights.devices.values_mut().for_each(|weight| *weight = number);
            let found = craft.vjp(state, inputs, &weights, (&mut dx, &mut du)).map(|_| ());
            assert_eq!(found, Err(DerivativeError::NotFiniteProduct), "{number}");
        }
        let mut moving = state.clone();
        moving.devices.states_mut().for_each(|[_, rate]| *rate = f64::NAN);
        let (dx, du) = (vec![1.0; x], vec![1.0; u]);
        let found = craft.jvp(&moving, inputs, (&dx, &du)).map(|_| ());
        assert!(matches!(found, Err(DerivativeError::Solve(_))), "{found:?}");
    }
}

/// Also a number that no acceleration changes with: positions, weights of what does not move.
#[test]
fn one_number_that_is_not_finite_is_rejected() {
    for (seed, fixed) in [(SEED + 1, false), (SEED + 1, true), (SEED + 4, false)] {
        let mut case = drawn(seed);
        if fixed {
            (case.state.r_b_n_dot, case.state.omega) = (Vector3::zeros(), Vector3::zeros());
            case.inputs.hub = HubMode::Fixed;
            case.inputs.modes.values_mut().for_each(|mode| *mode = Mode::Locked);
            case.state.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
        }
        let craft = case.craft();
        let Case { state, inputs, .. } = &case;
        let (x, u) = (craft.state_variables(inputs).count(), craft.input_variables(inputs).count());
        let rejected = Err(DerivativeError::NotFiniteProduct);
        for bad in [f64::NAN, f64::NEG_INFINITY] {
            for number in 0..x + u {
                let mut by = vec![0.5; x + u];
                by[number] = bad;
                let found = craft.jvp(state, inputs, by.split_at(x)).map(|_| ());
                assert_eq!(found, rejected, "{seed:#x}, {bad} of variable {number}");
            }
            let good = weights(&craft, &case, &mut Random::new(1));
            for number in 0..rows(&good).len() {
                let mut weights = good.clone();
                let hub = weights.r_b_n_ddot.iter_mut().chain(&mut weights.omega_dot);
                *hub.chain(weights.devices.values_mut()).nth(number).unwrap() = bad;
                let mut of = vec![0.0; x + u];
                let found = craft.vjp(state, inputs, &weights, of.split_at_mut(x)).map(|_| ());
                assert_eq!(found, rejected, "{seed:#x}, {bad} of acceleration {number}");
            }
        }
    }
}
