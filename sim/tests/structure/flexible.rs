//! The mounted force of an imbalanced wheel by the filter against runs of `Spacecraft` from rest: a
//! structure of two modes that carry momentum, off resonance and at it.

use nalgebra::{Complex, DMatrix, DVector, Vector3};
use precess::structure::accelerance::{Accelerance, Base, ComplexMatrix};
use precess::structure::averaged::AveragedDevices;
use precess::structure::dynamic_mass::Motor;
use precess::structure::mounted::mounted_force;
use precess::structure::{Mode, Node, RigidMass, Structure};
use precess_dynamics::{
    BuiltIn, FixedModes, Flexible, Inputs, ModalMount, ModalPoint, Modes, Quaternion,
    ReactionWheel, Spacecraft, State,
};

use super::structure;
use super::wheel::{I, hub, wheel};

type Storage = FixedModes<2, 1>;
type Craft = Spacecraft<[ReactionWheel; 1], Flexible<Storage>>;

const RATE: f64 = 400.0;
/// Static imbalance over mass, m.
const OFFSET: f64 = 1e-7;
const DAMPING: f64 = 0.02;
/// Steps of a turn, turns until the free motion is below 1e-3 of what it was, turns that are measured.
const STEPS: u32 = 60;
const SETTLE: u32 = 56;
const TURNS: u32 = 40;
/// Largest errors off resonance and at it.
const OFF_MAX: f64 = 0.01;
const AT_MAX: f64 = 0.05;

/// Where the mount is from B, m.
fn mount() -> Vector3<f64> {
    Vector3::new(0.25, 0.15, -0.1)
}

/// Translation and rotation at the mount, linear and angular momentum, of each mode.
fn shapes() -> [[Vector3<f64>; 4]; 2] {
    [
        [
            Vector3::new(0.09, 0.06, -0.12),
            Vector3::new(0.2, -0.3, 0.1),
            Vector3::new(1.0, 0.4, -1.2),
            Vector3::new(0.3, 0.2, -0.1),
        ],
        [
            Vector3::new(-0.05, 0.1, 0.04),
            Vector3::new(0.1, 0.2, -0.2),
            Vector3::new(-0.4, 1.1, 0.3),
            Vector3::new(-0.1, 0.3, 0.2),
        ],
    ]
}

fn modal(frequency: f64) -> Structure {
    let all = shapes();
    let frequencies = [frequency, 900.0];
    let modes = all.iter().zip(frequencies).map(|([_, _, linear, angular], frequency)| Mode {
        frequency,
        damping: DAMPING,
        linear: *linear,
        angular: *angular,
    });
    let rows = DMatrix::from_fn(6, 2, |row, mode| all[mode][row / 3][row % 3]);
    let node = Node { name: "wheel".into(), position: mount() };
    let mut whole = structure(vec![node], modes.collect(), rows);
    let hub = hub();
    whole.mass = Some(RigidMass::about_centre(hub.m_b, hub.r_bc_b, hub.i_b_bc));
    whole
}

fn craft(frequency: f64) -> Craft {
    let [one, two] = shapes();
    let modes = Modes {
        frequencies: [frequency, 900.0],
        damping: [DAMPING; 2],
        linear: [one[2], two[2]],
        angular: [one[3], two[3]],
        mounts: [ModalMount {
            point: ModalPoint {
                position: mount(),
                translation: [one[0], two[0]],
                rotation: [one[1], two[1]],
            },
            contained: None,
        }],
    };
    Spacecraft::flexible(&hub(), &modes, &[wheel(OFFSET)], &[0]).expect("valid")
}

/// The wheel at its mount.
struct Device {
    /// The blocked force about the mount.
    blocked: DVector<Complex<f64>>,
    dynamic_mass: ComplexMatrix,
}

impl Device {
    fn new() -> Self {
        let device = wheel(OFFSET);
        let size = device.m_w * device.d * RATE * RATE;
        let [y, z] = [device.mount.column(1), device.mount.column(2)];
        let force =
            y.map(|v| Complex::new(size * v, 0.0)) + z.map(|v| Complex::new(0.0, -size * v));
        let moment = (device.r_w_b - mount()).map(|v| Complex::new(v, 0.0)).cross(&force);
        let blocked = DVector::from_iterator(6, force.iter().chain(moment.iter()).copied());
        let devices: Vec<BuiltIn> = vec![device.into()];
        let averaged =
            AveragedDevices::new(&devices, &mount(), &[[0.0, RATE]], &[Motor::ConstantTorque]);
        let dynamic_mass = averaged.and_then(|of| of.dynamic_mass(RATE)).expect("valid");
        Self { blocked, dynamic_mass }
    }

    /// Its mounted force, and the accelerance of the structure.
    fn mounted(&self, frequency: f64) -> (DVector<Complex<f64>>, ComplexMatrix) {
        let own = Accelerance::new(&modal(frequency), Base::Free, &[0], &[0]).expect("a node");
        let own = own.at(RATE).expect("damped");
        let mounted = mounted_force(&self.dynamic_mass, &own, &self.blocked, RATE);
        (mounted.expect("damped"), own)
    }
}

/// The acceleration of the mount at the wheel's rate, in a run from rest.
fn measured(frequency: f64) -> DVector<Complex<f64>> {
    let craft = craft(frequency);
    let mut state: State<[ReactionWheel; 1], Quaternion, Flexible<Storage>> =
        State::at_rest_for(&craft);
    state.devices[0].spin = RATE;
    let inputs = Inputs::none_for(&craft);
    let step = std::f64::consts::TAU / RATE / f64::from(STEPS);
    let [at_mount, count] = [shapes(), shapes()];
    let mut sum = DVector::zeros(6);
    let mut weights = 0.0;
    for k in 0..STEPS * (SETTLE + TURNS) {
        if k >= STEPS * SETTLE {
            let found = craft.accelerations(&state, &inputs).expect("regular");
            let [a, alpha] = [found.r_b_n_ddot, found.omega_dot];
            let bent = |part: usize| {
                (0..count.len()).fold(Vector3::zeros(), |sum, mode| {
                    sum + at_mount[mode][part] * found.modal.eta_ddot[mode]
                })
            };
            let (linear, angular) = (a + alpha.cross(&mount()) + bent(0), alpha + bent(1));
            // Hann's window, so that what does not turn with the wheel does not count.
            let share = f64::from(k - STEPS * SETTLE) / f64::from(STEPS * TURNS);
            let weight = (std::f64::consts::PI * share).sin().powi(2);
            let turn = (-I * RATE * step * f64::from(k)).exp() * weight;
            weights += weight;
            for (to, from) in sum.iter_mut().zip(linear.iter().chain(angular.iter())) {
                *to += turn * *from * 2.0;
            }
        }
        state = craft.step(&state, &inputs, step).expect("regular");
    }
    sum / Complex::new(weights, 0.0)
}

#[test]
fn the_filter_is_the_run_of_a_structure_that_bends() {
    let device = Device::new();
    let motion = |frequency: f64| {
        let (mounted, own) = device.mounted(frequency);
        (own * mounted).rows(3, 3).norm()
    };
    let natural = |k: u32| 250.0 * 1.005_f64.powi(i32::try_from(k).unwrap_or(0));
    let at = (0..160).max_by(|a, b| motion(natural(*a)).total_cmp(&motion(natural(*b))));
    let at = at.expect("some");
    assert!((10..150).contains(&at), "a resonance within the range, at {at}");
    let peak = motion(natural(at));
    for (frequency, bound) in [(natural(at), AT_MAX), (250.0, OFF_MAX), (650.0, OFF_MAX)] {
        let (mounted, own) = device.mounted(frequency);
        let found = own.lu().solve(&measured(frequency)).expect("regular");
        for (first, name) in [(0, "force"), (3, "moment")] {
            let [found, mounted, blocked] =
                [&found, &mounted, &device.blocked].map(|of| of.rows(first, 3).into_owned());
            let error = (&found - &mounted).norm() / mounted.norm();
            let change = (&mounted - &blocked).norm() / blocked.norm();
            println!(
                "mode of {frequency:.0} rad/s, {name}: error {error:.1e}, changed by {change:.2}"
            );
            assert!(error < bound, "{frequency} rad/s, {name}: {error:e}");
            assert!(change > 0.05, "{frequency} rad/s, {name}: the mount gives way");
        }
    }
    assert!(peak > 5.0 * motion(250.0), "it is a resonance");
}
