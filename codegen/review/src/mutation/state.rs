//! One spacecraft with one device, in one state: everything of order one, so that every term counts.

use nalgebra::{Matrix3, Rotation3, Vector3};

use precess_codegen::kernel::parameters;
use precess_codegen::kinds::{Kind, Link};

/// Where a case is from: no two of a run are the same.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum CaseName {
    /// From random numbers.
    Drawn { seed: u64, mixed: bool },
    /// From the engines' spacecraft, by number.
    Stored(usize),
}

/// Everything that a law is evaluated for.
#[derive(Clone)]
pub(super) struct Case {
    pub(super) name: CaseName,
    pub(super) hub: Hub,
    /// The device's axes along B, as columns. Vectors of a case are along the device's all the same.
    pub(super) mount: Matrix3<f64>,
    /// In the order of the fields of `Parameters`.
    pub(super) parameters: Vec<f64>,
    pub(super) motion: Motion,
    pub(super) drive: Drive,
}

/// The rigid hub.
#[derive(Clone)]
pub(super) struct Hub {
    pub(super) mass: f64,
    /// Centre of mass from B.
    pub(super) centre: Vector3<f64>,
    /// About the centre of mass.
    pub(super) inertia: Matrix3<f64>,
}

/// Coordinates and velocities; vectors along B.
#[derive(Clone)]
pub(super) struct Motion {
    /// Angles, and lengths along sliding joints.
    pub(super) coordinates: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) omega: Vector3<f64>,
    /// Inertial velocity of point B.
    pub(super) velocity: Vector3<f64>,
}

/// Motor torques and modes, force through B, torque about B.
#[derive(Clone)]
pub(super) struct Drive {
    /// Of a joint whose acceleration is given: without effect.
    pub(super) motors: Vec<f64>,
    pub(super) modes: Vec<Mode>,
    pub(super) force: Vector3<f64>,
    pub(super) torque: Vector3<f64>,
}

/// What is given of a joint.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Mode {
    /// Its torque. The motor may have an inertia of its own that takes part only in
    /// the joint's rate, as a fast rotor behind a gear does: zero, but where `held` is to be noticed.
    Driven { inertia: f64 },
    /// Its acceleration; zero by the kind where that prescribes it.
    Given { acceleration: f64 },
}

impl Mode {
    /// The torque is given, and the motor weighs nothing.
    pub(super) const DRIVEN: Self = Self::Driven { inertia: 0.0 };

    /// What a kind's joints are, with this mode for all that have a motor.
    pub(super) fn of_kind(kind: &Kind, mut mode: impl FnMut(usize) -> Self) -> Vec<Self> {
        let kept = Self::Given { acceleration: 0.0 };
        let links = kind.links.iter().enumerate();
        links.map(|(k, link)| if link.is_driven() { mode(k) } else { kept }).collect()
    }

    /// Whether the torque is given.
    pub(super) fn is_driven(self) -> bool {
        matches!(self, Self::Driven { .. })
    }

    /// The values of `driven`, `held` and `given`.
    pub(super) fn numbers(self) -> [f64; 3] {
        match self {
            Self::Driven { inertia } => [1.0, inertia, 0.0],
            Self::Given { acceleration } => [0.0, 1.0, acceleration],
        }
    }

    /// The motor's own inertia.
    pub(super) fn inertia(self) -> f64 {
        match self {
            Self::Driven { inertia } => inertia,
            Self::Given { .. } => 0.0,
        }
    }
}

/// A force and a moment, or the velocity of a point and an angular velocity; along axes and about a
/// point that the context says.
#[derive(Clone, Copy)]
pub(super) struct Wrench {
    pub(super) force: Vector3<f64>,
    pub(super) moment: Vector3<f64>,
}

/// What a device is put to beside its motion.
#[derive(Clone)]
pub(super) struct Probe {
    /// On each body only: expressed in its own axes, about its joint's origin.
    pub(super) acting: Vec<Wrench>,
    /// Of a field of acceleration `G r`: symmetric, and not free of a trace.
    pub(super) gradient: Matrix3<f64>,
    /// A rigid motion: velocity of B and angular velocity.
    pub(super) twist: Wrench,
}

/// What the equations of motion are solved for.
#[derive(Clone)]
pub(super) struct Accelerations {
    /// Inertial acceleration of point B, along B.
    pub(super) point: Vector3<f64>,
    pub(super) omega: Vector3<f64>,
    pub(super) joints: Vec<f64>,
}

impl Drive {
    /// Kinetic energy of the motors' own inertias.
    pub(super) fn energy(&self, motion: &Motion) -> f64 {
        let motors = self.modes.iter().zip(&motion.rates);
        motors.map(|(mode, rate)| 0.5 * mode.inertia() * rate * rate).sum()
    }
}

impl Motion {
    /// The motion a short time later, to first order: enough for a first derivative.
    pub(super) fn after(&self, time: f64, a: &Accelerations) -> Self {
        let advance =
            |x: &[f64], rate: &[f64]| x.iter().zip(rate).map(|(x, rate)| x + time * rate).collect();
        Self {
            coordinates: advance(&self.coordinates, &self.rates),
            rates: advance(&self.rates, &a.joints),
            omega: self.omega + time * a.omega,
            // Components along axes that turn with B.
            velocity: self.velocity + time * (a.point - self.omega.cross(&self.velocity)),
        }
    }

    /// The same pose with the hub at rest and one rate per joint.
    pub(super) fn joints_alone(&self, rates: Vec<f64>) -> Self {
        let zero = Vector3::zeros();
        let coordinates = self.coordinates.clone();
        Self { coordinates, rates, omega: zero, velocity: zero }
    }
}

impl Wrench {
    pub(super) fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }

    /// Both act.
    pub(super) fn plus(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }

    /// Turned by `axes`, whose columns are the axes of the components.
    pub(super) fn turned(self, axes: &Matrix3<f64>) -> Self {
        Self { force: axes * self.force, moment: axes * self.moment }
    }

    /// The same about a point from which the present one lies at `arm`.
    pub(super) fn moved(self, arm: Vector3<f64>) -> Self {
        Self { moment: self.moment + arm.cross(&self.force), ..self }
    }

    /// What it does to a point that moves at `velocity` with a body that turns at `omega`.
    pub(super) fn power(self, velocity: &Vector3<f64>, omega: &Vector3<f64>) -> f64 {
        self.force.dot(velocity) + self.moment.dot(omega)
    }

    /// Its six components.
    pub(super) fn list(self) -> [f64; 6] {
        let (f, n) = (self.force, self.moment);
        [f.x, f.y, f.z, n.x, n.y, n.z]
    }
}

/// The random numbers of the cases: `SplitMix64`, the same everywhere.
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Either sign, between a half and three halves.
    pub(super) fn signed(&mut self) -> f64 {
        let size = self.within(0.5, 1.5);
        if self.bits() & 1 == 0 { size } else { -size }
    }

    pub(super) fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.signed())
    }

    pub(super) fn list(&mut self, length: usize) -> Vec<f64> {
        (0..length).map(|_| self.signed()).collect()
    }

    /// The inertia of a cloud of masses: three moments that obey the triangle inequality.
    fn inertia(&mut self) -> Matrix3<f64> {
        let g = Matrix3::from_fn(|_, _| 0.6 * self.signed());
        let spread = g * g.transpose();
        Matrix3::from_diagonal_element(spread.trace() + 0.5) - spread
    }

    /// A rotation without a zero in it, most likely.
    fn rotation(&mut self) -> Matrix3<f64> {
        Rotation3::from_scaled_axis(self.vector()).into_inner()
    }

    /// Accelerations that obey no law.
    pub(super) fn accelerations(&mut self, joints: usize) -> Accelerations {
        Accelerations { point: self.vector(), omega: self.vector(), joints: self.list(joints) }
    }

    fn wrench(&mut self) -> Wrench {
        Wrench { force: self.vector(), moment: self.vector() }
    }

    /// What acts on so many bodies, a field and a rigid motion.
    pub(super) fn probe(&mut self, bodies: usize) -> Probe {
        let acting = (0..bodies).map(|_| self.wrench()).collect();
        let half = Matrix3::from_fn(|_, _| 0.5 * self.signed());
        Probe { acting, gradient: half + half.transpose(), twist: self.wrench() }
    }

    /// A spacecraft with one device of `kind`, in a state.
    pub(super) fn case(&mut self, kind: &Kind, name: CaseName) -> Case {
        let joints = kind.links.len();
        let hub =
            Hub { mass: self.within(0.5, 1.5), centre: self.vector(), inertia: self.inertia() };
        let mut parameters: Vec<f64> = Vec::new();
        let fields = parameters_of(kind);
        while parameters.len() < fields.len() {
            let name = &fields[parameters.len()];
            let inertia = |link: &&Link| link.body.inertia.names().into_iter().flatten().next();
            let own = |link: &&Link| inertia(link).as_ref() == Some(name);
            if let Some(link) = kind.links.iter().find(own) {
                parameters.extend(patterned(&self.inertia(), &link.body.inertia.names()));
            } else if kind.links.iter().any(|link| Some(name.as_str()) == link.body.mass) {
                parameters.push(self.within(0.5, 1.5));
            } else {
                parameters.push(self.signed());
            }
        }
        let motion = Motion {
            coordinates: self.list(joints),
            rates: self.list(joints),
            omega: self.vector(),
            velocity: self.vector(),
        };
        let drive = Drive {
            motors: self.list(joints),
            modes: Mode::of_kind(kind, |_| Mode::DRIVEN),
            force: self.vector(),
            torque: self.vector(),
        };
        Case { name, hub, mount: self.rotation(), parameters, motion, drive }
    }

    /// Modes with every other joint's acceleration given, `first` or its neighbours. The motors of
    /// the others have inertias of their own.
    pub(super) fn modes(&mut self, kind: &Kind, first: usize) -> Vec<Mode> {
        Mode::of_kind(kind, |k| {
            if k % 2 == first {
                Mode::Given { acceleration: self.signed() }
            } else {
                Mode::Driven { inertia: self.within(0.5, 1.5) }
            }
        })
    }
}

/// What a pattern leaves of an inertia: the mean of the entries under each name, in order. A moment
/// that stands for two is still no larger than the sum of the others.
fn patterned(t: &Matrix3<f64>, names: &[Option<String>; 6]) -> Vec<f64> {
    const ENTRIES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
    let mut groups: Vec<(&String, Vec<f64>)> = Vec::new();
    for (name, entry) in names.iter().zip(ENTRIES) {
        let Some(name) = name else { continue };
        match groups.iter_mut().find(|(known, _)| *known == name) {
            Some((_, entries)) => entries.push(t[entry]),
            None => groups.push((name, vec![t[entry]])),
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "one or two")]
    let mean = |(_, entries): &(_, Vec<f64>)| {
        entries.iter().map(|entry| entry / entries.len() as f64).sum::<f64>()
    };
    groups.iter().map(mean).collect()
}

/// The names of a kind's parameters, in order; the mount is not among them.
pub(super) fn parameters_of(kind: &Kind) -> Vec<String> {
    let names = parameters(kind).fields.into_iter().map(|field| field.name);
    names.filter(|name| !name.starts_with("mount_")).collect()
}
