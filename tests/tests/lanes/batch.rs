//! The services in lanes against single evaluations, to the bit.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::Each as _;
use precess_dynamics::lanes::Batch;
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    Accelerations, Dgvscmg, Gravity, Hub, HubMode, Inputs, Mode, Passive, ReactionWheel, Sgcmg,
    SloshMass, SolveError, Spacecraft, State,
};
use precess_tests::bounds::SPACECRAFT;
use precess_tests::case::{Case, Set};
use precess_tests::measured::{self, Measured, dgvscmg};
use precess_tests::random::{Sample, Visitor, visit};

/// The accelerations of a case in a batch of one.
fn batched<const N: usize>(case: &Case<N>) -> Accelerations<Set<N>> {
    let batch = Batch::new(&case.hub, &case.devices).unwrap();
    let mut found = Vec::new();
    batch.accelerations(&[case.state], &case.inputs, &mut found).unwrap();
    found.remove(0).unwrap()
}

/// The same spacecraft, its devices one after another: what is converted has no groups of devices.
pub(super) fn one_after_another<D: WithNumbers<Scalar = f64>>(
    craft: &Spacecraft<D>,
) -> Spacecraft<D::With<f64>> {
    craft.with_numbers(|number| number)
}

/// The accelerations of a case with its devices one after another.
fn in_order<const N: usize>(case: &Case<N>) -> Accelerations<Set<N>> {
    let craft = one_after_another(&Spacecraft::new(&case.hub, &case.devices).unwrap());
    craft.accelerations(&case.state, &case.inputs).unwrap()
}

#[test]
fn lanes_have_the_bits_of_single_evaluations() {
    struct Bits;
    impl Visitor for Bits {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<f64>();
            let solved = case.solved(sample);
            assert_eq!(batched(&case), solved, "batch: {sample}");
            assert_eq!(in_order(&case), solved, "devices side by side: {sample}");
        }
    }
    visit(SPACECRAFT, &mut Bits);
}

pub(super) type Mixed = ([ReactionWheel; 2], Sgcmg, SloshMass);

pub(super) fn hub() -> Hub {
    Hub {
        m_b: 120.0,
        r_bc_b: Vector3::new(0.01, -0.02, 0.05),
        i_b_bc: Matrix3::new(20.0, 0.3, -0.2, 0.3, 18.0, 0.1, -0.2, 0.1, 15.0),
    }
}

pub(super) fn mixed() -> Mixed {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
    let wheel = ReactionWheel { d: 1e-5, ..ReactionWheel::bare_wheel(3.0, disc) };
    let mut tank = SloshMass::bare_slosh_mass(4.0);
    tank.passive.slosh_mass = Passive::spring(9.0, 0.1);
    ([wheel, ReactionWheel { r_w_b: Vector3::new(0.1, 0.0, 0.2), ..wheel }], gyro(), tank)
}

fn gyro() -> Sgcmg {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
    Sgcmg { d: 2e-5, ..Sgcmg::bare_wheel(5.0, disc) }
}

/// States that differ in everything.
pub(super) fn states(count: u32) -> Vec<State<Mixed>> {
    let state = |k: u32| {
        let x = f64::from(k);
        let mut state: State<Mixed> = State::at_rest();
        state.r_b_n = Vector3::new(x, 1.0, -x);
        state.r_b_n_dot = Vector3::new(0.1, 0.2 * x, 0.3);
        state.omega = Vector3::new(0.1 * x.sin(), 0.2, 0.1 * x.cos());
        state.attitude.q1 = 0.1 * x;
        state.devices.0[0].theta = 40.0 * x;
        state.devices.0[0].spin = 300.0 - x;
        state.devices.0[1].spin = -200.0 + x;
        state.devices.1.gamma = x.sin();
        state.devices.1.spin = 500.0;
        state.devices.2.x = 0.01 * x;
        state.devices.2.x_dot = -0.02 * x;
        state
    };
    (0..count).map(state).collect()
}

/// Inputs with a prescribed gimbal and a uniform field, each a little different.
pub(super) fn inputs(k: u32) -> Inputs<Mixed> {
    let mut inputs: Inputs<Mixed> = Inputs::none();
    inputs.force = Vector3::new(1.0, f64::from(k), -2.0);
    inputs.motors.0[1].u_w = 0.05 * f64::from(k);
    inputs.modes.1.gimbal = Mode::Prescribed(0.2);
    inputs.gravity = Gravity::Uniform(Vector3::new(0.0, 0.1, -9.81));
    inputs
}

#[test]
fn any_number_of_states_has_the_bits_of_single_evaluations() {
    let (craft, batch) =
        (Spacecraft::new(&hub(), &mixed()).unwrap(), Batch::new(&hub(), &mixed()).unwrap());
    let mut found = Vec::new();
    for count in [0, 1, 2, 7, 8, 9, 17] {
        let (states, each) = (states(count), (0..count).map(inputs).collect::<Vec<_>>());
        batch.accelerations(&states, &each, &mut found).unwrap();
        let single =
            states.iter().zip(&each).map(|(state, inputs)| craft.accelerations(state, inputs));
        assert_eq!(found, single.collect::<Vec<_>>(), "{count} states");
        batch.accelerations(&states, &inputs(3), &mut found).unwrap();
        let single = states.iter().map(|state| craft.accelerations(state, &inputs(3)));
        assert_eq!(found, single.collect::<Vec<_>>(), "{count} states, one input");
    }
}

#[test]
fn runs_have_the_bits_of_single_steps() {
    let (craft, batch) =
        (Spacecraft::new(&hub(), &mixed()).unwrap(), Batch::new(&hub(), &mixed()).unwrap());
    let mut found = Vec::new();
    for count in [1, 8, 9] {
        let (mut run, inputs) = (states(count), inputs(2));
        batch.run(&mut run, &inputs, 1e-3, 20, &mut found).unwrap();
        assert!(found.iter().all(Result::is_ok), "{found:?}");
        for (start, end) in states(count).iter().zip(&run) {
            let step = |state, _| craft.step(&state, &inputs, 1e-3).unwrap();
            assert_eq!((0..20).fold(*start, step), *end);
        }
    }
}

#[test]
fn each_state_has_its_own_error_and_the_others_their_result() {
    let (craft, batch) =
        (Spacecraft::new(&hub(), &mixed()).unwrap(), Batch::new(&hub(), &mixed()).unwrap());
    let mut states = states(9);
    let mut each: Vec<_> = (0..9).map(inputs).collect();
    states[1].omega.x = f64::NAN;
    states[2].r_b_n.y = f64::INFINITY;
    states[3].attitude.q0 = 0.0;
    states[3].attitude.q1 = 0.0;
    each[4].modes.0[0].wheel = Mode::Locked;
    each[5].hub = HubMode::Fixed;
    each[6].gravity = Gravity::Central { mu: 4e14 };
    states[7].devices.0[0].theta = 1e9;
    each[8].force.z = f64::MAX;
    states[8].omega.z = 1e160;
    let mut found = Vec::new();
    batch.accelerations(&states, &each, &mut found).unwrap();
    for (k, (state, inputs)) in states.iter().zip(&each).enumerate() {
        let single = craft.accelerations(state, inputs);
        assert_eq!(format!("{:?}", found[k]), format!("{single:?}"), "state {k}");
    }
    let rejected: Vec<_> = found.iter().map(Result::is_err).collect();
    assert_eq!(rejected, [false, true, true, true, true, true, false, false, true]);
    // A run that fails is left where the last step that did not fail led.
    let (mut run, mut ends) = (states.clone(), Vec::new());
    batch.run(&mut run, &each, 1e-3, 3, &mut ends).unwrap();
    for (k, (start, inputs)) in states.iter().zip(&each).enumerate() {
        let mut state = *start;
        let end = (0..3).try_for_each(|_| {
            state = craft.step(&state, inputs, 1e-3)?;
            Ok::<_, SolveError<f64>>(())
        });
        assert_eq!(format!("{:?}", (run[k], &ends[k])), format!("{:?}", (state, &end)), "run {k}");
    }
}

#[test]
fn inputs_for_another_number_of_states_are_rejected() {
    let batch = Batch::new(&hub(), &mixed()).unwrap();
    let each: Vec<_> = (0..3).map(inputs).collect();
    assert!(batch.accelerations(&states(2), &each, &mut Vec::new()).is_err());
}

#[test]
fn singular_device_is_named_across_lanes() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let devices = [Dgvscmg::bare_wheel(4.0, disc); 11];
    let craft = Spacecraft::new(&hub(), &devices).unwrap();
    let mut state: State<[Dgvscmg; 11]> = State::at_rest();
    state.devices[9].gamma_i = core::f64::consts::FRAC_PI_2;
    let expected = one_after_another(&craft).accelerations(&state, &Inputs::none());
    assert!(expected.is_err());
    assert_eq!(craft.accelerations(&state, &Inputs::none()), expected);
}

#[test]
fn steps_across_devices_follow_single_steps() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let devices = [Sgcmg { d: 1e-4, ..Sgcmg::bare_wheel(4.0, disc) }; 5];
    let craft = Spacecraft::new(&hub(), &devices).unwrap();
    let mut state: State<[Sgcmg; 5]> = State::at_rest();
    state.omega.x = 0.1;
    state.devices[3].spin = 400.0;
    let inputs = Inputs::none();
    let there = craft.step(&state, &inputs, 1e-3).unwrap();
    let single = one_after_another(&craft).step(&state, &inputs, 1e-3).unwrap();
    assert_eq!(there, single);
}

/// A thread keeps the slots of a batch between calls: with springs and friction, wrenches, given accelerations, and a state
/// that is not finite before it, the next call has the bits of single evaluations.
#[test]
fn what_a_call_leaves_on_its_thread_reaches_no_result_of_the_next() {
    for count in [3, 5, 3] {
        let devices = vec![dgvscmg::<f64>(); count];
        let sound = Measured::new(&devices);
        let mut sprung = devices.clone();
        for device in &mut sprung {
            device.passive.outer_gimbal = Passive::spring(3.0, 0.1);
            device.passive.inner_gimbal = Passive::friction(0.1, 0.2, 0.3);
        }
        let Measured { craft, mut state, mut inputs } = Measured::new(&sprung);
        for mode in inputs.modes.values_mut() {
            *mode = Mode::Prescribed(0.7);
        }
        let mut bodies = Inputs::no_wrenches_for(&craft);
        for wrench in bodies.values_mut() {
            wrench.force = Vector3::new(1.0, -2.0, 3.0);
        }
        inputs.bodies = Some(bodies);
        state.devices[0].gamma_o_dot = f64::NAN;
        let mut found = Vec::new();
        let spoilt = Batch::new(&measured::hub(), &sprung).unwrap();
        spoilt.accelerations(&[state.clone(), state], &inputs, &mut found).unwrap();
        assert!(found.iter().all(Result::is_err));

        let batch = Batch::new(&measured::hub(), &devices).unwrap();
        batch.accelerations(std::slice::from_ref(&sound.state), &sound.inputs, &mut found).unwrap();
        assert_eq!(found, [sound.accelerations()]);
    }
}
