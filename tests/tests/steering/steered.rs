//! 100 s of a spacecraft with four VSCMGs that Basilisk steers, by `vscmgVelocitySteering` and `vscmgGimbalRateServo`
//! every 0.05 s: `fixtures/steered.json`, by `engines/steered.py`.
//!
//! Basilisk's servo drops what the hub's angular acceleration requires of the motors, `J_g g_g . omega'` and
//! `I_ws g_s . omega'`; its measure of singularity has the columns of the wheels' momentum only. Our loop drops the same, and differs by
//! rounding; with these terms it shows what they are worth. Run with `--nocapture`.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::vscmg::{Joints, PerJoint};
use precess_dynamics::{
    Hub, ImbalanceModel, Inputs, Mrp, Passive, Servo, Spacecraft, State, Steered, SteeringLaw,
    SteeringMatrix, SteeringTerms, Vscmg, steering_weights,
};
use precess_tests::blocks::largest;
use precess_tests::stored::symmetric;
use serde::Deserialize;
use serde_json::Value;

/// Written by `tests/engines/steered.py`.
const TEXT: &str = include_str!("../../fixtures/steered.json");

/// Of the largest magnitude of a block. Measured: 3.1e-15, since both loops take the same steps with the attitude in MRPs. A
/// change of any number of law and servo by 1e-6 shows as at least 6.8e-11.
const AGREEMENT: f64 = 1e-12;

const GYROS: usize = 4;
const JOINTS: usize = 2 * GYROS;

type Set = [Vscmg; GYROS];
type Triple = [f64; 3];
type Each = [f64; GYROS];

const STEERED: [Steered; JOINTS] = {
    let (rate, acceleration) = (Steered::Rate, Steered::Acceleration);
    [rate, acceleration, rate, acceleration, rate, acceleration, rate, acceleration]
};

const GIMBALS: [Steered; JOINTS] = {
    let (rate, nothing) = (Steered::Rate, Steered::Nothing);
    [rate, nothing, rate, nothing, rate, nothing, rate, nothing]
};

#[derive(Deserialize)]
struct Stored {
    basilisk: String,
    step: f64,
    control_every: u32,
    stiffness: f64,
    damping: f64,
    gain: f64,
    /// Of gimbals and of wheels.
    weights: [f64; 2],
    mu: f64,
    hub: StoredHub,
    gyros: [Gyro; GYROS],
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
struct Gyro {
    mount: [Triple; 3],
    r_g_b: Triple,
    m_g: f64,
    i_g_gc: [f64; 6],
    m_w: f64,
    i_w_wc: Triple,
    spin: f64,
}

/// The state after some steps, and what is commanded there.
#[derive(Clone, Deserialize)]
struct Sample {
    steps: u32,
    position: Triple,
    velocity: Triple,
    mrp: Triple,
    omega: Triple,
    gamma: Each,
    gamma_dot: Each,
    theta: Each,
    spin: Each,
    demand: Triple,
    gimbal_rates: Each,
    wheel_accelerations: Each,
    gimbal_torques: Each,
    wheel_torques: Each,
}

const BLOCKS: [(&str, &str); 13] = [
    ("position of B", "m"),
    ("velocity of B", "m/s"),
    ("attitude (MRPs)", "1"),
    ("angular velocity of the hub", "rad/s"),
    ("angles of the gimbals", "rad"),
    ("rates of the gimbals", "rad/s"),
    ("angles of the wheels", "rad"),
    ("rates of the wheels", "rad/s"),
    ("demanded torque", "N m"),
    ("commanded rates of gimbals", "rad/s"),
    ("commanded accelerations of wheels", "rad/s^2"),
    ("torques of gimbals", "N m"),
    ("torques of wheels", "N m"),
];

/// Of the servo and of the measure of singularity: as Basilisk has them, or whole.
#[derive(Clone, Copy, PartialEq)]
enum Terms {
    AsBasilisk,
    Whole,
}

/// Largest of what is dropped, over a run.
#[derive(Default)]
struct Dropped {
    /// N m.
    gimbal: f64,
    /// N m.
    wheel: f64,
    /// Of the weight of the wheels.
    weight: f64,
}

impl Sample {
    fn blocks(&self) -> [&[f64]; 13] {
        [
            &self.position,
            &self.velocity,
            &self.mrp,
            &self.omega,
            &self.gamma,
            &self.gamma_dot,
            &self.theta,
            &self.spin,
            &self.demand,
            &self.gimbal_rates,
            &self.wheel_accelerations,
            &self.gimbal_torques,
            &self.wheel_torques,
        ]
    }

    fn state(&self) -> State<Set, Mrp> {
        State {
            r_b_n: self.position.into(),
            r_b_n_dot: self.velocity.into(),
            attitude: Mrp(self.mrp.into()),
            omega: self.omega.into(),
            devices: core::array::from_fn(|k| Joints {
                gamma: self.gamma[k],
                theta: self.theta[k],
                gamma_dot: self.gamma_dot[k],
                spin: self.spin[k],
            }),
            modal: (),
        }
    }
}

impl Gyro {
    fn vscmg(&self) -> Vscmg {
        let [axial, transverse, _] = self.i_w_wc;
        Vscmg {
            mount: Matrix3::from_rows(&self.mount.map(|row| Vector3::from(row).transpose())),
            r_g_b: self.r_g_b.into(),
            m_g: self.m_g,
            r_gc_g: Vector3::zeros(),
            i_g_gc: symmetric(self.i_g_gc),
            l_g: Vector3::zeros(),
            m_w: self.m_w,
            d: 0.0,
            i_w_wc: symmetric([axial, 0.0, 0.0, transverse, 0.0, transverse]),
            passive: PerJoint::all(Passive::none()),
            model: ImbalanceModel::Coupled,
        }
    }

    /// `J_s` and `J_g`, of gimbal and wheel, kg m^2.
    fn moments(&self) -> [f64; 2] {
        [self.i_g_gc[0] + self.i_w_wc[0], self.i_g_gc[5] + self.i_w_wc[2]]
    }

    /// `g_s`, `g_t` and `g_g`, expressed in B.
    fn axes(&self, gamma: f64) -> [Vector3<f64>; 3] {
        let mount = Matrix3::from_rows(&self.mount.map(|row| Vector3::from(row).transpose()));
        let (sin, cos) = gamma.sin_cos();
        [Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0), Vector3::z()]
            .map(|axis| mount * axis)
    }
}

impl Stored {
    fn read() -> Self {
        serde_json::from_str(TEXT).expect("written by engines/steered.py")
    }

    /// `det(D1 D1^T)` of Schaub, Vadali, Junkins (1998), over the mean momentum to the sixth, as Basilisk has it.
    fn measure(&self, state: &State<Set, Mrp>, reference: f64) -> f64 {
        let columns: [_; GYROS] = core::array::from_fn(|k| {
            let (gyro, joints) = (&self.gyros[k], &state.devices[k]);
            let ([g_s, g_t, _], [j_s, _]) = (gyro.axes(joints.gamma), gyro.moments());
            let (omega_s, omega_t) = (g_s.dot(&state.omega), g_t.dot(&state.omega));
            (gyro.i_w_wc[0] * joints.spin + 0.5 * j_s * omega_s) * g_t + 0.5 * j_s * omega_t * g_s
        });
        SteeringMatrix { columns, drift: Vector3::<f64>::zeros() }.measure(reference)
    }

    /// What law and servo command in a state: rates and accelerations, torques.
    fn commanded(
        &self,
        craft: &Spacecraft<Set>,
        state: &State<Set, Mrp>,
        demand: &Vector3<f64>,
        terms: Terms,
        dropped: &mut Dropped,
    ) -> [[f64; JOINTS]; 2] {
        let reference: f64 =
            self.gyros.iter().map(|gyro| gyro.moments()[0] * gyro.spin / 4.0).sum();
        let steering: SteeringTerms<f64, JOINTS> = craft.steering_terms(state).expect("regular");
        let measures =
            [self.measure(state, reference), steering.matrix(&GIMBALS).measure(reference)];
        let [theirs, ours] =
            measures.map(|measure| steering_weights(&STEERED, self.weights, self.mu, measure));
        dropped.weight = dropped.weight.max((ours[1] / theirs[1] - 1.0).abs());
        let weights = if terms == Terms::AsBasilisk { theirs } else { ours };
        let law = SteeringLaw { weights, ..SteeringLaw::exact() };
        let matrix = steering.matrix(&STEERED);
        // Basilisk leaves the drift to the control law.
        let commands = law.allocate(&matrix, &(demand - matrix.drift)).expect("regular").commands;
        let gains = [self.gain; JOINTS];
        let servo = Servo { steered: STEERED, gains, limits: [f64::INFINITY; JOINTS] };
        let none = [0.0; JOINTS];
        let found = craft.servo(&servo, state, &Inputs::none(), &commands, &none).expect("regular");
        let mut torques = found.torques;
        for (k, (gyro, joints)) in self.gyros.iter().zip(&state.devices).enumerate() {
            let [g_s, _, g_g] = gyro.axes(joints.gamma);
            let omega_dot = &found.accelerations.omega_dot;
            let of_gimbal = gyro.moments()[1] * g_g.dot(omega_dot);
            let of_wheel = gyro.i_w_wc[0] * g_s.dot(omega_dot);
            dropped.gimbal = dropped.gimbal.max(of_gimbal.abs());
            dropped.wheel = dropped.wheel.max(of_wheel.abs());
            if terms == Terms::AsBasilisk {
                torques[2 * k] -= of_gimbal;
                torques[2 * k + 1] -= of_wheel;
            }
        }
        [commands, torques]
    }

    /// Our states and commands where the file has its own.
    fn run(&self, terms: Terms, dropped: &mut Dropped) -> Vec<Sample> {
        let StoredHub { m_b, r_bc_b, i_b } = self.hub;
        let hub = Hub { m_b, r_bc_b: r_bc_b.into(), i_b_bc: symmetric(i_b) };
        let craft = Spacecraft::new(&hub, &self.gyros.map(|gyro| gyro.vscmg())).expect("valid");
        let mut state = self.samples[0].state();
        let mut inputs: Inputs<Set> = Inputs::none();
        let (mut found, mut samples) = (Vec::new(), self.samples.iter().map(|at| at.steps));
        let (mut next, last) = (samples.next(), self.samples[self.samples.len() - 1].steps);
        for steps in 0..=last {
            if steps % self.control_every == 0 {
                let demand = -(self.stiffness * state.attitude.0 + self.damping * state.omega);
                let [commands, torques] = self.commanded(&craft, &state, &demand, terms, dropped);
                for (motors, torques) in inputs.motors.iter_mut().zip(torques.chunks_exact(2)) {
                    (motors.u_g, motors.u_w) = (torques[0], torques[1]);
                }
                if next == Some(steps) {
                    next = samples.next();
                    found.push(sample(steps, &state, &demand, &commands, &torques));
                }
            }
            state = craft.step(&state, &inputs, self.step).expect("regular");
        }
        found
    }

    /// The largest difference of each block over the run, in units of its largest magnitude, and that magnitude.
    fn differences(&self, found: &[Sample]) -> [(f64, f64); 13] {
        assert_eq!(found.len(), self.samples.len());
        core::array::from_fn(|block| {
            let numbers = |samples: &[Sample]| -> Vec<f64> {
                samples.iter().flat_map(|sample| sample.blocks()[block].to_vec()).collect()
            };
            let (ours, theirs) = (numbers(found), numbers(&self.samples));
            let unit = largest(theirs.iter().map(|number| number.abs()));
            (largest(ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs())) / unit, unit)
        })
    }
}

fn sample(
    steps: u32,
    state: &State<Set, Mrp>,
    demand: &Vector3<f64>,
    commands: &[f64; JOINTS],
    torques: &[f64; JOINTS],
) -> Sample {
    let every = |list: &[f64; JOINTS], from: usize| core::array::from_fn(|k| list[2 * k + from]);
    Sample {
        steps,
        position: state.r_b_n.into(),
        velocity: state.r_b_n_dot.into(),
        mrp: state.attitude.0.into(),
        omega: state.omega.into(),
        gamma: state.devices.map(|joints| joints.gamma),
        gamma_dot: state.devices.map(|joints| joints.gamma_dot),
        theta: state.devices.map(|joints| joints.theta),
        spin: state.devices.map(|joints| joints.spin),
        demand: (*demand).into(),
        gimbal_rates: every(commands, 0),
        wheel_accelerations: every(commands, 1),
        gimbal_torques: every(torques, 0),
        wheel_torques: every(torques, 1),
    }
}

#[test]
fn a_spacecraft_is_steered_as_basilisk_steers_it() {
    let stored = Stored::read();
    assert_eq!((stored.samples.len(), stored.samples[20].steps), (21, 10_000));
    let mut dropped = Dropped::default();
    let found = stored.run(Terms::AsBasilisk, &mut dropped);
    for ((error, largest), (block, unit)) in stored.differences(&found).into_iter().zip(BLOCKS) {
        println!("{block}: {error:.1e} of {largest:.3} {unit}");
        assert!(
            error <= AGREEMENT,
            "{block} differs from Basilisk {} by {error:e} of {largest} {unit}",
            stored.basilisk
        );
    }
    let Dropped { gimbal, wheel, weight } = dropped;
    println!("dropped: J_g g_g . omega' {gimbal:.1e} N m, I_ws g_s . omega' {wheel:.1e} N m");
    println!("weights of wheels by columns of all terms: {weight:.1e} of the weight");
    // The terms that are dropped are no rounding: the comparison can tell.
    assert!(gimbal > 1e-4 && wheel > 1e-4 && weight > 1e-6);
}

/// What Basilisk drops, as a difference of the runs.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn what_basilisk_drops_moves_the_gimbals() {
    let stored = Stored::read();
    let found = stored.run(Terms::Whole, &mut Dropped::default());
    let differences = stored.differences(&found);
    for ((error, largest), (block, unit)) in differences.into_iter().zip(BLOCKS) {
        println!("{block}: {error:.1e} of {largest:.3} {unit}");
    }
    assert!(differences[5].0 > 1e-4 && differences[4].0 < 0.1, "{differences:?}");
}

/// What each number is changed by, to see whether the comparison notices.
const CHANGE: f64 = 1.0 + 1e-6;

/// Of the whole run, the first 20 s.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_change_of_any_number_of_law_or_servo_shows() {
    let file: Value = serde_json::from_str(TEXT).expect("written by engines/steered.py");
    let pointers = [
        "/stiffness",
        "/damping",
        "/gain",
        "/mu",
        "/weights/0",
        "/weights/1",
        "/gyros/2/i_g_gc/0",
        "/gyros/2/i_g_gc/3",
        "/gyros/2/i_g_gc/5",
        "/gyros/2/i_w_wc/0",
    ];
    for pointer in pointers {
        let mut changed = file.clone();
        changed["samples"].as_array_mut().expect("a list").truncate(5);
        let number = changed.pointer_mut(pointer).expect("a number of the file");
        *number = (number.as_f64().expect("a number") * CHANGE).into();
        let stored: Stored = serde_json::from_value(changed).expect("numbers for numbers");
        let found = stored.run(Terms::AsBasilisk, &mut Dropped::default());
        let worst = largest(stored.differences(&found).map(|(error, _)| error));
        println!("{pointer}: {worst:.1e}");
        assert!(worst > 10.0 * AGREEMENT, "{pointer}, changed by 1e-6: {worst:e}");
    }
}
