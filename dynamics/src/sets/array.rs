//! Members in a row: arrays and, with the feature `alloc`, vectors.

use crate::model::kind::JointInfo;
use crate::sets::bundle::{Bundle, MemberIndex, Part};
use crate::sets::devices::{DeviceSet, FixedSet, List, Visit, compare};
use crate::sets::per_device::PerDevice;
use crate::validation::parameter_error::ParameterError;

/// An array of members.
macro_rules! array {
    ($member:ty) => {
        [$member; N]
    };
}

/// An array made of the members of another.
macro_rules! array_of {
    ($members:expr, $of:expr) => {
        $members.each_ref().map($of)
    };
}

/// Members in a row. `$map` makes one of the same length, `$count` is the length of data unless it
/// is known when the program is compiled.
macro_rules! row {
    ($row:ident, $map:ident, $data:ident => $count:expr $(, $n:ident)?) => {
        impl<D: DeviceSet $(, const $n: usize)?> Part<$row!(D)> for MemberIndex {
            type Of = D;

            #[inline(always)]
            fn of<F: PerDevice<D::Scalar>>(self, whole: &$row!(D::Per<F>)) -> Option<&D::Per<F>> {
                whole.get(self.0)
            }

            #[inline(always)]
            fn of_mut<F: PerDevice<D::Scalar>>(
                self,
                whole: &mut $row!(D::Per<F>),
            ) -> Option<&mut D::Per<F>> {
                whole.get_mut(self.0)
            }
        }

        impl<D: DeviceSet $(, const $n: usize)?> DeviceSet for $row!(D) {
            type Scalar = D::Scalar;
            type Prepared = $row!(D::Prepared);
            type Per<F: PerDevice<D::Scalar>> = $row!(D::Per<F>);

            fn check(&self, device: &mut usize) -> Result<(), ParameterError<D::Scalar>> {
                self.iter().try_for_each(|member| member.check(device))
            }

            fn prepare(&self) -> Self::Prepared {
                let mut devices: Self::Prepared = $map!(self, D::prepare);
                D::set_groups(&mut devices);
                devices
            }

            fn prepare_alone(&self) -> Self::Prepared {
                $map!(self, D::prepare_alone)
            }

            fn new_data<F: PerDevice<D::Scalar>>(
                devices: &Self::Prepared,
                family: &F,
            ) -> Self::Per<F> {
                $map!(devices, |device| D::new_data(device, family))
            }

            fn list<L: List<D::Scalar>>(
                devices: &Self::Prepared,
            ) -> impl Iterator<Item = L::Item> {
                devices.iter().flat_map(D::list::<L>)
            }

            #[inline(always)]
            fn visit<B: Bundle<D::Scalar>, V: Visit<D::Scalar, B>>(
                devices: &Self::Prepared,
                mut data: B::Of<'_, Self>,
                visitor: &mut V,
            ) -> Result<(), V::Error> {
                compare::<Self, B, V>(devices.len(), &data, visitor)?;
                // One device is no row: its code is that without lanes.
                if V::ROWS && devices.len() > 1 {
                    let mut first = 0;
                    while let Some(rest @ [_, ..]) = devices.get(first..) {
                        let shown = D::visit_row::<Self, B, V>(rest, &mut data, first, visitor)?;
                        first = first.saturating_add(shown);
                    }
                    return Ok(());
                }
                for (index, device) in devices.iter().enumerate() {
                    let Some(data) = B::part::<Self, MemberIndex>(&mut data, MemberIndex(index)) else { break };
                    D::visit::<B, V>(device, data, visitor)?;
                }
                Ok(())
            }

            fn count<F: PerDevice<D::Scalar>>($data: &Self::Per<F>) -> Option<usize> {
                $count
            }
        }
    };
}

row!(array, array_of, _data => None, N);

impl<D: FixedSet, const N: usize> FixedSet for [D; N] {
    fn new_fixed<F: PerDevice<D::Scalar>>(family: &F) -> Self::Per<F> {
        [(); N].map(|()| D::new_fixed(family))
    }

    fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
        [(); N].into_iter().flat_map(|()| D::joint_infos())
    }
}

/// A vector of members.
#[cfg(feature = "alloc")]
macro_rules! vector {
    ($member:ty) => {
        alloc::vec::Vec<$member>
    };
}

/// A vector made of the members of another.
#[cfg(feature = "alloc")]
macro_rules! vector_of {
    ($members:expr, $of:expr) => {
        $members.iter().map($of).collect()
    };
}

#[cfg(feature = "alloc")]
row!(vector, vector_of, data => Some(data.len()));
