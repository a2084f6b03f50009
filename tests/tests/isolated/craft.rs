//! Random spacecraft with isolated platforms, as the solver has them and as a [`Tree`].

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use precess_dynamics::Scalar;
use precess_dynamics::{
    Coupled, Devices, Dgvscmg, Each, FixedSet, Gravity, HingedPanel, Hub, Inputs, Isolated,
    JointStates, Mode, Passive, Platform, Quaternion, ReactionWheel, Sgcmg, Spacecraft, State,
    Strut, Suspension, Vscmg, Wrench, platform,
};
use precess_tests::double_double::DoubleDouble;
use precess_tests::random::Random;

use crate::tree::{Field, Line, Tree};

/// Wheels and a gyro on a platform.
pub(crate) type Cluster = Isolated<([ReactionWheel; 2], Sgcmg)>;
/// A platform among devices on the hub.
pub(crate) type Mixed = (Dgvscmg, Isolated<(ReactionWheel, Vscmg)>, HingedPanel);
/// A platform on a platform.
pub(crate) type Stacked = Isolated<(Isolated<Vscmg>, ReactionWheel)>;

/// What a random spacecraft has besides masses and motion.
#[derive(Clone, Copy, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent choices")]
pub(crate) struct Options {
    /// Springs and dampers of single joints, matrices, struts.
    pub(crate) springs: bool,
    /// Dry friction at each joint of a platform that has springs.
    pub(crate) dry: bool,
    /// Springs and dampers that a step of a millisecond resolves with ease.
    pub(crate) soft: bool,
    /// Wrenches on bodies, force and torque on the hub.
    pub(crate) wrenches: bool,
    /// A field of gravity.
    pub(crate) gravity: Option<Gravity>,
    /// Modes drawn at random.
    pub(crate) modes: bool,
}

/// A spacecraft, a state, inputs, and the same as a tree.
pub(crate) struct Craft<D: Devices<Scalar = f64>> {
    pub(crate) solver: Spacecraft<D>,
    pub(crate) state: State<D>,
    pub(crate) inputs: Inputs<D>,
    pub(crate) tree: Tree,
    pub(crate) devices: D,
}

pub(crate) fn rotation(random: &mut Random) -> Matrix3<f64> {
    let angle = random.within(0.0, 3.0);
    Rotation3::new(random.vector(angle)).into_inner()
}

pub(crate) fn inertia(random: &mut Random, mass: f64, size: f64) -> Matrix3<f64> {
    let edges = Vector3::from_fn(|_, _| size * random.within(0.3, 1.0));
    let squares = edges.component_mul(&edges);
    let moments = (Vector3::from_element(squares.sum()) - squares) * (mass / 12.0);
    let axes = rotation(random);
    let turned = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (turned + turned.transpose()) * 0.5
}

pub(crate) fn passive(random: &mut Random, options: &Options) -> Passive {
    if !options.springs {
        return Passive::none();
    }
    let share = if options.soft { 0.01 } else { 1.0 };
    Passive {
        stiffness: share * random.log_within(1.0, 1e4),
        rest: random.within(-0.01, 0.01),
        viscous: share * random.log_within(0.1, 50.0),
        coulomb: if options.dry { random.within(0.0, 0.1) } else { 0.0 },
        coulomb_rate: 0.1,
    }
}

/// A positive definite matrix whose translations are in 1/m of what its rotations are.
fn definite(random: &mut Random, size: f64) -> Matrix6<f64> {
    let root = Matrix6::from_fn(|_, _| random.within(-1.0, 1.0));
    let lever = Vector6::new(1.0, 1.0, 1.0, 0.2, 0.2, 0.2);
    let matrix =
        Matrix6::from_diagonal(&lever) * root * root.transpose() * Matrix6::from_diagonal(&lever);
    (matrix + matrix.transpose()) * (0.5 * size)
}

fn suspension(random: &mut Random, options: &Options) -> Suspension {
    let share = if options.soft { 0.01 } else { 1.0 };
    let strut = |random: &mut Random| {
        Some(Strut {
            position: random.vector(0.2),
            direction: random.vector(1.0),
            length: random.within(0.1, 0.3),
            stiffness: share * random.log_within(10.0, 1e4),
            damping: share * random.log_within(0.1, 50.0),
        })
    };
    let coupled = Coupled {
        stiffness: definite(random, share * 100.0),
        rest: Vector6::from_fn(|_, _| random.within(-0.01, 0.01)),
        damping: definite(random, share),
    };
    let struts = [(); 6].map(|()| strut(random));
    Suspension { coupled: Some(coupled), struts }
}

fn platform(random: &mut Random, options: &Options) -> Platform {
    let m_p = random.log_within(1.0, 30.0);
    let passive = [(); 6].map(|()| passive(random, options));
    Platform {
        mount: rotation(random),
        r_p_b: random.vector(0.8),
        m_p,
        r_pc_p: random.vector(0.1),
        i_p_pc: inertia(random, m_p, 0.5),
        passive: platform::PerJoint::of(passive),
    }
}

pub(crate) fn isolated<C: precess_dynamics::DeviceSet<Scalar = f64>>(
    random: &mut Random,
    options: &Options,
    carried: C,
) -> Isolated<C> {
    let platform = platform(random, options);
    let springs = options.springs;
    let suspension = if springs { suspension(random, options) } else { Suspension::none() };
    Isolated { carrier: platform, suspension, carried }
}

pub(crate) fn wheel(random: &mut Random) -> ReactionWheel {
    let m_w = random.log_within(0.5, 6.0);
    ReactionWheel {
        mount: rotation(random),
        r_w_b: random.vector(0.3),
        d: random.log_within(1e-5, 1e-2),
        ..ReactionWheel::bare_wheel(m_w, inertia(random, m_w, 0.25))
    }
}

fn sgcmg(random: &mut Random) -> Sgcmg {
    let m_w = random.log_within(0.5, 6.0);
    Sgcmg {
        mount: rotation(random),
        r_g_b: random.vector(0.3),
        d: random.log_within(1e-5, 1e-2),
        ..Sgcmg::bare_wheel(m_w, inertia(random, m_w, 0.25))
    }
}

fn vscmg(random: &mut Random) -> Vscmg {
    let m_w = random.log_within(0.5, 6.0);
    Vscmg {
        mount: rotation(random),
        r_g_b: random.vector(0.3),
        d: random.log_within(1e-5, 1e-2),
        ..Vscmg::bare_wheel(m_w, inertia(random, m_w, 0.25))
    }
}

/// Adds the platform and its struts to a tree; returns its last link.
pub(crate) fn add_platform<C: precess_dynamics::DeviceSet<Scalar = f64>>(
    tree: &mut Tree,
    base: Option<usize>,
    of: &Isolated<C>,
) -> usize {
    let last = tree.device(base, &of.carrier);
    for strut in of.suspension.struts.iter().flatten() {
        let on_base =
            of.carrier.r_p_b + of.carrier.mount * (strut.position - strut.direction * strut.length);
        let (platform, on_platform) = (last, strut.position);
        tree.lines.push(Line { base, on_base, platform, on_platform, strut: *strut });
    }
    last
}

/// Adds the torques of coupled springs, once the tree has its coordinates.
pub(crate) fn add_coupled<C: precess_dynamics::DeviceSet<Scalar = f64>>(
    tree: &mut Tree,
    last: usize,
    of: &Isolated<C>,
) {
    let Some(coupled) = &of.suspension.coupled else { return };
    let first = last - 5;
    let q = Vector6::from_fn(|i, _| tree.links[first + i].q);
    let rates = Vector6::from_fn(|i, _| tree.links[first + i].rate);
    let torques = -(coupled.stiffness * (q - coupled.rest)) - coupled.damping * rates;
    let stretch = q - coupled.rest;
    tree.coupled_energy += 0.5 * stretch.dot(&(coupled.stiffness * stretch));
    let sizes = coupled.stiffness.abs() * (q.abs() + coupled.rest.abs())
        + coupled.damping.abs() * rates.abs();
    tree.coupled.extend((0..6).map(|i| (first + i, torques[i], sizes[i])));
    let dd = DoubleDouble::from_f64;
    tree.coupled_exactly.extend((0..6).map(|i| {
        let terms = (0..6).map(|j| {
            let stretch = dd(q[j]) - dd(coupled.rest[j]);
            dd(coupled.stiffness[(i, j)]) * stretch + dd(coupled.damping[(i, j)]) * dd(rates[j])
        });
        (first + i, -terms.fold(dd(0.0), |sum, term| sum + term))
    }));
}

pub(crate) fn hub(random: &mut Random) -> Hub {
    let m_b = random.log_within(20.0, 800.0);
    Hub { m_b, r_bc_b: random.vector(0.2), i_b_bc: inertia(random, m_b, 1.5) }
}

pub(crate) fn finished<D: FixedSet<Scalar = f64>>(
    random: &mut Random,
    options: &Options,
    devices: &D,
    mut tree: Tree,
) -> Craft<D> {
    let solver = Spacecraft::new(&tree.hub, devices).expect("parameters are sound");
    let mut state: State<D> = State::at_rest();
    state.r_b_n = random.vector(if options.gravity.is_some() { 50.0 } else { 3.0 });
    state.r_b_n_dot = random.vector(2.0);
    state.omega = random.vector(0.8);
    let turn = random.vector(1.0);
    let angle: f64 = random.within(0.0, 3.0);
    let (sin, cos) = (0.5 * angle).sin_cos();
    state.attitude = Quaternion { q0: cos, q1: sin * turn.x, q2: sin * turn.y, q3: sin * turn.z };
    let mut inputs: Inputs<D> = Inputs::none();
    let joints = state.devices.states_mut().zip(tree.links.iter_mut());
    for ([q, rate], link) in joints {
        let of_platform = link.info.rate == "x_dot" || link.mass == 0.0 || link.info.index == 5;
        (*q, *rate) = match (link.info.slides, of_platform) {
            (true, _) => (random.within(-0.1, 0.1), random.within(-0.5, 0.5)),
            (false, true) => (random.within(-1.2, 1.2), random.within(-1.0, 1.0)),
            (false, false) if link.info.body == "wheel" => {
                (random.within(-3.0, 3.0), random.within(-300.0, 300.0))
            }
            (false, false) => (random.within(-3.0, 3.0), random.within(-2.0, 2.0)),
        };
        (link.q, link.rate) = (*q, *rate);
    }
    for (motor, link) in inputs.motors.values_mut().zip(&mut tree.links) {
        *motor = random.within(-1.0, 1.0);
        link.motor = *motor;
    }
    for (mode, link) in inputs.modes.values_mut().zip(&mut tree.links) {
        if options.modes && link.info.driven && random.within(0.0, 1.0) < 0.4 {
            *mode = Mode::Prescribed(random.within(-2.0, 2.0));
        }
        link.mode = *mode;
    }
    if options.wrenches {
        let mut bodies = Inputs::<D>::no_wrenches();
        for (wrench, link) in bodies.values_mut().zip(&mut tree.links) {
            *wrench = Wrench { force: random.vector(2.0), moment: random.vector(0.5) };
            link.wrench = *wrench;
        }
        inputs.bodies = Some(bodies);
        (inputs.force, inputs.torque_b) = (random.vector(5.0), random.vector(1.0));
    }
    tree.axes = precess_dynamics::Attitude::dcm(&state.attitude).transpose();
    (tree.r, tree.v) = (state.r_b_n, state.r_b_n_dot);
    tree.omega = tree.axes * state.omega;
    (tree.force, tree.torque) = (tree.axes * inputs.force, tree.axes * inputs.torque_b);
    if let Some(gravity) = options.gravity {
        inputs.gravity = gravity;
        tree.field = field(&gravity, &tree.r);
    }
    Craft { solver, state, inputs, tree, devices: devices.clone() }
}

fn field(gravity: &Gravity, r: &Vector3<f64>) -> Field {
    let none = Field { at_b: Vector3::zeros(), gradient: Matrix3::zeros(), central: None };
    match *gravity {
        Gravity::None => none,
        Gravity::Uniform(at_b) => Field { at_b, ..none },
        Gravity::Central { mu } => {
            let (distance, n) = (r.norm(), r.normalize());
            let cube = mu / distance.powi(3);
            Field {
                at_b: -n * (mu / distance.powi(2)),
                gradient: cube * (3.0 * n * n.transpose() - Matrix3::identity()),
                central: Some((mu, n)),
            }
        }
    }
}

pub(crate) fn cluster(seed: u64, options: &Options) -> Craft<Cluster> {
    let random = &mut Random::new(seed);
    let mut tree = Tree::new(&hub(random));
    let carried = ([(); 2].map(|()| wheel(random)), sgcmg(random));
    let devices = isolated(random, options, carried);
    let last = add_platform(&mut tree, None, &devices);
    tree.device(Some(last), &devices.carried.0[0]);
    tree.device(Some(last), &devices.carried.0[1]);
    tree.device(Some(last), &devices.carried.1);
    let mut made = finished(random, options, &devices, tree);
    add_coupled(&mut made.tree, last, &devices);
    made
}

pub(crate) fn mixed(seed: u64, options: &Options) -> Craft<Mixed> {
    let random = &mut Random::new(seed);
    let mut tree = Tree::new(&hub(random));
    let m_w = random.log_within(0.5, 6.0);
    let first = Dgvscmg {
        mount: rotation(random),
        r_go_b: random.vector(0.5),
        d: 1e-3,
        m_go: 0.4,
        i_go_goc: inertia(random, 0.4, 0.3),
        m_gi: 0.3,
        i_gi_gic: inertia(random, 0.3, 0.3),
        ..Dgvscmg::bare_wheel(m_w, inertia(random, m_w, 0.25))
    };
    let carried = (wheel(random), vscmg(random));
    let middle = isolated(random, options, carried);
    let panel = HingedPanel {
        mount: rotation(random),
        r_p_b: random.vector(0.7),
        r_pc_p: random.vector(0.5),
        ..HingedPanel::bare_panel(4.0, inertia(random, 4.0, 1.0))
    };
    tree.device(None, &first);
    let last = add_platform(&mut tree, None, &middle);
    tree.device(Some(last), &middle.carried.0);
    tree.device(Some(last), &middle.carried.1);
    tree.device(None, &panel);
    let devices = (first, middle, panel);
    let mut made = finished(random, options, &devices, tree);
    add_coupled(&mut made.tree, last, &devices.1);
    made
}

pub(crate) fn stacked(seed: u64, options: &Options) -> Craft<Stacked> {
    let random = &mut Random::new(seed);
    let mut tree = Tree::new(&hub(random));
    let inner_carried = vscmg(random);
    let inner = isolated(random, options, inner_carried);
    let upper = wheel(random);
    let devices = isolated(random, options, (inner, upper));
    let outer_last = add_platform(&mut tree, None, &devices);
    let inner_last = add_platform(&mut tree, Some(outer_last), &devices.carried.0);
    tree.device(Some(inner_last), &devices.carried.0.carried);
    tree.device(Some(outer_last), &devices.carried.1);
    let mut made = finished(random, options, &devices, tree);
    add_coupled(&mut made.tree, outer_last, &devices);
    add_coupled(&mut made.tree, inner_last, &devices.carried.0);
    made
}
