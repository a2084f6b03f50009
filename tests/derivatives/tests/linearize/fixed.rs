//! [`Spacecraft::linearize_fixed`]: the numbers of `linearize_into`, without a heap, and what is rejected.

use allocation_counter::measure;
use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates, Kind};
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    DerivativeError, Dgvscmg, Gravity, HubMode, Inputs, Linearization, LinearizationWorkspace,
    Mode, Outputs, Passive, ReactionWheel, Sgcmg, SolveError, Spacecraft, State,
};
use precess_tests::cases;
use precess_tests::measured::{EachKind, Measured, dgvscmg, each_kind, hub};

use crate::draw::{Drawn, SEED};

/// How many spacecraft.
const SPACECRAFT: u64 = 240;

/// Joints of the largest spacecraft.
const JOINTS: usize = 24;

type Workspace = LinearizationWorkspace<f64, JOINTS>;

/// Both matrices, of the size that they have, full of NaN.
fn matrices<D: WithNumbers<Scalar = f64>>(
    craft: &Spacecraft<D>,
    inputs: &Inputs<D>,
) -> [Vec<f64>; 2] {
    let states = craft.state_variables(inputs).count();
    let columns = [states, craft.input_variables(inputs).count()];
    columns.map(|columns| vec![f64::NAN; states * columns])
}

/// Holds both matrices to those of `linearize`; false where there are no emitted derivatives.
fn agrees<D: WithNumbers<Scalar = f64>>(
    craft: &Spacecraft<D>,
    (state, inputs): (&State<D>, &Inputs<D>),
    workspace: &mut Workspace,
    bits: bool,
) -> bool {
    let [mut a, mut b] = matrices(craft, inputs);
    let found = craft.linearize_fixed(state, inputs, [&mut a, &mut b], workspace);
    if found == Err(DerivativeError::NotEmitted) {
        return false;
    }
    let expected: Linearization<D> =
        craft.linearize(state, inputs, &Outputs::accelerations()).unwrap();
    assert_eq!(found.unwrap(), expected.accelerations);
    for (found, expected) in [(&a, &expected.a), (&b, &expected.b)] {
        // NaN equals nothing.
        assert_eq!(found.as_slice(), expected.as_slice());
        let same = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits();
        assert!(!bits || found.iter().zip(expected.as_slice()).all(same), "{found:?} {expected}");
    }
    true
}

#[test]
fn random_spacecraft_have_the_numbers_of_linearize() {
    let (mut workspace, mut emitted, count) = (Workspace::new(), 0, cases(SPACECRAFT));
    for seed in SEED..SEED + count {
        for mut drawn in [Drawn::new(seed), Drawn::on_bearings(seed)] {
            drawn.case.inputs.bodies = None;
            if matches!(drawn.case.inputs.gravity, Gravity::Central { .. }) {
                drawn.case.inputs.gravity = Gravity::Uniform(Vector3::new(0.3, -9.7, 1.1));
            }
            let case = drawn.case::<f64>();
            let at = (&case.state, &case.inputs);
            let found = agrees(&case.craft(), at, &mut workspace, false);
            // Nothing else is without emitted derivatives.
            assert!(found || format!("{:?}", case.devices).contains("Lumped"), "{seed:#x}");
            emitted += u64::from(found);
        }
    }
    println!("{emitted} of {} with emitted derivatives", 2 * count);
    assert!(2 * emitted > count, "{emitted} of {}", 2 * count);
}

/// One, two and nine devices of each kind, as arrays and in a tuple.
struct Sets(Workspace);

impl EachKind<f64> for Sets {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        self.check(name, &device);
        self.check(name, &[device; 2]);
        self.check(name, &([device; 2], dgvscmg(), device));
    }
}

impl Sets {
    fn check<D: WithNumbers<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        let Measured { craft, state, mut inputs } = Measured::new(devices);
        let prescribed = HubMode::Prescribed { r_b_n_ddot: Vector3::x(), omega_dot: Vector3::y() };
        for gravity in [Gravity::None, Gravity::Uniform(Vector3::new(0.1, 0.2, -9.8))] {
            inputs.gravity = gravity;
            for hub in [HubMode::Free, prescribed, HubMode::Fixed] {
                inputs.hub = hub;
                for mode in [Mode::Driven, Mode::Locked] {
                    let (mut state, mut inputs) = (state.clone(), inputs.clone());
                    *inputs.modes.values_mut().next().unwrap() = mode;
                    if mode == Mode::Locked {
                        *state.devices.states_mut().next().unwrap()[1] = 0.0;
                    }
                    if hub == HubMode::Fixed {
                        (state.r_b_n_dot, state.omega) = (Vector3::zeros(), Vector3::zeros());
                    }
                    let at = (&state, &inputs);
                    assert!(agrees(&craft, at, &mut self.0, mode == Mode::Driven), "{name}");
                }
            }
        }
    }
}

#[test]
fn sets_of_every_kind_have_the_bits_of_linearize() {
    each_kind(&mut Sets(Workspace::new()));
}

#[test]
fn nothing_is_allocated() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.12));
    let gyro = Dgvscmg { d: 1e-3, ..Dgvscmg::bare_wheel(4.0, inertia) };
    let wheel = ReactionWheel { d: 1e-3, ..ReactionWheel::bare_wheel(4.0, inertia) };
    let devices = ([wheel; 3], Sgcmg::bare_wheel(4.0, inertia), [gyro; 2]);
    let Measured { craft, state, inputs } = Measured::new(&devices);
    let [mut a, mut b] = matrices(&craft, &inputs);
    let mut workspace = Workspace::new();
    let mut call = || {
        let into = [a.as_mut_slice(), b.as_mut_slice()];
        assert!(craft.linearize_fixed(&state, &inputs, into, &mut workspace).is_ok());
    };
    // With lanes, the first evaluation of a thread allocates what its others take.
    call();
    assert_eq!(measure(call).count_total, 0);
}

#[test]
fn what_has_another_size_is_rejected() {
    let Measured { craft, state, inputs } = Measured::new(&[dgvscmg::<f64>(); 2]);
    let [mut a, mut b] = matrices(&craft, &inputs);
    let mut workspace = Workspace::new();
    let (states, columns) = (24, 12);
    let found = craft.linearize_fixed(&state, &inputs, [&mut a[1..], &mut b], &mut workspace);
    let expected = states * states;
    let size = DerivativeError::Size { expected, found: expected - 1 };
    assert_eq!(found, Err(size));
    b.push(0.0);
    let found = craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut workspace);
    let expected = states * columns;
    assert_eq!(found, Err(DerivativeError::Size { expected, found: expected + 1 }));
    b.pop();
    let mut small = LinearizationWorkspace::<f64, 5>::default();
    let found = craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut small);
    assert_eq!(found, Err(DerivativeError::Size { expected: 6, found: 5 }));
    let mut exact = LinearizationWorkspace::<f64, 6>::new();
    assert!(craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut exact).is_ok());
}

#[test]
fn what_has_no_derivatives_is_rejected() {
    let mut wheel = ReactionWheel::bare_wheel(4.0, Matrix3::identity() * 1e-9);
    wheel.passive.wheel = Passive::spring(1e300, 0.0);
    let craft = Spacecraft::new(&hub(), &[wheel]).unwrap();
    let (mut state, mut inputs): (State<[ReactionWheel; 1]>, _) =
        (State::at_rest(), Inputs::none());
    let [mut a, mut b] = matrices(&craft, &inputs);
    let mut workspace = Workspace::new();
    // An acceleration of zero, whose derivative by the angle is -1e300 N m/rad over 1e-9 kg m².
    let found = craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut workspace);
    let expected = craft.linearize(&state, &inputs, &Outputs::accelerations()).map(|_| ());
    assert_eq!(expected, Err(DerivativeError::NotFinite { variable: 12 }));
    assert_eq!(found.map(|_| ()), expected);
    inputs.gravity = Gravity::Central { mu: 3.986e14 };
    state.r_b_n.x = 7e6;
    let found = craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut workspace);
    assert_eq!(found, Err(DerivativeError::NotEmitted));
    state.omega.x = f64::INFINITY;
    let found = craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut workspace);
    assert!(
        matches!(found, Err(DerivativeError::Solve(SolveError::NotFinite { .. }))),
        "{found:?}"
    );
}
