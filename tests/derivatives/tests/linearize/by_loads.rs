//! [`Spacecraft::linearize`] by the emitted derivatives of the loads: against differences in double-double, and against
//! dual numbers, which compute the same columns where other outputs are wanted.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, Axis, Gravity, HubMode, Inputs, LoadAxes, Mode, Outputs, Scalar, Spacecraft, Variable,
};
use precess_tests::blocks::Figures;
use precess_tests::bounds::{DERIVATIVES_MEDIAN as MEDIAN, DERIVATIVES_WORST as WORST};
use precess_tests::cases;
use precess_tests::derivative_blocks::{Blocks, kind};
use precess_tests::differences::{Named, difference};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::draw::{Case, Drawn, List, SEED};
use crate::perturb::{changed, magnitude, size};

/// How many spacecraft of each sort.
const SPACECRAFT: u64 = 240;

/// Accelerations with the names of their blocks.
pub(crate) fn named<T: Scalar>(
    craft: &Spacecraft<List<T>>,
    hub: [Vector3<T>; 2],
    joints: impl Iterator<Item = T>,
) -> Named<T> {
    let mut list = Vec::new();
    for (name, v) in ["r_b_n_ddot", "omega_dot"].into_iter().zip(hub) {
        list.extend(v.iter().map(|x| (name.to_owned(), *x)));
    }
    let joints = joints.zip(craft.joints());
    list.extend(joints.map(|(value, (_, info))| (info.acceleration.to_owned(), value)));
    list
}

/// Those of a spacecraft.
pub(crate) fn values<T: Scalar>(craft: &Spacecraft<List<T>>, case: &Case<T>) -> Named<T> {
    let found = craft.accelerations(&case.state, &case.inputs).expect("regular");
    named(craft, [found.r_b_n_ddot, found.omega_dot], found.devices.values())
}

/// Errors of `c` and `d`, block by block; whether any bit is another than that of dual numbers.
fn blocks(drawn: &Drawn) -> (Blocks, bool) {
    let (case, wide) = (drawn.case::<f64>(), drawn.case::<Wide>());
    let (craft, wide_craft) = (case.craft(), wide.craft());
    let wanted = Outputs::accelerations();
    let found = craft.linearize(&case.state, &case.inputs, &wanted).unwrap();
    assert_eq!(found.accelerations, craft.accelerations(&case.state, &case.inputs).unwrap());
    let columns = found.c.column_iter().chain(found.d.column_iter());
    let variables = || found.states.iter().chain(&found.inputs).copied();
    let mut blocks = Blocks::default();
    for (variable, column) in variables().zip(columns) {
        let of = |by| values(&wide_craft, &changed(&wide, variable, by));
        let expected = difference(size(&wide, variable), of);
        let kind = kind(&craft, variable);
        let large = magnitude(&wide, variable, kind.ends_with("spin"));
        let hub = [column.fixed_rows::<3>(0), column.fixed_rows::<3>(3)];
        let hub = hub.map(nalgebra::Matrix::into_owned);
        let joints = column.iter().skip(6).copied();
        blocks.add(&kind, large, &named(&craft, hub, joints), &expected);
    }
    // With loads the columns come from dual numbers; the rows of the accelerations are the same ones.
    let loads = Outputs { loads: Some(LoadAxes::Body), ..wanted };
    let dual = craft.linearize(&case.state, &case.inputs, &loads).unwrap();
    let rows = found.c.nrows();
    let same = found.c == dual.c.rows(0, rows) && found.d == dual.d.rows(0, rows);
    let apart = |a: &nalgebra::DMatrix<f64>, b: &nalgebra::DMatrix<f64>| {
        let scale = b.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        (a - b).amax() / scale
    };
    for (a, b) in [(&found.a, &dual.a), (&found.b, &dual.b)] {
        assert!(a.is_empty() || apart(a, b) < 1e-9, "{:#x}: {:e}", drawn.seed, apart(a, b));
    }
    (blocks, !same)
}

#[test]
fn emitted_derivatives_are_those_of_differences_in_double_double() {
    let (mut figures, mut emitted) = (Figures::default(), 0);
    let count = cases(SPACECRAFT);
    for seed in SEED..SEED + count {
        let (blocks, other_bits) = blocks(&Drawn::new(seed));
        emitted += u64::from(other_bits);
        let (error, name) =
            blocks.errors().fold((0.0, String::new()), |a, b| if b.0 > a.0 { b } else { a });
        figures.add(error);
        if error > WORST {
            println!("seed {seed:#x}: {error:.1e} in {name}");
        }
    }
    println!("worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    println!("{emitted} of {count} have other bits than dual numbers");
    // Others have no joint that is free, on a hub that is not.
    assert!(10 * emitted > 9 * count, "{emitted} of {count} by emitted derivatives");
    assert!(figures.worst() <= WORST && figures.median() <= MEDIAN, "{figures:?}");
}

/// Their bound in units of what each output changes: blocks of hub and gimbal cancel to nearly nothing.
const CHANGES: f64 = 1e-12;

#[test]
fn emitted_derivatives_of_wheels_on_bearings_are_exact_in_units_of_changes() {
    let mut figures = Figures::default();
    for seed in SEED..SEED + cases(SPACECRAFT / 3) {
        let (blocks, _) = blocks(&Drawn::on_bearings(seed));
        figures.add(blocks.errors_of_changes().fold(0.0, |most, (error, _)| error.max(most)));
    }
    println!("worst {:.1e}, median {:.1e}", figures.worst(), figures.median());
    assert!(figures.worst() <= CHANGES, "{figures:?}");
}

#[test]
fn a_prescribed_hub_in_a_uniform_field_turns_the_field_under_its_joints() {
    // Of a free hub the attitude moves no joint; of a prescribed one it does.
    let mut of = (SEED..SEED + SPACECRAFT).map(Drawn::new).find(|of| {
        matches!(of.case.inputs.hub, HubMode::Prescribed { .. })
            && matches!(of.case.inputs.gravity, Gravity::Uniform(_))
            && of.case.inputs.modes.values().any(|mode| mode == Mode::Driven)
    });
    let of = of.as_mut().unwrap();
    let case = of.case::<f64>();
    let craft = case.craft();
    let outputs = Outputs { momentum: Some(About::InertialOrigin), loads: None };
    let found = craft.linearize(&case.state, &case.inputs, &Outputs::accelerations()).unwrap();
    let dual = craft.linearize(&case.state, &case.inputs, &outputs).unwrap();
    let place = |by| found.states.iter().position(|state| *state == by).unwrap();
    let attitude = place(Variable::Attitude(Axis::Y));
    let rows = found.c.nrows();
    let [a, b] = [&found.c, &dual.c].map(|of| of.column(attitude).rows(0, rows).into_owned());
    assert!(a.rows(6, rows - 6).amax() > 0.0, "{a}");
    assert!((&a - &b).amax() <= 1e-11 * b.amax(), "{a} {b}");
}

#[test]
fn what_does_not_move_has_matrices_without_rows() {
    let mut of = Drawn::new(SEED);
    of.case.inputs.hub = HubMode::Fixed;
    of.case.inputs.bodies = None;
    of.case.state.r_b_n_dot = Vector3::zeros();
    of.case.state.omega = Vector3::zeros();
    of.case.inputs.modes.values_mut().for_each(|mode| *mode = Mode::Locked);
    of.case.state.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
    let case = of.case::<f64>();
    let craft = case.craft();
    let mut inputs = case.inputs.clone();
    let found = craft.linearize(&case.state, &inputs, &Outputs::accelerations()).unwrap();
    assert_eq!([found.a.shape(), found.b.shape()], [(0, 0); 2]);
    // Wrenches move nothing, but load what holds the hub.
    inputs.bodies = Some(Inputs::no_wrenches_for(&craft));
    let loads = Outputs { loads: Some(LoadAxes::Body), ..Outputs::accelerations() };
    let found = craft.linearize(&case.state, &inputs, &loads).unwrap();
    assert_eq!(found.b.shape(), (0, found.inputs.len()));
    let nothing = found.d.column_iter().filter(|column| column.amax() == 0.0).count();
    assert_eq!(nothing, 0, "{}", found.d);
}

#[test]
fn kept_matrices_become_those_of_another_spacecraft() {
    // Other sizes, other modes, with and without a hub that moves; by emitted derivatives and by dual numbers.
    let wanted = Outputs::accelerations();
    let others = Outputs { momentum: Some(About::InertialOrigin), ..wanted };
    let mut kept = None;
    for seed in SEED..SEED + 24 {
        for outputs in [wanted, others] {
            let case = Drawn::new(seed).case::<f64>();
            let craft = case.craft();
            let expected = craft.linearize(&case.state, &case.inputs, &outputs).unwrap();
            let kept = kept.get_or_insert_with(|| expected.clone());
            craft.linearize_into(&case.state, &case.inputs, &outputs, kept).unwrap();
            assert!(*kept == expected, "{seed:#x}");
        }
    }
}
