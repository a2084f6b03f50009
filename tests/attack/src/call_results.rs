//! Results of every public call of a spacecraft, as numbers or as an error.

use precess_dynamics::{
    About, Accelerations, Attitude, DeviceLoads, DeviceSet, Devices, Each, HubMode, Inputs,
    JointPower, JointStates, Ledger, LoadAxes, Loads, Mode, Power, Quaternion, Scalar, SolveError,
    Spacecraft, State, Wrench, set,
};

use super::PreparedCase;

/// Numbers, or the error.
pub type CallResult<T = f64> = Result<Vec<T>, SolveError<T>>;

/// A result that consists of numbers.
pub trait Numbers<T> {
    /// Adds the numbers, in order.
    fn add_to(&self, all: &mut Vec<T>);
}

impl<T: Scalar, W: Each<Wrench<T>>, U: Each<T>, P: Each<JointPower<T>>> Numbers<T>
    for DeviceLoads<W, U, P, T>
{
    fn add_to(&self, all: &mut Vec<T>) {
        let Self { mount, joints, motors, powers } = self;
        for wrench in std::iter::once(*mount).chain(joints.values()) {
            all.extend(wrench.force.iter().chain(&wrench.moment));
        }
        all.extend(motors.values());
        for JointPower { motor, spring, friction } in powers.values() {
            all.extend([motor, spring, friction]);
        }
    }
}

impl<T, L: Numbers<T>> Numbers<T> for Vec<L> {
    fn add_to(&self, all: &mut Vec<T>) {
        for member in self {
            member.add_to(all);
        }
    }
}

impl<T, L: Numbers<T>, const N: usize> Numbers<T> for [L; N] {
    fn add_to(&self, all: &mut Vec<T>) {
        for member in self {
            member.add_to(all);
        }
    }
}

impl<T, L: Numbers<T>> Numbers<T> for Option<L> {
    fn add_to(&self, all: &mut Vec<T>) {
        if let Some(member) = self {
            member.add_to(all);
        }
    }
}

macro_rules! tuples {
    ($($($member:ident $index:tt)*;)*) => {$(
        impl<T, $($member: Numbers<T>),*> Numbers<T> for ($($member,)*) {
            fn add_to(&self, all: &mut Vec<T>) {
                $(self.$index.add_to(all);)*
            }
        }
    )*};
}

tuples! {
    A 0;
    A 0 B 1;
    A 0 B 1 C 2;
    A 0 B 1 C 2 D 3 E 4 F 5;
}

impl<T: Scalar> Numbers<T> for Ledger<T> {
    fn add_to(&self, all: &mut Vec<T>) {
        let Self {
            kinetic,
            gravity,
            springs,
            kinetic_rate,
            power,
            residual,
            magnitude,
            momentum,
            ..
        } = *self;
        all.extend([kinetic, gravity, springs, kinetic_rate, residual, magnitude]);
        all.extend([power.total(), self.energy()]);
        power.add_to(all);
        all.extend(momentum.linear.iter().chain(&momentum.angular));
    }
}

impl<T: Scalar> Numbers<T> for Power<T> {
    fn add_to(&self, all: &mut Vec<T>) {
        let Self { external, hub, gravity, motors, springs, friction } = *self;
        all.extend([external, hub, gravity, motors, springs, friction, self.total()]);
    }
}

/// The numbers of accelerations.
pub fn of_accelerations<D: Devices>(found: &Accelerations<D>) -> Vec<D::Scalar> {
    let hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
    hub.chain(found.devices.values()).collect()
}

/// The numbers of a state.
pub fn of_state<D: Devices>(state: &State<D>) -> Vec<D::Scalar> {
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let hub = state.r_b_n.iter().chain(&state.r_b_n_dot).chain(&state.omega).copied();
    hub.chain([q0, q1, q2, q3]).chain(state.devices.states().flatten()).collect()
}

fn of_loads<D: Devices<Per<set::Loads>: Numbers<<D as DeviceSet>::Scalar>>>(
    loads: &Loads<D>,
) -> Vec<D::Scalar> {
    let mut all: Vec<_> = loads.hub.force.iter().chain(&loads.hub.moment).copied().collect();
    loads.devices.add_to(&mut all);
    all
}

/// Accelerations of this shape, all zero: everything is held at rest. None if that overflows.
#[must_use]
pub fn no_accelerations<D: Devices>(craft: &Spacecraft<D>) -> Option<Accelerations<D>> {
    let mut inputs = Inputs::none_for(craft);
    inputs.hub = HubMode::Fixed;
    inputs.modes.values_mut().for_each(|mode| *mode = Mode::Locked);
    let state: State<D> = State::at_rest_for(craft);
    craft.accelerations(&state, &inputs).ok()
}

/// Accelerations for which loads are computed: those of the state, or, if there are none, the
/// numbers of motors and forces.
fn wished<D: Devices>(placed: &PreparedCase<D>) -> Option<Accelerations<D>> {
    let PreparedCase { craft, state, inputs } = placed;
    if let Ok(found) = craft.accelerations(state, inputs) {
        return Some(found);
    }
    let mut wished = no_accelerations(craft)?;
    (wished.r_b_n_ddot, wished.omega_dot) = (inputs.force, inputs.torque_b);
    for (wished, motor) in wished.devices.values_mut().zip(inputs.motors.values()) {
        *wished = motor;
    }
    Some(wished)
}

/// The result of every call.
pub fn call_results<D: Devices<Per<set::Loads>: Numbers<<D as DeviceSet>::Scalar>>>(
    placed: &PreparedCase<D>,
    dt: D::Scalar,
) -> Vec<(&'static str, CallResult<D::Scalar>)> {
    let PreparedCase { craft, state, inputs } = placed;
    let numbers = |numbers: &dyn Numbers<D::Scalar>| {
        let mut all = Vec::new();
        numbers.add_to(&mut all);
        all
    };
    let momentum = |about| {
        craft
            .momentum(state, about)
            .map(|found| found.linear.iter().chain(&found.angular).copied().collect())
    };
    let centre = craft.centre_of_mass(state);
    let centre = centre.map(|found| found.c.iter().chain(&found.c_prime).copied().collect());
    let mut all = vec![
        ("accelerations", craft.accelerations(state, inputs).map(|f| of_accelerations(&f))),
        ("energy", craft.energy(state).map(|energy| vec![energy])),
        ("momentum about the origin", momentum(About::InertialOrigin)),
        ("momentum about the centre of mass", momentum(About::CentreOfMass)),
        ("momentum about a point", momentum(About::Point(inputs.force))),
        ("centre of mass", centre),
        ("step", craft.step(state, inputs, dt).map(|next| of_state(&next))),
        ("stop", {
            let stopped = craft.stop(state, inputs);
            stopped.map(|stopped| {
                let mut all = of_state(&stopped.state);
                all.push(stopped.energy_lost);
                all
            })
        }),
        ("step with work", {
            let stepped = craft.step_with_work(state, inputs, dt);
            stepped.map(|stepped| {
                let mut all = of_state(&stepped.state);
                stepped.work.add_to(&mut all);
                all
            })
        }),
    ];
    let Some(wished) = wished(placed) else { return all };
    for (name, axes) in [
        ("loads along body axes", LoadAxes::Body),
        ("loads in the parent body's axes", LoadAxes::Parent),
        ("loads along B axes", LoadAxes::Hub),
        ("loads along N axes", LoadAxes::Inertial),
    ] {
        all.push((name, craft.loads(state, inputs, &wished, axes).map(|loads| of_loads(&loads))));
    }
    let ledger = craft.ledger(state, inputs, &wished);
    all.push(("ledger", ledger.map(|ledger| numbers(&ledger))));
    all
}

/// The attitude as the numbers of its direction cosines.
pub fn of_attitude<T: Scalar, A: Attitude<T>>(attitude: &A) -> Vec<T> {
    attitude.dcm().iter().copied().collect()
}
