//! [`Spacecraft::parameter_derivatives`]: columns by parameters of hub and devices.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::column::{Column, Outputs, Results};
use crate::derivatives::error::DerivativeError;
use crate::derivatives::evaluation::not_finite;
use crate::derivatives::point::{DualSet, Number, Point, WIDTH};
use crate::derivatives::variable::Axis;
use crate::model::kind::Kind;
use crate::model::parameter_info::{NameError, ParameterMut, ParameterValue, Shape, find};
use crate::model::parameters::Hub;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, cross};
use crate::sets::with_numbers::{Change, WithNumbers};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::validation::imbalance::{Imbalance, WheelImbalance};

/// Which number of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Component {
    /// The only one.
    Number,
    /// That of a vector along an axis.
    Along(Axis),
    /// That of a symmetric tensor in a row and a column; off the diagonal, both elements together.
    Element(Axis, Axis),
}

/// A parameter that a derivative is taken by. Devices count from 0, as in the set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ParameterVariable<'a> {
    /// The hub's mass, kg.
    HubMass,
    /// Of the hub's centre of mass, B axes, m.
    HubCentre(Axis),
    /// An element of the hub's inertia about its centre of mass, B axes, kg m²; off the diagonal,
    /// both elements together.
    HubInertia(Axis, Axis),
    /// A parameter of a device by the name that [`Kind::parameter`] reads: `m_w`, `r_w_b`,
    /// `passive.wheel.viscous`. The mount has [`Self::MountRotation`].
    Device {
        /// The device.
        device: usize,
        /// The parameter.
        name: &'a str,
        /// Which of its numbers.
        component: Component,
    },
    /// A small rotation of a device's mount about an axis of B, rad: `mount` turns, the origin of
    /// the first joint stays.
    MountRotation {
        /// The device.
        device: usize,
        /// The axis.
        about: Axis,
    },
    /// `U_s`, the static imbalance of a device's wheel, kg m, as [`Imbalance`] states it.
    StaticImbalance {
        /// The device.
        device: usize,
    },
    /// `U_d`, the dynamic imbalance of a device's wheel, kg m², at its present phase; at phase zero
    /// where there is none.
    DynamicImbalance {
        /// The device.
        device: usize,
    },
    /// The phase of the dynamic imbalance of a device's wheel, rad.
    Phase {
        /// The device.
        device: usize,
    },
}

impl ParameterVariable<'_> {
    /// The device that it belongs to.
    fn device(&self) -> Option<usize> {
        match *self {
            Self::HubMass | Self::HubCentre(_) | Self::HubInertia(..) => None,
            Self::Device { device, .. }
            | Self::MountRotation { device, .. }
            | Self::StaticImbalance { device }
            | Self::DynamicImbalance { device }
            | Self::Phase { device } => Some(device),
        }
    }
}

impl<D: WithNumbers> Spacecraft<D> {
    /// Derivatives of the accelerations, and of what `outputs` names, by some parameters of the
    /// spacecraft of this hub and these devices: `column` is called with each variable and its
    /// derivatives, in the order of `variables`. Returns the accelerations.
    ///
    /// Exact to rounding, as [`Self::derivatives`] is: the constants of the kernels are prepared in
    /// [`Dual`](crate::Dual) numbers, too. Six variables an evaluation, without a heap. Parameters
    /// that rules tie together are differentiated one by one: an inertia does not follow its mass.
    /// By dry friction's `coulomb` where both it and `coulomb_rate` are zero there is no derivative.
    ///
    /// # Errors
    ///
    /// [`DerivativeError::Parameter`] as [`Self::new`], otherwise as [`Self::derivatives`];
    /// [`DerivativeError::NoSuchDevice`], [`DerivativeError::NoSuchParameter`],
    /// [`DerivativeError::NoImbalance`] and [`DerivativeError::Imbalance`] for a variable that does
    /// not exist.
    pub fn parameter_derivatives<'a, A: Attitude<D::Scalar>>(
        hub: &Hub<D::Scalar>,
        devices: &D,
        (state, inputs): (&State<D, A>, &Inputs<D>),
        outputs: &Outputs<D::Scalar>,
        variables: impl IntoIterator<Item = ParameterVariable<'a>>,
        mut column: impl FnMut(ParameterVariable<'a>, &Column<D>),
    ) -> Result<Accelerations<D>, DerivativeError<D::Scalar>> {
        let plain = Self::new(hub, devices)?;
        let accelerations = plain.checked(state, inputs, outputs)?;
        let dual_hub = hub.map(Number::constant);
        let dual_devices = devices.with_numbers(Number::constant);
        let results = |variables: &mut dyn Iterator<Item = ParameterVariable<'a>>| {
            let (mut hub, mut devices) = (dual_hub, dual_devices.clone());
            for (number, variable) in variables.enumerate() {
                seed(&mut hub, &mut devices, variable, number)?;
            }
            let dual = Spacecraft::<DualSet<D>>::prepared(&hub, &devices, zero());
            let at = Point::new(&dual, state, inputs, false);
            Results::of(&dual, &at, outputs).map_err(|error| not_finite(error, 0, None))
        };
        let mut variables = variables.into_iter().fuse();
        let mut first = 0_usize;
        loop {
            let some = [(); WIDTH].map(|()| variables.next());
            let by = || some.iter().flatten().copied();
            if by().next().is_none() {
                break;
            }
            let found = results(&mut by()).map_err(|error| {
                let alone = |variable| results(&mut core::iter::once(variable)).is_err();
                in_list(error, first, by().position(alone))
            })?;
            for (number, variable) in by().enumerate() {
                column(variable, &plain.column(&found, number));
            }
            first = first.saturating_add(WIDTH);
        }
        Ok(accelerations)
    }
}

/// The same error with the place in the list of the variable at fault.
fn in_list<T>(
    error: DerivativeError<T>,
    first: usize,
    number: Option<usize>,
) -> DerivativeError<T> {
    match error {
        DerivativeError::NotFinite { .. } => DerivativeError::NotFinite {
            variable: first.saturating_add(number.unwrap_or_default()),
        },
        error => error,
    }
}

/// Makes a parameter a variable of a number.
fn seed<T: Scalar, D: WithNumbers<Scalar = Number<T>>>(
    hub: &mut Hub<Number<T>>,
    devices: &mut D,
    variable: ParameterVariable<'_>,
    number: usize,
) -> Result<(), DerivativeError<T>> {
    let Some(device) = variable.device() else {
        match variable {
            ParameterVariable::HubCentre(axis) => {
                axis.of_mut(&mut hub.r_bc_b).add_derivative(number, one());
            }
            ParameterVariable::HubInertia(row, column) => {
                add_element(&mut hub.i_b_bc.data.0, row, column, number, one());
            }
            _ => hub.m_b.add_derivative(number, one()),
        }
        return Ok(());
    };
    let mut seeding = Seeding { next: 0, device, variable, number, found: None };
    devices.change(&mut seeding);
    let devices = seeding.next;
    seeding.found.unwrap_or(Err(DerivativeError::NoSuchDevice { device, devices }))
}

/// Adds to the derivative of an element of a symmetric tensor, once on the diagonal.
fn add_element<T: Scalar>(
    tensor: &mut Columns<Number<T>>,
    row: Axis,
    column: Axis,
    number: usize,
    derivative: T,
) {
    for (of, elements) in Axis::ALL.into_iter().zip(tensor) {
        for (at, element) in Axis::ALL.into_iter().zip(elements) {
            if (at, of) == (row, column) || (of, at) == (row, column) {
                element.add_derivative(number, derivative);
            }
        }
    }
}

/// Makes a parameter of one device a variable.
struct Seeding<'a, T> {
    /// The number of the device that comes next.
    next: usize,
    device: usize,
    variable: ParameterVariable<'a>,
    number: usize,
    found: Option<Result<(), DerivativeError<T>>>,
}

impl<T: Scalar> Change<Number<T>> for Seeding<'_, T> {
    fn change<K: Kind<Scalar = Number<T>>>(&mut self, device: &mut K) {
        if self.next == self.device {
            self.found = Some(self.seed(device));
        }
        self.next = self.next.saturating_add(1);
    }
}

impl<T: Scalar> Seeding<'_, T> {
    fn seed<K: Kind<Scalar = Number<T>>>(&self, device: &mut K) -> Result<(), DerivativeError<T>> {
        let number = self.number;
        match self.variable {
            ParameterVariable::Device { name, component, .. } => {
                self.seed_named(device, name, component)?;
            }
            ParameterVariable::MountRotation { about, .. } => {
                if let Some(ParameterMut::Matrix(mount)) = device.parameter_mut("mount") {
                    let unit = Axis::ALL.map(|axis| if axis == about { one() } else { zero() });
                    for column in &mut mount.data.0 {
                        let turned = cross(unit, column.map(|element| element.value));
                        for (element, derivative) in column.iter_mut().zip(turned) {
                            element.add_derivative(number, derivative);
                        }
                    }
                }
            }
            _ => self.seed_imbalance(device)?,
        }
        Ok(())
    }

    fn seed_named<K: Kind<Scalar = Number<T>>>(
        &self,
        device: &mut K,
        name: &str,
        component: Component,
    ) -> Result<(), DerivativeError<T>> {
        let number = self.number;
        let error = |name| DerivativeError::NoSuchParameter { device: self.device, name };
        let info = K::PARAMETERS.iter().find(|info| info.name == name);
        // What the table leaves out is of a joint: one number.
        let required = info.map_or(Shape::Scalar, |info| info.shape);
        match (find(device, name), component, required) {
            (None, ..) => return Err(error(NameError::Unknown { kind: K::NAME })),
            (Some(ParameterMut::Scalar(of)), Component::Number, _) => {
                of.add_derivative(number, one());
            }
            (Some(ParameterMut::Vector(of)), Component::Along(axis), _) => {
                axis.of_mut(of).add_derivative(number, one());
            }
            (Some(ParameterMut::Matrix(of)), Component::Element(row, column), Shape::Symmetric) => {
                add_element(&mut of.data.0, row, column, number, one());
            }
            _ => return Err(error(NameError::Shape { kind: K::NAME, required })),
        }
        Ok(())
    }

    /// By static or dynamic imbalance or phase: `d`, `J_12` and `J_13` change as [`Imbalance`] says.
    fn seed_imbalance<K: Kind<Scalar = Number<T>>>(
        &self,
        device: &mut K,
    ) -> Result<(), DerivativeError<T>> {
        let none = DerivativeError::NoImbalance { device: self.device };
        let parameters =
            [device.parameter("m_w"), device.parameter("d"), device.parameter("i_w_wc")];
        let [
            Ok(ParameterValue::Scalar(m_w)),
            Ok(ParameterValue::Scalar(d)),
            Ok(ParameterValue::Matrix(inertia)),
        ] = parameters
        else {
            return Err(none);
        };
        let imbalance = |error| DerivativeError::Imbalance { device: self.device, error };
        let wheel = WheelImbalance { d: d.value, j_12: inertia.m12.value, j_13: inertia.m13.value };
        let sheet = wheel.lumped(m_w.value).map_err(imbalance)?;
        sheet.in_wheel(m_w.value).map_err(imbalance)?;

        let Imbalance { u_s, u_d, phase } = sheet;
        let [u_s, u_d, phase] = [u_s, u_d, phase].map(Number::constant);
        let mut sheet = Imbalance { u_s, u_d, phase };
        let of = match self.variable {
            ParameterVariable::StaticImbalance { .. } => &mut sheet.u_s,
            ParameterVariable::DynamicImbalance { .. } => &mut sheet.u_d,
            _ => &mut sheet.phase,
        };
        of.add_derivative(self.number, one());
        let changed = sheet.in_wheel(Number::constant(m_w.value));
        let changed = changed.map_err(|_| DerivativeError::NotFinite { variable: self.number })?;
        // The phase of a negative d counts from -w_y, so that sheet is of a wheel half a turn on.
        let sense = if wheel.d < zero() { -one::<T>() } else { one() };
        let derivative = |of: Number<T>| sense * of.derivative(self.number);
        if let Some(ParameterMut::Scalar(d)) = device.parameter_mut("d") {
            d.add_derivative(self.number, derivative(changed.d));
        }
        if let Some(ParameterMut::Matrix(inertia)) = device.parameter_mut("i_w_wc") {
            let tensor = &mut inertia.data.0;
            add_element(tensor, Axis::X, Axis::Y, self.number, derivative(changed.j_12));
            add_element(tensor, Axis::X, Axis::Z, self.number, derivative(changed.j_13));
        }
        Ok(())
    }
}
