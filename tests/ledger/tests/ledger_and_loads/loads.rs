//! Loads on free bodies: each body has the acceleration that its joint loads, gravity and external
//! wrenches give it by Newton and Euler, and the hub the one that the reversed mount loads give it.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Attitude, Each, HubMode, LoadAxes, Loads, Mode, Passive, Wrench};
use precess_tests::cases;

use super::bounds::{EPSILONS, SPACECRAFT, Worst};
use super::craft::{Case, Craft, LoadsOfDevice, Mixed, Others};
use super::kinematics::{self, Body, turned};
use super::random::SEED;

const AXES: [LoadAxes; 4] = [LoadAxes::Body, LoadAxes::Parent, LoadAxes::Hub, LoadAxes::Inertial];

fn loads<D: Craft>(case: &Case<D>, axes: LoadAxes) -> Loads<D> {
    let found = case.craft.loads(&case.state, &case.inputs, &case.accelerations(), axes);
    found.unwrap_or_else(|error| panic!("{case}: {error}"))
}

/// The axes in which the load of a body's joint is expressed.
fn axes_of(body: &Body, axes: LoadAxes, nb: &Matrix3<f64>) -> Matrix3<f64> {
    match axes {
        LoadAxes::Body => body.load_axes,
        LoadAxes::Parent => body.parent,
        LoadAxes::Hub => Matrix3::identity(),
        LoadAxes::Inertial => nb.transpose(),
    }
}

/// Newton and Euler of one device's bodies; the largest error, in epsilons of the terms of all
/// bodies from this one outwards.
fn free_bodies(bodies: &[Body], loads: &[Wrench]) -> f64 {
    let mut worst = Worst::default();
    let (mut of_force, mut of_moment) = (0.0, 0.0);
    // From the tip inwards: the load of a joint is as large as all terms outboard of it.
    let mut beyond = None;
    for (body, load) in bodies.iter().zip(loads).rev() {
        let mut felt = load.plus(&body.applied);
        let origin = body.frame.origin;
        if let Some((next, of_next)) = beyond {
            let arm: Vector3<f64> = next - origin;
            felt = felt.minus(&Wrench::moved(of_next, &arm));
            of_moment += of_force * arm.norm();
        }
        let [force, moment] = body.sizes();
        of_force += force + body.applied.force.norm();
        of_moment += moment + body.applied.moment.norm();
        let off = felt.minus(&body.needs());
        for (off, of_terms) in [(off.force, of_force), (off.moment, of_moment)] {
            worst.add(share(off.norm(), f64::EPSILON * of_terms));
        }
        beyond = Some((origin, load));
    }
    worst.0
}

/// Zero where the unit is zero too.
fn share(error: f64, unit: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / unit }
}

#[test]
fn loads_move_every_body_as_it_moves_along_any_axes() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let case = Case::<D>::drawn(seed);
        let devices = kinematics::bodies(&case, &case.accelerations());
        let nb = case.state.attitude.dcm().transpose();
        for axes in AXES {
            let loads = D::loads_of_devices(&loads(&case, axes).devices);
            assert_eq!(loads.len(), devices.len());
            for (bodies, LoadsOfDevice { mount, joints, .. }) in devices.iter().zip(loads) {
                let joints: Vec<_> = bodies
                    .iter()
                    .zip(joints)
                    .map(|(body, load)| turned(&axes_of(body, axes, &nb), &load))
                    .collect();
                let error = free_bodies(bodies, &joints);
                worst.add(error);
                assert!(error <= EPSILONS, "{axes:?}: {error} eps; {case}");

                // The mount's is the first joint's, along N or B axes, about the device's place.
                let along =
                    if axes == LoadAxes::Inertial { nb.transpose() } else { Matrix3::identity() };
                let first = joints[0].moved(&bodies[0].slid);
                let off = turned(&along, &mount).minus(&first);
                let unit = EPSILONS * f64::EPSILON;
                let size = joints[0].moment.norm() + bodies[0].slid.norm() * first.force.norm();
                assert!(off.force.norm() <= unit * joints[0].force.norm(), "{axes:?}; {case}");
                assert!(off.moment.norm() <= unit * size, "{axes:?}; {case}");
            }
        }
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("free bodies: worst {:.2} eps", worst.0);
}

/// The hub as a body of its own: what acts on it are the reversed loads of the mounts, the inputs,
/// gravity and, on a fixed hub, the load of its table.
#[test]
fn reversed_mount_loads_accelerate_the_hub() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let case = Case::<D>::drawn(seed);
        let found = case.accelerations();
        let loads = loads(&case, LoadAxes::Hub);
        let devices = kinematics::bodies(&case, &found);
        let mut acting = Wrench { force: case.inputs.force, moment: case.inputs.torque_b }
            .plus(&kinematics::hub_pull(&case, &devices));
        if case.inputs.hub != HubMode::Free {
            acting = acting.plus(&loads.hub);
        }
        let (mut of_force, mut of_moment) = (acting.force.norm(), acting.moment.norm());
        for (bodies, LoadsOfDevice { mount, .. }) in
            devices.iter().zip(D::loads_of_devices(&loads.devices))
        {
            let place = bodies[0].frame.origin - bodies[0].slid;
            let carried = mount.moved(&place);
            acting = acting.minus(&carried);
            of_force += carried.force.norm();
            of_moment += carried.moment.norm() + place.norm() * carried.force.norm();
        }
        // A free hub needs no further wrench.
        if case.inputs.hub == HubMode::Free {
            let [force, moment] =
                [loads.hub.force.norm() / of_force, loads.hub.moment.norm() / of_moment];
            assert!(force.max(moment) <= EPSILONS * f64::EPSILON, "{force:e}, {moment:e}; {case}");
        }
        // About the centre of mass, and back to B.
        let (m, c, inertia) = (case.hub.m_b, case.hub.r_bc_b, case.hub.i_b_bc);
        let omega = case.state.omega;
        let about_c = acting.moved(&-c).moment - omega.cross(&(inertia * omega));
        let inverse = inertia.try_inverse().expect("a block has an inverse");
        let alpha = inverse * about_c;
        let at_c = acting.force / m;
        let at_b = at_c - alpha.cross(&c) - omega.cross(&omega.cross(&c));
        let of_alpha = inverse.norm() * (of_moment + c.norm() * of_force);
        let of_b = of_force / m + of_alpha * c.norm();
        for (found, expected, unit) in
            [(found.omega_dot, alpha, of_alpha), (found.r_b_n_ddot, at_b, of_b)]
        {
            let error = (found - expected).norm() / unit;
            worst.add(error);
            assert!(
                error <= EPSILONS * f64::EPSILON,
                "{found} is not {expected}: {error:e}; {case}"
            );
        }
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("hub as a free body: worst {:.2e}", worst.0);
}

/// A joint's load about its axis is motor, spring and friction together; a driven joint's motor
/// torque is the input.
#[test]
fn load_about_a_joint_is_motor_spring_and_friction() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let case = Case::<D>::drawn(seed);
        let devices = D::loads_of_devices(&loads(&case, LoadAxes::Hub).devices);
        let found = case.accelerations();
        let mut given = case.inputs.motors.values().zip(case.inputs.modes.values());
        let chains = case.devices.chains();
        let mut states =
            case.joints().into_iter().zip(chains.iter().flat_map(|chain| chain.passives.clone()));
        for (bodies, device) in kinematics::bodies(&case, &found).iter().zip(devices) {
            let (mut of_force, mut of_moment) = (0.0, 0.0);
            let mut errors = Vec::new();
            // The joints' own data, and from the tip inwards what each is a sum of.
            let joints: Vec<_> = given.by_ref().zip(states.by_ref()).take(bodies.len()).collect();
            let loads = bodies.iter().zip(&device.joints).zip(&device.motors);
            let mut beyond = None;
            for (((body, load), motor), joint) in loads.zip(joints).rev() {
                let ((torque, mode), ([q, rate], passive)) = joint;
                let origin = body.frame.origin;
                let arm = beyond.map_or(0.0, |next: Vector3<f64>| (next - origin).norm());
                let [force, moment] = body.sizes();
                of_moment += of_force * arm + moment + body.applied.moment.norm();
                of_force += force + body.applied.force.norm();
                beyond = Some(origin);
                let hat = body.frame.axes.column(body.info.axis).into_owned();
                let (felt, of_load) = if body.info.slides {
                    (load.force.dot(&hat), of_force)
                } else {
                    (load.moment.dot(&hat), of_moment)
                };
                let own = own_torque(&passive, q, rate);
                let unit = of_load + own.abs() + motor.abs();
                errors.push(share((felt - own - motor).abs(), unit));
                if mode == Mode::Driven {
                    errors.push(share((motor - torque).abs(), unit));
                }
            }
            for error in errors {
                worst.add(error / f64::EPSILON);
                assert!(error <= EPSILONS * f64::EPSILON, "{error:e}; {case}");
            }
        }
        assert!(given.next().is_none() && states.next().is_none());
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("motor torques: worst {:.2} eps", worst.0);
}

/// `-k (q - q_0) - c q' - u_c q' / sqrt(q'² + q_c'²)`.
fn own_torque(passive: &Passive, q: f64, rate: f64) -> f64 {
    let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = *passive;
    let dry = if coulomb == 0.0 { 0.0 } else { coulomb * rate / rate.hypot(coulomb_rate) };
    -stiffness * (q - rest) - viscous * rate - dry
}
