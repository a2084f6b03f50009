//! Devices side by side have the derivatives of their loads, to the bit, that they have one after another: every kind, in
//! rows of every length, before and behind a row of another kind.

use std::format;
use std::string::String;
use std::vec::Vec;

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::each_device::EachDevice;
use super::kernel::Moving;
use super::load_columns::{LoadColumns, LoadsWorkspace};
use super::side_by_side::TOGETHER;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::side_by_side::fallbacks::FALLBACKS;
use crate::equations::side_by_side::registers::Registers;
use crate::every_kind;
use crate::generated::devices::*;
use crate::model::kind::{JointInfo, Kind, no_body};
use crate::numbers::vec3::components;
use crate::sets::devices::DeviceSet;
use crate::sets::with_numbers::WithNumbers;
use crate::{
    BuiltIn, Each as _, Hub, ImbalanceModel, Inputs, JointStates as _, Mode, Passive, Spacecraft,
    State,
};

/// Devices of a kind and wheels.
type Set<K> = (Vec<K>, Vec<ReactionWheel>);

/// Lengths of rows of one kind: with registers of eight up to three groups, the last of any length.
const ALONE: [usize; 18] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 21, 22];

/// Lengths of a row of a kind and of a row of wheels.
const TWO_ROWS: [[usize; 2]; 4] = [[8, 5], [5, 8], [13, 3], [3, 13]];

/// What joints have: any mode and springs, or motors and springs or nothing. Joints of devices side by side are eliminated
/// side by side where they have the same modes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Joints {
    OfAnyMode,
    Driven,
    DrivenWithoutSprings,
}

/// Numbers in no order, the same in every run.
struct Numbers(u64);

impl Numbers {
    /// Within -1 and 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(0x9E37_79B9);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / f64::from(1_u32 << 31) - 1.0
    }

    fn vector(&mut self, largest: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| largest * self.next())
    }

    /// The mass of a body, and so on: no two devices have one number alike.
    fn device<K: Kind<Scalar = f64>>(&mut self, joints: Joints) -> K {
        let (mut bodies, mut passive) = (K::all(no_body()), K::all(Passive::none()));
        let of_joints = bodies.values_mut().zip(passive.values_mut()).zip(K::JOINTS);
        for ((body, passive), JointInfo { rate, .. }) in of_joints {
            body.origin = self.vector(1.0).into();
            body.mass = 3.0 + self.next();
            let beside = 1e-2 * self.next().abs();
            body.centre =
                if *rate == "spin" { [0.0, beside, 0.0] } else { self.vector(0.1).into() };
            let products = self.vector(0.01);
            let moments = Vector3::new(0.3, 0.2, 0.25) * (3.0 + self.next());
            body.inertia = Matrix3::from_diagonal(&moments);
            for ([row, column], product) in [[0, 1], [0, 2], [1, 2]].into_iter().zip(&products) {
                body.inertia[(row, column)] = *product;
                body.inertia[(column, row)] = *product;
            }
            if joints == Joints::DrivenWithoutSprings {
                continue;
            }
            *passive = Passive {
                stiffness: 200.0 + 100.0 * self.next(),
                rest: 1e-3 * self.next(),
                viscous: 0.02 + 0.01 * self.next(),
                coulomb: 0.1,
                coulomb_rate: 0.3,
            };
        }
        let [roll, pitch, yaw] = self.vector(3.0).into();
        let mount = Rotation3::from_euler_angles(roll, pitch, yaw).into_inner();
        K::of_bodies(&mount, &bodies, &passive, ImbalanceModel::Coupled)
    }
}

/// What is found of each device, with all joints eliminated: the shortest digits that are a number's alone.
fn found<D: DeviceSet<Scalar = f64> + crate::Devices>(
    craft: &Spacecraft<D>,
    state: &State<D>,
    inputs: &Inputs<D>,
    numbers: &mut Numbers,
    keeping: bool,
) -> String {
    let mut accelerations = craft.no_accelerations();
    accelerations.devices.values_mut().for_each(|to| *to = 2.0 * numbers.next());
    let hub = HubAccelerations {
        r_b_n_ddot: components(&numbers.vector(1.0)),
        omega_dot: components(&numbers.vector(1.0)),
    };
    let omega = components(&state.omega);
    let joints = craft.joints().count();
    let mut workspace = LoadsWorkspace::new();
    let mut each = EachDevice::new(craft.arithmetic, (omega, hub), joints, &mut workspace);
    if keeping {
        each = each.keeping_eliminations();
    }
    let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
    D::visit::<Moving, _>(&craft.devices, data, &mut each).unwrap();
    let columns = &workspace.columns;
    let three = |rows: &[[f64; TOGETHER]]| -> Vec<_> {
        rows.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect()
    };
    let of_joints = columns.joints().iter().map(|of| {
        let less = three(of.less.get(..of.count).unwrap_or_default());
        (of.first, of.count, of.free, three(&of.hub), less)
    });
    let (of_joints, omega) = (of_joints.collect::<Vec<_>>(), three(&columns.sums.omega));
    let LoadColumns { gains, eliminated, sums, .. } = columns;
    let matrix = sums.matrix;
    format!("{of_joints:?} {omega:?} {gains:?} {eliminated:?} {matrix:?}")
}

/// Accelerations with their derivatives along a direction, and the gradient of a weighted sum: to the bit.
fn products<D: WithNumbers<Scalar = f64>>(
    craft: &Spacecraft<D>,
    state: &State<D>,
    inputs: &Inputs<D>,
    numbers: &mut Numbers,
) -> Option<String> {
    let [states, acting] =
        [craft.state_variables(inputs).count(), craft.input_variables(inputs).count()];
    let mut some = |count: usize| -> Vec<_> { (0..count).map(|_| numbers.next()).collect() };
    let (mut of_state, mut of_inputs) = (some(states), some(acting));
    let (accelerations, along) = craft.jvp(state, inputs, (&of_state, &of_inputs)).ok()?;
    craft.vjp(state, inputs, &along, (&mut of_state, &mut of_inputs)).ok()?;
    Some(format!("{accelerations:?} {along:?} {of_state:?} {of_inputs:?}"))
}

fn compare<K: Kind<Scalar = f64>>(rows: [usize; 2]) {
    let joints = [Joints::OfAnyMode, Joints::Driven, Joints::DrivenWithoutSprings];
    for joints in joints {
        compare_with::<K>(rows, joints);
    }
}

fn compare_with<K: Kind<Scalar = f64>>([first, wheels]: [usize; 2], joints: Joints) {
    let numbers = &mut Numbers((first * 100 + wheels) as u64);
    let hub = Hub { m_b: 500.0, r_bc_b: numbers.vector(0.1), i_b_bc: Matrix3::identity() * 90.0 };
    let devices: Set<K> = (
        (0..first).map(|_| numbers.device(joints)).collect(),
        (0..wheels).map(|_| numbers.device(joints)).collect(),
    );
    let craft = Spacecraft::new(&hub, &devices).unwrap_or_else(|error| panic!("{error}"));
    let mut state: State<Set<K>> = State::at_rest_for(&craft);
    let mut inputs = Inputs::none_for(&craft);
    state.omega = numbers.vector(0.5);
    for [coordinate, rate] in state.devices.states_mut() {
        (*coordinate, *rate) = (numbers.next(), 5.0 * numbers.next());
    }
    let infos: Vec<_> = craft.joints().map(|(_, info)| info).collect();
    let modes = inputs.modes.values_mut().zip(infos);
    for (mode, info) in modes.filter(|_| joints == Joints::OfAnyMode) {
        let number = numbers.next();
        match number {
            ..-0.7 => *mode = Mode::Locked,
            0.7.. if info.driven => *mode = Mode::Prescribed(number),
            _ => (),
        }
    }
    let mut single = craft.clone();
    single.devices.0.iter_mut().for_each(|device| device.group = None);
    single.devices.1.iter_mut().for_each(|device| device.group = None);
    let seed = numbers.0;
    FALLBACKS.set(0);
    for keeping in [false, true] {
        let side_by_side = found(&craft, &state, &inputs, &mut Numbers(seed), keeping);
        assert_eq!(FALLBACKS.get(), 0, "{} and wheels: {first}, {wheels}", K::NAME);
        let one_by_one = found(&single, &state, &inputs, &mut Numbers(seed), keeping);
        assert!(side_by_side == one_by_one, "{} and wheels: {first}, {wheels}", K::NAME);
    }
    // A locked joint must not move.
    for ([_, rate], mode) in state.devices.states_mut().zip(inputs.modes.values()) {
        *rate = if mode == Mode::Locked { 0.0 } else { *rate };
    }
    let [side_by_side, one_by_one] =
        [&craft, &single].map(|craft| products(craft, &state, &inputs, &mut Numbers(seed)));
    assert!(side_by_side.is_some(), "{}: no products", K::NAME);
    assert!(side_by_side == one_by_one, "{} and wheels: {first}, {wheels}", K::NAME);
    assert_eq!(FALLBACKS.get(), 0, "{} and wheels: {first}, {wheels}", K::NAME);
    if first.max(wheels) >= 4 && Registers::widest().is_some() {
        let [of_kind, of_wheels] = [
            craft.devices.0.iter().any(|device| device.group.is_some()),
            craft.devices.1.iter().any(|device| device.group.is_some()),
        ];
        assert!(of_kind || of_wheels, "{}: nothing is side by side", K::NAME);
    }
}

/// Copies numbers of a set into one of another shape.
fn copied(
    from: &State<impl crate::Devices<Scalar = f64>>,
    to: &mut State<impl crate::Devices<Scalar = f64>>,
) {
    to.omega = from.omega;
    for ([coordinate, rate], [q, q_dot]) in to.devices.states_mut().zip(from.devices.states()) {
        (*coordinate, *rate) = (q, q_dot);
    }
}

/// A list of a kind and wheels, as of devices whose kinds are known when the program is compiled.
fn compare_list<K: Kind<Scalar = f64> + Into<BuiltIn>>([first, wheels]: [usize; 2]) {
    let numbers = &mut Numbers((first * 1000 + wheels) as u64);
    let hub = Hub { m_b: 500.0, r_bc_b: numbers.vector(0.1), i_b_bc: Matrix3::identity() * 90.0 };
    let typed: Set<K> = (
        (0..first).map(|_| numbers.device(Joints::OfAnyMode)).collect(),
        (0..wheels).map(|_| numbers.device(Joints::OfAnyMode)).collect(),
    );
    let of_kind = typed.0.iter().map(|device| (*device).into());
    let list: Vec<BuiltIn> = of_kind.chain(typed.1.iter().map(|wheel| (*wheel).into())).collect();
    let (mut one_by_one, list) =
        (Spacecraft::new(&hub, &typed).unwrap(), Spacecraft::new(&hub, &list).unwrap());
    one_by_one.devices.0.iter_mut().for_each(|device| device.group = None);
    one_by_one.devices.1.iter_mut().for_each(|device| device.group = None);
    let (mut state, mut inputs) = (State::at_rest_for(&one_by_one), Inputs::none_for(&one_by_one));
    state.omega = numbers.vector(0.5);
    for [coordinate, rate] in state.devices.states_mut() {
        (*coordinate, *rate) = (numbers.next(), 5.0 * numbers.next());
    }
    if let Some(mode) = inputs.modes.values_mut().next().filter(|_| first % 4 < 2) {
        *mode = Mode::Locked;
    }
    let (mut state_of_list, mut inputs_of_list) =
        (State::at_rest_for(&list), Inputs::none_for(&list));
    copied(&state, &mut state_of_list);
    for (to, mode) in inputs_of_list.modes.values_mut().zip(inputs.modes.values()) {
        *to = mode;
    }
    let seed = numbers.0;
    FALLBACKS.set(0);
    let of_list = found(&list, &state_of_list, &inputs_of_list, &mut Numbers(seed), first % 2 == 0);
    assert_eq!(FALLBACKS.get(), 0, "{} and wheels: {first}, {wheels}", K::NAME);
    let of_typed = found(&one_by_one, &state, &inputs, &mut Numbers(seed), first % 2 == 0);
    assert!(of_list == of_typed, "{} and wheels: {first}, {wheels}", K::NAME);
}

#[test]
fn lists_side_by_side_have_the_derivatives_of_one_after_another() {
    macro_rules! each {
        ($($kind:ident $module:ident $number:literal;)*) => {
            $(
                for count in 1..=9 {
                    compare_list::<$kind>([count, 0]);
                }
                TWO_ROWS.into_iter().for_each(compare_list::<$kind>);
            )*
        };
    }
    every_kind!(each);
}

#[test]
fn devices_side_by_side_have_the_derivatives_of_one_after_another() {
    macro_rules! each {
        ($($kind:ident $module:ident $number:literal;)*) => {
            $(
                for count in ALONE {
                    compare::<$kind>([count, 0]);
                }
                TWO_ROWS.into_iter().for_each(compare::<$kind>);
            )*
        };
    }
    every_kind!(each);
}
