//! A spacecraft with its state and what acts on it, as plain numbers: random ones, and as the C program reads
//! them.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    BuiltIn, BuiltInKind, DeviceParameters, ImbalanceModel, MAX_JOINTS, ParameterValue, Passive,
    Shape,
};

use crate::random::Random;

/// Which numbers of a case are drawn.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is tested with and without")]
pub(crate) struct Settings {
    pub(crate) mrp: bool,
    /// Springs, dampers and dry friction.
    pub(crate) passive: bool,
    pub(crate) wrenches: bool,
    /// Of `PRECESS_..._FIELD`.
    pub(crate) field: u8,
    /// Of `PRECESS_HUB_...`.
    pub(crate) hub: u8,
    /// Whether some joints are locked, some prescribed.
    pub(crate) modes: bool,
    pub(crate) dt: f64,
    pub(crate) steps: usize,
}

/// A joint: its state and what is given of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    pub(crate) coordinate: f64,
    pub(crate) rate: f64,
    /// Of `PRECESS_DRIVEN` and so on.
    pub(crate) mode: u8,
    pub(crate) torque: f64,
    pub(crate) acceleration: f64,
    pub(crate) force: [f64; 3],
    pub(crate) moment: [f64; 3],
}

/// A spacecraft, its state, and what acts on it.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) settings: Settings,
    pub(crate) mass: f64,
    pub(crate) centre_of_mass: [f64; 3],
    pub(crate) inertia: [f64; 6],
    pub(crate) devices: Vec<BuiltIn>,
    pub(crate) r_b_n: [f64; 3],
    pub(crate) r_b_n_dot: [f64; 3],
    pub(crate) attitude: [f64; 4],
    pub(crate) omega: [f64; 3],
    pub(crate) joints: Vec<Joint>,
    pub(crate) force: [f64; 3],
    pub(crate) torque_b: [f64; 3],
    /// Of a prescribed hub.
    pub(crate) r_b_n_ddot: [f64; 3],
    pub(crate) omega_dot: [f64; 3],
    pub(crate) uniform: [f64; 3],
    pub(crate) mu: f64,
}

impl Case {
    /// A random one of a set of kinds.
    pub(crate) fn random(kinds: &[BuiltInKind], settings: Settings, random: &mut Random) -> Self {
        let (mut devices, mut joints) = (Vec::new(), Vec::new());
        for kind in kinds {
            devices.push(device(*kind, settings, random));
            joints.extend(kind.joints().iter().map(|info| {
                let reach = if info.slides { 1e-3 } else { 3.0 };
                let spins = info.tip && !info.slides && kind.name() != "hinged_panel";
                // The products of inertia of such a wheel would tear it out of its bearings.
                let spin = if kind.name().starts_with("flexible") { 10.0 } else { 200.0 };
                let fast = if info.slides { 0.01 } else { 0.3 };
                let mut joint = Joint {
                    coordinate: random.within(-reach, reach),
                    rate: random.within(-1.0, 1.0) * if spins { spin } else { fast },
                    mode: u8::from(!info.driven),
                    torque: random.within(-0.1, 0.1),
                    acceleration: 0.0,
                    force: random.vector(0.1),
                    moment: random.vector(0.1),
                };
                if settings.modes && info.driven && random.bits().is_multiple_of(2) {
                    joint.mode = if random.bits().is_multiple_of(2) { 1 } else { 2 };
                    joint.acceleration = random.within(-0.1, 0.1);
                }
                if joint.mode == 2 {
                    joint.rate = 0.0;
                }
                joint
            }));
        }
        let moving = if settings.hub == 1 { 0.0 } else { 1.0 };
        let mass = random.within(100.0, 300.0);
        let [q0, q1, q2, q3] = [(); 4].map(|()| random.within(-1.0, 1.0));
        let size = (q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3).sqrt();
        let attitude =
            if settings.mrp { [q1, q2, q3, 0.0] } else { [q0, q1, q2, q3].map(|q| q / size) };
        Self {
            settings,
            mass,
            centre_of_mass: random.vector(0.2),
            inertia: [mass, 3.0, -2.0, 1.2 * mass, 1.0, 0.9 * mass],
            devices,
            r_b_n: random.vector(7e6),
            r_b_n_dot: random.vector(5e3 * moving),
            attitude,
            omega: random.vector(0.3 * moving),
            joints,
            force: random.vector(2.0),
            torque_b: random.vector(1.0),
            r_b_n_ddot: random.vector(0.1),
            omega_dot: random.vector(0.01),
            uniform: random.vector(9.0),
            mu: 3.986e14,
        }
    }

    /// As the C program reads it.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let mut numbers = vec![self.mass];
        numbers.extend(self.centre_of_mass);
        numbers.extend(self.inertia);
        numbers.push(f64::from(u8::from(self.settings.mrp)));
        let all: Vec<_> =
            self.devices.iter().map(|device| (device.kind(), device.parameters())).collect();
        numbers.extend(all.iter().flat_map(|(_, device)| device.mount.iter().copied()));
        for (kind, device) in &all {
            for (body, passive) in
                device.bodies.iter().zip(&device.passive).take(kind.joints().len())
            {
                numbers.push(body.mass);
                numbers.extend(body.origin);
                numbers.extend(body.centre);
                let i = &body.inertia;
                numbers.extend([i.m11, i.m12, i.m13, i.m22, i.m23, i.m33]);
                numbers.extend([passive.stiffness, passive.rest, passive.viscous]);
                numbers.extend([passive.coulomb, passive.coulomb_rate]);
            }
        }
        numbers.extend(self.r_b_n.iter().chain(&self.r_b_n_dot));
        numbers.extend(self.attitude.iter().chain(&self.omega));
        numbers.extend(self.joints.iter().map(|joint| joint.coordinate));
        numbers.extend(self.joints.iter().map(|joint| joint.rate));
        numbers.extend(self.force.iter().chain(&self.torque_b));
        for joint in &self.joints {
            numbers.extend([f64::from(joint.mode), joint.torque, joint.acceleration]);
        }
        numbers.push(f64::from(self.settings.hub));
        numbers.extend(self.r_b_n_ddot.iter().chain(&self.omega_dot));
        numbers.push(f64::from(self.settings.field));
        numbers.extend(self.uniform);
        numbers.extend([self.mu, f64::from(u8::from(self.settings.wrenches))]);
        numbers.extend(
            self.joints.iter().flat_map(|joint| joint.force.into_iter().chain(joint.moment)),
        );
        #[expect(clippy::cast_precision_loss, reason = "a count of steps is small")]
        numbers.extend([self.settings.dt, self.settings.steps as f64]);
        numbers
    }
}

/// A device of a kind with random parameters.
fn device(kind: BuiltInKind, settings: Settings, random: &mut Random) -> BuiltIn {
    let empty =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: Matrix3::zeros() };
    let none = DeviceParameters {
        mount: Matrix3::identity(),
        bodies: [empty; MAX_JOINTS],
        passive: [Passive::none(); MAX_JOINTS],
        model: ImbalanceModel::Coupled,
    };
    let mut device = BuiltIn::new(kind, &none).expect("nothing breaks the pattern of a kind");
    for info in kind.parameters() {
        let value = match (info.shape, info.unit) {
            (Shape::Scalar, "kg") => ParameterValue::Scalar(random.within(1.0, 5.0)),
            (Shape::Scalar, "kg m²") => ParameterValue::Scalar(random.within(0.1, 0.15)),
            (Shape::Scalar, _) => ParameterValue::Scalar(random.within(0.0, 1e-3)),
            (Shape::Vector, _) => ParameterValue::Vector(Vector3::from(random.vector(0.2))),
            (Shape::Rotation, _) => {
                ParameterValue::Matrix(Matrix3::from_row_slice(&random.rotation()))
            }
            (Shape::Symmetric, _) => {
                let [x, y, z] = random.vector(1e-3);
                let [a, b, c] = [(); 3].map(|()| random.within(0.1, 0.15));
                ParameterValue::Matrix(Matrix3::new(a, x, y, x, b, z, y, z, c))
            }
            (Shape::Model, _) => continue,
        };
        device.set_parameter(info.name, value).expect("a parameter of the kind");
    }
    let mut parameters = device.parameters();
    for (passive, info) in parameters.passive.iter_mut().zip(kind.joints()) {
        // A bearing without a spring would drift through its housing.
        let flexible = kind.name().starts_with("flexible");
        if settings.passive || flexible {
            let tip = info.tip && !info.slides && kind.name() != "hinged_panel";
            let stiffness = match (info.slides, flexible) {
                (true, _) => 4e4,
                // Gyroscopic torques of the wheel must not turn it over.
                (false, true) => 4e3,
                (false, false) => 40.0,
            };
            *passive = Passive {
                stiffness: if tip { 0.0 } else { stiffness },
                rest: random.within(-1e-4, 1e-4),
                viscous: random.within(0.0, if info.slides { 10.0 } else { 1e-3 }),
                coulomb: random.within(0.0, 1e-3),
                coulomb_rate: 0.1,
            };
        }
    }
    BuiltIn::new(kind, &parameters).expect("as it was, with springs")
}
