//! A case: one spacecraft in one state with inputs, as numbers, for any set of devices and scalar.

use nalgebra::Vector3;
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    BuiltIn, BuiltInKind, DeviceParameters, Devices, Each, Gravity, Hub, HubMode, ImbalanceModel,
    Inputs, JointStates, MAX_JOINTS, Mode, ParameterError, Passive, Quaternion, Scalar, Spacecraft,
    State, Wrench,
};

/// Devices as a case holds them.
pub type List<T = f64> = Vec<BuiltIn<T>>;

/// A spacecraft, how it moves and what acts on it.
#[derive(Clone, Debug)]
pub struct Case {
    /// The hub.
    pub hub: Hub,
    /// The devices.
    pub devices: List,
    /// How it moves.
    pub state: State<List>,
    /// What acts on it.
    pub inputs: Inputs<List>,
    /// Length of a step, s.
    pub dt: f64,
    /// How many steps, where there are several.
    pub steps: usize,
    /// More states with their inputs, if a batch is evaluated.
    pub more: Vec<(State<List>, Inputs<List>)>,
}

/// A case made ready in one shape and number.
#[derive(Clone, Debug)]
pub struct PreparedCase<D: Devices> {
    /// The spacecraft.
    pub craft: Spacecraft<D>,
    /// Its state.
    pub state: State<D>,
    /// What acts on it.
    pub inputs: Inputs<D>,
}

impl Case {
    /// A spacecraft that does nothing, in the state of rest.
    #[must_use]
    pub fn still(hub: Hub, devices: List) -> Self {
        let craft = template(&devices);
        let (state, inputs) = (State::at_rest_for(&craft), Inputs::none_for(&craft));
        Self { hub, devices, state, inputs, dt: 1e-3, steps: 1, more: Vec::new() }
    }

    /// A case of devices in any shape.
    #[must_use]
    pub fn from_set<D: Devices<Scalar = f64>>(
        hub: &Hub,
        devices: List,
        state: &State<D>,
        inputs: &Inputs<D>,
        dt: f64,
    ) -> Self {
        let craft = template(&devices);
        let state = moved(state, State::at_rest_for(&craft));
        let inputs = given(inputs, &craft);
        Self { hub: *hub, devices, state, inputs, dt, steps: 1, more: Vec::new() }
    }

    /// The case as it is.
    ///
    /// # Errors
    /// Of [`Spacecraft::new`].
    pub fn list(&self) -> Result<PreparedCase<List>, ParameterError> {
        let craft = Spacecraft::new(&self.hub, &self.devices)?;
        Ok(PreparedCase { craft, state: self.state.clone(), inputs: self.inputs.clone() })
    }

    /// The case in another shape or number, with these devices.
    ///
    /// # Errors
    /// Of [`Spacecraft::new`].
    pub fn placed<D: Devices>(
        &self,
        devices: &D,
    ) -> Result<PreparedCase<D>, ParameterError<D::Scalar>> {
        let craft = Spacecraft::new(&hub(&self.hub), devices)?;
        let state = moved(&self.state, State::at_rest_for(&craft));
        let inputs = given(&self.inputs, &craft);
        Ok(PreparedCase { craft, state, inputs })
    }

    /// The devices in another number.
    ///
    /// # Panics
    /// If a device is no longer one of its kind.
    #[must_use]
    pub fn devices_in<T: Scalar>(&self) -> List<T> {
        self.devices.iter().map(device).collect()
    }

    /// The kinds of the devices.
    #[must_use]
    pub fn kinds(&self) -> Vec<BuiltInKind> {
        self.devices.iter().map(BuiltIn::kind).collect()
    }

    /// The same case with another of its states.
    #[must_use]
    pub fn with(&self, state: &State<List>, inputs: &Inputs<List>) -> Self {
        Self { state: state.clone(), inputs: inputs.clone(), more: Vec::new(), ..self.clone() }
    }

    /// All states and inputs, the first among them.
    #[must_use]
    pub fn all(&self) -> Vec<(State<List>, Inputs<List>)> {
        let first = (self.state.clone(), self.inputs.clone());
        std::iter::once(first).chain(self.more.iter().cloned()).collect()
    }
}

/// A spacecraft of the same kinds that is always accepted: for the shape of its state.
pub(super) fn template(devices: &[BuiltIn]) -> Spacecraft<List> {
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: nalgebra::Matrix3::identity() };
    let unit = |device: &BuiltIn| {
        let mut parameters = device.parameters();
        parameters.mount = nalgebra::Matrix3::identity();
        parameters.passive = [Passive::none(); MAX_JOINTS];
        let tip = device.kind().joints().len().saturating_sub(1);
        for (index, body) in parameters.bodies.iter_mut().enumerate() {
            let BodyParameters { origin, centre, mass, inertia } = body;
            (*origin, *centre) = ([0.0; 3], [0.0; 3]);
            // Links of flexible bearings have no body.
            *mass = if index == tip { 1.0 } else { 0.0 };
            *inertia = nalgebra::Matrix3::zeros();
        }
        parameters.model = ImbalanceModel::Coupled;
        BuiltIn::new(device.kind(), &parameters).expect("bodies of a point mass fit every kind")
    };
    let devices: List = devices.iter().map(unit).collect();
    Spacecraft::new(&hub, &devices).expect("point masses on a hub")
}

fn number<T: Scalar>(x: f64) -> T {
    T::from_f64(x)
}

fn vector<T: Scalar>(v: &Vector3<f64>) -> Vector3<T> {
    v.map(number)
}

/// A hub in another number.
#[must_use]
pub fn hub<T: Scalar>(hub: &Hub) -> Hub<T> {
    Hub { m_b: number(hub.m_b), r_bc_b: vector(&hub.r_bc_b), i_b_bc: hub.i_b_bc.map(number) }
}

/// A device in another number.
fn device<T: Scalar>(device: &BuiltIn) -> BuiltIn<T> {
    let DeviceParameters { mount, bodies, passive, model } = device.parameters();
    let bodies = bodies.map(|body| BodyParameters {
        origin: body.origin.map(number),
        mass: number(body.mass),
        centre: body.centre.map(number),
        inertia: body.inertia.map(number),
    });
    let passive = passive.map(|passive| passive.map(number));
    let parameters = DeviceParameters { mount: mount.map(number), bodies, passive, model };
    BuiltIn::new(device.kind(), &parameters).expect("a device of its own kind")
}

/// A state's numbers in the shape and number of another.
pub fn moved<D: Devices<Scalar = f64>, E: Devices>(from: &State<D>, to: State<E>) -> State<E> {
    let Quaternion { q0, q1, q2, q3 } = from.attitude;
    let mut state = State {
        r_b_n: vector(&from.r_b_n),
        r_b_n_dot: vector(&from.r_b_n_dot),
        attitude: Quaternion { q0: number(q0), q1: number(q1), q2: number(q2), q3: number(q3) },
        omega: vector(&from.omega),
        ..to
    };
    for ([q, rate], from) in state.devices.states_mut().zip(from.devices.states()) {
        (*q, *rate) = (number(from[0]), number(from[1]));
    }
    state
}

/// Inputs in the shape and number of another spacecraft.
pub fn given<D: Devices<Scalar = f64>, E: Devices>(
    from: &Inputs<D>,
    craft: &Spacecraft<E>,
) -> Inputs<E> {
    let mut inputs = Inputs::none_for(craft);
    inputs.force = vector(&from.force);
    inputs.torque_b = vector(&from.torque_b);
    for (to, from) in inputs.motors.values_mut().zip(from.motors.values()) {
        *to = number(from);
    }
    for (to, from) in inputs.modes.values_mut().zip(from.modes.values()) {
        *to = match from {
            Mode::Driven => Mode::Driven,
            Mode::Prescribed(acceleration) => Mode::Prescribed(number(acceleration)),
            Mode::Locked => Mode::Locked,
        };
    }
    inputs.hub = match &from.hub {
        HubMode::Free => HubMode::Free,
        HubMode::Fixed => HubMode::Fixed,
        HubMode::Prescribed { r_b_n_ddot, omega_dot } => {
            HubMode::Prescribed { r_b_n_ddot: vector(r_b_n_ddot), omega_dot: vector(omega_dot) }
        }
    };
    inputs.gravity = match &from.gravity {
        Gravity::None => Gravity::None,
        Gravity::Uniform(g) => Gravity::Uniform(vector(g)),
        Gravity::Central { mu } => Gravity::Central { mu: number(*mu) },
    };
    inputs.bodies = from.bodies.as_ref().map(|from| {
        let mut bodies = Inputs::no_wrenches_for(craft);
        for (to, from) in bodies.values_mut().zip(from.values()) {
            *to = Wrench { force: vector(&from.force), moment: vector(&from.moment) };
        }
        bodies
    });
    inputs
}
