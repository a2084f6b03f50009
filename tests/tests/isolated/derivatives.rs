//! [`Spacecraft::linearize`] of platforms and rows of panels by the emitted derivatives of the loads, against dual
//! numbers, which compute the same columns where other outputs are requested.

use nalgebra::Vector3;
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{About, FixedSet, Gravity, HubMode, Outputs};
use precess_tests::blocks::Figures;
use precess_tests::cases;

use crate::craft::{Craft, Options, mixed, stacked};
use crate::panels::rows;

/// How many spacecraft of each sort.
const SPACECRAFT: u64 = 120;

/// Errors in units of the largest element of a column: 1e-11 at worst, some thousand roundings.
const WORST: f64 = 1e-11;
const MEDIAN: f64 = 1e-13;

/// What acts, in turn.
fn options(seed: u64) -> Options {
    Options {
        springs: seed.is_multiple_of(2),
        dry: seed.is_multiple_of(4),
        wrenches: seed.is_multiple_of(3),
        gravity: match seed % 5 {
            0 | 1 => Some(Gravity::Central { mu: 4e5 }),
            2 => Some(Gravity::Uniform(Vector3::new(3.0, -8.0, 2.0))),
            _ => None,
        },
        modes: seed % 7 < 3,
        ..Options::default()
    }
}

/// The error of each column; whether any bit is another than that of dual numbers.
fn errors<D: FixedSet<Scalar = f64> + WithNumbers>(
    craft: &Craft<D>,
    seed: u64,
) -> (Vec<f64>, bool) {
    let Craft { solver, state, inputs, .. } = craft;
    let (mut state, mut inputs) = (state.clone(), inputs.clone());
    if seed % 6 == 5 {
        let (r_b_n_ddot, omega_dot) = (Vector3::new(0.3, -0.2, 0.5), Vector3::new(0.1, 0.4, -0.2));
        inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot };
    }
    if seed % 6 == 2 {
        inputs.hub = HubMode::Fixed;
        (state.r_b_n_dot, state.omega) = (Vector3::zeros(), Vector3::zeros());
    }
    let state = &state;
    let wanted = Outputs::accelerations();
    let found = solver.linearize(state, &inputs, &wanted).unwrap();
    assert_eq!(found.accelerations, solver.accelerations(state, &inputs).unwrap());
    let others = Outputs { momentum: Some(About::InertialOrigin), ..wanted };
    let dual = solver.linearize(state, &inputs, &others).unwrap();
    let same = found.a == dual.a && found.b == dual.b;
    let columns = |of: &nalgebra::DMatrix<f64>| -> Vec<_> {
        of.column_iter().map(nalgebra::Matrix::into_owned).collect()
    };
    let pairs = [(&found.a, &dual.a), (&found.b, &dual.b)];
    let pairs = pairs.into_iter().flat_map(|(a, b)| columns(a).into_iter().zip(columns(b)));
    let names = found.states.iter().chain(&found.inputs);
    let errors = pairs.zip(names).map(|((a, b), name)| {
        let scale = b.amax();
        let error = if scale == 0.0 { a.amax() } else { (a - b).amax() / scale };
        if error > WORST {
            println!("seed {seed}: {error:.1e} by {}", solver.variable_name(*name));
        }
        error
    });
    (errors.collect(), !same)
}

fn check(name: &str, all: impl Iterator<Item = (Vec<f64>, bool)>) {
    let (mut figures, mut emitted, mut count) = (Figures::default(), 0, 0);
    for (errors, other_bits) in all {
        for error in errors {
            figures.add(error);
        }
        emitted += u32::from(other_bits);
        count += 1;
    }
    println!("{name}: worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    assert_eq!(emitted, count, "{name}: by emitted derivatives");
    assert!(figures.worst() <= WORST && figures.median() <= MEDIAN, "{name}");
}

#[test]
fn emitted_derivatives_on_carriers_are_those_of_dual_numbers() {
    let seeds = || 0..cases(SPACECRAFT);
    check("mixed", seeds().map(|seed| errors(&mixed(seed, &options(seed)), seed)));
    check("stacked", seeds().map(|seed| errors(&stacked(seed, &options(seed)), seed)));
    check("rows", seeds().map(|seed| errors(&rows(seed, &options(seed)), seed)));
}
