//! A spacecraft over other numbers.

use crate::derivatives::structure::StructureDerivatives;
use crate::numbers::real::Scalar;
use crate::sets::with_numbers::WithNumbers;
use crate::solve::spacecraft::Spacecraft;

impl<D: WithNumbers, S: StructureDerivatives> Spacecraft<D, S> {
    /// The same spacecraft with each of its numbers converted, such as
    /// [`Dual::constant`](crate::Dual::constant): every service then runs over the other numbers.
    ///
    /// Converted are the constants that [`Self::new`] has computed, so parameters are no variables
    /// of the result. Those of which parameters are variables come from
    /// [`WithNumbers::with_numbers`](crate::set::WithNumbers::with_numbers) and [`Self::new`].
    ///
    /// [`Self::new`]: Spacecraft::new
    #[must_use]
    pub fn with_numbers<U: Scalar>(
        &self,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> Spacecraft<D::With<U>, S> {
        let devices = D::convert(&self.devices, number);
        let structure = S::constants(self, &devices, number);
        Spacecraft {
            hub: self.hub.map(number),
            body: self.body.map(number),
            shares: self.shares.map(number),
            devices,
            passive: self.passive,
            hub_excess: number(self.hub_excess),
            arithmetic: self.arithmetic,
            structure,
        }
    }
}
