//! Derivatives against differences of a formulation that shares nothing with the solver: Newton and
//! Euler body by body, in double-double.

use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Accelerations, Outputs, Variable};
use precess_tests::blocks::Figures;
use precess_tests::case::Case;
use precess_tests::cases;
use precess_tests::derivative_blocks::Blocks;
use precess_tests::differences::{Named, difference, index};
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::newton_euler;
use precess_tests::random::{SEED, Sample};

use crate::accuracy::{MEDIAN, WORST};

/// How many spacecraft of one and two devices each.
const SPACECRAFT: u64 = 60;

fn named<const N: usize, T: precess_dynamics::Scalar>(
    of: &Accelerations<[precess_dynamics::Dgvscmg<T>; N]>,
) -> Named<T> {
    let mut list = Vec::new();
    list.extend(of.r_b_n_ddot.iter().map(|x| ("r_b_n_ddot".to_owned(), *x)));
    list.extend(of.omega_dot.iter().map(|x| ("omega_dot".to_owned(), *x)));
    let joints = of.devices.values().enumerate();
    list.extend(joints.map(|(k, x)| (format!("joint {}", k % 3), x)));
    list
}

fn changed<const N: usize>(case: &Case<N, Wide>, variable: Variable, by: Wide) -> Case<N, Wide> {
    let mut case = *case;
    let (state, inputs) = (&mut case.state, &mut case.inputs);
    let of = match variable {
        Variable::Omega(axis) => &mut state.omega[index(axis)],
        Variable::Force(axis) => &mut inputs.force[index(axis)],
        Variable::TorqueB(axis) => &mut inputs.torque_b[index(axis)],
        Variable::Coordinate(joint) => state.devices.states_mut().nth(joint).unwrap()[0],
        Variable::Rate(joint) => {
            let [_, rate] = state.devices.states_mut().nth(joint).unwrap();
            rate
        }
        Variable::Motor(joint) => inputs.motors.values_mut().nth(joint).unwrap(),
        other => panic!("{other} does not act in free space"),
    };
    *of = *of + by;
    case
}

fn worst_block<const N: usize>(seed: u64) -> f64 {
    let sample = Sample::<N>::new(seed);
    let (case, wide) = (sample.case::<f64>(), sample.case::<Wide>());
    let craft = case.spacecraft(sample);
    let free = |variable: &Variable| {
        !matches!(variable, Variable::Position(_) | Variable::Attitude(_) | Variable::Velocity(_))
    };
    let states = craft.state_variables(&case.inputs);
    let variables: Vec<_> =
        states.chain(craft.input_variables(&case.inputs)).filter(free).collect();
    let mut blocks = Blocks::default();
    let outputs = Outputs::accelerations();
    craft
        .derivatives(&case.state, &case.inputs, &outputs, variables, |variable, column| {
            let of = |by| {
                let Case { hub, devices, state, inputs } = changed(&wide, variable, by);
                named(&newton_euler::accelerations(&hub, &devices, &state, &inputs).unwrap())
            };
            let kind = match variable.joint() {
                Some(joint) => {
                    format!("{variable:?}").replace(&joint.to_string(), "")
                        + &(joint % 3).to_string()
                }
                None => format!("{variable:?}").split('(').next().unwrap().to_owned(),
            };
            blocks.add(&kind, 1.0, &named(&column.accelerations), &difference(1.0, of));
        })
        .unwrap_or_else(|error| panic!("seed {seed:#x}: {error}"));
    blocks.errors().map(|(error, _)| error).fold(0.0, f64::max)
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn derivatives_are_those_of_newton_and_euler() {
    let mut figures = Figures::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        figures.add(worst_block::<1>(seed));
        figures.add(worst_block::<2>(seed));
    }
    println!("worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    assert!(figures.worst() <= WORST && figures.median() <= MEDIAN);
}
