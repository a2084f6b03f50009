//! Joints in a step: sums of slopes, the next stage, and the end of the step, device by device.
//!
//! A visitor, not iterators over a whole set: where devices are listed, four such iterators beside
//! each other take longer than the sums. A device of an enumeration is not converted to its kind.

#![expect(clippy::inline_always, reason = "a device's sums are shorter than a call")]

use core::convert::Infallible;

use crate::equations::device::Device;
use crate::model::kind::Kind;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, advanced_by, zero};
use crate::sets::bundle::{Bundle, Shared, Unique};
use crate::sets::devices::{Devices, Visit};
use crate::sets::enumeration::DeviceEnum;
use crate::sets::per_device::{Accelerations, Joints};

/// The stage, the start, the sum of slopes, and the accelerations at the stage.
pub(crate) type StageData = (Unique<Joints>, Shared<Joints>, Unique<Joints>, Shared<Accelerations>);

/// Adds `weight` times the slope to the sum, and sets the next stage: the start plus `offset` times
/// the slope, s both.
pub(crate) struct NextStage<T> {
    pub(crate) weight: T,
    pub(crate) offset: T,
}

impl<T: Scalar> NextStage<T> {
    #[inline(always)]
    fn joints<J: JointStates<T>>(
        &self,
        (stage, start, sum, found): (&mut J, &J, &mut J, &impl Each<T>),
    ) {
        let Self { weight, offset } = *self;
        let joints = stage.states_mut().zip(start.states());
        let joints = joints.zip(sum.states_mut()).zip(found.values());
        for ((([coordinate, rate], [from, rate_from]), [sum, sum_of_rate]), acceleration) in joints
        {
            *sum = *sum + weight * *rate;
            *sum_of_rate = *sum_of_rate + weight * acceleration;
            *coordinate = from + (zero::<T>() + offset * *rate);
            *rate = rate_from + (zero::<T>() + offset * acceleration);
        }
    }
}

impl<T: Scalar> Visit<T, StageData> for NextStage<T> {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        data: <StageData as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        self.joints(data);
        Ok(())
    }

    #[inline(always)]
    fn visit_enum<E: DeviceEnum<Scalar = T> + Devices>(
        &mut self,
        _: &E::Prepared,
        data: <StageData as Bundle<T>>::Of<'_, E>,
    ) -> Result<(), Infallible> {
        self.joints(data);
        Ok(())
    }
}

/// What becomes the end of the step, the start, and the sum of slopes.
pub(crate) type StepEndData = (Unique<Joints>, Shared<Joints>, Shared<Joints>);

/// Sets the start plus the sum of slopes; a joint that does not move, such as a locked one, keeps its bits.
pub(crate) struct StepEnd;

impl StepEnd {
    #[inline(always)]
    fn joints<T: Scalar, J: JointStates<T>>((next, start, sum): (&mut J, &J, &J)) {
        let joints = next.states_mut().zip(start.states().zip(sum.states()));
        for ([coordinate, rate], ([from, rate_from], [by, rate_by])) in joints {
            *coordinate = advanced_by(from, by);
            *rate = advanced_by(rate_from, rate_by);
        }
    }
}

impl<T: Scalar> Visit<T, StepEndData> for StepEnd {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        data: <StepEndData as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        Self::joints::<T, _>(data);
        Ok(())
    }

    #[inline(always)]
    fn visit_enum<E: DeviceEnum<Scalar = T> + Devices>(
        &mut self,
        _: &E::Prepared,
        data: <StepEndData as Bundle<T>>::Of<'_, E>,
    ) -> Result<(), Infallible> {
        Self::joints::<T, _>(data);
        Ok(())
    }
}
