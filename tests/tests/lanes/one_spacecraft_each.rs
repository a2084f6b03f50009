//! Spacecraft whose parameters differ, side by side in lanes, against each by itself: to the bit,
//! errors included.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::lanes::{Batch, BatchAccelerations};
use precess_dynamics::{
    Each as _, ImbalanceModel, Inputs, Mode, Passive, ReactionWheel, SolveError, Spacecraft, State,
};

use super::batch::{self, Mixed, hub, mixed, states};

/// A spacecraft that differs from the others in everything: mass, inertia, imbalance, places,
/// mounts, springs.
fn craft(k: u32) -> Spacecraft<Mixed> {
    let x = f64::from(k);
    let (mut hub, mut devices) = (hub(), mixed());
    hub.m_b += x;
    hub.r_bc_b.y += 0.01 * x;
    hub.i_b_bc.m22 += 0.1 * x;
    devices.0[0].d *= x;
    devices.0[1].r_w_b.z -= 0.02 * x;
    devices.0[1].m_w += 0.1 * x;
    devices.1.mount *= Rotation3::from_axis_angle(&Vector3::x_axis(), 0.3 * x).matrix();
    devices.1.i_w_wc.m13 += 1e-6 * x;
    devices.1.i_w_wc.m31 = devices.1.i_w_wc.m13;
    // Some have a spring where others have none, and one has dry friction.
    if k.is_multiple_of(3) {
        devices.1.passive.gimbal = Passive::spring(2.0 + x, 0.1);
    }
    if k.is_multiple_of(2) {
        devices.2.passive.slosh_mass = Passive::none();
    }
    if k == 5 {
        devices.0[0].passive.wheel =
            Passive { coulomb: 1e-3, coulomb_rate: 0.1, ..Passive::none() };
    }
    if k == 6 {
        devices.0[1].model = ImbalanceModel::Lumped;
    }
    Spacecraft::new(&hub, &devices).unwrap()
}

/// Inputs with a gimbal that is driven in every second one, against a spring in some.
fn inputs(k: u32) -> Inputs<Mixed> {
    let mut inputs = batch::inputs(k);
    if !k.is_multiple_of(2) {
        inputs.modes.1.gimbal = Mode::Driven;
        inputs.motors.1.u_g = 0.01 * f64::from(k);
    }
    inputs
}

pub(super) fn crafts(count: u32) -> Vec<Spacecraft<Mixed>> {
    (0..count).map(craft).collect()
}

/// Everything printed, so that NaN and the sign of zero count.
pub(super) fn printed(found: &impl std::fmt::Debug) -> String {
    format!("{found:?}")
}

#[test]
fn each_spacecraft_has_the_bits_it_has_by_itself() {
    let mut found = Vec::new();
    for count in [0, 1, 3, 8, 9, 17] {
        let (crafts, states) = (crafts(count), states(count));
        let batch = Batch::from_spacecraft(crafts.clone());
        let each: Vec<_> = (0..count).map(inputs).collect();
        batch.accelerations(&states, &each, &mut found).unwrap();
        let alone = crafts.iter().zip(&states).zip(&each);
        let alone = alone.map(|((craft, state), inputs)| craft.accelerations(state, inputs));
        assert_eq!(printed(&found), printed(&alone.collect::<Vec<_>>()), "{count} spacecraft");
        batch.accelerations(&states, &inputs(3), &mut found).unwrap();
        let alone = crafts.iter().zip(&states);
        let alone = alone.map(|(craft, state)| craft.accelerations(state, &inputs(3)));
        assert_eq!(printed(&found), printed(&alone.collect::<Vec<_>>()), "{count}, one input");
    }
}

/// A list of wheels that differ from each other and from those of every other spacecraft.
fn listed(wheels: u32, k: u32) -> Spacecraft<Vec<ReactionWheel>> {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
    let wheel = |i: u32| ReactionWheel {
        d: 1e-4 * f64::from(i + 10 * k),
        r_w_b: Vector3::new(0.1 * f64::from(i), 0.2, 0.3),
        ..ReactionWheel::bare_wheel(3.0 + f64::from(k), disc)
    };
    let mut hub = hub();
    hub.m_b += f64::from(k);
    Spacecraft::new(&hub, &(0..wheels).map(wheel).collect()).unwrap()
}

/// Lengths of lists: other than the first of the batch or of its group, in some, all or no group of four or eight.
const LENGTHS: &[&[u32]] = &[
    &[3, 3, 3, 3, 1, 1, 1, 1],
    &[1, 1, 1, 1, 3, 3, 3, 3],
    &[2, 1, 2, 2],
    &[1, 2, 1, 1],
    &[2, 0, 2, 1],
    &[1, 1, 1, 2],
    &[0, 0, 0, 0, 0, 0, 0, 0, 2],
    &[1, 2, 3, 2, 1, 3, 2, 2, 3],
    &[2, 2, 2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 1],
    &[2; 17],
];

#[test]
fn spacecraft_whose_lists_differ_in_length_have_the_bits_they_have_by_themselves() {
    for lengths in LENGTHS {
        let crafts: Vec<_> =
            lengths.iter().zip(1..).map(|(wheels, k)| listed(*wheels, k)).collect();
        let state = |craft| {
            let mut state: State<Vec<ReactionWheel>> = State::at_rest_for(craft);
            state.omega = Vector3::new(0.1, 0.2, 0.3);
            for joints in &mut state.devices {
                (joints.spin, joints.theta) = (300.0, 0.3);
            }
            state
        };
        let acting = |craft| {
            let mut inputs: Inputs<Vec<ReactionWheel>> = Inputs::none_for(craft);
            inputs.motors.iter_mut().for_each(|motors| motors.u_w = 0.1);
            inputs
        };
        let states: Vec<_> = crafts.iter().map(state).collect();
        let inputs: Vec<_> = crafts.iter().map(acting).collect();
        for (each, threads) in [(true, false), (false, false), (true, true)] {
            let batch = Batch::from_spacecraft(crafts.clone());
            let batch = if threads { batch.on_threads() } else { batch };
            let (mut found, mut run, mut ends) = (Vec::new(), states.clone(), Vec::new());
            // Inputs of the first fit others of its length only, which have errors of their own.
            if each {
                batch.accelerations(&states, &inputs, &mut found).unwrap();
                batch.run(&mut run, &inputs, 1e-3, 3, &mut ends).unwrap();
            } else {
                batch.accelerations(&states, &inputs[0], &mut found).unwrap();
                batch.run(&mut run, &inputs[0], 1e-3, 3, &mut ends).unwrap();
            }
            for (k, craft) in crafts.iter().enumerate() {
                let inputs = &inputs[if each { k } else { 0 }];
                let alone = craft.accelerations(&states[k], inputs);
                assert_eq!(printed(&found[k]), printed(&alone), "spacecraft {k} of {lengths:?}");
                let mut state = states[k].clone();
                let end = (0..3).try_for_each(|_| {
                    state = craft.step(&state, inputs, 1e-3)?;
                    Ok::<_, SolveError<f64>>(())
                });
                let (run, alone) = ((&run[k], &ends[k]), (&state, &end));
                assert_eq!(printed(&run), printed(&alone), "run {k} of {lengths:?}");
            }
        }
    }
}

/// What is given of the joints is taken in once for all groups of lanes, but where a group has dry
/// friction or a lumped imbalance, which is added to it.
#[test]
fn groups_with_loads_of_their_own_between_others_have_the_bits_of_each_by_itself() {
    let plain = [1, 2, 4, 7, 8, 9, 10, 11];
    let of_groups: [[u32; 8]; 4] = [plain, [5; 8], plain, [1, 6, 2, 6, 5, 4, 6, 7]];
    let crafts: Vec<_> = of_groups.as_flattened().iter().map(|k| craft(*k)).collect();
    let states = states(32);
    let mut given = batch::inputs(0);
    given.modes.1.gimbal = Mode::Driven;
    given.motors.1.u_g = 0.02;
    assert!(given.modes.values().all(|mode| mode != Mode::Locked), "else nothing is kept");
    let mut found = Vec::new();
    Batch::from_spacecraft(crafts.clone()).accelerations(&states, &given, &mut found).unwrap();
    let alone = crafts.iter().zip(&states);
    let alone = alone.map(|(craft, state)| craft.accelerations(state, &given));
    assert_eq!(printed(&found), printed(&alone.collect::<Vec<_>>()));
}

/// Minus zero and zero add up to zero: a spring of none in a lane beside one that has a spring must
/// not be added.
#[test]
fn a_spring_in_another_lane_leaves_the_sign_of_zero() {
    let plain =
        ReactionWheel::bare_wheel(3.0, Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1)));
    let mut sprung = plain;
    sprung.passive.wheel = Passive::spring(2.0, 0.1);
    let crafts = [plain, sprung].map(|wheel| Spacecraft::new(&hub(), &[wheel]).unwrap());
    let states: [State<[ReactionWheel; 1]>; 2] = [State::at_rest(); 2];
    let mut inputs: Inputs<[ReactionWheel; 1]> = Inputs::none();
    inputs.motors[0].u_w = -0.0;
    let mut found = Vec::new();
    Batch::from_spacecraft(crafts.to_vec()).accelerations(&states, &inputs, &mut found).unwrap();
    let alone = crafts.iter().zip(&states);
    let alone = alone.map(|(craft, state)| craft.accelerations(state, &inputs));
    assert_eq!(printed(&found), printed(&alone.collect::<Vec<_>>()));
}

#[test]
fn runs_have_the_bits_of_single_steps() {
    let (count, inputs) = (17, inputs(3));
    let (crafts, mut run, mut found) = (crafts(count), states(count), Vec::new());
    let batch = Batch::from_spacecraft(crafts.clone());
    batch.run(&mut run, &inputs, 1e-3, 20, &mut found).unwrap();
    assert!(found.iter().all(Result::is_ok), "{found:?}");
    for ((craft, start), end) in crafts.iter().zip(states(count)).zip(&run) {
        let step = |state, _| craft.step(&state, &inputs, 1e-3).unwrap();
        assert_eq!(printed(&(0..20).fold(start, step)), printed(end));
    }
}

#[test]
fn each_spacecraft_has_its_own_error() {
    let (crafts, mut states) = (crafts(9), states(9));
    let mut each: Vec<_> = (0..9).map(inputs).collect();
    states[1].omega.x = f64::NAN;
    states[3].attitude.q0 = 0.0;
    states[3].attitude.q1 = 0.0;
    each[4].modes.0[0].wheel = Mode::Locked;
    states[8].omega.z = 1e160;
    let batch = Batch::from_spacecraft(crafts.clone());
    let mut found = Vec::new();
    batch.accelerations(&states, &each, &mut found).unwrap();
    let alone = crafts.iter().zip(&states).zip(&each);
    let alone = alone.map(|((craft, state), inputs)| craft.accelerations(state, inputs));
    assert_eq!(printed(&found), printed(&alone.collect::<Vec<_>>()));
    let rejected: Vec<_> = found.iter().map(Result::is_err).collect();
    assert_eq!(rejected, [false, true, false, true, true, false, false, false, true]);
    let (mut run, mut ends) = (states.clone(), Vec::new());
    batch.run(&mut run, &each, 1e-3, 3, &mut ends).unwrap();
    for (k, start) in states.iter().enumerate() {
        let mut state = *start;
        let end = (0..3).try_for_each(|_| {
            state = crafts[k].step(&state, &each[k], 1e-3)?;
            Ok::<_, SolveError<f64>>(())
        });
        assert_eq!(printed(&(run[k], &ends[k])), printed(&(state, &end)), "run {k}");
    }
}

#[test]
fn other_numbers_of_states_or_inputs_are_rejected() {
    let batch = Batch::from_spacecraft(crafts(3));
    let each: Vec<Inputs<Mixed>> = (0..2).map(inputs).collect();
    let count = |expected, found| Err(SolveError::Count { expected, found });
    let mut out: BatchAccelerations<Mixed> = Vec::new();
    assert_eq!(batch.accelerations(&states(2), &inputs(0), &mut out), count(3, 2));
    assert_eq!(batch.accelerations(&states(3), &each, &mut out), count(3, 2));
    let mut states: Vec<State<Mixed>> = states(4);
    assert_eq!(batch.run(&mut states, &inputs(0), 1e-3, 1, &mut Vec::new()), count(3, 4));
}
