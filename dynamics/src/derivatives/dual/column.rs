//! [`Column`]: the derivatives of all requested results by one variable.

use nalgebra::Vector3;

use crate::derivatives::dual::elimination::ConstantsPlain;
use crate::derivatives::dual::point::{DualSet, Number, Point};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::model::kind::Kind;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, filled};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{columns, components, cross, rotate_transposed, vector};
use crate::results::loads::LoadAxes;
use crate::results::momentum::{About, EnergyAndMomentum, Momentum};
use crate::sets::bundle::{Shared, Unique};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device as data;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::Accelerations;
use crate::solve::structure::{Rigid, StructureData};
use crate::{Attitude, Loads};

/// What is differentiated beside the accelerations. Each costs about as much again as they do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<T = f64> {
    /// Kinetic energy and momenta, the angular one about this point.
    pub momentum: Option<About<T>>,
    /// The load on every joint, in these axes, and that on the hub: what [`Spacecraft::loads`]
    /// returns for the accelerations of the state.
    pub loads: Option<LoadAxes>,
}

impl<T> Outputs<T> {
    /// Only accelerations.
    #[must_use]
    pub const fn accelerations() -> Self {
        Self { momentum: None, loads: None }
    }
}

/// The loads on the joints: [`DeviceLoads::joints`](crate::DeviceLoads::joints) of each device.
pub(crate) type JointLoads<D> =
    <D as DeviceSet>::Per<data::PerJoint<Wrench<<D as DeviceSet>::Scalar>>>;

/// Derivatives by one variable, each in the unit of the quantity over that of the variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<D: Devices, S: StructureData = Rigid> {
    /// Of the accelerations, expressed as [`Accelerations`] are.
    pub accelerations: Accelerations<D, S>,
    /// Of the acceleration of B expressed in N, the derivative of
    /// [`State::r_b_n_dot`](crate::State::r_b_n_dot): it also changes with the attitude.
    pub r_b_n_ddot_n: Vector3<D::Scalar>,
    /// Of kinetic energy and momenta, if requested. By
    /// [`Variable::Attitude`], of their components expressed in N.
    pub momentum: Option<EnergyAndMomentum<D::Scalar>>,
    /// Of the load on every joint, if requested: force and moment that its parent body exerts
    /// on its child body, about the joint's origin.
    pub loads: Option<JointLoads<D>>,
    /// Of what must act on the hub in addition to the inputs, about B, expressed in B
    /// ([`Loads::hub`]), if loads were requested: what moves a fixed or prescribed hub.
    pub hub_load: Option<Wrench<D::Scalar>>,
}

impl<D: Devices, S: StructureDerivatives> Column<D, S> {
    /// The element of the matrix of the linearised system: the derivative by `variable`, of which
    /// this is the column, of the time derivative of a state. None where `state` is no state.
    ///
    /// The derivative of the position is the velocity, that of the attitude `-omega x dtheta +
    /// domega`, that of a coordinate its rate; the others are accelerations.
    #[must_use]
    pub fn element(
        &self,
        state: Variable,
        variable: Variable,
        omega: &Vector3<D::Scalar>,
    ) -> Option<D::Scalar> {
        let unit = |holds: bool| if holds { one() } else { zero() };
        let along = |axis: Axis| vector(Axis::ALL.map(|other| unit(other == axis)));
        Some(match state {
            Variable::Position(axis) => unit(variable == Variable::Velocity(axis)),
            Variable::Attitude(axis) => match variable {
                Variable::Attitude(by) => axis.of(cross(components(&along(by)), components(omega))),
                Variable::Omega(by) => unit(by == axis),
                _ => zero(),
            },
            Variable::Velocity(axis) => axis.of(components(&self.r_b_n_ddot_n)),
            Variable::Omega(axis) => axis.of(components(&self.accelerations.omega_dot)),
            Variable::Coordinate(joint) => unit(variable == Variable::Rate(joint)),
            Variable::Rate(joint) => self.accelerations.devices.values().nth(joint)?,
            Variable::ModalCoordinate(mode) => unit(variable == Variable::ModalRate(mode)),
            Variable::ModalRate(mode) => {
                *S::modal_accelerations(&self.accelerations.modal).get(mode)?
            }
            _ => return None,
        })
    }
}

/// Everything that is differentiated, in dual numbers.
#[derive(Debug)]
pub(crate) struct Results<D: Devices, S: StructureData> {
    accelerations: Accelerations<D, S>,
    r_b_n_ddot_n: Vector3<D::Scalar>,
    momentum: Option<EnergyAndMomentum<D::Scalar>>,
    /// On the joints, and on the hub.
    loads: Option<(JointLoads<D>, Wrench<D::Scalar>)>,
}

impl<T: Scalar, D: Devices<Scalar = Number<T>>, S: StructureDerivatives> Results<D, S> {
    /// Evaluates them.
    pub(crate) fn of(
        spacecraft: &Spacecraft<D, S>,
        at: &Point<D, S>,
        outputs: &Outputs<T>,
    ) -> Result<Self, SolveError<Number<T>>> {
        let Point { state, inputs } = at;
        let accelerations =
            spacecraft.accelerations_by(ConstantsPlain(spacecraft.arithmetic), state, inputs)?;
        let bn = columns(&state.attitude.dcm());
        let in_n = rotate_transposed(&bn, components(&accelerations.r_b_n_ddot));
        let momentum = match &outputs.momentum {
            Some(about) => Some(spacecraft.energy_and_momentum(state, constant(about))?),
            None => None,
        };
        let loads = match outputs.loads {
            Some(axes) => {
                let found = spacecraft.loads(state, inputs, &accelerations, axes)?;
                Some((joint_loads(spacecraft, &found), found.hub))
            }
            None => None,
        };
        Ok(Self { accelerations, r_b_n_ddot_n: vector(in_n), momentum, loads })
    }
}

/// The point of the momentum, constant.
fn constant<T: Scalar>(about: &About<T>) -> About<Number<T>> {
    match about {
        About::InertialOrigin => About::InertialOrigin,
        About::CentreOfMass => About::CentreOfMass,
        About::Point(point) => About::Point(point.map(Number::constant)),
    }
}

/// Copies the loads on the joints of each device.
struct Copies;

impl<T: Scalar> Visit<T, (Shared<data::Loads>, Unique<data::PerJoint<Wrench<T>>>)> for Copies {
    type Error = core::convert::Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        (loads, to): (&crate::equations::device_loads::LoadsOf<K>, &mut K::PerJoint<Wrench<T>>),
    ) -> Result<(), Self::Error> {
        *to = loads.joints;
        Ok(())
    }
}

fn joint_loads<D: Devices, S: StructureDerivatives>(
    spacecraft: &Spacecraft<D, S>,
    loads: &Loads<D, S>,
) -> JointLoads<D> {
    let mut joints = D::new_data(&spacecraft.devices, &data::PerJoint(Wrench::none()));
    let data = (&loads.devices, &mut joints);
    let Ok(()) = D::visit::<(Shared<data::Loads>, Unique<data::PerJoint<Wrench<D::Scalar>>>), _>(
        &spacecraft.devices,
        data,
        &mut Copies,
    );
    joints
}

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// The derivatives by the variable of a number.
    pub(crate) fn column(&self, of: &Results<DualSet<D>, S>, number: usize) -> Column<D, S> {
        let along =
            |v: &Vector3<Number<D::Scalar>>| v.map(|component| component.derivative(number));
        let wrench = |of: Wrench<_>| Wrench { force: along(&of.force), moment: along(&of.moment) };
        let Results { accelerations, r_b_n_ddot_n, momentum, loads } = of;
        let joints = accelerations.devices.values().map(|value| value.derivative(number));
        let no_wrenches = || D::new_data(&self.devices, &data::PerJoint(Wrench::none()));
        Column {
            accelerations: Accelerations {
                r_b_n_ddot: along(&accelerations.r_b_n_ddot),
                omega_dot: along(&accelerations.omega_dot),
                devices: filled(D::new_data(&self.devices, &data::Accelerations), joints),
                modal: S::accelerations(&accelerations.modal, |of: Number<D::Scalar>| {
                    of.derivative(number)
                }),
            },
            r_b_n_ddot_n: along(r_b_n_ddot_n),
            momentum: momentum.as_ref().map(|of| EnergyAndMomentum {
                energy: of.energy.derivative(number),
                momentum: Momentum {
                    linear: along(&of.momentum.linear),
                    angular: along(&of.momentum.angular),
                },
            }),
            loads: loads.as_ref().map(|(of, _)| filled(no_wrenches(), of.values().map(wrench))),
            hub_load: loads.as_ref().map(|(_, of)| wrench(*of)),
        }
    }
}
