//! Random spacecraft of mixed kinds, with everything on: modes, motors, springs, friction, wrenches
//! on bodies, gravity.

use core::f64::consts::{PI, TAU};
use core::fmt::{self, Display, Formatter};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    Accelerations, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg,
    BalancedVscmg, DeviceLoads, Dgcmg, Dgvscmg, Each, FixedSet, FlexibleReactionWheel,
    FlexibleVscmg, Gravity, HingedPanel, Hub, HubMode, ImbalanceModel, Inputs, JointStates, Mode,
    Passive, Quaternion, ReactionWheel, Sgcmg, SloshMass, Spacecraft, State, Vscmg, Wrench,
    kind::JointInfo, set,
};

use super::draw::{Drawn, TORQUE};
use super::random::Random;

/// Six kinds; with [`Others`] all of them.
pub(crate) type Mixed = (Dgvscmg, Vscmg, Sgcmg, ReactionWheel, HingedPanel, SloshMass);
/// The others.
pub(crate) type Others = (
    BalancedDgvscmg,
    Dgcmg,
    BalancedVscmg,
    BalancedSgcmg,
    BalancedDgcmg,
    BalancedReactionWheel,
    FlexibleReactionWheel,
    FlexibleVscmg,
);

/// 6000 rpm.
const FASTEST_WHEEL: f64 = 6000.0 * TAU / 60.0;

/// A device as its bodies: what the reference kinematics need.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    pub(crate) mount: Matrix3<f64>,
    pub(crate) bodies: Vec<BodyParameters<f64>>,
    pub(crate) infos: &'static [JointInfo],
    /// Whether wrenches on the last body are expressed in its parent body's axes.
    pub(crate) round: bool,
    pub(crate) passives: Vec<Passive>,
    /// `U_s`, `J_12`, `J_13` of the simplified model; the last body is without them in this case.
    pub(crate) lumped: Option<[f64; 3]>,
}

/// Loads of one device of any kind.
#[derive(Clone, Debug)]
pub(crate) struct LoadsOfDevice {
    pub(crate) mount: Wrench,
    pub(crate) joints: Vec<Wrench>,
    pub(crate) motors: Vec<f64>,
}

/// A set that can be drawn at random and split into chains of bodies.
pub(crate) trait Craft: FixedSet<Scalar = f64> {
    fn drawn(random: &mut Random, heaviest: f64) -> Self;
    fn chains(&self) -> Vec<Chain>;
    fn loads_of_devices(loads: &Self::Per<set::Loads>) -> Vec<LoadsOfDevice>;
}

impl<K: Drawn> Craft for K {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        <K as Drawn>::drawn(random, heaviest)
    }

    fn chains(&self) -> Vec<Chain> {
        let mut bodies: Vec<_> = self.bodies().values().collect();
        let mut lumped = None;
        if let (ImbalanceModel::Lumped, Some(rotor)) = (self.model(), bodies.last_mut()) {
            let inertia = &mut rotor.inertia;
            lumped = Some([rotor.mass * rotor.centre[1], inertia.m12, inertia.m13]);
            (inertia.m12, inertia.m21, inertia.m13, inertia.m31) = (0.0, 0.0, 0.0, 0.0);
            rotor.centre = [0.0; 3];
        }
        let passives = self.passive().values().collect();
        let (mount, infos, round) = (*self.mount(), K::JOINTS, K::ROUND);
        vec![Chain { mount, bodies, infos, round, passives, lumped }]
    }

    fn loads_of_devices(
        DeviceLoads { mount, joints, motors, .. }: &Self::Per<set::Loads>,
    ) -> Vec<LoadsOfDevice> {
        let (joints, motors) = (joints.values().collect(), motors.values().collect());
        vec![LoadsOfDevice { mount: *mount, joints, motors }]
    }
}

macro_rules! sets {
    ($($($member:ident $index:tt),*;)*) => {$(
        impl<$($member: Craft),*> Craft for ($($member,)*) {
            fn drawn(random: &mut Random, heaviest: f64) -> Self {
                ($($member::drawn(random, heaviest),)*)
            }

            fn chains(&self) -> Vec<Chain> {
                [$(self.$index.chains()),*].concat()
            }

            fn loads_of_devices(loads: &Self::Per<set::Loads>) -> Vec<LoadsOfDevice> {
                [$($member::loads_of_devices(&loads.$index)),*].concat()
            }
        }
    )*};
}

sets! {
    A 0, B 1, C 2;
    A 0, B 1, C 2, D 3, E 4, F 5;
    A 0, B 1, C 2, D 3, E 4, F 5, G 6, H 7;
}

/// A spacecraft, how it moves and what acts on it.
#[derive(Clone, Debug)]
pub(crate) struct Case<D: Craft> {
    pub(crate) seed: u64,
    pub(crate) hub: Hub,
    pub(crate) devices: D,
    pub(crate) craft: Spacecraft<D>,
    pub(crate) state: State<D>,
    pub(crate) inputs: Inputs<D>,
}

impl<D: Craft> Case<D> {
    /// The spacecraft of a seed.
    pub(crate) fn drawn(seed: u64) -> Self {
        let random = &mut Random::new(seed);
        let m_b = random.log_within(1.0, 5000.0);
        let length = random.within(0.0, 3.0);
        let hub = Hub { m_b, r_bc_b: random.vector(length), i_b_bc: random.block(m_b) };
        let devices = D::drawn(random, m_b);
        let craft = Spacecraft::new(&hub, &devices)
            .unwrap_or_else(|error| panic!("seed {seed:#x}: {error}"));
        let mut case =
            Self { seed, hub, devices, craft, state: State::at_rest(), inputs: Inputs::none() };
        case.draw_inputs(random);
        case.draw_state(random);
        case
    }

    fn draw_inputs(&mut self, random: &mut Random) {
        let inputs = &mut self.inputs;
        let (force, torque) = (random.signed(100.0), random.signed(TORQUE));
        inputs.force = random.vector(force);
        inputs.torque_b = random.vector(torque);
        inputs.motors.values_mut().for_each(|motor| *motor = random.signed(TORQUE));
        for (mode, info) in inputs.modes.values_mut().zip(D::joint_infos()) {
            if info.driven && random.chance(0.4) {
                let given = Mode::Prescribed(random.signed(10.0));
                *mode = if random.chance(0.4) { Mode::Locked } else { given };
            }
        }
        inputs.hub = match random.within(0.0, 6.0) {
            ..1.0 => HubMode::Fixed,
            1.0..2.0 => {
                let (linear, angular) = (random.signed(10.0), random.signed(1.0));
                let (r_b_n_ddot, omega_dot) = (random.vector(linear), random.vector(angular));
                HubMode::Prescribed { r_b_n_ddot, omega_dot }
            }
            _ => HubMode::Free,
        };
        let mut bodies = D::all(Wrench::none());
        for wrench in bodies.values_mut() {
            let (force, moment) = (random.signed(10.0), random.signed(TORQUE));
            *wrench = Wrench { force: random.vector(force), moment: random.vector(moment) };
        }
        inputs.bodies = random.chance(0.7).then_some(bodies);
    }

    /// B within 100 m of the origin, at up to 10 m/s: near enough for the gradient of a field of
    /// 10 m/s² to matter.
    fn draw_state(&mut self, random: &mut Random) {
        let state = &mut self.state;
        state.r_b_n = Vector3::from_fn(|_, _| random.within(-100.0, 100.0));
        let (speed, turning) = (random.within(0.0, 10.0), random.within(0.0, 1.0));
        state.r_b_n_dot = random.vector(speed);
        state.omega = random.vector(turning);
        let q = random.unit_quaternion();
        state.attitude = Quaternion { q0: q.w, q1: q.i, q2: q.j, q3: q.k };
        let joints = state.devices.states_mut().zip(self.inputs.modes.values());
        for (([coordinate, rate], mode), info) in joints.zip(D::joint_infos()) {
            let fastest = if info.body == "wheel" { FASTEST_WHEEL } else { 5.0 };
            let (farthest, fastest) = match info.body {
                "axial slide" | "radial slide y" | "radial slide z" => (5e-3, 0.1),
                // At a tilt of a right angle the axis of the spin is that of the other tilt.
                "tilt y" | "tilt z" => (1.0, fastest),
                _ => (if info.slides { 1.0 } else { PI }, fastest),
            };
            *coordinate = random.within(-farthest, farthest);
            *rate = random.within(-fastest, fastest);
            if mode == Mode::Locked {
                *rate = 0.0;
            }
        }
        if self.inputs.hub == HubMode::Fixed {
            (state.r_b_n_dot, state.omega) = (Vector3::zeros(), Vector3::zeros());
        }
        self.inputs.gravity = match random.within(0.0, 3.0) {
            ..1.0 => Gravity::None,
            1.0..2.0 => Gravity::Uniform(random.vector(9.8)),
            _ => Gravity::Central { mu: 9.8 * self.state.r_b_n.norm_squared() },
        };
    }

    /// The accelerations of the state and the inputs.
    pub(crate) fn accelerations(&self) -> Accelerations<D> {
        let found = self.craft.accelerations(&self.state, &self.inputs);
        found.unwrap_or_else(|error| panic!("{self}: {error}"))
    }

    /// Coordinate and rate of every joint.
    pub(crate) fn joints(&self) -> Vec<[f64; 2]> {
        self.state.devices.states().collect()
    }
}

/// All that is needed to draw the spacecraft again.
impl<D: Craft> Display for Case<D> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let first = self.craft.joints().next().map_or("none", |(_, info)| info.body);
        let Inputs { hub, gravity, .. } = &self.inputs;
        write!(
            f,
            "seed {:#x}, {} joints from {first}, {hub:?}, {gravity:?}",
            self.seed,
            self.joints().len()
        )
    }
}
