//! The longest step of structure and devices together: named by the error, accepted, and no
//! vibration grows with it.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    Devices, FixedModes, Flexible, FlexibleVscmg, Hub, HubMode, Inputs, ListedModes, ModalMount,
    ModalPoint, ModalStorage, Mode, Modes, Passive, Platform, Quantity, Quaternion, ReactionWheel,
    SolveError, Spacecraft, State, flexible_vscmg, platform,
};
use precess_tests::random::Random;
use precess_tests::vibrations::longest_step;

use crate::craft::{Case, Mixed, ON_MOUNT, SEED, Size};

/// The state of a set on modes that are kept so.
type Motion<D, S> = State<D, Quaternion, Flexible<S>>;

fn diagonal(x: f64, y: f64, z: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(x, y, z))
}

/// The longest step that the error names, and its joint; none if it names the modes.
fn named<D: Devices<Scalar = f64>, S: ModalStorage>(
    craft: &Spacecraft<D, Flexible<S>>,
    state: &Motion<D, S>,
    inputs: &Inputs<D, Flexible<S>>,
) -> (Option<&'static str>, f64) {
    match craft.step(state, inputs, 10.0).expect_err("too long") {
        SolveError::Unstable { joint, dt: 10.0, longest, .. } => (Some(joint), longest),
        SolveError::UnstableModes { dt: 10.0, longest } => (None, longest),
        error => panic!("{error}"),
    }
}

fn energy<D: Devices<Scalar = f64>, S: ModalStorage>(
    craft: &Spacecraft<D, Flexible<S>>,
    state: &Motion<D, S>,
    inputs: &Inputs<D, Flexible<S>>,
) -> f64 {
    let found = craft.accelerations(state, inputs).expect("accelerations");
    craft.ledger(state, inputs, &found).expect("a ledger").energy()
}

/// Asserts that a step just below the named one is accepted and makes no energy, and one just above
/// is rejected.
fn holds<D: Devices<Scalar = f64>, S: ModalStorage>(
    craft: &Spacecraft<D, Flexible<S>>,
    start: &Motion<D, S>,
    inputs: &Inputs<D, Flexible<S>>,
    longest: f64,
) {
    assert!(craft.step(start, inputs, 1.001 * longest).is_err());
    let mut state = start.clone();
    let mut most = [0.0_f64; 2];
    for half in &mut most {
        for _ in 0..400 {
            state = craft.step(&state, inputs, 0.999 * longest).expect("a stable step");
            *half = half.max(energy(craft, &state, inputs));
        }
    }
    assert!(most[1] <= (1.0 + 1e-4) * most[0], "{most:?}");
}

/// A mount at which the modes do not move.
fn still<const MODES: usize>() -> ModalMount<FixedModes<MODES, 1>> {
    let zeros = [Vector3::zeros(); MODES];
    let point = ModalPoint { position: Vector3::zeros(), translation: zeros, rotation: zeros };
    ModalMount { point, contained: None }
}

/// Two equal panels, left and right: the antisymmetric vibration is the faster one, and a symmetric
/// start would not see it.
#[test]
fn antisymmetric_vibration_of_two_equal_panels_limits_the_step() {
    let hub = Hub { m_b: 120.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(200.0, 40.0, 200.0) };
    // 6 of 10 kg of each panel move with its first bending mode, 3 m from B along y.
    let (p, arm, w) = (6.0_f64.sqrt(), 3.0, 10.0);
    let modes: Modes<FixedModes<2, 1>> = Modes {
        frequencies: [w; 2],
        damping: [0.005; 2],
        linear: [Vector3::new(0.0, 0.0, p); 2],
        angular: [Vector3::new(p * arm, 0.0, 0.0), Vector3::new(-p * arm, 0.0, 0.0)],
        mounts: [still()],
    };
    let craft = Spacecraft::flexible(&hub, &modes, &([] as [ReactionWheel; 0]), &[]).unwrap();
    let inputs = Inputs::none_for(&craft);
    let mut state = Motion::at_rest_for(&craft);
    state.modal.eta[0] = 1e-3;
    let fastest = w / (1.0 - 2.0 * p * p * arm * arm / 200.0_f64).sqrt();
    let (joint, longest) = named(&craft, &state, &inputs);
    assert_eq!(joint, None);
    assert!((longest * fastest / 8.0_f64.sqrt() - 1.0).abs() < 1e-6, "{longest}");
    holds(&craft, &state, &inputs, longest);
}

/// An isolated platform on a mount that its structure moves: both together vibrate faster than
/// either, the platform held or the structure.
#[test]
fn isolator_on_a_bending_panel_is_faster_than_either() {
    type Storage = FixedModes<1, 1>;
    let hub = Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(20.0, 18.0, 15.0) };
    let along = |z| [Vector3::new(0.0, 0.0, z)];
    for phi in [0.1, 0.2, 0.3, 0.5] {
        let position = Vector3::new(0.0, 0.0, 1.0);
        let point = ModalPoint { position, translation: along(phi), rotation: along(0.0) };
        let modes: Modes<Storage> = Modes {
            frequencies: [20.0],
            damping: [0.0],
            linear: along(0.0),
            angular: along(0.0),
            mounts: [ModalMount { point, contained: None }],
        };
        let [slide, turn] = [10.0, 0.1].map(|m| Passive::spring(m * 200.0_f64.powi(2), 0.0));
        let set = Platform {
            r_p_b: position,
            passive: platform::PerJoint::of([slide, slide, slide, turn, turn, turn]),
            ..Platform::bare(10.0, Matrix3::identity() * 0.1)
        };
        let craft = Spacecraft::flexible(&hub, &modes, &set, &0).unwrap();
        let inputs = Inputs::none_for(&craft);
        let mut state: Motion<Platform, Storage> = Motion::at_rest_for(&craft);
        state.devices.z = 1e-6;
        let (joint, longest) = named(&craft, &state, &inputs);
        // Along z, of hub, platform and mode: compliance of the mount 1 / m_hub + phi².
        let upper = 200.0 * (1.0 + 10.0 * (0.01 + phi * phi)).sqrt();
        assert!(longest * upper < 8.0_f64.sqrt() * 1.01, "{phi}: {longest}");
        assert!(joint.is_some(), "{phi}");
        holds(&craft, &state, &inputs, longest);
    }
}

/// With every joint driven the massless gimbal is singular; locked, its equation is not solved.
#[test]
fn massless_gimbal_that_is_locked_changes_no_limit() {
    type Storage = FixedModes<1, 1>;
    type Set = [FlexibleVscmg; 1];
    let hub = Hub { m_b: 120.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(200.0, 40.0, 200.0) };
    let (p, arm, w) = (12.0_f64.sqrt(), 3.0, 10.0);
    let modes: Modes<Storage> = Modes {
        frequencies: [w],
        damping: [0.005],
        linear: [Vector3::new(0.0, 0.0, p)],
        angular: [Vector3::new(p * arm, 0.0, 0.0)],
        mounts: [still()],
    };
    let (slide, tilt) = (Passive::spring(3e4, 10.0), Passive::spring(80.0, 0.02));
    let passive = flexible_vscmg::PerJoint {
        gimbal: Passive::none(),
        axial_slide: slide,
        radial_slide_y: slide,
        radial_slide_z: slide,
        tilt_y: tilt,
        tilt_z: tilt,
        wheel: Passive::none(),
    };
    let limit = |m_g: f64| {
        let bare = FlexibleVscmg::bare_wheel(3.0, diagonal(0.02, 0.012, 0.012));
        let i_g_gc = Matrix3::identity() * (0.002 * m_g);
        let device = FlexibleVscmg { m_g, i_g_gc, passive, ..bare };
        let craft = Spacecraft::flexible(&hub, &modes, &[device], &[0]).unwrap();
        let mut inputs: Inputs<Set, Flexible<Storage>> = Inputs::none_for(&craft);
        inputs.modes = [flexible_vscmg::PerJoint::all(Mode::Locked)];
        let mut state: Motion<Set, Storage> = Motion::at_rest_for(&craft);
        state.modal.eta[0] = 1e-3;
        let (joint, longest) = named(&craft, &state, &inputs);
        assert_eq!(joint, None);
        holds(&craft, &state, &inputs, longest);
        longest
    };
    let (with, without) = (limit(0.5), limit(0.0));
    assert!((with / without - 1.0).abs() < 0.01, "{with} {without}");
}

/// Joints with springs and dampers, driven, locked or prescribed, on modes of a structure: the limit
/// is that of the eigenvalues of all of them in the pose.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn limit_is_that_of_the_eigenvalues_of_structure_and_devices() {
    let (mut worst, mut worst_damped, mut by_modes, mut by_joints) = (0.0_f64, 0.0_f64, 0, 0);
    for seed in 0..32_u64 {
        // Above 24 modes, their directions at the mounts are fewer.
        let modes = [3, 8, 20, 40][usize::try_from(seed % 4).unwrap()];
        let size = Size { modes, contained: seed % 3 == 1, rotation: 0.02, free: false };
        let mut case = Case::new(SEED + 3400 + seed, size);
        let random = &mut Random::new(SEED + 3500 + seed);
        let damped = seed % 2 == 1;
        let size = if seed % 4 < 2 { 1e5 } else { 10.0 };
        let mut state = Motion::at_rest_for(&case.craft);
        for [coordinate, _] in state.devices.states_mut() {
            *coordinate = random.within(-0.5, 0.5);
        }
        state.modal.eta.iter_mut().for_each(|eta| *eta = random.within(-0.02, 0.02));
        let coordinates: Vec<_> = state.devices.states().map(|[q, _]| q).collect();
        let spring = |random: &mut Random, rest: f64| Passive {
            rest,
            stiffness: random.log_within(0.01 * size, size),
            viscous: if damped { random.log_within(0.001, 0.1) * size.sqrt() } else { 0.0 },
            ..Passive::none()
        };
        let (a, b, c, d) = &mut case.devices;
        let joints = a.passive.values_mut().chain(b.passive.values_mut());
        let joints = joints.chain(c.passive.values_mut()).chain(d.passive.values_mut());
        for (passive, rest) in joints.zip(&coordinates) {
            *passive = spring(random, *rest);
        }
        if !damped {
            case.modes.damping.fill(0.0);
        }
        let craft = Spacecraft::flexible(&case.hub, &case.modes, &case.devices, &ON_MOUNT).unwrap();
        let mut inputs: Inputs<Mixed, Flexible<ListedModes>> = Inputs::none_for(&craft);
        let mut driven = Vec::new();
        for (index, mode) in inputs.modes.values_mut().enumerate() {
            match random.within(0.0, 1.0) {
                x if x < 0.15 => *mode = Mode::Locked,
                x if x < 0.3 => *mode = Mode::Prescribed(0.0),
                _ => driven.push(index),
            }
        }
        if seed % 5 == 4 {
            inputs.hub = HubMode::Fixed;
        }

        let count = driven.len() + modes;
        let mut responses = DMatrix::zeros(count, count);
        // The modes are bent: what their own springs do is subtracted.
        let list = |inputs: &Inputs<Mixed, Flexible<ListedModes>>| -> Vec<f64> {
            let found = craft.accelerations(&state, inputs).unwrap();
            let joints: Vec<_> = found.devices.values().collect();
            driven.iter().map(|joint| joints[*joint]).chain(found.modal.eta_ddot).collect()
        };
        let none = list(&inputs);
        for column in 0..count {
            let mut forced = inputs.clone();
            match driven.get(column) {
                Some(joint) => *forced.motors.values_mut().nth(*joint).unwrap() = 1e3,
                None => forced.modal.forces[column - driven.len()] = 1e3,
            }
            for (row, (with, without)) in list(&forced).iter().zip(&none).enumerate() {
                responses[(row, column)] = 1e-3 * (with - without);
            }
        }
        let (a, b, c, d) = &case.devices;
        let own = a.passive.values().chain(b.passive.values());
        let own: Vec<_> = own.chain(c.passive.values()).chain(d.passive.values()).collect();
        let (w, zeta) = (&case.modes.frequencies, &case.modes.damping);
        let stiffness = driven.iter().map(|joint| own[*joint].stiffness);
        let stiffness: Vec<_> = stiffness.chain(w.iter().map(|w| w * w)).collect();
        let damping = driven.iter().map(|joint| own[*joint].viscous);
        let modal = w.iter().zip(zeta).map(|(w, zeta)| 2.0 * zeta * w);
        let damping: Vec<_> = damping.chain(modal).collect();
        let exact = longest_step(&responses, &damping, &stiffness);

        let (joint, longest) = named(&craft, &state, &inputs);
        let short = 1.0 - longest / exact;
        let bound = if damped { 0.15 } else { 1e-5 };
        assert!((-1e-5..bound).contains(&short), "{seed}: {longest}, not {exact}");
        let most = if damped { &mut worst_damped } else { &mut worst };
        *most = most.max(short);
        *(if joint.is_some() { &mut by_joints } else { &mut by_modes }) += 1;
        assert!(craft.step(&state, &inputs, 0.999 * longest).is_ok(), "{seed}");
        assert!(craft.step(&state, &inputs, 1.001 * longest).is_err(), "{seed}");
    }
    println!("short by {worst:.1e} undamped, {worst_damped:.2} damped at most");
    assert!(by_modes > 4 && by_joints > 4, "{by_modes} {by_joints}");
}

/// One mode of this damping ratio on an empty mount.
fn single(damping: f64) -> Spacecraft<[ReactionWheel; 0], Flexible<FixedModes<1, 1>>> {
    let hub = Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 20.0 };
    let modes: Modes<FixedModes<1, 1>> = Modes {
        frequencies: [20.0],
        damping: [damping],
        linear: [Vector3::new(0.0, 0.0, 1.0)],
        angular: [Vector3::zeros()],
        mounts: [still()],
    };
    Spacecraft::flexible(&hub, &modes, &[], &[]).expect("valid")
}

#[test]
fn input_that_is_not_finite_is_named_before_the_step() {
    let craft = single(0.01);
    let inputs = Inputs::none_for(&craft);
    let mut state = Motion::at_rest_for(&craft);
    state.omega.x = f64::INFINITY;
    for dt in [1e-3, 1.0, 1e300] {
        let found = craft.step(&state, &inputs, dt).expect_err("not finite");
        let value = f64::INFINITY;
        assert_eq!(found, SolveError::NotFinite { what: Quantity::BodyRate, value });
    }
}

/// A step of no length changes nothing and is no step that is too long.
#[test]
fn step_of_no_length_is_never_too_long() {
    for damping in [0.0, 1e3, 1e308] {
        let craft = single(damping);
        let found = craft.step(&Motion::at_rest_for(&craft), &Inputs::none_for(&craft), 0.0);
        let overflows = matches!(found, Err(SolveError::Overflow { .. }));
        assert!(found.is_ok() || (damping == 1e308 && overflows), "{damping}: {found:?}");
    }
}

/// A step so long that the state overflows is an overflow, of the work too, as on a rigid hub.
#[test]
fn step_that_overflows_names_no_finite_input() {
    type Storage = FixedModes<0, 1>;
    let hub = Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 20.0 };
    let none: Modes<Storage> =
        Modes { frequencies: [], damping: [], linear: [], angular: [], mounts: [still()] };
    let craft = Spacecraft::flexible(&hub, &none, &([] as [ReactionWheel; 0]), &[]).unwrap();
    let mut state: Motion<[ReactionWheel; 0], Storage> = Motion::at_rest_for(&craft);
    state.r_b_n_dot.x = 1e10;
    let inputs = Inputs::none_for(&craft);
    let rigid = craft
        .undeformed()
        .step_with_work(&state.with_modal(()), &inputs.with_modal(()), 1e300)
        .map(|_| ());
    let rigid = rigid.expect_err("overflow");
    let found = craft.step_with_work(&state, &inputs, 1e300).map(|_| ()).expect_err("overflow");
    assert!(matches!(found, SolveError::Overflow { .. }), "{found:?}");
    assert_eq!(found, rigid);
}
