//! Loads, energy and momenta of every kind against the sums over point masses.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg,
    DeviceLoads, Dgcmg, Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, Gravity, HingedPanel,
    HubMode, LoadAxes, Mode, ReactionWheel, Sgcmg, SloshMass, Vscmg, Wrench,
};
use precess_point_masses::{Body, Chain, Mass, PointMasses, Rates};

use super::balance::{disturb, pair};
use super::case::{Case, World, joints, largest};
use super::devices::Drawn;
use super::random::{Random, errors_of};

/// Largest error, in units of the sum of the magnitudes of all terms.
const ROUNDING: f64 = 50.0 * f64::EPSILON;

/// Spacecraft per kind; each is checked in four choices of axes.
const SEEDS: u64 = 300;

/// A sum with the sum of the magnitudes of its terms.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sum: Vector3<f64>,
    size: f64,
}

impl Sum {
    fn add(&mut self, term: Vector3<f64>) {
        self.sum += term;
        self.size += term.norm();
    }

    /// Adds a moment, whose rounding is that of its factors also where they are parallel.
    fn add_cross(&mut self, arm: &Vector3<f64>, force: &Vector3<f64>) {
        self.sum += arm.cross(force);
        self.size += arm.norm() * force.norm();
    }

    /// How far a value is off, in units of the terms.
    fn error(&self, found: Vector3<f64>) -> f64 {
        let off = (found - self.sum).norm();
        if off == 0.0 { 0.0 } else { off / self.size }
    }
}

/// Force and moment about a point.
#[derive(Clone, Copy, Debug, Default)]
struct Needed {
    force: Sum,
    moment: Sum,
}

impl Needed {
    /// Error of a wrench that is expressed in other axes.
    fn error(&self, found: &Wrench, axes: &Matrix3<f64>) -> f64 {
        self.force.error(axes * found.force).max(self.moment.error(axes * found.moment))
    }

    fn add(&mut self, arm: Vector3<f64>, force: Vector3<f64>) {
        self.force.add(force);
        self.moment.add_cross(&arm, &force);
    }
}

/// What a joint transmits, about a point: all that the bodies from its own outwards need, less what
/// they have.
fn transmitted(
    bodies: &[Body],
    wrenches: &[Wrench],
    g: Vector3<f64>,
    joint: usize,
    origin: Vector3<f64>,
) -> Needed {
    let chain = bodies[joint + 1].chain;
    // B's own share apart: a mass that falls almost freely has the rounding of both.
    let of_b = bodies[0].frame.origin[2];
    let mut needed = Needed::default();
    let outwards = bodies.iter().skip(1).zip(wrenches).skip(joint);
    for (body, wrench) in outwards.take_while(|(body, _)| body.chain == chain) {
        for Mass { mass, r: [r, _, acceleration] } in body.masses() {
            needed.add(r - origin, of_b * mass);
            needed.add(r - origin, (acceleration - of_b) * mass);
            needed.add(r - origin, g * -mass);
        }
        let arm = body.frame.origin[0] - origin;
        needed.add(arm, body.own * -wrench.force);
        needed.moment.add(body.own * -wrench.moment);
    }
    needed
}

/// The largest error of all loads of a spacecraft, expressed in one choice of axes.
fn error_along<K: Drawn>(case: &Case<[K; 2]>, masses: &PointMasses, axes: LoadAxes) -> f64 {
    let accelerations = case.accelerations();
    let loads = case.craft.loads(&case.state, &case.inputs, &accelerations, axes);
    let loads = case.expect_ok(loads);
    let bodies = masses.bodies(&Rates::of_accelerations(&accelerations));
    let Gravity::Uniform(g) = case.inputs.gravity else { panic!("a uniform field") };
    let g = masses.bn * g;
    let wrenches: Vec<_> = case.inputs.bodies.iter().flat_map(Each::values).collect();
    let passive = masses.passive();
    let inertial = masses.bn.transpose();
    let mut errors = Vec::new();
    for (number, device) in loads.devices.iter().enumerate() {
        let DeviceLoads { mount, joints, motors, .. } = device;
        let settings = joints.values().zip(motors.values()).zip(K::JOINTS);
        for ((found, motor), info) in settings {
            let joint = number * K::JOINTS.len() + info.index;
            let body = &bodies[joint + 1];
            let origin = body.frame.origin[0];
            let needed = transmitted(&bodies, &wrenches, g, joint, origin);
            let along = match axes {
                LoadAxes::Body => body.own,
                LoadAxes::Parent => body.parent,
                LoadAxes::Hub => Matrix3::identity(),
                LoadAxes::Inertial => inertial.transpose(),
            };
            errors.push(needed.error(&found, &along));
            // The motor's part: along the axis, less spring and friction.
            let felt = if info.slides { needed.force } else { needed.moment };
            let axis = body.frame.axes[0].column(info.axis).into_owned();
            let off = (axis.dot(&felt.sum) - passive[joint] - motor).abs();
            errors.push(off / (felt.size + passive[joint].abs()));
            if info.index == 0 {
                let along =
                    if axes == LoadAxes::Inertial { masses.bn } else { Matrix3::identity() };
                // About the device's place, which a sliding joint leaves.
                let [slid, _] = case.state.devices[number].states().next().unwrap_or_default();
                let place = if info.slides { origin - axis * slid } else { origin };
                let needed = transmitted(&bodies, &wrenches, g, joint, place);
                errors.push(needed.error(mount, &along));
            }
        }
    }
    let mut hub = of_hub(case, &bodies, g);
    errors.push(hub.error(&loads.hub, &Matrix3::identity()));
    if case.inputs.hub == HubMode::Free {
        // The expected value is zero: what is computed is rounding of the terms.
        (hub.force.sum, hub.moment.sum) = Default::default();
        errors.push(hub.error(&loads.hub, &Matrix3::identity()));
    }
    largest(errors)
}

/// The wrench that the hub needs in addition to the inputs.
fn of_hub<K: Drawn>(case: &Case<[K; 2]>, bodies: &[Body], g: Vector3<f64>) -> Needed {
    let origin = bodies[0].frame.origin[0];
    let of_b = bodies[0].frame.origin[2];
    let mut all = Needed::default();
    for body in bodies {
        for Mass { mass, r: [r, _, acceleration] } in body.masses() {
            all.add(r - origin, of_b * mass);
            all.add(r - origin, (acceleration - of_b) * mass);
            all.add(r - origin, g * -mass);
        }
    }
    let wrenches = case.inputs.bodies.iter().flat_map(Each::values);
    for (wrench, body) in wrenches.zip(&bodies[1..]) {
        all.add(body.frame.origin[0] - origin, body.own * -wrench.force);
        all.moment.add(body.own * -wrench.moment);
    }
    all.force.add(-case.inputs.force);
    all.moment.add(-case.inputs.torque_b);
    all
}

fn loads_are_those_of_the_masses<K: Drawn>() {
    let error = |random: &mut Random| {
        let (_, case, masses) = pair::<K>(random);
        let all = [LoadAxes::Body, LoadAxes::Parent, LoadAxes::Hub, LoadAxes::Inertial];
        largest(all.map(|axes| error_along(&case, &masses, axes)))
    };
    errors_of(SEEDS, error).are_within(ROUNDING);
}

/// A clamped hub: what the table exerts is in the loads too.
fn loads_of_a_clamped_hub<K: Drawn>() {
    let error = |random: &mut Random| {
        let (world, case, chains) = clamped::<K>(random);
        let masses = PointMasses::of_spacecraft(&world.hub, &case.state, chains);
        let found = case.accelerations();
        assert_eq!(found.r_b_n_ddot, Vector3::zeros());
        assert_eq!(found.omega_dot, Vector3::zeros());
        error_along(&case, &masses, LoadAxes::Body)
    };
    errors_of(SEEDS, error).are_within(ROUNDING);
}

fn clamped<K: Drawn>(random: &mut Random) -> (World, Case<[K; 2]>, Vec<Chain>) {
    let world = World::drawn(random);
    let devices = [(); 2].map(|()| K::sprung(random, world.hub.m_b));
    let settings = devices.map(|_| joints::<K>(random)).concat();
    let mut case = world.case(&devices, &settings);
    disturb(&mut case, random);
    (case.state.r_b_n_dot, case.state.omega) = (Vector3::zeros(), Vector3::zeros());
    case.inputs.hub = HubMode::Fixed;
    let chains = devices.iter().map(Drawn::chain).collect();
    (world, case, chains)
}

/// All computed accelerations, prescribed: loads and motor torques do not change.
fn what_was_found_gives_the_motors_back<K: Drawn>() {
    let error = |random: &mut Random| {
        let (_, case, masses) = pair::<K>(random);
        let found = case.accelerations();
        let Rates { r_b_n_dot: r_b_n_ddot, omega: omega_dot, joints } =
            Rates::of_accelerations(&found);
        let settings: Vec<_> =
            case.settings().iter().zip(joints).map(|(j, a)| j.prescribed(a)).collect();
        // What a kind prescribes by itself is what it already was: zero.
        let mut given = case.with_settings(&settings);
        given.inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot };
        assert_eq!(given.accelerations(), found, "seed {:#x}", case.seed);
        error_along(&given, &masses, LoadAxes::Body).max(motors_off(&case, &given, &masses))
    };
    errors_of(SEEDS, error).are_within(ROUNDING);
}

/// Error of the motor torques of a prescribed motion against those that drove it, in units of what
/// the joints transmit; and the wrench that the hub needs, which should be zero.
fn motors_off<K: Drawn>(case: &Case<[K; 2]>, given: &Case<[K; 2]>, masses: &PointMasses) -> f64 {
    let found = given.accelerations();
    let loads = given.craft.loads(&given.state, &given.inputs, &found, LoadAxes::Body);
    let loads = given.expect_ok(loads);
    let bodies = masses.bodies(&Rates::of_accelerations(&found));
    let Gravity::Uniform(g) = case.inputs.gravity else { panic!("a uniform field") };
    let g = masses.bn * g;
    let wrenches: Vec<_> = case.inputs.bodies.iter().flat_map(Each::values).collect();
    let motors = loads.devices.iter().flat_map(|device| device.motors.values());
    let settings = case.settings();
    let joints = motors.zip(&settings).zip(case.craft.joints()).enumerate();
    let driven = joints.filter(|(_, ((_, joint), _))| joint.mode == Mode::Driven);
    let errors = driven.map(|(number, ((motor, joint), (_, info)))| {
        let Needed { force, moment } =
            transmitted(&bodies, &wrenches, g, number, bodies[number + 1].frame.origin[0]);
        (motor - joint.torque).abs() / if info.slides { force.size } else { moment.size }
    });
    let mut hub = of_hub(case, &bodies, g);
    (hub.force.sum, hub.moment.sum) = Default::default();
    largest(errors.chain([hub.error(&loads.hub, &Matrix3::identity())]))
}

fn sums_are_those_of_the_masses<K: Drawn>() {
    let error = |random: &mut Random| {
        let (_, case, masses) = pair::<K>(random);
        let bodies = masses.bodies(&Rates::none(masses.coordinates.len()));
        let [mut linear, mut angular, mut moment, mut rate] = [Sum::default(); 4];
        let (mut energy, mut multiplied_out, mut total) = (0.0, 0.0, 0.0);
        let [_, v_b, _] = bodies[0].frame.origin;
        let omega = case.state.omega;
        for Mass { mass, r: [r, v, _] } in bodies.iter().flat_map(Body::masses) {
            linear.add(v * mass);
            angular.add_cross(&(masses.r_b_n + r), &(v * mass));
            moment.add(r * mass);
            // Seen from B: less what B itself does.
            rate.add(v * mass);
            rate.add(v_b * -mass);
            rate.add(omega.cross(&r) * -mass);
            energy += v.norm_squared() * mass / 2.0;
            let seen = (v - v_b - omega.cross(&r)).norm();
            let parts = v_b.norm() + omega.norm() * r.norm() + seen;
            multiplied_out += parts * parts * mass / 2.0;
            total += mass;
        }
        let found = case.expect_ok(case.craft.momentum(&case.state, About::InertialOrigin));
        let centre = case.expect_ok(case.craft.centre_of_mass(&case.state));
        let kinetic = case.expect_ok(case.craft.energy(&case.state));
        largest([
            linear.error(masses.bn * found.linear),
            angular.error(masses.bn * found.angular),
            moment.error(centre.c * total),
            rate.error(centre.c_prime * total),
            (kinetic - energy).abs() / multiplied_out,
            (case.craft.mass() - total).abs() / total,
        ])
    };
    errors_of(SEEDS, error).are_within(ROUNDING);
}

macro_rules! every_kind {
    ($($check:ident: $claim:ident;)*) => {$(
        #[test]
        fn $claim() {
            $check::<ReactionWheel>();
            $check::<Vscmg>();
            $check::<Sgcmg>();
            $check::<Dgvscmg>();
            $check::<Dgcmg>();
            $check::<BalancedReactionWheel>();
            $check::<BalancedVscmg>();
            $check::<BalancedSgcmg>();
            $check::<BalancedDgvscmg>();
            $check::<BalancedDgcmg>();
            $check::<HingedPanel>();
            $check::<SloshMass>();
            $check::<FlexibleReactionWheel>();
            $check::<FlexibleVscmg>();
        }
    )*};
}

every_kind! {
    loads_are_those_of_the_masses: every_joint_and_mount_carries_what_the_masses_need;
    loads_of_a_clamped_hub: clamp_exerts_what_the_masses_need;
    what_was_found_gives_the_motors_back: motion_that_was_driven_and_is_given_takes_the_same_motors;
    sums_are_those_of_the_masses: energy_and_momenta_are_those_of_the_masses;
}
