//! [`WithNumbers`] of an isolated set: platform and suspension in other numbers, then what is carried.

use crate::isolation::parameters::Platform;
use crate::isolation::platform_elimination::PlatformConstants;
use crate::isolation::suspension::{Coupled, Strut, Suspension};
use crate::numbers::real::Scalar;
use crate::sets::devices::DeviceSet;
use crate::sets::isolated::{Isolated, PreparedIsolated};
use crate::sets::with_numbers::{Change, WithNumbers};

impl<T: Scalar> Suspension<T> {
    /// Each number converted.
    fn map<U: Scalar>(&self, number: impl Fn(T) -> U + Copy) -> Suspension<U> {
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

impl<D: WithNumbers> WithNumbers for Isolated<D> {
    type With<U: Scalar> = Isolated<D::With<U>>;

    fn with_numbers<U: Scalar>(
        &self,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> Isolated<D::With<U>> {
        Isolated {
            platform: self.platform.with_numbers(number),
            suspension: self.suspension.map(number),
            carried: self.carried.with_numbers(number),
        }
    }

    fn convert<U: Scalar>(
        devices: &PreparedIsolated<D>,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> <Self::With<U> as DeviceSet>::Prepared {
        let PlatformConstants { device, suspension, body, carried_mass } = &devices.carrier;
        let carrier = PlatformConstants {
            device: Platform::convert(device, number),
            suspension: suspension.map(number),
            body: body.map(number),
            carried_mass: number(*carried_mass),
        };
        PreparedIsolated { carrier, carried: D::convert(&devices.carried, number) }
    }

    fn change<C: Change<D::Scalar>>(&mut self, change: &mut C) {
        change.change(&mut self.platform);
        self.carried.change(change);
    }
}
