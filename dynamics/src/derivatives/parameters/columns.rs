//! [`Spacecraft::parameter_derivatives`]: columns by parameters of hub and devices.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::dual::column::{Column, Outputs, Results};
use crate::derivatives::dual::evaluation::not_finite;
use crate::derivatives::dual::point::{DualSet, Number, Point, WIDTH};
use crate::derivatives::error::DerivativeError;
use crate::derivatives::parameters::change::{add_change, add_hub_change};
#[cfg(feature = "alloc")]
use crate::derivatives::parameters::loads::ParameterLoads;
use crate::derivatives::variable::Axis;
use crate::model::kind::Kind;
use crate::model::parameters::Hub;
use crate::numbers::real::{Scalar, one, zero};
use crate::sets::with_numbers::{Change, WithNumbers};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

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
    /// `U_s`, the static imbalance of a device's wheel, kg m, as [`Imbalance`](crate::Imbalance) states it.
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
    pub(crate) fn device(&self) -> Option<usize> {
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
    /// Exact to rounding. With the feature `alloc`, accelerations only, without carriers, lumped imbalance and a
    /// central field: `-M⁻¹` times what the loads of one device, or of the hub, change by at these accelerations, by
    /// Newton's and Euler's equations of its bodies, with one elimination for all variables. Otherwise as
    /// [`Self::derivatives`], six variables an evaluation and without a heap: the constants of the kernels are prepared
    /// in [`Dual`](crate::Dual) numbers, too. Parameters that rules tie together are differentiated one by one: an
    /// inertia does not follow its mass.
    ///
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
        column: impl FnMut(ParameterVariable<'a>, &Column<D>),
    ) -> Result<Accelerations<D>, DerivativeError<D::Scalar>> {
        let plain = Self::alone(hub, devices)?;
        let found = plain.checked(state, inputs, outputs)?;
        plain.parameter_columns(
            (hub, devices),
            (state, inputs),
            &found,
            outputs,
            variables,
            column,
        )?;
        Ok(found)
    }

    /// The columns, of the spacecraft of this hub and these devices and with its accelerations.
    #[cfg_attr(
        not(feature = "alloc"),
        expect(unused_variables, reason = "without a heap all is computed in dual numbers")
    )]
    pub(crate) fn parameter_columns<'a, A: Attitude<D::Scalar>>(
        &self,
        (hub, devices): (&Hub<D::Scalar>, &D),
        (state, inputs): (&State<D, A>, &Inputs<D>),
        accelerations: &Accelerations<D>,
        outputs: &Outputs<D::Scalar>,
        variables: impl IntoIterator<Item = ParameterVariable<'a>>,
        mut column: impl FnMut(ParameterVariable<'a>, &Column<D>),
    ) -> Result<(), DerivativeError<D::Scalar>> {
        #[cfg(feature = "alloc")]
        if *outputs == Outputs::accelerations()
            && let Some(mut loads) =
                ParameterLoads::new(self, (hub, devices), (state, inputs), accelerations)
        {
            for (number, variable) in variables.into_iter().enumerate() {
                let found = loads.column(variable);
                column(variable, found.map_err(|error| in_list(error, number, None))?);
            }
            return Ok(());
        }
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
                column(variable, &self.column(&found, number));
            }
            first = first.saturating_add(WIDTH);
        }
        Ok(())
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
        add_hub_change(hub, variable, |of| of.add_derivative(number, one()));
        return Ok(());
    };
    let mut seeding = Seeding { next: 0, device, variable, number, found: None };
    devices.change(&mut seeding);
    let devices = seeding.next;
    seeding.found.unwrap_or(Err(DerivativeError::NoSuchDevice { device, devices }))
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
            let (of, number) = (*device, self.number);
            let value = |of: Number<T>| of.value;
            let add = |to: &mut Number<T>, by| to.add_derivative(number, by);
            let which = (self.device, self.variable);
            self.found = Some(add_change(device, (&of, value), which, add));
        }
        self.next = self.next.saturating_add(1);
    }
}
