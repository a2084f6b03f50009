//! Rows of panels: a row of four with a wheel on its second panel, and a row of two on a platform, as the
//! solver has them and as a [`Tree`](crate::tree::Tree); what a row is a limit of.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::{
    Accelerations, Devices, Each, FixedSet, Gravity, HingedPanel, HubMode, Inputs, Isolated, Mode,
    OnPanel, Outputs, Platform, ReactionWheel, Spacecraft, State, Suspension, Variable,
    hinged_panel, platform,
};
use precess_tests::random::Random;

use crate::craft::{
    Craft, Options, add_coupled, add_platform, finished, hub, inertia, isolated, passive, rotation,
    wheel,
};
use crate::tree::Tree;

/// A row of two panels.
type Two = OnPanel<HingedPanel>;
/// A row of four panels with a wheel on the second.
type Four = OnPanel<OnPanel<(Two, ReactionWheel)>>;

/// Largest difference of two ways to compute the same accelerations, of the largest of their block.
const AGREEMENT: f64 = 1e-11;

fn panel(random: &mut Random, options: &Options) -> HingedPanel {
    let m_p = random.log_within(1.0, 20.0);
    HingedPanel {
        mount: rotation(random),
        r_p_b: random.vector(0.9),
        r_pc_p: random.vector(0.5),
        passive: hinged_panel::PerJoint { panel: passive(random, options) },
        ..HingedPanel::bare_panel(m_p, inertia(random, m_p, 1.0))
    }
}

/// Both rows.
pub(crate) fn rows(seed: u64, options: &Options) -> Craft<(Four, Isolated<Two>)> {
    let random = &mut Random::new(seed);
    let mut tree = Tree::new(&hub(random));
    let [first, second, third, fourth, inner, outer] = [(); 6].map(|()| panel(random, options));
    let on_second = (OnPanel::on_panel(third, fourth), wheel(random));
    let row = OnPanel::on_panel(first, OnPanel::on_panel(second, on_second));
    let base = isolated(random, options, OnPanel::on_panel(inner, outer));
    let one = tree.device(None, &row.carrier);
    let two = tree.device(Some(one), &row.carried.carrier);
    let three = tree.device(Some(two), &row.carried.carried.0.carrier);
    tree.device(Some(three), &row.carried.carried.0.carried);
    tree.device(Some(two), &row.carried.carried.1);
    let last = add_platform(&mut tree, None, &base);
    let on_platform = tree.device(Some(last), &base.carried.carrier);
    tree.device(Some(on_platform), &base.carried.carried);
    let mut made = finished(random, options, &(row, base), tree);
    add_coupled(&mut made.tree, last, &made.devices.1.clone());
    made
}

/// Hub's accelerations and the joints' in order.
fn listed<D: Devices<Scalar = f64>>(of: &Accelerations<D>) -> Vec<f64> {
    of.r_b_n_ddot.iter().chain(&of.omega_dot).copied().chain(of.devices.values()).collect()
}

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for block in [0..3, 3..6, 6..found.len()] {
        let (found, expected) = (&found[block.clone()], &expected[block]);
        let largest = expected.iter().fold(0.0_f64, |largest, of| largest.max(of.abs()));
        for (found, expected) in found.iter().zip(expected) {
            let off = (found - expected).abs();
            assert!(off <= AGREEMENT * largest, "{what}: {found}, not {expected}: {off:e}");
        }
    }
}

fn moving<D: FixedSet<Scalar = f64>>(random: &mut Random) -> (State<D>, Inputs<D>) {
    let (mut state, mut inputs) = (State::<D>::at_rest(), Inputs::<D>::none());
    (state.omega, state.r_b_n_dot) = (random.vector(0.5), random.vector(1.0));
    state.r_b_n = random.vector(40.0);
    inputs.gravity = Gravity::Central { mu: 3000.0 };
    (inputs.force, inputs.torque_b) = (random.vector(3.0), random.vector(1.0));
    (state, inputs)
}

/// A carrying panel that carries nothing is the emitted panel.
#[test]
fn panel_that_carries_nothing_is_a_hinged_panel() {
    for seed in 0..10 {
        let random = &mut Random::new(seed);
        let options = Options { springs: true, dry: true, ..Options::default() };
        let (hub, alone) = (hub(random), panel(random, &options));
        let carrying = OnPanel::<[HingedPanel; 0]>::on_panel(alone, []);
        let (mut state, mut inputs) = moving::<HingedPanel>(random);
        (state.devices.phi, state.devices.phi_dot) = (0.7, -0.4);
        inputs.motors.u_p = 0.3;
        let expected = Spacecraft::new(&hub, &alone).expect("sound");
        let expected = listed(&expected.accelerations(&state, &inputs).expect("regular"));
        let mut same: State<OnPanel<[HingedPanel; 0]>> = State::at_rest();
        (same.omega, same.r_b_n_dot, same.r_b_n) = (state.omega, state.r_b_n_dot, state.r_b_n);
        same.devices.carrier = state.devices;
        let mut given = Inputs::<OnPanel<[HingedPanel; 0]>>::none();
        (given.force, given.torque_b, given.gravity) =
            (inputs.force, inputs.torque_b, inputs.gravity);
        given.motors.carrier = inputs.motors;
        let found = Spacecraft::new(&hub, &carrying).expect("sound");
        let found = listed(&found.accelerations(&same, &given).expect("regular"));
        assert_near(&found, &expected, &format!("seed {seed}"));
    }
}

/// A panel is a platform of which five joints are locked.
#[test]
fn carrying_panel_is_a_platform_with_five_joints_locked() {
    for seed in 0..10 {
        let random = &mut Random::new(100 + seed);
        let (hub, options) = (hub(random), Options::default());
        let (inner, outer) = (panel(random, &options), panel(random, &options));
        let as_platform = Platform {
            mount: inner.mount,
            r_p_b: inner.r_p_b,
            r_pc_p: inner.r_pc_p,
            ..Platform::bare(inner.m_p, inner.i_p_pc)
        };
        let stand =
            Isolated { carrier: as_platform, suspension: Suspension::none(), carried: outer };
        let (mut state, inputs) = moving::<Two>(random);
        (state.devices.carrier.phi, state.devices.carrier.phi_dot) = (0.9, 0.6);
        (state.devices.carried.phi, state.devices.carried.phi_dot) = (-0.5, -1.1);
        let mut same = State::<Isolated<HingedPanel>>::at_rest();
        let mut given = Inputs::<Isolated<HingedPanel>>::none();
        (same.omega, same.r_b_n_dot, same.r_b_n) = (state.omega, state.r_b_n_dot, state.r_b_n);
        (same.devices.carrier.gamma, same.devices.carrier.gamma_dot) = (0.9, 0.6);
        same.devices.carried = state.devices.carried;
        (given.force, given.torque_b, given.gravity) =
            (inputs.force, inputs.torque_b, inputs.gravity);
        given.modes.carrier =
            platform::PerJoint { platform: Mode::Driven, ..platform::PerJoint::all(Mode::Locked) };
        let row = Spacecraft::new(&hub, &OnPanel::on_panel(inner, outer)).expect("sound");
        let found = row.accelerations(&state, &inputs).expect("regular");
        let stand = Spacecraft::new(&hub, &stand).expect("sound");
        let mut expected = listed(&stand.accelerations(&same, &given).expect("regular"));
        assert_eq!(expected.drain(6..11).filter(|of| *of != 0.0).count(), 0);
        assert_near(&listed(&found), &expected, &format!("seed {seed}"));
    }
}

/// Two panels in line, the hinges parallel, on a hub that nothing moves: the double pendulum of the textbook,
/// in a uniform field. `m` at the ends of massless panels of length l, angles from the field:
/// `2 l a'' + l b'' cos(a - b) + l b'² sin(a - b) + 2 g sin a = 0`,
/// `l b'' + l a'' cos(a - b) - l a'² sin(a - b) + g sin b = 0`, with b the angle of the second panel.
#[test]
fn two_panels_on_a_fixed_hub_are_a_double_pendulum() {
    let (m, l, g) = (2.0, 0.8, 9.81);
    // A point mass nearly: inertia far below rounding of `m l²`, above that of the checks.
    let point = |r_p_b| HingedPanel {
        r_p_b,
        r_pc_p: Vector3::new(l, 0.0, 0.0),
        ..HingedPanel::bare_panel(m, Matrix3::identity() * 1e-18)
    };
    let row: Two = OnPanel::on_panel(point(Vector3::zeros()), point(Vector3::new(l, 0.0, 0.0)));
    let hub = hub(&mut Random::new(5));
    let craft = Spacecraft::new(&hub, &row).expect("sound");
    let (mut state, mut inputs) = (State::<Two>::at_rest(), Inputs::<Two>::none());
    let (a, b, a_dot, b_dot) = (0.6_f64, -0.9_f64, 1.2, -0.7);
    (state.devices.carrier.phi, state.devices.carrier.phi_dot) = (a, a_dot);
    (state.devices.carried.phi, state.devices.carried.phi_dot) = (b - a, b_dot - a_dot);
    inputs.gravity = Gravity::Uniform(Vector3::new(g, 0.0, 0.0));
    inputs.hub = HubMode::Fixed;
    let found = craft.accelerations(&state, &inputs).expect("regular").devices;
    let (a_ddot, b_ddot) =
        (found.carrier.phi_ddot, found.carrier.phi_ddot + found.carried.phi_ddot);
    let (sin, cos) = (a - b).sin_cos();
    let first = 2.0 * l * a_ddot + l * b_ddot * cos + l * b_dot * b_dot * sin + 2.0 * g * a.sin();
    let second = l * b_ddot + l * a_ddot * cos - l * a_dot * a_dot * sin + g * b.sin();
    assert!(first.abs() < 1e-13 * 2.0 * g && second.abs() < 1e-13 * g, "{first:e}, {second:e}");
}

/// The same hanging at rest: `w² = (2 ± √2) g / l`, by the derivatives.
#[test]
fn two_panels_that_hang_have_the_frequencies_of_a_double_pendulum() {
    let (m, l, g) = (2.0, 0.8, 9.81);
    let at_end = |r_p_b| HingedPanel {
        r_p_b,
        r_pc_p: Vector3::new(l, 0.0, 0.0),
        ..HingedPanel::bare_panel(m, Matrix3::identity() * 1e-18)
    };
    let row: Two = OnPanel::on_panel(at_end(Vector3::zeros()), at_end(Vector3::new(l, 0.0, 0.0)));
    let craft = Spacecraft::new(&hub(&mut Random::new(6)), &row).expect("sound");
    let gravity = Gravity::Uniform(Vector3::new(g, 0.0, 0.0));
    let inputs = Inputs::<Two> { hub: HubMode::Fixed, gravity, ..Inputs::none() };
    let outputs = Outputs::accelerations();
    let system = craft.linearize(&State::<Two>::at_rest(), &inputs, &outputs).expect("regular");
    let place = |variable| system.states.iter().position(|state| *state == variable);
    let by = |row, column| {
        let (row, column) = (place(Variable::Rate(row)), place(Variable::Coordinate(column)));
        -system.a[(row.expect("a state"), column.expect("a state"))]
    };
    let [a, b, c, d] = [by(0, 0), by(0, 1), by(1, 0), by(1, 1)];
    let per = g / l;
    assert!((a + d - 4.0 * per).abs() <= 1e-13 * per, "sum of squares {}", a + d);
    assert!((a * d - b * c - 2.0 * per * per).abs() <= 1e-12 * per * per, "{}", a * d - b * c);
}

/// Locked hinges: the row is part of the hub.
#[test]
fn row_with_locked_hinges_is_part_of_the_hub() {
    let random = &mut Random::new(77);
    let (hub, options) = (hub(random), Options::default());
    let (inner, outer) = (panel(random, &options), panel(random, &options));
    let (mut state, mut inputs) = moving::<Two>(random);
    (state.devices.carrier.phi, state.devices.carried.phi) = (0.8, -1.3);
    inputs.modes.carrier.panel = Mode::Locked;
    inputs.modes.carried.panel = Mode::Locked;
    let row = Spacecraft::new(&hub, &OnPanel::on_panel(inner, outer)).expect("sound");
    let found = row.accelerations(&state, &inputs).expect("regular");
    // Masses, places and inertias of hub and panels.
    let turn = |angle| Rotation3::from_axis_angle(&Vector3::z_axis(), angle).into_inner();
    let of_inner = inner.mount * turn(0.8);
    let of_outer = of_inner * outer.mount * turn(-1.3);
    let at_outer = inner.r_p_b + of_inner * outer.r_p_b;
    let bodies = [
        (hub.m_b, hub.r_bc_b, hub.i_b_bc),
        (
            inner.m_p,
            inner.r_p_b + of_inner * inner.r_pc_p,
            of_inner * inner.i_p_pc * of_inner.transpose(),
        ),
        (
            outer.m_p,
            at_outer + of_outer * outer.r_pc_p,
            of_outer * outer.i_p_pc * of_outer.transpose(),
        ),
    ];
    let m_b: f64 = bodies.iter().map(|(mass, ..)| mass).sum();
    let r_bc_b = bodies.iter().map(|(mass, r, _)| r * *mass).sum::<Vector3<f64>>() / m_b;
    let about = |(mass, r, inertia): &(f64, Vector3<f64>, Matrix3<f64>)| {
        let arm = r - r_bc_b;
        inertia + (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * *mass
    };
    let i_b_bc: Matrix3<f64> = bodies.iter().map(about).sum();
    let i_b_bc = (i_b_bc + i_b_bc.transpose()) * 0.5;
    let whole = precess_dynamics::Hub { m_b, r_bc_b, i_b_bc };
    let rigid = Spacecraft::new(&whole, &([] as [HingedPanel; 0]));
    let (mut same, mut given) = (State::<[HingedPanel; 0]>::at_rest(), Inputs::none());
    (same.omega, same.r_b_n_dot, same.r_b_n) = (state.omega, state.r_b_n_dot, state.r_b_n);
    (given.force, given.torque_b, given.gravity) = (inputs.force, inputs.torque_b, inputs.gravity);
    let expected = rigid.expect("sound").accelerations(&same, &given).expect("regular");
    assert_near(&listed(&found)[..6], &listed(&expected), "locked");
    assert_eq!(listed(&found)[6..], [0.0, 0.0]);
}
