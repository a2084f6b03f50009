//! Accelerations by parameters, from what the loads of one device change by: against differences in double-double, and
//! against dual numbers through the whole solver, which compute the same columns where other outputs are wanted.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{Column, Gravity, Outputs, Scalar, Spacecraft};
use precess_tests::blocks::Figures;
use precess_tests::bounds::{DERIVATIVES_MEDIAN as MEDIAN, DERIVATIVES_WORST as WORST};
use precess_tests::cases;
use precess_tests::derivative_blocks::Blocks;
use precess_tests::differences::{Named, difference};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::by_loads::{named, values};
use crate::draw::{Case, Drawn, List, SEED};
use crate::outputs::OUTPUTS;
use crate::parameters::{block, changed, parameters, size, variables};

/// How many spacecraft: each has some sixty parameters.
const SPACECRAFT: u64 = 60;
/// How many compared with dual numbers only.
const WITH_DUAL_NUMBERS: u64 = 240;

/// A spacecraft without a central field, under which dual numbers compute the columns.
fn drawn(mut of: Drawn) -> Drawn {
    if matches!(of.case.inputs.gravity, Gravity::Central { .. }) {
        of.case.inputs.gravity = Gravity::Uniform(Vector3::new(3.0, -8.0, 2.0));
        of.case.state.r_b_n = Vector3::new(20.0, -30.0, 10.0);
    }
    of
}

fn rows(craft: &Spacecraft<List>, column: &Column<List>) -> Named<f64> {
    let Column { accelerations, r_b_n_ddot_n, .. } = column;
    let hub = [accelerations.r_b_n_ddot, accelerations.omega_dot];
    let mut rows = named(craft, hub, accelerations.devices.values());
    rows.extend(r_b_n_ddot_n.iter().map(|x| ("r_b_n_ddot_n".to_owned(), *x)));
    rows
}

/// The derivatives by all parameters, each with its block.
fn columns(case: &Case<f64>, outputs: &Outputs) -> Vec<Named<f64>> {
    let craft = case.craft();
    let of_devices = parameters(case);
    let variables = variables(&of_devices);
    let (mut given, mut columns) = (vec![], vec![]);
    let found = Spacecraft::parameter_derivatives(
        &case.hub,
        &case.devices,
        (&case.state, &case.inputs),
        outputs,
        variables.iter().copied(),
        |variable, column| {
            given.push(variable);
            columns.push(rows(&craft, column));
        },
    );
    assert_eq!(given, variables, "columns in the order of the variables");
    assert_eq!(found.unwrap(), craft.accelerations(&case.state, &case.inputs).unwrap());
    columns
}

/// Errors of the columns, in blocks of one parameter.
fn blocks_against(
    case: &Case<f64>,
    columns: &[Named<f64>],
    expected: impl Fn(usize) -> Named<Wide>,
) -> Blocks {
    let mut blocks = Blocks::default();
    let of_devices = parameters(case);
    for (number, (variable, column)) in variables(&of_devices).iter().zip(columns).enumerate() {
        let (kind, large) = block(case, variable);
        blocks.add(&kind, large, column, &expected(number));
    }
    blocks
}

fn against_differences(drawn: &Drawn) -> Blocks {
    let (case, wide) = (drawn.case::<f64>(), drawn.case::<Wide>());
    let of_devices = parameters(&case);
    let variables = variables(&of_devices);
    let columns = columns(&case, &Outputs::accelerations());
    blocks_against(&case, &columns, |number| {
        let of = |by| {
            let case = changed(&wide, &variables[number], by);
            let craft = case.craft();
            let mut rows = values(&craft, &case);
            let bn = precess_dynamics::Attitude::dcm(&case.state.attitude);
            let found = craft.accelerations(&case.state, &case.inputs).unwrap().r_b_n_ddot;
            for column in 0..3 {
                let [x, y, z] = [0, 1, 2].map(|row| bn[(row, column)] * found[row]);
                rows.push(("r_b_n_ddot_n".to_owned(), x + y + z));
            }
            rows
        };
        difference(size(&case, &variables[number]), of)
    })
}

fn worst(errors: impl Iterator<Item = (f64, String)>) -> (f64, String) {
    errors.fold((0.0, String::new()), |a, b| if b.0 > a.0 { b } else { a })
}

#[test]
fn accelerations_by_parameters_are_those_of_differences_in_double_double() {
    let mut figures = Figures::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        let (error, name) = worst(against_differences(&drawn(Drawn::new(seed))).errors());
        figures.add(error);
        if error > WORST {
            println!("seed {seed:#x}: {error:.1e} in {name}");
        }
    }
    println!("worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    assert!(figures.worst() <= WORST && figures.median() <= MEDIAN, "{figures:?}");
}

/// Their bound in units of what each output changes: blocks of hub and gimbal cancel to nearly nothing.
const CHANGES: f64 = 1e-12;

#[test]
fn accelerations_by_parameters_of_wheels_on_bearings_are_exact_in_units_of_changes() {
    let mut figures = Figures::default();
    for seed in SEED..SEED + cases(SPACECRAFT / 3) {
        let blocks = against_differences(&drawn(Drawn::on_bearings(seed)));
        figures.add(worst(blocks.errors_of_changes()).0);
    }
    println!("worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    assert!(figures.worst() <= CHANGES, "{figures:?}");
}

/// Of all kinds, by every parameter that has a name. Both have rounding of their own.
#[test]
fn accelerations_by_parameters_are_those_of_dual_numbers() {
    let (mut figures, mut other_bits) = (Figures::default(), 0);
    let count = cases(WITH_DUAL_NUMBERS);
    for seed in SEED..SEED + count {
        let case = drawn(Drawn::new(seed)).case::<f64>();
        let columns_by_loads = columns(&case, &Outputs::accelerations());
        let dual = columns(&case, &OUTPUTS);
        other_bits += u64::from(columns_by_loads != dual);
        let expected = |number: usize| {
            let wide = |(name, value): &(String, f64)| (name.clone(), Wide::from_f64(*value));
            dual[number].iter().map(wide).collect()
        };
        let (error, name) = worst(blocks_against(&case, &columns_by_loads, expected).errors());
        figures.add(error);
        if error > WORST {
            println!("seed {seed:#x}: {error:.1e} in {name}");
        }
    }
    println!("worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    println!("{other_bits} of {count} have other bits than dual numbers");
    // A lumped imbalance leaves the columns to dual numbers.
    assert!(5 * other_bits > 3 * count, "{other_bits} of {count} by loads");
    assert!(figures.worst() <= WORST && figures.median() <= MEDIAN, "{figures:?}");
}
