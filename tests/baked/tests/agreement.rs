//! Kernels of one spacecraft against the general solver, on random states: every mode, errors
//! included.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess_description::Description;
use precess_dynamics::kind::{BodyParameters, ImbalanceModel};
use precess_dynamics::{
    BuiltIn, BuiltInKind, DeviceParameters, Each as _, Hub, Inputs, JointArray, Mode, Passive,
    Quaternion, Spacecraft, State,
};
use precess_tests::blocks::largest;
use precess_tests::bounds::ACCELERATIONS_WORST;

/// A list of devices of any kind.
type Set = Vec<BuiltIn>;

/// Random states of each spacecraft.
const STATES: u32 = 300;

fn description(name: &str) -> Description {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let text = std::fs::read_to_string(file.join("description.toml")).expect("a description");
    Description::read(&text).expect("a description")
}

fn matrix(rows: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}

/// The spacecraft for the general solver.
fn general(description: &Description) -> Spacecraft<Set> {
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
        let mut bodies = [none; 3];
        for (to, body) in bodies.iter_mut().zip(&device.body) {
            *to = BodyParameters {
                origin: body.origin,
                mass: body.mass,
                centre: body.centre_of_mass,
                inertia: matrix(&body.inertia),
            };
        }
        let passive = [Passive::none(); 3];
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
struct Joint {
    at: [f64; 2],
    torque: bool,
    given: f64,
}

/// Accelerations of B, angular acceleration, and those of each joint of each device.
type Found = ([f64; 3], [f64; 3], Vec<Vec<f64>>);

/// A random state of a spacecraft and what acts on it.
struct Drawn {
    omega: [f64; 3],
    force: [f64; 3],
    torque_b: [f64; 3],
    /// Device by device, body by body; locked ones stand.
    joints: Vec<Vec<Joint>>,
}

fn drawn(description: &Description, seed: u32) -> Drawn {
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
fn expected(
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

/// The largest error of a block, in units of its largest magnitude.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    let scale = largest(expected.iter().copied());
    let errors = found.iter().zip(expected).map(|(found, expected)| (found - expected).abs());
    let worst = largest(errors);
    // An acceleration that is given is exactly that, zero included.
    if scale > 0.0 { worst / scale } else { worst }
}

/// A device of the emitted crate.
macro_rules! device {
    ($mission:ident::$shape:ident, $of:expr $(, $locked:ident: $k:literal)*) => {{
        let of: &precess_description::Device = $of;
        $mission::$shape::Device {
            mount: of.mount,
            bodies: std::array::from_fn(|k| $mission::Body {
                mass: of.body[k].mass,
                origin: of.body[k].origin,
                centre_of_mass: of.body[k].centre_of_mass,
                inertia: of.body[k].inertia,
            }),
            $($locked: of.body[$k].locked_at.unwrap_or_default(),)*
        }
    }};
}

macro_rules! hub {
    ($mission:ident, $of:expr) => {
        $mission::Hub {
            mass: $of.hub.mass,
            centre_of_mass: $of.hub.centre_of_mass,
            inertia: $of.hub.inertia,
        }
    };
}

macro_rules! drive {
    ($mission:ident, $of:expr) => {
        if $of.torque {
            $mission::Drive::Torque($of.given)
        } else {
            $mission::Drive::Acceleration($of.given)
        }
    };
}

/// Holds every random state of a spacecraft against the general solver.
fn agree(name: &str, description: &Description, found: impl Fn(&Drawn) -> Option<Found>) {
    let spacecraft = general(description);
    let (mut worst, mut solved) = (0.0_f64, 0);
    for seed in 0..STATES {
        let drawn = drawn(description, seed);
        let expected = expected(&spacecraft, description, &drawn);
        let found = found(&drawn);
        assert_eq!(found.is_some(), expected.is_some(), "{name}: state {seed} has accelerations");
        let (Some(found), Some(expected)) = (found, expected) else { continue };
        solved += 1;
        let joint = |all: &[Vec<f64>], k: usize| -> Vec<f64> {
            all.iter().filter_map(|device| device.get(k).copied()).collect()
        };
        let mut errors = vec![off(&found.0, &expected.0), off(&found.1, &expected.1)];
        errors.extend((0..3).map(|k| off(&joint(&found.2, k), &joint(&expected.2, k))));
        worst = worst.max(largest(errors));
    }
    assert!(solved > STATES / 2, "{name}: only {solved} states have accelerations");
    assert!(worst <= ACCELERATIONS_WORST, "{name}: off by {worst:e}");
    println!("{name}: {solved} states, worst {worst:.1e} of the block");
}

#[test]
fn imaging_satellite_with_locked_gimbals() {
    let description = description("imaging_satellite");
    let devices = &description.device;
    let baked = imaging_satellite::Spacecraft::new(&imaging_satellite::Parameters {
        hub: hub!(imaging_satellite, description),
        cmg: std::array::from_fn(
            |k| device!(imaging_satellite::cmg, &devices[k], gamma_o: 0, gamma_i: 1),
        ),
    })
    .expect("as assumed");
    agree("imaging_satellite", &description, |drawn| {
        let wheel = |k: usize| drawn.joints[k][2];
        let state = imaging_satellite::State {
            omega: drawn.omega,
            cmg: std::array::from_fn(|k| {
                let [theta, spin] = wheel(k).at;
                imaging_satellite::cmg::Joints { theta, spin }
            }),
        };
        let inputs = imaging_satellite::Inputs {
            force: drawn.force,
            torque_b: drawn.torque_b,
            cmg: std::array::from_fn(|k| imaging_satellite::cmg::Drives {
                u_w: drive!(imaging_satellite, wheel(k)),
            }),
        };
        let found = baked.accelerations(&state, &inputs).ok()?;
        let joints = found.cmg.iter().map(|own| vec![0.0, 0.0, own.spin_dot]);
        Some((found.r_b_n_ddot, found.omega_dot, joints.collect()))
    });
}

#[test]
fn table1_with_every_joint_free() {
    let description = description("table1");
    let baked = table1::Spacecraft::new(&table1::Parameters {
        hub: hub!(table1, description),
        cmg: [device!(table1::cmg, &description.device[0])],
    })
    .expect("as assumed");
    agree("table1", &description, |drawn| {
        let [o, i, w] = [0, 1, 2].map(|k| drawn.joints[0][k]);
        let joints = table1::cmg::Joints {
            gamma_o: o.at[0],
            gamma_o_dot: o.at[1],
            gamma_i: i.at[0],
            gamma_i_dot: i.at[1],
            theta: w.at[0],
            spin: w.at[1],
        };
        let drives = table1::cmg::Drives {
            u_o: drive!(table1, o),
            u_i: drive!(table1, i),
            u_w: drive!(table1, w),
        };
        let state = table1::State { omega: drawn.omega, cmg: [joints] };
        let inputs = table1::Inputs { force: drawn.force, torque_b: drawn.torque_b, cmg: [drives] };
        let found = baked.accelerations(&state, &inputs).ok()?;
        let [own] = found.cmg;
        let joints = vec![vec![own.gamma_o_ddot, own.gamma_i_ddot, own.spin_dot]];
        Some((found.r_b_n_ddot, found.omega_dot, joints))
    });
}

#[test]
fn four_wheels_each_with_a_kernel_of_its_own() {
    let description = description("four_wheels");
    let devices = &description.device;
    let baked = four_wheels::Spacecraft::new(&four_wheels::Parameters {
        hub: hub!(four_wheels, description),
        wheel_x: [device!(four_wheels::wheel_x, &devices[0])],
        wheel_y: [device!(four_wheels::wheel_y, &devices[1])],
        wheel_z: [device!(four_wheels::wheel_z, &devices[2])],
        wheel_skew: [device!(four_wheels::wheel_skew, &devices[3])],
    })
    .expect("as assumed");
    agree("four_wheels", &description, |drawn| {
        macro_rules! joints {
            ($shape:ident, $k:literal) => {{
                let [theta, spin] = drawn.joints[$k][0].at;
                [four_wheels::$shape::Joints { theta, spin }]
            }};
        }
        macro_rules! drives {
            ($shape:ident, $k:literal) => {
                [four_wheels::$shape::Drives { u_w: drive!(four_wheels, drawn.joints[$k][0]) }]
            };
        }
        let state = four_wheels::State {
            omega: drawn.omega,
            wheel_x: joints!(wheel_x, 0),
            wheel_y: joints!(wheel_y, 1),
            wheel_z: joints!(wheel_z, 2),
            wheel_skew: joints!(wheel_skew, 3),
        };
        let inputs = four_wheels::Inputs {
            force: drawn.force,
            torque_b: drawn.torque_b,
            wheel_x: drives!(wheel_x, 0),
            wheel_y: drives!(wheel_y, 1),
            wheel_z: drives!(wheel_z, 2),
            wheel_skew: drives!(wheel_skew, 3),
        };
        let found = baked.accelerations(&state, &inputs).ok()?;
        let all = [
            found.wheel_x[0].spin_dot,
            found.wheel_y[0].spin_dot,
            found.wheel_z[0].spin_dot,
            found.wheel_skew[0].spin_dot,
        ];
        Some((found.r_b_n_ddot, found.omega_dot, all.map(|own| vec![own]).to_vec()))
    });
}

#[test]
fn an_angle_that_is_no_number_is_an_error_in_both() {
    let description = description("table1");
    let spacecraft = general(&description);
    let baked = table1::Spacecraft::new(&table1::Parameters {
        hub: hub!(table1, description),
        cmg: [device!(table1::cmg, &description.device[0])],
    })
    .expect("as assumed");
    let mut drawn = drawn(&description, 1);
    drawn.joints[0][0].at[0] = f64::NAN;
    assert!(expected(&spacecraft, &description, &drawn).is_none());
    let [o, i, w] = [0, 1, 2].map(|k| drawn.joints[0][k]);
    let joints = table1::cmg::Joints {
        gamma_o: o.at[0],
        gamma_o_dot: o.at[1],
        gamma_i: i.at[0],
        gamma_i_dot: i.at[1],
        theta: w.at[0],
        spin: w.at[1],
    };
    let drives = table1::cmg::Drives {
        u_o: table1::Drive::Torque(0.0),
        u_i: table1::Drive::Torque(0.0),
        u_w: table1::Drive::Torque(0.0),
    };
    let state = table1::State { omega: drawn.omega, cmg: [joints] };
    let inputs = table1::Inputs { force: [0.0; 3], torque_b: [0.0; 3], cmg: [drives] };
    assert!(baked.accelerations(&state, &inputs).is_err());
}
