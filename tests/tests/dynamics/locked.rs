//! A locked joint keeps the bits of its coordinate, those of -0.0 too, in every step and run: by
//! itself, with work, listed, in single precision, across devices, in batches, on a flexible structure.

use nalgebra::{Matrix3, Vector3};
#[cfg(feature = "lanes")]
use precess_dynamics::lanes::Batch;
use precess_dynamics::{
    BuiltIn, FixedModes, Flexible, Hub, Inputs, Isolated, JointStates, ModalMount, ModalPoint,
    Mode, Modes, Platform, Quaternion, Scalar, Sgcmg, Spacecraft, State, Suspension,
};

#[cfg(feature = "lanes")]
use super::{lanes::one_after_another, parameter_batch::printed};

/// Five gyros, which fill more than one register of lanes: each gimbal is locked, each wheel turns.
type Set<T = f64> = [Sgcmg<T>; 5];

/// Coordinates of the locked gimbals, rad.
const LOCKED: [f64; 5] = [-0.0, 0.0, 0.25, -1.5, -0.0];

/// Length of a step, s, and steps of a run.
const DT: f64 = 1e-3;
const STEPS: usize = 40;

fn hub<T: Scalar>() -> Hub<T> {
    let number = T::from_f64;
    let i_b_bc = (Matrix3::identity() * 60.0).map(number);
    Hub { m_b: number(60.0), r_bc_b: Vector3::zeros().map(number), i_b_bc }
}

fn devices<T: Scalar>() -> Set<T> {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01)).map(T::from_f64);
    [Sgcmg { d: T::from_f64(1e-4), ..Sgcmg::bare_wheel(T::from_f64(3.0), disc) }; 5]
}

fn state<T: Scalar>() -> State<Set<T>> {
    let mut state: State<Set<T>> = State::at_rest();
    state.omega = Vector3::new(0.1, -0.2, 0.05).map(T::from_f64);
    for (joints, gamma) in state.devices.iter_mut().zip(LOCKED) {
        (joints.gamma, joints.spin) = (T::from_f64(gamma), T::from_f64(300.0));
    }
    state
}

fn inputs<T: Scalar>() -> Inputs<Set<T>> {
    let mut inputs: Inputs<Set<T>> = Inputs::none();
    for (modes, motors) in inputs.modes.iter_mut().zip(&mut inputs.motors) {
        (modes.gimbal, motors.u_w) = (Mode::Locked, T::from_f64(0.1));
    }
    inputs
}

/// Compares the gimbals, the first joint of every two, by their bits.
#[track_caller]
fn kept<T: Scalar>(path: &str, joints: &impl JointStates<T>) {
    let gimbals: Vec<u64> = joints.states().step_by(2).map(|[q, _]| q.to_f64().to_bits()).collect();
    assert_eq!(gimbals, LOCKED.map(f64::to_bits), "{path}");
}

#[test]
fn steps_of_one_spacecraft_keep_locked_coordinates() {
    fn steps<T: Scalar>(path: &str) {
        let craft = Spacecraft::new(&hub::<T>(), &devices()).unwrap();
        let (inputs, dt) = (inputs(), T::from_f64(DT));
        let (mut now, mut with_work) = (state(), state());
        for _ in 0..STEPS {
            now = craft.step(&now, &inputs, dt).unwrap();
            with_work = craft.step_with_work(&with_work, &inputs, dt).unwrap().state;
        }
        kept(path, &now.devices);
        kept(path, &with_work.devices);
        assert!(now.devices.iter().all(|joints| joints.theta > T::ZERO), "{path}: a wheel rests");
        kept(path, &craft.stop(&state(), &inputs).unwrap().state.devices);
    }
    steps::<f64>("step");
    steps::<f32>("step in single precision");

    let list: Vec<BuiltIn> = devices().map(BuiltIn::from).to_vec();
    let craft = Spacecraft::new(&hub(), &list).unwrap();
    let mut now: State<Vec<BuiltIn>> = State::at_rest_for(&craft);
    let mut given = Inputs::none_for(&craft);
    for (to, from) in now.devices.states_mut().zip(state::<f64>().devices.states()) {
        (*to[0], *to[1]) = (from[0], from[1]);
    }
    given.modes.iter_mut().for_each(|modes| modes.as_mut_slice()[0] = Mode::Locked);
    for _ in 0..STEPS {
        now = craft.step(&now, &given, DT).unwrap();
    }
    kept("step of a list", &now.devices);
}

#[cfg(feature = "lanes")]
#[test]
fn lanes_keep_locked_coordinates_and_have_the_bits_of_steps() {
    let (inputs, devices) = (inputs::<f64>(), devices());
    let craft = Spacecraft::new(&hub(), &devices).unwrap();
    let mut alone = state();
    let in_order = one_after_another(&craft);
    let mut side_by_side = state();
    for _ in 0..STEPS {
        alone = in_order.step(&alone, &inputs, DT).unwrap();
        side_by_side = craft.step(&side_by_side, &inputs, DT).unwrap();
    }
    kept("step across devices", &side_by_side.devices);
    assert_eq!(printed(&side_by_side), printed(&alone));

    let batch = Batch::new(&hub(), &devices).unwrap();
    let each = Batch::from_spacecraft(vec![craft; 9]);
    let (mut states, mut ends) = (vec![state(); 9], Vec::new());
    batch.run(&mut states, &inputs, DT, STEPS, &mut ends).unwrap();
    let mut others = vec![state(); 9];
    each.run(&mut others, &inputs, DT, STEPS, &mut ends).unwrap();
    for now in states.iter().chain(&others) {
        kept("run of a batch", &now.devices);
        assert_eq!(printed(now), printed(&alone), "other bits than steps");
    }
}

#[test]
fn steps_on_a_flexible_structure_and_a_platform_keep_locked_coordinates() {
    type Modal = FixedModes<1, 1>;
    let modes: Modes<Modal> = Modes {
        frequencies: [20.0],
        damping: [0.01],
        linear: [Vector3::new(0.0, 0.0, 0.3)],
        angular: [Vector3::zeros()],
        mounts: [ModalMount {
            point: ModalPoint {
                position: Vector3::zeros(),
                translation: [Vector3::new(0.0, 0.0, 0.1)],
                rotation: [Vector3::zeros()],
            },
            contained: None,
        }],
    };
    let craft = Spacecraft::flexible(&hub(), &modes, &devices(), &[0; 5]).unwrap();
    let mut given: Inputs<Set, Flexible<Modal>> = Inputs::none_for(&craft);
    given = inputs().with_modal(given.modal);
    let mut now: State<Set, Quaternion, Flexible<Modal>> = State::at_rest_for(&craft);
    now = state().with_modal(now.modal);
    now.modal.eta[0] = 1e-3;
    for _ in 0..STEPS {
        now = craft.step(&now, &given, DT).unwrap();
    }
    kept("step of a structure", &now.devices);

    let platform = Platform::bare(10.0, Matrix3::identity());
    let isolated = Isolated { platform, suspension: Suspension::none(), carried: devices() };
    let craft = Spacecraft::new(&hub(), &isolated).unwrap();
    let mut now: State<Isolated<Set>> = State::at_rest();
    let mut inputs: Inputs<Isolated<Set>> = Inputs::none();
    (now.devices.carried, inputs.modes.carried) = (state().devices, self::inputs().modes);
    now.devices.platform.z_dot = 0.1;
    for _ in 0..STEPS {
        now = craft.step(&now, &inputs, DT).unwrap();
    }
    kept("step of what a platform carries", &now.devices.carried);
    assert!(now.devices.platform.z > 0.0, "the platform rests");
}
