//! A platform by itself is a kind of device: as an isolated set that carries nothing, in lanes, in
//! single precision.

use nalgebra::{Matrix3, Vector3};
#[cfg(feature = "lanes")]
use precess_dynamics::lanes::Batch;
use precess_dynamics::{
    Each, Hub, Inputs, Isolated, JointStates, LoadAxes, Passive, Platform, ReactionWheel, Scalar,
    Spacecraft, State, Suspension, platform,
};
use precess_tests::bounds::SINGLE_PRECISION;
#[cfg(feature = "lanes")]
use precess_tests::random::Random;

/// Rates and coordinates of the tests: an arbitrary pose far from the singular one.
const STATE: [[f64; 2]; 6] =
    [[0.03, 0.2], [-0.02, -0.1], [0.01, 0.3], [0.4, -0.6], [-0.7, 0.5], [1.1, 0.8]];

fn hub<T: Scalar>() -> Hub<T> {
    let number = T::from_f64;
    let inertia = Matrix3::from_diagonal(&Vector3::new(9.0, 8.0, 6.0));
    Hub {
        m_b: number(90.0),
        r_bc_b: Vector3::new(number(0.1), number(-0.2), number(0.05)),
        i_b_bc: inertia.map(T::from_f64),
    }
}

fn platform<T: Scalar>() -> Platform<T> {
    let (spring, number) = (Passive::spring(300.0, 4.0).map(T::from_f64), T::from_f64);
    let inertia = Matrix3::new(0.3, 0.02, -0.01, 0.02, 0.4, 0.03, -0.01, 0.03, 0.5);
    Platform {
        r_p_b: Vector3::new(number(0.3), number(0.1), number(-0.2)),
        r_pc_p: Vector3::new(number(0.02), number(-0.05), number(0.04)),
        passive: platform::PerJoint::all(spring),
        ..Platform::bare(number(7.0), inertia.map(T::from_f64))
    }
}

#[test]
fn platform_by_itself_is_an_isolated_set_that_carries_nothing() {
    type Bare = Isolated<[ReactionWheel; 0]>;
    let alone = Spacecraft::new(&hub(), &platform::<f64>()).expect("sound");
    let suspension = Suspension::none();
    let set = Isolated { carrier: platform(), suspension, carried: [] };
    let carrying = Spacecraft::new(&hub(), &set).expect("sound");
    let mut state: State<Platform> = State::at_rest();
    for ([q, rate], [of_q, of_rate]) in state.devices.states_mut().zip(STATE) {
        (*q, *rate) = (of_q, of_rate);
    }
    state.omega = Vector3::new(0.2, -0.3, 0.5);
    let mut with: State<Bare> = State::at_rest();
    (with.omega, with.devices.carrier) = (state.omega, state.devices);
    let found = alone.accelerations(&state, &Inputs::none()).expect("regular");
    let expected = carrying.accelerations(&with, &Inputs::none()).expect("regular");
    assert_eq!(found.r_b_n_ddot, expected.r_b_n_ddot);
    assert_eq!(found.omega_dot, expected.omega_dot);
    assert_eq!(found.devices, expected.devices.carrier);
    let loads = alone.loads(&state, &Inputs::none(), &found, LoadAxes::Parent).expect("finite");
    let of_set = carrying.loads(&with, &Inputs::none(), &expected, LoadAxes::Parent);
    assert_eq!(loads.devices, of_set.expect("finite").devices.carrier);
}

#[cfg(feature = "lanes")]
#[test]
fn platform_in_lanes_has_the_bits_of_the_scalar_path() {
    let (hub, devices) = (hub(), [platform::<f64>(); 2]);
    let craft = Spacecraft::new(&hub, &devices).expect("sound");
    let random = &mut Random::new(11);
    let states: Vec<State<[Platform; 2]>> = (0..9)
        .map(|_| {
            let mut state: State<[Platform; 2]> = State::at_rest();
            state.omega = random.vector(0.5);
            for [q, rate] in state.devices.states_mut() {
                (*q, *rate) = (random.within(-0.5, 0.5), random.within(-1.0, 1.0));
            }
            state
        })
        .collect();
    let inputs = Inputs::none();
    let batch = Batch::new(&hub, &devices).expect("sound");
    let mut found = Vec::new();
    batch.accelerations(&states, &inputs, &mut found).expect("of one length");
    for (state, found) in states.iter().zip(found) {
        assert_eq!(found, craft.accelerations(state, &inputs));
    }
}

#[test]
fn single_precision_is_that_of_its_digits() {
    fn found<T: Scalar>() -> Vec<f64> {
        type Set<T> = Isolated<ReactionWheel<T>>;
        let number = T::from_f64;
        let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01)).map(T::from_f64);
        let carried =
            ReactionWheel { d: number(1e-3), ..ReactionWheel::bare_wheel(number(3.0), disc) };
        let suspension = Suspension::none();
        let set = Isolated { carrier: platform(), suspension, carried };
        let craft: Spacecraft<Set<T>> = Spacecraft::new(&hub(), &set).expect("sound");
        let mut state: State<Set<T>> = State::at_rest();
        for ([q, rate], [of_q, of_rate]) in state.devices.states_mut().zip(STATE) {
            (*q, *rate) = (number(of_q), number(of_rate));
        }
        state.devices.carried.spin = number(40.0);
        let found = craft.accelerations(&state, &Inputs::none()).expect("regular");
        found.devices.carrier.values().map(Scalar::to_f64).collect()
    }
    let (single, double) = (found::<f32>(), found::<f64>());
    let unit = double.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    for (single, double) in single.iter().zip(&double) {
        assert!((single - double).abs() < SINGLE_PRECISION * unit, "{single}, not {double}");
    }
}
