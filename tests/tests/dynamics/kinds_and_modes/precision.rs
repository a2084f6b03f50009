//! A mixed set in single, double and twofold precision.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    BalancedDgvscmg, HingedPanel, Hub, Inputs, Passive, ReactionWheel, Scalar, Sgcmg, SloshMass,
    Spacecraft, State, hinged_panel, slosh_mass,
};
use precess_tests::double_double::DoubleDouble;

use super::case::Solution;
use super::random::{Random, errors_of};

/// Largest difference of `f32` from `f64` over Table 1's ranges, of the block: `2^-23` times
/// conditioning.
const SINGLE_PRECISION: f64 = 1e-4;

/// Largest error of `f64` against a reference in higher precision, of the block.
const DOUBLE_WORST: f64 = 1e-11;

/// Largest median of that error.
const DOUBLE_MEDIAN: f64 = 1e-13;

const SEEDS: u64 = 300;

type Set<T> = ([ReactionWheel<T>; 2], Sgcmg<T>, BalancedDgvscmg<T>, (HingedPanel<T>, SloshMass<T>));

/// A number that `f32` has too, so that both precisions solve the same spacecraft.
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what is wanted")]
fn exact<T: Scalar>(x: f64) -> T {
    T::from_f64(f64::from(x as f32))
}

fn vector<T: Scalar>(x: f64, y: f64, z: f64) -> Vector3<T> {
    Vector3::new(exact(x), exact(y), exact(z))
}

fn diagonal<T: Scalar>(x: f64, y: f64, z: f64) -> Matrix3<T> {
    let o = exact(0.0);
    Matrix3::new(exact(x), o, o, o, exact(y), o, o, o, exact(z))
}

/// Hub and wheels of Table 1, with a panel and a slosh mass.
fn set<T: Scalar>() -> (Hub<T>, Set<T>) {
    let hub = Hub {
        m_b: exact(800.0),
        r_bc_b: vector(0.02, -0.01, 0.03),
        i_b_bc: diagonal(900.0, 800.0, 600.0),
    };
    let (mass, disc) = (exact(4.0), diagonal(0.2, 0.1, 0.1));
    let wheel = ReactionWheel { d: exact(0.08e-3), ..ReactionWheel::bare_wheel(mass, disc) };
    let first = ReactionWheel { r_w_b: vector(0.3, 0.0, 0.0), ..wheel };
    let (o, one) = (exact::<T>(0.0), exact::<T>(1.0));
    let mount = Matrix3::new(o, o, one, one, o, o, o, one, o);
    let second = ReactionWheel { mount, r_w_b: vector(0.0, 0.3, 0.1), ..wheel };
    let sgcmg = Sgcmg {
        r_g_b: vector(-0.3, 0.0, 0.2),
        m_g: exact(1.0),
        i_g_gc: diagonal(0.05, 0.05, 0.05),
        l_g: vector(0.01, 0.0, 0.02),
        ..Sgcmg::bare_wheel(mass, disc)
    };
    let double = BalancedDgvscmg {
        mount,
        r_go_b: vector(0.0, -0.3, 0.0),
        m_go: exact(1.0),
        i_go_goc: diagonal(0.08, 0.08, 0.08),
        m_gi: exact(1.0),
        i_gi_gic: diagonal(0.05, 0.05, 0.05),
        ..BalancedDgvscmg::bare_wheel(mass, exact(0.2), exact(0.1))
    };
    let panel = HingedPanel {
        r_p_b: vector(0.0, 1.0, 0.0),
        r_pc_p: vector(0.0, 0.5, 0.0),
        passive: hinged_panel::PerJoint::all(Passive::spring(exact(20.0), exact(0.1))),
        ..HingedPanel::bare_panel(exact(10.0), diagonal(2.0, 0.5, 2.0))
    };
    let slosh = SloshMass {
        r_s_b: vector(0.0, 0.0, -0.5),
        passive: slosh_mass::PerJoint::all(Passive::spring(exact(5.0), exact(0.5))),
        ..SloshMass::bare_slosh_mass(exact(20.0))
    };
    (hub, ([first, second], sgcmg, double, (panel, slosh)))
}

fn solved<T: Scalar>(random: &mut Random) -> Solution {
    let (hub, devices) = set::<T>();
    let craft = Spacecraft::new(&hub, &devices).expect("valid");
    let mut state = State::<Set<T>>::at_rest();
    let mut within = |size: f64| random.within(-size, size);
    state.omega = vector(within(0.05), within(0.05), within(0.05));
    for ([coordinate, rate], (_, info)) in state.devices.states_mut().zip(craft.joints()) {
        let [q, fastest] = match info.coordinate {
            "theta" => [3.0, 200.0],
            "x" => [0.05, 0.05],
            "phi" => [0.1, 0.1],
            _ => [3.0, 1.0],
        };
        (*coordinate, *rate) = (exact(within(q)), exact(within(fastest)));
    }
    let mut inputs = Inputs::<Set<T>>::none();
    inputs.motors.values_mut().for_each(|motor| *motor = exact(within(0.25)));
    let found = craft.accelerations(&state, &inputs).expect("regular");
    let wide = |v: &Vector3<T>| Vector3::from_fn(|k, _| v[k].to_f64());
    let names = craft.joints().map(|(_, info)| info.coordinate);
    Solution {
        r_b_n_ddot: wide(&found.r_b_n_ddot),
        omega_dot: wide(&found.omega_dot),
        joints: names.zip(found.devices.values().map(Scalar::to_f64)).collect(),
    }
}

#[test]
fn mixed_set_in_double_precision_is_that_in_twofold() {
    let errors = errors_of(SEEDS, |random: &mut Random| {
        let expected = solved::<DoubleDouble>(&mut random.clone());
        solved::<f64>(random).error(&expected)
    });
    errors.are_within(DOUBLE_WORST);
    errors.have_median_within(DOUBLE_MEDIAN);
}

#[test]
fn mixed_set_in_single_precision_is_that_in_double() {
    let error = |random: &mut Random| {
        let expected = solved::<f64>(&mut random.clone());
        solved::<f32>(random).error(&expected)
    };
    errors_of(SEEDS, error).are_within(SINGLE_PRECISION);
}
