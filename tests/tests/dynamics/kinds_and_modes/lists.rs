//! Lists known only at run time: the same devices in the same order give the same bits; and which
//! lists are rejected.

use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, BuiltIn, Devices, Inputs, LoadAxes, Mode, SolveError, State, Wrench,
};
use precess_tests::cases;

use super::balance::disturb;
use super::case::{Case, World};
use super::mixed::{Mixed, Settings, bits, drawn};
use super::random::Random;

const SEEDS: u64 = 100;

/// Short enough for every spring and friction drawn, in s.
const STEP: f64 = 1e-7;

type List = Vec<BuiltIn>;

fn listed((wheels, sgcmg, double, (panel, slosh)): &Mixed) -> List {
    let [first, second] = wheels.map(BuiltIn::from);
    vec![first, second, (*sgcmg).into(), (*double).into(), (*panel).into(), (*slosh).into()]
}

/// The mixed set and the same as a list, with wrenches on the bodies.
fn both(seed: u64) -> (Case<Mixed>, Case<List>) {
    let random = &mut Random::new(seed);
    let world = World::drawn(random);
    let (devices, settings): (Mixed, Settings) = drawn(random, world.hub.m_b);
    let mut set = world.case(&devices, &settings.concat());
    disturb(&mut set, random);
    let mut list = world.case(&listed(&devices), &settings.concat());
    list.inputs.gravity = set.inputs.gravity;
    let wrenches: Vec<Wrench> = set.inputs.bodies.iter().flat_map(Each::values).collect();
    let mut bodies = Inputs::no_wrenches_for(&list.craft);
    bodies.values_mut().zip(wrenches).for_each(|(body, wrench)| *body = wrench);
    list.inputs.bodies = Some(bodies);
    (set, list)
}

/// The bits of a state's joints, rates of the hub and position.
fn of_state<D: Devices<Scalar = f64>>(state: &State<D>) -> Vec<u64> {
    let hub = state.r_b_n.iter().chain(&state.r_b_n_dot).chain(&state.omega).copied();
    hub.chain(state.devices.states().flatten()).map(f64::to_bits).collect()
}

#[test]
fn list_is_the_set_to_the_bit() {
    let mut rejected: u64 = 0;
    for seed in 1..=SEEDS {
        let (set, list) = both(seed);
        assert_eq!(bits(&set.solved()), bits(&list.solved()), "seed {seed}");
        let (of_set, of_list) = (
            set.expect_ok(set.craft.step(&set.state, &set.inputs, STEP)),
            list.expect_ok(list.craft.step(&list.state, &list.inputs, STEP)),
        );
        assert_eq!(of_state(&of_set), of_state(&of_list), "seed {seed}");
        // A step too long for the springs and frictions drawn is rejected by both.
        let (of_set, of_list) = (
            set.craft.step(&set.state, &set.inputs, 1e-4).map(|state| of_state(&state)),
            list.craft.step(&list.state, &list.inputs, 1e-4).map(|state| of_state(&state)),
        );
        assert_eq!(of_set, of_list, "seed {seed}");
        rejected += u64::from(of_set.is_err());
        assert_eq!(set.craft.mass().to_bits(), list.craft.mass().to_bits(), "seed {seed}");
    }
    assert!(0 < rejected && rejected < SEEDS, "{rejected} of {SEEDS} steps rejected");
}

#[test]
fn books_and_loads_of_a_list_are_those_of_the_set_to_the_bit() {
    for seed in 1..=cases(SEEDS) {
        let (set, list) = both(seed);
        let (of_set, of_list) = (set.accelerations(), list.accelerations());
        assert_eq!(
            set.expect_ok(set.craft.ledger(&set.state, &set.inputs, &of_set)),
            list.expect_ok(list.craft.ledger(&list.state, &list.inputs, &of_list)),
            "seed {seed}"
        );
        assert_eq!(
            set.expect_ok(set.craft.momentum(&set.state, About::CentreOfMass)),
            list.expect_ok(list.craft.momentum(&list.state, About::CentreOfMass)),
            "seed {seed}"
        );
        let axes = LoadAxes::Parent;
        let of_set = set.expect_ok(set.craft.loads(&set.state, &set.inputs, &of_set, axes));
        let of_list = list.expect_ok(list.craft.loads(&list.state, &list.inputs, &of_list, axes));
        assert_eq!(of_set.hub, of_list.hub, "seed {seed}");
        let ([first, _], _, double, (_, slosh)) = &of_set.devices;
        let mounts = [first.mount, double.mount, slosh.mount];
        assert_eq!(mounts, [0, 3, 5].map(|device| of_list.devices[device].mount), "seed {seed}");
        let torques: Vec<_> = double.motors.values().collect();
        assert_eq!(torques, *of_list.devices[3].motors, "seed {seed}");
        let joints: Vec<_> = double.joints.values().collect();
        assert_eq!(joints, *of_list.devices[3].joints, "seed {seed}");
    }
}

#[test]
fn stop_of_a_list_is_that_of_the_set_to_the_bit() {
    for seed in 1..=cases(SEEDS) {
        let (mut set, mut list) = both(seed);
        for modes in [&mut set.inputs.modes.0[1].wheel, &mut list.inputs.modes[1][0]] {
            *modes = Mode::Locked;
        }
        let of_set = set.expect_ok(set.craft.stop(&set.state, &set.inputs));
        let of_list = list.expect_ok(list.craft.stop(&list.state, &list.inputs));
        assert_eq!(of_state(&of_set.state), of_state(&of_list.state), "seed {seed}");
        assert_eq!(of_set.energy_lost.to_bits(), of_list.energy_lost.to_bits(), "seed {seed}");
    }
}

#[test]
fn list_of_another_length_is_rejected_wherever_it_stands() {
    let (_, list) = both(1);
    let rejected = |change: fn(&mut State<List>, &mut Inputs<List>)| {
        let (mut state, mut inputs) = (list.state.clone(), list.inputs.clone());
        change(&mut state, &mut inputs);
        let error = list.craft.accelerations(&state, &inputs).expect_err("another length");
        assert_eq!(list.craft.step(&state, &inputs, 1e-3), Err(error));
        assert_eq!(list.craft.stop(&state, &inputs), Err(error));
        error
    };
    let count = |expected, found| SolveError::Count { expected, found };
    let mut found = list.expect_ok(list.craft.accelerations(&list.state, &list.inputs));
    found.devices.pop();
    let loads = list.craft.loads(&list.state, &list.inputs, &found, LoadAxes::Body);
    assert_eq!(loads, Err(count(6, 5)));
    assert_eq!(list.craft.ledger(&list.state, &list.inputs, &found), Err(count(6, 5)));
    assert_eq!(rejected(|state, _| state.devices.truncate(5)), count(6, 5));
    assert_eq!(rejected(|state, _| state.devices.push(state.devices[0])), count(6, 7));
    assert_eq!(rejected(|_, inputs| inputs.motors.truncate(5)), count(6, 5));
    assert_eq!(rejected(|_, inputs| inputs.modes.clear()), count(6, 0));
    assert_eq!(rejected(|_, inputs| inputs.bodies.iter_mut().for_each(Vec::clear)), count(6, 0));
    // Of one device: the wheel has one joint, the SGCMG two, the DGVSCMG three, the panel one.
    assert_eq!(rejected(|state, _| state.devices.swap(1, 2)), count(1, 2));
    assert_eq!(rejected(|_, inputs| inputs.motors.swap(2, 3)), count(2, 3));
    assert_eq!(rejected(|_, inputs| inputs.modes.swap(3, 4)), count(3, 1));
    let energy = |state: &State<List>| list.craft.energy(state);
    let mut state = list.state.clone();
    state.devices.clear();
    assert_eq!(energy(&state), Err(count(6, 0)));
}
