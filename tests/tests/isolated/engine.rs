//! Stored values of Pinocchio and `MuJoCo`: wheels and a gyro on a platform of six joints, rows of four panels.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{BodyParameters, Kind};
use precess_dynamics::{
    About, Each, FixedSet, HingedPanel, Hub, ImbalanceModel, Inputs, Isolated, JointStates,
    OnPanel, Passive, Platform, ReactionWheel, Spacecraft, State, Suspension, Vscmg,
};
use precess_tests::bounds::{ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST};
use serde::Deserialize;

type Cluster = Isolated<([ReactionWheel; 2], Vscmg)>;
type Row = OnPanel<OnPanel<OnPanel<HingedPanel>>>;

/// What an engine found for a spacecraft.
type OfEngine = fn(&Craft) -> &EngineSolution;

/// Energy and momenta are sums of some tens of products: of their magnitude.
const SUMS: f64 = 1e-13;

#[derive(Deserialize)]
struct Fixture {
    clusters: Vec<Craft>,
    rows: Vec<Craft>,
}

#[derive(Deserialize)]
struct Craft {
    seed: u32,
    hub: StoredHub,
    omega: [f64; 3],
    r_b_n_dot: [f64; 3],
    force: [f64; 3],
    torque_b: [f64; 3],
    devices: [Device; 4],
    pinocchio: EngineSolution,
    mujoco: EngineSolution,
}

#[derive(Deserialize)]
#[expect(clippy::struct_field_names, reason = "as in the file")]
struct StoredHub {
    m_b: f64,
    r_bc_b: [f64; 3],
    i_b: [f64; 6],
}

#[derive(Deserialize)]
struct Device {
    kind: String,
    mount: [[f64; 3]; 3],
    links: Vec<Link>,
}

#[derive(Deserialize)]
struct Link {
    motion: String,
    axis: usize,
    origin: [f64; 3],
    mass: f64,
    centre: [f64; 3],
    inertia: [f64; 6],
    q: f64,
    rate: f64,
    torque: f64,
}

#[derive(Deserialize)]
struct EngineSolution {
    r_b_n_ddot: Vec<f64>,
    omega_dot: Vec<f64>,
    joints: Vec<f64>,
    energy: f64,
    linear: [f64; 3],
    angular_b: [f64; 3],
}

fn tensor([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

impl Device {
    /// As a device of a kind, whose joints it must have.
    fn built<K: Kind<Scalar = f64>>(&self) -> K {
        assert_eq!((self.kind.as_str(), self.links.len()), (K::NAME, K::JOINTS.len()));
        let none = BodyParameters {
            origin: [0.0; 3],
            mass: 0.0,
            centre: [0.0; 3],
            inertia: Matrix3::zeros(),
        };
        let mut bodies = <K as Kind>::all(none);
        for ((body, link), info) in bodies.values_mut().zip(&self.links).zip(K::JOINTS) {
            assert_eq!((link.motion == "slide", link.axis), (info.slides, info.axis));
            let Link { origin, mass, centre, .. } = *link;
            *body = BodyParameters { origin, mass, centre, inertia: tensor(link.inertia) };
        }
        let [x, y, z] = self.mount;
        let mount = Matrix3::from_rows(&[x.into(), y.into(), z.into()]);
        let passive = <K as Kind>::all(Passive::none());
        K::of_bodies(&mount, &bodies, &passive, ImbalanceModel::Coupled)
    }
}

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    let unit = expected.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let off = found.iter().zip(expected).map(|(found, expected)| (found - expected).abs() / unit);
    off.fold(0.0, |most, off| if off > most || off.is_nan() { off } else { most })
}

/// What the solver finds for a platform.
fn of_cluster(of: &Craft) -> EngineSolution {
    let [platform, first, second, gyro] = &of.devices;
    let carried = ([first.built(), second.built()], gyro.built());
    let carrier = platform.built::<Platform>();
    solved::<Cluster>(of, &Isolated { carrier, suspension: Suspension::none(), carried })
}

/// What the solver finds for a row.
fn of_row(of: &Craft) -> EngineSolution {
    let [first, second, third, fourth] = &of.devices;
    let outer = OnPanel::on_panel(third.built(), fourth.built());
    let row = OnPanel::on_panel(first.built(), OnPanel::on_panel(second.built(), outer));
    solved::<Row>(of, &row)
}

fn solved<D: FixedSet<Scalar = f64>>(of: &Craft, devices: &D) -> EngineSolution {
    let hub = Hub { m_b: of.hub.m_b, r_bc_b: of.hub.r_bc_b.into(), i_b_bc: tensor(of.hub.i_b) };
    let craft: Spacecraft<D> = Spacecraft::new(&hub, devices).expect("sound");
    let mut state: State<D> = State::at_rest();
    (state.omega, state.r_b_n_dot) = (of.omega.into(), of.r_b_n_dot.into());
    let mut inputs: Inputs<D> = Inputs::none();
    (inputs.force, inputs.torque_b) = (of.force.into(), of.torque_b.into());
    let links = || of.devices.iter().flat_map(|device| &device.links);
    for ([q, rate], link) in state.devices.states_mut().zip(links()) {
        (*q, *rate) = (link.q, link.rate);
    }
    for (motor, link) in inputs.motors.values_mut().zip(links()) {
        *motor = link.torque;
    }
    let found = craft.accelerations(&state, &inputs).expect("regular");
    // B is at the inertial origin.
    let momentum = craft.momentum(&state, About::InertialOrigin).expect("finite");
    EngineSolution {
        r_b_n_ddot: found.r_b_n_ddot.as_slice().to_vec(),
        omega_dot: found.omega_dot.as_slice().to_vec(),
        joints: found.devices.values().collect(),
        energy: craft.energy(&state).expect("finite"),
        linear: momentum.linear.into(),
        angular_b: momentum.angular.into(),
    }
}

/// Asserts energy and momenta; worst of the hub's two blocks of accelerations.
fn of_hub(seed: u32, found: &EngineSolution, engine: &EngineSolution) -> [f64; 2] {
    assert!((found.energy / engine.energy - 1.0).abs() < SUMS, "seed {seed}: energy");
    let near = |found: [f64; 3], expected: [f64; 3]| {
        let [found, expected] = [found, expected].map(Vector3::from);
        (found - expected).norm() / expected.norm()
    };
    assert!(near(found.linear, engine.linear) < SUMS, "seed {seed}");
    assert!(near(found.angular_b, engine.angular_b) < SUMS, "seed {seed}");
    [worst(&found.r_b_n_ddot, &engine.r_b_n_ddot), worst(&found.omega_dot, &engine.omega_dot)]
}

/// Worst of each block of accelerations of a cluster.
fn errors_of_cluster(seed: u32, found: &EngineSolution, engine: &EngineSolution) -> Vec<f64> {
    let (joints, expected) = (&found.joints, &engine.joints);
    let wheels = |of: &[f64]| [of[6], of[7], of[9]];
    // Blocks: slides, turns of the platform, gimbal, wheels.
    let of_joints = [
        worst(&joints[..3], &expected[..3]),
        worst(&joints[3..6], &expected[3..6]),
        worst(&joints[8..9], &expected[8..9]),
        worst(&wheels(joints), &wheels(expected)),
    ];
    of_hub(seed, found, engine).into_iter().chain(of_joints).collect()
}

/// Those of a row, whose hinges are a block.
fn errors_of_row(seed: u32, found: &EngineSolution, engine: &EngineSolution) -> Vec<f64> {
    let joints = worst(&found.joints, &engine.joints);
    of_hub(seed, found, engine).into_iter().chain([joints]).collect()
}

type Errors = fn(u32, &EngineSolution, &EngineSolution) -> Vec<f64>;

/// Both engines to the bounds of the accelerations: on these spacecraft `MuJoCo` rounds no worse.
fn assert_agreement(
    all: &[Craft],
    solved: fn(&Craft) -> EngineSolution,
    errors: Errors,
    what: &str,
) {
    assert!(all.len() >= 20);
    let engines: [(_, OfEngine); 2] =
        [("Pinocchio", |of| &of.pinocchio), ("MuJoCo", |of| &of.mujoco)];
    let found: Vec<_> = all.iter().map(|of| (of, solved(of))).collect();
    for (name, engine) in engines {
        let each = found.iter();
        let mut errors: Vec<_> =
            each.flat_map(|(of, found)| errors(of.seed, found, engine(of))).collect();
        errors.sort_by(f64::total_cmp);
        let (median, worst) = (errors[errors.len() / 2], errors[errors.len() - 1]);
        println!("{what} against {name}: median {median:.1e}, worst {worst:.1e}");
        assert!(median <= ACCELERATIONS_MEDIAN, "{name}: median {median:e}");
        assert!(worst <= ACCELERATIONS_WORST, "{name}: worst {worst:e}");
    }
}

fn fixture() -> Fixture {
    let text = include_str!("../../fixtures/isolated.json");
    serde_json::from_str(text).expect("a fixture")
}

#[test]
fn isolated_clusters_are_those_of_the_engines() {
    assert_agreement(&fixture().clusters, of_cluster, errors_of_cluster, "isolated clusters");
}

#[test]
fn rows_of_panels_are_those_of_the_engines() {
    assert_agreement(&fixture().rows, of_row, errors_of_row, "rows of panels");
}
