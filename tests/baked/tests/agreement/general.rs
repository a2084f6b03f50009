//! A described spacecraft in the general solver, at random states.

use nalgebra::{Matrix3, Vector3};
use precess_description::Description;
use precess_dynamics::kind::{BodyParameters, ImbalanceModel};
use precess_dynamics::{
    BuiltIn, BuiltInKind, DeviceParameters, Each as _, Hub, Inputs, JointArray, MAX_JOINTS, Mode,
    Passive, Quaternion, Spacecraft, State,
};

/// A list of devices of any kind.
pub(crate) type Set = Vec<BuiltIn>;

fn matrix(rows: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}

/// The spacecraft for the general solver.
pub(crate) fn general(description: &Description) -> Spacecraft<Set> {
    let hub = Hub {
        m_b: description.hub.mass,
        r_bc_b: Vector3::from(description.hub.centre_of_mass),
        i_b_bc: matrix(&description.hub.inertia),
    };
    let devices = description.device.iter().map(|device| {
        let none = BodyParameters {
            origin: [0.0; 3],
            mass: 0.0,
            centre: [0.0; 3],
            inertia: Matrix3::zeros(),
        };
        let mut bodies = [none; MAX_JOINTS];
        for (to, body) in bodies.iter_mut().zip(&device.body) {
            *to = BodyParameters {
                origin: body.origin,
                mass: body.mass,
                centre: body.centre_of_mass,
                inertia: matrix(&body.inertia),
            };
        }
        let passive = [Passive::none(); MAX_JOINTS];
        let (mount, model) = (matrix(&device.mount), ImbalanceModel::Coupled);
        let kind = BuiltInKind::of_name(&device.kind).expect("a kind");
        BuiltIn::new(kind, &DeviceParameters { mount, bodies, passive, model }).expect("a device")
    });
    Spacecraft::new(&hub, &devices.collect::<Set>()).expect("a spacecraft")
}

/// Numbers between -1 and 1.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let upper = u32::try_from(self.0 >> 32).expect("32 bits");
        f64::from(upper) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    fn vector(&mut self, scale: f64) -> [f64; 3] {
        [(); 3].map(|()| scale * self.next())
    }
}

/// A joint's coordinate and rate, whether its torque is given, and what is given.
#[derive(Clone, Copy)]
pub(crate) struct Joint {
    pub(crate) at: [f64; 2],
    pub(crate) torque: bool,
    pub(crate) given: f64,
}

/// Accelerations of B, angular acceleration, and those of each joint of each device.
pub(crate) type Found = ([f64; 3], [f64; 3], Vec<Vec<f64>>);

/// A random state of a spacecraft and what acts on it.
pub(crate) struct Drawn {
    pub(crate) omega: [f64; 3],
    pub(crate) force: [f64; 3],
    pub(crate) torque_b: [f64; 3],
    /// Device by device, body by body; locked ones are at rest.
    pub(crate) joints: Vec<Vec<Joint>>,
}

pub(crate) fn drawn(description: &Description, seed: u32) -> Drawn {
    let mut draws = Draws(u64::from(seed) * 977 + 5);
    let joints = description.device.iter().map(|device| {
        let tip = device.body.len() - 1;
        let joint = |(k, body): (usize, &precess_description::Body)| {
            if let Some(at) = body.locked_at {
                return Joint { at: [at, 0.0], torque: false, given: 0.0 };
            }
            let rate = if k == tip { 600.0 } else { 5.0 } * draws.next();
            let torque = draws.next() > -0.5;
            Joint { at: [20.0 * draws.next(), rate], torque, given: draws.next() }
        };
        device.body.iter().enumerate().map(joint).collect()
    });
    let joints = joints.collect();
    let [omega, force, torque_b] = [1.0, 10.0, 5.0].map(|scale| draws.vector(scale));
    Drawn { omega, force, torque_b, joints }
}

/// Accelerations by the general solver: of the hub, and of each joint of each device.
pub(crate) fn expected(
    spacecraft: &Spacecraft<Set>,
    description: &Description,
    drawn: &Drawn,
) -> Option<Found> {
    let mut state: State<Set, Quaternion> = State::at_rest_for(spacecraft);
    let mut inputs = Inputs::none_for(spacecraft);
    state.omega = Vector3::from(drawn.omega);
    inputs.force = Vector3::from(drawn.force);
    inputs.torque_b = Vector3::from(drawn.torque_b);
    for (to, from) in state.devices.iter_mut().zip(&drawn.joints) {
        for (to, from) in to.as_mut_slice().iter_mut().zip(from) {
            *to = from.at;
        }
    }
    let flat = drawn.joints.iter().flatten();
    let locked = description.device.iter().flat_map(|d| &d.body).map(|b| b.locked_at.is_some());
    for ((motor, mode), (joint, locked)) in
        inputs.motors.values_mut().zip(inputs.modes.values_mut()).zip(flat.zip(locked))
    {
        match (locked, joint.torque) {
            (true, _) => *mode = Mode::Locked,
            (false, true) => (*motor, *mode) = (joint.given, Mode::Driven),
            (false, false) => *mode = Mode::Prescribed(joint.given),
        }
    }
    let found = spacecraft.accelerations(&state, &inputs).ok()?;
    let joints = found.devices.iter().map(|device: &JointArray<f64>| device.as_slice().to_vec());
    Some((found.r_b_n_ddot.into(), found.omega_dot.into(), joints.collect()))
}
