//! Derivatives of spacecraft whose devices are evaluated side by side, against the same devices one after another: to
//! the bit, of each service that takes the emitted derivatives of the loads. The kernel of every kind is compared in the
//! unit tests of the solver.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::kind::{Each as _, JointStates as _};
use precess_dynamics::{
    Axis, Gravity, Hub, Inputs, Mode, Outputs, ParameterDirection, Passive, ReactionWheel, Sgcmg,
    Spacecraft, State, Variable,
};
use precess_tests::random::Random;

use super::batch::{hub, one_after_another};
use super::one_spacecraft_each::printed;

type Set = (Vec<Sgcmg>, Vec<ReactionWheel>);

/// Numbers of gyros and wheels: with registers of eight the last of two or three groups has any length, in rows of one
/// kind and behind another kind.
const COUNTS: [[usize; 2]; 22] = [
    [0, 3],
    [0, 5],
    [0, 6],
    [0, 8],
    [0, 9],
    [0, 11],
    [0, 12],
    [0, 13],
    [0, 14],
    [0, 16],
    [0, 21],
    [0, 22],
    [3, 0],
    [7, 0],
    [11, 0],
    [13, 0],
    [21, 0],
    [8, 5],
    [5, 8],
    [8, 4],
    [3, 13],
    [13, 3],
];

/// Length of a step, s.
const DT: f64 = 1e-3;

/// Devices of which no two are alike.
fn devices([gyros, wheels]: [usize; 2], random: &mut Random) -> Set {
    let passive = |random: &mut Random| Passive {
        rest: random.within(-0.1, 0.1),
        ..Passive::spring(random.within(0.1, 1.0), random.within(0.01, 0.1))
    };
    let disc = |random: &mut Random| {
        let axial = random.within(0.02, 0.03);
        Matrix3::from_diagonal(&Vector3::new(axial, 0.6 * axial, 0.6 * axial))
    };
    let gyro = |random: &mut Random| {
        let mut gyro = Sgcmg::bare_wheel(random.within(2.0, 4.0), disc(random));
        (gyro.d, gyro.r_g_b) = (random.within(1e-4, 1e-3), random.vector(0.5));
        gyro.passive.gimbal = passive(random);
        gyro
    };
    let gyros = (0..gyros).map(|_| gyro(random)).collect();
    let wheel = |random: &mut Random| {
        let mut wheel = ReactionWheel::bare_wheel(random.within(2.0, 4.0), disc(random));
        (wheel.d, wheel.r_w_b) = (random.within(1e-4, 1e-3), random.vector(0.5));
        wheel
    };
    (gyros, (0..wheels).map(|_| wheel(random)).collect())
}

/// What each service finds, by its name.
fn found(
    craft: &Spacecraft<Set>,
    (hub, devices): (&Hub, &Set),
    (state, inputs): (&State<Set>, &Inputs<Set>),
    random: &mut Random,
) -> Vec<(&'static str, String)> {
    let matrices = craft.linearize(state, inputs, &Outputs::accelerations()).unwrap();
    let (rows, held) = (matrices.states.len(), matrices.inputs.len());
    let mut numbers =
        |count: usize| -> Vec<f64> { (0..count).map(|_| random.within(-1.0, 1.0)).collect() };
    let (mut of_state, mut of_inputs) = (numbers(rows), numbers(held));
    let along = craft.jvp(state, inputs, (&of_state, &of_inputs)).unwrap();
    craft.vjp(state, inputs, &along.1, (&mut of_state, &mut of_inputs)).unwrap();
    let step = craft.linearize_step(state, inputs, DT).unwrap();
    let directions = [ParameterDirection {
        hub: Hub { m_b: 2.0, r_bc_b: Vector3::new(0.1, 0.2, 0.3), i_b_bc: Matrix3::identity() },
        held: vec![(Variable::Force(Axis::X), 1.0)],
        ..ParameterDirection::none()
    }];
    let changes = DMatrix::from_vec(rows, 1, numbers(rows));
    let (of, at) = ((hub, devices), (state, inputs));
    let accelerations = craft.accelerations_along(of, at, &changes, &directions).unwrap();
    let after = craft.step_along(of, at, DT, &changes, &directions).unwrap();
    assert!(accelerations.is_some() && after.is_some(), "no emitted derivatives");
    vec![
        ("linearize", printed(&matrices)),
        ("jvp", printed(&along)),
        ("vjp", printed(&(of_state, of_inputs))),
        ("linearize_step", printed(&step)),
        ("accelerations_along", printed(&accelerations)),
        ("step_along", printed(&after)),
    ]
}

#[test]
fn derivatives_of_devices_side_by_side_have_the_bits_of_one_after_another() {
    let hub = hub();
    for (seed, counts) in (0xDE51..).zip(COUNTS) {
        let random = &mut Random::new(seed);
        let devices = devices(counts, random);
        let craft = Spacecraft::new(&hub, &devices).unwrap();
        let mut state: State<Set> = State::at_rest_for(&craft);
        let mut inputs = Inputs::none_for(&craft);
        state.omega = random.vector(0.3);
        for [coordinate, rate] in state.devices.states_mut() {
            (*coordinate, *rate) = (random.within(-3.0, 3.0), random.within(-20.0, 20.0));
        }
        inputs.gravity = Gravity::Uniform(random.vector(9.8));
        inputs.motors.values_mut().for_each(|motor| *motor = random.within(-0.1, 0.1));
        for modes in &mut inputs.modes.1 {
            if random.bits().is_multiple_of(4) {
                modes.wheel = Mode::Prescribed(random.within(-1.0, 1.0));
            }
        }
        let (of, at) = ((&hub, &devices), (&state, &inputs));
        let side_by_side = found(&craft, of, at, &mut Random::new(seed));
        let in_order = found(&one_after_another(&craft), of, at, &mut Random::new(seed));
        for ((service, found), (_, expected)) in side_by_side.iter().zip(&in_order) {
            assert!(found == expected, "{service} of {counts:?} gyros and wheels");
        }
    }
}
