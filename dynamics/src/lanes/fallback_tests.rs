//! What lanes support does not fall back to the scalar path, and what they do not support does.

use std::vec;
use std::vec::Vec;

use nalgebra::{Matrix3, Vector3};

use super::accelerations::Evaluation;
use super::batch_spacecraft::SharedSpacecraft;
use super::run::Runs;
use super::{Batch, Observers};
use crate::equations::side_by_side::fallbacks::FALLBACKS;
use crate::equations::side_by_side::registers::Registers;
use crate::{
    BuiltIn, Gravity, Hub, HubMode, ImbalanceModel, Inputs, JointStates, Mode, Passive,
    ReactionWheel, Sgcmg, SloshMass, Spacecraft, State, Wrench,
};

/// How often a state falls back in a call.
fn fallbacks(call: impl FnOnce()) -> usize {
    FALLBACKS.set(0);
    call();
    FALLBACKS.get()
}

type Set = (ReactionWheel, Sgcmg, SloshMass);

/// States of a batch: two full groups of the widest lanes and one that is not full.
const COUNT: u32 = 19;

const STEPS: usize = 5;

/// Length of a step, s.
const DT: f64 = 1e-3;

fn hub() -> Hub {
    Hub { m_b: 50.0, r_bc_b: Vector3::new(0.01, 0.0, 0.05), i_b_bc: Matrix3::identity() * 9.0 }
}

fn disc() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01))
}

fn gyro() -> Sgcmg {
    Sgcmg { d: 1e-4, ..Sgcmg::bare_wheel(5.0, disc()) }
}

fn devices() -> Set {
    let wheel = ReactionWheel { d: 1e-4, ..ReactionWheel::bare_wheel(3.0, disc()) };
    (wheel, gyro(), SloshMass::bare_slosh_mass(4.0))
}

fn state(k: u32) -> State<Set> {
    let mut state: State<Set> = State::at_rest();
    let x = f64::from(k + 1);
    state.r_b_n = Vector3::new(7e6 + x, 1e5, -1e4 * x);
    state.omega = Vector3::new(0.01, 0.002 * x, 0.03);
    (state.devices.0.spin, state.devices.1.spin) = (300.0 - x, 400.0 + x);
    (state.devices.1.gamma_dot, state.devices.2.x_dot) = (0.1 * x, -0.02 * x);
    state
}

/// Fallbacks of the accelerations and of the runs of a batch and of a batch of spacecraft.
fn of_batches(devices: &Set, change: fn(u32, &mut Inputs<Set>)) -> [usize; 4] {
    let input = |k| {
        let mut inputs: Inputs<Set> = Inputs::none();
        change(k, &mut inputs);
        inputs
    };
    let states: Vec<_> = (0..COUNT).map(state).collect();
    let inputs: Vec<_> = (0..COUNT).map(input).collect();
    let craft = Spacecraft::new(&hub(), devices).unwrap();
    let others = Spacecraft::new(&hub(), &self::devices()).unwrap();
    let of = |k: u32| if k.is_multiple_of(3) { &others } else { &craft };
    let crafts = (0..COUNT).map(|k| of(k).clone()).collect();
    let (batch, each) = (Batch::new(&hub(), devices).unwrap(), Batch::from_spacecraft(crafts));
    let (mut found, mut ends) = (Vec::new(), Vec::new());
    [
        fallbacks(|| batch.accelerations(&states, &inputs, &mut found).unwrap()),
        fallbacks(|| batch.run(&mut states.clone(), &inputs, DT, STEPS, &mut ends).unwrap()),
        fallbacks(|| each.accelerations(&states, &inputs, &mut found).unwrap()),
        fallbacks(|| each.run(&mut states.clone(), &inputs, DT, STEPS, &mut ends).unwrap()),
    ]
}

#[test]
fn what_lanes_support_does_not_fall_back() {
    let nothing: fn(u32, &mut Inputs<Set>) = |_, _| {};
    assert_eq!(of_batches(&devices(), nothing), [0; 4]);
    let mut sprung = devices();
    sprung.2.passive.slosh_mass = Passive::spring(9.0, 0.1);
    assert_eq!(
        of_batches(&sprung, |_, inputs| inputs.modes.1.gimbal = Mode::Prescribed(0.1)),
        [0; 4]
    );
    let mut dry = devices();
    dry.1.passive.gimbal = Passive::friction(0.01, 1e-3, 0.05);
    assert_eq!(of_batches(&dry, nothing), [0; 4]);
    let mut lumped = devices();
    lumped.0.model = ImbalanceModel::Lumped;
    assert_eq!(of_batches(&lumped, nothing), [0; 4]);
    let central = |k: u32, inputs: &mut Inputs<Set>| {
        inputs.gravity = Gravity::Central { mu: 4e14 + f64::from(k) };
    };
    assert_eq!(of_batches(&devices(), central), [0; 4]);
    let wrenches = |k: u32, inputs: &mut Inputs<Set>| {
        let mut wrenches = Inputs::<Set>::no_wrenches();
        wrenches.1.wheel = Wrench::torque(&Vector3::new(0.1, f64::from(k), 0.3));
        inputs.bodies = k.is_multiple_of(2).then_some(wrenches);
    };
    assert_eq!(of_batches(&devices(), wrenches), [0; 4]);
    let all = |k: u32, inputs: &mut Inputs<Set>| {
        inputs.gravity = Gravity::Central { mu: 4e14 };
        inputs.bodies = k.is_multiple_of(2).then(Inputs::<Set>::no_wrenches);
    };
    (dry.0.model, dry.1.model) = (ImbalanceModel::Lumped, ImbalanceModel::Lumped);
    assert_eq!(of_batches(&dry, all), [0; 4]);
}

#[test]
fn what_lanes_do_not_support_falls_back() {
    let count = COUNT as usize;
    let held = |k: u32, inputs: &mut Inputs<Set>| {
        let (r_b_n_ddot, omega_dot) = (Vector3::zeros(), Vector3::zeros());
        if k == 3 {
            inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot };
        }
    };
    assert_eq!(of_batches(&devices(), held), [1; 4]);
    // Wrenches that are not finite are errors, which the scalar path finds.
    let bad = |_: u32, inputs: &mut Inputs<Set>| {
        let mut wrenches = Inputs::<Set>::no_wrenches();
        wrenches.0.wheel.force.y = f64::INFINITY;
        inputs.bodies = Some(wrenches);
    };
    assert_eq!(of_batches(&devices(), bad), [count; 4]);
}

#[test]
fn devices_side_by_side_do_not_fall_back() {
    let (mut dry, mut lumped) = (gyro(), gyro());
    dry.passive.gimbal = Passive::friction(0.01, 1e-3, 0.05);
    lumped.model = ImbalanceModel::Lumped;
    let mut state: State<[Sgcmg; 5]> = State::at_rest();
    state.r_b_n.x = 7e6;
    for (k, joints) in (0_u32..).zip(&mut state.devices) {
        (joints.gamma_dot, joints.spin) = (0.1 + f64::from(k), 300.0);
    }
    let none: Inputs<[Sgcmg; 5]> = Inputs::none();
    let central = Inputs { gravity: Gravity::Central { mu: 4e14 }, ..none };
    let wrenches = Inputs { bodies: Some(Inputs::<[Sgcmg; 5]>::no_wrenches()), ..none };
    for inputs in [none, central, wrenches] {
        for devices in [[gyro(); 5], [gyro(), dry, gyro(), lumped, dry]] {
            let craft = Spacecraft::new(&hub(), &devices).unwrap();
            let call = || {
                craft.accelerations(&state, &inputs).unwrap();
                craft.step(&state, &inputs, 1e-3).unwrap();
            };
            assert_eq!(fallbacks(call), 0);
        }
    }
    state.devices[2].theta = 1e9;
    let craft = Spacecraft::new(&hub(), &[gyro(); 5]).unwrap();
    // Without registers of several numbers no devices are grouped.
    let groups = usize::from(Registers::widest().is_some());
    assert_eq!(fallbacks(|| assert!(craft.accelerations(&state, &none).is_ok())), groups);
    let list: Vec<BuiltIn> = vec![gyro().into(); 5];
    let craft = Spacecraft::new(&hub(), &list).unwrap();
    let mut of_list: State<Vec<BuiltIn>> = State::at_rest_for(&craft);
    for ([q, rate], [of_q, of_rate]) in of_list.devices.states_mut().zip(state.devices.states()) {
        (*q, *rate) = (of_q, of_rate);
    }
    let none = Inputs::none_for(&craft);
    assert_eq!(fallbacks(|| assert!(craft.accelerations(&of_list, &none).is_ok())), groups);
}

#[test]
fn a_cpu_without_wide_registers_gives_the_same_bits() {
    let batch = Batch::new(&hub(), &devices()).unwrap();
    let mut inputs: Inputs<Set> = Inputs::none();
    inputs.torque_b = Vector3::new(0.1, 0.0, -0.2);
    let start: Vec<_> = (0..COUNT).map(state).collect();
    let mut laned = Vec::new();
    batch.accelerations(&start, &inputs, &mut laned).unwrap();
    let craft = Spacecraft::new(&hub(), &devices()).unwrap();
    let mut scalar = vec![Ok(craft.no_accelerations()); start.len()];
    let (crafts, out) = (&SharedSpacecraft::new(craft), &mut scalar[..]);
    Evaluation { crafts, start: 0, states: &start, inputs: (&inputs).into(), out }.one_by_one();
    assert_eq!(laned, scalar);
    // Seen after two and four of five steps.
    let (mut states, mut ends) = (start.clone(), Vec::new());
    let mut records = vec![Vec::new(); start.len()];
    let observe = |record: &mut Vec<(usize, State<Set>)>, steps: usize, now: &State<Set>| {
        record.push((steps, *now));
    };
    let observers = Observers::new(2, &mut records, observe);
    batch.run_observed(&mut states, &inputs, DT, STEPS, observers, &mut ends).unwrap();
    let (mut one_by_one, mut seen) = (start.clone(), vec![Vec::new(); start.len()]);
    let mut ended = vec![Ok(()); start.len()];
    let mut see = |index: usize, steps: usize, now: &State<Set>| seen[index].push((steps, *now));
    let (states_of, see_them) = (&mut one_by_one[..], &mut see);
    let (inputs, out) = ((&inputs).into(), &mut ended[..]);
    let every = Some(2);
    Runs {
        crafts,
        start: 0,
        states: states_of,
        inputs,
        dt: DT,
        steps: STEPS,
        every,
        see: see_them,
        out,
    }
    .one_by_one();
    assert_eq!((states, ends, records), (one_by_one, ended, seen));
}
