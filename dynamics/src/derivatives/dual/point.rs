//! [`Point`]: state and inputs in dual numbers, and variables seeded in them.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::turned::Turned;
use crate::derivatives::error::DerivativeError;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::Variable;
use crate::equations::gravity::Gravity;
use crate::model::mode::{HubMode, Mode};
use crate::model::wrench::Wrench;
use crate::numbers::dual::Dual;
use crate::numbers::each::{Each, JointStates, filled};
use crate::numbers::real::{Scalar, one};
use crate::sets::devices::{DeviceSet, Devices};
use crate::sets::per_device as data;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::solve::structure::StructureData;

/// How many derivatives one evaluation computes: the hub's state and its inputs fill whole ones.
pub(crate) const WIDTH: usize = 6;

/// A number with the derivatives of one evaluation.
pub(crate) type Number<T> = Dual<T, WIDTH>;

/// A set of devices over these numbers.
pub(crate) type DualSet<D> = <D as WithNumbers>::With<Number<<D as DeviceSet>::Scalar>>;

/// State and inputs.
#[derive(Clone, Debug)]
pub(crate) struct Point<D: Devices, S: StructureData> {
    pub(crate) state: State<D, Turned<D::Scalar>, S>,
    pub(crate) inputs: Inputs<D, S>,
}

impl<T: Scalar, D: Devices<Scalar = Number<T>>, S: StructureDerivatives> Point<D, S> {
    /// Constant state and inputs, of as many devices as the spacecraft has. `wrenches` is whether
    /// those on bodies are variables.
    pub(crate) fn new<E: Devices<Scalar = T>, A: Attitude<T>>(
        spacecraft: &Spacecraft<D, S>,
        state: &State<E, A, S>,
        inputs: &Inputs<E, S>,
        wrenches: bool,
    ) -> Self {
        let number = Number::constant;
        let constant = |wrench: Wrench<T>| Wrench {
            force: wrench.force.map(number),
            moment: wrench.moment.map(number),
        };
        let mut joints = D::new_data(&spacecraft.devices, &data::Joints);
        for ([coordinate, rate], [x, x_dot]) in joints.states_mut().zip(state.devices.states()) {
            (*coordinate, *rate) = (number(x), number(x_dot));
        }
        let no_wrenches = || D::new_data(&spacecraft.devices, &data::PerJoint(Wrench::none()));
        let bodies = match &inputs.bodies {
            Some(bodies) => Some(filled(no_wrenches(), bodies.values().map(constant))),
            None => wrenches.then(no_wrenches),
        };
        let motors = D::new_data(&spacecraft.devices, &data::Motors);
        let modes = D::new_data(&spacecraft.devices, &data::PerJoint(Mode::Driven));
        let mode = |mode| match mode {
            Mode::Driven => Mode::Driven,
            Mode::Prescribed(acceleration) => Mode::Prescribed(number(acceleration)),
            Mode::Locked => Mode::Locked,
        };
        Self {
            state: State {
                r_b_n: state.r_b_n.map(number),
                r_b_n_dot: state.r_b_n_dot.map(number),
                attitude: Turned::of(&state.attitude),
                omega: state.omega.map(number),
                devices: joints,
                modal: S::state(&state.modal, number),
            },
            inputs: Inputs {
                force: inputs.force.map(number),
                torque_b: inputs.torque_b.map(number),
                motors: filled(motors, inputs.motors.values().map(number)),
                modes: filled(modes, inputs.modes.values().map(mode)),
                hub: match &inputs.hub {
                    HubMode::Free => HubMode::Free,
                    HubMode::Fixed => HubMode::Fixed,
                    HubMode::Prescribed { r_b_n_ddot, omega_dot } => HubMode::Prescribed {
                        r_b_n_ddot: r_b_n_ddot.map(number),
                        omega_dot: omega_dot.map(number),
                    },
                },
                gravity: match &inputs.gravity {
                    Gravity::None => Gravity::None,
                    Gravity::Uniform(g) => Gravity::Uniform(g.map(number)),
                    Gravity::Central { mu } => Gravity::Central { mu: number(*mu) },
                },
                bodies,
                modal: S::inputs(&inputs.modal, number),
            },
        }
    }

    /// Makes something a variable of a number.
    pub(crate) fn seed(
        &mut self,
        variable: Variable,
        number: usize,
    ) -> Result<(), DerivativeError<T>> {
        self.seed_multiple(variable, number, one())
    }

    /// Makes something a multiple of the variable of a number.
    pub(crate) fn seed_multiple(
        &mut self,
        variable: Variable,
        number: usize,
        multiple: T,
    ) -> Result<(), DerivativeError<T>> {
        let Self { state, inputs } = self;
        let found = match variable {
            Variable::Attitude(axis) => {
                state.attitude.seed(axis, number, multiple);
                return Ok(());
            }
            Variable::Position(axis) => Some(axis.of_mut(&mut state.r_b_n)),
            Variable::Velocity(axis) => Some(axis.of_mut(&mut state.r_b_n_dot)),
            Variable::Omega(axis) => Some(axis.of_mut(&mut state.omega)),
            Variable::Coordinate(joint) => {
                state.devices.states_mut().nth(joint).map(|[coordinate, _]| coordinate)
            }
            Variable::Rate(joint) => state.devices.states_mut().nth(joint).map(|[_, rate]| rate),
            Variable::Force(axis) => Some(axis.of_mut(&mut inputs.force)),
            Variable::TorqueB(axis) => Some(axis.of_mut(&mut inputs.torque_b)),
            Variable::Motor(joint) => inputs.motors.values_mut().nth(joint),
            Variable::Acceleration(joint) => match inputs.modes.values_mut().nth(joint) {
                Some(Mode::Prescribed(acceleration)) => Some(acceleration),
                Some(_) => return Err(DerivativeError::NotAnInput { variable }),
                None => None,
            },
            Variable::HubAcceleration(axis) => match &mut inputs.hub {
                HubMode::Prescribed { r_b_n_ddot, .. } => Some(axis.of_mut(r_b_n_ddot)),
                _ => return Err(DerivativeError::NotAnInput { variable }),
            },
            Variable::HubAngularAcceleration(axis) => match &mut inputs.hub {
                HubMode::Prescribed { omega_dot, .. } => Some(axis.of_mut(omega_dot)),
                _ => return Err(DerivativeError::NotAnInput { variable }),
            },
            Variable::BodyForce(joint, axis) => {
                let wrench = inputs.bodies.iter_mut().flat_map(Each::values_mut).nth(joint);
                wrench.map(|wrench| axis.of_mut(&mut wrench.force))
            }
            Variable::BodyMoment(joint, axis) => {
                let wrench = inputs.bodies.iter_mut().flat_map(Each::values_mut).nth(joint);
                wrench.map(|wrench| axis.of_mut(&mut wrench.moment))
            }
            Variable::Gravity(axis) => match &mut inputs.gravity {
                Gravity::Uniform(g) => Some(axis.of_mut(g)),
                _ => return Err(DerivativeError::NotAnInput { variable }),
            },
            Variable::Mu => match &mut inputs.gravity {
                Gravity::Central { mu } => Some(mu),
                _ => return Err(DerivativeError::NotAnInput { variable }),
            },
            Variable::ModalCoordinate(mode) => {
                let [eta, _] = S::coordinates(&mut state.modal);
                eta.get_mut(mode)
            }
            Variable::ModalRate(mode) => {
                let [_, eta_dot] = S::coordinates(&mut state.modal);
                eta_dot.get_mut(mode)
            }
            Variable::ModalForce(mode) => S::forces(&mut inputs.modal).get_mut(mode),
            Variable::MountForce(mount, axis) => {
                let wrench = S::wrenches(&mut inputs.modal).get_mut(mount);
                wrench.map(|wrench| axis.of_mut(&mut wrench.force))
            }
            Variable::MountMoment(mount, axis) => {
                let wrench = S::wrenches(&mut inputs.modal).get_mut(mount);
                wrench.map(|wrench| axis.of_mut(&mut wrench.moment))
            }
        };
        if let Some(found) = found {
            found.add_derivative(number, multiple);
            return Ok(());
        }
        Err(self.missing(variable))
    }

    /// The error for a variable of a joint, mode or mount that there is not.
    fn missing(&mut self, variable: Variable) -> DerivativeError<T> {
        match variable {
            Variable::ModalCoordinate(mode)
            | Variable::ModalRate(mode)
            | Variable::ModalForce(mode) => {
                let modes = S::forces(&mut self.inputs.modal).len();
                DerivativeError::NoSuchMode { mode, modes }
            }
            Variable::MountForce(mount, _) | Variable::MountMoment(mount, _) => {
                let mounts = S::wrenches(&mut self.inputs.modal).len();
                DerivativeError::NoSuchMount { mount, mounts }
            }
            _ => {
                let joints = self.state.devices.states().count();
                let joint = variable.joint().unwrap_or_default();
                DerivativeError::NoSuchJoint { joint, joints }
            }
        }
    }
}
