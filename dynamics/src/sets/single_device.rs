//! A single device as a set.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::equations::device::Device;
use crate::model::kind::{JointInfo, Kind};
use crate::sets::bundle::{Bundle, MemberIndex, Part};
use crate::sets::devices::{DeviceSet, FixedSet, List, Visit};
use crate::sets::per_device::PerDevice;
use crate::validation::check::check_device;
use crate::validation::parameter_error::ParameterError;

impl<K: Kind> DeviceSet for K {
    type Scalar = K::Scalar;
    type Prepared = Device<K>;
    type Per<F: PerDevice<K::Scalar>> = F::Of<K>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<K::Scalar>> {
        check_device(*device, self)?;
        *device = device.wrapping_add(1);
        Ok(())
    }

    fn prepare(&self) -> Device<K> {
        Device::new(self)
    }

    fn new_data<F: PerDevice<K::Scalar>>(_: &Device<K>, family: &F) -> F::Of<K> {
        family.initial::<K>()
    }

    fn list<L: List<K::Scalar>>(device: &Device<K>) -> impl Iterator<Item = L::Item> {
        L::of(device)
    }

    #[inline(always)]
    fn visit<B: Bundle<K::Scalar>, V: Visit<K::Scalar, B>>(
        device: &Device<K>,
        data: B::Of<'_, K>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        visitor.visit(device, data)
    }

    fn count<F: PerDevice<K::Scalar>>(_: &F::Of<K>) -> Option<usize> {
        None
    }

    #[cfg(feature = "lanes")]
    fn set_groups(devices: &mut [Device<K>]) {
        crate::equations::side_by_side::group::set_groups(devices);
    }

    #[inline(always)]
    fn visit_row<W, B, V>(
        devices: &[Device<K>],
        data: &mut B::Of<'_, W>,
        first: usize,
        visitor: &mut V,
    ) -> Result<usize, V::Error>
    where
        W: DeviceSet<Scalar = K::Scalar>,
        B: Bundle<K::Scalar>,
        V: Visit<K::Scalar, B>,
        MemberIndex: Part<W, Of = K>,
    {
        visitor.visit_row::<K, W>(devices, data, first)
    }
}

impl<K: Kind> FixedSet for K {
    fn new_fixed<F: PerDevice<K::Scalar>>(family: &F) -> F::Of<K> {
        family.initial::<K>()
    }

    fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
        K::JOINTS.iter()
    }
}
