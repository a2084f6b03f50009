//! Random spacecraft, states and inputs as batches take them, and what the suite of the emitted solver makes of them.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Attitude as _, BuiltIn, BuiltInKind, Gravity, Hub, HubMode, Mode, Quaternion, Wrench,
};
use precess_gpu::ActingInputs;

use crate::case::{Case, Settings};
use crate::random::Random;
use crate::reference::reference;

/// All that a batch can have act, but for a hub that is held and a shape of the attitude.
pub(crate) const SETTINGS: Settings = Settings {
    mrp: false,
    passive: true,
    wrenches: true,
    field: 2,
    hub: 0,
    modes: true,
    dt: 1e-4,
    steps: 0,
};

/// A random case whose attitude stays the same to the last bit when it is normalised.
pub(crate) fn random(kinds: &[BuiltInKind], settings: Settings, random: &mut Random) -> Case {
    let mut case = Case::random(kinds, settings, random);
    // Some are changed by every normalisation.
    loop {
        let [q0, q1, q2, q3] = [(); 4].map(|()| random.within(-1.0, 1.0));
        let q = Quaternion { q0, q1, q2, q3 }.normalised().normalised();
        if q.normalised() == q {
            case.attitude = [q.q0, q.q1, q.q2, q.q3];
            return case;
        }
    }
}

pub(crate) fn craft(case: &Case) -> (Hub, Vec<BuiltIn>) {
    let [xx, xy, xz, yy, yz, zz] = case.inertia;
    let i_b_bc = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let hub = Hub { m_b: case.mass, r_bc_b: Vector3::from(case.centre_of_mass), i_b_bc };
    (hub, case.devices.clone())
}

pub(crate) fn inputs(case: &Case) -> ActingInputs {
    let joints = || case.joints.iter();
    let mode = |of: &crate::case::Joint| match of.mode {
        0 => Mode::Driven,
        1 => Mode::Prescribed(of.acceleration),
        _ => Mode::Locked,
    };
    let wrench = |of: &crate::case::Joint| Wrench {
        force: Vector3::from(of.force),
        moment: Vector3::from(of.moment),
    };
    ActingInputs {
        force: Vector3::from(case.force),
        torque_b: Vector3::from(case.torque_b),
        motors: joints().map(|joint| joint.torque).collect(),
        modes: joints().map(mode).collect(),
        hub: match case.settings.hub {
            0 => HubMode::Free,
            1 => HubMode::Fixed,
            _ => HubMode::Prescribed {
                r_b_n_ddot: Vector3::from(case.r_b_n_ddot),
                omega_dot: Vector3::from(case.omega_dot),
            },
        },
        gravity: match case.settings.field {
            0 => Gravity::None,
            1 => Gravity::Uniform(Vector3::from(case.uniform)),
            _ => Gravity::Central { mu: case.mu },
        },
        bodies: case.settings.wrenches.then(|| joints().map(wrench).collect()),
    }
}

/// Coordinates and rates of each device in a flat state.
fn by_device(case: &Case, coordinates: &[f64], rates: &[f64]) -> Vec<f64> {
    let (mut numbers, mut first) = (Vec::new(), 0);
    for device in &case.devices {
        let end = first + device.kind().joints().len();
        numbers.extend(&coordinates[first..end]);
        numbers.extend(&rates[first..end]);
        first = end;
    }
    numbers
}

/// The state of a case as a flat one.
pub(crate) fn row(case: &Case) -> Vec<f64> {
    let mut row = [case.r_b_n, case.r_b_n_dot].concat();
    row.extend(case.attitude.iter().chain(&case.omega));
    let of = |number: fn(&crate::case::Joint) -> f64| -> Vec<f64> {
        case.joints.iter().map(number).collect()
    };
    row.extend(by_device(case, &of(|joint| joint.coordinate), &of(|joint| joint.rate)));
    row
}

/// Accelerations, and the flat state after so many steps, by the suite of the emitted solver; none where it fails.
pub(crate) fn expected(case: &Case, steps: usize) -> [Option<Vec<f64>>; 2] {
    let joints = case.joints.len();
    let settings = Settings { steps, ..case.settings };
    let all = reference(&Case { settings, ..case.clone() });
    let state = &all[10 + joints..];
    let (coordinates, rates) = state[13..13 + 2 * joints].split_at(joints);
    let row = [state[..13].to_vec(), by_device(case, coordinates, rates)].concat();
    let found =
        |status: usize, numbers: Vec<f64>| (all[0] == 0.0 && all[status] == 0.0).then_some(numbers);
    [found(1, all[4..10 + joints].to_vec()), found(2, row)]
}
