//! Gravity and point forces against textbook formulas.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Attitude, Dgvscmg, Each, Gravity, Hub, HubMode, Inputs, JointStates, Mode, Spacecraft, State,
    Wrench,
};
use precess_tests::cases;

use super::bounds::{LIMIT, SPACECRAFT, Worst};
use super::craft::{Case, Craft, Mixed, Others};
use super::kinematics;
use super::random::SEED;

/// A step of RK4 for a comparison of two runs that take the same steps, s: a wheel turns by 0.6
/// rad.
const STEP: f64 = 1e-3;

/// Every joint locked, and nothing acting but gravity.
fn lock<D: Craft>(case: &mut Case<D>) {
    let joints = case.state.devices.states_mut().zip(case.inputs.modes.values_mut());
    for (([_, rate], mode), info) in joints.zip(D::joint_infos()) {
        *rate = 0.0;
        *mode = if info.driven { Mode::Locked } else { Mode::Prescribed(0.0) };
    }
    let (gravity, modes) = (case.inputs.gravity, case.inputs.modes.clone());
    case.inputs = Inputs { gravity, modes, ..Inputs::none() };
}

/// Hub and locked devices as one rigid body.
fn rigid<D: Craft>(case: &Case<D>) -> Hub {
    let found = case.accelerations();
    let devices = kinematics::bodies(case, &found);
    let bodies = || devices.iter().flatten();
    let Hub { m_b, r_bc_b, i_b_bc } = case.hub;
    let mass = bodies().fold(m_b, |sum, body| sum + body.mass);
    let moment = bodies().fold(r_bc_b * m_b, |sum, body| sum + body.centre * body.mass);
    let centre = moment / mass;
    let about = |inertia: &Matrix3<f64>, mass: f64, position: &Vector3<f64>| {
        let arm = position - centre;
        let square = Matrix3::from_diagonal_element(arm.norm_squared());
        inertia + (square - arm * arm.transpose()) * mass
    };
    let own = about(&i_b_bc, m_b, &r_bc_b);
    let inertia = bodies().fold(own, |sum, b| sum + about(&b.inertia, b.mass, &b.centre));
    Hub { m_b: mass, r_bc_b: centre, i_b_bc: (inertia + inertia.transpose()) * 0.5 }
}

/// All accelerations of joints, to be compared.
fn of_joints<D: Craft>(found: &precess_dynamics::Accelerations<D>) -> Vec<f64> {
    found.devices.values().collect()
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |largest, number| largest.max(number.abs()))
}

#[test]
fn in_a_uniform_field_everything_falls_and_nothing_else_changes() {
    fn check<D: Craft>(seed: u64) {
        let mut case = Case::<D>::drawn(seed);
        case.inputs.hub = HubMode::Free;
        let g = Vector3::new(3.0, -5.0, 7.0);
        case.inputs.gravity = Gravity::None;
        let floating = case.accelerations();
        case.inputs.gravity = Gravity::Uniform(g);
        let falling = case.accelerations();
        let fall = case.state.attitude.dcm() * g;
        let off = falling.r_b_n_ddot - floating.r_b_n_ddot - fall;
        assert!(off.norm() <= LIMIT * (floating.r_b_n_ddot.norm() + fall.norm()), "{case}");
        let off = falling.omega_dot - floating.omega_dot;
        assert!(off.norm() <= LIMIT * floating.omega_dot.norm(), "{case}");
        let (floating, falling) = (of_joints(&floating), of_joints(&falling));
        let off: Vec<_> = floating.iter().zip(&falling).map(|(a, b)| a - b).collect();
        assert!(largest(&off) <= LIMIT * largest(&floating), "{case}");
    }
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed);
        check::<Others>(seed);
    }
}

/// Half a second of it: B falls by `g t² / 2` more, attitude and joints move the same.
#[test]
fn a_falling_run_is_a_floating_run_and_a_fall() {
    let g = Vector3::new(3.0, -5.0, 7.0);
    let mut case = Case::<Mixed>::drawn(SEED + 1);
    // Light wheels under motors and stiff friction want steps of microseconds; not here.
    case.inputs.modes = Inputs::<Mixed>::none().modes;
    for mode in case.inputs.modes.values_mut() {
        *mode = Mode::Prescribed(0.0);
    }
    case.inputs.hub = HubMode::Free;
    let fly = |gravity| {
        let mut case = case.clone();
        case.inputs.gravity = gravity;
        for _ in 0..500 {
            case.state = case.craft.step(&case.state, &case.inputs, STEP).expect("a step");
        }
        case.state
    };
    let (floating, falling) = (fly(Gravity::None), fly(Gravity::Uniform(g)));
    let off = falling.r_b_n - floating.r_b_n - g * 0.125;
    assert!(off.norm() <= LIMIT * floating.r_b_n.norm(), "{off}");
    assert!((falling.omega - floating.omega).norm() <= LIMIT * floating.omega.norm());
    let rates = |state: &State<Mixed>| -> Vec<_> { state.devices.states().flatten().collect() };
    let (floating, falling) = (rates(&floating), rates(&falling));
    let off: Vec<_> = floating.iter().zip(&falling).map(|(a, b)| a - b).collect();
    assert!(largest(&off) <= LIMIT * largest(&floating), "{off:?}");
}

/// `I omega' = 3 mu / R³ n x I n`, with the centre of mass at B and at rest.
fn gradient_turns(hub: &Hub, mu: f64, r: &Vector3<f64>, alpha: &Vector3<f64>, what: &str) -> f64 {
    let (n, far) = (r.normalize(), r.norm());
    let torque = n.cross(&(hub.i_b_bc * n)) * (3.0 * mu / far.powi(3));
    let off = (hub.i_b_bc * alpha - torque).norm() / torque.norm();
    // Bodies that cancel in the first moment do not cancel in its rounding.
    assert!(off <= LIMIT, "{what}: {off:e}");
    off
}

/// The centre of mass is brought to B: the field is expanded about B, and of a body beside it the
/// textbook's torque is the first term of a series in its distance from B over the orbit's.
#[test]
fn gradient_turns_a_rigid_body_as_in_the_textbook_also_one_of_locked_devices() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let mut case = Case::<D>::drawn(seed);
        lock(&mut case);
        case.state.omega = Vector3::zeros();
        let mu = 9.8 * case.state.r_b_n.norm_squared();
        case.inputs.gravity = Gravity::Central { mu };
        let r = case.state.attitude.dcm() * case.state.r_b_n;
        let off_centre = rigid(&case);
        case.hub.r_bc_b -= off_centre.r_bc_b * (off_centre.m_b / case.hub.m_b);
        case.craft = Spacecraft::new(&case.hub, &case.devices).expect("valid parameters");

        let whole = Hub { r_bc_b: Vector3::zeros(), ..rigid(&case) };
        let craft = Spacecraft::<[Dgvscmg; 0]>::new(&whole, &[]).expect("a rigid body");
        let State { r_b_n, r_b_n_dot, attitude, omega, .. } = case.state;
        let state = State { r_b_n, r_b_n_dot, attitude, omega, devices: [], modal: () };
        let inputs = Inputs { gravity: case.inputs.gravity, ..Inputs::none() };
        let jointed = craft.accelerations(&state, &inputs).expect("a solution");
        let locked = case.accelerations();

        worst.add(gradient_turns(&whole, mu, &r, &jointed.omega_dot, &format!("rigid, {case}")));
        worst.add(gradient_turns(&whole, mu, &r, &locked.omega_dot, &format!("locked, {case}")));
        let off = (jointed.r_b_n_ddot - locked.r_b_n_ddot).norm();
        assert!(off <= LIMIT * jointed.r_b_n_ddot.norm(), "{off:e}; {case}");
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("textbook torque: worst {:.1e} of it", worst.0);
}

/// Off its centre of mass, too, a rigid body is the same whatever it is made of.
#[test]
fn locked_devices_are_one_rigid_body_in_a_central_field() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let mut case = Case::<D>::drawn(seed);
        lock(&mut case);
        case.inputs.gravity = Gravity::Central { mu: 9.8 * case.state.r_b_n.norm_squared() };
        let craft = Spacecraft::<[Dgvscmg; 0]>::new(&rigid(&case), &[]).expect("a rigid body");
        let State { r_b_n, r_b_n_dot, attitude, omega, .. } = case.state;
        let state = State { r_b_n, r_b_n_dot, attitude, omega, devices: [], modal: () };
        let inputs = Inputs { gravity: case.inputs.gravity, ..Inputs::none() };
        let jointed = craft.accelerations(&state, &inputs).expect("a solution");
        let locked = case.accelerations();
        for (a, b) in
            [(jointed.r_b_n_ddot, locked.r_b_n_ddot), (jointed.omega_dot, locked.omega_dot)]
        {
            worst.add((a - b).norm() / a.norm());
            assert!((a - b).norm() <= LIMIT * a.norm(), "{a} and {b}; {case}");
        }
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("locked devices as a rigid body: worst {:.1e}", worst.0);
}

/// Far from the centre, where an orbit is, the spacecraft falls as a point does, and the torque of
/// the gradient is a millionth of a millionth of that force times its arm: nothing of it is lost.
#[test]
fn gradient_is_felt_in_a_low_orbit() {
    let (mu, far) = (3.986_004_418e14, 7.0e6);
    let hub = Hub {
        m_b: 500.0,
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(300.0, 200.0, 100.0)),
    };
    let craft = Spacecraft::<[Dgvscmg; 0]>::new(&hub, &[]).expect("a rigid body");
    let n = Vector3::new(2.0, 1.0, 2.0) / 3.0;
    let state = State::<[Dgvscmg; 0]> { r_b_n: n * far, ..State::at_rest() };
    let inputs = Inputs { gravity: Gravity::Central { mu }, ..Inputs::none() };
    let found = craft.accelerations(&state, &inputs).expect("a solution");
    let torque = n.cross(&(hub.i_b_bc * n)) * (3.0 * mu / far.powi(3));
    assert!((hub.i_b_bc * found.omega_dot - torque).norm() <= LIMIT * torque.norm());
    // A point's fall, but for the square of size over distance.
    let fall = n * (-mu / (far * far));
    assert!((found.r_b_n_ddot - fall).norm() <= LIMIT * fall.norm());
}

/// A force at a point of a body is the same as on the hub at that point once the joints are locked,
/// and the same as that force at the joint with its moment.
#[test]
fn point_force_on_a_locked_body_is_one_on_the_hub() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let mut case = Case::<D>::drawn(seed);
        lock(&mut case);
        case.inputs.gravity = Gravity::None;
        let bodies: Vec<_> = kinematics::bodies(&case, &case.accelerations()).concat();
        for (joint, body) in bodies.iter().enumerate() {
            let (point, force) = (Vector3::new(0.3, -0.8, 0.5), Vector3::new(20.0, 30.0, -10.0));
            let with = |wrench: Wrench| {
                let mut all = D::all(Wrench::none());
                *all.values_mut().nth(joint).expect("a joint") = wrench;
                let inputs = Inputs { bodies: Some(all), ..case.inputs.clone() };
                case.craft.accelerations(&case.state, &inputs).expect("a solution")
            };
            let on_body = with(Wrench::at(&point, &force));
            let force_alone = Wrench { force, moment: Vector3::zeros() };
            assert_eq!(with(force_alone.moved(&point)), on_body, "{case}");

            let mut inputs = case.inputs.clone();
            inputs.add_force(
                &(body.frame.origin + body.load_axes * point),
                &(body.load_axes * force),
            );
            let on_hub = case.craft.accelerations(&case.state, &inputs).expect("a solution");
            for (a, b) in
                [(on_body.r_b_n_ddot, on_hub.r_b_n_ddot), (on_body.omega_dot, on_hub.omega_dot)]
            {
                worst.add((a - b).norm() / b.norm());
                assert!((a - b).norm() <= LIMIT * b.norm(), "{a} and {b}; {case}");
            }
        }
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + 20 {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("point force on body and hub: worst {:.1e}", worst.0);
}
