//! Residual flexibility: coordinates without mass for the static response of modes left out.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::kind::Each;
use precess_dynamics::{
    FixedModes, Flexible, Gravity, Hub, HubMode, Inputs, ListedModes, ModalMount, ModalPoint, Mode,
    Modes, ModesError, Quaternion, ReactionWheel, ResidualFault, SloshMass, SolveError, Spacecraft,
    State,
};
use precess_tests::bounds::{ACCELERATIONS_WORST, BACKWARD_EPSILONS, LIMITS, POWER_EPSILONS};
use precess_tests::random::Random;

use crate::accelerations::{block_error, listed};
use crate::craft::{self, Case, SEED, Size};
use crate::known::{Cantilever, analytic};
use crate::reference::reference;

/// A random case with residual coordinates.
pub(crate) fn case(seed: u64, modes: usize, residual: usize) -> Case {
    let size = Size { modes, contained: false, rotation: 0.1, free: false };
    let mut case = Case::new(seed, size);
    let random = &mut Random::new(seed + 1);
    for _ in 0..residual {
        case.modes.frequencies.push(random.within(30.0, 90.0));
        case.modes.damping.push(0.0);
        case.modes.linear.push(Vector3::zeros());
        case.modes.angular.push(Vector3::zeros());
        for mount in &mut case.modes.mounts {
            mount.point.translation.push(random.vector(0.1));
            mount.point.rotation.push(random.vector(0.1));
        }
        case.state.modal.eta.push(random.within(-1.0, 1.0));
        case.state.modal.eta_dot.push(random.within(-10.0, 10.0));
        case.inputs.modal.forces.push(random.within(-1.0, 1.0));
    }
    case.craft = craft_of(&case, residual).expect("valid");
    case
}

/// The spacecraft of a case.
fn craft_of(
    case: &Case,
    residual: usize,
) -> Result<Spacecraft<craft::Mixed, Flexible<ListedModes>>, ModesError> {
    let (hub, modes) = (&case.hub, &case.modes);
    Spacecraft::flexible_with_residual(hub, modes, residual, &case.devices, &craft::ON_MOUNT)
}

/// The mass matrix has a zero for each of them; all else is that of the kinetic energy.
#[test]
fn accelerations_with_residual_coordinates_are_those_of_the_kinetic_energy() {
    let (mut worst, mut backward) = (0.0_f64, 0.0_f64);
    for (seed, (modes, residual)) in (SEED + 1000..).zip([(2, 1), (3, 4), (1, 6)]) {
        let case = case(seed, modes, residual);
        let (found, expected) = (listed(&case), reference(&case));
        worst = worst.max(block_error(&found, &expected.accelerations, modes + residual));
        backward = backward.max(expected.backward_error(&found));
    }
    println!("{worst:.1e}, {backward:.1e}");
    assert!(worst <= ACCELERATIONS_WORST, "{worst:e}");
    assert!(backward <= BACKWARD_EPSILONS * f64::EPSILON, "{backward:e}");
}

/// Sixty modes with five residual coordinates: beside the directions of the mounts, and with every
/// mode a direction.
#[test]
fn residual_coordinates_are_directions_of_their_own() {
    let case = case(SEED + 1010, 60, 5);
    let mut dense = case.clone();
    for _ in 0..12 {
        let ModalMount { point, .. } = dense.modes.mounts[0].clone();
        dense.modes.mounts.push(ModalMount { point, contained: None });
    }
    dense.inputs.modal.mounts.resize(15, precess_dynamics::Wrench::none());
    dense.craft = craft_of(&dense, 5).expect("valid");
    let error = block_error(&listed(&case), &listed(&dense), 65);
    assert!(error <= LIMITS, "{error:e}");
}

#[test]
fn power_balances_with_residual_coordinates() {
    for (seed, gravity) in (SEED + 1020..).zip([
        Gravity::None,
        Gravity::Uniform(Vector3::new(0.4, -0.3, 9.0)),
        Gravity::Central { mu: 900.0 },
    ]) {
        let mut case = case(seed, 20, 6);
        case.modes.damping[22] = 0.3;
        case.craft = craft_of(&case, 6).expect("valid");
        case.inputs.gravity = gravity;
        let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
        let ledger = case.craft.ledger(&case.state, &case.inputs, &found).expect("a ledger");
        let balance = ledger.residual.abs() / ledger.magnitude;
        assert!(balance <= POWER_EPSILONS * f64::EPSILON, "seed {seed:#x}: {balance:e}");
        assert!(ledger.modal.damping < 0.0);
        // Loads close, too: what hub and modes need beside the inputs is rounding.
        let axes = precess_dynamics::LoadAxes::Body;
        let loads = case.craft.loads(&case.state, &case.inputs, &found, axes).expect("finite");
        let size = case.craft.mass() * found.r_b_n_ddot.norm();
        assert!(loads.hub.force.norm() <= LIMITS * size);
        assert!(loads.modal.forces.iter().all(|force| force.abs() <= LIMITS * size));
    }
}

#[test]
fn cantilever_with_residual_flexibility_is_the_truncated_sum_with_it() {
    for modes in [1, 3, 8] {
        let cantilever = Cantilever::with_modes(modes, true);
        for omega in [0.3, 2.0, 9.0] {
            let (found, expected) = (cantilever.receptance(omega), cantilever.modal_sum(omega));
            let error = (found / expected - 1.0).abs();
            assert!(error <= LIMITS, "{modes} modes at {omega} rad/s: {error:e}");
        }
    }
}

/// Of a mode left out, `phi² / (w² - W²)`, the static part `phi² / w²` is given: what is left is
/// `phi² W² / (w² (w² - W²))`, and with w growing as (i - 1/2)² the rest of the sum is that of
/// (i - 1/2)⁻⁸ over the modes beyond n, which falls as n⁻⁷, not n⁻³.
#[test]
fn residual_flexibility_converges_with_the_seventh_power_of_the_modes() {
    let error = |modes, residual| {
        let found = Cantilever::with_modes(modes, residual).receptance(2.0);
        (found / analytic(2.0) - 1.0).abs()
    };
    let rest = |modes: u32| (modes..2000).rev().map(|i| (f64::from(i) + 0.5).powi(-8)).sum::<f64>();
    for modes in [3, 5] {
        let (ratio, expected) =
            (error(modes, true) / error(2 * modes, true), rest(modes) / rest(2 * modes));
        println!("{modes} modes: {:e}, {:e}", error(modes, false), error(modes, true));
        assert!((ratio / expected - 1.0).abs() < 0.01, "{modes} modes: {ratio}, not {expected}");
        assert!(error(modes, true) < 1e-3 * error(modes, false));
    }
    assert!((rest(20) / rest(40) / 128.0 - 1.0).abs() < 0.01);
}

/// A point mass on a spring without mass, on a held hub: `x'' = -k/m x - 2 zeta sqrt(k/m) x'`.
#[test]
fn mass_on_a_residual_coordinate_is_a_damped_oscillator() {
    const MASS: f64 = 3.0;
    const COMPLIANCE: f64 = 1e-4;
    const RATIO: f64 = 0.2;
    let along = |z: f64| [Vector3::new(0.0, 0.0, z)];
    let place = Vector3::new(1.0, 0.0, 0.0);
    let point =
        ModalPoint { position: place, translation: along(COMPLIANCE.sqrt()), rotation: along(0.0) };
    let modes: Modes<FixedModes<1, 1>> = Modes {
        frequencies: [1.0],
        damping: [RATIO],
        linear: along(0.0),
        angular: along(0.0),
        mounts: [ModalMount { point, contained: None }],
    };
    let hub = Hub { m_b: 20.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    let device = SloshMass { r_s_b: place, ..SloshMass::bare_slosh_mass(MASS) };
    let craft = Spacecraft::flexible_with_residual(&hub, &modes, 1, &device, &0).expect("valid");
    assert_eq!((craft.modes(), craft.massive()), (1, 0));
    let mut state: State<SloshMass, Quaternion, Flexible<FixedModes<1, 1>>> =
        State::at_rest_for(&craft);
    (state.modal.eta, state.modal.eta_dot) = ([0.02], [0.7]);
    let mut inputs = Inputs::none_for(&craft);
    inputs.hub = HubMode::Fixed;
    inputs.modes.values_mut().for_each(|mode| *mode = Mode::Locked);
    let found = craft.accelerations(&state, &inputs).expect("a solution").modal.eta_ddot[0];
    let w = (1.0 / (MASS * COMPLIANCE)).sqrt();
    let expected = -w * w * state.modal.eta[0] - 2.0 * RATIO * w * state.modal.eta_dot[0];
    assert!((found / expected - 1.0).abs() <= LIMITS, "{found} {expected}");
    let point = &modes.mounts[0].point;
    let moved = craft.point_motion(point, &state).expect("finite").displacement.z;
    assert!((moved - COMPLIANCE.sqrt() * state.modal.eta[0]).abs() <= LIMITS * moved);
    match craft.step(&state, &inputs, 1.0) {
        Err(SolveError::UnstableModes { longest, .. }) => {
            assert!((longest * w / 8.0_f64.sqrt() - 1.0).abs() < 1e-9, "{longest}");
        }
        found => panic!("{found:?}"),
    }
}

/// Shapes of a compliance of two mounts and a point: their sum of products is the compliance.
#[test]
fn shapes_of_a_compliance_make_it() {
    let random = &mut Random::new(SEED + 1030);
    let case =
        Case::new(SEED + 1031, Size { modes: 2, contained: false, rotation: 0.1, free: false });
    // Seven directions of eighteen; the point's rows are of the same.
    let root = DMatrix::from_fn(24, 7, |row, _| {
        (if row % 6 < 3 { 1e-4 } else { 1e-3 }) * random.within(-1.0, 1.0)
    });
    let whole = &root * root.transpose();
    let compliance: Vec<f64> = (0..24)
        .flat_map(|row| (0..18).map(move |column| (row, column)))
        .map(|at| whole[at])
        .collect();
    let mut modes = case.modes.clone();
    let mut points = [modes.mounts[2].point.clone()];
    let count = modes.add_residual(&mut points, &compliance).expect("valid");
    assert_eq!(count, 7);
    assert!(modes.damping.len() == 9 && points[0].translation.len() == 9);
    let shape = |row: usize, mode: usize| {
        let point = if row < 18 { &modes.mounts[row / 6].point } else { &points[0] };
        if row % 6 < 3 { point.translation[mode][row % 3] } else { point.rotation[mode][row % 3] }
    };
    for row in 0..24 {
        for column in 0..18 {
            let sum: f64 = (2..9).map(|mode| shape(row, mode) * shape(column, mode)).sum();
            let unit = (whole[(row, row)] * whole[(column, column)]).sqrt();
            assert!((sum - whole[(row, column)]).abs() <= 1e-11 * unit, "{row}, {column}");
        }
    }
}

#[test]
fn residual_coordinates_that_have_no_place_are_errors() {
    let fault = |found: Result<_, ModesError>| match found {
        Err(error @ ModesError::Residual { mode, fault }) => {
            assert!(error.to_string().contains("residual") || error.to_string().contains("row"));
            (mode, fault)
        }
        found => panic!("{found:?}"),
    };
    let good = case(SEED + 1040, 2, 2);
    let rejected = |change: &dyn Fn(&mut Case)| {
        let mut bad = good.clone();
        change(&mut bad);
        fault(craft_of(&bad, 2).map(|_| ()))
    };
    let found = rejected(&|case| case.modes.frequencies[3] = 0.0);
    assert_eq!(found, (3, ResidualFault::NoStiffness));
    let found = rejected(&|case| case.modes.linear[2].x = 1e-9);
    assert_eq!(found, (2, ResidualFault::Momentum));
    let found = rejected(&|case| {
        let contained = precess_dynamics::ContainedBody {
            mass: 1.0,
            centre: Vector3::zeros(),
            inertia: Matrix3::identity(),
        };
        case.modes.mounts[1].contained = Some(contained);
    });
    assert_eq!(found, (2, ResidualFault::Contained { mount: 1 }));
    let found = rejected(&|case| {
        for mount in &mut case.modes.mounts {
            mount.point.translation[3] = Vector3::zeros();
            mount.point.rotation[3] = Vector3::zeros();
        }
    });
    assert_eq!(found, (3, ResidualFault::Massless { mass: 0.0 }));
    let found = fault(craft_of(&good, 5).map(|_| ()));
    assert_eq!(found, (5, ResidualFault::Count { modes: 4 }));

    let compliance = |change: &dyn Fn(&mut Vec<f64>)| {
        let mut modes = good.modes.clone();
        let mut entries = DMatrix::<f64>::identity(18, 18).as_slice().to_vec();
        change(&mut entries);
        let found = fault(modes.add_residual(&mut [], &entries).map(|_| ()));
        assert_eq!(modes.frequencies.len(), 4, "nothing is changed");
        found
    };
    let found = compliance(&|entries| {
        entries.pop();
    });
    assert_eq!(found, (0, ResidualFault::Entries { expected: 324, found: 323 }));
    assert!(matches!(
        compliance(&|entries| entries[18] = f64::NAN),
        (1, ResidualFault::NotFinite { .. })
    ));
    assert_eq!(
        compliance(&|entries| entries[18] = 0.5),
        (1, ResidualFault::Asymmetric { difference: 0.5 })
    );
    let found = compliance(&|entries| entries[19] = -1.0);
    assert_eq!(found, (1, ResidualFault::Negative { pivot: -1.0 }));
}

/// A mount of residual flexibility has no inertia about the axis of a wheel that its motor drives, in
/// any orientation: what is left of it there is rounding of what the wheel has.
#[test]
fn mount_without_inertia_about_a_free_spin_axis_is_rejected_in_every_orientation() {
    let diagonal = |a, b, c| Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let hub = Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(20.0, 18.0, 15.0) };
    for k in 0..200 {
        let turn = Vector3::new(0.3 + 0.01 * f64::from(k), -0.7, 0.011 * f64::from(k));
        let mount = *nalgebra::Rotation3::from_scaled_axis(turn).matrix();
        let position = Vector3::new(0.4, 0.1, 0.2);
        let bare = ReactionWheel::bare_wheel(3.0, diagonal(0.02, 0.01, 0.01));
        let wheel = ReactionWheel { mount, r_w_b: position, ..bare };
        let point = ModalPoint { position, translation: vec![], rotation: vec![] };
        let mut modes: Modes<ListedModes> = Modes {
            frequencies: vec![],
            damping: vec![],
            linear: vec![],
            angular: vec![],
            mounts: vec![ModalMount { point, contained: None }],
        };
        // 0.1 um/N, 10 urad/(N m).
        let mut compliance = [0.0; 36];
        for (number, entry) in compliance.iter_mut().step_by(7).enumerate() {
            *entry = if number < 3 { 1e-7 } else { 1e-5 };
        }
        let residual = modes.add_residual(&mut [], &compliance).expect("a compliance");
        let craft =
            Spacecraft::flexible_with_residual(&hub, &modes, residual, &vec![wheel], &vec![0])
                .expect("valid");
        let mut inputs: Inputs<Vec<ReactionWheel>, Flexible<ListedModes>> =
            Inputs::none_for(&craft);
        inputs.motors[0].u_w = 0.1;
        let mut state: State<Vec<ReactionWheel>, Quaternion, Flexible<ListedModes>> =
            State::at_rest_for(&craft);
        state.devices[0].spin = 100.0;
        let found = craft.accelerations(&state, &inputs);
        let Err(SolveError::ModalMass { pivot, bound }) = found else { panic!("{k}: {found:?}") };
        assert!(pivot <= bound && bound < 1e-16, "{k}: {pivot} {bound}");
        // The wheel locked, every direction has its inertia.
        inputs.modes[0] = precess_dynamics::reaction_wheel::PerJoint::all(Mode::Locked);
        state.devices[0].spin = 0.0;
        let found = craft.accelerations(&state, &inputs).expect("a solution");
        assert!(found.modal.eta_ddot.iter().all(|eta| eta.abs() < 1e-9), "{k}: {found:?}");
    }
}
