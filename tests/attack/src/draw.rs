//! How cases are drawn: any kinds, parameters, motions and inputs that a profile allows.
//!
//! Real bodies by default: masses 0.1 to 100 kg on a hub of 1 to 5000 kg, solid blocks and discs,
//! lengths to 3 m, rates to 5 rad/s and 600 rad/s. A profile lets a share of all numbers have any
//! magnitude, or be no number.

use std::f64::consts::PI;

use nalgebra::Vector3;
use precess_dynamics::{
    BuiltInKind, Each, Gravity, Hub, HubMode, Inputs, JointArray, JointStates, MAX_JOINTS, Mode,
    Passive, Quaternion, State, Wrench,
};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Strategy};

use super::bodies::{Body, block, built_in, unit};
use super::case::{Case, List, template};
use super::number::Number;

/// What may be drawn.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a thing that is on or off by itself")]
pub struct Profile {
    /// Share of numbers of states, inputs and parameters that have any magnitude.
    pub wild: f64,
    /// Share of numbers of states and inputs that are infinite or NaN.
    pub not_finite: f64,
    /// The lists of kinds to draw from; any up to five devices where there is none.
    pub sets: &'static [&'static [BuiltInKind]],
    /// Whether joints may be prescribed and locked.
    pub modes: bool,
    /// Whether joints may have springs and friction.
    pub passive: bool,
    /// Whether imbalance may be lumped.
    pub lumped: bool,
    /// Whether the hub may be fixed or prescribed.
    pub held: bool,
    /// Whether there may be gravity.
    pub gravity: bool,
    /// Whether anything acts from outside or by motors.
    pub driven: bool,
    /// How many more states there may be.
    pub more: usize,
}

impl Profile {
    /// Real bodies with everything on.
    pub const REAL: Self = Self {
        wild: 0.0,
        not_finite: 0.0,
        sets: &[],
        modes: true,
        passive: true,
        lumped: true,
        held: true,
        gravity: true,
        driven: true,
        more: 0,
    };
}

/// Kinds, the simplest first.
const KINDS: [BuiltInKind; 14] = [
    BuiltInKind::ReactionWheel,
    BuiltInKind::BalancedReactionWheel,
    BuiltInKind::HingedPanel,
    BuiltInKind::SloshMass,
    BuiltInKind::Sgcmg,
    BuiltInKind::BalancedSgcmg,
    BuiltInKind::Vscmg,
    BuiltInKind::BalancedVscmg,
    BuiltInKind::Dgcmg,
    BuiltInKind::BalancedDgcmg,
    BuiltInKind::Dgvscmg,
    BuiltInKind::BalancedDgvscmg,
    BuiltInKind::FlexibleReactionWheel,
    BuiltInKind::FlexibleVscmg,
];

/// Motion, passive elements and inputs of a joint.
#[derive(Clone, Debug)]
struct Joint {
    motion: [f64; 2],
    torque: f64,
    mode: u8,
    acceleration: f64,
    passive: [f64; 5],
    bound: [bool; 2],
    wrench: [[f64; 3]; 2],
}

#[derive(Clone, Debug)]
struct Device {
    kind: usize,
    mount: [f64; 4],
    bodies: [Body; MAX_JOINTS],
    joints: [Joint; MAX_JOINTS],
    lumped: bool,
}

/// How the hub moves and what acts on it.
#[derive(Clone, Debug)]
struct World {
    hub_motion: [[f64; 3]; 3],
    attitude: [f64; 4],
    acting: [[f64; 3]; 2],
    held: u8,
    given: [[f64; 3]; 2],
    field: u8,
    gravity: [f64; 3],
    wrenches: bool,
    dt: f64,
    steps: usize,
    compatible: bool,
}

impl Profile {
    /// A number of a state or of inputs.
    fn number(&self, number: Number) -> Number {
        number.or_any(self.wild).or_not_finite(self.not_finite)
    }

    fn vector(&self, size: f64) -> impl Strategy<Value = [f64; 3]> + use<> {
        [(); 3].map(|()| self.number(Number::within(-size, size)))
    }

    fn turn() -> impl Strategy<Value = [f64; 4]> + use<> {
        let first = Number::new(1.0, |random| random.within(-1.0, 1.0));
        let rest = [(); 3].map(|()| Number::within(-1.0, 1.0));
        (first, rest).prop_map(|(first, [x, y, z])| [first, x, y, z])
    }

    fn body(&self, lightest: f64, heaviest: f64) -> impl Strategy<Value = Body> + use<> {
        let wild = self.wild * 0.5;
        let length = |size: f64| [(); 3].map(|()| Number::within(-size, size).or_any(wild));
        let mass = Number::log_within(lightest, heaviest).or_any(wild);
        let edges = [(); 3].map(|()| Number::log_within(0.05, 3.0).or_any(wild));
        let hollow = proptest::bool::weighted(0.2);
        (mass, length(1.7), length(0.5), edges, Self::turn(), hollow).prop_map(
            |(mass, origin, centre, edges, turn, hollow)| Body {
                mass: mass.abs(),
                origin,
                centre,
                edges,
                turn,
                hollow,
            },
        )
    }

    fn joint(&self) -> impl Strategy<Value = Joint> + use<> {
        let angle = Number::new(0.0, |random| {
            let bits = random.bits();
            let drawn =
                if bits % 4 == 0 { random.within(-1e3, 1e3) } else { random.within(-PI, PI) };
            if bits % 16 == 1 { -0.0 } else { drawn }
        });
        let motion = [self.number(angle), self.number(Number::within(-1.0, 1.0))];
        let share = |low: f64| Number::log_within(low, 1.0).or_any(self.wild * 0.5);
        let passive =
            (share(1e-3), Number::within(-1.0, 1.0), share(1e-4), share(1e-4), share(1e-3));
        let bound = proptest::array::uniform2(proptest::bool::weighted(0.4));
        let wrench = [self.vector(10.0), self.vector(10.0)];
        let torque = self.number(Number::within(-10.0, 10.0));
        let acceleration = self.number(Number::within(-10.0, 10.0));
        (motion, torque, 0_u8..10, acceleration, passive, bound, wrench).prop_map(
            |(motion, torque, mode, acceleration, (k, rest, c, u, w), bound, wrench)| Joint {
                motion,
                torque,
                mode,
                acceleration,
                passive: [100.0 * k.abs(), rest, 10.0 * c.abs(), 10.0 * u.abs(), 0.1 * w.abs()],
                bound,
                wrench,
            },
        )
    }

    fn device(&self) -> impl Strategy<Value = Device> + use<> {
        let bodies = [(); MAX_JOINTS].map(|()| self.body(0.1, 100.0));
        let joints = [(); MAX_JOINTS].map(|()| self.joint());
        (0..KINDS.len(), Self::turn(), bodies, joints, proptest::bool::weighted(0.2)).prop_map(
            |(kind, mount, bodies, joints, lumped)| Device { kind, mount, bodies, joints, lumped },
        )
    }

    fn world(&self) -> impl Strategy<Value = World> + use<> {
        let hub_motion = [self.vector(100.0), self.vector(10.0), self.vector(0.6)];
        let acting = [self.vector(60.0), self.vector(6.0)];
        let given = [self.vector(6.0), self.vector(0.6)];
        let [first, second, third, fourth] = [1.0, 0.0, 0.0, 0.0]
            .map(|simplest| self.number(Number::new(simplest, |random| random.within(-1.0, 1.0))));
        let attitude = [first, second, third, fourth];
        let dt = Number::log_within(1e-5, 1e-2).or_any(self.wild).or_not_finite(self.not_finite);
        let motion = (hub_motion, attitude, acting, proptest::bool::weighted(0.7));
        let modes = (0_u8..8, given, 0_u8..6, self.vector(6.0), proptest::bool::weighted(0.4));
        (motion, modes, dt, 1_usize..6).prop_map(|(motion, modes, dt, steps)| {
            let (hub_motion, attitude, acting, compatible) = motion;
            let (held, given, field, gravity, wrenches) = modes;
            World {
                hub_motion,
                attitude,
                acting,
                held,
                given,
                field,
                gravity,
                wrenches,
                dt,
                steps,
                compatible,
            }
        })
    }

    /// A case of this profile.
    pub fn cases(self) -> BoxedStrategy<Case> {
        let hub = self.body(1.0, 5000.0);
        let most = self.sets.iter().map(|set| set.len()).max();
        let count = most.map_or(0..=5, |most| most..=most);
        let set = 0..self.sets.len().max(1);
        let more = vec((self.world(), vec(self.joint(), 18)), 0..=self.more);
        (hub, vec(self.device(), count), set, self.world(), more)
            .prop_map(move |(hub, devices, set, world, more)| {
                self.case(&hub, devices, set, &world, &more)
            })
            .boxed()
    }

    fn case(
        &self,
        hub: &Body,
        mut devices: Vec<Device>,
        set: usize,
        world: &World,
        more: &[(World, Vec<Joint>)],
    ) -> Case {
        if let Some(kinds) = self.sets.get(set) {
            devices.truncate(kinds.len());
            for (device, kind) in devices.iter_mut().zip(*kinds) {
                device.kind = KINDS.iter().position(|known| known == kind).unwrap_or(0);
            }
        }
        let made = |device: &Device| {
            let Device { kind, mount, ref bodies, lumped, .. } = *device;
            built_in(KINDS[kind], mount, bodies, &self.passives(device), lumped && self.lumped)
        };
        let list: List = devices.iter().map(made).collect();
        let Body { mass, centre, .. } = *hub;
        let hub = Hub { m_b: mass, r_bc_b: centre.into(), i_b_bc: block(hub) };
        let mut case = Case::still(hub, list);
        let counts = devices
            .iter()
            .zip(&case.devices)
            .map(|(device, made)| device.joints.iter().take(made.kind().joints().len()));
        let joints: Vec<&Joint> = counts.flatten().collect();
        let nothing = Inputs::no_wrenches_for(&template(&case.devices));
        self.inputs(&mut case.inputs, world, &joints, &case.devices, &nothing);
        self.state(&mut case.state, world, &joints, &case.devices);
        self.compatible(&mut case.state, &case.inputs);
        (case.dt, case.steps) = (world.dt, world.steps);
        for (world, joints) in more {
            let joints: Vec<&Joint> = joints.iter().collect();
            let (mut state, mut inputs) = (case.state.clone(), case.inputs.clone());
            self.inputs(&mut inputs, world, &joints, &case.devices, &nothing);
            self.state(&mut state, world, &joints, &case.devices);
            // Some may move where they are locked.
            if world.compatible {
                self.compatible(&mut state, &inputs);
            }
            case.more.push((state, inputs));
        }
        case
    }

    fn passives(&self, device: &Device) -> [Passive; MAX_JOINTS] {
        let mut passive = [Passive::none(); MAX_JOINTS];
        for (passive, joint) in passive.iter_mut().zip(&device.joints) {
            let [stiffness, rest, viscous, coulomb, coulomb_rate] = joint.passive;
            let [sprung, dry] = joint.bound.map(|bound| bound && self.passive);
            if sprung {
                *passive = Passive { rest, ..Passive::spring(stiffness, viscous) };
            }
            if dry {
                *passive = Passive { coulomb, coulomb_rate, ..*passive };
            }
        }
        passive
    }

    fn inputs(
        &self,
        inputs: &mut Inputs<List>,
        world: &World,
        joints: &[&Joint],
        list: &List,
        nothing: &[JointArray<Wrench>],
    ) {
        if self.driven {
            let [force, torque_b] = world.acting;
            (inputs.force, inputs.torque_b) = (force.into(), torque_b.into());
            for (motor, joint) in inputs.motors.values_mut().zip(joints) {
                *motor = joint.torque;
            }
        }
        let infos = list.iter().flat_map(|device| device.kind().joints());
        for ((mode, joint), info) in inputs.modes.values_mut().zip(joints).zip(infos) {
            if self.modes && info.driven {
                *mode = match joint.mode {
                    6 | 7 => Mode::Prescribed(joint.acceleration),
                    8 | 9 => Mode::Locked,
                    _ => Mode::Driven,
                };
            }
        }
        let [r_b_n_ddot, omega_dot] = world.given.map(Vector3::from);
        inputs.hub = match world.held {
            6 if self.held => HubMode::Fixed,
            7 if self.held => HubMode::Prescribed { r_b_n_ddot, omega_dot },
            _ => HubMode::Free,
        };
        let g = Vector3::from(world.gravity);
        inputs.gravity = match world.field {
            2 | 3 if self.gravity => Gravity::Uniform(g),
            4 | 5 if self.gravity => {
                let [position, ..] = world.hub_motion.map(Vector3::from);
                let mu = g.norm() * position.norm_squared();
                Gravity::Central { mu: if mu.is_finite() { mu } else { world.gravity[0] } }
            }
            _ => Gravity::None,
        };
        inputs.bodies = (world.wrenches && self.driven).then(|| {
            let mut bodies = nothing.to_vec();
            for (wrench, joint) in bodies.values_mut().zip(joints) {
                let [force, moment] = joint.wrench.map(Vector3::from);
                *wrench = Wrench { force, moment };
            }
            bodies
        });
    }

    fn state(&self, state: &mut State<List>, world: &World, joints: &[&Joint], list: &List) {
        let [position, velocity, omega] = world.hub_motion.map(Vector3::from);
        (state.r_b_n, state.r_b_n_dot, state.omega) = (position, velocity, omega);
        let real = self.wild == 0.0 && self.not_finite == 0.0;
        let [q0, q1, q2, q3] = if real { unit(world.attitude) } else { world.attitude };
        state.attitude = Quaternion { q0, q1, q2, q3 };
        let infos = list.iter().flat_map(|device| device.kind().joints());
        for (([coordinate, rate], joint), info) in state.devices.states_mut().zip(joints).zip(infos)
        {
            let [q, q_dot] = joint.motion;
            let size = if info.body == "wheel" { 600.0 } else { 5.0 };
            (*coordinate, *rate) = (if info.slides { q * 0.1 } else { q }, size * q_dot);
        }
    }

    /// Brings to rest what the inputs hold.
    fn compatible(&self, state: &mut State<List>, inputs: &Inputs<List>) {
        for ([_, rate], mode) in state.devices.states_mut().zip(inputs.modes.values()) {
            if mode == Mode::Locked && rate.is_finite() {
                *rate = 0.0;
            }
        }
        if inputs.hub == HubMode::Fixed && self.not_finite == 0.0 {
            (state.r_b_n_dot, state.omega) = (Vector3::zeros(), Vector3::zeros());
        }
    }
}
