//! Every derivative by state and inputs against differences in double-double, over random
//! spacecraft of every kind and mode; and the values, bit by bit.

use precess_dynamics::{Gravity, Variable};
use precess_tests::blocks::Figures;
pub(crate) use precess_tests::bounds::{DERIVATIVES_MEDIAN as MEDIAN, DERIVATIVES_WORST as WORST};
use precess_tests::cases;
use precess_tests::derivative_blocks::{Blocks, kind};
use precess_tests::differences::difference;
use precess_tests::double_double::DoubleDouble as Wide;

use crate::draw::{Drawn, SEED};
use crate::outputs::{OUTPUTS, derivatives, values};
use crate::perturb::{changed, magnitude, size};

/// How many spacecraft.
pub(crate) const SPACECRAFT: u64 = 240;

/// The derivatives of a spacecraft, block by block; its values are those of `accelerations`.
fn blocks(drawn: &Drawn) -> Blocks {
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
            blocks.add(&kind, large, &derivatives(&craft, case.inputs.hub, column), &expected);
        },
    );
    let found = found.unwrap_or_else(|error| panic!("seed {:#x}: {error}", drawn.seed));
    assert_eq!(given, variables, "columns in the order of the variables");
    let values = craft.accelerations(&case.state, &case.inputs).unwrap();
    assert_eq!(found, values);
    blocks
}

/// The worst of some errors, with its name.
fn worst(errors: impl Iterator<Item = (f64, String)>) -> (f64, String) {
    errors.fold((0.0, String::new()), |a, b| if b.0 > a.0 { b } else { a })
}

/// Errors over the spacecraft without flexible bearings; the worst, its block and seed.
pub(crate) fn measured() -> (Figures, (f64, String, u64)) {
    let mut figures = Figures::default();
    let mut largest = (0.0, String::new(), 0);
    for seed in SEED..SEED + cases(SPACECRAFT) {
        let (error, name) = worst(blocks(&Drawn::new(seed)).errors());
        figures.add(error);
        if error > WORST {
            println!("seed {seed:#x}: {error:.1e} in {name}");
        }
        if error > largest.0 {
            largest = (error, name, seed);
        }
    }
    (figures, largest)
}

#[test]
fn derivatives_are_those_of_differences_in_double_double() {
    let (figures, (error, name, seed)) = measured();
    println!("worst {error:.1e} in {name}, seed {seed:#x}; median {:.1e}", figures.median());
    assert!(figures.worst() <= WORST, "{error:e} in {name} at seed {seed:#x}");
    assert!(figures.median() <= MEDIAN, "median {:e}", figures.median());
}

/// How many with a wheel on flexible bearings.
const ON_BEARINGS: u64 = 80;

/// Their bounds in units of what each output changes: measured 1.6e-13.
const CHANGES: f64 = 1e-12;
/// How many exceed the bound of the others in units of blocks, some of which are zero but for rounding, and by how much.
const EXCEEDING: (u64, f64) = (18, 2e-5);

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn derivatives_of_wheels_on_bearings_are_those_of_differences_in_double_double() {
    let [mut of_changes, mut of_blocks] = [(); 2].map(|()| Figures::default());
    let mut exceeding = 0;
    for seed in SEED..SEED + ON_BEARINGS {
        let blocks = blocks(&Drawn::on_bearings(seed));
        let (error, name) = worst(blocks.errors_of_changes());
        assert!(error <= CHANGES, "{error:e} in {name} at seed {seed:#x}");
        of_changes.add(error);
        let (error, _) = worst(blocks.errors());
        of_blocks.add(error);
        exceeding += u64::from(error > WORST);
    }
    for (unit, figures) in [("changes", &of_changes), ("blocks", &of_blocks)] {
        println!("in units of {unit}: {:.1e}, median {:.1e}", figures.worst(), figures.median());
    }
    println!("{exceeding} of {ON_BEARINGS} exceed {WORST:e} in units of blocks");
    assert!(of_changes.median() <= MEDIAN, "median {:e}", of_changes.median());
    assert!(exceeding <= EXCEEDING.0 && of_blocks.worst() <= EXCEEDING.1, "{EXCEEDING:?}");
}
