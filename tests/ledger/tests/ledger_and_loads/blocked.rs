//! The blocked-force test: on a table at rest, a wheel at constant speed exerts the
//! rotating force and torque of its data sheet.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, Each, Hub, HubMode, Imbalance, ImbalanceModel, Inputs, JointStates, LoadAxes, Mode,
    ReactionWheel, Sgcmg, Spacecraft, State, Vscmg, Wrench,
};

use super::bounds::Worst;
use super::craft::{Case, Craft, LoadsOfDevice};
use super::draw::Drawn;
use super::kinematics::{self, Frame, turned};
use super::random::{Random, SEED};

/// A dozen roundings of forces of this size.
const READING: f64 = 1e-12;

/// A kind whose wheel can be off balance.
trait OffBalance: Drawn {
    fn with(&self, imbalance: &Imbalance, model: ImbalanceModel) -> Self;
}

macro_rules! off_balance {
    ($($kind:ident)*) => {$(
        impl OffBalance for $kind {
            fn with(&self, imbalance: &Imbalance, model: ImbalanceModel) -> Self {
                Self { model, ..self.with_imbalance(imbalance).expect("an imbalance") }
            }
        }
    )*};
}

off_balance!(ReactionWheel Sgcmg Vscmg Dgcmg Dgvscmg);

/// A wheel at constant speed in gimbals that are locked somewhere, on a hub that is clamped.
fn clamped_case<K: Drawn>(seed: u64, device: K, [theta, spin]: [f64; 2]) -> Case<K> {
    let random = &mut Random::new(seed);
    let hub = Hub { m_b: 50.0, r_bc_b: random.vector(0.5), i_b_bc: random.block(50.0) };
    let craft = Spacecraft::new(&hub, &device).expect("valid parameters");
    let mut state: State<K> = State::at_rest();
    let mut inputs: Inputs<K> = Inputs { hub: HubMode::Fixed, ..Inputs::none() };
    let joints = state.devices.states_mut().zip(inputs.modes.values_mut());
    for (([coordinate, rate], mode), info) in joints.zip(K::JOINTS) {
        if info.tip {
            (*coordinate, *rate, *mode) = (theta, spin, Mode::Prescribed(0.0));
        } else {
            (*coordinate, *mode) = (random.within(-TAU, TAU), Mode::Locked);
        }
    }
    Case { seed, hub, devices: device, craft, state, inputs }
}

/// Wrench on the table about B, wrench on the mount about its origin, and the frame of the wheel.
fn reading<K: Drawn>(case: &Case<K>) -> (Wrench, Wrench, Frame, Vector3<f64>) {
    let found = case.accelerations();
    let loads = case.craft.loads(&case.state, &case.inputs, &found, LoadAxes::Hub);
    let loads = loads.unwrap_or_else(|error| panic!("{case}: {error}"));
    let none = Wrench::none();
    let table = none.minus(&loads.hub);
    let [LoadsOfDevice { mount, .. }] =
        <K as Craft>::loads_of_devices(&loads.devices).try_into().expect("one device");
    let [device] = kinematics::bodies(case, &found).try_into().expect("one device");
    let wheel = device.last().expect("a wheel").frame;
    (table, none.minus(&mount), wheel, device[0].frame.origin)
}

/// Eight phases, both senses, twenty-four angles of a turn.
fn check<K: OffBalance>(model: ImbalanceModel, worst: &mut Worst) {
    for number in 0..8_u32 {
        let seed = SEED + u64::from(number);
        let random = &mut Random::new(seed);
        let sheet = Imbalance {
            u_s: random.log_within(1e-5, 1e-2),
            u_d: random.log_within(1e-6, 1e-3),
            phase: TAU * f64::from(number) / 8.0 + 0.1,
        };
        let device = <K as Drawn>::drawn(random, 100.0).with(&sheet, model);
        for angle in 0..24_u32 {
            let spin = if angle % 2 == 0 { 300.0 } else { -450.0 };
            let case = clamped_case(seed, device, [TAU * f64::from(angle) / 24.0, spin]);
            let (table, mount, wheel, origin) = reading(&case);

            // By the data sheet, through W along the wheel's axes at this angle.
            let square = spin * spin;
            let (sin, cos) = libm::sincos(sheet.phase);
            let stated = Wrench {
                force: Vector3::new(0.0, sheet.u_s, 0.0) * square,
                moment: Vector3::new(0.0, cos, sin) * (sheet.u_d * square),
            };
            let at_w = turned(&wheel.axes, &stated);
            let (of_force, of_torque) = (sheet.u_s * square, sheet.u_d * square);
            for (found, arm) in [(table, wheel.origin), (mount, wheel.origin - origin)] {
                let off = found.minus(&at_w.moved(&arm));
                let force = off.force.norm() / of_force;
                let moment = off.moment.norm() / (of_torque + wheel.origin.norm() * of_force);
                worst.add(force.max(moment));
                assert!(force <= READING && moment <= READING, "{force:e}, {moment:e}; {case}");
            }
        }
    }
}

#[test]
fn still_mount_feels_the_force_and_the_torque_of_the_data_sheet() {
    let mut worst = Worst::default();
    for model in [ImbalanceModel::Coupled, ImbalanceModel::Lumped] {
        check::<ReactionWheel>(model, &mut worst);
        check::<Sgcmg>(model, &mut worst);
        check::<Vscmg>(model, &mut worst);
        check::<Dgcmg>(model, &mut worst);
        check::<Dgvscmg>(model, &mut worst);
    }
    println!("blocked force: worst {:.2e} of it", worst.0);
}

/// The force goes round with the wheel: over a turn its readings have one harmonic, the first, of
/// size `U_s Omega²`, and a torque of `U_d Omega²` that leads it by the phase.
#[test]
fn readings_over_a_turn_have_the_size_and_the_lead_of_the_data_sheet() {
    let sheet = Imbalance { u_s: 3.2e-4, u_d: 1.54e-6, phase: 0.7 };
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.011, 0.011));
    let wheel = ReactionWheel::bare_wheel(4.0, disc).with_imbalance(&sheet).expect("an imbalance");
    let (angles, spin) = (16_u32, 500.0);
    // First harmonics of y and z as cosine and sine of the angle.
    let mut harmonics = [[0.0; 2]; 4];
    for angle in 0..angles {
        let theta = TAU * f64::from(angle) / f64::from(angles);
        let (table, ..) = reading(&clamped_case(SEED, wheel, [theta, spin]));
        let (sin, cos) = libm::sincos(theta);
        let readings = [table.force.y, table.force.z, table.moment.y, table.moment.z];
        for (harmonic, reading) in harmonics.iter_mut().zip(readings) {
            harmonic[0] += reading * cos * 2.0 / f64::from(angles);
            harmonic[1] += reading * sin * 2.0 / f64::from(angles);
        }
        assert_eq!(table.force.x, 0.0);
    }
    let [f_y, f_z, l_y, l_z] = harmonics;
    let square = spin * spin;
    let same = |found: f64, expected: f64, unit: f64| {
        assert!((found - expected).abs() <= READING * unit, "{found} is not {expected}");
    };
    let (of_force, of_torque) = (sheet.u_s * square, sheet.u_d * square);
    let (sin, cos) = libm::sincos(sheet.phase);
    for (found, expected, unit) in [
        (f_y, [1.0, 0.0], of_force),
        (f_z, [0.0, 1.0], of_force),
        (l_y, [cos, -sin], of_torque),
        (l_z, [sin, cos], of_torque),
    ] {
        same(found[0], expected[0] * unit, unit);
        same(found[1], expected[1] * unit, unit);
    }
}

#[test]
fn balanced_wheels_leave_the_table_still() {
    fn check<K: Drawn>() {
        for seed in SEED..SEED + 20 {
            let device = <K as Drawn>::drawn(&mut Random::new(seed), 100.0);
            let case = clamped_case(seed, device, [1.0, 600.0]);
            let (table, mount, ..) = reading(&case);
            let [chain] = device.chains().try_into().expect("one device");
            let rotor = chain.bodies.last().expect("a wheel");
            // Of what a rotor across its axis would give.
            let unit = READING * rotor.inertia[(0, 0)] * 600.0 * 600.0;
            for felt in [table, mount] {
                assert_eq!(felt.force, Vector3::zeros(), "{case}");
                assert!(felt.moment.norm() <= unit, "{}; {case}", felt.moment);
            }
        }
    }
    check::<BalancedReactionWheel>();
    check::<BalancedSgcmg>();
    check::<BalancedVscmg>();
    check::<BalancedDgcmg>();
    check::<BalancedDgvscmg>();
}
