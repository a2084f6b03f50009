//! A locked joint keeps the bits of its coordinate, those of -0.0 too, in every step and run: by
//! itself, with work, listed, in single precision, on a flexible structure. In lanes: `lanes/locked.rs`.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BuiltIn, FixedModes, Flexible, Inputs, Isolated, JointStates, ModalMount, ModalPoint, Mode,
    Modes, Platform, Quaternion, Scalar, Spacecraft, State, Suspension,
};

use super::locked_gyros::{DT, STEPS, Set, devices, hub, inputs, kept, state};

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
    let isolated =
        Isolated { carrier: platform, suspension: Suspension::none(), carried: devices() };
    let craft = Spacecraft::new(&hub(), &isolated).unwrap();
    let mut now: State<Isolated<Set>> = State::at_rest();
    let mut inputs: Inputs<Isolated<Set>> = Inputs::none();
    (now.devices.carried, inputs.modes.carried) = (state().devices, self::inputs().modes);
    now.devices.carrier.z_dot = 0.1;
    for _ in 0..STEPS {
        now = craft.step(&now, &inputs, DT).unwrap();
    }
    kept("step of what a platform carries", &now.devices.carried);
    assert!(now.devices.carrier.z > 0.0, "the platform rests");
}
