//! Evaluates one state of one device in every service.

use precess_dynamics::kind::{Each, JointStates, Kind};
#[cfg(feature = "lanes")]
use precess_dynamics::lanes::Batch;
use precess_dynamics::{BuiltIn, Hub, Inputs, SolveError, Spacecraft, State};

/// A device of a kind, its joints and motors.
#[derive(Clone, Copy)]
pub(crate) struct OneDevice<K: Kind<Scalar = f64>> {
    pub(crate) hub: Hub,
    pub(crate) device: K,
    pub(crate) state: State<[K; 1]>,
    pub(crate) inputs: Inputs<[K; 1]>,
}

/// Angular acceleration of the hub, or why there is none.
pub(crate) type Outcome = Result<[f64; 3], SolveError>;

/// The result of each service, by its name.
pub(crate) fn outcomes<K>(case: &OneDevice<K>) -> Vec<(&'static str, Outcome)>
where
    K: Kind<Scalar = f64> + Into<BuiltIn>,
{
    let OneDevice { hub, device, state, inputs } = case;
    let craft = Spacecraft::new(hub, &[*device]).expect("valid parameters");
    let found = craft.accelerations(state, inputs);
    let mut all = vec![("one state", found.map(|found| found.omega_dot.into()))];
    #[cfg(feature = "lanes")]
    all.extend(in_lanes(case));
    all.push((
        "list on board",
        listed::<K, [Option<BuiltIn>; 2]>(case, &[Some((*device).into()), None]),
    ));
    all.push(("list", listed::<K, Vec<BuiltIn>>(case, &vec![(*device).into()])));
    all
}

/// The result of each service in lanes, by its name.
#[cfg(feature = "lanes")]
fn in_lanes<K>(case: &OneDevice<K>) -> Vec<(&'static str, Outcome)>
where
    K: Kind<Scalar = f64>,
{
    let OneDevice { hub, device, state, inputs } = case;
    let batch = Batch::new(hub, &[*device]).expect("valid parameters");
    let mut out = Vec::new();
    batch.accelerations(&[*state; 9], inputs, &mut out).expect("as many inputs as states");
    out.into_iter().map(|found| ("batch", found.map(|found| found.omega_dot.into()))).collect()
}

/// The same by a set whose devices are known at run time only.
fn listed<K, D>(case: &OneDevice<K>, devices: &D) -> Outcome
where
    K: Kind<Scalar = f64>,
    D: precess_dynamics::Devices<Scalar = f64>,
{
    let craft = Spacecraft::new(&case.hub, devices).expect("valid parameters");
    let mut state = State::at_rest_for(&craft);
    state.r_b_n = case.state.r_b_n;
    state.r_b_n_dot = case.state.r_b_n_dot;
    state.attitude = case.state.attitude;
    state.omega = case.state.omega;
    for ([q, rate], [from, from_rate]) in
        state.devices.states_mut().zip(case.state.devices.states())
    {
        (*q, *rate) = (from, from_rate);
    }
    let mut inputs = Inputs::none_for(&craft);
    let motors = inputs.motors.values_mut().zip(case.inputs.motors.values());
    motors.for_each(|(to, from)| *to = from);
    let modes = inputs.modes.values_mut().zip(case.inputs.modes.values());
    modes.for_each(|(to, from)| *to = from);
    inputs.hub = case.inputs.hub;
    craft.accelerations(&state, &inputs).map(|found| found.omega_dot.into())
}
