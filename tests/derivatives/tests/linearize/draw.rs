//! Random spacecraft of every kind, joint mode, mode of the hub and gravity, in any scalar.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{BodyParameters, Each, JointStates, Kind, Value};
use precess_dynamics::set::{Change, WithNumbers};
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, BuiltIn,
    Dgcmg, Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, Gravity, HingedPanel, Hub, HubMode,
    ImbalanceModel, Inputs, Mode, Passive, Quaternion, ReactionWheel, Scalar, Sgcmg, SloshMass,
    Spacecraft, State, Vscmg, Wrench,
};
use precess_tests::bearings::{clearance, sprung};
use precess_tests::random::Random;

/// A list of devices of any kinds.
pub(crate) type List<T = f64> = Vec<BuiltIn<T>>;

/// A spacecraft in a state under inputs.
#[derive(Clone, Debug)]
pub(crate) struct Case<T: Scalar> {
    pub(crate) hub: Hub<T>,
    pub(crate) devices: List<T>,
    pub(crate) state: State<List<T>>,
    pub(crate) inputs: Inputs<List<T>>,
}

/// What is drawn, with the rotation of each mount, from which it is computed in each scalar.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    pub(crate) seed: u64,
    pub(crate) case: Case<f64>,
    mounts: Vec<[f64; 4]>,
}

/// Spacecraft `n` is drawn from `SEED + n`.
pub(crate) const SEED: u64 = 0x11EA_5123;

/// 6000 rpm.
const FASTEST_WHEEL: f64 = 628.0;

/// How a device of a kind is drawn.
type Draw = fn(&mut Random, f64) -> BuiltIn;

/// The kinds without flexible bearings.
const KINDS: [Draw; 12] = [
    device::<Dgvscmg>,
    device::<BalancedDgvscmg>,
    device::<Dgcmg>,
    device::<BalancedDgcmg>,
    device::<Vscmg>,
    device::<BalancedVscmg>,
    device::<Sgcmg>,
    device::<BalancedSgcmg>,
    device::<ReactionWheel>,
    device::<BalancedReactionWheel>,
    device::<HingedPanel>,
    device::<SloshMass>,
];

/// Those with.
const ON_BEARINGS: [Draw; 2] = [device::<FlexibleReactionWheel>, device::<FlexibleVscmg>];

impl Drawn {
    /// The spacecraft of a seed: one to three devices without flexible bearings, the kinds in turn.
    pub(crate) fn new(seed: u64) -> Self {
        Self::with_first(KINDS[usize::try_from(seed % 12).unwrap()], seed)
    }

    /// The same, but that the first device has flexible bearings.
    pub(crate) fn on_bearings(seed: u64) -> Self {
        Self::with_first(ON_BEARINGS[usize::try_from(seed % 2).unwrap()], seed)
    }

    fn with_first(first: Draw, seed: u64) -> Self {
        let random = &mut Random::new(seed);
        let m_b = random.log_within(10.0, 5000.0);
        let reach = random.within(0.0, 1.0);
        let hub = Hub { m_b, r_bc_b: random.vector(reach), i_b_bc: block(random, m_b) };
        let count = 1 + random.bits() % 3;
        let draw = |k: u64, random: &mut Random| match k {
            0 => first,
            _ => KINDS[usize::try_from(random.bits() % 12).unwrap()],
        };
        let devices: List = (0..count).map(|k| draw(k, random)(random, m_b)).collect();
        let mut drawn = Self {
            seed,
            mounts: devices.iter().map(|_| quaternion(random)).collect(),
            case: still(hub, devices),
        };
        drawn.case.devices.change(&mut Mounts(drawn.mounts.iter()));
        drawn.set_in_motion(random);
        drawn
    }

    /// State and inputs.
    fn set_in_motion(&mut self, random: &mut Random) {
        let Case { hub, devices, state, inputs } = &mut self.case;
        let craft = Spacecraft::new(hub, devices).unwrap();
        let [q0, q1, q2, q3] = quaternion(random);
        state.attitude = Quaternion { q0, q1, q2, q3 };
        state.r_b_n = random.vector(7e6);
        inputs.gravity = match random.bits() % 3 {
            0 => Gravity::Uniform(random.vector(9.8)),
            1 => Gravity::Central { mu: 3.986e14 },
            _ => Gravity::None,
        };
        if !matches!(inputs.gravity, Gravity::Central { .. }) {
            state.r_b_n = random.vector(50.0);
        }
        inputs.hub = match random.bits() % 6 {
            0 => HubMode::Fixed,
            1 => HubMode::Prescribed {
                r_b_n_ddot: random.vector(1.0),
                omega_dot: random.vector(0.3),
            },
            _ => HubMode::Free,
        };
        if inputs.hub != HubMode::Fixed {
            state.r_b_n_dot = random.vector(10.0);
            let turning = random.within(0.1, 1.0);
            state.omega = random.vector(turning);
        }
        inputs.force = random.vector(30.0);
        inputs.torque_b = random.vector(5.0);
        let wrenches = random.bits().is_multiple_of(2);
        inputs.bodies = wrenches.then(|| Inputs::no_wrenches_for(&craft));
        for wrench in inputs.bodies.iter_mut().flat_map(Each::values_mut) {
            *wrench = Wrench { force: random.vector(3.0), moment: random.vector(1.0) };
        }
        let joints = craft.joints().zip(state.devices.states_mut());
        let given = inputs.motors.values_mut().zip(inputs.modes.values_mut());
        for (((_, info), [coordinate, rate]), (motor, mode)) in joints.zip(given) {
            let [farthest, fastest] = clearance(info).unwrap_or(match (info.slides, info.rate) {
                (true, _) => [0.3, 3.0],
                (false, "spin") => [3.0, FASTEST_WHEEL],
                (false, _) => [3.0, 3.0],
            });
            *coordinate = random.within(-farthest, farthest);
            *rate = random.within(-fastest, fastest);
            *motor = random.within(-5.0, 5.0);
            match random.bits() % 6 {
                0 if info.driven => *mode = Mode::Prescribed(random.within(-2.0, 2.0)),
                1 => (*mode, *rate) = (Mode::Locked, 0.0),
                _ => (),
            }
        }
    }

    /// In a scalar: numbers exactly as drawn, mounts orthonormal to its rounding.
    pub(crate) fn case<T: Scalar>(&self) -> Case<T> {
        let Case { hub, devices, state, inputs } = &self.case;
        let mut devices = devices.with_numbers(T::from_f64);
        devices.change(&mut Mounts(self.mounts.iter()));
        let mut case = still(hub.map(T::from_f64), devices);
        let Quaternion { q0, q1, q2, q3 } = state.attitude;
        let [q0, q1, q2, q3] = [q0, q1, q2, q3].map(T::from_f64);
        case.state.attitude = Quaternion { q0, q1, q2, q3 };
        case.state.r_b_n = state.r_b_n.map(T::from_f64);
        case.state.r_b_n_dot = state.r_b_n_dot.map(T::from_f64);
        case.state.omega = state.omega.map(T::from_f64);
        for (to, from) in case.state.devices.states_mut().zip(state.devices.states()) {
            for (to, from) in to.into_iter().zip(from) {
                *to = T::from_f64(from);
            }
        }
        case.inputs.force = inputs.force.map(T::from_f64);
        case.inputs.torque_b = inputs.torque_b.map(T::from_f64);
        copy(&mut case.inputs.motors, &inputs.motors, T::from_f64);
        copy(&mut case.inputs.modes, &inputs.modes, |mode| match mode {
            Mode::Driven => Mode::Driven,
            Mode::Prescribed(value) => Mode::Prescribed(T::from_f64(value)),
            Mode::Locked => Mode::Locked,
        });
        case.inputs.hub = match inputs.hub {
            HubMode::Free => HubMode::Free,
            HubMode::Fixed => HubMode::Fixed,
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => HubMode::Prescribed {
                r_b_n_ddot: r_b_n_ddot.map(T::from_f64),
                omega_dot: omega_dot.map(T::from_f64),
            },
        };
        case.inputs.gravity = match inputs.gravity {
            Gravity::None => Gravity::None,
            Gravity::Uniform(g) => Gravity::Uniform(g.map(T::from_f64)),
            Gravity::Central { mu } => Gravity::Central { mu: T::from_f64(mu) },
        };
        case.inputs.bodies = inputs.bodies.as_ref().map(|bodies| {
            let mut to = Inputs::no_wrenches_for(&case.craft());
            copy(&mut to, bodies, |wrench| Wrench {
                force: wrench.force.map(T::from_f64),
                moment: wrench.moment.map(T::from_f64),
            });
            to
        });
        case
    }
}

impl<T: Scalar> Case<T> {
    /// The spacecraft.
    pub(crate) fn craft(&self) -> Spacecraft<List<T>> {
        Spacecraft::new(&self.hub, &self.devices).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Nothing moves and nothing acts.
fn still<T: Scalar>(hub: Hub<T>, devices: List<T>) -> Case<T> {
    let craft = Spacecraft::new(&hub, &devices).unwrap_or_else(|error| panic!("{error}"));
    let (state, inputs) = (State::at_rest_for(&craft), Inputs::none_for(&craft));
    Case { hub, devices, state, inputs }
}

/// Sets the mount of each device.
struct Mounts<'a>(std::slice::Iter<'a, [f64; 4]>);

impl<T: Scalar> Change<T> for Mounts<'_> {
    fn change<K: Kind<Scalar = T>>(&mut self, device: &mut K) {
        let mount = rotation(*self.0.next().unwrap());
        let value = precess_dynamics::ParameterValue::Matrix(mount);
        device.set_parameter("mount", value).unwrap();
    }
}

/// Copies value by value.
fn copy<V: Value, W: Value>(to: &mut impl Each<V>, from: &impl Each<W>, of: impl Fn(W) -> V) {
    for (to, from) in to.values_mut().zip(from.values()) {
        *to = of(from);
    }
}

/// A device with bodies up to the hub's mass; of what the kind has no parameter for, nothing.
fn device<K: Kind<Scalar = f64> + Into<BuiltIn>>(random: &mut Random, heaviest: f64) -> BuiltIn {
    let no_body =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: Matrix3::zeros() };
    let (mut bodies, mut passive) = (K::all(no_body), K::all(Passive::none()));
    let flexible = K::JOINTS.iter().any(|info| clearance(info).is_some());
    let mut heaviest = heaviest;
    for (index, (body, info)) in bodies.values_mut().zip(K::JOINTS).enumerate() {
        let tip = info.rate == "spin";
        body.mass = random.log_within(0.1, heaviest);
        let reach = if index == 0 { random.within(0.0, 2.0) } else { random.log_within(1e-3, 1.0) };
        body.origin = random.vector(reach).into();
        let (inertia, radius) = disc(random, body.mass);
        if tip {
            body.inertia = inertia;
            // More than bearings would bear.
            let largest = if flexible { radius / 100.0 } else { radius };
            body.centre = [0.0, random.log_within(1e-5, largest), 0.0];
        } else {
            body.inertia = block(random, body.mass);
            let reach = random.log_within(1e-3, 1.0);
            body.centre = random.vector(reach).into();
        }
        // A gimbal that holds bearings has at least a third of the rotor's mass.
        if flexible && clearance(info).is_none() {
            heaviest = heaviest.min(3.0 * body.mass);
        }
    }
    let all_sprung = random.bits().is_multiple_of(2);
    for (passive, info) in passive.values_mut().zip(K::JOINTS) {
        if all_sprung || clearance(info).is_some() {
            *passive = sprung(random, info);
        }
    }
    let model = if random.bits().is_multiple_of(4) {
        ImbalanceModel::Lumped
    } else {
        ImbalanceModel::Coupled
    };
    K::of_bodies(&Matrix3::identity(), &bodies, &passive, model).into()
}

/// A quaternion of about unit length.
fn quaternion(random: &mut Random) -> [f64; 4] {
    loop {
        let q: [f64; 4] = std::array::from_fn(|_| random.within(-1.0, 1.0));
        let square: f64 = q.iter().map(|x| x * x).sum();
        if (0.1..=1.0).contains(&square) {
            return q.map(|x| x / square.sqrt());
        }
    }
}

/// The rotation of a quaternion, orthonormal to the scalar's rounding.
fn rotation<T: Scalar>(q: [f64; 4]) -> Matrix3<T> {
    let [q0, q1, q2, q3] = q.map(T::from_f64);
    precess_dynamics::Attitude::dcm(&Quaternion { q0, q1, q2, q3 })
}

/// Principal moments along turned axes: symmetric to the last bit.
fn turned(moments: Vector3<f64>, q: [f64; 4]) -> Matrix3<f64> {
    let axes: Matrix3<f64> = rotation(q);
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (inertia + inertia.transpose()) * 0.5
}

/// The inertia of a solid block.
fn block(random: &mut Random, mass: f64) -> Matrix3<f64> {
    let edges = Vector3::from_fn(|_, _| random.log_within(0.1, 3.0));
    let squares = edges.component_mul(&edges);
    let moments = Vector3::from_element(squares.sum()) - squares;
    turned(moments * (mass / 12.0), quaternion(random))
}

/// The inertia of a disc about nearly the x axis, with its radius.
fn disc(random: &mut Random, mass: f64) -> (Matrix3<f64>, f64) {
    let radius = random.log_within(0.05, 0.5);
    let axial = mass * radius * radius / 2.0;
    let tilt = random.log_within(1e-6, 0.05);
    let inertia =
        turned(Vector3::new(axial, 0.6 * axial, 0.6 * axial), [1.0, 0.0, tilt, 0.3 * tilt]);
    (inertia, radius)
}
