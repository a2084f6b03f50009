//! What a whole linearisation costs, beside central differences of the accelerations over the same
//! variables: `cargo run --release -p precess-derivatives --example cost`.
//!
//! Differences have some ten digits at best, and steps that somebody has to choose.

use std::hint::black_box;
use std::time::Instant;

use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Dgvscmg, Outputs, Variable};
use precess_tests::measured::{Measured, dgvscmg};

/// The shortest of some runs, microseconds a call.
fn shortest(mut call: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let start = Instant::now();
        for _ in 0..10 {
            call();
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e5);
    }
    best
}

fn main() {
    measure::<1>();
    measure::<4>();
}

fn measure<const N: usize>() {
    let Measured { craft, state, inputs } = Measured::new(&[dgvscmg::<f64>(); N]);
    let variables: Vec<_> =
        craft.state_variables(&inputs).chain(craft.input_variables(&inputs)).collect();
    let value = shortest(|| {
        let _ = black_box(craft.accelerations(black_box(&state), black_box(&inputs)));
    });
    let exact = shortest(|| {
        let by = variables.iter().copied();
        let sum = |_, column: &precess_dynamics::Column<[Dgvscmg; N]>| {
            black_box(column);
        };
        let outputs = Outputs::accelerations();
        let _ = black_box(craft.derivatives(black_box(&state), &inputs, &outputs, by, sum));
    });
    let differences = shortest(|| {
        for variable in &variables {
            for step in [1e-6, -1e-6] {
                let (mut state, mut inputs) = (state, inputs);
                match *variable {
                    Variable::Omega(_) => state.omega.x += step,
                    Variable::Coordinate(joint) => {
                        state.devices.states_mut().nth(joint).into_iter().for_each(|[x, _]| {
                            *x += step;
                        });
                    }
                    Variable::Rate(joint) => {
                        state.devices.states_mut().nth(joint).into_iter().for_each(|[_, x]| {
                            *x += step;
                        });
                    }
                    Variable::Motor(joint) => {
                        inputs.motors.values_mut().nth(joint).into_iter().for_each(|u| *u += step);
                    }
                    _ => inputs.force.x += step,
                }
                let _ = black_box(craft.accelerations(black_box(&state), black_box(&inputs)));
            }
        }
    });
    println!(
        "{N} DGVSCMG: accelerations {value:.2} us; {} columns exact {exact:.1} us, {:.2} evaluations \
         a column; by central differences {differences:.1} us",
        variables.len(),
        exact / value / f64::from(u32::try_from(variables.len()).unwrap_or(u32::MAX)),
    );
}
