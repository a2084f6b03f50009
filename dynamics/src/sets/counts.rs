//! Whether state, inputs and accelerations are of as many devices and joints as a set has. Sets of
//! fixed size always are.

use core::marker::PhantomData;

use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Given, Maybe, Shared};
use crate::sets::devices::{DeviceSet, SetInputs, Visit};
use crate::sets::per_device::{Accelerations, Joints};

/// What may differ in its number of members.
type Counted = (Shared<Joints>, Maybe<Given>, Maybe<Shared<Accelerations>>);

/// Compares the numbers of members.
struct Counts<T>(PhantomData<T>);

impl<T: Scalar> Visit<T, Counted> for Counts<T> {
    type Error = SolveError<T>;

    #[inline]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        _: <Counted as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SolveError<T>> {
        Ok(())
    }

    #[inline]
    fn compare(&mut self, expected: usize, found: usize) -> Result<(), SolveError<T>> {
        compare_counts(expected, found)
    }
}

/// Rejects a number of members that is not that of the set.
#[inline]
pub(crate) fn compare_counts<T>(expected: usize, found: usize) -> Result<(), SolveError<T>> {
    if expected == found { Ok(()) } else { Err(SolveError::Count { expected, found }) }
}

/// Rejects data of another number of devices or joints.
#[inline]
pub(crate) fn check_counts<D: DeviceSet>(
    devices: &D::Prepared,
    joints: &D::Per<Joints>,
    given: Option<SetInputs<'_, D>>,
    accelerations: Option<&D::Per<Accelerations>>,
) -> Result<(), SolveError<D::Scalar>> {
    let data = (joints, given, accelerations);
    D::visit::<Counted, _>(devices, data, &mut Counts(PhantomData))
}
