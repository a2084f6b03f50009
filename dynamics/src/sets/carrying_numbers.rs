//! [`WithNumbers`] of a set on a carrier: the carrier in other numbers, then what is carried.

use crate::equations::device::Device;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierConstants;
use crate::isolation::panel::CarryingPanel;
use crate::isolation::parameters::Platform;
use crate::isolation::suspension::{Coupled, Strut, Suspension};
use crate::numbers::real::Scalar;
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::DeviceSet;
use crate::sets::with_numbers::{Change, WithNumbers};

/// The suspension of a carrier in other numbers.
type SuspensionOver<C, U> = <<C as CarrierNumbers>::Over<U> as Carrier>::Suspension;

/// A carrier in other numbers, precomputed, with its suspension.
type PreparedOver<C, U> = (Device<<C as CarrierNumbers>::Over<U>>, SuspensionOver<C, U>);

/// A carrier whose numbers can be converted. Implemented for every carrier of this crate.
pub trait CarrierNumbers: Carrier {
    /// The same carrier with parameters of other numbers.
    type Over<U: Scalar>: CarrierNumbers<Scalar = U>;

    /// Carrier and suspension with each number converted.
    #[doc(hidden)]
    fn over<U: Scalar>(
        &self,
        suspension: &Self::Suspension,
        number: impl Fn(Self::Scalar) -> U + Copy,
    ) -> (Self::Over<U>, SuspensionOver<Self, U>);
    /// The same, precomputed.
    #[doc(hidden)]
    fn device_over<U: Scalar>(
        device: &Device<Self>,
        suspension: &Self::Suspension,
        number: impl Fn(Self::Scalar) -> U + Copy,
    ) -> PreparedOver<Self, U>;
}

impl<T: Scalar> CarrierNumbers for Platform<T> {
    type Over<U: Scalar> = Platform<U>;

    fn over<U: Scalar>(
        &self,
        suspension: &Suspension<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> (Platform<U>, Suspension<U>) {
        (self.with_numbers(number), suspension.map(number))
    }

    fn device_over<U: Scalar>(
        device: &Device<Self>,
        suspension: &Suspension<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> (Device<Platform<U>>, Suspension<U>) {
        (Self::convert(device, number), suspension.map(number))
    }
}

impl<T: Scalar> CarrierNumbers for CarryingPanel<T> {
    type Over<U: Scalar> = CarryingPanel<U>;

    fn over<U: Scalar>(&self, (): &(), number: impl Fn(T) -> U + Copy) -> (CarryingPanel<U>, ()) {
        (self.with_numbers(number), ())
    }

    fn device_over<U: Scalar>(
        device: &Device<Self>,
        (): &(),
        number: impl Fn(T) -> U + Copy,
    ) -> (Device<CarryingPanel<U>>, ()) {
        (Self::convert(device, number), ())
    }
}

impl<T: Scalar> Suspension<T> {
    /// Each number converted.
    pub(crate) fn map<U: Scalar>(&self, number: impl Fn(T) -> U + Copy) -> Suspension<U> {
        let coupled = self.coupled.map(|of| Coupled {
            stiffness: of.stiffness.map(number),
            rest: of.rest.map(number),
            damping: of.damping.map(number),
        });
        let strut = |of: Strut<T>| Strut {
            position: of.position.map(number),
            direction: of.direction.map(number),
            length: number(of.length),
            stiffness: number(of.stiffness),
            damping: number(of.damping),
        };
        Suspension { coupled, struts: self.struts.map(|of| of.map(strut)) }
    }
}

impl<T, C, D> WithNumbers for Carrying<C, D>
where
    T: Scalar,
    C: CarrierNumbers<Scalar = T>,
    D: WithNumbers<Scalar = T>,
{
    type With<U: Scalar> = Carrying<C::Over<U>, D::With<U>>;

    fn with_numbers<U: Scalar>(&self, number: impl Fn(T) -> U + Copy) -> Self::With<U> {
        let (carrier, suspension) = self.carrier.over(&self.suspension, number);
        Carrying { carrier, suspension, carried: self.carried.with_numbers(number) }
    }

    fn convert<U: Scalar>(
        devices: &PreparedCarrying<C, D>,
        number: impl Fn(T) -> U + Copy,
    ) -> <Self::With<U> as DeviceSet>::Prepared {
        let CarrierConstants { device, suspension, body, carried_mass } = &devices.carrier;
        let (device, suspension) = C::device_over(device, suspension, number);
        let carrier = CarrierConstants {
            device,
            suspension,
            body: body.map(number),
            carried_mass: number(*carried_mass),
        };
        PreparedCarrying { carrier, carried: D::convert(&devices.carried, number) }
    }

    fn change<N: Change<T>>(&mut self, change: &mut N) {
        change.change(&mut self.carrier);
        self.carried.change(change);
    }
}
