//! A set that may be absent: `[Option<BuiltIn>; 8]` carries up to eight devices, without a heap.
//!
//! What is absent has no joints, counts as no device and costs nothing but its place.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::numbers::each::{Each, JointStates, Value};
use crate::sets::bundle::{Bundle, Part};
use crate::sets::devices::{DeviceSet, List, Visit, compare};
use crate::sets::per_device::PerDevice;
use crate::validation::parameter_error::ParameterError;

impl<V: Value, P: Each<V>> Each<V> for Option<P> {
    fn values(&self) -> impl Iterator<Item = V> {
        self.iter().flat_map(P::values)
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.iter_mut().flat_map(P::values_mut)
    }
}

impl<T: Value, J: JointStates<T>> JointStates<T> for Option<J> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.iter().flat_map(J::states)
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.iter_mut().flat_map(J::states_mut)
    }
}

/// The member that there may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OptionMember;

impl<D: DeviceSet> Part<Option<D>> for OptionMember {
    type Of = D;

    #[inline(always)]
    fn of<F: PerDevice<D::Scalar>>(self, whole: &Option<D::Per<F>>) -> Option<&D::Per<F>> {
        whole.as_ref()
    }

    #[inline(always)]
    fn of_mut<F: PerDevice<D::Scalar>>(
        self,
        whole: &mut Option<D::Per<F>>,
    ) -> Option<&mut D::Per<F>> {
        whole.as_mut()
    }
}

impl<D: DeviceSet> DeviceSet for Option<D> {
    type Scalar = D::Scalar;
    type Prepared = Option<D::Prepared>;
    type Per<F: PerDevice<D::Scalar>> = Option<D::Per<F>>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<D::Scalar>> {
        self.as_ref().map_or(Ok(()), |member| member.check(device))
    }

    fn prepare(&self) -> Self::Prepared {
        self.as_ref().map(D::prepare)
    }

    fn new_data<F: PerDevice<D::Scalar>>(devices: &Self::Prepared, family: &F) -> Self::Per<F> {
        devices.as_ref().map(|member| D::new_data(member, family))
    }

    fn list<L: List<D::Scalar>>(devices: &Self::Prepared) -> impl Iterator<Item = L::Item> {
        devices.iter().flat_map(D::list::<L>)
    }

    #[inline(always)]
    fn visit<B: Bundle<D::Scalar>, V: Visit<D::Scalar, B>>(
        devices: &Self::Prepared,
        mut data: B::Of<'_, Self>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        compare::<Self, B, V>(usize::from(devices.is_some()), &data, visitor)?;
        let Some(member) = devices else { return Ok(()) };
        let Some(data) = B::part::<Self, OptionMember>(&mut data, OptionMember) else {
            return Ok(());
        };
        D::visit::<B, V>(member, data, visitor)
    }

    fn count<F: PerDevice<D::Scalar>>(data: &Self::Per<F>) -> Option<usize> {
        Some(usize::from(data.is_some()))
    }
}
