//! Terms of every kind, summed, are the moment that inverse dynamics finds; momenta those of a hub at rest.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, Kind};
use precess_dynamics::{
    About, Accelerations, Devices, Hub, Inputs, LoadAxes, ReactionWheel, Sgcmg, Spacecraft, State,
    Steered, SteeringError, SteeringTerms, Vscmg,
};
use precess_tests::measured::{EachKind, Measured, each_kind};
use precess_tests::random::{SEED, Sample};

/// Rounding of sums over bodies that are heavier and further out than what is left.
const TOLERANCE: f64 = 1e-12;

/// The moment about B on the devices, by inverse dynamics: what the hub lacks without them.
fn by_loads<D: Devices<Scalar = f64>>(
    craft: &Spacecraft<D>,
    bare: &Spacecraft<[Vscmg; 0]>,
    state: &State<D>,
    accelerations: &Accelerations<D>,
) -> Vector3<f64> {
    let inputs = Inputs::none_for(craft);
    let whole = craft.loads(state, &inputs, accelerations, LoadAxes::Hub).unwrap();
    let mut alone: State<[Vscmg; 0]> = State::at_rest();
    (alone.r_b_n, alone.r_b_n_dot) = (state.r_b_n, state.r_b_n_dot);
    (alone.attitude, alone.omega) = (state.attitude, state.omega);
    let accelerations = Accelerations {
        r_b_n_ddot: accelerations.r_b_n_ddot,
        omega_dot: accelerations.omega_dot,
        devices: [],
        modal: (),
    };
    let own = bare.loads(&alone, &Inputs::none(), &accelerations, LoadAxes::Hub).unwrap();
    whole.hub.moment - own.hub.moment
}

fn compare<D: Devices<Scalar = f64>, const N: usize>(
    whose: &str,
    hub: &Hub,
    craft: &Spacecraft<D>,
    state: &State<D>,
    accelerations: &Accelerations<D>,
) {
    let terms: SteeringTerms<f64, N> = craft.steering_terms(state).unwrap();
    let mut joints = [0.0; N];
    for (to, from) in joints.iter_mut().zip(accelerations.devices.values()) {
        *to = from;
    }
    let (omega_dot, r_b_n_ddot) = (accelerations.omega_dot, accelerations.r_b_n_ddot);
    let found = terms.moment(&joints, &omega_dot, &r_b_n_ddot);
    let bare = Spacecraft::new(hub, &[]).unwrap();
    let expected = by_loads(craft, &bare, state, accelerations);
    let by_rate = terms.by_rate.iter().zip(terms.rates).map(|(n, rate)| n.norm() * rate.abs());
    let by_acceleration =
        terms.by_acceleration.iter().zip(joints).map(|(n, joint)| n.norm() * joint.abs());
    let sizes = [
        (terms.inertia * omega_dot).norm(),
        terms.first_moment.cross(&r_b_n_ddot).norm(),
        terms.gyroscopic.norm(),
        (hub.i_b_bc * omega_dot).norm(),
    ];
    let size: f64 = by_rate.chain(by_acceleration).chain(sizes).sum();
    let error = (found - expected).norm();
    assert!(error <= TOLERANCE * size, "{whose}: {error:e} of {size:e}");

    let mut at_rest = state.clone();
    (at_rest.omega, at_rest.r_b_n_dot) = (Vector3::zeros(), Vector3::zeros());
    at_rest.attitude = State::<[Vscmg; 0]>::at_rest().attitude;
    at_rest.r_b_n = Vector3::zeros();
    let momentum = craft.momentum(&at_rest, About::InertialOrigin).unwrap().angular;
    let of_joints = terms.by_acceleration.iter().zip(terms.rates);
    let size: f64 = of_joints.map(|(n, rate)| n.norm() * rate.abs()).sum();
    let error = (terms.momentum - momentum).norm();
    assert!(error <= TOLERANCE * size, "{whose}: momentum {error:e} of {size:e}");
}

#[test]
fn terms_of_random_spacecraft_sum_to_the_moment() {
    for seed in SEED..SEED + precess_tests::cases(200) {
        let sample = Sample::<2>::new(seed);
        let case = sample.case::<f64>();
        let (craft, solved) = (case.spacecraft(sample), case.solved(sample));
        compare::<_, 6>(&sample.to_string(), &case.hub, &craft, &case.state, &solved);
    }
}

/// Two devices of each kind.
struct Pairs(usize);

impl EachKind<f64> for Pairs {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        self.0 += 1;
        let measured = Measured::new(&[device; 2]);
        let accelerations = measured.accelerations().unwrap();
        let (hub, craft, state) =
            (precess_tests::measured::hub(), &measured.craft, &measured.state);
        match K::JOINTS.len() {
            1 => compare::<_, 2>(name, &hub, craft, state, &accelerations),
            2 => compare::<_, 4>(name, &hub, craft, state, &accelerations),
            3 => compare::<_, 6>(name, &hub, craft, state, &accelerations),
            5 => compare::<_, 10>(name, &hub, craft, state, &accelerations),
            6 => compare::<_, 12>(name, &hub, craft, state, &accelerations),
            7 => compare::<_, 14>(name, &hub, craft, state, &accelerations),
            count => panic!("{name} has {count} joints: a case of its own"),
        }
    }
}

#[test]
fn terms_of_every_kind_sum_to_the_moment() {
    let mut pairs = Pairs(0);
    each_kind(&mut pairs);
    assert_eq!(pairs.0, 14);
}

#[test]
fn a_mixed_set_has_its_joints_in_order_and_another_number_is_an_error() {
    let inertia = nalgebra::Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let devices = (
        [ReactionWheel::bare_wheel(4.0, inertia); 2],
        Sgcmg::bare_wheel(4.0, inertia),
        Vscmg::bare_wheel(4.0, inertia),
    );
    let measured = Measured::new(&devices);
    let accelerations = measured.accelerations().unwrap();
    let hub = precess_tests::measured::hub();
    compare::<_, 6>("mixed", &hub, &measured.craft, &measured.state, &accelerations);
    let refused = measured.craft.steering_terms::<_, 5>(&measured.state).unwrap_err();
    assert_eq!(refused, SteeringError::Joints { expected: 6, found: 5 });
    assert_eq!(refused.to_string(), "arrays of 5 for 6 joints; give one element per joint");
    // Room for more joints: what is beyond the last one is zero.
    let [exact, roomy] = [
        measured.craft.steering_terms::<_, 6>(&measured.state).map(|of| of.by_rate.to_vec()),
        measured.craft.steering_terms::<_, 9>(&measured.state).map(|of| of.by_rate.to_vec()),
    ]
    .map(Result::unwrap);
    assert_eq!(roomy, [exact, vec![Vector3::zeros(); 3]].concat());
}

#[test]
fn a_matrix_splits_the_terms_without_loss() {
    let sample = Sample::<2>::new(SEED);
    let case = sample.case::<f64>();
    let craft = case.spacecraft(sample);
    let terms: SteeringTerms<f64, 6> = craft.steering_terms(&case.state).unwrap();
    let steered = [
        [Steered::Rate, Steered::Rate, Steered::Acceleration],
        [Steered::Rate, Steered::Nothing, Steered::Nothing],
    ];
    let steered = [steered[0], steered[1]].concat().try_into().unwrap();
    let matrix = terms.matrix(&steered);
    let rates = terms.rates;
    let commands = [rates[0], rates[1], 3.0, rates[3], 9.0, 9.0];
    // The gimbals at their rates, one wheel accelerating, nothing else.
    let accelerations = [0.0, 0.0, 3.0, 0.0, 0.0, 0.0];
    let whole = terms.moment(&accelerations, &Vector3::zeros(), &Vector3::zeros());
    let error = (matrix.torque(&commands) + whole).norm();
    assert!(error < 1e-13 * whole.norm(), "{error:e}");
    assert_eq!(matrix.times(&[0.0, 0.0, 0.0, 0.0, 1.0, 1.0]), Vector3::zeros());
}
