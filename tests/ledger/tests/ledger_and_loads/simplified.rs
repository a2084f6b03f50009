//! The simplified model against the coupled one: what it leaves out, by order of the imbalance.
//!
//! With `s` the scale of `d`, `J_12` and `J_13`, the coupled equations are
//! `(M_0 + s M_1 + ..) q'' = h_0 + s h_1 + ..`, and the simplified model has
//! `M_0 q'' = h_0 + s h_W`, with `h_W` the part of `h_1` in the square of the wheel's rate. Where
//! nothing but the wheel moves and nothing drives, `h_0 = 0` and `h_1 = h_W`: the disturbances
//! agree to first order and differ to second. Where the hub or a gimbal turns, `h_1` has products
//! of its rate with the wheel's; where a motor drives, `M_1 q_0''` is of first order: what is left
//! out is then as large as the disturbance, but for the ratio of those rates.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::Kind;
use precess_dynamics::{
    Accelerations, Dgcmg, Dgvscmg, Each, Hub, HubMode, Imbalance, ImbalanceModel, Inputs,
    JointStates, LoadAxes, Mode, Passive, ReactionWheel, Sgcmg, Spacecraft, State, Vscmg,
};

use super::bounds::LIMIT;
use super::draw::Drawn;
use super::random::{Random, SEED};

/// Allowed off a slope: at these scales the next order is a hundredth of the one compared.
const SLOPE: f64 = 0.1;
const SCALES: u32 = 7;
const SPIN: f64 = 300.0;
/// A wheel as slow as everything else: what is left out then is larger than the second order, which
/// grows with the square of this.
const SLOW: f64 = 3.0;
/// At scale one: a centre a few tenths of a millimetre off in a wheel of 4 kg.
const SHEET: Imbalance = Imbalance { u_s: 1e-3, u_d: 1e-4, phase: 0.9 };

trait OffBalance: Drawn {
    fn scaled(&self, scale: f64, model: ImbalanceModel) -> Self;
}

macro_rules! off_balance {
    ($($kind:ident)*) => {$(
        impl OffBalance for $kind {
            fn scaled(&self, scale: f64, model: ImbalanceModel) -> Self {
                let Imbalance { u_s, u_d, phase } = SHEET;
                let sheet = Imbalance { u_s: u_s * scale, u_d: u_d * scale, phase };
                // Springs and friction would be a drive of their own.
                let passive = <Self as Kind>::all(Passive::none());
                // A wheel in which this imbalance is small.
                let i_w_wc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.011, 0.012));
                let wheel = Self { m_w: 4.0, i_w_wc, ..*self };
                let made = wheel.with_imbalance(&sheet).expect("an imbalance");
                Self { model, passive, ..made }
            }
        }
    )*};
}

off_balance!(ReactionWheel Sgcmg Vscmg Dgcmg Dgvscmg);

type Change<K> = fn(&mut State<K>, &mut Inputs<K>);

/// The wheel at constant speed, gimbals free and at rest; then a change.
fn situation<K: OffBalance>(
    seed: u64,
    spin: f64,
    change: Change<K>,
) -> (K, Hub, State<K>, Inputs<K>) {
    let random = &mut Random::new(seed);
    let hub = Hub { m_b: 50.0, r_bc_b: random.vector(0.2), i_b_bc: random.block(50.0) };
    let device = <K as Drawn>::drawn(random, 10.0);
    let (mut state, mut inputs): (State<K>, Inputs<K>) = (State::at_rest(), Inputs::none());
    let joints = state.devices.states_mut().zip(inputs.modes.values_mut());
    for (([coordinate, rate], mode), info) in joints.zip(K::JOINTS) {
        *coordinate = random.within(-3.0, 3.0);
        if info.tip {
            (*rate, *mode) = (spin, Mode::Prescribed(0.0));
        }
    }
    change(&mut state, &mut inputs);
    (device, hub, state, inputs)
}

/// Hub and joints in one list; joint accelerations with them.
fn numbers<K: OffBalance>(found: &Accelerations<K>) -> Vec<f64> {
    let hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
    hub.chain(found.devices.values()).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Slopes over the scales 1, 1/2, .. 1/64 of the coupled disturbance, the lumped one, and of their
/// difference; with the sizes at scale one.
fn slopes<K: OffBalance>(
    seed: u64,
    spin: f64,
    change: Change<K>,
    quantity: impl Fn(&Spacecraft<K>, &State<K>, &Inputs<K>) -> Vec<f64>,
) -> [[f64; 2]; 3] {
    let (device, hub, state, inputs) = situation::<K>(seed, spin, change);
    let with = |scale, model| {
        let craft = Spacecraft::new(&hub, &device.scaled(scale, model)).expect("valid parameters");
        quantity(&craft, &state, &inputs)
    };
    let still = with(0.0, ImbalanceModel::Coupled);
    let mut curves: [Vec<f64>; 3] = Default::default();
    for halvings in 0..SCALES {
        let scale = 0.5_f64.powi(halvings.cast_signed());
        let coupled = with(scale, ImbalanceModel::Coupled);
        let lumped = with(scale, ImbalanceModel::Lumped);
        curves[0].push(distance(&coupled, &still));
        curves[1].push(distance(&lumped, &still));
        curves[2].push(distance(&coupled, &lumped));
    }
    curves.map(|curve| {
        let (first, last) = (curve[0], curve[curve.len() - 1]);
        [libm::log2(first / last) / f64::from(SCALES - 1), first]
    })
}

fn accelerations<K: OffBalance>(
    craft: &Spacecraft<K>,
    state: &State<K>,
    inputs: &Inputs<K>,
) -> Vec<f64> {
    numbers(&craft.accelerations(state, inputs).expect("a solution"))
}

/// Holds both models to slope one, and their difference to another.
fn hold(what: &str, seed: u64, found: [[f64; 2]; 3], of_difference: f64) {
    let [coupled, lumped, difference] = found;
    for (slope, expected) in [(coupled[0], 1.0), (lumped[0], 1.0), (difference[0], of_difference)] {
        assert!((slope - expected).abs() <= SLOPE, "{what}, seed {seed:#x}: {found:?}");
    }
    assert!(difference[1] > 0.0);
}

/// All kinds with a wheel that can be off balance, some spacecraft of each.
macro_rules! all_kinds {
    ($check:ident $(, $argument:expr)*) => {
        for seed in SEED..SEED + 10 {
            $check::<ReactionWheel>(seed $(, $argument)*);
            $check::<Sgcmg>(seed $(, $argument)*);
            $check::<Vscmg>(seed $(, $argument)*);
            $check::<Dgcmg>(seed $(, $argument)*);
            $check::<Dgvscmg>(seed $(, $argument)*);
        }
    };
}

#[test]
fn from_rest_the_models_differ_to_second_order() {
    fn check<K: OffBalance>(seed: u64) {
        hold("from rest", seed, slopes::<K>(seed, SPIN, |_, _| (), accelerations), 2.0);
    }
    all_kinds!(check);
}

#[test]
fn with_the_hub_turning_they_differ_to_first_order() {
    fn check<K: OffBalance>(seed: u64) {
        let turning: Change<K> = |state, _| state.omega = Vector3::new(0.3, -0.5, 0.4);
        hold("turning", seed, slopes(seed, SLOW, turning, accelerations), 1.0);
    }
    all_kinds!(check);
}

/// A motor on the wheel, or on the first gimbal where the wheel has none.
#[test]
fn with_a_motor_on_they_differ_to_first_order() {
    fn check<K: OffBalance>(seed: u64) {
        let driven: Change<K> = |_, inputs| {
            let tip = inputs.modes.values_mut().zip(K::JOINTS).last();
            if let Some((mode, info)) = tip.filter(|(_, info)| info.driven) {
                assert!(info.tip);
                *mode = Mode::Driven;
            }
            inputs.motors.values_mut().for_each(|torque| *torque = 5.0);
        };
        hold("motor", seed, slopes(seed, SLOW, driven, accelerations), 1.0);
    }
    all_kinds!(check);
}

#[test]
fn with_gimbals_turning_they_differ_to_first_order() {
    fn check<K: OffBalance>(seed: u64) {
        let turning: Change<K> = |state, _| {
            for ([_, rate], info) in state.devices.states_mut().zip(K::JOINTS) {
                if !info.tip {
                    *rate = 0.5;
                }
            }
        };
        hold("gimbals", seed, slopes(seed, SLOW, turning, accelerations), 1.0);
    }
    for seed in SEED..SEED + 10 {
        check::<Sgcmg>(seed);
        check::<Vscmg>(seed);
        check::<Dgcmg>(seed);
        check::<Dgvscmg>(seed);
    }
}

/// A tenth of a second of free flight, five turns of the wheel: hub and gimbals start to move by
/// the disturbance only, so that all that differs is still of second order.
#[test]
fn from_rest_trajectories_differ_to_second_order() {
    fn check<K: OffBalance>(seed: u64) {
        let flown = slopes::<K>(
            seed,
            SPIN,
            |_, _| (),
            |craft, state, inputs| {
                let fly = |state: State<K>, _| craft.step(&state, inputs, 1e-3).expect("a step");
                let state = (0..100).fold(*state, fly);
                let hub = state.omega.iter().chain(&state.r_b_n_dot).copied();
                hub.chain(state.devices.states().map(|[_, rate]| rate)).collect()
            },
        );
        hold("flown", seed, flown, 2.0);
    }
    all_kinds!(check);
}

/// Nothing but the wheel moves, whatever the imbalance: the load on the table is the same.
#[test]
fn blocked_the_models_are_the_same() {
    fn check<K: OffBalance>(seed: u64) {
        let blocked: Change<K> = |_, inputs| {
            inputs.hub = HubMode::Fixed;
            for (mode, info) in inputs.modes.values_mut().zip(K::JOINTS) {
                if !info.tip {
                    *mode = Mode::Locked;
                }
            }
        };
        let (device, hub, state, inputs) = situation::<K>(seed, SPIN, blocked);
        let [coupled, lumped] = [ImbalanceModel::Coupled, ImbalanceModel::Lumped].map(|model| {
            let craft =
                Spacecraft::new(&hub, &device.scaled(1.0, model)).expect("valid parameters");
            let found = craft.accelerations(&state, &inputs).expect("a solution");
            let axes = LoadAxes::Hub;
            craft.loads(&state, &inputs, &found, axes).expect("loads").hub
        });
        let off = coupled.minus(&lumped);
        assert!(off.force.norm() <= LIMIT * lumped.force.norm(), "seed {seed:#x}: {off:?}");
        // Arms of up to ten metres make the moment that of the force.
        let unit = lumped.moment.norm() + lumped.force.norm();
        assert!(off.moment.norm() <= LIMIT * unit, "seed {seed:#x}: {off:?}");
    }
    all_kinds!(check);
}
