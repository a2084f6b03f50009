//! A spacecraft of any set with a state and inputs, set joint by joint, and the comparison of two
//! of them, block by block.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointInfo, JointStates, Kind};
use precess_dynamics::{
    Accelerations, Devices, Hub, Inputs, Mode, Quaternion, SolveError, Spacecraft, State,
};

use super::random::Random;

/// Largest difference between two descriptions of the same spacecraft, of the block: rounding.
pub(crate) const LIMITS: f64 = 1e-12;

/// Number of random spacecraft per claim.
pub(crate) const SEEDS: u64 = 1000;

/// State, motor torque and mode of one joint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    /// Coordinate and rate.
    pub(crate) state: [f64; 2],
    pub(crate) torque: f64,
    pub(crate) mode: Mode,
}

/// Everything about a spacecraft but its devices.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) seed: u64,
    pub(crate) hub: Hub,
    r_b_n: Vector3<f64>,
    r_b_n_dot: Vector3<f64>,
    attitude: Quaternion,
    pub(crate) omega: Vector3<f64>,
    pub(crate) force: Vector3<f64>,
    pub(crate) torque_b: Vector3<f64>,
}

/// A spacecraft in a state under inputs.
#[derive(Clone, Debug)]
pub(crate) struct Case<D: Devices<Scalar = f64>> {
    pub(crate) seed: u64,
    pub(crate) craft: Spacecraft<D>,
    pub(crate) state: State<D>,
    pub(crate) inputs: Inputs<D>,
}

/// Accelerations of any set: of the hub, and of each joint that is not locked by the name of its
/// coordinate.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    pub(crate) r_b_n_ddot: Vector3<f64>,
    pub(crate) omega_dot: Vector3<f64>,
    pub(crate) joints: Vec<(&'static str, f64)>,
}

impl Joint {
    /// Driven, with random state and torque.
    pub(crate) fn drawn(random: &mut Random, info: &JointInfo) -> Self {
        let torque = random.within(-10.0, 10.0);
        Self { state: random.joint(info), torque, mode: Mode::Driven }
    }

    /// Locked at a coordinate.
    pub(crate) fn locked(coordinate: f64) -> Self {
        Self { state: [coordinate, 0.0], torque: 0.0, mode: Mode::Locked }
    }

    /// The same joint with a prescribed acceleration; the torque is kept and has no effect.
    pub(crate) fn prescribed(self, acceleration: f64) -> Self {
        Self { mode: Mode::Prescribed(acceleration), ..self }
    }
}

/// The joints of one device at random, each in the mode of its kind.
pub(crate) fn joints<K: Kind>(random: &mut Random) -> Vec<Joint> {
    let own = |info: &JointInfo| if info.driven { Mode::Driven } else { Mode::Prescribed(0.0) };
    K::JOINTS.iter().map(|info| Joint { mode: own(info), ..Joint::drawn(random, info) }).collect()
}

impl World {
    pub(crate) fn drawn(random: &mut Random) -> Self {
        let m_b = random.log_within(10.0, 5000.0);
        let [w, x, y, z] = {
            let q = random.rotation();
            [q.w, q.i, q.j, q.k]
        };
        let (speed, turning) = (random.within(0.0, 10.0), random.within(0.0, 1.0));
        let hub = Hub { m_b, r_bc_b: random.position(), i_b_bc: random.block(m_b) };
        Self {
            seed: random.seed,
            hub,
            r_b_n: Vector3::from_fn(|_, _| random.within(-100.0, 100.0)),
            r_b_n_dot: random.vector(speed),
            attitude: Quaternion { q0: w, q1: x, q2: y, q3: z },
            omega: random.vector(turning),
            force: Vector3::from_fn(|_, _| random.within(-100.0, 100.0)),
            torque_b: Vector3::from_fn(|_, _| random.within(-10.0, 10.0)),
        }
    }

    /// The same with another hub.
    pub(crate) fn on(&self, hub: Hub) -> Self {
        Self { hub, ..self.clone() }
    }

    /// The spacecraft with these devices, with the settings of each joint in the order of the
    /// devices.
    pub(crate) fn case<D: Devices<Scalar = f64>>(
        &self,
        devices: &D,
        settings: &[Joint],
    ) -> Case<D> {
        let Self { seed, .. } = self;
        let craft = Spacecraft::new(&self.hub, devices)
            .unwrap_or_else(|error| panic!("seed {seed:#x}: {error}"));
        let state = State {
            r_b_n: self.r_b_n,
            r_b_n_dot: self.r_b_n_dot,
            attitude: self.attitude,
            omega: self.omega,
            ..State::at_rest_for(&craft)
        };
        let (force, torque_b) = (self.force, self.torque_b);
        let inputs = Inputs { force, torque_b, ..Inputs::none_for(&craft) };
        assert_eq!(craft.joints().count(), settings.len(), "settings for each joint");
        let mut case = Case { seed: *seed, craft, state, inputs };
        case.set(settings);
        case
    }
}

impl<D: Devices<Scalar = f64>> Case<D> {
    /// The settings of every joint, in order.
    pub(crate) fn settings(&self) -> Vec<Joint> {
        let given = self.inputs.motors.values().zip(self.inputs.modes.values());
        let joints = self.state.devices.states().zip(given);
        joints.map(|(state, (torque, mode))| Joint { state, torque, mode }).collect()
    }

    /// The same with other settings.
    pub(crate) fn with_settings(&self, settings: &[Joint]) -> Self {
        let mut case = self.clone();
        case.set(settings);
        case
    }

    /// Sets state, torque and mode of every joint.
    pub(crate) fn set(&mut self, settings: &[Joint]) {
        let Self { state, inputs, .. } = self;
        for ([coordinate, rate], joint) in state.devices.states_mut().zip(settings) {
            [*coordinate, *rate] = joint.state;
        }
        let given = inputs.motors.values_mut().zip(inputs.modes.values_mut());
        for ((motor, mode), joint) in given.zip(settings) {
            (*motor, *mode) = (joint.torque, joint.mode);
        }
    }

    /// The solver's accelerations; fails with the seed if there are none.
    pub(crate) fn accelerations(&self) -> Accelerations<D> {
        self.expect_ok(self.craft.accelerations(&self.state, &self.inputs))
    }

    /// The value of a call; fails with the seed if it is an error.
    pub(crate) fn expect_ok<R>(&self, result: Result<R, SolveError>) -> R {
        result.unwrap_or_else(|error| panic!("seed {:#x}: {error}", self.seed))
    }

    /// The solver's accelerations, joint by joint.
    pub(crate) fn solved(&self) -> Solution {
        let Accelerations { r_b_n_ddot, omega_dot, devices, .. } = self.accelerations();
        let joints = self.craft.joints().zip(self.inputs.modes.values()).zip(devices.values());
        let moving = joints.filter(|((_, mode), _)| *mode != Mode::Locked);
        let joints = moving.map(|(((_, info), _), value)| (info.coordinate, value)).collect();
        Solution { r_b_n_ddot, omega_dot, joints }
    }
}

impl Solution {
    /// The largest difference from what is expected, each in units of the largest magnitude of its
    /// block there. A block is one vector of the hub, or all joints of one name.
    pub(crate) fn error(&self, expected: &Self) -> f64 {
        self.error_beside(expected, expected)
    }

    /// The same where a block may be held at zero: the unit is the block's largest magnitude in
    /// what is expected or in another motion of the same joints.
    pub(crate) fn error_beside(&self, expected: &Self, other: &Self) -> f64 {
        assert_eq!(self.joints.len(), expected.joints.len(), "joints that are not locked");
        let of_hub = [
            (self.r_b_n_ddot - expected.r_b_n_ddot).amax()
                / expected.r_b_n_ddot.amax().max(other.r_b_n_ddot.amax()),
            (self.omega_dot - expected.omega_dot).amax()
                / expected.omega_dot.amax().max(other.omega_dot.amax()),
        ];
        let mut blocks: BTreeMap<_, [f64; 2]> = BTreeMap::new();
        let pairs = self.joints.iter().zip(&expected.joints).zip(&other.joints);
        for (((_, found), (name, expected)), (_, other)) in pairs {
            let [difference, unit] = blocks.entry(name).or_default();
            *difference = largest([*difference, (found - expected).abs()]);
            *unit = largest([*unit, expected.abs(), other.abs()]);
        }
        let of_joints = blocks
            .into_values()
            .map(|[difference, unit]| if difference == 0.0 { 0.0 } else { difference / unit });
        largest(of_hub.into_iter().chain(of_joints))
    }
}

/// The largest of some magnitudes; infinite if any is NaN, which `f64::max` would drop.
pub(crate) fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}
