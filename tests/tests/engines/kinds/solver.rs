//! A stored spacecraft for the solver, with any scalar: a list of devices whose kinds are known at
//! run time.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{BodyParameters, Each, JointStates};
use precess_dynamics::{
    About, Accelerations, Attitude, BuiltIn, DeviceParameters, Gravity, Hub, HubMode,
    ImbalanceModel, Inputs, LoadAxes, Loads, MAX_JOINTS, Mode, Momentum, Passive, Quaternion,
    Scalar, SolveError, Spacecraft, State, Stopped, Wrench,
};

use super::stored::{Craft, StoredDevice, StoredHubMode, StoredJoint, StoredMode};

pub(crate) type Set<T> = Vec<BuiltIn<T>>;

/// A spacecraft in its state under its inputs.
pub(crate) struct Case<T: Scalar> {
    name: String,
    mass: f64,
    pub(crate) craft: Spacecraft<Set<T>>,
    state: State<Set<T>>,
    inputs: Inputs<Set<T>>,
}

impl<T: Scalar> Case<T> {
    /// Away from N's origin, and turned in N by a rotation that is exact, so that a vector along the
    /// wrong axes shows.
    pub(crate) fn new(stored: &Craft) -> Self {
        let hub = Hub {
            m_b: scalar(stored.hub.m_b),
            r_bc_b: vector(stored.hub.r_bc_b),
            i_b_bc: symmetric(stored.hub.i_b),
        };
        let devices: Set<T> = stored.devices.iter().map(device).collect();
        let craft = Spacecraft::new(&hub, &devices)
            .unwrap_or_else(|error| panic!("{}: {error}", stored.name));
        let half = scalar(0.5);
        let attitude = Quaternion { q0: half, q1: half, q2: half, q3: half };
        let nb = attitude.dcm().transpose();
        let mut state = State {
            r_b_n: vector([3.0, -2.0, 1.0]),
            r_b_n_dot: turned(&nb, &vector(stored.r_b_n_dot)),
            attitude,
            omega: vector(stored.omega),
            ..State::at_rest_for(&craft)
        };
        for ([coordinate, rate], joint) in state.devices.states_mut().zip(stored.joints()) {
            (*coordinate, *rate) = (scalar(joint.coordinate), scalar(joint.rate));
        }
        let mut wrenches = Inputs::no_wrenches_for(&craft);
        for (wrench, joint) in wrenches.values_mut().zip(stored.joints()) {
            let [a, b, c, d, e, f] = joint.wrench;
            *wrench = Wrench { force: vector([a, b, c]), moment: vector([d, e, f]) };
        }
        let mut inputs = Inputs {
            force: vector(stored.force),
            torque_b: vector(stored.torque_b),
            hub: hub_mode(stored.hub_mode),
            gravity: Gravity::Uniform(turned(&nb, &vector(stored.gravity))),
            bodies: Some(wrenches),
            ..Inputs::none_for(&craft)
        };
        let given = inputs.motors.values_mut().zip(inputs.modes.values_mut());
        for ((motor, to), joint) in given.zip(stored.joints()) {
            (*motor, *to) = (scalar(joint.motor), mode(joint.mode));
        }
        let mass = stored.hub.m_b + stored.joints().map(|joint| joint.mass).sum::<f64>();
        Self { name: stored.name.clone(), mass, craft, state, inputs }
    }

    pub(crate) fn accelerations(&self) -> Accelerations<Set<T>> {
        self.expect_ok(self.craft.accelerations(&self.state, &self.inputs))
    }

    /// Kinetic energy.
    pub(crate) fn energy(&self) -> T {
        self.expect_ok(self.craft.energy(&self.state))
    }

    /// The state after an impulsive stop, and the energy lost.
    pub(crate) fn stopped(&self) -> Stopped<Set<T>, Quaternion<T>> {
        self.expect_ok(self.craft.stop(&self.state, &self.inputs))
    }

    /// Kinetic energy before an impulsive stop less kinetic energy after it.
    pub(crate) fn energy_difference(&self) -> T {
        self.energy() - self.expect_ok(self.craft.energy(&self.stopped().state))
    }

    fn expect_ok<R>(&self, result: Result<R, SolveError<T>>) -> R {
        result.unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }
}

impl Case<f64> {
    /// Loads of the joints along the axes of their bodies.
    pub(crate) fn loads(&self, found: &Accelerations<Set<f64>>) -> Loads<Set<f64>> {
        self.expect_ok(self.craft.loads(&self.state, &self.inputs, found, LoadAxes::Body))
    }

    /// Energy of gravity with B at the origin, and of springs.
    pub(crate) fn potential(&self) -> f64 {
        let ledger = self.craft.ledger(&self.state, &self.inputs, &self.accelerations());
        let ledger = self.expect_ok(ledger);
        let Gravity::Uniform(g) = self.inputs.gravity else { panic!("{}: gravity", self.name) };
        let of_b = -self.mass * g.dot(&self.state.r_b_n);
        ledger.gravity - of_b + ledger.springs
    }

    /// Linear momentum, moment of momentum about B, centre of mass from B; along B.
    pub(crate) fn moments(&self) -> [Vector3<f64>; 3] {
        // The point of N in which B is at this moment.
        let b = About::Point(self.state.r_b_n);
        let Momentum { linear, angular } = self.expect_ok(self.craft.momentum(&self.state, b));
        let bn = self.state.attitude.dcm();
        let centre = self.expect_ok(self.craft.centre_of_mass(&self.state));
        [bn * linear, bn * angular, centre.c]
    }
}

/// `BuiltIn::new` rejects what the kind has no parameter for, so the chain of the file is the kind's.
fn device<T: Scalar>(stored: &StoredDevice) -> BuiltIn<T> {
    let kind = stored.kind();
    assert_eq!(kind.joints().len(), stored.joints.len(), "joints of {}", stored.kind);
    let joint = |k: usize| stored.joints[k.min(stored.joints.len() - 1)];
    let parameters = DeviceParameters {
        mount: mount(stored.mount),
        bodies: core::array::from_fn::<_, MAX_JOINTS, _>(|k| body(&joint(k))),
        passive: core::array::from_fn::<_, MAX_JOINTS, _>(|k| passive(&joint(k))),
        model: ImbalanceModel::Coupled,
    };
    BuiltIn::new(kind, &parameters).unwrap_or_else(|error| panic!("{}: {error}", stored.kind))
}

fn body<T: Scalar>(joint: &StoredJoint) -> BodyParameters<T> {
    BodyParameters {
        origin: joint.origin.map(scalar),
        mass: scalar(joint.mass),
        centre: joint.centre.map(scalar),
        inertia: symmetric(joint.inertia),
    }
}

pub(crate) fn passive<T: Scalar>(joint: &StoredJoint) -> Passive<T> {
    let [stiffness, rest, viscous, coulomb, coulomb_rate] = joint.passive.map(scalar);
    Passive { stiffness, rest, viscous, coulomb, coulomb_rate }
}

pub(crate) fn mode<T: Scalar>(stored: StoredMode) -> Mode<T> {
    match stored {
        StoredMode::Driven => Mode::Driven,
        StoredMode::Locked => Mode::Locked,
        StoredMode::Prescribed(acceleration) => Mode::Prescribed(scalar(acceleration)),
    }
}

pub(crate) fn hub_mode<T: Scalar>(stored: StoredHubMode) -> HubMode<T> {
    match stored {
        StoredHubMode::Free => HubMode::Free,
        StoredHubMode::Fixed => HubMode::Fixed,
        StoredHubMode::Prescribed { r_b_n_ddot, omega_dot } => {
            HubMode::Prescribed { r_b_n_ddot: vector(r_b_n_ddot), omega_dot: vector(omega_dot) }
        }
    }
}

/// The rotation of a quaternion of any length: columns are the new axes.
pub(crate) fn mount<T: Scalar>(quaternion: [f64; 4]) -> Matrix3<T> {
    let [w, x, y, z] = quaternion.map(scalar::<T>);
    let s = scalar::<T>(2.0) * (w * w + x * x + y * y + z * z).recip();
    let one = scalar::<T>(1.0);
    Matrix3::new(
        one - s * (y * y + z * z),
        s * (x * y - w * z),
        s * (x * z + w * y),
        s * (x * y + w * z),
        one - s * (x * x + z * z),
        s * (y * z - w * x),
        s * (x * z - w * y),
        s * (y * z + w * x),
        one - s * (x * x + y * y),
    )
}

pub(crate) fn scalar<T: Scalar>(value: f64) -> T {
    T::from_f64(value)
}

fn vector<T: Scalar>(components: [f64; 3]) -> Vector3<T> {
    Vector3::from(components.map(scalar))
}

fn symmetric<T: Scalar>(entries: [f64; 6]) -> Matrix3<T> {
    let [xx, xy, xz, yy, yz, zz] = entries.map(scalar);
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn turned<T: Scalar>(axes: &Matrix3<T>, v: &Vector3<T>) -> Vector3<T> {
    let row = |k: usize| axes[(k, 0)] * v.x + axes[(k, 1)] * v.y + axes[(k, 2)] * v.z;
    Vector3::new(row(0), row(1), row(2))
}
