//! Loads: Newton and Euler of every body by differences of its place in double-double, action and
//! reaction with the structure, the axes in which they are expressed.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    Accelerations, Attitude, DeviceLoads, Flexible, Gravity, ListedModes, LoadAxes, Loads, Real,
    Scalar, Wrench,
};
use precess_tests::bounds::LIMITS;
use precess_tests::double_double::DoubleDouble as DD;
use precess_tests::newton_euler::vector::{Tensor, Vector, cross, dot};

use crate::craft::{Case, Mixed, ON_MOUNT, SEED, Size};
use crate::reference::{bodies, dd, exponential, poses, tensor, vector};

/// Step of the differences of fourth order: with rates of 20 rad/s their truncation is 1e-15.
const STEP: f64 = 3e-6;

/// A force and a moment, or a magnitude of each.
type Pair<T> = [T; 2];

/// Of one device: wrench at its mount, wrenches of its joints, motor torques.
struct OfDevice {
    mount: Wrench,
    joints: Vec<Wrench>,
    motors: Vec<f64>,
}

fn of_device<W: Each<Wrench>, U: Each<f64>, P>(loads: &DeviceLoads<W, U, P, f64>) -> OfDevice {
    let (joints, motors) = (loads.joints.values().collect(), loads.motors.values().collect());
    OfDevice { mount: loads.mount, joints, motors }
}

fn of_devices(loads: &Loads<Mixed, Flexible<ListedModes>>) -> [OfDevice; 4] {
    let (a, b, c, d) = &loads.devices;
    [of_device(a), of_device(b), of_device(c), of_device(d)]
}

fn case(seed: u64, contained: bool) -> Case {
    let modes = usize::try_from(1 + seed % 9).unwrap();
    let size = Size { modes, contained, rotation: 0.2, free: false };
    let mut case = Case::new(seed, size);
    case.state.r_b_n = Vector3::new(6.0, -5.0, 7.0);
    case.inputs.gravity = match seed % 3 {
        0 => Gravity::None,
        1 => Gravity::Uniform(Vector3::new(0.4, -0.3, 9.0)),
        _ => Gravity::Central { mu: 900.0 },
    };
    case
}

fn found(case: &Case) -> Accelerations<Mixed, Flexible<ListedModes>> {
    case.craft.accelerations(&case.state, &case.inputs).expect("a solution")
}

/// Place, axes and joint origin of every body of the devices in N, a time after the state, to second
/// order with the accelerations found.
fn at_time(
    case: &Case,
    found: &Accelerations<Mixed, Flexible<ListedModes>>,
    time: f64,
) -> Vec<[Vector<DD>; 5]> {
    let (t, half) = (dd(time), dd(0.5 * time) * dd(time));
    let rigid = &case.state;
    let bn = tensor(&rigid.attitude.dcm());
    let modes =
        case.state.modal.eta.iter().zip(&case.state.modal.eta_dot).zip(&found.modal.eta_ddot);
    let modes = modes.map(|((eta, rate), a)| dd(*eta) + dd(*rate) * t + dd(*a) * half);
    let joints = rigid.devices.states().zip(found.devices.values());
    let joints = joints.map(|([q, rate], a)| dd(q) + dd(rate) * t + dd(a) * half);
    let x: Vec<DD> = modes.chain(joints).collect();
    // The angular velocity of exp(tilde(w t + ½ w' t²)) is w + w' t to first order.
    let turn = exponential(vector(&rigid.omega) * t + vector(&found.omega_dot) * half);
    let axes = bn.transpose() * turn;
    let a = bn.transpose() * vector(&found.r_b_n_ddot);
    let r = vector(&rigid.r_b_n) + vector(&rigid.r_b_n_dot) * t + a * half;
    let links: usize = case.chains.iter().map(|chain| chain.links.len()).sum();
    let poses = poses(case, &x).into_iter().take(links);
    poses
        .map(|pose| {
            let own = axes * pose.axes;
            let column = |k| own.column(k);
            [r + axes * pose.at, column(0), column(1), column(2), r + axes * pose.origin]
        })
        .collect()
}

/// What each body needs in N: force, and moment about its centre of mass; less gravity.
fn needs(
    case: &Case,
    found: &Accelerations<Mixed, Flexible<ListedModes>>,
) -> Vec<Pair<Vector<DD>>> {
    let now = at_time(case, found, 0.0);
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at_time(case, found, k * STEP));
    let over = (dd(12.0) * dd(STEP)).recip();
    let over_square = (dd(12.0) * dd(STEP) * dd(STEP)).recip();
    let field = |r: Vector<DD>| match case.inputs.gravity {
        Gravity::None => Vector::zero(),
        Gravity::Uniform(g) => vector(&g),
        Gravity::Central { mu } => {
            // g + G (r - r_B), about B.
            let of = vector(&case.state.r_b_n);
            let square = dot(of, of);
            let per_cube = dd(mu) * (square * square.sqrt()).recip();
            let arm = r - of;
            let along = dot(of, arm) * dd(3.0) * square.recip();
            (of * (along - dd(1.0)) - arm) * per_cube
        }
    };
    bodies(case)
        .iter()
        .zip(0..now.len())
        .map(|(body, k)| {
            let first = |i: usize| (a[k][i] - d[k][i] + (c[k][i] - b[k][i]) * dd(8.0)) * over;
            let second = |i: usize| {
                let near = (b[k][i] + c[k][i]) * dd(16.0);
                (near - a[k][i] - d[k][i] - now[k][i] * dd(30.0)) * over_square
            };
            let force = (second(0) - field(now[k][0])) * body.mass;
            let axes = Tensor::of_columns([now[k][1], now[k][2], now[k][3]]);
            // e' = w x e and e'' = w' x e + w x (w x e): sums over the axes of e x e' and e x e''.
            let sum = |of: &dyn Fn(usize) -> Vector<DD>| {
                (1..4).fold(Vector::zero(), |sum, i| sum + cross(now[k][i], of(i))) * dd(0.5)
            };
            let (omega, alpha) = (sum(&first), sum(&second));
            let inertia = body.inertia.resolved_from(axes);
            let mut moment = inertia * alpha + cross(omega, inertia * omega);
            if let Gravity::Central { mu } = case.inputs.gravity {
                let of = vector(&case.state.r_b_n);
                let square = dot(of, of);
                let size = dd(3.0 * mu) * (square * square * square.sqrt()).recip();
                moment = moment - cross(of, inertia * of) * size;
            }
            [force, moment]
        })
        .collect()
}

/// Loads of all joints in N about their origins, and the sum of the magnitudes of their terms.
fn expected(
    case: &Case,
    found: &Accelerations<Mixed, Flexible<ListedModes>>,
) -> Vec<Vec<(Pair<Vector3<f64>>, f64)>> {
    let (needs, now) = (needs(case, found), at_time(case, found, 0.0));
    let mut first = 0;
    let chains = case.chains.iter().map(|chain| {
        let bodies = first..first + chain.links.len();
        first = bodies.end;
        let joint = |joint: usize| {
            let mut sums = [Vector::zero(); 2];
            let mut size = 0.0;
            for body in joint..bodies.end {
                let [force, moment] = needs[body];
                let arm = now[body][0] - now[joint][4];
                let moment = moment + cross(arm, force);
                sums = [sums[0] + force, sums[1] + moment];
                size += force.norm().to_f64() + moment.norm().to_f64();
            }
            (sums.map(|sum| sum.to_nalgebra().map(Scalar::to_f64)), size)
        };
        bodies.clone().map(joint).collect()
    });
    chains.collect()
}

#[test]
fn loads_are_newton_and_euler_of_every_body() {
    let mut worst = 0.0_f64;
    for seed in SEED + 900..SEED + 912 {
        let case = case(seed, seed % 2 == 1);
        let found = found(&case);
        let expected = expected(&case, &found);
        let loads = |axes| case.craft.loads(&case.state, &case.inputs, &found, axes).unwrap();
        let of_n = of_devices(&loads(LoadAxes::Inertial));
        let of_b = of_devices(&loads(LoadAxes::Hub));
        let of_bodies = of_devices(&loads(LoadAxes::Body));
        let bn = case.state.attitude.dcm();
        let mut states = case.state.devices.states();
        for (device, joints) in expected.iter().enumerate() {
            for (k, ([force, moment], size)) in joints.iter().enumerate() {
                let load = of_n[device].joints[k];
                let off = (load.force - force).norm().max((load.moment - moment).norm());
                worst = worst.max(off / size);
                assert!(off <= LIMITS * size, "seed {seed:#x}, {device}.{k}: {off:e} of {size:e}");
                let in_b = of_b[device].joints[k];
                let off = (in_b.force - bn * force).norm() + (in_b.moment - bn * moment).norm();
                assert!(off <= LIMITS * size, "seed {seed:#x}, {device}.{k}: expressed in B");
                // The motor's part of the load along the joint, less spring and damper.
                let info = case.chains[device].links[k].info;
                let own = of_bodies[device].joints[k];
                let along = if info.slides { own.force } else { own.moment }[info.axis];
                let [q, rate] = states.next().unwrap();
                let motor = along + 3.0 * (q - 0.1) + 0.2 * rate;
                let off = (of_bodies[device].motors[k] - motor).abs();
                assert!(off <= LIMITS * size.max(1.0), "seed {seed:#x}, {device}.{k}: motor");
            }
            // About the device's place, which turns with the mount, and not where it slid to.
            let ([force, moment], size) = joints[0];
            let point =
                &case.modes.mounts[[ON_MOUNT.0, ON_MOUNT.1, ON_MOUNT.2, ON_MOUNT.3][device]];
            let axes = case.craft.point_motion(&point.point, &case.state).unwrap().axes;
            let slid = axes * (first_joint(&case, device) - place(&case, device));
            let moment = moment + (bn.transpose() * slid).cross(&force);
            let size = size * (1.0 + slid.norm());
            let mount = of_n[device].mount;
            assert!((mount.force - force).norm() <= LIMITS * size);
            assert!((mount.moment - moment).norm() <= LIMITS * size);
            // In B, whatever the axes of the joints' loads.
            for own in [of_bodies[device].mount, of_b[device].mount] {
                assert!((own.force - bn * force).norm() <= LIMITS * size);
                assert!((own.moment - bn * moment).norm() <= LIMITS * size);
            }
        }
    }
    println!("worst {worst:.1e}");
}

/// Place of a device in the frame of the mount: the origin of its first joint at coordinate zero.
fn place(case: &Case, device: usize) -> Vector3<f64> {
    Vector3::from(case.chains[device].links[0].origin)
}

/// Place of the first joint in the frame of the mount, the structure undeformed.
fn first_joint(case: &Case, device: usize) -> Vector3<f64> {
    let chain = &case.chains[device];
    let link = &chain.links[0];
    let states: Vec<_> = case.state.devices.states().collect();
    let before: usize = case.chains[..device].iter().map(|chain| chain.links.len()).sum();
    let origin = Vector3::from(link.origin);
    if link.info.slides {
        origin + chain.axes * Vector3::ith(link.info.axis, 1.0) * states[before][0]
    } else {
        origin
    }
}

/// The devices' loads, turned around, are the forces on the structure: with them (F4) holds for the
/// structure by itself, hub and modes. Nothing of the devices but their loads enters.
#[test]
fn structure_moves_as_the_reactions_of_the_devices_make_it() {
    let mut worst = 0.0_f64;
    for seed in (SEED + 920..SEED + 940).filter(|seed| seed % 3 != 2) {
        let case = case(seed, false);
        let found = found(&case);
        let loads =
            case.craft.loads(&case.state, &case.inputs, &found, LoadAxes::Body).expect("finite");
        let rigid = &case.state;
        let bn = rigid.attitude.dcm();
        let gravity = match case.inputs.gravity {
            Gravity::Uniform(g) => bn * g,
            _ => Vector3::zeros(),
        };
        let (a, alpha) = (found.r_b_n_ddot - gravity, found.omega_dot);
        let (omega, modes) = (rigid.omega, &case.modes);
        let sum = |shapes: &[Vector3<f64>], numbers: &[f64]| {
            shapes.iter().zip(numbers).fold(Vector3::zeros(), |sum, (shape, x)| sum + shape * *x)
        };
        let (m, c) = (case.hub.m_b, case.hub.r_bc_b);
        let s = c * m + sum(&modes.linear, &case.state.modal.eta);
        let (p, h) = (
            sum(&modes.linear, &case.state.modal.eta_dot),
            sum(&modes.angular, &case.state.modal.eta_dot),
        );
        let inertia =
            case.hub.i_b_bc + (Matrix3::identity() * c.norm_squared() - c * c.transpose()) * m;
        let force = a * m
            + alpha.cross(&s)
            + sum(&modes.linear, &found.modal.eta_ddot)
            + omega.cross(&omega.cross(&s))
            + omega.cross(&p) * 2.0;
        let moment = s.cross(&a)
            + inertia * alpha
            + sum(&modes.angular, &found.modal.eta_ddot)
            + omega.cross(&(inertia * omega))
            + omega.cross(&h);
        let mut off = [force - case.inputs.force, moment - case.inputs.torque_b];
        let mut modal: Vec<f64> = (0..modes.frequencies.len())
            .map(|i| {
                let (w, zeta) = (modes.frequencies[i], modes.damping[i]);
                let own = found.modal.eta_ddot[i]
                    + w * w * case.state.modal.eta[i]
                    + 2.0 * zeta * w * case.state.modal.eta_dot[i];
                modes.linear[i].dot(&a) + modes.angular[i].dot(&alpha) + own
                    - case.inputs.modal.forces[i]
            })
            .collect();
        let mut sizes = [force.norm(), moment.norm()];
        for (k, mount) in modes.mounts.iter().enumerate() {
            let motion = case.craft.point_motion(&mount.point, &case.state).unwrap();
            // Sum of the devices about the mount, in B.
            let mut total = Wrench::none();
            for (device, of) in of_devices(&loads).iter().enumerate() {
                if case.chains[device].mount == k {
                    let arm = place(&case, device) - mount.point.position;
                    total = total.plus(&of.mount.moved(&(motion.axes * arm)));
                }
            }
            let scale = total.force.norm() * 3.0 + total.moment.norm();
            let off_force = (total.force - loads.modal.mounts[k].force).norm();
            let off_moment = (total.moment - loads.modal.mounts[k].moment).norm();
            assert!(off_force + off_moment <= LIMITS * scale, "seed {seed:#x}, mount {k}");

            let in_mount = |v: Vector3<f64>| motion.axes.transpose() * v;
            let own = Wrench { force: in_mount(total.force), moment: in_mount(total.moment) };
            let net = own.minus(&case.inputs.modal.mounts[k]);
            let (force, moment) = (motion.axes * net.force, motion.axes * net.moment);
            let place = mount.point.position + motion.displacement;
            off = [off[0] + force, off[1] + moment + place.cross(&force)];
            sizes = [sizes[0] + force.norm(), sizes[1] + moment.norm() + 3.0 * force.norm()];
            // Angular velocity in the mount's axes for the rotation vector: the right Jacobian.
            let (t, x) = (motion.rotation, motion.rotation.norm());
            let jacobian = |v: &Vector3<f64>| {
                let (sin, cos) = libm::sincos(x);
                let once = t.cross(v);
                v - once * ((1.0 - cos) / (x * x)) + t.cross(&once) * ((x - sin) / (x * x * x))
            };
            for (i, sum) in modal.iter_mut().enumerate() {
                let rotation = jacobian(&mount.point.rotation[i]);
                *sum += mount.point.translation[i].dot(&force) + rotation.dot(&net.moment);
            }
        }
        for (off, size) in off.iter().zip(sizes) {
            worst = worst.max(off.norm() / size);
            assert!(off.norm() <= LIMITS * size, "seed {seed:#x}: {:e}", off.norm());
        }
        for (i, off) in modal.iter().enumerate() {
            let w = modes.frequencies[i];
            let size =
                (w * w * case.state.modal.eta[i]).abs() + found.modal.eta_ddot[i].abs() + sizes[0];
            worst = worst.max(off.abs() / size);
            assert!(off.abs() <= LIMITS * size, "seed {seed:#x}, mode {i}: {off:e}");
        }
        // What the solver says of it is rounding, too.
        let hub = loads.hub;
        assert!(hub.force.norm() <= LIMITS * sizes[0] && hub.moment.norm() <= LIMITS * sizes[1]);
    }
    println!("worst {worst:.1e}");
}

/// Accelerations that nothing in the inputs makes need forces that are found: with them as inputs
/// the accelerations come back.
#[test]
fn desired_accelerations_come_back_with_the_loads_as_inputs() {
    for seed in SEED + 950..SEED + 959 {
        let mut case = case(seed, seed % 2 == 1);
        let mut desired = found(&case);
        desired.r_b_n_ddot += Vector3::new(0.3, -0.2, 0.5);
        desired.omega_dot += Vector3::new(-0.1, 0.4, 0.2);
        desired.modal.eta_ddot.iter_mut().for_each(|a| *a += 0.7);
        desired.devices.values_mut().for_each(|a| *a += 0.6);
        let loads = case
            .craft
            .loads(&case.state, &case.inputs, &desired, LoadAxes::Parent)
            .expect("finite");
        case.inputs.force += loads.hub.force;
        case.inputs.torque_b += loads.hub.moment;
        for (force, more) in case.inputs.modal.forces.iter_mut().zip(&loads.modal.forces) {
            *force += more;
        }
        let devices = of_devices(&loads);
        let motors = devices.iter().flat_map(|device| device.motors.iter().copied());
        for (motor, torque) in case.inputs.motors.values_mut().zip(motors) {
            *motor = torque;
        }
        let again = found(&case);
        let list = |a: &Accelerations<Mixed, Flexible<ListedModes>>| -> Vec<f64> {
            let hub = a.r_b_n_ddot.iter().chain(&a.omega_dot).copied();
            hub.chain(a.modal.eta_ddot.iter().copied()).chain(a.devices.values()).collect()
        };
        let modes = case.state.modal.eta.len();
        let error = crate::accelerations::block_error(&list(&again), &list(&desired), modes);
        // Accelerations of a joint of little inertia, 1e-2 of the rest, from torques: A2.
        assert!(error <= precess_tests::bounds::ACCELERATIONS_WORST, "seed {seed:#x}: {error:e}");
    }
}
