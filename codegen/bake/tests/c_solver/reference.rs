//! What the Rust library makes of a case, in the order in which the C program writes.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Attitude, BuiltIn, Each, Gravity, Hub, HubMode, Inputs, JointStates, Mode, Mrp, Quaternion,
    SolveError, Spacecraft, State, Wrench,
};

use crate::case::Case;

pub(crate) type Set = Vec<BuiltIn>;

/// An attitude as four numbers.
pub(crate) trait Numbers: Attitude<f64> {
    fn of(numbers: [f64; 4]) -> Self;
    fn numbers(&self) -> [f64; 4];
}

impl Numbers for Quaternion {
    fn of([q0, q1, q2, q3]: [f64; 4]) -> Self {
        Self { q0, q1, q2, q3 }
    }

    fn numbers(&self) -> [f64; 4] {
        [self.q0, self.q1, self.q2, self.q3]
    }
}

impl Numbers for Mrp {
    fn of([x, y, z, _]: [f64; 4]) -> Self {
        Self::from_components(x, y, z)
    }

    fn numbers(&self) -> [f64; 4] {
        [self.0.x, self.0.y, self.0.z, 0.0]
    }
}

/// The status that the C has for an error.
fn status<T>(result: &Result<T, SolveError>) -> f64 {
    match result {
        Ok(_) => 0.0,
        Err(SolveError::NotFinite { .. }) => 2.0,
        Err(SolveError::Singular { .. }) => 4.0,
        Err(SolveError::Overflow { .. }) => 5.0,
        Err(SolveError::LockedJointMoves { .. }) => 6.0,
        Err(SolveError::FixedHubMoves { .. }) => 7.0,
        Err(SolveError::NotDriven { .. }) => 8.0,
        Err(SolveError::AtCentre) => 9.0,
        Err(SolveError::Unstable { .. }) => 10.0,
        Err(other) => panic!("no error of a rigid hub: {other}"),
    }
}

/// The numbers that the C program writes of the case.
pub(crate) fn reference(case: &Case) -> Vec<f64> {
    if case.settings.mrp { by::<Mrp>(case) } else { by::<Quaternion>(case) }
}

/// The spacecraft of a case that has one, its state, and what acts on it.
pub(crate) fn of_case<A: Numbers>(case: &Case) -> (Spacecraft<Set>, State<Set, A>, Inputs<Set>) {
    let craft = Spacecraft::<Set>::new(&hub(case), &case.devices).expect("a spacecraft");
    let (state, inputs) = (state::<A>(case, &craft), inputs(case, &craft));
    (craft, state, inputs)
}

fn hub(case: &Case) -> Hub {
    let [xx, xy, xz, yy, yz, zz] = case.inertia;
    Hub {
        m_b: case.mass,
        r_bc_b: Vector3::from(case.centre_of_mass),
        i_b_bc: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    }
}

fn by<A: Numbers>(case: &Case) -> Vec<f64> {
    let made = Spacecraft::<Set>::new(&hub(case), &case.devices);
    let (mut statuses, mut found) = ([0.0; 4], vec![0.0; 6 + case.joints.len()]);
    let Ok(craft) = made else {
        statuses[0] = 1.0;
        let coordinates = case.joints.iter().map(|joint| joint.coordinate).collect();
        return [statuses.to_vec(), found, start(case), coordinates].concat();
    };
    let (mut state, inputs) = (state::<A>(case, &craft), inputs(case, &craft));
    let accelerations = craft.accelerations(&state, &inputs);
    statuses[1] = status(&accelerations);
    if let Ok(own) = accelerations {
        found = own.r_b_n_ddot.iter().chain(&own.omega_dot).copied().collect();
        found.extend(own.devices.iter().flat_map(Each::values));
    }
    for _ in 0..case.settings.steps {
        let next = craft.step(&state, &inputs, case.settings.dt);
        statuses[2] = status(&next);
        let Ok(next) = next else { break };
        state = next;
        statuses[3] += 1.0;
    }
    let numbers = numbers(&state);
    let wrapped = state.wrapped(&craft);
    let wrapped = wrapped.devices.states().map(|[coordinate, _]| coordinate).collect();
    [statuses.to_vec(), found, numbers, wrapped].concat()
}

fn state<A: Numbers>(case: &Case, craft: &Spacecraft<Set>) -> State<Set, A> {
    let mut state = State::at_rest_for(craft);
    state.r_b_n = Vector3::from(case.r_b_n);
    state.r_b_n_dot = Vector3::from(case.r_b_n_dot);
    state.attitude = A::of(case.attitude);
    state.omega = Vector3::from(case.omega);
    let joints = state.devices.iter_mut().flat_map(JointStates::states_mut);
    for ([coordinate, rate], joint) in joints.zip(&case.joints) {
        (*coordinate, *rate) = (joint.coordinate, joint.rate);
    }
    state
}

fn inputs(case: &Case, craft: &Spacecraft<Set>) -> Inputs<Set> {
    let mut inputs = Inputs::none_for(craft);
    inputs.force = Vector3::from(case.force);
    inputs.torque_b = Vector3::from(case.torque_b);
    let motors = inputs.motors.iter_mut().flat_map(Each::values_mut);
    let modes = inputs.modes.iter_mut().flat_map(Each::values_mut);
    for ((torque, mode), joint) in motors.zip(modes).zip(&case.joints) {
        *torque = joint.torque;
        *mode = match joint.mode {
            0 => Mode::Driven,
            1 => Mode::Prescribed(joint.acceleration),
            _ => Mode::Locked,
        };
    }
    inputs.hub = match case.settings.hub {
        0 => HubMode::Free,
        1 => HubMode::Fixed,
        _ => HubMode::Prescribed {
            r_b_n_ddot: Vector3::from(case.r_b_n_ddot),
            omega_dot: Vector3::from(case.omega_dot),
        },
    };
    inputs.gravity = match case.settings.field {
        0 => Gravity::None,
        1 => Gravity::Uniform(Vector3::from(case.uniform)),
        _ => Gravity::Central { mu: case.mu },
    };
    if case.settings.wrenches {
        let mut bodies = Inputs::no_wrenches_for(craft);
        let wrenches = bodies.iter_mut().flat_map(Each::values_mut);
        for (wrench, joint) in wrenches.zip(&case.joints) {
            let (force, moment) = (Vector3::from(joint.force), Vector3::from(joint.moment));
            *wrench = Wrench { force, moment };
        }
        inputs.bodies = Some(bodies);
    }
    inputs
}

fn numbers<A: Numbers>(state: &State<Set, A>) -> Vec<f64> {
    let joints: Vec<_> = state.devices.iter().flat_map(JointStates::states).collect();
    let mut numbers: Vec<_> = state.r_b_n.iter().chain(&state.r_b_n_dot).copied().collect();
    numbers.extend(state.attitude.numbers());
    numbers.extend(state.omega.iter());
    numbers.extend(joints.iter().map(|[coordinate, _]| coordinate));
    numbers.extend(joints.iter().map(|[_, rate]| rate));
    numbers
}

/// The state at the start.
fn start(case: &Case) -> Vec<f64> {
    let mut numbers = [case.r_b_n, case.r_b_n_dot].concat();
    numbers.extend(case.attitude.iter().chain(&case.omega));
    numbers.extend(case.joints.iter().map(|joint| joint.coordinate));
    numbers.extend(case.joints.iter().map(|joint| joint.rate));
    numbers
}
