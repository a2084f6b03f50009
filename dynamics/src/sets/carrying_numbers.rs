//! [`WithNumbers`] of a set on a carrier: the carrier in other numbers, then what is carried.

use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierConstants;
use crate::numbers::real::Scalar;
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::DeviceSet;
use crate::sets::with_numbers::{Change, WithNumbers};

impl<T: Scalar, C: Carrier<Scalar = T>, D: WithNumbers<Scalar = T>> WithNumbers for Carrying<C, D> {
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
