//! A run of two imbalanced VSCMGs with motors against Basilisk's own effector for VSCMGs, fully
//! coupled, 20,000 steps of RK4: `fixtures/gyros.json`, written by `engines/gyros.py`.
//!
//! Both runs take the same steps, the attitude in MRPs, from the same state, so that they differ by
//! rounding only. Run with `--nocapture` to see the differences.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::vscmg::{Joints, PerJoint};
use precess_dynamics::{Hub, ImbalanceModel, Inputs, Mrp, Passive, Spacecraft, State, Vscmg};
use precess_tests::blocks::largest;
use precess_tests::bounds::GYROS_BESIDE_BASILISK;
use precess_tests::stored::symmetric;
use serde::Deserialize;
use serde_json::Value;

/// Written by `tests/engines/gyros.py`.
const TEXT: &str = include_str!("../../fixtures/gyros.json");

const GYROS: usize = 2;

type Set = [Vscmg; GYROS];
type Triple = [f64; 3];

#[derive(Deserialize)]
struct Stored {
    basilisk: String,
    step: f64,
    steps: u32,
    hub: StoredHub,
    gyros: [StoredGyro; GYROS],
    samples: Vec<Sample>,
}

#[derive(Clone, Copy, Deserialize)]
#[expect(clippy::struct_field_names, reason = "the names of `Hub`: frames and points")]
struct StoredHub {
    m_b: f64,
    r_bc_b: Triple,
    i_b: [f64; 6],
}

#[derive(Clone, Copy, Deserialize)]
struct StoredGyro {
    mount: [Triple; 3],
    r_g_b: Triple,
    m_g: f64,
    r_gc_g: Triple,
    i_g_gc: [f64; 6],
    l_g_xz: [f64; 2],
    m_w: f64,
    i_w_wc: Triple,
    u_s: f64,
    u_d: f64,
    u_g: f64,
    u_w: f64,
}

/// The state after some steps: of B in N, and of the gyros.
#[derive(Clone, Copy, Deserialize)]
struct Sample {
    steps: u32,
    position: Triple,
    velocity: Triple,
    mrp: Triple,
    omega: Triple,
    gamma: [f64; GYROS],
    gamma_dot: [f64; GYROS],
    theta: [f64; GYROS],
    spin: [f64; GYROS],
}

/// Names and units, in the order of [`Sample::blocks`].
const QUANTITIES: [(&str, &str); 8] = [
    ("position of B", "m"),
    ("velocity of B", "m/s"),
    ("attitude (MRPs)", "1"),
    ("angular velocity of the hub", "rad/s"),
    ("angles of the gimbals", "rad"),
    ("rates of the gimbals", "rad/s"),
    ("angles of the wheels", "rad"),
    ("rates of the wheels", "rad/s"),
];

impl StoredGyro {
    fn vscmg(&self) -> Vscmg {
        let [xx, yy, zz] = self.i_w_wc;
        let [x, z] = self.l_g_xz;
        Vscmg {
            mount: Matrix3::from_rows(&self.mount.map(|row| Vector3::from(row).transpose())),
            r_g_b: self.r_g_b.into(),
            m_g: self.m_g,
            r_gc_g: self.r_gc_g.into(),
            i_g_gc: symmetric(self.i_g_gc),
            l_g: Vector3::new(x, 0.0, z),
            m_w: self.m_w,
            d: self.u_s / self.m_w,
            i_w_wc: symmetric([xx, 0.0, self.u_d, yy, 0.0, zz]),
            passive: PerJoint::all(Passive::none()),
            model: ImbalanceModel::Coupled,
        }
    }
}

impl Sample {
    fn blocks(&self) -> [&[f64]; 8] {
        let Self { position, velocity, mrp, omega, gamma, gamma_dot, theta, spin, .. } = self;
        [position, velocity, mrp, omega, gamma, gamma_dot, theta, spin]
    }

    fn state(&self) -> State<Set, Mrp> {
        let joints = |k: usize| Joints {
            gamma: self.gamma[k],
            theta: self.theta[k],
            gamma_dot: self.gamma_dot[k],
            spin: self.spin[k],
        };
        State {
            r_b_n: self.position.into(),
            r_b_n_dot: self.velocity.into(),
            attitude: Mrp(self.mrp.into()),
            omega: self.omega.into(),
            devices: core::array::from_fn(joints),
            modal: (),
        }
    }

    fn from_state(steps: u32, state: &State<Set, Mrp>) -> Self {
        Self {
            steps,
            position: state.r_b_n.into(),
            velocity: state.r_b_n_dot.into(),
            mrp: state.attitude.0.into(),
            omega: state.omega.into(),
            gamma: state.devices.map(|joints| joints.gamma),
            gamma_dot: state.devices.map(|joints| joints.gamma_dot),
            theta: state.devices.map(|joints| joints.theta),
            spin: state.devices.map(|joints| joints.spin),
        }
    }
}

impl Stored {
    /// The largest difference of each quantity over the run, in units of its largest magnitude, and
    /// that magnitude.
    fn differences(&self) -> [(f64, f64); 8] {
        let ours = self.run();
        core::array::from_fn(|block| {
            let numbers = |samples: &[Sample]| -> Vec<f64> {
                samples.iter().flat_map(|sample| sample.blocks()[block].to_vec()).collect()
            };
            let (ours, theirs) = (numbers(&ours), numbers(&self.samples));
            let unit = largest(theirs.iter().map(|number| number.abs()));
            (largest(ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs())) / unit, unit)
        })
    }

    /// Our states after as many steps as those of the file.
    fn run(&self) -> Vec<Sample> {
        let StoredHub { m_b, r_bc_b, i_b } = self.hub;
        let hub = Hub { m_b, r_bc_b: r_bc_b.into(), i_b_bc: symmetric(i_b) };
        let gyros = self.gyros.map(|gyro| gyro.vscmg());
        let spacecraft = Spacecraft::new(&hub, &gyros).expect("valid");
        let mut inputs: Inputs<Set> = Inputs::none();
        for (motors, gyro) in inputs.motors.iter_mut().zip(&self.gyros) {
            (motors.u_g, motors.u_w) = (gyro.u_g, gyro.u_w);
        }
        let mut state = self.samples[0].state();
        let mut made = 0;
        let until = |sample: &Sample| {
            while made < sample.steps {
                state = spacecraft.step(&state, &inputs, self.step).expect("regular");
                made += 1;
            }
            Sample::from_state(made, &state)
        };
        self.samples.iter().map(until).collect()
    }
}

#[test]
fn two_imbalanced_vscmgs_move_as_basilisk_moves_them() {
    let stored: Stored = serde_json::from_str(TEXT).expect("written by engines/gyros.py");
    assert_eq!((stored.steps, stored.samples.len()), (20_000, 21));
    for ((error, largest), (quantity, unit)) in stored.differences().into_iter().zip(QUANTITIES) {
        println!("{quantity}: {error:.1e} of {largest:.3} {unit}");
        assert!(
            error <= GYROS_BESIDE_BASILISK,
            "{quantity} differs from Basilisk {} by {error:e} of {largest} {unit}, above \
             {GYROS_BESIDE_BASILISK:e}",
            stored.basilisk
        );
    }
}

/// What every parameter is changed by, to see whether the comparison notices.
const CHANGE: f64 = 1.0 + 1e-8;

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_change_of_any_parameter_of_a_gyro_shows() {
    let file: Value = serde_json::from_str(TEXT).expect("written by engines/gyros.py");
    let names =
        ["r_g_b", "m_g", "r_gc_g", "i_g_gc", "l_g_xz", "m_w", "i_w_wc", "u_s", "u_d", "u_g", "u_w"];
    for name in names {
        let mut changed = file.clone();
        for gyro in changed["gyros"].as_array_mut().expect("a list") {
            for number in numbers(&mut gyro[name]) {
                *number = (number.as_f64().expect("a number") * CHANGE).into();
            }
        }
        let stored: Stored = serde_json::from_value(changed).expect("numbers for numbers");
        let worst = largest(stored.differences().map(|(error, _)| error));
        println!("{name}: {worst:.1e}");
        assert!(worst > 10.0 * GYROS_BESIDE_BASILISK, "{name}, changed by 1e-8: {worst:e}");
    }
}

fn numbers(value: &mut Value) -> Vec<&mut Value> {
    match value {
        Value::Array(entries) => entries.iter_mut().collect(),
        number => vec![number],
    }
}
