//! Every derivative by state and inputs against differences in double-double, over random
//! spacecraft of twelve kinds and every mode; and the values, bit by bit.

use precess_dynamics::{Gravity, Variable};
use precess_tests::blocks::Figures;
pub(crate) use precess_tests::bounds::{DERIVATIVES_MEDIAN as MEDIAN, DERIVATIVES_WORST as WORST};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::draw::{Drawn, SEED};
use crate::outputs::{Blocks, OUTPUTS, derivatives, kind, values};
use crate::perturb::{changed, difference, magnitude, size};

/// How many spacecraft.
pub(crate) const SPACECRAFT: u64 = 240;

/// The worst block of a spacecraft; its values are those of `accelerations`.
fn worst_block(drawn: &Drawn) -> (f64, String) {
    let (case, wide) = (drawn.case::<f64>(), drawn.case::<Wide>());
    let (craft, wide_craft) = (case.craft(), wide.craft());
    let gravity = match case.inputs.gravity {
        Gravity::None => vec![],
        Gravity::Uniform(_) => precess_dynamics::Axis::ALL.map(Variable::Gravity).to_vec(),
        Gravity::Central { .. } => vec![Variable::Mu],
    };
    let variables: Vec<_> = craft
        .state_variables(&case.inputs)
        .chain(craft.input_variables(&case.inputs))
        .chain(gravity)
        .collect();
    let mut blocks = Blocks::default();
    let mut given = Vec::new();
    let found = craft.derivatives(
        &case.state,
        &case.inputs,
        &OUTPUTS,
        variables.iter().copied(),
        |variable, column| {
            given.push(variable);
            let of = |by| values(&wide_craft, &changed(&wide, variable, by));
            let expected = difference(size(&wide, variable), of);
            let kind = kind(&craft, variable);
            let large = magnitude(&wide, variable, kind.ends_with("spin"));
            blocks.add(&kind, large, &derivatives(&craft, column), &expected);
        },
    );
    let found = found.unwrap_or_else(|error| panic!("seed {:#x}: {error}", drawn.seed));
    assert_eq!(given, variables, "columns in the order of the variables");
    let values = craft.accelerations(&case.state, &case.inputs).unwrap();
    assert_eq!(found, values);
    blocks.errors().fold((0.0, String::new()), |a, b| if b.0 > a.0 { b } else { a })
}

/// Errors over all spacecraft; the worst, its block and seed.
pub(crate) fn measured() -> (Figures, (f64, String, u64)) {
    let mut figures = Figures::default();
    let mut worst = (0.0, String::new(), 0);
    for seed in SEED..SEED + SPACECRAFT {
        let (error, name) = worst_block(&Drawn::new(seed));
        figures.add(error);
        if error > WORST {
            println!("seed {seed:#x}: {error:.1e} in {name}");
        }
        if error > worst.0 {
            worst = (error, name, seed);
        }
    }
    (figures, worst)
}

#[test]
fn derivatives_are_those_of_differences_in_double_double() {
    let (figures, (error, name, seed)) = measured();
    println!("worst {error:.1e} in {name}, seed {seed:#x}; median {:.1e}", figures.median());
    assert!(figures.worst() <= WORST, "{error:e} in {name} at seed {seed:#x}");
    assert!(figures.median() <= MEDIAN, "median {:e}", figures.median());
}
