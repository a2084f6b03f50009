//! Derivatives by state and inputs against differences in double-double: of structures with modes, with mounts, with
//! both; of a step, too. Without either they are those of the rigid hub, bit by bit.

use nalgebra::{DMatrix, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::set::{OnMount, WithNumbers};
use precess_dynamics::{
    About, Attitude, Column, DerivativeError, DeviceSet, Devices, Dgvscmg, Flexible, Gravity,
    HingedPanel, HubMode, Inputs, Isolated, ListedModes, LoadAxes, Loads, ModalState, Outputs,
    Quaternion, ReactionWheel, Rigid, Scalar, SloshMass, Spacecraft, State, Variable, Vscmg,
    Wrench,
};
use precess_tests::blocks::Figures;
use precess_tests::bounds::{DERIVATIVES_MEDIAN, DERIVATIVES_WORST};
use precess_tests::derivative_blocks::{Blocks, kind, named};
use precess_tests::differences::{Named, difference, index};
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::random::Random;

use crate::craft::{Case, ON_MOUNT, SEED, Size, draw_inputs, draw_motion, structure};
use crate::wide::{Point, craft};
use crate::{platform, residual};

type Structure = Flexible<ListedModes>;

/// Everything is differentiated.
const OUTPUTS: Outputs =
    Outputs { momentum: Some(About::InertialOrigin), loads: Some(LoadAxes::Body) };

/// A step that resolves modes and springs, s.
const DT: f64 = 1e-3;

/// The loads on all joints in a row.
trait JointLoads: Devices {
    fn joint_loads(loads: &Loads<Self, Structure>) -> Vec<Wrench<Self::Scalar>>;
}

impl<T: Scalar> JointLoads for [ReactionWheel<T>; 0] {
    fn joint_loads(_: &Loads<Self, Structure>) -> Vec<Wrench<T>> {
        Vec::new()
    }
}

impl<T: Scalar> JointLoads for (Dgvscmg<T>, ReactionWheel<T>, HingedPanel<T>, SloshMass<T>) {
    fn joint_loads(loads: &Loads<Self, Structure>) -> Vec<Wrench<T>> {
        let (gyro, wheel, panel, slosh) = &loads.devices;
        let first = gyro.joints.values().chain(wheel.joints.values());
        first.chain(panel.joints.values()).chain(slosh.joints.values()).collect()
    }
}

impl<T: Scalar> JointLoads for (ReactionWheel<T>, Isolated<Vscmg<T>>) {
    fn joint_loads(loads: &Loads<Self, Structure>) -> Vec<Wrench<T>> {
        let (wheel, isolated) = &loads.devices;
        let on_platform = isolated.carrier.joints.values().chain(isolated.carried.joints.values());
        wheel.joints.values().chain(on_platform).collect()
    }
}

/// The values at a state.
fn values<D: JointLoads<Scalar = Wide>>(
    craft: &Spacecraft<D, Structure>,
    Point { state, inputs }: &Point<D>,
) -> Named<Wide> {
    let expect = "regular";
    let found = craft.accelerations(state, inputs).expect(expect);
    let bn = state.attitude.dcm();
    let in_n = Vector3::from_fn(|k, _| {
        let [x, y, z] = [0, 1, 2].map(|row| bn[(row, k)] * found.r_b_n_ddot[row]);
        x + y + z
    });
    let momentum = craft.energy_and_momentum(state, About::InertialOrigin).expect(expect);
    let loads = craft.loads(state, inputs, &found, LoadAxes::Body).expect(expect);
    let held = (inputs.hub != HubMode::Free).then_some(loads.hub);
    let hub = [found.r_b_n_ddot, in_n, found.omega_dot];
    let accelerations = [found.devices.values().collect(), found.modal.eta_ddot];
    named(craft, hub, accelerations, &momentum, (&D::joint_loads(&loads), held))
}

/// The derivatives of a column, with a hub of that mode.
fn derivatives<D: Devices<Scalar = f64>>(
    craft: &Spacecraft<D, Structure>,
    hub: HubMode,
    column: &Column<D, Structure>,
) -> Named<f64> {
    let Column { accelerations, r_b_n_ddot_n, momentum, loads, hub_load } = column;
    let held = if hub == HubMode::Free { None } else { *hub_load };
    let hub = [accelerations.r_b_n_ddot, *r_b_n_ddot_n, accelerations.omega_dot];
    let joints = accelerations.devices.values().collect();
    let loads: Vec<_> = loads.iter().flat_map(Each::values).collect();
    let modes = accelerations.modal.eta_ddot.clone();
    named(craft, hub, [joints, modes], &momentum.expect("requested"), (&loads, held))
}

/// The scale on which a variable's effect changes.
fn size<D: Devices<Scalar = Wide>>(at: &Point<D>, variable: Variable) -> f64 {
    match variable {
        Variable::Position(_) => at.state.r_b_n.iter().map(|x| x.abs().to_f64()).sum(),
        Variable::Mu => 900.0,
        _ => 1.0,
    }
}

/// The worst block of derivatives, with its name.
fn worst_block<D>(
    case: &Case<D>,
    residual: usize,
    on_mount: &<D::With<Wide> as DeviceSet>::Per<OnMount>,
) -> (f64, String)
where
    D: WithNumbers<Scalar = f64>,
    D::With<Wide>: JointLoads,
{
    let own = &case.craft;
    let wide = craft(case, residual, on_mount);
    let at = Point::new(&wide, case);
    let field = matches!(case.inputs.gravity, Gravity::Central { .. }).then_some(Variable::Mu);
    let states = own.state_variables(&case.inputs);
    let variables: Vec<_> = states.chain(own.input_variables(&case.inputs)).chain(field).collect();
    let emitted = own.linearize(&case.state, &case.inputs, &Outputs::accelerations()).unwrap();
    assert_eq!(emitted.accelerations, own.accelerations(&case.state, &case.inputs).unwrap());
    let mut columns = emitted.c.column_iter().chain(emitted.d.column_iter());
    let (mut blocks, mut of_emitted, mut other_bits) = (Blocks::default(), Blocks::default(), 0);
    let by = variables.iter().copied();
    let found = own.derivatives(&case.state, &case.inputs, &OUTPUTS, by, |variable, column| {
        let size = size(&at, variable);
        let expected = difference(size, |by| values(&wide, &at.changed(variable, by)));
        let found = derivatives(own, case.inputs.hub, column);
        let kind = kind(own, variable);
        blocks.add(&kind, size, &found, &expected);
        // There is none by the gravitational parameter.
        let Some(own) = columns.next() else { return };
        let (dual, expected) = (accelerations(&found), accelerations(&expected));
        let names = expected.iter().map(|(name, _)| name.clone());
        let found: Named<f64> = names.zip(own.iter().copied()).collect();
        other_bits += usize::from(found != dual);
        of_emitted.add(&kind, size, &found, &expected);
    });
    let found = found.unwrap_or_else(|error| panic!("seed {:#x}: {error}", case.seed));
    assert_eq!(found, own.accelerations(&case.state, &case.inputs).unwrap());
    assert!(other_bits > 0, "seed {:#x}: not by emitted derivatives", case.seed);
    let (dual, emitted) = (largest(&blocks), largest(&of_emitted));
    if emitted.0 > dual.0 { (emitted.0, format!("{}, emitted", emitted.1)) } else { dual }
}

/// The accelerations of all that is differentiated, in order.
fn accelerations<T: Copy>(of: &Named<T>) -> Named<T> {
    let of_hub = |(name, _): &&(String, T)| ["r_b_n_ddot", "omega_dot"].contains(&name.as_str());
    let after = of.iter().skip_while(|(name, _)| name != "energy").skip(1);
    of.iter().filter(of_hub).chain(after).cloned().collect()
}

fn largest(blocks: &Blocks) -> (f64, String) {
    blocks.errors().fold((0.0, String::new()), |a, b| if b.0 > a.0 { b } else { a })
}

/// A structure with modes, and neither mounts nor devices.
fn without_mounts(seed: u64, size: Size) -> Case<[ReactionWheel; 0]> {
    let random = &mut Random::new(seed);
    let (hub, modes) = structure(random, size, &[]);
    let craft = Spacecraft::flexible(&hub, &modes, &[], &[]).expect("valid");
    let (mut state, mut inputs) = (State::at_rest_for(&craft), Inputs::none_for(&craft));
    draw_motion(random, size, &mut state);
    draw_inputs(random, &mut inputs);
    Case { seed, hub, modes, devices: [], craft, chains: Vec::new(), state, inputs }
}

/// A case of modes and mounts, every second with wrenches on the bodies; and the hub and the field of a number.
fn drawn(seed: u64, size: Size) -> Case {
    let mut case = Case::new(seed, size);
    let random = &mut Random::new(seed + 1);
    if seed.is_multiple_of(2) {
        let mut bodies = Inputs::no_wrenches_for(&case.craft);
        for wrench in bodies.values_mut() {
            *wrench = Wrench { force: random.vector(3.0), moment: random.vector(1.0) };
        }
        case.inputs.bodies = Some(bodies);
    }
    match seed % 3 {
        0 => case.inputs.gravity = Gravity::Central { mu: 900.0 },
        1 => {
            let (r_b_n_ddot, omega_dot) = (random.vector(1.0), random.vector(0.3));
            case.inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot };
        }
        _ => (),
    }
    case
}

const fn of_modes(modes: usize, contained: bool) -> Size {
    Size { modes, contained, rotation: 0.1, free: false }
}

#[test]
fn derivatives_are_those_of_differences_in_double_double() {
    let mut figures = Figures::default();
    let mut add = |what: &str, (error, name): (f64, String)| {
        println!("{what}: {error:.1e} in {name}");
        figures.add(error);
    };
    let of = |case: &Case| worst_block(case, 0, &ON_MOUNT);
    add("modes", worst_block(&without_mounts(SEED + 1200, of_modes(3, false)), 0, &[]));
    add("mounts", of(&drawn(SEED + 1201, of_modes(0, false))));
    add("mounts that contain bodies", of(&drawn(SEED + 1202, of_modes(0, true))));
    for (seed, contained) in (SEED + 1203..).zip([false, true, false]) {
        add("modes and mounts", of(&drawn(seed, of_modes(3, contained))));
    }
    add("residual coordinates", worst_block(&residual::case(SEED + 1206, 2, 1), 1, &ON_MOUNT));
    let size = of_modes(2, true);
    let mut suspension = platform::suspension(1.0);
    for strut in suspension.struts.iter_mut().flatten() {
        // Of length one in every scalar.
        strut.direction = Vector3::new(0.0, 0.0, 1.0);
    }
    let carried = platform::case(SEED + 1207, size, &suspension);
    add("a platform", worst_block(&carried, 0, &platform::ON_MOUNT));
    let (worst, median) = (figures.worst(), figures.median());
    println!("worst {worst:.1e}, median {median:.1e}");
    assert!(worst <= DERIVATIVES_WORST, "{worst:e}");
    assert!(median <= DERIVATIVES_MEDIAN, "{median:e}");
}

/// More modes than directions: the constants of the directions are converted, too.
#[test]
fn derivatives_of_many_modes_are_those_of_differences() {
    let case = Case::new(SEED + 1210, of_modes(26, true));
    let wide = craft(&case, 0, &ON_MOUNT);
    let at = Point::new(&wide, &case);
    let mut blocks = Blocks::default();
    let by = [
        Variable::Omega(precess_dynamics::Axis::Y),
        Variable::Coordinate(3),
        Variable::ModalCoordinate(25),
        Variable::ModalRate(7),
        Variable::ModalForce(11),
        Variable::MountForce(1, precess_dynamics::Axis::Z),
        Variable::MountMoment(2, precess_dynamics::Axis::X),
    ];
    let own = &case.craft;
    own.derivatives(&case.state, &case.inputs, &OUTPUTS, by, |variable, column| {
        let expected = difference(1.0, |by| values(&wide, &at.changed(variable, by)));
        blocks.add(&kind(own, variable), 1.0, &derivatives(own, HubMode::Free, column), &expected);
    })
    .expect("regular");
    let (error, name) = largest(&blocks);
    println!("{error:.1e} in {name}");
    assert!(error <= DERIVATIVES_WORST, "{error:e} in {name}");
}

/// The numbers of a state after a step, its attitude by the rotation from another one about the axes of B.
fn numbers<D: Devices<Scalar = Wide>>(
    states: &[Variable],
    state: &State<D, Quaternion<Wide>, Structure>,
    from: &Quaternion<Wide>,
) -> Vec<Wide> {
    let joint = |joint: usize| state.devices.states().nth(joint).unwrap();
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let (s, q) = (from.q0, [from.q1, from.q2, from.q3]);
    let p = [q1, q2, q3];
    let turn = |k: usize| {
        let (m, n) = ((k + 1) % 3, (k + 2) % 3);
        let half = s * p[k] - q0 * q[k] - (q[m] * p[n] - q[n] * p[m]);
        half + half
    };
    let number = |variable: &Variable| match *variable {
        Variable::Position(axis) => state.r_b_n[index(axis)],
        Variable::Attitude(axis) => turn(index(axis)),
        Variable::Velocity(axis) => state.r_b_n_dot[index(axis)],
        Variable::Omega(axis) => state.omega[index(axis)],
        Variable::Coordinate(of) => joint(of)[0],
        Variable::Rate(of) => joint(of)[1],
        Variable::ModalCoordinate(mode) => state.modal.eta[mode],
        Variable::ModalRate(mode) => state.modal.eta_dot[mode],
        other => panic!("{other} is no state"),
    };
    states.iter().map(number).collect()
}

#[test]
fn linearised_step_is_that_of_differences_in_double_double() {
    let case = drawn(SEED + 1212, of_modes(3, true));
    let (own, wide) = (&case.craft, craft(&case, 0, &ON_MOUNT));
    let at = Point::new(&wide, &case);
    let found = own.linearize_step(&case.state, &case.inputs, DT).expect("a step");
    assert_eq!(found.state, own.step(&case.state, &case.inputs, DT).unwrap());
    let dt = <Wide as Scalar>::from_f64(DT);
    let stepped = |at: &Point<_>| wide.step(&at.state, &at.inputs, dt).expect("a step");
    let reached = stepped(&at).attitude;
    let kinds: Vec<_> = found.states.iter().map(|variable| kind(own, *variable)).collect();
    let list = |numbers: Vec<Wide>| kinds.iter().cloned().zip(numbers).collect::<Named<Wide>>();
    let mut blocks = Blocks::default();
    let columns = found.a.column_iter().chain(found.b.column_iter());
    for (variable, column) in found.states.iter().chain(&found.inputs).zip(columns) {
        let size = size(&at, *variable);
        let expected = difference(size, |by| {
            list(numbers(&found.states, &stepped(&at.changed(*variable, by)), &reached))
        });
        let found: Named<f64> = kinds.iter().cloned().zip(column.iter().copied()).collect();
        blocks.add(&kind(own, *variable), size, &found, &expected);
    }
    let (error, name) = largest(&blocks);
    println!("{error:.1e} in {name}");
    assert!(error <= DERIVATIVES_WORST, "{error:e} in {name}");
}

fn bits(of: &DMatrix<f64>) -> Vec<u64> {
    of.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn without_modes_and_mounts_they_are_those_of_the_rigid_hub() {
    for seed in SEED + 1220..SEED + 1223 {
        let case = drawn(seed, of_modes(0, false));
        let rigid = Spacecraft::new(&case.hub, &case.devices).unwrap();
        let craft = Spacecraft::from_rigid(rigid.clone());
        let none = ModalState { eta: Vec::new(), eta_dot: Vec::new() };
        let (state, inputs) = (case.state.with_modal(none), &case.inputs);
        let of_rigid = (state.clone().with_modal(()), inputs.clone().with_modal::<Rigid>(()));
        let inputs = inputs.clone().with_modal(Inputs::none_for(&craft).modal);
        let found = craft.linearize(&state, &inputs, &OUTPUTS).unwrap();
        let expected = rigid.linearize(&of_rigid.0, &of_rigid.1, &OUTPUTS).unwrap();
        assert_eq!(found.accelerations.with_modal::<Rigid>(()), expected.accelerations);
        assert_eq!(
            (&found.states, &found.inputs, &found.outputs),
            (&expected.states, &expected.inputs, &expected.outputs)
        );
        for (found, expected) in [
            (&found.a, &expected.a),
            (&found.b, &expected.b),
            (&found.c, &expected.c),
            (&found.d, &expected.d),
        ] {
            assert_eq!(bits(found), bits(expected), "seed {seed:#x}");
        }
        let found = craft.linearize_step(&state, &inputs, DT).unwrap();
        let expected = rigid.linearize_step(&of_rigid.0, &of_rigid.1, DT).unwrap();
        assert_eq!(found.state.with_modal::<Rigid>(()), expected.state);
        assert_eq!((bits(&found.a), bits(&found.b)), (bits(&expected.a), bits(&expected.b)));
    }
}

/// A conversion of each number to itself: nothing is left out.
#[test]
fn converted_structure_has_the_same_bits() {
    let mut case = residual::case(SEED + 1230, 30, 1);
    case.inputs.gravity = Gravity::Central { mu: 900.0 };
    let (own, same) = (&case.craft, case.craft.with_numbers(|number: f64| number));
    let Case { state, inputs, .. } = &case;
    let found = same.accelerations(state, inputs).unwrap();
    assert_eq!(found, own.accelerations(state, inputs).unwrap());
    let both = [own, &same];
    let [a, b] = both.map(|of| of.loads(state, inputs, &found, LoadAxes::Body).unwrap());
    assert_eq!(a, b);
    let [a, b] = both.map(|of| of.ledger(state, inputs, &found).unwrap());
    assert_eq!(a, b);
    let [a, b] = both.map(|of| of.step(state, inputs, DT).unwrap());
    assert_eq!(a, b);
    let [a, b] = both.map(|of| of.step(state, inputs, 1.0).err());
    assert!(a.is_some());
    assert_eq!(a, b);
    assert_eq!(own.mass(), same.mass());
}

#[test]
fn a_mode_or_mount_that_does_not_exist_is_named() {
    let case = Case::new(SEED + 1240, of_modes(2, false));
    let axis = precess_dynamics::Axis::X;
    let of = |variable| {
        let none = Outputs::accelerations();
        case.craft.derivatives(&case.state, &case.inputs, &none, [variable], |_, _| ()).err()
    };
    for variable in [Variable::ModalCoordinate, Variable::ModalRate, Variable::ModalForce] {
        assert_eq!(of(variable(1)), None);
        let error = DerivativeError::NoSuchMode { mode: 2, modes: 2 };
        assert_eq!(of(variable(2)), Some(error));
        assert_eq!(error.to_string(), "no mode 2; modes count from 0, and there are 2");
    }
    for variable in [Variable::MountForce, Variable::MountMoment] {
        assert_eq!(of(variable(2, axis)), None);
        let error = DerivativeError::NoSuchMount { mount: 3, mounts: 3 };
        assert_eq!(of(variable(3, axis)), Some(error));
        assert_eq!(error.to_string(), "no mount 3; mounts count from 0, and there are 3");
    }
    let name = |variable| case.craft.variable_name(variable).to_string();
    assert_eq!(name(Variable::ModalRate(1)), "modal.eta_dot[1]");
    assert_eq!(name(Variable::MountMoment(2, axis)), "modal.mounts[2].moment.x");
}
