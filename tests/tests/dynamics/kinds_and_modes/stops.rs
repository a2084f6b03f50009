//! Impulsive stops: momentum is conserved, and the impulses of the brakes dissipate energy.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, Accelerations, Attitude, Dgvscmg, HubMode, Inputs, LoadAxes, Loads, Mode, Quaternion,
    State, Stopped, Wrench,
};
use precess_point_masses::{Body, PointMasses, Rates};

use super::case::{Case, Joint, SEEDS, World, joints, largest};
use super::devices::Drawn;
use super::mixed::{Mixed, chains, drawn};
use super::random::{Random, errors_of};

/// Largest error of energy and momentum, of the kinetic energy and of the sum of the bodies'
/// momenta: a stop has no integrator, so this is rounding.
const ROUNDING: f64 = 1e-12;

/// The mixed set with every other joint locked while it moves; those of the kinds themselves are
/// prescribed.
fn braking(random: &mut Random) -> (Case<Mixed>, PointMasses) {
    let world = World::drawn(random);
    let (devices, settings) = drawn(random, world.hub.m_b);
    let mut settings = settings.concat();
    for joint in settings.iter_mut().filter(|joint| joint.mode == Mode::Driven) {
        if random.bits() & 1 == 0 {
            joint.mode = Mode::Locked;
        }
    }
    let case = world.case(&devices, &settings);
    let masses = PointMasses::of_spacecraft(&world.hub, &case.state, chains(&devices));
    (case, masses)
}

fn stop(case: &Case<Mixed>) -> Stopped<Mixed, Quaternion> {
    case.expect_ok(case.craft.stop(&case.state, &case.inputs))
}

/// Units of momentum: the sums over bodies of the magnitudes of their linear and angular momentum.
pub(crate) fn sizes(masses: &PointMasses) -> [f64; 2] {
    let bodies = masses.bodies(&Rates::none(masses.coordinates.len()));
    let of_body = |body: &Body| {
        let momenta = body.masses().map(|mass| {
            let [r, v, _] = mass.r;
            [v * mass.mass, (masses.r_b_n + r).cross(&v) * mass.mass]
        });
        let [p, h] = momenta.fold([Vector3::zeros(); 2], |[p, h], [q, k]| [p + q, h + k]);
        [p.norm(), h.norm()]
    };
    bodies.iter().map(of_body).fold([0.0; 2], |[p, h], [q, k]| [p + q, h + k])
}

#[test]
fn stop_conserves_linear_and_angular_momentum() {
    let error = |random: &mut Random| {
        let (case, masses) = braking(random);
        let momentum = |state| case.expect_ok(case.craft.momentum(state, About::InertialOrigin));
        let (before, after) = (momentum(&case.state), momentum(&stop(&case).state));
        let [linear, angular] = sizes(&masses);
        largest([
            (after.linear - before.linear).norm() / linear,
            (after.angular - before.angular).norm() / angular,
        ])
    };
    errors_of(SEEDS, error).are_within(ROUNDING);
}

#[test]
fn locked_joints_end_at_rest_prescribed_ones_keep_their_rates_and_nothing_is_displaced() {
    errors_of(SEEDS, |random| {
        let (case, _) = braking(random);
        let after = stop(&case).state;
        let joints = case.state.devices.states().zip(after.devices.states());
        for (([q, before], [same, after]), mode) in joints.zip(case.inputs.modes.values()) {
            assert_eq!(q.to_bits(), same.to_bits());
            match mode {
                Mode::Locked => assert_eq!(after.to_bits(), 0.0_f64.to_bits()),
                Mode::Prescribed(_) => assert_eq!(after, before),
                Mode::Driven => {}
            }
        }
        assert_eq!((after.r_b_n, after.attitude), (case.state.r_b_n, case.state.attitude));
        0.0
    })
    .are_within(0.0);
}

/// The impulses at the joints that velocities jump by: the motors that the jumps would need as
/// accelerations from rest, less those that rest needs against its springs.
fn impulses(case: &Case<Mixed>, after: &State<Mixed>) -> (Vec<f64>, Wrench) {
    let before = &case.state;
    let mut still = *before;
    (still.r_b_n_dot, still.omega) = (Vector3::zeros(), Vector3::zeros());
    still.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
    // Accelerations of this shape, filled with jumps of the velocities.
    let [mut jumps, mut none] =
        [case.expect_ok(case.craft.accelerations(&still, &Inputs::none())); 2];
    jumps.r_b_n_ddot = still.attitude.dcm() * (after.r_b_n_dot - before.r_b_n_dot);
    jumps.omega_dot = after.omega - before.omega;
    let rates = before.devices.states().zip(after.devices.states());
    for (jump, ([_, before], [_, after])) in jumps.devices.values_mut().zip(rates) {
        *jump = after - before;
    }
    (none.r_b_n_ddot, none.omega_dot) = (Vector3::zeros(), Vector3::zeros());
    none.devices.values_mut().for_each(|jump| *jump = 0.0);
    let loads = |accelerations: &Accelerations<Mixed>| {
        let loads = case.craft.loads(&still, &Inputs::none(), accelerations, LoadAxes::Body);
        let Loads { devices, hub, .. } = case.expect_ok(loads);
        let ([first, second], sgcmg, double, (panel, slosh)) = devices;
        let mut motors: Vec<f64> = first.motors.values().chain(second.motors.values()).collect();
        motors.extend(sgcmg.motors.values().chain(double.motors.values()));
        motors.extend(panel.motors.values().chain(slosh.motors.values()));
        (motors, hub)
    };
    let ((moving, hub), (resting, _)) = (loads(&jumps), loads(&none));
    (moving.iter().zip(&resting).map(|(moving, resting)| moving - resting).collect(), hub)
}

/// An impulse does work at the mean of the rates before and after it.
#[test]
fn energy_lost_is_the_work_of_the_impulses() {
    let error = |random: &mut Random| {
        let (case, masses) = braking(random);
        let Stopped { state: after, energy_lost } = stop(&case);
        let before = case.expect_ok(case.craft.energy(&case.state));
        let (impulses, Wrench { force, moment }) = impulses(&case, &after);
        let rates = case.state.devices.states().zip(after.devices.states());
        let works = impulses
            .iter()
            .zip(rates)
            .map(|(impulse, ([_, from], [_, to]))| -impulse * (from + to) / 2.0);
        let given = case.inputs.modes.values().map(|mode| mode != Mode::Driven);
        let work: f64 = works.zip(given).filter(|(_, given)| *given).map(|(work, _)| work).sum();
        // Nobody outside pushes the hub.
        let [linear, angular] = sizes(&masses);
        largest([
            (work - energy_lost).abs() / before,
            force.norm() / linear,
            moment.norm() / angular,
        ])
    };
    errors_of(SEEDS, error).are_within(ROUNDING);
}

fn gimbals(random: &mut Random) -> Case<[Dgvscmg; 2]> {
    let world = World::drawn(random);
    let devices = [(); 2].map(|()| Dgvscmg::drawn(random, world.hub.m_b));
    let settings = devices.map(|_| joints::<Dgvscmg>(random)).concat();
    world.case(&devices, &settings)
}

#[test]
fn each_stop_of_a_single_joint_loses_energy() {
    errors_of(SEEDS, |random| {
        let case = gimbals(random);
        for joint in 0..6 {
            let mut settings = case.settings();
            settings[joint].mode = Mode::Locked;
            let case = case.with_settings(&settings);
            let stopped = case.expect_ok(case.craft.stop(&case.state, &case.inputs));
            assert!(stopped.energy_lost > 0.0, "joint {joint}, seed {:#x}", case.seed);
        }
        0.0
    })
    .are_within(0.0);
}

#[test]
fn clamping_everything_takes_all_kinetic_energy() {
    errors_of(SEEDS, |random| {
        let case = gimbals(random);
        let lock = |joint: &Joint| Joint { mode: Mode::Locked, ..*joint };
        let settings: Vec<_> = case.settings().iter().map(lock).collect();
        let mut case = case.with_settings(&settings);
        case.inputs.hub = HubMode::Fixed;
        let stopped = case.expect_ok(case.craft.stop(&case.state, &case.inputs));
        assert_eq!(case.craft.energy(&stopped.state), Ok(0.0));
        assert_eq!(case.craft.energy(&case.state), Ok(stopped.energy_lost));
        0.0
    })
    .are_within(0.0);
}
